"""Shape functions along edges and on faces of a mesh: what spreads a distributed load consistently over nodes."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .elements import ELEMENTS, Element

_POINTS = 8
"""Gauss points along each side: more than polynomials ask for, because what is integrated has kinks inside elements."""


@dataclass(frozen=True)
class Trace:
    """Edges or faces of one shape, at the points of a quadrature.

    `nodes`: mesh nodes, shape (parts, n); `values`: their shape functions, shape (points, n); `measures`: length (m) or area
    (m2) that each point stands for, shape (parts, points).
    """

    nodes: np.ndarray
    values: np.ndarray
    measures: np.ndarray


def edge_traces(points: np.ndarray, blocks: Mapping[str, np.ndarray], members: np.ndarray) -> list[Trace]:
    """Edges all of whose nodes are `members`, a mask over the mesh's nodes; each edge once.

    `points`: coordinates (m), shape (nodes, 3); `blocks`: element type -> node numbers, shape (elements, nodes of the type).
    """
    edges: dict[int, list[np.ndarray]] = {}
    for name, elements in blocks.items():
        element = ELEMENTS[name]
        for start, end in sorted(map(sorted, element.shape.edges)):
            local = [start, end] + ([element.edges[frozenset((start, end))]] if element.quadratic else [])
            inside = members[elements[:, local]].all(axis=1)
            edges.setdefault(len(local), []).append(elements[inside][:, local])
    return [chain_trace(points, _each_once(np.concatenate(parts))) for parts in edges.values()]


def chain_trace(points: np.ndarray, edges: np.ndarray) -> Trace:
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


def face_traces(points: np.ndarray, blocks: Mapping[str, np.ndarray], members: np.ndarray) -> list[Trace]:
    """Faces all of whose nodes are `members`; arguments as of `edge_traces`."""
    traces = []
    for name, elements in blocks.items():
        element = ELEMENTS[name]
        for face, corners in zip(element.faces, element.shape.faces, strict=True):
            nodes = elements[members[elements[:, list(face)]].all(axis=1)]
            if len(nodes):
                traces.append(_face_trace(points, element, list(face), list(corners), nodes))
    return traces


def _face_trace(points: np.ndarray, element: Element, face: list[int], corners: list[int], elements: np.ndarray) -> Trace:
    """Trace of the same face of many elements of a type. A triangle is a quadrangle of which two corners are one."""
    along, weights = np.polynomial.legendre.leggauss(_POINTS)
    first, second = (axis.ravel() for axis in np.meshgrid(along, along))
    # bilinear in the square from -1 to 1, and its slopes along both sides
    signs = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    terms = 1.0 + first[:, None] * signs[:, 0], 1.0 + second[:, None] * signs[:, 1]
    ends = element.nodes[corners if len(corners) == 4 else [*corners, corners[2]]]
    local = 0.25 * (terms[0] * terms[1]) @ ends
    slopes = 0.25 * (signs[:, 0] * terms[1]) @ ends, 0.25 * (signs[:, 1] * terms[0]) @ ends
    gradients = element.shape_gradients(local)
    sides = [np.einsum("qnk,qk,end->eqd", gradients, slope, points[elements], optimize=True) for slope in slopes]
    areas = np.outer(weights, weights).ravel() * np.linalg.norm(np.cross(*sides), axis=2)
    return Trace(elements[:, face], element.shape_functions(local)[:, face], areas)


def _each_once(edges: np.ndarray) -> np.ndarray:
    """The edges without those that another element has, too."""
    _, first = np.unique(np.sort(edges[:, :2], axis=1), axis=0, return_index=True)
    return edges[np.sort(first)]
