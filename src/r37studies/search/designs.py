"""Designs of a search: the blade that it starts at and its scenes, with other values of some keys, and what they give.

Light: the workflow imports this whether there is a search or not.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from r37core.base.varied_number import BLADE, SCENE, VariedNumber, value_at, values_of
from r37core.blade.definition import Shape
from r37core.config import BladeSettings, Settings, operating_range, plain, varied_settings
from r37core.config.blades import blade_settings
from r37core.config.changed_numbers import entry_with, scene_numbers
from r37core.config.families import design_entry
from r37core.config.shape_keys import SECTION_KEYS, SHARES, ShapeKeys, neutral_value
from r37studies.surrogate.designs import Design, Value

from .section import SECTION, QuantitySection, SearchSection

START = "start"
"""Name of the design that the search starts at."""

UNKNOWN: Value = (math.nan, math.nan)

FOLDER = SECTION.name
"""Folder of the designs' files: the extension's name."""

_KEPT = ("stress", "static_stress", "fatigue")
"""Results of a scene that designs have, too: what they are judged by."""


@dataclass(frozen=True)
class SearchDesigns:
    """Designs of the search that `settings` ask for."""

    settings: Settings

    @property
    def entry(self) -> SearchSection:
        """Section of config.yaml."""
        entry = self.settings.section(SECTION)
        assert entry is not None
        return entry

    @property
    def start(self) -> Any:
        """The entry of blades.yaml that all designs have in common."""
        entry = self.settings.designs.entries[self.entry.blade]
        assert isinstance(entry, ShapeKeys)
        return entry

    @cached_property
    def scenes(self) -> tuple[str, ...]:
        """Scenes that the objectives and constraints are of, in the order of the run."""
        quantities = [*self.entry.objectives.values(), *self.entry.constraints.values()]
        named = {scene for each in quantities for scene in each.scenes or ()}
        return tuple(scene for scene in self.settings.scene_names if scene in named)

    @property
    def start_values(self) -> list[float | None]:
        """Values of the variables that the start has; None where neither its entry says nor a key that is left out."""
        # all scenes that have a number agree
        return [
            start_value(self.start, number.key) if number.kind == BLADE else next(iter(self.values_in_scenes(number).values()))
            for number in self.numbers
        ]

    @property
    def numbers(self) -> list[VariedNumber]:
        """Numbers of the variables."""
        return list(map(VariedNumber.named, self.entry.variables))

    @property
    def change_blade(self) -> bool:
        """True if a variable is of the blade, so that designs have models of their own."""
        return any(number.kind == BLADE for number in self.numbers)

    def values_in_scenes(self, number: VariedNumber) -> dict[str, float]:
        """Scene -> its value of a number of scenes, of all scenes of the search that have it."""
        known = self.scene_numbers.items() if number.kind == SCENE else ()
        return {scene: numbers[number.key] for scene, numbers in known if number.key in numbers}

    @cached_property
    def scene_numbers(self) -> dict[str, dict[str, float]]:
        """Numbers of each scene of the search by dotted keys."""
        return {scene: scene_numbers(self.settings.scene_designs.entries[scene]) for scene in self.scenes}

    def varied_entry(self, name: str, values: Mapping[str, float]) -> Any:
        """The entry with other values of some variables. Raises ConfigError for one that a blade cannot have."""
        return design_entry(self.entry.blade, self.start, values_of(BLADE, values), name, self.settings.designs.document)

    def scene_changes(self, scene: str, values: Mapping[str, float]) -> dict[str, float]:
        """Values of the variables that a scene has, of all `values` of variables, by dotted keys of its entry."""
        return {key: value for key, value in values_of(SCENE, values).items() if key in self.scene_numbers[scene]}

    def blade(self, name: str, values: Sequence[float] | None) -> BladeSettings:
        """A design as a blade, the start without `values`. Raises ConfigError where its shape is impossible."""
        blade, designs = self.entry.blade, self.settings.designs
        if values is None or not self.change_blade:
            return self.settings.blades[blade]
        changed = self.varied_entry(name, dict(zip(self.entry.variables, values, strict=True)))
        # the name is that of the start, by which tables of sweep and lean know it
        return blade_settings(blade, {**designs.entries, blade: changed}, self.settings.root, designs.document)

    def design_settings(self, name: str, values: Sequence[float] | None) -> dict[str, Settings]:
        """Scene -> the settings with a design in it, and results that designs are judged by.

        Without `values` it is the start. Raises ConfigError and ImpossibleValueError where a value is impossible.
        """
        blade, settings, searched = self.blade(name, values), self.settings, self.entry.blade
        if isinstance(shape := blade.definition, Shape) and blade.elastic != settings.blades[searched].elastic:
            # for messages
            blade = replace(blade, definition=shape.replaced(name=f"{searched}, {FOLDER}/{name}"))
        named = {} if values is None else dict(zip(self.entry.variables, values, strict=True))
        scene_settings = {}
        for scene in self.scenes:
            changed = entry_with(settings.scene_designs.entries[scene], self.scene_changes(scene, named)).scene()
            results = tuple(result for result in settings.results_of(searched, scene) if result in _KEPT)
            chosen = replace(settings.scenes[scene], scene=changed, results=results, stress_history_speeds=())
            scene_settings[scene] = varied_settings(settings, {searched: blade}, {scene: chosen})
        return scene_settings


def start_value(entry: ShapeKeys, key: str) -> float | None:
    """Value of a dotted key of an entry, for a share or law that is left out one that changes nothing; None without a value."""
    first = key.split(".")[0]
    if getattr(entry, first, None) is None and (first in SECTION_KEYS or key in SHARES):
        return neutral_value(key)
    return value_at(plain(entry), key)


@dataclass(frozen=True)
class SearchChoice:
    """Variables, objectives and constraints of the section `entry`, whose measures are chosen.

    `start`: values of the variables that the start has, None where unknown.
    """

    entry: SearchSection
    start: tuple[float | None, ...]

    @property
    def quantities(self) -> dict[str, QuantitySection]:
        """Quantities of objectives and constraints, by name."""
        return {**self.entry.objectives, **self.entry.constraints}

    def design(
        self, name: str, values: Sequence[float | None], number: int, gave: Mapping[str, Any] | str, tried: Mapping[str, Design]
    ) -> Design:
        """The design of round `number` that `gave` quantities, or the reason why it cannot be built; `tried`: those before it.

        What is None is not known.
        """
        measured, refused = ({}, gave) if isinstance(gave, str) else (gave, "")
        quantities = {name: (_number(value), _number(scatter)) for name, (value, scatter) in measured.items()}
        objectives, scatters = zip(*(quantities.get(objective, UNKNOWN) for objective in self.entry.objectives), strict=True)
        margins = tuple(self.margins(quantities, tried[START].quantities if tried else quantities))
        return Design(name, tuple(map(_number, values)), objectives, scatters, margins, number, refused, quantities)

    def margins(self, values: Mapping[str, Value], start: Mapping[str, Value]) -> list[float]:
        """Margins by which each bound is kept, in its quantity's unit, below 0 where it is not: constraint by constraint."""
        margins = []
        for name, constraint in self.entry.constraints.items():
            value, reference = (of.get(name, UNKNOWN)[0] for of in (values, start))
            lowest, highest = constraint.bounds(reference)
            margins += [
                margin for bound, margin in ((lowest, value - lowest), (highest, highest - value)) if math.isfinite(bound)
            ]
        return margins


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def choice_of(settings: Settings) -> SearchChoice:
    """Search that the section of config.yaml asks for."""
    designs, is_flown = designs_of(settings), operating_range(settings) is not None
    quantities = {
        kind: {name: each.chosen(is_flown) for name, each in getattr(designs.entry, kind).items()}
        for kind in ("objectives", "constraints")
    }
    return SearchChoice(designs.entry.model_copy(update=quantities), tuple(designs.start_values))


def designs_of(settings: Settings) -> SearchDesigns:
    """Designs of the search of these settings, made once."""
    return settings.made(SearchDesigns)


def is_asked(settings: Settings) -> bool:
    """True if this run has a search."""
    return settings.section(SECTION) is not None
