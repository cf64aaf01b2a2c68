"""How large a run is: its simulations and what they cost. `r37 check`, the study `estimate` and the progress line say this."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from r37core.config import Settings
from r37core.config.settings import most_runs

Pair = tuple[str, str]
"""Blade and scene."""

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


def extents(settings: Settings, members: Mapping[Pair, int]) -> dict[Pair, Extent]:
    """The extent of each blade and scene; `members`: simulations of members there, at most."""
    return {
        pair: Extent(len(plan.certain), most_runs(settings, *pair), members.get(pair, 0))
        for pair, plan in settings.speed_plans.items()
    }


def extent_of(settings: Settings, members: Mapping[Pair, int]) -> Extent:
    """The extent of a whole run."""
    return sum(extents(settings, members).values(), Extent(0, 0, 0))
