"""Stacking of the profiles: placed on one radial line by the blade's plane sections, then shifted by sweep and lean.

Source: section 2 of the benchmark. Profiles are first stacked by their conical centres of area, then the blade is cut
by planes normal to the stacking line and every profile is moved until each section's centre of area is on the line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from numpy import ndarray

from .profile import BladeShapeError, Profile, area_and_centroid

_TOLERANCE = 1e-9  # m
_POINTS_PER_SIDE = 400
_NEAREST = 0.04
"""Span between cut sections: those near an end are cut through the spline's continuation, which close profiles lead astray."""


@dataclass(frozen=True)
class Placement:
    """Rigid motion of each profile on its own cone: axial shift (m) and rotation about the axis (rad), shape (profiles,)."""

    axial: ndarray
    rotation: ndarray

    def __add__(self, other: Placement) -> Placement:
        return Placement(self.axial + other.axial, self.rotation + other.rotation)


def span_weights(spans: ndarray) -> scipy.interpolate.CubicSpline:
    """Not-a-knot spline: span fractions (points,) -> weights, shape (points, profiles), of profiles at ascending `spans`.

    A value at a span is the sum of weight * profile value; beyond the profiles the end polynomials go on.
    """
    return scipy.interpolate.CubicSpline(spans, np.eye(len(spans)))


def conical_stacking(profiles: Sequence[Profile]) -> Placement:
    """Placement of profiles (hub to tip) with their centres of area, on their cones, at theta = 0 and the hub's axial place."""
    axial = np.array([p.cone.axial(p.centroid[0]) for p in profiles])
    rotation = np.array([-p.centroid[1] for p in profiles])
    return Placement(axial[0] - axial, rotation)


def plane_section_stacking(profiles: Sequence[Profile]) -> Placement:
    """Placement that puts the centre of area of every plane section x = const on one radial line.

    Section i is cut at the radius of profile i's centre of area. The line is at theta = 0, its axial position the
    one of the hub's section, so the hub profile does not shift axially. Of profiles closer than 4% of the span only some are
    cut, and the others moved as a cubic spline through these.

    Raises BladeShapeError when a section cannot be cut or the iteration does not settle.
    """
    spans = np.array([p.parameters.span for p in profiles])
    # apart, with the first and the last
    chosen = [0]
    for i in range(1, len(spans) - 1):
        if min(spans[i] - spans[chosen[-1]], spans[-1] - spans[i]) >= _NEAREST - 1e-9:
            chosen.append(i)
    sectioned = np.array([*chosen, len(spans) - 1])
    start = conical_stacking(profiles)
    moves = _moves_of_sections([profiles[i] for i in sectioned], Placement(start.axial[sectioned], start.rotation[sectioned]))
    weights = span_weights(spans[sectioned])(spans)
    return start + Placement(weights @ moves.axial, weights @ moves.rotation)


def _moves_of_sections(profiles: Sequence[Profile], start: Placement) -> Placement:
    """Displacements to add to the placement `start` so that the centre of area of every profile's section is on one line."""
    weights = span_weights(np.array([p.parameters.span for p in profiles]))
    drawn = [(p.cone, *p.outline(_POINTS_PER_SIDE)) for p in profiles]
    # cylindrical coordinates (r, theta, z), shape (profiles, 3, points)
    outlines = np.array([[cone.radius(m), theta, cone.axial(m)] for cone, m, theta in drawn])
    heights = np.array([p.cone.radius(p.centroid[0]) for p in profiles])

    def added(moves: ndarray) -> Placement:
        axial, tangential = np.split(moves, 2)
        return Placement(axial - axial[0], tangential / heights)

    def offsets(moves: ndarray) -> ndarray:
        """Offset of every section's centre of area from the stacking line (m), axial then tangential."""
        placement = start + added(moves)
        placed = outlines + np.stack([0.0 * heights, placement.rotation, placement.axial], axis=1)[:, :, None]
        centroids = np.array([_section_centroid(weights, placed, *each) for each in zip(profiles, heights, strict=True)])
        # the hub does not shift: its own entry only pins the line, through the unused first move
        axial = centroids[:, 1] - centroids[0, 1]
        axial[0] = moves[0]
        return np.concatenate([axial, centroids[:, 0]])

    # "move by minus the offset found" has a unit Jacobian to first order; hybrid Powell starts there and, unlike the
    # plain iteration, also settles where the sections' extrapolated ends couple neighbouring profiles strongly
    solution = scipy.optimize.root(offsets, np.zeros(2 * len(profiles)), tol=1e-12)
    residual = np.abs(offsets(solution.x))
    if not np.max(residual) < _TOLERANCE:
        worst = profiles[int(np.argmax(residual)) % len(profiles)]
        raise BladeShapeError(
            f"{worst.parameters.label}: the stacking does not settle; "
            "neighbouring profiles of the table differ too much in shape"
        )
    return added(solution.x)


def _section_centroid(
    weights: scipy.interpolate.CubicSpline, outlines: ndarray, profile: Profile, height: float
) -> tuple[float, float]:
    """Centre of area (y, z) of the section x = height; each outline point runs along the span until it meets the plane."""
    v = np.full(outlines.shape[2], profile.parameters.span)
    slopes = weights.derivative()
    for _ in range(50):
        radius, theta, axial = np.einsum("np,pcn->cn", weights(v), outlines)
        d_radius, d_theta, _ = np.einsum("np,pcn->cn", slopes(v), outlines)
        x = radius * np.cos(theta)
        slope = d_radius * np.cos(theta) - radius * np.sin(theta) * d_theta
        step = (height - x) / slope
        v = v + np.clip(step, -0.2, 0.2)
        if np.max(np.abs(step)) < 1e-12:
            _, y, z = area_and_centroid(radius * np.sin(theta), axial)
            return y, z
    raise BladeShapeError(
        f"{profile.parameters.label}: the plane section through this profile's centre of area cannot be cut; "
        "neighbouring profiles cross or differ too much in radius"
    )


def sweep_and_lean(spans: ndarray, table: ndarray) -> Placement:
    """Placement of profiles at `spans` (fractions) from a table with columns span, sweep (m), lean (rad).

    Interpolated by the cubic B-spline through the table's rows (lower order with fewer than four). Sweep is positive
    downstream; lean is positive in the direction of rotation, which is towards negative theta.
    """
    spline = scipy.interpolate.make_interp_spline(table[:, 0], table[:, 1:], k=min(3, len(table) - 1))
    sweep, lean = spline(spans).T
    return Placement(sweep, -lean)


def chordwise_sweep(profiles: Sequence[Any], angle: float) -> Placement:
    """Placement of profiles or sections (hub to tip) for a chordwise sweep by `angle` (rad), positive forward.

    Each has, as a Profile, its `cone`, its centre of area (m, theta) on that, `centroid`, and its `stagger` angle (rad).

    Source: section 2 of the benchmark: axial sweep -tan(angle) (r - r_hub) cos(stagger) and lean
    arcsin(tan(angle) (r - r_hub)/r sin(stagger)), r the radius of the profile's centre of area.
    """
    radius = np.array([p.cone.radius(p.centroid[0]) for p in profiles])
    stagger = np.array([p.stagger for p in profiles])
    shift = np.tan(angle) * (radius - radius[0])
    lean = np.arcsin(shift / radius * np.sin(stagger))
    return Placement(-shift * np.cos(stagger), -lean)
