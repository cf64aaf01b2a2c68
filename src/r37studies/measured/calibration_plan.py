"""Numbers of a configuration that are fitted to its measurements, checked, and the designs that this takes."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from r37core.base.io import Named
from r37core.base.plain import to_plain
from r37core.base.varied_number import BLADE, KINDS, VariedNumber
from r37core.config import BladeSettings, Settings
from r37core.config.changed_numbers import changed_pair, check_known, nominal_value, scene_numbers
from r37core.config.section import plain
from r37core.config.spread import SpreadEntry
from r37core.contact.scene import Scene

from .measurement_plan import Measured
from .points import CONFIRMING, GAIN
from .section import CALIBRATE, MEASURED, CalibrateSection

FREQUENCIES = VariedNumber("frequencies", "frequencies_percent")
"""All natural frequencies at rest, in percent of the model's."""


@dataclass(frozen=True)
class Calibrated:
    """Plan of the calibration that `settings` ask for."""

    settings: Settings

    @property
    def section(self) -> CalibrateSection:
        """Section of config.yaml."""
        section = self.settings.section(CALIBRATE)
        assert section is not None
        return section

    @cached_property
    def spreads(self) -> dict[VariedNumber, SpreadEntry]:
        """Distribution of each number before. Gains come last."""
        section = self.section
        spreads = section.spreads | ({FREQUENCIES: section.frequencies_percent} if section.frequencies_percent else {})
        for number, each in enumerate(self.settings.section(MEASURED)):
            if each.gain:
                spreads[VariedNumber(GAIN, f"m{number}.{GAIN}")] = each.gain
        return spreads

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Blades and scenes that are simulated."""
        return self.settings.made(Measured).pairs

    @cached_property
    def nominal(self) -> list[float]:
        """Value in the configuration of each number, which all measured blades and scenes that have it share."""
        settings, document, values = self.settings, self.settings.document, []
        scenes = {scene: scene_numbers(settings.scene_designs.entries[scene]) for _, scene in self.pairs}
        own = [number for number in self.spreads if number.kind in KINDS]
        check_known(own, (key for known in scenes.values() for key in known), document, (CALIBRATE.name,))
        for number in self.spreads:
            if number not in own:
                values.append(1.0 if number.kind == GAIN else 100.0)
                continue
            path = (CALIBRATE.name, number.section, number.key)
            try:
                known = {nominal_value(number, settings.blades[blade], scenes[scene]) for blade, scene in self.pairs} - {None}
            except ValueError as error:
                raise document.refusal(str(error), "other numbers", *path) from None
            if len(known) != 1:
                which = f"{number.key} {'with several values' if known else 'that no measured blade or scene has'}"
                raise document.refusal(which, "a number with one value in what was measured", *path)
            values += [float(value) for value in known if value is not None]
        return values

    @property
    def budget(self) -> list[int]:
        """Number of designs of each round."""
        entry, last = self.section, self.section.runs - CONFIRMING
        return [entry.first, *(min(entry.batch, last - done) for done in range(entry.first, last, entry.batch)), CONFIRMING]

    def inputs(self) -> dict[str, list[str]]:
        """Files that the designs start from: lists, of each blade and scene."""
        files = [self.settings.made(Measured).inputs(Named(blade=blade, scene=scene)) for blade, scene in self.pairs]
        return {name: [each.get(name, each["model"]) for each in files] for name in sorted(set().union(*files))}

    def made_of(self, wildcards: Any) -> Any:
        """All that the designs follow from beside the files, as plain values."""
        scenes = [self.settings.scene_designs.entries[scene].model_dump() for _, scene in self.pairs]
        choices = [to_plain(self.settings.integration_choice(*pair)) for pair in self.pairs]
        spreads = {number.name: plain(spread) for number, spread in self.spreads.items()}
        measured = to_plain(self.settings.made(Measured).all)
        return [scenes, choices, measured, self.section.model_dump(), spreads, self.nominal]

    def changed(self, blade: str, scene: str, values: Mapping[VariedNumber, float]) -> tuple[BladeSettings, Scene]:
        """A blade and a scene with those of the values that they have. Raises ConfigError and ImpossibleValueError."""
        entry = self.settings.scene_designs.entries[scene]
        known = scene_numbers(entry)
        numbers = {number: value for number, value in values.items() if number.kind == BLADE or number.key in known}
        return changed_pair(self.settings.blades[blade], entry, numbers)
