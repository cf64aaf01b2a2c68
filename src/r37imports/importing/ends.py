"""The ends of an imported blade, towards hub and casing: what its shape tells of them, and whether a rule catches them."""

from dataclasses import dataclass

import numpy as np

from r37core.fem.surface import Faces, area_vectors, chosen, mask_within, nodes_of, smooth_patches
from r37core.rom.recovery_nodes import cylinder
from r37imports.refusal import ImportRefused

from .raw_mesh import RawMesh
from .source import Where

_CREASE = np.radians(40.0)
_BEND = np.radians(15.0)  # within a face that a set names; beyond is a chamfer
_RADIAL = 0.5  # of a unit normal: faces that look along the radius, out or in
_STRAIGHT = 2e-3  # of the blade's height: how far the nodes of an end may be from a cone
_LARGE = 0.1  # of the largest patch's area: smaller ones are no end
_BELOW = 0.2  # of the blade's height: how far a platform is below the tip, a conical tip's edge is not
_ROUNDED = 7  # decimals of the rule's numbers (m)
_TOLERANCES = (1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, np.inf)  # m
_LOOKS = {"root": "towards the axis", "tip": "towards the casing"}
_PLANAR = np.radians(0.5)  # between the normals of faces of one plane
_SLANTED = 0.25  # of a unit normal, outward and to a side: the faces of a root that a disc holds
_UNEVEN = 0.1  # of what flanks look to a side, summed: to one side more than to the other


@dataclass(frozen=True)
class Caught:
    """A part of the blade's surface: its `nodes` (of a set as the root, all), and its faces as a `mask` over all outer ones."""

    nodes: np.ndarray
    mask: np.ndarray


@dataclass(frozen=True)
class End(Caught):
    """An end of the blade, the `rule` of a cone or planes that catches it, and whether it lies on them, `straight`.

    One that does not may be curved, flat as the bottom of a foot, or run into a fillet.
    """

    rule: Where
    straight: bool


def find_end(what: str, points: np.ndarray, surface: list[Faces]) -> End | None:
    """The end `what` (root or tip) of a mesh with nodes at `points` (m), shape (nodes, 3), and these outer faces.

    It is the smooth patch of faces that look along the radius, the outermost or innermost large one. None where no cone
    catches all of it and nothing else.
    """
    patch, areas, heights, radius = _radial_patches(what, points, surface)
    if not areas.any():
        return None
    # the top of a platform may be many times larger than the tip
    near = (heights >= radius.max() - _BELOW * np.ptp(radius)) | (what == "root")
    large = areas >= _LARGE * areas[near if near.any() else slice(None)].max()
    mask = patch == np.argmax(np.where(large, heights if what == "tip" else -heights, -np.inf))
    nodes = nodes_of(chosen(surface, mask))
    rule = _cone(points[nodes])
    straight = rule.tolerance <= max(_STRAIGHT * np.ptp(radius), _TOLERANCES[0])
    is_exact = np.array_equal(mask_within(surface, rule.within(points)), mask)
    return End(nodes, mask, rule, straight) if is_exact else None


def find_flanks(points: np.ndarray, surface: list[Faces]) -> End | None:
    """Flanks by which a disc holds the root: planes that look outward and to both sides alike, the root behind them.

    `points` (m), shape (nodes, 3). None where there are none, or where no rule catches all of them and nothing else.
    """
    vectors, looks, radius = _face_looks(points, surface)
    sizes, distance = np.linalg.norm(vectors, axis=1), cylinder(points)[0]
    slanted = (np.minimum(looks[:, 0], np.abs(looks[:, 1])) >= _SLANTED) & (radius < 0.5 * (radius.min() + radius.max()))
    patch = np.where(slanted, smooth_patches(surface, vectors, _PLANAR), -1)
    areas = np.bincount(patch + 1, sizes)[1:]
    mask, planes = np.zeros(len(patch), dtype=bool), []
    for number in np.flatnonzero(areas >= _LARGE * areas.max(initial=1e-300)):
        own = patch == number
        nodes, normal = nodes_of(chosen(surface, own)), vectors[own].sum(axis=0)
        heights = points @ (normal := normal / np.linalg.norm(normal))
        height = heights[nodes].mean()
        # a fillet has the platform below and before it
        if heights[distance < distance[nodes].min()].max(initial=-np.inf) < height + _TOLERANCES[0]:
            mask |= own
            planes.append(height * normal)
    aside, feet = (sizes * looks[:, 1])[mask], tuple(map(tuple, (np.round(planes, _ROUNDED) + 0.0).tolist()))
    is_even = abs(aside.sum()) <= _UNEVEN * np.abs(aside).sum()
    for rule in (Where(planes=feet, tolerance=tolerance) for tolerance in _TOLERANCES[:-1]):
        if is_even and np.array_equal(mask_within(surface, rule.within(points)), mask):
            return End(nodes_of(chosen(surface, mask)), mask, rule, True)
    return None


def find_platform(points: np.ndarray, surface: list[Faces]) -> Where | None:
    """The cone of a modelled root's top, the outermost large patch that looks outward far below the tip; None without one."""
    patch, areas, heights, radius = _radial_patches("tip", points, surface)
    below = (areas >= _LARGE * areas.max(initial=1e-300)) & (heights < radius.max() - _BELOW * np.ptp(radius))
    if not below.any():
        return None
    return _cone(points[nodes_of(chosen(surface, patch == np.argmax(heights * below)))])


def _radial_patches(what: str, points: np.ndarray, surface: list[Faces]) -> tuple[np.ndarray, ...]:
    """Smooth patch of each outer face that looks as the end `what` does, else -1.

    Areas (m2) and mean radii (m) of the patches, 0 where none of their faces does; radii (m) of the faces.
    """
    vectors, looks, radius = _face_looks(points, surface)
    # a fillet is smooth all the way to the blade's sides
    looking = looks[:, 0] * (1.0 if what == "tip" else -1.0) >= _RADIAL
    patch, sizes = np.where(looking, smooth_patches(surface, vectors, _CREASE), -1), np.linalg.norm(vectors, axis=1)
    areas, moments = (np.bincount(patch + 1, weights)[1:] for weights in (sizes, sizes * radius))
    return patch, areas, moments / np.maximum(areas, 1e-300), radius


def _face_looks(points: np.ndarray, surface: list[Faces]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Outward normals of the faces times their areas (m2), their unit normals' parts outward and round the axis, radii (m)."""
    vectors = area_vectors(surface, points)
    centres = np.concatenate([points[part.nodes[:, : part.corners]].mean(axis=1) for part in surface])
    (x, y), (along_x, along_y) = centres[:, :2].T, vectors[:, :2].T
    radius = np.hypot(x, y)
    looks = np.stack([along_x * x + along_y * y, along_y * x - along_x * y], axis=1)
    return vectors, looks / np.maximum(radius * np.linalg.norm(vectors, axis=1), 1e-300)[:, None], radius


def caught_by(where: Where, what: str, mesh: RawMesh, surface: list[Faces]) -> Caught:
    """The outer faces whose nodes are all in a set, or keep a rule, for the end `what`; a set as the root has all its nodes.

    Raises ImportRefused where there are none.
    """
    members = where.nodes(what, mesh)
    mask = mask_within(surface, members)
    if what == "root" and where.sets and members.any():
        return Caught(np.flatnonzero(members), mask)
    if not mask.any():
        remark = f", which has {members.sum()} nodes" if where.sets else ""
        raise ImportRefused(
            f"{what}: no outer face has all its nodes within {where.describe()}{remark}; give another set or rule, or a wider "
            f"tolerance_m"
        )
    return Caught(nodes_of(chosen(surface, mask)), mask)


def check_end(what: str, where: Where, caught: Caught, end: End | None, points: np.ndarray, surface: list[Faces]) -> None:
    """Refuse faces, `caught` by `where`, that are not all of the `end` and nothing else.

    Without an end that lies on a cone they may be any, but a rule does not cut a smooth patch of the `surface`, of nodes at
    `points`. A set as the root may clamp any patches, each of them as a whole.
    """
    looks = _LOOKS[what]
    if what == "root" and where.planes:
        end, looks = find_flanks(points, surface), "outward, as flanks"
    straight = end is not None and end.straight
    if where.sets and what == "tip" and not straight:
        return
    if end is not None and straight and not (where.sets and what == "root"):
        expected, beside = end.mask, (caught.mask & ~end.mask).sum()
    else:
        patch, *_ = _radial_patches(what, points, surface)
        if where.sets:
            # flanks, of which a disc holds the root, are planes
            vectors = area_vectors(surface, points)
            faces, planes = smooth_patches(surface, vectors, _BEND), smooth_patches(surface, vectors, _PLANAR)
            patch, looks = np.where(patch >= 0, faces, faces.max() + 1 + planes), "as its own do"
        expected, beside = np.isin(patch, patch[caught.mask & (patch >= 0)]), 0
    whole, within = expected.sum(), (caught.mask & expected).sum()
    if within == whole and not beside:
        return
    also = f"; it also caught {beside} side faces: narrow it" if beside else ": widen it"
    raise ImportRefused(
        f"{what}: {where.describe()} caught {within} of the {whole} faces that look {looks}{also}, or take what "
        "was caught with end_check: false"
    )


def check_root(points: np.ndarray, root: np.ndarray, tip: np.ndarray) -> None:
    """Refuse clamped nodes `root` that do not hold the blade, are the tip's or lie farther out than the nodes of the `tip`."""
    offsets = points[root] - points[root].mean(axis=0)
    if np.linalg.matrix_rank(offsets, tol=1e-6 * np.ptp(points, axis=0).max()) < 2:
        raise ImportRefused(f"root: found {len(root)} nodes on one line, which do not hold the blade; give the nodes of a face")
    inner, outer = (cylinder(points[nodes])[0].mean() for nodes in (root, tip))
    if inner >= outer:
        raise ImportRefused(
            f"root: found clamped nodes at a radius of {inner:.4g} m and a tip at {outer:.4g} m; allowed: a root nearer to the "
            "rotor axis; exchange root and tip, or check rotor_axis and axis_point"
        )
    if both := len(np.intersect1d(root, tip)):
        raise ImportRefused(f"root: {both} of its {len(root)} nodes are the tip's too; allowed: root and tip apart")


def _cone(points: np.ndarray) -> Where:
    """The rule of the cone about z through nodes at `points`, shape (n, 3): radius as a straight line of z, least squares."""
    radius, _, z = cylinder(points)
    flat = np.ptp(z) < 1e-6 * np.ptp(points, axis=0).max()
    line = np.polynomial.Polynomial.fit(z, radius, 0 if flat else 1)
    first, last = z.min(), z.max() if not flat else z.min() + 1.0
    start, end = ((round(float(position), _ROUNDED), round(float(line(position)), _ROUNDED)) for position in (first, last))
    off = np.abs(Where(cone_zr=(start, end), tolerance=0.0).off_cone(points)).max()
    # twice what is needed, and a round number
    tolerance = next(step for step in _TOLERANCES if step >= 2.0 * off)
    return Where(cone_zr=(start, end), tolerance=tolerance)
