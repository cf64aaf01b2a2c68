"""The plan of the tolerances: members of each blade and scene, run by one job, and what is made of them together."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from r37core.base.plain import to_plain
from r37core.base.varied_number import VariedNumber
from r37core.blade.definition import Shape
from r37core.config import BladeSettings, Settings, varied_settings
from r37core.plans import paths
from r37core.plans.extension import AddedColumns, Extension, Figure
from r37core.plans.extent import Pair, extent_of
from r37core.plans.provenance import Attributes
from r37core.plans.sweep_plan import Sweep
from r37core.sweep.blade_sweep import CAMPBELL, blade_sweep, shared_speeds
from r37core.sweep.recipe import structure_attributes

from .members import SECTION, Member, Members, members_can_be_drawn, members_of
from .number_ranks import remarks_on_rankings
from .ranges import MEMBERS_SHOWING

FOLDER = "tolerances"
"""Folder of the members' files: the extension's name."""

DATASET, TABLE = "<results>/tolerances.nc", "<results>/tolerances.csv"
MEMBERS = "<results>/tolerances/{blade}/{scene}/members.nc"
"""Responses and Campbell diagrams of the members of a blade and scene; the folder has the parts that they are made of."""

_KEPT = ("spectrum", "stress", "static_stress", "fatigue")
"""Results of a scene that its members have, too: what ranges are read off."""


@dataclass(frozen=True)
class Tolerances:
    """Plan of the members that `settings` ask for, and of what is made of them; methods with `wildcards` as of Sweep."""

    settings: Settings

    @property
    def sample(self) -> Members:
        """The members."""
        return members_of(self.settings)

    def _varied(self, wildcards: Any) -> Iterator[tuple[str, Member, Settings]]:
        """Name of each member of a blade and scene, the member, and the settings with its blade and scene."""
        settings, blade, scene = self.settings, wildcards.blade, wildcards.scene
        results = tuple(result for result in settings.results_of(blade, scene) if result in _KEPT)
        chosen = replace(settings.scenes[scene], results=results, stress_history_speeds=())
        first: dict[BladeSettings, str] = {}
        for name, member in self.sample.all[blade, scene].items():
            # members with the same blade have one model
            own, shape = member.blade, member.blade.definition
            if isinstance(shape, Shape):
                message_name = f"{blade}, member {first.setdefault(own.elastic, name)} of {FOLDER}"
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

    def structure(self, wildcards: Any) -> Attributes:
        """Parameters of the models of members that are for messages."""
        return structure_attributes(self.settings, wildcards.blade)

    def speeds(self, wildcards: Any) -> dict[str, Any]:
        """Speeds of all members of a blade and scene, as plain values."""
        share = self.settings.section(SECTION).largest_share
        return to_plain(shared_speeds(self.settings, wildcards.blade, wildcards.scene, share))

    @property
    def simulations(self) -> dict[Pair, int]:
        """Largest number of simulations of members, by blade and scene."""
        share, plans = self.settings.section(SECTION).largest_share, self.settings.speed_plans
        return {pair: len(members) * plans[pair].speed_count(share) for pair, members in self.sample.all.items()}

    @property
    def samples(self) -> list[tuple[str, str, dict[str, list[float | None]]]]:
        """Blade, scene, and the values of each of its members in the units of the keys, in the order of the dataset."""
        every = self.sample.all.items()
        return [(*pair, {name: list(member.values) for name, member in members.items()}) for pair, members in every]

    @property
    def nominal(self) -> dict[str, list[str]]:
        """Responses and Campbell diagrams of the nominal runs."""
        runs, blades = paths.run_keys(self.sample.pairs), paths.of("blade", [blade for blade, _ in self.sample.pairs])
        return {"nominal": paths.filled({paths.RESPONSE: runs}), "nominal_campbells": paths.filled({paths.CAMPBELL: blades})}

    @property
    def first_rounds(self) -> list[str]:
        """First rounds of the nominal runs: as of Sweep."""
        adaptive = paths.run_keys(pair for pair in self.sample.pairs if self.settings.speed_plans[pair].refined)
        return paths.filled({paths.ROUND: [{**run, "round": "0"} for run in adaptive]})


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The members of each blade and scene, and what is made of them."""
    pairs = members_of(sweep.settings).pairs
    return {MEMBERS: paths.run_keys(pairs), **dict.fromkeys((DATASET, TABLE), [{}] if pairs else [])}


def remarks(settings: Settings) -> list[str]:
    """How many members there are, and whether these rank the numbers."""
    members, entry = members_of(settings), settings.section(SECTION)
    if not members.pairs:
        return []
    most = extent_of(settings, settings.made(Tolerances).simulations).members
    counted = f"tolerances: {entry.members} members, {most} simulations of theirs at most, beside those of the sweep"
    return [counted, *_without_width(members), *remarks_on_rankings(entry.members, len(members.numbers))]


def _without_width(members: Members) -> list[str]:
    """Remarks on numbers that have one value in all members, and so no rank."""
    values: dict[VariedNumber, set[float]] = {number: set() for number in members.numbers}
    for member in (member for of in members.all.values() for member in of.values()):
        for number, value in zip(members.numbers, member.values, strict=True):
            if value is not None:
                values[number].add(value)
    return [
        f"tolerances.{number.section}: {number.key} is {min(of):g} in all members, so it is not ranked; a wider tolerance "
        "lets it be"
        for number, of in values.items()
        if len(of) == 1
    ]


EXTENSION = Extension(
    name=FOLDER,
    section=SECTION,
    checks=(members_can_be_drawn,),
    members=lambda settings: settings.made(Tolerances).simulations,
    targets=targets,
    columns=(AddedColumns("summary", TABLE, "r37studies.tolerances.ranges.ranged_summary", MEMBERS_SHOWING),),
    offers={"members": DATASET},
    remarks=remarks,
    figures=(
        Figure(
            rule="tolerance_figure",
            name="tolerances_{blade}__{scene}",
            runs=lambda sweep: paths.run_keys(members_of(sweep.settings).pairs),
            draw="r37studies.tolerances.figures.draw_tolerances",
            files={"tolerances": DATASET, "nominal": paths.RESPONSE},
            label="tolerances",
            caption="Tolerances of blade {blade} in scene {scene}: median of all members, the band that nine tenths lie in, "
            "and the nominal run (dashed). Then the share of the members above yield, with the interval of the chance. Last, "
            "by how much each number moves three measures, with intervals: rank coefficients. Above the "
            "bars stands the place in the ranking; pale ones have none.",
        ),
    ),
    closing="r37studies.tolerances.table.closing",
)
