"""Members of a sample: a blade and a scene with other values of the numbers under `tolerances`."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from r37core.config import BladeSettings, ConfigError, Settings, blades_named, scenes_named
from r37core.config.changed_numbers import (
    BLADE_KEYS,
    ImpossibleValueError,
    blade_number,
    changed_blade,
    changed_scene,
    scene_numbers,
)
from r37core.config.cross_checks import LARGEST_NUMBER_OF_SIMULATIONS, names_are_there
from r37core.config.messages import single_line
from r37core.contact.scene import Scene
from r37core.plans.member_values import drawn, is_of_sample, number_of, sobol_points

from .section import SECTION

T = TypeVar("T")


@dataclass(frozen=True)
class Member:
    """Member of a sample. `values`: of each number in its key's unit; None for one that the blade or scene does not have."""

    blade: BladeSettings
    scene: Scene
    values: tuple[float | None, ...]


class Members:
    """The members of all blades and scenes that have tolerances. `numbers`: section and key of each -> its tolerance."""

    def __init__(self, settings: Settings):
        self._settings, self._entry = settings, settings.section(SECTION)
        self.numbers = self._entry.spreads

    @cached_property
    def pairs(self) -> list[tuple[str, str]]:
        """Blades and scenes that have members, in the order of the run: those that have some of the numbers.

        Raises ConfigError where numbers are given and no blade and scene that is run has any of them.
        """
        settings, nominals = self._settings, self._nominals
        pairs = [pair for pair, nominal in nominals.items() if any(value is not None for value in nominal)]
        # a part of the blades may have none
        if self.numbers and not pairs and settings.config.run.part is None:
            named, (blades, scenes) = ", ".join(key for _, key in self.numbers), self._chosen
            run = f"{', '.join(blades)} in {', '.join(scenes)}"
            raise self._refusal((), f"none of its numbers ({named}) in {run}", "blades and scenes that are run and have some")
        return pairs

    @property
    def _chosen(self) -> tuple[list[str], list[str]]:
        """Blades and scenes that are to have members."""
        settings, entry = self._settings, self._entry
        return blades_named(settings, entry.blades), scenes_named(settings, entry.scenes)

    @cached_property
    def _nominals(self) -> dict[tuple[str, str], list[float | None]]:
        """Value without tolerance of each number, for each of the chosen blades and scenes that are run."""
        if not self.numbers:
            return {}
        blades, scenes = self._chosen
        pairs = [pair for pair in self._settings.speed_plans if pair[0] in blades and pair[1] in scenes]
        return {pair: [self._nominal(*number, *pair) for number in self.numbers] for pair in pairs}

    @cached_property
    def _scene_numbers(self) -> dict[str, dict[str, float]]:
        """Numbers of the scenes that are run, by dotted key."""
        return {name: scene_numbers(self._settings.scene_designs.entries[name]) for name in self._settings.scene_names}

    @cached_property
    def all(self) -> dict[tuple[str, str], dict[str, Member]]:
        """Members by blade and scene, by name: the sample, and what sensitivity indices need beside it.

        Raises ConfigError for a number that is not there, and for a value that is impossible.
        """
        return {pair: self._run_members(*pair) for pair in self.pairs}

    @cached_property
    def _points(self) -> dict[str, tuple[float, ...]]:
        return sobol_points(len(self.numbers), self._entry.members, self._entry.seed)

    def _run_members(self, blade: str, scene: str) -> dict[str, Member]:
        nominal = self._nominals[blade, scene]
        self._check_ends(blade, scene, nominal)
        varied = (number for number, value in enumerate(nominal) if value is not None)
        beside = (None, *varied) if self._entry.sensitivity else ()
        wanted = [name for name in self._points if is_of_sample(name) or number_of(name) in beside]
        return {name: self._member(name, blade, scene, nominal) for name in wanted}

    def _check_ends(self, blade: str, scene: str, nominal: Sequence[float | None]) -> None:
        """Every value that a bounded number can take at most is possible: more members then meet nothing new."""
        for ((section, key), tolerance), value in zip(self.numbers.items(), nominal, strict=True):
            for end in tolerance.ends(value) if value is not None else ():
                self._changed(blade, scene, {(section, key): end}, f"the end of its range of {blade} in {scene}")

    def _nominal(self, section: str, key: str, blade: str, scene: str) -> float | None:
        """Value without tolerance; None where the blade or the scene has no such number."""
        path = (section, key)
        if section == "of_blades":
            if key not in BLADE_KEYS:
                raise self._refusal(path, single_line(key), f"one of {', '.join(BLADE_KEYS)}")
            entry = self._settings.blades[blade]
            try:
                nominal = blade_number(entry, key)
            except ValueError as error:
                raise self._refusal(path, str(error), "blades with a table of sweep and lean, or none") from None
        else:
            known = list(dict.fromkeys(key for numbers in self._scene_numbers.values() for key in numbers))
            if key not in known:
                allowed = f"a number of the scenes that are run, by its dotted key: {', '.join(known)}"
                raise self._refusal(path, single_line(key), allowed)
            nominal = self._scene_numbers[scene].get(key)
        if nominal == 0.0 and self.numbers[path].percent:
            raise self._refusal(path, f"percent of {key}, which is 0", "uniform, normal, between or values")
        return nominal

    def _member(self, name: str, blade: str, scene: str, nominal: Sequence[float | None]) -> Member:
        values = drawn(self.numbers.values(), nominal, self._points[name])
        changes = {number: value for number, value in zip(self.numbers, values, strict=True) if value is not None}
        return Member(*self._changed(blade, scene, changes, f"member {name} of {blade} in {scene}"), values)

    def _changed(
        self, blade: str, scene: str, values: Mapping[tuple[str, str], float], who: str
    ) -> tuple[BladeSettings, Scene]:
        """A blade and a scene with other values of some numbers."""
        settings = self._settings
        blade_changes, scene_changes = (
            {key: value for (section, key), value in values.items() if section == wanted}
            for wanted in ("of_blades", "of_scenes")
        )
        return (
            self._possible("of_blades", who, lambda: changed_blade(settings.blades[blade], blade_changes)),
            self._possible("of_scenes", who, lambda: changed_scene(settings.scene_designs.entries[scene], scene_changes)),
        )

    def _possible(self, section: str, who: str, change: Callable[[], T]) -> T:
        try:
            return change()
        except ImpossibleValueError as error:
            known = (section, error.key) in self.numbers
            path, text = (error.key,) if known else (), str(error) if known else f"{error.key}: {error}"
            path_of_key = ("tolerances", section, *path)
            raise self._settings.documents.config.error(path_of_key, f"{who}: {text}; or a narrower tolerance") from None

    def _refusal(self, path: tuple[str, ...], value: str, allowed: str) -> ConfigError:
        return self._settings.documents.config.refusal(("tolerances", *path), value, allowed)


def members_of(settings: Settings) -> Members:
    """Members that the settings ask for, drawn once."""
    return settings.made(Members)


def members_can_be_drawn(settings: Settings) -> None:
    """Tolerances name blades, scenes and numbers that are there, no member is impossible, and all can be planned."""
    entry, documents, path = settings.section(SECTION), settings.documents, ("tolerances",)
    names_are_there(settings, path, entry)
    # the configuration that a run keeps has the empty section written out
    if entry != type(entry)() and not members_of(settings).numbers:
        raise documents.config.refusal(path, "no numbers", "some under of_scenes or of_blades")
    members = entry.members * (len(members_of(settings).numbers) + 2 if entry.sensitivity else 1)
    number = members * sum(len(settings.speed_plans[pair].certain) for pair in members_of(settings).pairs)
    if number > LARGEST_NUMBER_OF_SIMULATIONS:
        raise documents.config.refusal(
            (*path, "members"),
            f"{number} simulations of members",
            f"at most {LARGEST_NUMBER_OF_SIMULATIONS} in one run: fewer members, speeds, blades or scenes, or no sensitivity",
        )
    # draws them, and refuses what is impossible
    _ = members_of(settings).all
