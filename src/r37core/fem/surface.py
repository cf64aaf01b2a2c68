"""The outer surface of a mesh: its faces, patches of them, and the loops round a patch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from .elements import ELEMENTS


@dataclass(frozen=True)
class Faces:
    """Faces of one shape: `nodes`, shape (faces, n), corners counter-clockwise seen from outside, then mid-nodes."""

    corners: int
    nodes: np.ndarray

    @property
    def quadratic(self) -> bool:
        """Whether the edges have mid-nodes."""
        return self.nodes.shape[1] > self.corners

    def edges(self) -> np.ndarray:
        """Edges in the turn of the face, shape (faces * corners, 3): start, mid-node (-1 without), end."""
        start = self.nodes[:, : self.corners]
        middle = self.nodes[:, self.corners :] if self.quadratic else np.full_like(start, -1)
        return np.stack([start, middle, np.roll(start, -1, axis=1)], axis=2).reshape(-1, 3)

    def where(self, members: np.ndarray) -> Faces:
        """Faces all of whose nodes are `members`, a mask over the mesh's nodes."""
        return Faces(self.corners, self.nodes[members[self.nodes].all(axis=1)])


def outer_faces(blocks: Mapping[str, np.ndarray]) -> list[Faces]:
    """Faces that belong to one element only, by shape (triangles and quadrangles, with or without mid-nodes)."""
    by_shape: dict[tuple[int, int], list[np.ndarray]] = {}
    for name, elements in blocks.items():
        element = ELEMENTS[name]
        for face, corners in zip(element.faces, element.corner_faces, strict=True):
            by_shape.setdefault((len(corners), len(face)), []).append(elements[:, list(face)])
    outer = []
    for corner_count in (3, 4):
        shapes = {shape: np.concatenate(parts) for shape, parts in by_shape.items() if shape[0] == corner_count}
        if not shapes:
            continue
        keys = np.concatenate([np.sort(nodes[:, :corner_count], axis=1) for nodes in shapes.values()])
        _, inverse, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
        once = np.split(count[inverse.ravel()] == 1, np.cumsum([len(nodes) for nodes in shapes.values()])[:-1])
        outer += [Faces(corner_count, nodes[keep]) for nodes, keep in zip(shapes.values(), once, strict=True) if keep.any()]
    return outer


def faces_within(faces: list[Faces], members: np.ndarray) -> list[Faces]:
    """The faces all of whose nodes are `members`, a mask over the mesh's nodes."""
    within = [part.where(members) for part in faces]
    return [part for part in within if len(part.nodes)]


def nodes_of(faces: list[Faces]) -> np.ndarray:
    """Numbers of the nodes of these faces, ascending."""
    return np.unique(np.concatenate([np.empty(0, dtype=np.int64), *(part.nodes.ravel() for part in faces)]))


def patches(faces: list[Faces]) -> int:
    """Number of patches of faces that share no node."""
    edges = np.concatenate([part.edges() for part in faces])
    _, local = np.unique(edges[:, [0, 2]], return_inverse=True)
    pairs = local.reshape(-1, 2).T
    size = int(pairs.max()) + 1
    graph = sp.coo_array((np.ones(pairs.shape[1]), (pairs[0], pairs[1])), shape=(size, size))
    return int(connected_components(graph, directed=False)[0])


def loops(faces: list[Faces]) -> list[np.ndarray]:
    """Closed lines round a patch: node numbers in order, mid-nodes among them, counter-clockwise seen from outside.

    A patch with holes has several; the order of the loops is that of their first node.
    """
    edges = np.concatenate([part.edges() for part in faces])
    keys = np.sort(edges[:, [0, 2]], axis=1)
    _, inverse, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    following = {int(start): (int(middle), int(end)) for start, middle, end in edges[count[inverse.ravel()] == 1]}
    found = []
    while following:
        start = min(following)
        line, node = [], start
        while node in following:
            middle, end = following.pop(node)
            line += [node] if middle < 0 else [node, middle]
            node = end
        found.append(np.array(line))
    return found
