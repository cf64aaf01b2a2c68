"""Sections that no blade has: gaps and outliers in their points, and a section out of line with those next to it."""

from collections.abc import Sequence

import numpy as np

from r37core.base.io import TextFileError
from r37core.blade.profile import BladeShapeError, area_and_centroid
from r37imports.refusal import UNLESS
from r37imports.sections.section_curve import SectionCurve, turns

_GAP, _GAP_RATIO = 0.1, 3.0
"""Step between points that is a gap: this share of the section's length, and so many times both steps next to it."""
_INWARD, _SHORTEST, _LONGEST = np.radians(30.0), 1e-3, 1e-2
"""Turn inwards that no blade has, where the shorter and the longer step exceed these shares: rounding bends smaller ones."""
_OFF = 0.01
"""Share of the section's length by which no point of a blade lies off the radius of those next to it."""
_PLACE, _STAGGER, _LENGTH, _CURVATURES = 0.05, 5.0, 0.1, 3.0
"""Deviations of a section, well above those of bent ends: shares of its length, degrees; and of curvatures of the others."""


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
            size = text.format(scale * sizes.max(), np.argmax(sizes) + 1)
            raise BladeShapeError(f"{curve.label}: found {size} of {len(plane)}; correct it; {UNLESS}")


def check_succession(curves: Sequence[SectionCurve], lines: Sequence[int]) -> None:
    """Raise TextFileError, at its line of `lines`, for the section that lies farthest out of line with the others."""
    places = np.array([(curve.radius, curve.z, curve.radius * curve.centroid[1], curve.pressure.length) for curve in curves]).T
    radii, axial, around, lengths = 1e3 * places
    length = float(np.median(lengths))
    for what, unit, limit, values in (
        ("axial place", "mm", _PLACE * length, axial),
        ("place round the axis", "mm", _PLACE * length, around),
        ("stagger", "degrees", _STAGGER, np.degrees([curve.stagger for curve in curves])),
        ("length", "mm", _LENGTH * length, lengths),
    ):
        deviations, explained = _deviations(radii, values)
        number = int(np.argmax(np.abs(deviations) - explained))
        if abs(deviations[number]) > limit + explained[number]:
            reason = f"found its {what} {deviations[number]:+.3g} {unit} off the line through the sections next to it"
            raise TextFileError(lines[number], f"{curves[number].label}: {reason} (allowed: {limit:.3g}); correct it; {UNLESS}")


def _deviations(radii: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Deviation of each value from the line through its neighbours, and the part that the curvature of the others explains."""
    count = len(radii)
    deviations, explained = np.zeros((2, count))
    # of fewer than five sections the others do not tell which one is out of line
    for number in range(count if count >= 5 else 0):
        low, high = (other for other in np.clip(number - 1, 0, count - 3) + np.arange(3) if other != number)
        slope = (values[high] - values[low]) / (radii[high] - radii[low])
        x, y = np.delete(radii, number), np.delete(values, number)
        curvature = np.abs(np.diff(np.diff(y) / np.diff(x)) / (x[2:] - x[:-2])).max()
        deviations[number] = values[number] - values[low] - slope * (radii[number] - radii[low])
        explained[number] = _CURVATURES * curvature * abs((radii[number] - radii[low]) * (radii[number] - radii[high]))
    return deviations, explained
