"""Operators of the tip's edge: how deep its nodes, between the contact nodes, too, pass the casing."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .casing_of_run import CasingOfRun
from .contact_operators import ContactOperators
from .stepped_blade import SteppedBlade


@dataclass(frozen=True, eq=False)
class EdgeOperators:
    """Operators of the edge's nodes of a stepped `blade`, in the `casing` as they meet it; forces act on those of `contact`."""

    blade: SteppedBlade
    casing: CasingOfRun
    contact: ContactOperators

    @cached_property
    def motion(self) -> ContactOperators:
        """Operators from the motion of all modes to the edge."""
        return ContactOperators(self.blade, self.casing)

    @cached_property
    def flexibility(self) -> np.ndarray:
        """Normal displacement (m/N), shape (edge nodes, 3 contact nodes), that follows forces at once; see static_shapes."""
        return self.motion.operator_at_rest[0] @ self.contact.static_shapes

    @property
    def depth(self) -> float:
        """Distance (m) from the surface that a node meets first to the casing: the lining's thickness, 0 without one."""
        lining = self.casing.scene.lining
        return lining.thickness if lining else 0.0

    @property
    def room(self) -> np.ndarray:
        """Distance (m) of each node of the edge from the round casing, behind a lining where there is one, shape (nodes,)."""
        return self.casing.clearance + self.depth

    @property
    def penetration_at_rest(self) -> float:
        """Penetration (m) of the edge into the casing before anything vibrates; 0 where it is clear of it."""
        return max(0.0, -float(self.room.min()))
