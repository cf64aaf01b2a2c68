"""The outer surface of a mesh: its faces, patches of them, and the loops round a patch."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy import ndarray
from scipy.sparse.csgraph import connected_components

from .elements import ELEMENTS


@dataclass(frozen=True)
class Faces:
    """Faces of one shape: `nodes`, shape (faces, n), corners counter-clockwise seen from outside, then mid-nodes."""

    corners: int
    nodes: ndarray

    @property
    def quadratic(self) -> bool:
        """True where the edges have mid-nodes."""
        return self.nodes.shape[1] > self.corners

    def edges(self) -> ndarray:
        """Edges in the turn of the face, shape (faces * corners, 3): start, mid-node (-1 without), end."""
        start = self.nodes[:, : self.corners]
        middle = self.nodes[:, self.corners :] if self.quadratic else np.full_like(start, -1)
        return np.stack([start, middle, np.roll(start, -1, axis=1)], axis=2).reshape(-1, 3)


def outer_faces(blocks: Mapping[str, ndarray]) -> list[Faces]:
    """Faces that belong to one element only, by shape (triangles and quadrangles, with or without mid-nodes)."""
    shape_faces: dict[tuple[int, int], list[ndarray]] = {}
    for name, elements in blocks.items():
        element = ELEMENTS[name]
        for face, corners in zip(element.faces, element.shape.faces, strict=True):
            shape_faces.setdefault((len(corners), len(face)), []).append(elements[:, list(face)])
    outer = []
    for corner_count in (3, 4):
        shapes = {shape: np.concatenate(parts) for shape, parts in shape_faces.items() if shape[0] == corner_count}
        if not shapes:
            continue
        keys = np.concatenate([np.sort(nodes[:, :corner_count], axis=1) for nodes in shapes.values()])
        _, inverse, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
        once = np.split(count[inverse.ravel()] == 1, np.cumsum([len(nodes) for nodes in shapes.values()])[:-1])
        outer += [Faces(corner_count, nodes[keep]) for nodes, keep in zip(shapes.values(), once, strict=True) if keep.any()]
    return outer


def mask_within(faces: list[Faces], members: ndarray) -> ndarray:
    """Mask over the faces, shape (faces,), whose nodes are all `members`, a mask over the mesh's nodes."""
    return np.concatenate([np.empty(0, dtype=bool), *(members[part.nodes].all(axis=1) for part in faces)])


def chosen(faces: list[Faces], mask: ndarray) -> list[Faces]:
    """The faces of a mask over all of them, shape (faces,)."""
    parts = np.split(mask, np.cumsum([len(part.nodes) for part in faces])[:-1])
    return [Faces(part.corners, part.nodes[keep]) for part, keep in zip(faces, parts, strict=True) if keep.any()]


def nodes_of(faces: list[Faces]) -> ndarray:
    """Numbers of the nodes of these faces, ascending."""
    return np.unique(np.concatenate([np.empty(0, dtype=np.int64), *(part.nodes.ravel() for part in faces)]))


def loops(faces: list[Faces]) -> list[ndarray]:
    """Closed lines round a patch: node numbers in order, mid-nodes among them, counter-clockwise seen from outside.

    A patch with holes has several; the order of the loops is that of their first node.
    """
    edges = np.concatenate([part.edges() for part in faces])
    keys = np.sort(edges[:, [0, 2]], axis=1)
    _, inverse, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    following = {int(start): (int(middle), int(end)) for start, middle, end in edges[count[inverse.ravel()] == 1]}
    lines = []
    while following:
        start = min(following)
        line, node = [], start
        while node in following:
            middle, end = following.pop(node)
            line += [node] if middle < 0 else [node, middle]
            node = end
        lines.append(np.array(line))
    return lines


def area_vectors(faces: list[Faces], points: ndarray) -> ndarray:
    """Outward normal of each face times its area, shape (faces, 3), of its corners at `points`, shape (nodes, 3)."""
    outer = []
    for part in faces:
        corners = points[part.nodes[:, : part.corners]]
        # of a quadrangle both diagonals, of a triangle two edges
        (a, b), (c, d) = ((0, 2), (1, 3)) if part.corners == 4 else ((0, 1), (0, 2))
        outer.append(0.5 * np.cross(corners[:, b] - corners[:, a], corners[:, d] - corners[:, c]))
    return np.concatenate(outer)


def smooth_patches(faces: list[Faces], vectors: ndarray, crease: float) -> ndarray:
    """Patch of each face, shape (faces,), from `area_vectors`: normals of neighbours differ by less than `crease` (rad)."""
    edges = np.sort(np.concatenate([part.edges()[:, [0, 2]] for part in faces]), axis=1)
    owner = np.repeat(np.arange(len(vectors)), np.concatenate([np.full(len(part.nodes), part.corners) for part in faces]))
    _, edge_numbers = np.unique(edges, axis=0, return_inverse=True)
    order = np.argsort(edge_numbers.ravel(), kind="stable")
    pairs = np.flatnonzero(np.diff(edge_numbers.ravel()[order]) == 0)
    first, second = owner[order[pairs]], owner[order[pairs + 1]]
    normals = vectors / np.linalg.norm(vectors, axis=1)[:, None]
    smooth = np.sum(normals[first] * normals[second], axis=1) > np.cos(crease)
    graph = sp.coo_array((np.ones(smooth.sum()), (first[smooth], second[smooth])), shape=(len(vectors),) * 2)
    return connected_components(graph, directed=False)[1]
