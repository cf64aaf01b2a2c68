"""Designs of a search: the blade that it starts at, with other values of some keys."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from r37core.config import BladeSettings, Settings
from r37core.config.blades import SHARES, BladeEntry, blade_settings
from r37core.config.changed_numbers import blade_number, changed_blade, changed_scene, scene_numbers
from r37core.config.families import design_entry
from r37core.config.section_laws import SECTION_KEYS
from r37core.plans.member_values import drawn, is_of_sample, sobol_points
from r37core.plans.samples import NOMINAL, Member, Pair, Sample, path_part

from .problem import SearchVariable
from .section import SECTION, SearchSection

FOLDER = SECTION.name
"""Folder of the designs' files: the extension's name."""

_KEPT = ("stress", "static_stress")
"""Results of a scene that designs have, too: what they are judged by."""


def member_part(design: str) -> str:
    """The part `member` of the paths of a design's files."""
    return path_part(f"{FOLDER}/{design}")


@dataclass(frozen=True)
class SearchDesigns:
    """Designs of the search that `settings` ask for."""

    settings: Settings

    @property
    def entry(self) -> SearchSection:
        """What is asked for."""
        entry = self.settings.section(SECTION)
        assert entry is not None
        return entry

    @property
    def start(self) -> BladeEntry:
        """The entry of blades.yaml that all designs have in common."""
        entry = self.settings.designs.entries[self.entry.blade]
        assert isinstance(entry, BladeEntry)
        return entry

    @property
    def variables(self) -> tuple[SearchVariable, ...]:
        """What varies between which bounds, in the units of the keys."""
        return tuple(SearchVariable(key, *bounds) for key, bounds in self.entry.variables.items())

    @cached_property
    def scenes(self) -> tuple[str, ...]:
        """Scenes that the objectives and constraints are of, in the order of the run."""
        quantities = [*self.entry.objectives.values(), *self.entry.constraints.values()]
        named = {scene for each in quantities for scene in each.scenes or ()}
        return tuple(scene for scene in self.settings.scene_names if scene in named)

    @property
    def start_values(self) -> list[float | None]:
        """Values of the variables that the start has; None where neither its entry says nor a key that is left out."""
        return [start_value(self.start, key) for key in self.entry.variables]

    def varied_entry(self, name: str, values: Mapping[str, float]) -> BladeEntry:
        """The entry with other values of some variables. Raises ConfigError for one that a blade cannot have."""
        return design_entry(self.entry.blade, self.start, values, name, self.settings.designs.document)

    def blade(self, name: str, values: Sequence[float] | None) -> BladeSettings:
        """A design as a blade, the start without `values`. Raises ConfigError where its shape is impossible."""
        blade, designs = self.entry.blade, self.settings.designs
        if values is None:
            return self.settings.blades[blade]
        changed = self.varied_entry(name, dict(zip(self.entry.variables, values, strict=True)))
        # the name is that of the start, by which tables of sweep and lean know it
        return blade_settings(blade, {**designs.entries, blade: changed}, self.settings.root, designs.document)

    def samples(self, name: str, values: Sequence[float] | None) -> dict[Pair, Sample]:
        """A design in each scene: its nominal run, and members under tolerances where an objective has a quantile.

        Raises ConfigError and ImpossibleValueError where one of them is impossible.
        """
        blade = self.blade(name, values)
        return {(self.entry.blade, scene): self._sample(name, blade, scene) for scene in self.scenes}

    def _sample(self, name: str, blade: BladeSettings, scene: str) -> Sample:
        settings, own = self.settings, member_part(name)
        chosen = settings.scenes[scene].scene
        members = {NOMINAL: Member(blade, chosen, own), **self._members(name, blade, scene)}
        return Sample(
            members=members,
            deciding=list(members),
            largest_share=settings.config.refinement.scene_refinement(chosen).largest_share,
            results=tuple(result for result in settings.results_of(self.entry.blade, scene) if result in _KEPT),
            campbell=own,
        )

    def _members(self, name: str, blade: BladeSettings, scene: str) -> dict[str, Member]:
        """Members under tolerances, with a model of their own where the blade is another one."""
        tolerances, scene_entry = self.entry.tolerances, self.settings.scene_designs.entries[scene]
        if tolerances is None:
            return {}
        scene_values, spreads = scene_numbers(scene_entry), tolerances.spreads
        nominal = [blade_number(blade, key) if where == "of_blades" else scene_values.get(key) for where, key in spreads]
        points = sobol_points(len(spreads), tolerances.members, self.entry.seed)
        members = {}
        for member in filter(is_of_sample, points):
            changes: dict[str, dict[str, float]] = {"of_blades": {}, "of_scenes": {}}
            for (where, key), value in zip(spreads, drawn(spreads.values(), nominal, points[member]), strict=True):
                if value is not None:
                    changes[where][key] = value
            other = changed_blade(blade, changes["of_blades"])
            own = path_part(f"{FOLDER}/{name}", NOMINAL if other.elastic == blade.elastic else member)
            members[member] = Member(other, changed_scene(scene_entry, changes["of_scenes"]), own)
        return members


def start_value(entry: BladeEntry, key: str) -> float | None:
    """Value of a dotted key of an entry, for a share or law that is left out one that changes nothing; None without a value."""
    first, *others = key.split(".")
    inner: Any = getattr(entry, first, None)
    if inner is None and (first in SECTION_KEYS or key in SHARES):
        return 100.0 if first.endswith("_percent") else 0.0
    for step in others:
        inner = inner[int(step)] if isinstance(inner, list) else getattr(inner, step, None)
    return float(inner) if isinstance(inner, int | float) else None
