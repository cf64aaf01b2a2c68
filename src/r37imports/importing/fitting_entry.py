"""Suggestions from the shape of a refused mesh for its entry in blades.yaml: axes, and rules for root and tip."""

import warnings
from contextlib import suppress
from dataclasses import replace

import numpy as np

from r37core.fem.orientation import Orientation
from r37core.fem.surface import Faces, chosen, outer_faces
from r37core.rom.recovery_nodes import cylinder
from r37imports.placement import fitting_units, to_blade
from r37imports.refusal import ASKED, ImportRefused, MeshWarning

from .ends import End, caught_by, check_end, find_end, find_flanks, find_platform
from .raw_mesh import RawMesh
from .source import MeshSource
from .tip import check_sense, find_tip_lines, off_revolution

_FLAT = 0.1  # of how far a tip is from a surface of revolution: a plane catches it that much better
_SAME_AXES = 0.2  # difference of unit vectors: radial may point anywhere within the blade


def fitting_entry(source: MeshSource, raw: RawMesh) -> dict[str, str]:
    """Keys of an entry and their values as YAML that differ from those of `source` and fit the shape of its mesh.

    `raw`: the mesh in the file's unit and axes. Empty where the shape tells nothing.
    """
    orientation = source.orientation
    entry: dict[str, str] = {}
    # the side and the axes of a turbine may both be meant otherwise
    fitted = find_axes(raw, orientation) if source.sense_check and source.pressure_side_forward else None
    if fitted is not None and not _alike(fitted, orientation):
        entry = {"rotor_axis": _direction(fitted.rotor_axis), "radial": _direction(fitted.radial), "rotation": fitted.rotation}
        orientation = fitted
    unit = _fitting_unit(orientation, raw)
    if unit is None:
        return entry
    if unit != orientation.length_unit:
        entry["length_unit"] = str(unit)
    try:
        mesh = to_blade(replace(orientation, length_unit=unit), raw)
    except ImportRefused:
        return entry
    surface = outer_faces(mesh.blocks)
    for what in ("root", "tip"):
        end = find_end(what, mesh.points, surface)
        flanks = find_flanks(mesh.points, surface) if what == "root" else None
        rules = [part.rule.as_yaml() for part in (flanks, end) if part]
        if rules and not _catches(what, source, mesh, surface, end):
            entry[what] = " # or its bottom: ".join(rules)
        if not rules and getattr(source, what).sets == (ASKED,):
            entry[f"# {what}"] = "no cone catches one whole face alone; give sets of the file, or limits such as r_at_most_m"
        if what == "tip" and end:
            entry |= _tolerance_of_flat_tip(mesh.points[end.nodes], source.revolution_tolerance)
    if not source.hub_zr and (platform := find_platform(mesh.points, surface)):
        entry["hub_zr_m"] = platform.points_as_yaml()
    return entry


def _tolerance_of_flat_tip(tip: np.ndarray, tolerance: float) -> dict[str, str]:
    """Keys that let a flat tip pass: nodes `tip` (m), shape (n, 3), farther than `tolerance` (m) from a cone."""
    off = float(np.abs(off_revolution(tip)).max())
    _, _, axes = np.linalg.svd(tip - tip.mean(axis=0), full_matrices=False)
    if off <= tolerance or np.ptp(tip @ axes[-1]) > 2.0 * _FLAT * off:
        return {}
    needed = np.ceil(1e5 * 1.05 * off) / 1e5
    remark = f"# the tip is flat, up to {1e3 * off:.3g} mm off the casing's shape; better turn it to that"
    return {"revolution_tolerance_m": f"{needed:g} {remark}"}


def _fitting_unit(orientation: Orientation, raw: RawMesh) -> str | float | None:
    """The unit that is given where the blade has a plausible size with it, else the likeliest one; None without any."""
    try:
        to_blade(orientation, raw)
    except ImportRefused as error:
        if error.key == "length_unit":
            points = orientation.points_to_blade(raw.points) / orientation.metres_per_unit
            return next(iter(fitting_units(np.ptp(cylinder(points)[0]))), None)
    return orientation.length_unit


def _alike(first: Orientation, second: Orientation) -> bool:
    with suppress(ImportRefused):
        return np.allclose(first.rows, second.rows, atol=_SAME_AXES)
    return False


def _direction(vector: tuple[float, float, float]) -> str:
    return f"[{', '.join(f'{x:g}' for x in vector)}]"


def _catches(what: str, source: MeshSource, mesh: RawMesh, surface: list[Faces], end: End | None) -> bool:
    """True if the set or rule of the entry catches this end, or may well be meant otherwise."""
    with suppress(ImportRefused):
        caught = caught_by(getattr(source, what), what, mesh, surface)
        if what == "root":
            check_end(what, source.root, caught, end, mesh.points, surface)
        return what == "root" or end is None or np.array_equal(caught.mask, end.mask)
    return False


_SIZE = 0.1  # m: of the mesh while its axes are looked for, whatever its unit


def find_axes(mesh: RawMesh, like: Orientation) -> Orientation | None:
    """The orientation `like` this one, but with axes along the file's own that the shape of the mesh fits; None without any.

    The rotor axis is the one about which the ends are cones. Of its two directions and the two senses of rotation one has
    leading edge and pressure side where a compressor has them. A tip without stagger or camber tells none.
    """
    size = np.ptp(mesh.points, axis=0).max()
    surface = outer_faces(mesh.blocks)
    candidates = [(_SIZE, like)]
    for axis in np.eye(3):
        middle = (mesh.points.mean(axis=0) - like.axis_point) * (1.0 - axis)
        radial = tuple(np.where(np.arange(3) == np.argmax(np.abs(middle)), np.sign(middle), 0.0).tolist())
        tried = replace(like, length_unit=_SIZE / size, rotor_axis=tuple(axis), radial=radial, rotation="negative")
        placed = tried.points_to_blade(mesh.points)
        hub, casing = (find_end(what, placed, surface) for what in ("root", "tip"))
        if hub and casing and hub.straight and casing.straight:
            candidates.append((hub.rule.tolerance + casing.rule.tolerance, tried))
    _, best = min(candidates, key=lambda candidate: candidate[0])
    if best is like:
        return None
    x, y, z = best.rotor_axis
    axes = best.rotor_axis, (0.0 - x, 0.0 - y, 0.0 - z)
    turned = [replace(best, rotor_axis=axis, rotation=sense) for axis in axes for sense in ("positive", "negative")]
    fitting = [orientation for orientation in turned if _makes_sense(mesh, orientation)]
    return replace(fitting[0], length_unit=like.length_unit) if len(fitting) == 1 else None


def _makes_sense(mesh: RawMesh, orientation: Orientation) -> bool:
    """True if leading edge and pressure side of the tip fit the orientation, and follow from its shape."""
    placed = to_blade(orientation, mesh)
    surface = outer_faces(placed.blocks)
    casing = find_end("tip", placed.points, surface)
    with suppress(ImportRefused, MeshWarning), warnings.catch_warnings(action="error", category=MeshWarning):
        if casing:
            check_sense(placed.points, find_tip_lines(placed.points, chosen(surface, casing.mask), True), True)
            return True
    return False
