"""A blade's definition: profiles plus sweep and lean, and the blade built from it; other kinds of definitions."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np

from r37core.base.io import function_named
from r37core.base.packages import registered
from r37core.base.plain import from_plain

from .blade_map import Blade, BladeMap
from .profile import BladeShapeError, Profile, ProfileParameters
from .section_changes import SectionChange, SpanLaw, changed_profiles
from .stacking import chordwise_sweep, plane_section_stacking, sweep_and_lean

SMALLER_CHANGES = (
    "; where the blade's entry has stagger_deg, camber_deg, chord_percent or thickness_percent, a smaller change near this span"
)
"""Advice for a shape that cannot be built, or is meshed badly, in addition to its message."""


class Definition:
    """Definition of a blade, whatever it is given by.

    `stages`: stages of the structure (plans/stages.py) that others stand in place of, or "" where it has none. `cyclic`: the
    disc that it is a sector of, with its number of `sectors`; None of a blade alone.
    """

    stages: ClassVar[Mapping[str, str]] = {}
    cyclic: Any = None

    def files(self, root: Path) -> list[Path]:
        """Files that stages read, of names that start from the folder `root`."""
        return []

    def remarks(self, root: Path, material: Any) -> list[str]:
        """Remarks before a run; `material`: of blades.yaml (fem.material), None for one without."""
        return []


class Shape(Definition, ABC):
    """Definition whose blade this program meshes, a frozen dataclass with at least these fields.

    `stacking`: rows of span, sweep (m), lean (rad); `chordwise_sweep_angle` in rad, positive forward.
    """

    name: str
    stacking: tuple[tuple[float, float, float], ...] | None
    chordwise_sweep_angle: float | None

    @property
    @abstractmethod
    def changes(self) -> tuple[str, ...]:
        """Names of the changes that its sections can have, fields of SectionChange."""

    @property
    @abstractmethod
    def height(self) -> float:
        """Height of the blade (m)."""

    @abstractmethod
    def changed(self, laws: Mapping[str, SpanLaw]) -> Self:
        """The definition changed by laws over the span, by the names of `changes`. Raises SectionChangeError."""

    def replaced(self, **values: Any) -> Self:
        """The definition with other values of some fields."""
        # the dataclasses are those derived from this class
        definition: Any = self
        return replace(definition, **values)

    @abstractmethod
    def build(self, round_edges: bool) -> BladeMap:
        """Build the blade; BladeShapeError, with the blade's name, where the shape is impossible."""


@dataclass(frozen=True)
class BladeDefinition(Shape):
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


def shape_from_plain(data: Mapping[str, Any]) -> Shape:
    """The definition of which `to_plain` made `data`. Raises PlainError as `from_plain`."""
    kinds = (name for key, name in registered("SHAPES").items() if key in data)
    return from_plain(next(map(function_named, kinds), BladeDefinition), data)


def shape_modules() -> list[str]:
    """Modules that a step imports by name where it makes or reads shapes."""
    names = {**registered("SHAPES"), **registered("GEOMETRIES")}.values()
    return [name.rpartition(".")[0] for name in names]
