"""The plan of the sweep: which simulations, from which files, and which results are wanted of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property, partial
from itertools import chain, count, takewhile
from pathlib import Path
from typing import Any

from r37core.config import Settings
from r37core.io import as_list, read_json, readable
from r37core.speeds import SpeedPlan

from . import paths
from .samples import Pair, Sample, Samples, folder_and_name, member_of, path_part

KINDS = ("rms", "spectrum", "stress", "wear", "casing")
"""Kinds of datasets over all blades and scenes; the first of every scene, the others of those that want them."""

MAPS = ("spectrum", "wear", "casing")
"""Kinds that are drawn as maps over speed."""


@dataclass(frozen=True)
class Sweep:
    """Plan of the sweep that `settings` ask for, and of samples `beside` it (see Samples).

    Methods with `wildcards` are inputs and parameters of rules. `round_file(member=..., blade=..., scene=..., round=...)`: file
    of a finished round of refinement; Snakemake's own exception for one that is still to be made. Without it adaptive speeds
    have no plan.
    """

    settings: Settings
    round_file: Callable[..., str] | None = None
    beside: Mapping[str, Mapping[Pair, Sample]] = field(default_factory=dict)

    @cached_property
    def samples(self) -> Samples:
        """All members that are run."""
        return Samples(self.settings, self.beside)

    def contact_model(self, wildcards: Any) -> str:
        """What the simulations of a blade and scene start from."""
        return self._of_model(wildcards, paths.CONTACT_MODEL)

    def models(self, wildcards: Any) -> list[str]:
        """What the simulations of a blade and scene start from, and the operator of the stress, where that is wanted."""
        return [self.contact_model(wildcards), *self.stress_operator(wildcards)]

    def stress_operator(self, wildcards: Any) -> list[str]:
        """The stress of a blade per motion, for a scene whose stress is wanted."""
        return [self._of_model(wildcards, paths.STRESS_OPERATOR)] if "stress" in self.results(wildcards) else []

    def _of_model(self, wildcards: Any, pattern: str) -> str:
        tip_line = self.settings.scenes[wildcards.scene].tip_line
        return paths.fill(pattern, member=self.samples.member(wildcards).model, blade=wildcards.blade, tip_line=tip_line)

    def nominal_stamp(self, wildcards: Any) -> list[str]:
        """What a member waits for: the nominal runs can be done, which else would be said once for every member."""
        where = {"blade": wildcards.blade, "scene": wildcards.scene}
        return [paths.fill(paths.INTEGRATION_STAMP, **where)] if wildcards.member else []

    def speed_files(self, wildcards: Any) -> list[str]:
        """The simulations of one blade and scene, by ascending speed: of all rounds, where its speeds are adaptive."""
        plan, rounds = self.speed_plan(wildcards), map(partial(self.new_speeds, wildcards), count())
        speeds = sorted(chain.from_iterable(takewhile(bool, rounds)) if plan.refined else plan.certain)
        return paths.speed_files(member_of(wildcards), wildcards, speeds)

    def new_speeds(self, wildcards: Any, number: int) -> list[float]:
        """Speeds (rad/s) that a round asked for: the same of all members of a sample."""
        assert self.round_file is not None
        member = path_part(folder_and_name(wildcards)[0])
        file = self.round_file(member=member, blade=wildcards.blade, scene=wildcards.scene, round=number)
        return speeds_of_round(file, self.speed_plan(wildcards))

    def yield_stress(self, wildcards: Any) -> float:
        """Of a blade (Pa)."""
        return self.samples.member(wildcards).blade.yield_stress

    def speed_plan(self, wildcards: Any) -> SpeedPlan:
        """Speeds of one blade and scene."""
        return self.settings.speed_plans[wildcards.blade, wildcards.scene]

    def speeds(self, wildcards: Any, input: Any) -> list[float]:
        """Speeds (rad/s), ascending, of the files that are an input; a round stands there until the rounds are done."""
        names = [Path(file).stem for file in as_list(input.speeds)]
        return [float(name.removeprefix("speed_")) for name in names if name.startswith("speed_")]

    def results(self, wildcards: Any) -> tuple[str, ...]:
        """What is wanted of a blade and scene."""
        return self.samples.sample(wildcards).results

    def stress_history_speeds(self, wildcards: Any) -> tuple[float, ...]:
        """Speeds (rad/s) of a blade and scene whose stress is kept for every revolution."""
        return self.samples.sample(wildcards).history_speeds

    @property
    def kinds(self) -> list[str]:
        """Kinds of datasets that this run ends in."""
        return [kind for kind in KINDS if self.runs_with(kind)]

    def runs_with(self, kind: str) -> list[tuple[str, str]]:
        """Pairs of blade and scene that have this kind of result."""
        pairs = [(blade, scene) for blade in self.settings.blades for scene in self.settings.scenes]
        return [pair for pair in pairs if kind == KINDS[0] or kind in self.settings.results_of(*pair)]


def speeds_of_round(file: str, plan: SpeedPlan | None = None) -> list[float]:
    """Speeds (rad/s) that a round asked for, of those that its `plan` may ask for.

    Each member of a sample asks: the file is read once as long as it is the same. Raises InputFileError for a damaged one.
    """
    return _speeds_of_round(file, Path(file).stat().st_mtime_ns, plan)


@cache
def _speeds_of_round(file: str, _time: int, plan: SpeedPlan | None) -> list[float]:
    content = read_json(file)
    with readable(file):
        speeds = [float(speed) for speed in content["new"]]
        if strange := set() if plan is None else set(speeds).difference(_all_of(plan)):
            raise ValueError(f"it asks for {min(strange):.9g} rad/s, which is no speed of the configuration")
        return speeds


@cache
def _all_of(plan: SpeedPlan) -> frozenset[float]:
    return frozenset(plan.every_speed())
