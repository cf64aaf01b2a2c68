"""Shape functions along edges of a mesh: they spread a distributed load consistently over nodes."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy import ndarray

from .elements import ELEMENTS

_POINTS = 8
"""Gauss points along an edge: more than polynomials ask for, because what is integrated has kinks inside elements."""


@dataclass(frozen=True)
class Trace:
    """Edges of one shape, at the points of a quadrature.

    `nodes`: mesh nodes, shape (edges, n); `values`: their shape functions, shape (points, n); `measures`: length (m) that each
    point stands for, shape (edges, points).
    """

    nodes: ndarray
    values: ndarray
    measures: ndarray


def edge_traces(points: ndarray, blocks: Mapping[str, ndarray], members: ndarray) -> list[Trace]:
    """Edges all of whose nodes are `members`, a mask over the mesh's nodes; each edge once.

    `points`: coordinates (m), shape (nodes, 3); `blocks`: element type -> node numbers, shape (elements, nodes of the type).
    """
    edges: dict[int, list[ndarray]] = {}
    for name, elements in blocks.items():
        element = ELEMENTS[name]
        for start, end in sorted(map(sorted, element.shape.edges)):
            local = [start, end] + ([element.edges[frozenset((start, end))]] if element.quadratic else [])
            inside = members[elements[:, local]].all(axis=1)
            edges.setdefault(len(local), []).append(elements[inside][:, local])
    several = [np.concatenate(parts) for parts in edges.values()]
    # without those that another element has, too
    firsts = [np.unique(np.sort(each[:, :2], axis=1), axis=0, return_index=True)[1] for each in several]
    return [chain_trace(points, each[np.sort(first)]) for each, first in zip(several, firsts, strict=True)]


def chain_trace(points: ndarray, edges: ndarray) -> Trace:
    """Edges by their node numbers, shape (edges, 2 or 3): both ends, then the middle where there is one."""
    along, weights = np.polynomial.legendre.leggauss(_POINTS)
    if edges.shape[1] == 2:
        values = np.stack([0.5 * (1.0 - along), 0.5 * (1.0 + along)], axis=1)
        slopes = np.stack([np.full(_POINTS, -0.5), np.full(_POINTS, 0.5)], axis=1)
    else:
        values = np.stack([0.5 * along * (along - 1.0), 0.5 * along * (along + 1.0), 1.0 - along**2], axis=1)
        slopes = np.stack([along - 0.5, along + 0.5, -2.0 * along], axis=1)
    tangents = np.einsum("qn,end->eqd", slopes, points[edges])
    return Trace(edges, values, weights * np.linalg.norm(tangents, axis=2))
