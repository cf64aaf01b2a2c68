"""Definition of a blade by section curves, and the blade built from it."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any, Self

import numpy as np

from r37core.blade.definition import Shape
from r37core.blade.profile import BladeShapeError
from r37core.blade.section_changes import SectionChangeError, SpanLaw
from r37core.blade.stacking import Placement, chordwise_sweep, sweep_and_lean

from .section_blade import BEYOND, Meridian, SectionBlade
from .section_curve import Point, SectionCurve

_ALONG = np.array([0.0, 0.5, 1.0])
"""Shares of a side at which neighbouring sections are compared."""


@dataclass(frozen=True)
class SectionsDefinition(Shape):
    """Definition by a user: closed curves of points from hub to tip, in m, in the blade's frame, with sweep and lean on top.

    `hub` and `tip`: points (z, r) of the meridians that cut the blade, one of a cylinder; without them its first and last
    section do. `stacking`, `chordwise_sweep_angle`: as in BladeDefinition.
    """

    name: str
    sections: tuple[tuple[Point, ...], ...]
    hub: tuple[tuple[float, float], ...] | None = None
    tip: tuple[tuple[float, float], ...] | None = None
    pressure_forward: bool = True
    stacking: tuple[tuple[float, float, float], ...] | None = None
    chordwise_sweep_angle: float | None = None

    def curve(self, number: int) -> SectionCurve:
        """Section with its sides, by its number from 0 at the hub. Raises BladeShapeError for a curve that is no section."""
        label = f"section {number + 1} of {len(self.sections)} from the hub"
        return _section_curve(self.sections[number], label, self.pressure_forward)

    @property
    def curves(self) -> tuple[SectionCurve, ...]:
        """All sections with their sides. Raises BladeShapeError."""
        return tuple(map(self.curve, range(len(self.sections))))

    @property
    def changes(self) -> tuple[str, ...]:
        """Names of the changes that its sections can have."""
        return ("stagger",)

    @property
    def height(self) -> float:
        """Distance of the first section from the last (m)."""
        return self.curve(len(self.sections) - 1).radius - self.curve(0).radius

    def _ends(self) -> list[Meridian | None]:
        """Surfaces that cut the blade at hub and tip."""
        return [Meridian(points) if points else None for points in (self.hub, self.tip)]

    def places(self) -> np.ndarray:
        """Fraction of the height from hub to tip at which each section lies; BladeShapeError unless these rise."""
        curves = self.curves
        for below, above in pairwise(curves):
            rise = above.pressure.point(_ALONG)[0] - below.pressure.point(_ALONG)[0]
            if not np.all(rise > 0.0):
                raise BladeShapeError(
                    f"{above.label}: it does not lie wholly above the one before it (mean radius {above.radius:.5g} m after "
                    f"{below.radius:.5g} m); allowed: sections in their order from hub to tip, or from tip to hub"
                )
        radii = np.array([curve.radius for curve in curves])
        pairs = zip(self._ends(), (curves[0], curves[-1]), strict=True)
        first, last = (curve.radius if end is None else float(end.radius(np.array(curve.z))) for end, curve in pairs)
        if not last > first:
            raise BladeShapeError(f"the tip, at a radius of {last:.5g} m, does not lie above the hub, at {first:.5g} m")
        places = (radii - first) / (last - first)
        for what, radius, beyond in (("hub", first, places[0]), ("tip", last, 1.0 - places[-1])):
            if beyond > BEYOND:
                raise BladeShapeError(
                    f"{what}: its radius of {radius:.5g} m lies outside the sections, of mean radii {radii[0]:.5g} to "
                    f"{radii[-1]:.5g} m, by {100 * beyond:.3g}% of the height; allowed: {100 * BEYOND:g}%; give sections that "
                    f"reach it, or another {what}"
                )
        return places

    def remarks(self, root: Path, material: Any) -> list[str]:
        """The radii between which sections and blade lie, and what hub and tip cut off or add."""
        places, first, last = self.places(), self.curves[0].radius, self.curves[-1].radius
        below, above = (self.height / np.ptp(places) * share for share in (-places[0], places[-1] - 1.0))
        extent = f"sections lie from r {first:.4g} to {last:.4g} m, the blade from {first + below:.4g} to {last - above:.4g} m"
        hub, tip = (f"{'adds' if share < 0.0 else 'cuts off'} {1e3 * abs(share):.3g} mm" for share in (below, above))
        return [f"{extent}: the hub {hub}, the tip {tip}"]

    def changed(self, laws: Mapping[str, SpanLaw]) -> Self:
        """The definition with another stagger, by a law over the span. Raises SectionChangeError for any other change."""
        others = sorted(set(laws) - set(self.changes))
        if others:
            allowed = "stagger_deg, sweep and lean, or other sections"
            raise SectionChangeError(f"a blade given by sections has no arcs to change so; allowed: {allowed}", others)
        if "stagger" not in laws:
            return self
        angles = laws["stagger"].evaluate(np.clip(self.places(), 0.0, 1.0))
        turned = tuple(
            points if angle == 0.0 else self.curve(number).rotated(float(angle))
            for number, (points, angle) in enumerate(zip(self.sections, angles, strict=True))
        )
        return replace(self, sections=turned)

    def build(self, round_edges: bool) -> SectionBlade:
        """Build the blade; BladeShapeError, with the blade's name, where the shape is impossible."""
        try:
            places = self.places()
            placement = Placement(np.zeros(len(places)), np.zeros(len(places)))
            if self.stacking is not None:
                placement = sweep_and_lean(places, np.array(self.stacking))
            elif self.chordwise_sweep_angle is not None:
                placement = chordwise_sweep(self.curves, self.chordwise_sweep_angle)
            hub, tip = self._ends()
            return SectionBlade(self.curves, places, placement, hub, tip, round_edges, self.pressure_forward)
        except BladeShapeError as error:
            raise BladeShapeError(f"blade {self.name}: {error}") from None


# designs of a family start from the same sections, and a call reads them several times; one takes 0.3 MB
_section_curve = lru_cache(maxsize=2**7)(SectionCurve)
