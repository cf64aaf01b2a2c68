"""The plan of the tolerances: members of samples, each with runs of its own, and what is made of them together."""

from dataclasses import dataclass
from functools import cached_property

from r37core.base.varied_number import VariedNumber
from r37core.config import BladeSettings, Settings
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.extent import extent_of
from r37core.plans.member_values import is_of_sample
from r37core.plans.samples import NOMINAL, Member, Pair, Sample, Sampling, path_part
from r37core.plans.sweep_plan import Sweep

from .members import SECTION, Members, members_can_be_drawn, members_of
from .number_ranks import remarks_on_rankings

FOLDER = "tolerances"
"""Folder of the members' files: the extension's name."""

DATASET, TABLE = "<results>/tolerances.nc", "<results>/tolerances.csv"
RESPONSE_OF_MEMBER = paths.RESPONSE.replace("{member}", path_part(FOLDER, "{member}"))
_FIRST_ROUND = paths.ROUND.replace("{member}", path_part(FOLDER)).replace("{round}", "0")

_KEPT = ("spectrum", "stress", "static_stress", "fatigue")
"""Results of a scene that its members have, too: what ranges are read off."""


@dataclass(frozen=True)
class Tolerances:
    """Plan of the members that `settings` ask for, and of what is made of them."""

    settings: Settings

    @property
    def _members(self) -> Members:
        return members_of(self.settings)

    @cached_property
    def samples(self) -> dict[Pair, Sample]:
        """Members by blade and scene: those that alone decide on adaptive speeds, then those for sensitivity indices."""
        settings, models = self.settings, self._models
        return {
            (blade, scene): Sample(
                members={name: Member(of.blade, of.scene, models[blade][name]) for name, of in members.items()},
                deciding=[name for name in members if is_of_sample(name)],
                largest_share=settings.section(SECTION).largest_share,
                results=tuple(result for result in settings.results_of(blade, scene) if result in _KEPT),
            )
            for (blade, scene), members in self._members.all.items()
        }

    @property
    def _models(self) -> dict[str, dict[str, str]]:
        """Whose model each member has, by blade: of the first of those with the same blade, or the nominal one."""
        first: dict[str, dict[BladeSettings, str]] = {}
        models: dict[str, dict[str, str]] = {}
        for (blade, _), members in self._members.all.items():
            known = first.setdefault(blade, {self.settings.blades[blade].elastic: NOMINAL})
            for name, member in members.items():
                if name not in models.setdefault(blade, {}):
                    models[blade][name] = known.setdefault(member.blade.elastic, path_part(FOLDER, name))
        return models

    @property
    def runs(self) -> list[dict[str, str]]:
        """Blade, scene and member of all responses, in the order of the dataset."""
        every = self.samples.items()
        return [{"blade": blade, "scene": scene, "member": name} for (blade, scene), of in every for name in of.members]

    @property
    def runs_of_sample(self) -> list[dict[str, str]]:
        """Runs of the samples, without members for sensitivity indices alone."""
        return [run for run in self.runs if is_of_sample(run["member"])]

    @property
    def campbells_of_sample(self) -> list[str]:
        """The Campbell diagram of each of them."""
        models, runs = self._models, self.runs_of_sample
        return [paths.fill(paths.CAMPBELL, member=models[run["blade"]][run["member"]], blade=run["blade"]) for run in runs]

    @property
    def nominal(self) -> dict[str, list[str]]:
        """Responses and Campbell diagrams of the nominal runs."""
        pairs = self._members.pairs
        runs, blades = paths.run_keys(pairs), paths.of("blade", [blade for blade, _ in pairs])
        return {"nominal": paths.filled({paths.RESPONSE: runs}), "nominal_campbells": paths.filled({paths.CAMPBELL: blades})}

    @property
    def adaptive(self) -> paths.Wildcards:
        """Blades and scenes whose members share rounds of refinement."""
        return paths.run_keys(pair for pair in self._members.pairs if self.settings.speed_plans[pair].refined)

    @property
    def first_rounds(self) -> list[str]:
        """First rounds of the members and of the nominal runs beside them: as of Sweep."""
        nominal = [{**run, "round": "0"} for run in self.adaptive]
        return paths.filled({_FIRST_ROUND: self.adaptive, paths.ROUND: nominal})

    @property
    def numbers(self) -> list[str]:
        """Keys of the numbers that vary."""
        return [number.key for number in self._members.numbers]

    @property
    def values(self) -> list[list[float | None]]:
        """Values of each of the runs, in the units of the keys."""
        every = self._members.all
        return [list(every[run["blade"], run["scene"]][run["member"]].values) for run in self.runs]


def simulated(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The responses of the members, and first rounds where their speeds are adaptive."""
    planned = sweep.settings.made(Tolerances)
    return {RESPONSE_OF_MEMBER: planned.runs, _FIRST_ROUND: planned.adaptive}


def remarks(settings: Settings) -> list[str]:
    """How many members there are, and whether these rank the numbers."""
    members, entry = members_of(settings), settings.section(SECTION)
    if not members.pairs:
        return []
    most = extent_of(settings, {FOLDER: settings.made(Tolerances).samples}).members
    counted = f"tolerances: {entry.members} members, {most} simulations of theirs at most, beside those of the sweep"
    return [counted, *_without_width(members), *remarks_on_rankings(entry.members, len(members.numbers), entry.sensitivity)]


def _without_width(members: Members) -> list[str]:
    """Remarks on numbers that have one value in all members, and so no index."""
    values: dict[VariedNumber, set[float]] = {number: set() for number in members.numbers}
    for member in (member for of in members.all.values() for member in of.values()):
        for number, value in zip(members.numbers, member.values, strict=True):
            if value is not None:
                values[number].add(value)
    return [
        f"tolerances.{number.section}: {number.key} is {min(of):g} in all members, so it has no index; a wider tolerance "
        "gives it one"
        for number, of in values.items()
        if len(of) == 1
    ]


EXTENSION = Extension(
    name=FOLDER,
    section=SECTION,
    checks=(members_can_be_drawn,),
    sampling=Sampling(lambda settings: settings.made(Tolerances).samples, ranges=TABLE, dataset=DATASET),
    simulated=simulated,
    targets=lambda sweep: dict.fromkeys((DATASET, TABLE), [{}] if members_of(sweep.settings).pairs else []),
    remarks=remarks,
    figures=(
        Figure(
            rule="tolerance_figure",
            name="tolerances_{blade}__{scene}",
            runs=lambda sweep: paths.run_keys(members_of(sweep.settings).pairs),
            draw="tolerances.figures.draw_tolerances",
            files={"tolerances": DATASET, "nominal": paths.nominal(paths.RESPONSE)},
            label="tolerances",
            caption="Tolerances of blade {blade} in scene {scene}: median of all members, the band that nine tenths lie in, "
            "and the nominal run (dashed). Then the share of the members above yield, with the interval of the chance. Last, "
            "by how much each number moves three measures, with intervals: rank coefficients, and where asked for Sobol's "
            "total indices. Above the bars stands the place in the ranking; pale ones have none.",
        ),
    ),
    closing="tolerances.table.closing",
)
