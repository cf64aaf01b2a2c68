"""How large a run is: its simulations and what they cost. `r37 check`, the study `estimate` and the progress line say this."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from r37core.config import Settings
from r37core.config.speed_choice import most_runs

from .samples import Pair, Sample

_JOB_S = 0.07
"""CPU time (s) of a simulation beside its time integration: its process, results and file, and Snakemake's share."""


@dataclass(frozen=True)
class Extent:
    """Simulations of a sweep, `certain` ones and at `most` where speeds are adaptive, and at most so many of its `members`."""

    certain: int
    most: int
    members: int

    def __add__(self, other: Extent) -> Extent:
        return Extent(self.certain + other.certain, self.most + other.most, self.members + other.members)

    @property
    def at_most(self) -> int:
        """Simulations of the sweep and of its members, at most."""
        return self.most + self.members

    @property
    def wording(self) -> str:
        """Numbers, for a sentence about simulations."""
        sweep = str(self.certain) if self.most == self.certain else f"{self.certain} to about {self.most}"
        return f"{sweep}, and at most {self.members} of members" if self.members else sweep

    def cpu_time(self, per_run: float) -> str:
        """Time that they take at most, in words; `per_run`: CPU seconds of the time integration of one."""
        cost = self.at_most * (per_run + _JOB_S)
        return f"{cost:.3g} s" if cost < 120.0 else f"{cost / 60.0:.3g} minutes"


def extents(settings: Settings, beside: Mapping[str, Mapping[Pair, Sample]]) -> dict[Pair, Extent]:
    """The extent of each blade and scene, with the samples `beside` it (see Samples)."""
    pair_extents: dict[Pair, Extent] = {}
    for pair, plan in settings.speed_plans.items():
        several = [samples[pair] for samples in beside.values() if pair in samples]
        members = sum(len(sample.members) * plan.speed_count(sample.largest_share) for sample in several)
        pair_extents[pair] = Extent(len(plan.certain), most_runs(settings, *pair), members)
    return pair_extents


def extent_of(settings: Settings, beside: Mapping[str, Mapping[Pair, Sample]]) -> Extent:
    """The extent of a whole run."""
    return sum(extents(settings, beside).values(), Extent(0, 0, 0))
