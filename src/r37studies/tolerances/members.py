"""tolerances of config.yaml, and members of a sample: blades and scenes with other values of some numbers, run by one job."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from r37core.base.io import TextFileError, read_text
from r37core.base.plain import to_plain
from r37core.base.varied_number import VariedNumber
from r37core.blade.definition import Shape
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import number_rows
from r37core.config import BladeSettings, ConfigError, Settings, blades_named, scenes_named, varied_settings
from r37core.config.changed_numbers import ImpossibleValueError, changed_pair, check_known, nominal_value, scene_numbers
from r37core.config.cross_checks import LARGEST_NUMBER_OF_SIMULATIONS, names_are_there
from r37core.config.section import AllOrNames, ExtensionSection, FileName, LeftOut, left_out, option
from r37core.config.spread import MemberCount, SpreadEntry, Spreads
from r37core.contact.scene import Scene
from r37core.plans import paths
from r37core.plans.extent import Pair, Runs
from r37core.plans.provenance import Attributes
from r37core.plans.sweep_plan import Sweep
from r37core.sweep.blade_sweep import CAMPBELL, blade_sweep, shared_speeds
from r37studies.member_values import drawn, sobol_points


class ToleranceSection(Spreads):
    """Distributions of numbers, and the sample drawn from them; both may be empty."""

    members: MemberCount = option("Number of members, a power of two; a larger sample contains the smaller ones", 32)
    seed: int = option("Seed of the sample", 0, ge=0, le=2**31)
    drawn_file: FileName | LeftOut = left_out(
        "Values of members (CSV) by names such as scene.damping_ratio, in place of distributions: members.csv of a calibration"
    )
    blades: AllOrNames = option("Blades with tolerances", "all")
    scenes: AllOrNames = option("Scenes with tolerances", "all")
    largest_share: float = option("Largest share of the finest grid of adaptive speeds that a member runs", 0.2, ge=1e-3, le=1)


SECTION = ExtensionSection("tolerances", ToleranceSection, ToleranceSection())

_KEPT = ("spectrum", "stress", "static_stress", "fatigue")
"""Results of a scene that its members have, too: what ranges are read off."""


@dataclass(frozen=True)
class Member:
    """Member of a sample. `values`: of each number in its key's unit; None for one that the blade or scene does not have."""

    blade: BladeSettings
    scene: Scene
    values: tuple[float | None, ...]


class Tolerances:
    """Members of all blades and scenes of `settings` that have tolerances; methods with `wildcards` as of Sweep.

    `numbers`: each with its tolerance.
    """

    def __init__(self, settings: Settings):
        self.settings, self._entry = settings, settings.section(SECTION)
        self.numbers = self._drawn() if self._entry.drawn_file else self._entry.spreads

    def _drawn(self) -> dict[VariedNumber, SpreadEntry]:
        """Values of each number in the file, a row for each member. Raises ConfigError."""
        path, file, members = ("drawn_file",), self.settings.root / str(self._entry.drawn_file), self._entry.members
        if self._entry.spreads:
            raise self._refusal(path, "distributions beside it", "one of them")
        try:
            rows = number_rows(read_text(file))
        except (OSError, TextFileError, BladeShapeError) as error:
            raise self._error(path, f"{file}: {error}; allowed: a CSV with a number in each field") from None
        if len(rows) < members:
            raise self._refusal(path, f"{len(rows)} rows in {file}", f"{members} or more, one for each member")
        # evenly over the rows, whose first ones a calibration finds most likely
        kept = [rows[place * len(rows) // members] for place in range(members)]
        # joined as they were drawn: several members may share a value
        return {VariedNumber.named(name): SpreadEntry.model_construct(values=[row[name] for row in kept]) for name in rows[0]}

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Blades and scenes that have members, in the order of the run: those that have some of the numbers.

        Raises ConfigError where numbers are given and no blade and scene that is run has any of them.
        """
        return list(self._nominals)

    @cached_property
    def _nominals(self) -> dict[tuple[str, str], list[float | None]]:
        """Value without tolerance of each number, for each of the `pairs`."""
        settings, entry = self.settings, self._entry
        if not self.numbers:
            return {}
        blades, scenes = blades_named(settings, entry.blades), scenes_named(settings, entry.scenes)
        known = {name: scene_numbers(settings.scene_designs.entries[name]) for name in settings.scene_names}
        keys = (key for numbers in known.values() for key in numbers)
        check_known(self.numbers, keys, settings.document, (SECTION.name,))
        nominals = {
            (blade, scene): [self._nominal(number, blade, known[scene]) for number in self.numbers]
            for blade, scene in settings.speed_plans
            if blade in blades and scene in scenes
        }
        if having := {pair: values for pair, values in nominals.items() if {*values} != {None}}:
            return having
        named, run = ", ".join(number.key for number in self.numbers), f"{', '.join(blades)} in {', '.join(scenes)}"
        raise self._refusal((), f"none of its numbers ({named}) in {run}", "blades and scenes that are run and have some")

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

    def _nominal(self, number: VariedNumber, blade: str, scene: Mapping[str, float]) -> float | None:
        """Value without tolerance; None where the blade or the scene, of these numbers, has no such number."""
        path, known = (number.section, number.key), self.settings.blades[blade]
        try:
            nominal = nominal_value(number, known, scene)
        except ValueError as error:
            raise self._refusal(path, str(error), "blades with a table of sweep and lean, or none") from None
        if nominal == 0.0 and self.numbers[number].percent:
            raise self._refusal(path, f"percent of {number.key}, which is 0", "uniform, normal, between or values")
        return nominal

    def _changed(self, blade: str, scene: str, values: Mapping[VariedNumber, float], who: str) -> tuple[BladeSettings, Scene]:
        """A blade and a scene with other values of some numbers."""
        settings = self.settings
        try:
            return changed_pair(settings.blades[blade], settings.scene_designs.entries[scene], values)
        except ImpossibleValueError as error:
            path, text = error.place(self.numbers)
            raise self._error(path, f"{who}: {text}; or a narrower tolerance") from None

    def _error(self, path: tuple[str, ...], text: str) -> ConfigError:
        return self.settings.document.error((SECTION.name, *path), text)

    def _refusal(self, path: tuple[str, ...], value: str, allowed: str) -> ConfigError:
        return self._error(path, f"found {value}; allowed: {allowed}")

    def _varied(self, wildcards: Any) -> Iterator[tuple[str, Member, Settings]]:
        """Name of each member of a blade and scene, the member, and the settings with its blade and scene."""
        settings, blade, scene = self.settings, wildcards.blade, wildcards.scene
        results = tuple(result for result in settings.results_of(blade, scene) if result in _KEPT)
        chosen = replace(settings.scenes[scene], results=results, stress_history_speeds=())
        first: dict[BladeSettings, str] = {}
        for name, member in self.all[blade, scene].items():
            # members with the same blade have one model
            own, shape = member.blade, member.blade.definition
            if isinstance(shape, Shape):
                message_name = f"{blade}, member {first.setdefault(own.elastic, name)} of {SECTION.name}"
                own = replace(own, definition=shape.replaced(name=message_name))
            yield name, member, varied_settings(settings, {blade: own}, {scene: replace(chosen, scene=member.scene)})

    def sweeps(self, wildcards: Any) -> dict[str, Any]:
        """Sweep of each member, as plain values. For the nominal blade all files are existing ones, those of the job's inputs.

        The parameter is no function of the inputs, because Snakemake would not compare it then.
        """
        nominal, run = self.settings.blades[wildcards.blade].elastic, (wildcards.blade, wildcards.scene)
        files = dict.fromkeys(("contact_model", "stress_operator", CAMPBELL), "")
        return {
            name: to_plain(blade_sweep(varied, *run, existing=files if member.blade.elastic == nominal else {}, kept=False))
            for name, member, varied in self._varied(wildcards)
        }

    def about(self, wildcards: Any) -> Attributes:
        """Attributes of the files of each member, as JSON."""
        varied = ((name, Sweep(settings).provenance(wildcards)) for name, _, settings in self._varied(wildcards))
        return Attributes({name: str(Attributes(made, member=name)) for name, made in varied})

    def speeds(self, wildcards: Any) -> dict[str, Any]:
        """Speeds of all members of a blade and scene, as plain values."""
        return to_plain(shared_speeds(self.settings, wildcards.blade, wildcards.scene, self._entry.largest_share))

    @property
    def runs(self) -> dict[Pair, Runs]:
        """Simulations of members, by blade and scene."""
        entry, plans = self._entry, {pair: self.settings.speed_plans[pair] for pair in self.pairs}
        models = entry.members if entry.of_blades else 0
        return {
            pair: Runs(entry.members * plan.speed_count(entry.largest_share), entry.members * len(plan.certain), models=models)
            for pair, plan in plans.items()
        }

    @property
    def samples(self) -> list[tuple[str, str, dict[str, list[float | None]]]]:
        """Blade, scene, and the values of each of its members in the units of the keys, in the order of the dataset."""
        every = self.all.items()
        return [(*pair, {name: list(member.values) for name, member in members.items()}) for pair, members in every]

    @property
    def nominal(self) -> dict[str, list[str]]:
        """Responses and Campbell diagrams of the nominal runs."""
        runs, blades = paths.run_keys(self.pairs), paths.of("blade", [blade for blade, _ in self.pairs])
        return {"nominal": paths.filled({paths.RESPONSE: runs}), "nominal_campbells": paths.filled({paths.CAMPBELL: blades})}

    @property
    def first_rounds(self) -> list[str]:
        """First rounds of the nominal runs: as of Sweep."""
        adaptive = paths.run_keys(pair for pair in self.pairs if self.settings.speed_plans[pair].refined)
        return paths.filled({paths.ROUND: [{**run, "round": "0"} for run in adaptive]})


def members_can_be_drawn(settings: Settings) -> None:
    """Tolerances name blades, scenes and numbers that are there, no member is impossible, and all can be planned."""
    entry, document, path = settings.section(SECTION), settings.document, (SECTION.name,)
    names_are_there(settings, path, entry)
    tolerances = settings.made(Tolerances)
    # the configuration that a run keeps has the empty section written out
    if entry != type(entry)() and not tolerances.numbers:
        raise document.refusal("no numbers", "some under of_scenes or of_blades", *path)
    number = entry.members * sum(len(settings.speed_plans[pair].certain) for pair in tolerances.pairs)
    if number > LARGEST_NUMBER_OF_SIMULATIONS:
        raise document.refusal(
            f"{number} simulations of members",
            f"at most {LARGEST_NUMBER_OF_SIMULATIONS} in one run: fewer members, speeds, blades or scenes",
            *path,
            "members",
        )
    # draws them, and refuses what is impossible
    _ = tolerances.all
