"""A blade's mesh as an object: nodes, elements of one or more types, where each node lies on the blade, named node sets."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy import ndarray

TIP_LINES = {"pressure_edge": "tip_pressure_edge", "camber": "tip_camber_line", "suction_edge": "tip_suction_edge"}
"""Name of a line of the tip -> its node set."""

NODE_SETS = ("root", "tip", "tip_pressure_edge", "tip_suction_edge", "tip_camber_line", "leading_edge", "trailing_edge")


@dataclass(frozen=True)
class BladeMesh:
    """A mesh of solid elements in the blade's frame.

    `points`: coordinates (m), shape (nodes, 3); `blocks`: name of an element type (of meshio) -> node numbers from 0, shape
    (elements, nodes of the type); `parameters`: (chord, span, thickness) of each node, shape (nodes, 3), chord 0 (leading)
    to 1 (trailing edge), span 0 (root) to 1 (tip), thickness -1 (pressure) to 1 (suction side); `normals`: unit vector from
    the pressure to the suction side at each node, shape (nodes, 3); `node_sets`: node numbers of each name in NODE_SETS,
    those of TIP_LINES from the leading to the trailing edge. `cyclic`, shape (pairs, 2), of a sector of a disc alone: each node
    of its low face, and the node of its high face that it becomes by a turn of one sector about z.
    """

    points: ndarray
    blocks: Mapping[str, ndarray]
    parameters: ndarray
    normals: ndarray
    node_sets: Mapping[str, ndarray]
    cyclic: ndarray | None = None

    def node_set(self, name: str) -> ndarray:
        """Node numbers of a set, lines of the tip from leading to trailing edge; KeyError for a name not in NODE_SETS."""
        return self.node_sets[name]

    def mask(self, name: str) -> ndarray:
        """Mask over the nodes, shape (nodes,), of those of a set; KeyError as of node_set."""
        return np.isin(np.arange(len(self.points)), self.node_set(name))

    @property
    def free_nodes(self) -> ndarray:
        """Numbers of the nodes that are not clamped at the root."""
        return np.setdiff1d(np.arange(len(self.points)), self.node_set("root"))


def parametric_node_sets(parameters: ndarray) -> dict[str, ndarray]:
    """Node sets of a mesh whose `parameters`, shape (nodes, 3), are exact on the faces of the blade."""
    chord, span, thickness = parameters.T
    tip_mask = span == 1.0
    members = {
        "root": span == 0.0,
        "tip": tip_mask,
        "tip_pressure_edge": tip_mask & (thickness == -1.0),
        "tip_suction_edge": tip_mask & (thickness == 1.0),
        "tip_camber_line": tip_mask & (thickness == 0.0),
        "leading_edge": chord == 0.0,
        "trailing_edge": chord == 1.0,
    }
    return {name: along_chord(np.flatnonzero(mask), name, chord) for name, mask in members.items()}


def along_chord(nodes: ndarray, name: str, chord: ndarray) -> ndarray:
    """The nodes of the set `name`, from leading to trailing edge (by `chord` of all nodes) if it is a line of the tip."""
    return nodes[np.argsort(chord[nodes], kind="stable")] if name in TIP_LINES.values() else nodes
