"""Boundary nodes of the reduced model: evenly spaced along one line of the tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from r37core.mesh.blade_mesh import BladeMesh

TIP_LINES = {
    "pressure_edge": "tip_pressure_edge",
    "camber": "tip_camber_line",
    "suction_edge": "tip_suction_edge",
}
"""Name of a tip line in the configuration -> node set of the mesh."""


class BoundaryError(ValueError):
    """Boundary nodes that the mesh does not have."""


@dataclass(frozen=True)
class BoundaryChoice:
    """Where the contact nodes lie: the tip line (a key of TIP_LINES), how many, and whether the corners are among them.

    With corners, node i of n lies at i/(n-1) of the chord; without, at (i + 1/2)/n.
    """

    tip_line: str
    nodes: int
    corners: bool

    @property
    def chord_positions(self) -> np.ndarray:
        """Wanted fractions of the chord, from the leading to the trailing edge."""
        if self.corners and self.nodes > 1:
            return np.linspace(0.0, 1.0, self.nodes)
        return (np.arange(self.nodes) + 0.5) / self.nodes


def boundary_nodes(mesh: BladeMesh, choice: BoundaryChoice) -> np.ndarray:
    """Numbers of the mesh nodes nearest to the wanted positions, from the leading to the trailing edge.

    Raises BoundaryError when the line has too few nodes for them to be distinct.
    """
    line = mesh.node_set(TIP_LINES[choice.tip_line])
    chord = mesh.parameters[line, 0]
    distance = np.abs(chord[None, :] - choice.chord_positions[:, None]) if len(line) else np.empty((choice.nodes, 0))
    nearest = distance.argmin(axis=1) if len(line) else np.empty(0, dtype=int)
    if len(np.unique(nearest)) < choice.nodes:
        raise BoundaryError(
            f"{choice.nodes} boundary nodes do not fit on the {len(line)} mesh nodes of the tip line "
            f"'{choice.tip_line}'; ask for fewer, or raise tip_elements (for the camber line also: an odd number of "
            "layers, or an even one with nodes at mid-thickness) in the fidelity level; of an imported mesh, refine the tip"
        )
    return line[nearest]
