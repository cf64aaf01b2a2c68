"""A blade's definition: profiles plus sweep and lean, and the blade built from it."""

from dataclasses import dataclass

import numpy as np

from .blade_surface import Blade
from .profile import BladeShapeError, Profile, ProfileParameters
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
