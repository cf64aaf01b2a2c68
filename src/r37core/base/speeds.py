"""Speeds to simulate: numbers and ranges, joined, some sampled adaptively; and how a speed stands in file names."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import isclose
from typing import Any

from r37core.base.units import RAD_S

LARGEST_NUMBER = 100_000
"""Speeds of one blade in one scene."""


class SpeedError(ValueError):
    """Speeds that cannot be used together."""


@dataclass(frozen=True)
class RefinedRange:
    """Adaptive speeds: `coarse` intervals of the grid start, start + refine_to, ... up to `last` of them.

    All numbers but start and refine_to count intervals of the grid, so that a speed is the same number in whichever round it
    is asked for. These two are in the unit that they were given in, of which one is `unit` rad/s.
    """

    start: float
    refine_to: float
    coarse: int
    last: int
    unit: float = 1.0

    @property
    def interval(self) -> float:
        """Length of the grid's intervals (rad/s)."""
        return self.refine_to * self.unit

    def speed(self, index: int) -> float:
        """The speed (rad/s) at an index of the grid, from 0 to `last`."""
        # rounded, so that a step like 0.1 gives the numbers a user would write
        return round(self.start + index * self.refine_to, 9) * self.unit

    def coarse_indices(self) -> list[int]:
        """Indices of the grid that are run whatever is found there."""
        indices = list(range(0, self.last + 1, self.coarse))
        return indices if indices[-1] == self.last else [*indices, self.last]

    def every_speed(self) -> list[float]:
        """All speeds (rad/s) of the grid."""
        return [self.speed(index) for index in range(self.last + 1)]


@dataclass(frozen=True)
class SpeedPlan:
    """Speeds that a list asks for: `certain` ones (rad/s), ascending, with the coarse ones of the `refined` ranges."""

    certain: tuple[float, ...]
    refined: tuple[RefinedRange, ...] = ()

    def including(self, speeds: Iterable[float]) -> "SpeedPlan":
        """The plan with more certain speeds (rad/s): those between its lowest and highest that it does not have yet."""
        known = self.certain
        new = {each for each in speeds if known[0] < each < known[-1] and not any(isclose(each, speed) for speed in known)}
        return replace(self, certain=tuple(sorted(new.union(known))))

    def speed_count(self, largest_share: float) -> int:
        """Number of speeds that are run when so large a share of each grid may be, as a rule at most."""
        grids = sum(max(len(grid.coarse_indices()), int(largest_share * (grid.last + 1))) for grid in self.refined)
        return len(self.certain) - sum(len(grid.coarse_indices()) for grid in self.refined) + grids

    def every_speed(self) -> list[float]:
        """All speeds that can be asked for, ascending."""
        return sorted({*self.certain, *(speed for grid in self.refined for speed in grid.every_speed())})


def plan_speeds(entries: Sequence[float | Mapping[str, Any]], default_step: float, unit: str = "rad/s") -> SpeedPlan:
    """Plan of numbers and ranges with `start`, `stop` (included) and, if given, `step` and `refine_to`.

    All of them are in the `unit`, rad/s or rpm, `default_step` is in rad/s.

    Raises SpeedError for a range that runs backwards, a step that is not a multiple of refine_to, refining ranges that
    overlap, more than LARGEST_NUMBER speeds and a speed given twice. A number inside a refining range is no repetition.
    """
    rad_s = RAD_S[unit]
    numbers = [float(entry) * rad_s for entry in entries if not isinstance(entry, Mapping)]
    speeds: list[float] = []
    refined: list[RefinedRange] = []
    counted = len(numbers)
    for entry in (entry for entry in entries if isinstance(entry, Mapping)):
        start, stop, step = float(entry["start"]), float(entry["stop"]), float(entry.get("step", default_step / rad_s))
        if stop < start:
            raise SpeedError(f"found a range from {start:g} to {stop:g}; allowed: stop not below start")
        finest = float(entry.get("refine_to", step))
        intervals = (stop - start) / finest + 1e-9
        if not counted + intervals < LARGEST_NUMBER:
            raise SpeedError(
                f"found {intervals + 1:.4g} speeds from {start:g} to {stop:g} {unit} in steps of {finest:g}; "
                f"allowed: at most {LARGEST_NUMBER} speeds together"
            )
        counted += int(intervals) + 1
        # without refine_to all of it is coarse
        grid = _grid(start, step, finest, int(intervals), unit)
        speeds += [grid.speed(index) for index in grid.coarse_indices()]
        refined += [grid] if "refine_to" in entry else []
    for low, high in pairwise(sorted(refined, key=lambda grid: grid.start)):
        if high.speed(0) < low.speed(low.last):
            raise SpeedError(
                f"found ranges with refine_to that overlap, from {high.start:g} to {low.speed(low.last) / rad_s:g} {unit}; "
                "allowed: each speed in one of them"
            )
    coarse = {grid.speed(index) for grid in refined for index in grid.coarse_indices()}
    together = sorted([*speeds, *(number for number in numbers if number not in coarse)])
    twice = [a for a, b in pairwise(together) if a == b]
    if twice:
        text = exact_text(round(twice[0] / rad_s, 9))
        raise SpeedError(f"found {text} {unit} twice; allowed: each speed once (do the ranges overlap?)")
    return SpeedPlan(tuple(together), tuple(refined))


def _grid(start: float, step: float, refine_to: float, last: int, unit: str) -> RefinedRange:
    coarse = round(step / refine_to)
    if coarse < 1 or abs(coarse * refine_to - step) > 1e-9 * step:
        raise SpeedError(f"found refine_to {refine_to:g} with steps of {step:g} {unit}; allowed: the step is a multiple of it")
    return RefinedRange(start, refine_to, coarse, last, RAD_S[unit])


def spaced(start: float, stop: float, step: float) -> list[float]:
    """Numbers from `start` to `stop`, both included, as far as the step goes."""
    return [rounded(start + i * step) for i in range(int((stop - start) / step + 1e-9) + 1)]


def rounded(number: float) -> float:
    """A number without the last digits, which differ where it follows from a step like 0.1 or from rpm."""
    return round(number, 9)


def exact_text(number: float) -> str:
    """The shortest text that `float` reads as exactly this number, without a trailing .0: how numbers stand in file names."""
    return repr(float(number)).removesuffix(".0")
