"""What a reduced model is made of. Light: the configuration imports it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from r37core.mesh.blade_mesh import BladeMesh

from .boundary import BoundaryChoice


@dataclass(frozen=True)
class StressSubmesh:
    """Where stress is recovered: nodes with x < `maximum_x` and `minimum_z` < z < `maximum_z` (m), none of them clamped."""

    maximum_x: float
    minimum_z: float
    maximum_z: float

    def elements(self, mesh: BladeMesh) -> dict[str, np.ndarray]:
        """Nodes of the elements all of whose nodes qualify, by element type."""
        x, _, z = mesh.points.T
        qualifies = (x < self.maximum_x) & (z > self.minimum_z) & (z < self.maximum_z)
        qualifies[mesh.node_set("root")] = False
        chosen = {name: nodes[qualifies[nodes].all(axis=1)] for name, nodes in mesh.blocks.items()}
        return {name: nodes for name, nodes in chosen.items() if len(nodes)}


@dataclass(frozen=True)
class ReductionChoice:
    """What the reduced model is made of.

    Boundary nodes, speeds (rad/s) at which the basis is computed, fixed-interface modes at each, tolerance of
    dependence, which rotation terms are kept, where stress is recovered, and whether the whole blade is.
    """

    boundary: BoundaryChoice
    speeds: tuple[float, ...]
    fixed_interface_modes: int
    tolerance: float
    spin_softening: bool
    coriolis: bool
    stress_submesh: StressSubmesh
    whole_blade: bool

    @classmethod
    def from_plain(cls, values: Mapping[str, Any]) -> ReductionChoice:
        """From the dictionary that `asdict` makes of a choice."""
        return cls(
            **dict(values)
            | {
                "boundary": BoundaryChoice(**values["boundary"]),
                "speeds": tuple(values["speeds"]),
                "stress_submesh": StressSubmesh(**values["stress_submesh"]),
            }
        )
