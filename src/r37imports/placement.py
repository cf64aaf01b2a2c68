"""Place of a mesh of another program in the blade's frame, and whether that is plausible."""

from dataclasses import replace

import numpy as np

from r37core.base.units import LENGTH_UNITS
from r37core.blade.sense import TipSense
from r37core.fem.orientation import Orientation
from r37core.rom.recovery_nodes import cylinder

from .importing.raw_mesh import RawMesh
from .refusal import UNLESS, ImportRefused, warn_of

_SPAN_BETWEEN = (1e-3, 5.0)
_USUAL_SPAN = 0.1
_TIP_RADIUS_BETWEEN = (5e-3, 10.0)
_USUAL_TIP_RADIUS = (0.01, 3.0)
"""Radii of a tip (m), from the smallest turbochargers to the last stages of steam turbines."""
_RADIAL_WITHIN = np.cos(np.radians(45.0))


def fitting_units(span: float) -> list[str]:
    """Units in which a blade of this span, in its file's numbers, has a plausible size; the likeliest first."""
    sizes = {name: span * metres for name, metres in LENGTH_UNITS.items()}
    plausible = [name for name, size in sizes.items() if _SPAN_BETWEEN[0] < size < _SPAN_BETWEEN[1]]
    return sorted(plausible, key=lambda name: abs(np.log(sizes[name] / _USUAL_SPAN)))


def to_blade(orientation: Orientation, mesh: RawMesh) -> RawMesh:
    """The mesh in metres and the blade's frame. Raises ImportRefused for a blade of no plausible size or place."""
    points = orientation.points_to_blade(mesh.points)
    check_place(orientation, points)
    return replace(mesh, points=points, blocks=orientation.mirrored(mesh.blocks))


def contact_nodes_to_blade(orientation: Orientation, points: np.ndarray) -> np.ndarray:
    """Contact nodes at the tip, shape (n, 3), in metres and the blade's frame. Raises ImportRefused as `to_blade`."""
    placed = orientation.points_to_blade(points)
    radius, _, _ = cylinder(placed)
    low, high = _TIP_RADIUS_BETWEEN
    if not low <= radius.min() <= radius.max() <= high:
        raise ImportRefused(
            f"the contact nodes would lie {radius.min():.3g} to {radius.max():.3g} m from the rotor axis (allowed: {low:g} "
            f"to {high:g} m); length_unit {orientation.length_unit}, rotor_axis or axis_point does not fit the file",
            "length_unit",
        )
    _check_side(orientation, placed, "the contact nodes' middle")
    warn_of_size(orientation, placed)
    return placed


def warn_of_size(orientation: Orientation, points: np.ndarray) -> None:
    """Warn of `points` (m) of the blade's frame, shape (n, 3), that reach as far from the axis as hardly any blade does."""
    tip, (low, high) = cylinder(points)[0].max(), _USUAL_TIP_RADIUS
    if not low <= tip <= high:
        warn_of(
            f"length_unit {orientation.length_unit} gives a tip radius of {tip:.3g} m; those of blades are {low:g} to {high:g} "
            "m: check length_unit, rotor_axis and axis_point"
        )


def check_place(orientation: Orientation, points: np.ndarray) -> None:
    """Raise ImportRefused where a blade at `points` (m), shape (n, 3), in its frame has no plausible size or place."""
    radius, _, _ = cylinder(points)
    span = np.ptp(radius)
    sizes = " x ".join(f"{size:.3g}" for size in np.ptp(points, axis=0))
    low, high = _SPAN_BETWEEN
    if not low < span < high:
        own = span / orientation.metres_per_unit
        fitting = [f"{name} ({own * LENGTH_UNITS[name]:.3g} m)" for name in fitting_units(own)]
        raise ImportRefused(
            f"the blade would be {sizes} m in size (radial, tangential, axial) with a span of {span:.3g} m (allowed: "
            f"{low:g} to {high:g} m); length_unit {orientation.length_unit} or rotor_axis does not fit the file; "
            f"fitting units: {', '.join(fitting) or 'none, give metres per unit'}",
            "length_unit",
        )
    _check_side(orientation, points, "the blade's middle")
    if radius.max() > _TIP_RADIUS_BETWEEN[1]:
        raise ImportRefused(
            f"the blade would reach to {radius.max():.3g} m from the rotor axis (allowed: {_TIP_RADIUS_BETWEEN[1]:g} m); "
            "check axis_point, rotor_axis and length_unit",
            "axis_point",
        )
    if radius.min() < 1e-3 * span:
        raise ImportRefused("the rotor axis passes through the blade; check rotor_axis and axis_point")


def _check_side(orientation: Orientation, points: np.ndarray, what: str) -> None:
    mean = points.mean(axis=0)[:2]
    distance = np.hypot(*mean)
    if not mean[0] > _RADIAL_WITHIN * distance:
        x, y, z = np.round(mean @ orientation.rows[:2] / distance, 3) + 0.0
        raise ImportRefused(
            f"{what} lies at {np.degrees(np.arctan2(*mean[::-1])):.0f} degrees round the axis from "
            f"`radial`; rotor_axis, axis_point or radial does not fit the file; fitting: radial: [{x:g}, {y:g}, {z:g}]",
            "radial",
        )


def refuse_sense(ends: np.ndarray, sense: TipSense, pressure_forward: bool | None) -> None:
    """Refuse a rotation, rotor axis or pressure side that the `sense` of a tip contradicts, with ImportRefused.

    `ends`: leading and trailing edge, shape (2, 3); `pressure_forward`: whether the pressure side looks along the rotation,
    None where only the stagger tells.
    """
    fits = None if pressure_forward is None else sense.fits(pressure_forward)
    if sense.leads() is False:
        key, remedy = {
            None: ("rotation", "change rotation, or rotor_axis if it points upstream"),
            True: ("rotor_axis", "change rotor_axis if it points upstream, else both rotation and pressure_side"),
            False: ("rotation", "change rotation"),
        }[fits]
        leading, trailing = -np.arctan2(ends[:, 1], ends[:, 0])
        raise ImportRefused(
            f"found the tip's leading edge at {in_degrees(leading)} and its trailing edge at {in_degrees(trailing)} round the "
            f"axis, counted in the direction of rotation (stagger {in_degrees(sense.stagger)}); allowed: a leading edge that "
            f"is ahead, as in compressors and turbines; {remedy}; {UNLESS}",
            key,
        )
    if fits is False:
        side, other = ("along", "backward") if pressure_forward else ("against", "forward")
        raise ImportRefused(
            f"found a pressure side that looks {side} the rotation and is convex (camber {in_degrees(sense.camber)}, stagger "
            f"{in_degrees(sense.stagger)}); give pressure_side: {other}, or change both rotor_axis and rotation if rotor_axis "
            f"points upstream; {UNLESS}",
            "pressure_side",
        )


def in_degrees(angle: float) -> str:
    """Angle (rad) in words."""
    return f"{np.degrees(angle):+.1f} degrees"
