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
    """Where stress is recovered: unclamped nodes with x < `maximum_x` and `minimum_z` < z < `maximum_z` (m).

    `excluded_layers`: elements that hold a contact node or a clamped node are left out, and so many further layers round them
    as this number exceeds one: there a force on a single node and the clamping give stresses that grow with a finer mesh.
    """

    maximum_x: float
    minimum_z: float
    maximum_z: float
    excluded_layers: int

    def elements(self, mesh: BladeMesh, contact_nodes: np.ndarray) -> dict[str, np.ndarray]:
        """Nodes of the elements all of whose nodes qualify, by element type."""
        x, _, z = mesh.points.T
        qualifies = (x < self.maximum_x) & (z > self.minimum_z) & (z < self.maximum_z)
        root = mesh.node_set("root")
        qualifies[root] = False
        near = np.zeros(len(x), dtype=bool)
        near[contact_nodes] = near[root] = True
        for _ in range(self.excluded_layers - 1):
            near[np.concatenate([nodes[near[nodes].any(axis=1)].ravel() for nodes in mesh.blocks.values()])] = True
        chosen = {}
        for name, nodes in mesh.blocks.items():
            kept = qualifies[nodes].all(axis=1) & ~(near[nodes].any(axis=1) & (self.excluded_layers > 0))
            if kept.any():
                chosen[name] = nodes[kept]
        return chosen


EVERYWHERE = StressSubmesh(np.inf, -np.inf, np.inf, 0)
"""Stress on the whole blade but for the clamped elements."""


@dataclass(frozen=True)
class ReductionChoice:
    """What the reduced model is made of.

    Boundary nodes, speeds (rad/s) at which the basis is computed, fixed-interface modes at each, tolerance of
    dependence, which rotation terms are kept, where stress is recovered, and whether the whole blade is.
    """

    boundary: BoundaryChoice
    speeds: tuple[float, ...]
    fixed_interface_modes: int
    basis_tolerance: float
    spin_softening: bool
    coriolis: bool
    stress_submesh: StressSubmesh
    recover_whole_blade: bool

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
