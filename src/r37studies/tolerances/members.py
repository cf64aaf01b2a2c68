"""tolerances of config.yaml, and members of a sample: a blade and a scene with other values of the numbers under tolerances."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from pydantic import Field

from r37core.base.varied_number import VariedNumber
from r37core.config import BladeSettings, ConfigError, Settings, blades_named, scenes_named
from r37core.config.changed_numbers import ImpossibleValueError, changed_pair, check_known, nominal_value, scene_numbers
from r37core.config.cross_checks import LARGEST_NUMBER_OF_SIMULATIONS, names_are_there
from r37core.config.section import AllOrNames, ExtensionSection, FileName, LeftOut, left_out
from r37core.config.spread import MemberCount, SpreadEntry, Spreads
from r37core.contact.scene import Scene
from r37studies.member_values import drawn, sobol_points


class ToleranceSection(Spreads):
    """Distributions of numbers, and the sample drawn from them; both may be empty."""

    members: MemberCount = Field(
        default=32, description="Number of members, a power of two; a larger sample contains the smaller ones"
    )
    seed: int = Field(default=0, ge=0, le=2**31, description="Seed of the sample")
    drawn_file: FileName | LeftOut = left_out(
        "Values of members (CSV) by names such as scene.damping_ratio, in place of distributions: members.csv of a calibration"
    )
    blades: AllOrNames = Field(default="all", description="Blades with tolerances")
    scenes: AllOrNames = Field(default="all", description="Scenes with tolerances")
    largest_share: float = Field(
        default=0.2, ge=1e-3, le=1, description="Largest share of the finest grid of adaptive speeds that a member runs"
    )


SECTION = ExtensionSection("tolerances", ToleranceSection, ToleranceSection())


@dataclass(frozen=True)
class Member:
    """Member of a sample. `values`: of each number in its key's unit; None for one that the blade or scene does not have."""

    blade: BladeSettings
    scene: Scene
    values: tuple[float | None, ...]


class Members:
    """The members of all blades and scenes that have tolerances. `numbers`: each with its tolerance."""

    def __init__(self, settings: Settings):
        self._settings, self._entry = settings, settings.section(SECTION)
        self.numbers = self._drawn() if self._entry.drawn_file else self._entry.spreads

    def _drawn(self) -> dict[VariedNumber, SpreadEntry]:
        """Values of each number in the file, a row for each member. Raises ConfigError."""
        document, path = self._settings.documents.config, (SECTION.name, "drawn_file")
        file, members = self._settings.root / str(self._entry.drawn_file), self._entry.members
        if self._entry.spreads:
            raise document.refusal(path, "distributions beside it", "one of them")
        try:
            with open(file, newline="", encoding="utf-8") as stream:
                rows = [{str(name): float(value) for name, value in row.items()} for row in csv.DictReader(stream)]
        except (OSError, ValueError, TypeError) as error:
            raise document.error(path, f"{file}: {error}; allowed: a CSV with a number in each field") from None
        if len(rows) < members:
            raise document.refusal(path, f"{len(rows)} rows in {file}", f"{members} or more, one for each member")
        # evenly over the rows, whose first ones a calibration finds most likely
        kept = [rows[place * len(rows) // members] for place in range(members)]
        # joined as they were drawn: several members may share a value
        return {VariedNumber.named(name): SpreadEntry.model_construct(values=[row[name] for row in kept]) for name in rows[0]}

    @cached_property
    def pairs(self) -> list[tuple[str, str]]:
        """Blades and scenes that have members, in the order of the run: those that have some of the numbers.

        Raises ConfigError where numbers are given and no blade and scene that is run has any of them.
        """
        pairs = [pair for pair, nominal in self._nominals.items() if any(value is not None for value in nominal)]
        if self.numbers and not pairs:
            named, (blades, scenes) = ", ".join(number.key for number in self.numbers), self._chosen
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
        keys = (key for numbers in self._scene_numbers.values() for key in numbers)
        check_known(self.numbers, keys, self._settings.documents.config, (SECTION.name,))
        return {pair: [self._nominal(number, *pair) for number in self.numbers] for pair in pairs}

    @cached_property
    def _scene_numbers(self) -> dict[str, dict[str, float]]:
        """Numbers of the scenes that are run, by dotted key."""
        return {name: scene_numbers(self._settings.scene_designs.entries[name]) for name in self._settings.scene_names}

    @cached_property
    def all(self) -> dict[tuple[str, str], dict[str, Member]]:
        """Members by blade and scene, by name.

        Raises ConfigError for a number that is not there, and for a value that is impossible.
        """
        count = self._entry.members
        points = sobol_points(len(self.numbers), count, self._entry.seed) if self.pairs else {}
        if self._entry.drawn_file:
            # the place of each member's row
            points = {name: ((int(name) + 0.5) / count,) * len(self.numbers) for name in points}
        return {pair: self._run_members(*pair, points) for pair in self.pairs}

    def _run_members(self, blade: str, scene: str, points: Mapping[str, Sequence[float]]) -> dict[str, Member]:
        nominal, members = self._nominals[blade, scene], {}
        # every value that a bounded number can take at most is possible: more members then meet nothing new
        for (number, tolerance), value in zip(self.numbers.items(), nominal, strict=True):
            for end in tolerance.ends(value) if value is not None else ():
                self._changed(blade, scene, {number: end}, f"the end of its range of {blade} in {scene}")
        for name, point in points.items():
            values = drawn(self.numbers, nominal, point)
            changed = self._changed(blade, scene, values, f"member {name} of {blade} in {scene}")
            members[name] = Member(*changed, tuple(map(values.get, self.numbers)))
        return members

    def _nominal(self, number: VariedNumber, blade: str, scene: str) -> float | None:
        """Value without tolerance; None where the blade or the scene has no such number."""
        path, run = (number.section, number.key), (self._settings.blades[blade], self._scene_numbers[scene])
        try:
            nominal = nominal_value(number, *run)
        except ValueError as error:
            raise self._refusal(path, str(error), "blades with a table of sweep and lean, or none") from None
        if nominal == 0.0 and self.numbers[number].percent:
            raise self._refusal(path, f"percent of {number.key}, which is 0", "uniform, normal, between or values")
        return nominal

    def _changed(self, blade: str, scene: str, values: Mapping[VariedNumber, float], who: str) -> tuple[BladeSettings, Scene]:
        """A blade and a scene with other values of some numbers."""
        settings = self._settings
        try:
            return changed_pair(settings.blades[blade], settings.scene_designs.entries[scene], values)
        except ImpossibleValueError as error:
            path, text = error.place(self.numbers)
            raise settings.documents.config.error((SECTION.name, *path), f"{who}: {text}; or a narrower tolerance") from None

    def _refusal(self, path: tuple[str, ...], value: str, allowed: str) -> ConfigError:
        return self._settings.documents.config.refusal((SECTION.name, *path), value, allowed)


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
    number = entry.members * sum(len(settings.speed_plans[pair].certain) for pair in members_of(settings).pairs)
    if number > LARGEST_NUMBER_OF_SIMULATIONS:
        raise documents.config.refusal(
            (*path, "members"),
            f"{number} simulations of members",
            f"at most {LARGEST_NUMBER_OF_SIMULATIONS} in one run: fewer members, speeds, blades or scenes",
        )
    # draws them, and refuses what is impossible
    _ = members_of(settings).all
