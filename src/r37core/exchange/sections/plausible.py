"""Sections that no blade has: gaps and outliers in their points, and a section out of line with those next to it."""

from collections.abc import Sequence

import numpy as np

from r37core.base.io import TextFileError
from r37core.blade.profile import BladeShapeError, area_and_centroid
from r37core.blade.section_curve import SectionCurve, turns

_GAP, _GAP_RATIO = 0.1, 3.0
"""Step between points that is a gap: this share of the section's length, and so many times both steps next to it."""
_INWARD, _SHORTEST, _LONGEST = np.radians(30.0), 1e-3, 1e-2
"""Turn inwards that no blade has, where the shorter and the longer step exceed these shares: rounding bends smaller ones."""
_OFF = 0.01
"""Share of the section's length by which no point of a blade lies off the radius of those next to it."""
_PLACE, _STAGGER, _LENGTH, _CURVATURES = 0.05, 5.0, 0.1, 3.0
"""Deviations of a section, well above those of bent ends: shares of its length, degrees; and of curvatures of the others."""
_FEWEST = 5
"""Sections from which on the others tell that one is out of line."""
_REMEDY = "correct it, or sense_check: false takes the blade as it is"


def check_points(curve: SectionCurve) -> None:
    """Raise BladeShapeError for a section with a gap in its points or a point that lies off the others."""
    plane, radius, length = curve.outline, curve.points[:, 0], curve.pressure.length
    after = np.linalg.norm(np.roll(plane, -1, axis=0) - plane, axis=1) / length
    before = np.roll(after, 1)
    inward = -np.sign(area_and_centroid(*plane.T)[0]) * turns(plane)
    inward[(np.minimum(before, after) < _SHORTEST) | (np.maximum(before, after) < _LONGEST)] = 0.0
    gaps = np.where(after > _GAP_RATIO * np.maximum(before, np.roll(after, -1)), after, 0.0)
    off = np.abs(radius - 0.5 * (np.roll(radius, 1) + np.roll(radius, -1))) / length
    for sizes, limit, scale, text in (
        (gaps, _GAP, 1e3 * length, "a gap of {:.3g} mm after point {}"),
        (inward, _INWARD, np.degrees(1.0), "an inward corner of {:.3g} degrees at point {}"),
        (off, _OFF, 1e3 * length, "a radius {:.3g} mm off that of both neighbours at point {}"),
    ):
        if sizes.max() > limit:
            found = text.format(scale * sizes.max(), np.argmax(sizes) + 1)
            raise BladeShapeError(f"{curve.label}: found {found} of {len(plane)}; {_REMEDY}")


def check_succession(curves: Sequence[SectionCurve], lines: Sequence[int]) -> None:
    """Raise TextFileError, at its line of `lines`, for the section that lies farthest out of line with the others."""
    length = 1e3 * float(np.median([curve.pressure.length for curve in curves]))
    radii = np.array([curve.radius for curve in curves])
    for what, unit, limit, value in (
        ("axial place", "mm", _PLACE * length, lambda curve: 1e3 * curve.z),
        ("place round the axis", "mm", _PLACE * length, lambda curve: 1e3 * curve.radius * curve.centroid[1]),
        ("stagger", "degrees", _STAGGER, lambda curve: np.degrees(curve.stagger)),
        ("length", "mm", _LENGTH * length, lambda curve: 1e3 * curve.pressure.length),
    ):
        deviations, explained = _deviations(radii, np.array([value(curve) for curve in curves]))
        number = int(np.argmax(np.abs(deviations) - explained))
        if abs(deviations[number]) > limit + explained[number]:
            found = f"found its {what} {deviations[number]:+.3g} {unit} off the line through the sections next to it"
            raise TextFileError(lines[number], f"{curves[number].label}: {found} (allowed: {limit:.3g}); {_REMEDY}")


def _deviations(radii: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Deviation of each value from the line through its neighbours, and the part that the curvature of the others explains."""
    count = len(radii)
    found = np.zeros((2, count))
    for number in range(count if count >= _FEWEST else 0):
        low, high = (other for other in np.clip(number - 1, 0, count - 3) + np.arange(3) if other != number)
        slope = (values[high] - values[low]) / (radii[high] - radii[low])
        x, y = np.delete(radii, number), np.delete(values, number)
        curvature = np.abs(np.diff(np.diff(y) / np.diff(x)) / (x[2:] - x[:-2])).max()
        found[0, number] = values[number] - values[low] - slope * (radii[number] - radii[low])
        found[1, number] = _CURVATURES * curvature * abs((radii[number] - radii[low]) * (radii[number] - radii[high]))
    return found[0], found[1]
