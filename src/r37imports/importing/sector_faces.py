"""The two faces of a sector of a disc, which become each other by a turn of one sector: pairs of their nodes."""

import numpy as np
from scipy.spatial import cKDTree

from r37core.fem.surface import nodes_of, outer_faces
from r37imports.refusal import ASKED, ImportRefused

from .raw_mesh import RawMesh
from .source import CyclicFaces, Where

_SAME = 1e-5
"""Distance, as a share of the mesh's size, up to which two nodes are in one place; files have 6 digits or more."""

_REMEDY = "mesh the two faces alike (gmsh: setPeriodic; others: a cyclic or copied mesh)"


def sector_pairs(cyclic: CyclicFaces, mesh: RawMesh, root: np.ndarray) -> np.ndarray:
    """Nodes of the low face and those of the high face which they become, shape (pairs, 2), of a mesh in the blade's frame.

    `root`: clamped nodes. Low is the face behind in the sense of theta, whichever the names are. Raises ImportRefused.
    """
    surface = nodes_of(outer_faces(mesh.blocks))
    asked = ASKED in (cyclic.low, cyclic.high)
    first, second = (surface, surface) if asked else (_members(cyclic, key, mesh) for key in ("low", "high"))
    both = np.intersect1d(first, second)
    if not asked and len(both):
        raise ImportRefused(f"cyclic: {len(both)} nodes are in both faces; allowed: faces without a common node", "cyclic")
    points, size = mesh.points, np.ptp(mesh.points, axis=0).max()
    turned = points @ _turn(2.0 * np.pi / cyclic.sectors).T
    forth, back = (cKDTree(points[there]).query(turned[here]) for here, there in ((first, second), (second, first)))
    if asked:
        matched = forth[0] <= _SAME * size
        if matched.sum() < 3:
            raise ImportRefused(
                f"cyclic: turned by {360.0 / cyclic.sectors:g} degrees no face of the mesh lies on another (nearest "
                f"{1e3 * forth[0].min():.3g} mm; allowed: {1e3 * _SAME * size:.2g} mm); check sectors, or {_REMEDY}",
                "cyclic",
            )
        pairs = np.stack([first[matched], second[forth[1][matched]]], axis=1)
    else:
        flipped = back[0].max() < forth[0].max()
        low, high, (distance, nearest) = (second, first, back) if flipped else (first, second, forth)
        if len(low) != len(high) or distance.max() > _SAME * size:
            raise ImportRefused(
                f"cyclic: the faces '{cyclic.low}' ({len(first)} nodes) and '{cyclic.high}' ({len(second)} nodes), turned by "
                f"{360.0 / cyclic.sectors:g} degrees, do not match (largest distance {1e3 * distance.max():.3g} mm; "
                f"allowed: {1e3 * _SAME * size:.2g} mm); check sectors, or {_REMEDY}",
                "cyclic",
            )
        pairs = np.stack([low, high[nearest]], axis=1)
    clamped = np.isin(pairs, root)
    if (clamped[:, 0] != clamped[:, 1]).any() or clamped.all():
        raise ImportRefused(
            f"cyclic: of {len(pairs)} pairs of nodes {np.sum(clamped[:, 0] != clamped[:, 1])} have one clamped node and "
            f"{clamped.all(axis=1).sum()} have two; allowed: a root that ends alike at both faces, such as the bore",
            "root",
        )
    return pairs


def _members(cyclic: CyclicFaces, key: str, mesh: RawMesh) -> np.ndarray:
    return np.flatnonzero(Where((getattr(cyclic, key),)).nodes(f"cyclic: {key}", mesh))


def _turn(angle: float) -> np.ndarray:
    return np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
