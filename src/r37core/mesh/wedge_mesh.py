"""The wedge mesh as an object: nodes, elements, the parameters of each node on the blade, and named node sets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

NODE_SETS = (
    "root",
    "tip_pressure_edge",
    "tip_suction_edge",
    "tip_camber_line",
    "leading_edge",
    "trailing_edge",
)


@dataclass(frozen=True)
class WedgeMesh:
    """A mesh of 15-node wedges.

    `points`: coordinates (m), shape (nodes, 3); `elements`: node numbers from 0, shape (elements, 15), in the order of
    C3D15; `parameters`: (chord, span, thickness) of each node, shape (nodes, 3); `normals`: unit vector from the
    pressure to the suction side at each node, shape (nodes, 3).
    """

    points: np.ndarray
    elements: np.ndarray
    parameters: np.ndarray
    normals: np.ndarray

    def node_set(self, name: str) -> np.ndarray:
        """Node numbers of a named set; lines along the tip run from the leading to the trailing edge.

        Raises KeyError for a name not in NODE_SETS.
        """
        chord, span, thickness = self.parameters.T
        at_tip = span == 1.0
        members = {
            "root": span == 0.0,
            "tip_pressure_edge": at_tip & (thickness == -1.0),
            "tip_suction_edge": at_tip & (thickness == 1.0),
            "tip_camber_line": at_tip & (thickness == 0.0),
            "leading_edge": chord == 0.0,
            "trailing_edge": chord == 1.0,
        }[name]
        nodes = np.flatnonzero(members)
        return nodes[np.argsort(chord[nodes], kind="stable")] if name.startswith("tip_") else nodes

    @property
    def free_nodes(self) -> np.ndarray:
        """Numbers of the nodes that are not clamped at the root."""
        return np.setdiff1d(np.arange(len(self.points)), self.node_set("root"))
