"""The two faces of a sector of a disc, which become each other by a turn of one sector: pairs of their nodes."""

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

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
    points, names = mesh.points, {"low": cyclic.low, "high": cyclic.high}
    if asked := ASKED in names.values():
        first = second = nodes_of(outer_faces(mesh.blocks))
    else:
        first, second = (np.flatnonzero(Where((names[key],)).nodes(f"cyclic: {key}", mesh)) for key in names)
        if both := len(np.intersect1d(first, second)):
            raise ImportRefused(f"cyclic: {both} nodes are in both faces; allowed: faces without a common node")
    angle, allowed = 360.0 / cyclic.sectors, _SAME * np.ptp(points, axis=0).max()
    turned = Rotation.from_euler("z", angle, degrees=True).apply(points)
    forth, back = (cKDTree(points[there]).query(turned[here]) for here, there in ((first, second), (second, first)))
    flipped = back[0].max() < forth[0].max()
    low, high, (distance, nearest) = (second, first, back) if flipped else (first, second, forth)
    matched = distance <= allowed
    if asked:
        agrees, off = matched.sum() >= 3, f"no face of the mesh lies on another (nearest {1e3 * distance.min():.3g}"
    else:
        agrees = matched.all() and len(low) == len(high)
        faces = f"'{cyclic.low}' ({len(first)} nodes) and '{cyclic.high}' ({len(second)} nodes)"
        off = f"the faces {faces} do not match (largest distance {1e3 * distance.max():.3g}"
    if not agrees:
        raise ImportRefused(
            f"cyclic: turned by {angle:g} degrees {off} mm; allowed: {1e3 * allowed:.2g} mm); check sectors, or {_REMEDY}"
        )
    pairs = np.stack([low[matched], high[nearest[matched]]], axis=1)
    clamped = np.isin(pairs, root)
    if (single := np.sum(clamped[:, 0] != clamped[:, 1])) or clamped.all():
        raise ImportRefused(
            f"cyclic: of {len(pairs)} pairs of nodes {single} have one clamped node and "
            f"{clamped.all(axis=1).sum()} have two; allowed: a root that ends alike at both faces, such as the bore",
            "root",
        )
    return pairs
