"""A mesh from another program as a blade: read, checked, turned to the blade's frame, its root and tip found."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from r37core.fem.surface import chosen, outer_faces
from r37core.mesh.blade_mesh import NODE_SETS, BladeMesh
from r37core.rom.recovery_nodes import cylinder
from r37imports.placement import to_blade, warn_of_size
from r37imports.refusal import ImportRefused, blamed, kept

from .abaqus_reader import read_abaqus
from .ansys_reader import read_ansys
from .ends import Caught, caught_by, check_end, check_root, find_end, find_platform
from .files import kind_of, mesh_files
from .fitting_entry import fitting_entry
from .mesh_checks import checked, without_free_nodes
from .meshio_reader import quietly, read_med, read_msh, read_nastran, read_with_meshio
from .raw_mesh import RawMesh
from .sector_faces import sector_pairs
from .source import MeshSource
from .tip import TipLines, check_revolution, check_sense, find_tip_lines

_READERS: dict[str, Callable[[Path], RawMesh]] = {".msh": read_msh, ".med": read_med, ".vtu": read_with_meshio}
_READERS |= {".inp": read_abaqus, ".bdf": read_nastran, ".nas": read_nastran, ".cdb": read_ansys}


def import_mesh(source: MeshSource, folder: Path | str = ".") -> tuple[BladeMesh, np.ndarray]:
    """The blade's mesh and the scaled Jacobian of each element, shape (elements,); `folder`: what `source.file` starts from.

    Raises ImportRefused, with the file's name and the reason, for a mesh that cannot be computed with.
    """
    file = mesh_files(source.file, Path(folder))[0]
    with blamed("mesh", source.file):
        raw = quietly(_READERS[kind_of(file)], file)
        raw, quality = checked(without_free_nodes(raw) if source.drop_free_nodes else raw, source.minimum_scaled_jacobian)
    size = ""
    try:
        with blamed("rotor_axis", source.file):
            placed = to_blade(source.orientation, raw)
            warn_of_size(source.orientation, placed.points)
        # what fits its shape, fits in any unit
        radius, _, _ = cylinder(placed.points)
        unit, reach = source.orientation.length_unit, f"{radius.min():.4g} to {radius.max():.4g} m"
        size = f"; with length_unit {unit} the blade reaches from {reach} from the axis"
        root, tip, lines = _ends(source, placed)
    except ImportRefused as error:
        raise ImportRefused(f"{error.reason}{size}", error.key, fitting_entry(source, raw) | _known_sets(source, raw)) from None
    height = source.height(placed.points)
    if height is not None:
        below = height[tip].min() <= 0.0
        if below or height[root].min() > 0.01 * height[tip].max():
            wrong = "a tip that is not above" if below else "a root above"
            raise ImportRefused(f"{source.file}: found {wrong} hub_zr_m; allowed: the platform's top", "hub_zr_m")
    with blamed("mesh", source.file):
        parameters, normals = blade_parameters(placed.points, root, tip, source.pressure_side_forward, height)
    sets = dict.fromkeys(NODE_SETS, np.empty(0, dtype=np.int64)) | {"root": root, "tip": tip}
    # the edges come last: nodes that they share with the camber line count by their place on the edge
    for name, (nodes, fractions) in reversed(lines.items()):
        sets[name] = nodes
        parameters[nodes, 0] = fractions
    edge = sets["tip_pressure_edge"]
    sets["leading_edge"], sets["trailing_edge"] = edge[:1], edge[-1:]
    parameters[root, 1], parameters[tip, 1] = 0.0, 1.0
    with blamed("cyclic", source.file):
        cyclic = sector_pairs(source.cyclic, placed, root) if source.cyclic else None
    return BladeMesh(placed.points, placed.blocks, parameters, normals, sets, cyclic), quality


_MOST_NAMES = 30


def _known_sets(source: MeshSource, mesh: RawMesh) -> dict[str, str]:
    """A remark with the sets of the file where the entry names one that it lacks, or asks."""
    wanted = {name.upper() for where in (source.root, source.tip) for name in where.sets + where.without}
    known = [f"{name} ({len(nodes)} nodes)" for name, nodes in sorted(mesh.sets.items()) if len(nodes)] or ["none"]
    more = [f"and {len(known) - _MOST_NAMES} more"] if len(known) > _MOST_NAMES else []
    is_known = wanted <= {name.upper() for name in mesh.sets}
    return {} if is_known else {"# sets of the file": ", ".join(known[:_MOST_NAMES] + more)}


def size_in_words(mesh: BladeMesh, source: MeshSource) -> str:
    """Length and width, radii of tip and root, and where the span begins, as text, to be compared with the real blade."""
    radius, size = cylinder(mesh.points)[0], np.ptp(mesh.points, axis=0)
    leading, trailing, root = (radius[mesh.node_set(name)] for name in ("leading_edge", "trailing_edge", "root"))
    span = "span begins at hub_zr_m, stress regions with a minimum_span lie above"
    if source.hub_zr is None:
        platform = find_platform(mesh.points, outer_faces(mesh.blocks))
        hint = f"; the root is modelled: at its platform with hub_zr_m: {platform.points_as_yaml()}" if platform else ""
        span = f"span begins at the clamped faces{hint}"
    return (
        f"{size[0]:.4g} m long and {size[2]:.4g} m wide along the axis, "
        f"radius of the tip {leading.max():.4g} m at the leading and {trailing.max():.4g} m at the trailing edge, "
        f"of the root {root.mean():.4g} m; {span}"
    )


def _ends(source: MeshSource, raw: RawMesh) -> tuple[np.ndarray, np.ndarray, TipLines]:
    """The clamped nodes, those of the tip and lines along it, of a mesh in the blade's frame.

    Raises ImportRefused for ends that cannot be meant: one message with all that is wrong, so that one change mends it.
    """
    surface = outer_faces(raw.blocks)
    rules = {"root": source.root, "tip": source.tip}
    ends = {what: find_end(what, raw.points, surface) for what in rules}
    refusals: list[ImportRefused] = []
    caught: dict[str, Caught] = {}
    for what, where in rules.items():
        with kept(refusals, what):
            caught[what] = caught_by(where, what, raw, surface)
    if len(caught) == len(rules):
        with blamed("root", source.file):
            check_root(raw.points, caught["root"].nodes, caught["tip"].nodes)
    tip = caught.get("tip")
    if source.end_check:
        for what, part in caught.items():
            with kept(refusals, what):
                check_end(what, rules[what], part, ends[what], raw.points, surface)
        # where the rule for the tip is refused, the sense is still judged by the faces that it should have caught
        casing = ends["tip"]
        tip = casing if casing and casing.straight else tip
    if tip is not None:
        with kept(refusals, "tip"):
            check_revolution(raw.points[tip.nodes], source.revolution_tolerance)
            lines = find_tip_lines(raw.points, chosen(surface, tip.mask), source.pressure_side_forward)
            if source.sense_check:
                check_sense(raw.points, lines, source.pressure_side_forward)
    # ends here where a part was not caught
    if refusals:
        reasons = dict.fromkeys(error.reason for error in refusals)
        raise ImportRefused(f"{source.file}: " + "; and ".join(reasons), refusals[0].key)
    return caught["root"].nodes, caught["tip"].nodes, lines


_SECTIONS = 25
_SHARE = 0.06  # of the span: nodes within it make a section
_FEWEST = 24  # nodes of a section


def blade_parameters(
    points: np.ndarray, root: np.ndarray, tip: np.ndarray, pressure_forward: bool, height: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """(chord, span, thickness) of every node, shape (nodes, 3), and unit normals, shape (nodes, 3).

    `points` (m), shape (nodes, 3), in the blade's frame; `root` and `tip`: node numbers. Span is the distance to the root
    over that to root and tip; of a modelled root it is 0, and `height` (m), shape (nodes,), above its platform counts instead.
    Each section (nodes of like span) has a chord, the longest principal axis of its nodes across the blade's height, pointing
    downstream, and a normal, the shortest, from the pressure to the suction side; chord and thickness are the place between
    the section's extremes along them. They serve the names of the modes and pictures; of the mechanics only the weights of
    patches, along the chord. `pressure_forward`: whether the pressure side looks towards the rotation. Raises ImportRefused
    for a mesh with too few nodes for sections.
    """
    root_distance = cKDTree(points[root]).query(points)[0] if height is None else height
    tip_distance, _ = cKDTree(points[tip]).query(points)
    # nodes of a modelled root are in no section
    span = np.where(root_distance < 0.0, -1.0, root_distance / (root_distance + tip_distance))
    levels = np.linspace(0.0, 1.0, _SECTIONS)
    members = [_members(span, level) for level in levels]
    centres = np.array([0.5 * (points[m].max(axis=0) + points[m].min(axis=0)) for m in members])
    upward, whole = np.gradient(centres, levels, axis=0), centres[-1] - centres[0]
    length = np.linalg.norm(whole)
    if not length > 1e-6 * np.ptp(points, axis=0).max():
        raise ImportRefused(
            f"found a mesh of {len(points)} nodes, too few to tell sections between root and tip; mesh the blade finer"
        )
    # a coarse mesh has the same nodes in neighbouring sections
    upward[np.linalg.norm(upward, axis=1) < 0.2 * length] = whole
    upward /= np.linalg.norm(upward, axis=1)[:, None]
    chords, normals = _section_axes(points, members, centres, upward, pressure_forward)
    extremes = []
    for m, centre, chord, normal in zip(members, centres, chords, normals, strict=True):
        along, across = (points[m] - centre) @ chord, (points[m] - centre) @ normal
        extremes.append([along.min(), np.ptp(along), across.min(), np.ptp(across)])
    columns = np.hstack([centres, chords, normals, extremes]).T
    rows = np.stack([np.interp(span, levels, column) for column in columns], axis=1)
    centre, chord, normal, sizes = np.split(rows, [3, 6, 9], axis=1)
    along_low, along_size, across_low, across_size = sizes.T
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    chord_fraction = (np.sum((points - centre) * chord, axis=1) - along_low) / along_size
    thickness = 2.0 * (np.sum((points - centre) * normal, axis=1) - across_low) / across_size - 1.0
    return np.stack([chord_fraction.clip(0.0, 1.0), span.clip(0.0), thickness.clip(-1.0, 1.0)], axis=1), normal


def _members(span: np.ndarray, level: float) -> np.ndarray:
    distance = np.abs(span - level)
    within = np.flatnonzero(distance <= _SHARE)
    return within if len(within) >= _FEWEST else np.argsort(distance, kind="stable")[:_FEWEST]


def _section_axes(
    points: np.ndarray, members: list[np.ndarray], centres: np.ndarray, height: np.ndarray, pressure_forward: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors along the chord and the normal of every section, shape (sections, 3) each; signs agree along the span."""
    chords, normals = [], []
    for m, centre, up in zip(members, centres, height, strict=True):
        flat = points[m] - points[m].mean(axis=0)
        flat -= np.outer(flat @ up, up)
        _, axes = np.linalg.eigh(flat.T @ flat)
        chord, normal = axes[:, 2], axes[:, 1]
        theta = np.array([-centre[1], centre[0], 0.0]) / np.hypot(*centre[:2])
        towards_suction = theta if pressure_forward else -theta
        # of a beam as thick as it is wide one may lie across the other's usual direction
        chords.append(np.copysign(1.0, chord[2] if abs(chord[2]) > 0.02 else chord @ towards_suction) * chord)
        normals.append(np.copysign(1.0, normal @ towards_suction) * normal)
    for series in (chords, normals):
        for i in range(1, len(series)):
            series[i] *= 1.0 if series[i] @ series[i - 1] >= 0.0 else -1.0
    return np.array(chords), np.array(normals)
