"""A scene: what the blade meets. Plain numbers only, so that its repr tells whether it was edited."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .casing import Casing


@dataclass(frozen=True)
class Lining:
    """Lining of bars in front of the casing.

    `thickness` (m), moduli and yield stress in Pa, `bars` round the circumference; `shared_ring`: all tip nodes wear one
    ring, else each has its own; area of a bar as a multiple of the natural one (bar arc length times the node's share of the
    chord), or `bar_area` in m2. Law after Legrand, Batailly and Pierre, J. Comput. Nonlinear Dyn. 7 (2012): yield in
    compression with linear hardening; the plastic shortening is the wear.
    """

    thickness: float
    elastic_modulus: float
    plastic_modulus: float
    yield_stress: float
    bars: int = 10000
    shared_ring: bool = True
    natural_areas: float = 1.0
    bar_area: float | None = None

    def area(self, radius: float, chord_share: float) -> float:
        """Area of one bar (m2) at `radius` (m), for a node's share of the chord (m)."""
        if self.bar_area is not None:
            return self.bar_area
        return self.natural_areas * 2.0 * np.pi * radius / self.bars * chord_share


@dataclass(frozen=True)
class Friction:
    """Always-sliding Coulomb friction.

    `coefficient`; `vector`: along the real sliding velocity (rotation plus vibration), else the vibration is neglected;
    `against_rotation`: whether the rotation's part of the sliding velocity is the real one or reversed; `coupled`: whether
    the friction a casing multiplier causes is part of the complementarity problem or added after it is solved.
    """

    coefficient: float
    vector: bool = True
    against_rotation: bool = True
    coupled: bool = True


@dataclass(frozen=True)
class Scene:
    """What the blade meets: casing, lining or None, friction or None, and how the gap is measured.

    `damping_ratio`: of every mode; `exact_gap`: radius of the displaced node, sqrt((r + u_r)^2 + u_theta^2), instead of
    r + u_r; `divergence_limit` (m): a tip displacement beyond it ends the run as diverged.
    """

    casing: Casing
    lining: Lining | None = None
    friction: Friction | None = None
    damping_ratio: float = 0.0005
    exact_gap: bool = False
    divergence_limit: float = 0.05
