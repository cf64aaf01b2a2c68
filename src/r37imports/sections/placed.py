"""Sections of a file in the blade's frame, checked, and what fits where an entry asks for it."""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from r37core.base.io import TextFileError
from r37core.base.units import LENGTH_UNITS
from r37core.blade.profile import BladeShapeError
from r37core.blade.sense import sense_of_line
from r37core.fem.orientation import Orientation
from r37core.rom.recovery_nodes import cylinder
from r37imports.placement import check_place, fitting_units, refuse_sense
from r37imports.refusal import ASKED, UNLESS, ImportRefused
from r37imports.sections.definition import SectionsDefinition
from r37imports.sections.section_curve import SectionCurve

from .plausible import check_points, check_succession
from .section_file import FileSection, SectionFile

OWN = "sections"
"""Value of hub and tip that ends the blade with its first or last section, whatever lies next to the file."""

_REVOLUTION = 1e-4
"""Distance (m) up to which the last section lies on a surface of revolution, as the tip of a mesh."""
_MERIDIAN = 4
"""Order of the polynomial through the meridian of a section."""
_SHARES = np.linspace(0.0, 1.0, 201)
_REVOLVED, _ROUNDED, _NEARER = 1e-3, 1e-4, 20.0
"""Shares of their length by which sections lie off surfaces of revolution about their axis; times that about another one."""

Meridians = tuple[tuple[float, float], ...] | None
Placed = tuple[tuple[tuple[float, float, float], ...], ...]


def placed_sections(file: SectionFile, orientation: Orientation) -> tuple[Placed, tuple[int, ...]]:
    """Sections from hub to tip, in metres and in the blade's frame, and their lines in the file.

    Raises ImportRefused for a blade of no plausible size or place.
    """
    points = [orientation.points_to_blade(section.points) for section in file.sections]
    check_place(orientation, np.concatenate(points))
    order = _outwards(points)
    sections = tuple(tuple(map(tuple, points[number].tolist())) for number in order)
    return sections, tuple(file.sections[number].line for number in order)


def placed_meridian(points: np.ndarray, orientation: Orientation) -> Meridians:
    """Meridian (z, r), m, of points in the file's unit and axes, shape (n, 3)."""
    radius, _, z = cylinder(orientation.points_to_blade(points))
    return tuple(zip(z.tolist(), radius.tolist(), strict=True))


def meridian_along(points: Meridians, curves: Sequence[SectionCurve]) -> Meridians:
    """The part of a meridian next to sections: ducts up- and downstream may run back."""
    if points is None or len(points) < 3:
        return points
    z = np.concatenate([curve.points[:, 2] for curve in curves])
    reach = 0.25 * np.ptp(z)
    places = np.array([place for place, _ in points])
    inside = (places >= z.min() - reach) & (places <= z.max() + reach)
    # pieces that end or pass next to the sections, too
    passing = inside[1:] | inside[:-1] | (np.diff(np.sign(places - z.mean())) != 0.0)
    near = np.flatnonzero(passing)
    kept = points[near[0] : near[-1] + 2] if len(near) else points
    return tuple(point for number, point in enumerate(kept) if number == 0 or point[0] != kept[number - 1][0])


def check_curves(definition: SectionsDefinition, lines: Sequence[int], plausible: bool) -> None:
    """Refuse sections that are none, with TextFileError at their lines, or that do not follow each other, BladeShapeError.

    `plausible`: refuse those that no blade has, too.
    """
    for number, line in enumerate(lines):
        try:
            curve = definition.curve(number)
            if plausible:
                check_points(curve)
        except BladeShapeError as error:
            raise TextFileError(line, str(error)) from None
    definition.places()
    if plausible:
        check_succession(definition.curves, lines)


def check_axis(sections: Sequence[FileSection], orientation: Orientation) -> None:
    """Refuse a rotor axis where the sections lie on surfaces of revolution about another axis of the file; ImportRefused."""
    points = [section.points - np.array(orientation.axis_point) for section in sections]
    axes = np.array([orientation.rows[2], *np.eye(3)])
    own, *others = (np.median([_off_revolution(places, axis) for places in points]) for axis in axes)
    if min(others) < _REVOLVED and own > _NEARER * max(min(others), _ROUNDED):
        fitting = axes[1 + np.argmin(others)]
        raise ImportRefused(
            f"found {list(orientation.rotor_axis)}; the sections lie on surfaces of revolution about {fitting.tolist()} "
            f"or {(0.0 - fitting).tolist()}, whichever points downstream; {UNLESS}",
            "rotor_axis",
        )


def check_ends(definition: SectionsDefinition, orientation: Orientation, entered: Iterable[str]) -> None:
    """Refuse hub and tip outside the sections, and a last section that ends the blade on no surface of revolution.

    Raises BladeShapeError with a tip that fits; ImportRefused where the `entered` ones of hub and tip fit a reversed axis.
    """
    try:
        definition.places()
    except BladeShapeError as error:
        turned: Any = {end: tuple((-z, radius) for z, radius in getattr(definition, end)) for end in entered}
        with suppress(BladeShapeError):
            replace(definition, **turned).places()
            fitting = [0.0 - part for part in orientation.rotor_axis]
            raise ImportRefused(f"{error}, or rotor_axis: {fitting}, with which it fits", "rotor_axis") from None
        raise
    # both sides of a surface of revolution share a meridian, which may be curved
    if definition.tip is None and (off := _off_meridian(*_meridian_of(definition.curves[-1]))) > _REVOLUTION:
        raise BladeShapeError(
            f"tip: the last section lies up to {1e3 * off:.3g} mm off every surface of revolution (allowed: "
            f"{1e3 * _REVOLUTION:g} mm); the casing cuts the blade with tip: {fitting_surface(definition.curves[-1])}"
        )


def check_sections_sense(definition: SectionsDefinition) -> None:
    """Refuse a rotation, rotor axis or pressure side that the last section contradicts, with ImportRefused."""
    line = definition.curves[-1].camber_line(_SHARES)
    refuse_sense(line[[0, -1]], sense_of_line(line), definition.pressure_forward)


def fitting_unit(file: SectionFile, orientation: Orientation, stated: str) -> tuple[str, str]:
    """The `stated` or the likeliest unit, and the line that answers so; ImportRefused where none fits.

    `orientation` has the unit of a metre.
    """
    points = np.concatenate([section.points for section in file.sections])
    radius, _, _ = cylinder(orientation.points_to_blade(points))
    # no program writes these
    units = sorted(fitting_units(np.ptp(radius)), key=lambda unit: (unit != stated, unit in ("ft", "um")))
    if not units:
        reason = f"found '{ASKED}', and no unit that fits sections from {radius.min():.5g} to {radius.max():.5g} from the axis"
        raise ImportRefused(f"{reason}; give metres per unit", "length_unit")
    sizes = [f"{unit} ({radius.min() * LENGTH_UNITS[unit]:.4g} to {radius.max() * LENGTH_UNITS[unit]:.4g} m)" for unit in units]
    return units[0], f"length_unit: {units[0]}; by the radii of the sections these are possible: {', '.join(sizes)}"


def fitting_rotation(sections: Sequence[FileSection], orientation: Orientation) -> tuple[str, str]:
    """Rotation with the leading edge of the last section ahead, and its line; that of `orientation` is positive."""
    points = [orientation.points_to_blade(section.points) for section in sections]
    tip = points[_outwards(points)[-1]]
    sense = sense_of_line(SectionCurve(tip, "the last section").camber_line(_SHARES))
    if (leads := sense.leads()) is None:
        reason = f"the tip's stagger of {np.degrees(sense.stagger):.1f} degrees tells no rotation"
        return "positive", f"{reason}; give positive or negative"
    fitting = "positive" if leads else "negative"
    return fitting, f"rotation: {fitting}, with the leading edge ahead"


def fitting_end(own: np.ndarray | str | None, curve: SectionCurve) -> str:
    """Line that answers for hub or tip: the file's own meridian, of this name, or what its first or last section needs."""
    if own is not None:
        return f"leave out, for {own if isinstance(own, str) else 'that of the file'}"
    return (
        f"{fitting_surface(curve)} or {OWN}, where the passage ends with this section, at r {curve.radius:.5g} m; sections "
        "that reach beyond it, as those of CAD do, need its own radius_m, cone_zr_m or meridian"
    )


def fitting_surface(curve: SectionCurve) -> str:
    """The cone next to a section as an entry has it."""
    radius, z = _meridian_of(curve)
    line = np.polynomial.Polynomial.fit(z, radius, 1)
    ends = ", ".join(f"[{place:.7f}, {line(place):.7f}]" for place in (z.min(), z.max()))
    return f"{{ cone_zr_m: [{ends}] }}"


def _off_revolution(points: np.ndarray, axis: np.ndarray) -> float:
    """Distance of points, shape (n, 3), from a surface of revolution about an axis, as a share of their extent."""
    z = points @ axis
    return _off_meridian(np.linalg.norm(points - np.outer(z, axis), axis=1), z) / float(np.ptp(points, axis=0).max())


def _off_meridian(radius: np.ndarray, z: np.ndarray) -> float:
    """Largest distance of points (r, z) from one smooth meridian."""
    # the full answer comes without a warning of points that give no meridian
    meridian, _ = np.polynomial.Polynomial.fit(z, radius, _MERIDIAN, full=True)
    return float(np.abs(radius - meridian(z)).max())


def _meridian_of(curve: SectionCurve) -> tuple[np.ndarray, np.ndarray]:
    """Radii and axial places (m) of points of both sides."""
    radius, _, z = np.concatenate([side.point(_SHARES) for side in (curve.pressure, curve.suction)], axis=1)
    return radius, z


def _outwards(points: Sequence[np.ndarray]) -> list[int]:
    """Numbers of the sections as the file has them, backwards where they run from the tip to the hub."""
    radii = [cylinder(part)[0].mean() for part in points]
    return list(range(len(points)))[:: -1 if radii[0] > radii[-1] else 1]
