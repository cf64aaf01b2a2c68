"""Virtual strain gauges: the strain at a place on the blade's surface, in one direction of the surface."""

from collections.abc import Sequence

import numpy as np

from r37core.fem.elements import ELEMENTS, Element
from r37core.fem.surface import outer_faces
from r37core.mesh.blade_mesh import BladeMesh
from r37core.stress.gauge import Gauge


def gauge_rows(mesh: BladeMesh, basis: np.ndarray, gauges: Sequence[Gauge]) -> tuple[np.ndarray, np.ndarray]:
    """Strain of every gauge per unit of each reduced coordinate, shape (gauges, coordinates), and its place (m), (gauges, 3).

    `basis`, shape (nodes, 3, coordinates): displacement of all nodes. The strain is that of the element under the gauge, at
    the gauge: n . e n with e = (grad u + grad u^T) / 2 and n the unit vector along the grid. Of the vibration: the static
    strain of the rotation is no part of it. Raises ValueError for a place that is not on the blade's surface.
    """
    rows, places = [], []
    for gauge in gauges:
        element, nodes, local, slopes, parameters = _surface_point(mesh, gauge)
        corners = mesh.points[nodes]
        tangents = slopes @ element.jacobian(corners[None], local)[0, 0].T
        # from the span towards the trailing edge, in the surface
        chordwise, spanwise = np.linalg.inv(parameters) @ tangents
        along = spanwise / np.linalg.norm(spanwise)
        across = chordwise - along * (along @ chordwise)
        direction = np.cos(gauge.angle) * along + np.sin(gauge.angle) * across / np.linalg.norm(across)
        gradients, _ = element.physical_gradients(corners[None], local)
        rows.append(np.einsum("a,aij,i->j", gradients[0, 0] @ direction, basis[nodes], direction, optimize=True))
        places.append(element.shape_functions(local)[0] @ corners)
    return np.array(rows), np.array(places)


def _surface_point(mesh: BladeMesh, gauge: Gauge) -> tuple[Element, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """The element under a gauge, by the triangle of corners of its side's outer faces that holds (chord, span).

    With the numbers of its nodes, the local coordinates of the gauge there, shape (1, 3), their change along two directions in
    the surface, shape (2, 3), and that of (chord, span) along these, shape (2, 2).
    """
    corners = np.concatenate(_triangles(mesh, gauge.side))
    parameters = mesh.parameters[corners, :2]
    edges = parameters[:, 1:] - parameters[:, :1]
    area = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]
    corners, parameters, edges = corners[area != 0.0], parameters[area != 0.0], edges[area != 0.0]
    offset = np.array([gauge.chord, gauge.span]) - parameters[:, 0]
    shares = np.linalg.solve(edges.transpose(0, 2, 1), offset[:, :, None])[:, :, 0]
    shares = np.column_stack([1.0 - shares.sum(axis=1), shares])
    best = int(np.argmax(shares.min(axis=1)))
    # a little beyond the sides of a triangle a place still counts as in it
    if shares[best].min() < -0.05:
        raise ValueError(
            f"a strain gauge at chord {gauge.chord:g} and span {gauge.span:g} is not on the {gauge.side} side of the mesh; "
            "take a place farther from the edges (signals.gauges in config.yaml)"
        )
    # an outer face belongs to one element
    element, nodes = next(
        (ELEMENTS[name], nodes)
        for name, rows in mesh.blocks.items()
        for nodes in rows[np.isin(rows, corners[best]).sum(axis=1) == len(corners[best])]
    )
    local = element.nodes[[int(np.flatnonzero(nodes == node)[0]) for node in corners[best]]]
    # the shape functions' local coordinates are linear in those of a triangle of corners, chord and span (nearly) too
    return element, nodes, shares[best, None] @ local, local[1:] - local[:1], edges[best]


def _triangles(mesh: BladeMesh, side: str) -> list[np.ndarray]:
    """Corners of the side's outer faces as triangles, shape (triangles, 3) each, without those of root and tip."""
    ends = [np.isin(np.arange(len(mesh.points)), mesh.node_set(name)) for name in ("root", "tip")]
    sign = {"pressure": -1.0, "suction": 1.0}[side]
    triangles = []
    for part in outer_faces(mesh.blocks):
        faces = part.nodes[:, : part.corners]
        a, b, c = (mesh.points[faces[:, number]] for number in range(3))
        outwards = np.sum(np.cross(b - a, c - a) * mesh.normals[faces].mean(axis=1), axis=1)
        outer = faces[(sign * outwards > 0.0) & ~np.any([end[faces].all(axis=1) for end in ends], axis=0)]
        triangles += [outer[:, split] for split in ([0, 1, 2], [0, 2, 3])[: part.corners - 2]]
    return triangles
