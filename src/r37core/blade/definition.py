"""A blade's definition: profiles plus sweep and lean, or sections, and the blade built from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from r37core.base.plain import from_plain

from .blade_surface import Blade
from .profile import BladeShapeError, Profile, ProfileParameters
from .section_changes import SectionChange, SpanLaw, changed_profiles
from .sections_definition import SectionsDefinition
from .stacking import chordwise_sweep, plane_section_stacking, sweep_and_lean

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

    def changed(self, laws: Mapping[str, SpanLaw]) -> BladeDefinition:
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


Shape = BladeDefinition | SectionsDefinition
"""Definitions whose blade this program meshes."""


def shape_from_plain(data: Mapping[str, Any]) -> Shape:
    """The definition of which `to_plain` made `data`. Raises PlainError as `from_plain`."""
    return from_plain(SectionsDefinition, data) if "sections" in data else from_plain(BladeDefinition, data)
