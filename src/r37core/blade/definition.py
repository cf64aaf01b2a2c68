"""A blade's definition: profiles plus sweep and lean, or sections, and the blade built from it."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from itertools import pairwise
from typing import Any, Self

import numpy as np

from r37core.base.plain import from_plain

from .blade_map import BEYOND, Blade, Meridian, SectionBlade
from .profile import BladeShapeError, Profile, ProfileParameters
from .section_changes import SectionChange, SectionChangeError, SpanLaw, changed_profiles
from .section_curve import Point, SectionCurve
from .stacking import Placement, chordwise_sweep, plane_section_stacking, sweep_and_lean

SMALLER_CHANGES = (
    "; where the blade's entry has stagger_deg, camber_deg, chord_percent or thickness_percent, a smaller change near this span"
)
"""Advice for a shape that cannot be built, or is meshed badly, in addition to its message."""


@dataclass(frozen=True)
class BladeDefinition:
    """Definition by a user: profiles from hub to tip, and either a sweep and lean table, a chordwise sweep, or neither.

    `stacking`: rows of span, sweep (m), lean (rad); `chordwise_sweep_angle` in rad, positive forward. Made of plain
    numbers, so that its repr is exact and tells whether a blade was edited.
    """

    name: str
    profiles: tuple[ProfileParameters, ...]
    stacking: tuple[tuple[float, float, float], ...] | None = None
    chordwise_sweep_angle: float | None = None

    @property
    def changes(self) -> tuple[str, ...]:
        """Names of the changes that its profiles can have."""
        return tuple(field.name for field in fields(SectionChange))

    @property
    def height(self) -> float:
        """Height of the leading edge (m)."""
        return self.profiles[-1].inlet_radius - self.profiles[0].inlet_radius

    def changed(self, laws: Mapping[str, SpanLaw]) -> Self:
        """The definition with profiles changed by laws, by the names of SectionChange's fields. Raises SectionChangeError."""
        return replace(self, profiles=changed_profiles(self.profiles, laws))

    def build(self, round_edges: bool) -> Blade:
        """Build the blade; BladeShapeError, with the blade's name, where the shape is impossible."""
        try:
            profiles = [Profile(parameters) for parameters in self.profiles]
            placement = plane_section_stacking(profiles)
            if self.stacking is not None:
                placement += sweep_and_lean(np.array([p.span for p in self.profiles]), np.array(self.stacking))
            elif self.chordwise_sweep_angle is not None:
                placement += chordwise_sweep(profiles, self.chordwise_sweep_angle)
            return Blade(profiles, placement, round_edges)
        except BladeShapeError as error:
            raise BladeShapeError(f"blade {self.name}: {error}{SMALLER_CHANGES}") from None


_ALONG = np.array([0.0, 0.5, 1.0])
"""Shares of a side at which neighbouring sections are compared."""


@dataclass(frozen=True)
class SectionsDefinition:
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
        return section_curve(self.sections[number], label, self.pressure_forward)

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
        first = radii[0] if self.hub is None else float(Meridian(self.hub).radius(np.array(curves[0].z)))
        last = radii[-1] if self.tip is None else float(Meridian(self.tip).radius(np.array(curves[-1].z)))
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
            return SectionBlade(
                self.curves,
                places,
                placement,
                None if self.hub is None else Meridian(self.hub),
                None if self.tip is None else Meridian(self.tip),
                round_edges,
                self.pressure_forward,
            )
        except BladeShapeError as error:
            raise BladeShapeError(f"blade {self.name}: {error}") from None


# designs of a family start from the same sections, and a call reads them several times; one takes 0.3 MB
@lru_cache(maxsize=2**7)
def section_curve(points: tuple[Point, ...], label: str, pressure_forward: bool) -> SectionCurve:
    """A section with its sides, made once. Raises as SectionCurve."""
    return SectionCurve(points, label, pressure_forward)


Shape = BladeDefinition | SectionsDefinition
"""Definitions whose blade this program meshes."""


def shape_from_plain(data: Mapping[str, Any]) -> Shape:
    """The definition of which `to_plain` made `data`. Raises PlainError as `from_plain`."""
    return from_plain(SectionsDefinition, data) if "sections" in data else from_plain(BladeDefinition, data)
