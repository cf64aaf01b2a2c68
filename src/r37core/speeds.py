"""Speeds to simulate: numbers and ranges, joined, some of which refine themselves; and how a speed stands in file names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

LARGEST_NUMBER = 100_000
"""Speeds of one blade in one scene."""


class SpeedError(ValueError):
    """Speeds that cannot be used together."""


@dataclass(frozen=True)
class RefinedRange:
    """Speeds (rad/s) that refine themselves: `coarse` intervals of the grid start, start + refine_to, ... up to `last` of them.

    All numbers but start and refine_to count intervals of the grid, so that a speed is the same number in whichever round it
    is asked for.
    """

    start: float
    refine_to: float
    coarse: int
    last: int

    def speed(self, place: int) -> float:
        """The speed at a place of the grid, from 0 to `last`."""
        # rounded, so that a step like 0.1 gives the numbers a user would write
        return round(self.start + place * self.refine_to, 9)

    def coarse_places(self) -> list[int]:
        """Places of the grid that are run whatever is found there."""
        places = list(range(0, self.last + 1, self.coarse))
        return places if places[-1] == self.last else [*places, self.last]

    def every_speed(self) -> list[float]:
        """All speeds of the grid."""
        return [self.speed(place) for place in range(self.last + 1)]


@dataclass(frozen=True)
class SpeedPlan:
    """What a list of speeds asks for: `certain` speeds (rad/s), ascending, and ranges that refine themselves.

    The coarse speeds of the ranges are among the certain ones.
    """

    certain: tuple[float, ...]
    refined: tuple[RefinedRange, ...] = ()

    def at_most(self, largest_share: float) -> int:
        """How many speeds are run when so large a share of each grid may be, as a rule at most."""
        grids = sum(max(len(one.coarse_places()), int(largest_share * (one.last + 1))) for one in self.refined)
        return len(self.certain) - sum(len(one.coarse_places()) for one in self.refined) + grids

    def every_speed(self) -> list[float]:
        """All speeds that can be asked for, ascending."""
        return sorted({*self.certain, *(speed for one in self.refined for speed in one.every_speed())})


def speed_plan_from(fields: Mapping[str, Any]) -> SpeedPlan:
    """The plan of which `asdict` made the dictionary."""
    return SpeedPlan(tuple(fields["certain"]), tuple(RefinedRange(**one) for one in fields["refined"]))


def plan_speeds(entries: Sequence[float | Mapping[str, Any]], default_step: float) -> SpeedPlan:
    """What numbers and ranges with `start`, `stop` (included) and, if given, `step` and `refine_to` ask for.

    Raises SpeedError for a range that runs backwards, a step that is not a multiple of refine_to, refining ranges that
    overlap, more than LARGEST_NUMBER speeds and a speed given twice. A number inside a refining range is no repetition.
    """
    numbers: list[float] = []
    speeds: list[float] = []
    refined: list[RefinedRange] = []
    counted = 0.0
    for entry in entries:
        if not isinstance(entry, Mapping):
            numbers.append(float(entry))
            counted += 1
            continue
        start, stop, step = float(entry["start"]), float(entry["stop"]), float(entry.get("step", default_step))
        if stop < start:
            raise SpeedError(f"found a range from {start:g} to {stop:g}; allowed: stop not below start")
        finest = float(entry.get("refine_to", step))
        intervals = (stop - start) / finest + 1e-9
        if not counted + intervals < LARGEST_NUMBER:
            raise SpeedError(
                f"found {intervals + 1:.4g} speeds from {start:g} to {stop:g} rad/s in steps of {finest:g}; "
                f"allowed: at most {LARGEST_NUMBER} speeds together"
            )
        counted += int(intervals) + 1
        if "refine_to" in entry:
            refined.append(_refined(start, step, finest, int(intervals)))
            speeds += [refined[-1].speed(place) for place in refined[-1].coarse_places()]
        else:
            speeds += spaced(start, stop, step)
    for one, other in pairwise(sorted(refined, key=lambda one: one.start)):
        if other.start < one.speed(one.last):
            raise SpeedError(
                f"found ranges with refine_to that overlap, from {other.start:g} to {one.speed(one.last):g} rad/s; "
                "allowed: each speed in one of them"
            )
    coarse = {one.speed(place) for one in refined for place in one.coarse_places()}
    together = sorted([*speeds, *(number for number in numbers if number not in coarse)])
    twice = [a for a, b in pairwise(together) if a == b]
    if twice:
        raise SpeedError(f"found {exact_text(twice[0])} rad/s twice; allowed: each speed once (do the ranges overlap?)")
    return SpeedPlan(tuple(together), tuple(refined))


def _refined(start: float, step: float, refine_to: float, last: int) -> RefinedRange:
    coarse = round(step / refine_to)
    if coarse < 1 or abs(coarse * refine_to - step) > 1e-9 * step:
        raise SpeedError(f"found refine_to {refine_to:g} with steps of {step:g} rad/s; allowed: the step is a multiple of it")
    return RefinedRange(start, refine_to, coarse, last)


def spaced(start: float, stop: float, step: float) -> list[float]:
    """Numbers from `start` to `stop`, both included, as far as the step goes."""
    # rounded, so that a step like 0.1 gives the numbers a user would write
    return [round(start + i * step, 9) for i in range(int((stop - start) / step + 1e-9) + 1)]


def exact_text(number: float) -> str:
    """The shortest text that `float` reads as exactly this number, without a trailing .0: how numbers stand in file names."""
    return repr(float(number)).removesuffix(".0")
