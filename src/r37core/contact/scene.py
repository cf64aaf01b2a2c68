"""A scene: what the blade meets. Plain numbers only, so that its repr tells whether it was edited."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .casing import Casing


@dataclass(frozen=True)
class Lining:
    """Lining of bars in front of the casing.

    `thickness` (m), moduli and yield stress in Pa, `bars` round the circumference, each `bar_width` (m) wide, or of a given
    `bar_area` (m2); `shared_ring`: all tip nodes wear one ring, else each has its own. Law after Legrand, Batailly and
    Pierre, J. Comput. Nonlinear Dyn. 7 (2012): yield in compression with linear hardening; the plastic shortening is the wear.
    """

    thickness: float
    elastic_modulus: float
    plastic_modulus: float
    yield_stress: float
    bar_width: float
    bars: int
    shared_ring: bool
    bar_area: float | None = None

    def area(self, radius: float) -> float:
        """Area of one bar (m2): its width times the arc length of a bar at `radius` (m)."""
        return 2.0 * np.pi * radius / self.bars * self.bar_width if self.bar_area is None else self.bar_area


@dataclass(frozen=True)
class Friction:
    """Always-sliding Coulomb friction.

    `coefficient`; `vector`: along the real sliding velocity (rotation plus vibration), else the vibration is neglected;
    `against_rotation`: whether the rotation's part of the sliding velocity is the real one or reversed; `coupled`: whether
    the friction a casing multiplier causes is part of the complementarity problem or added after it is solved.
    """

    coefficient: float
    vector: bool
    against_rotation: bool
    coupled: bool


@dataclass(frozen=True)
class Scene:
    """What the blade meets: casing, lining or None, friction or None, and how the gap is measured.

    `damping_ratio`: of every mode; `exact_gap`: distance of the displaced node from the conical, lobed casing, instead of
    the clearance at the undeformed node's angle less the normal displacement; `divergence_limit` (m): a tip displacement
    beyond it ends the run as diverged.
    """

    casing: Casing
    lining: Lining | None
    friction: Friction | None
    damping_ratio: float
    exact_gap: bool
    divergence_limit: float
