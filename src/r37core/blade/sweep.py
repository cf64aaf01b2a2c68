"""Sweep and lean: how a variant's profiles are shifted against the stacked reference."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import make_interp_spline

from .profile import Profile
from .stacking import Placement


def sweep_and_lean(spans: np.ndarray, table: np.ndarray) -> Placement:
    """Placement of profiles at `spans` (fractions) from a table with columns span, sweep (m), lean (rad).

    Interpolated by the cubic B-spline through the table's rows (lower order with fewer than four). Sweep is positive
    downstream; lean is positive in the direction of rotation, which is towards negative theta.
    """
    order = min(3, len(table) - 1)
    spline = make_interp_spline(table[:, 0], table[:, 1:], k=order)
    sweep, lean = spline(spans).T
    return Placement(sweep, -lean)


def chordwise_sweep(profiles: Sequence[Profile], angle: float) -> Placement:
    """Placement of the profiles (hub to tip) for a chordwise sweep by `angle` (rad), positive forward.

    Source: section 2 of the benchmark: axial sweep -tan(angle) (r - r_hub) cos(stagger) and lean
    arcsin(tan(angle) (r - r_hub)/r sin(stagger)), r the radius of the profile's centre of area.
    """
    radius = np.array([p.cone.radius(p.centroid[0]) for p in profiles])
    stagger = np.array([p.stagger for p in profiles])
    shift = np.tan(angle) * (radius - radius[0])
    lean = np.arcsin(shift / radius * np.sin(stagger))
    return Placement(-shift * np.cos(stagger), -lean)
