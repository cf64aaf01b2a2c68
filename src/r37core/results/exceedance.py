"""Where over speed a blade exceeds yield or the Goodman line, from the share of a run's revolutions that does.

In direct contact one revolution's largest stress scatters by a tenth on most blades, from revolution to revolution and from
speed to speed, so that a speed is above yield or below it by chance. The share of a hundred revolutions, smoothed over
neighbouring speeds, has borders that can be found again. Smoothing would widen the ranges of a motion that repeats itself,
whose shares are 0 or 1: such a share is smoothed with those alone from which chance may tell it apart. A lined blade
repeats itself: its shares are taken as they are.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy import ndarray
from xarray import Dataset

from r37core.time_integration.status import RunStatus

HALF_WIDTH = 10.0
"""Distance (rad/s) at which a neighbour's share has no weight any more; its weight falls in a straight line to there."""

_INTERVALS = 1.5
"""Least reach of a neighbour's weight, in intervals between speeds, where these are farther apart."""

_BY_CHANCE = 0.2
"""Difference of two shares that chance may make: three standard deviations where half of a hundred revolutions are above."""

RESOLVED = 3
"""Least number of neighbouring speeds alike that show the border of a range, and do not hit it by chance."""

DEVIATIONS = 2.0
"""Standard deviations within which a number is said to lie."""

_DRAWS, _SEED = 200, 0


@dataclass(frozen=True)
class SpeedRange:
    """Speeds (rad/s) from `begin` to `end`; `truncated`: it reaches to the first or last speed of all, and may go on beyond."""

    begin: float
    end: float
    truncated: bool

    @property
    def length(self) -> float:
        """Length of the range (rad/s)."""
        return self.end - self.begin


@dataclass(frozen=True)
class Exceedance:
    """`shares` of the revolutions above yield at ascending `speeds` (rad/s), both of shape (speeds,).

    `chance`: whether they scatter, as in direct contact; else they are taken as they are.
    """

    speeds: ndarray
    shares: ndarray
    chance: bool

    @cached_property
    def weights(self) -> ndarray:
        """Weight of each speed's share in the smoothed one of each speed, shape (speeds, speeds); the sum of a row is 1.

        A straight line falls from 1 at the speed itself to 0 at HALF_WIDTH, or farther off where speeds are few; each speed
        counts for the length of the range that is nearest to it. Two shares of which one is 0 or 1, and which differ by more
        than chance, have no weight in each other's mean.
        """
        if not self.chance or len(self.speeds) < 2:
            return np.eye(len(self.speeds))
        steps = np.diff(self.speeds)
        before, after = np.concatenate([steps[:1], steps]), np.concatenate([steps, steps[-1:]])
        reach = np.maximum(HALF_WIDTH, _INTERVALS * np.maximum(before, after))
        distance = np.abs(self.speeds[:, None] - self.speeds)
        nearest = 0.5 * (np.concatenate([[0.0], steps]) + np.concatenate([steps, [0.0]]))
        is_chance = (self.shares > 0.0) & (self.shares < 1.0)
        alike = is_chance[:, None] & is_chance | (np.abs(self.shares[:, None] - self.shares) <= _BY_CHANCE)
        weights = np.maximum(0.0, 1.0 - distance / reach[:, None]) * nearest * alike
        return weights / weights.sum(axis=1, keepdims=True)

    @cached_property
    def smoothed(self) -> ndarray:
        """The shares, each the mean of its neighbours', shape (speeds,)."""
        return self.weights @ self.shares

    def ranges(self, share: float) -> list[SpeedRange]:
        """Where the smoothed share is above `share`; between speeds it is a straight line."""
        return ranges_above(self.speeds, self.smoothed, share)

    def length(self, share: float) -> float:
        """Length (rad/s) of all ranges above `share` together."""
        return length_of(self.ranges(share))

    @property
    def integral(self) -> float:
        """Integral of the shares over speed (rad/s), without threshold and smoothing."""
        return float(np.trapezoid(self.shares, self.speeds))

    def scatter_of_integral(self, measure: Callable[[ndarray], float] | None = None) -> float:
        """Standard deviation of `integral` (rad/s), or of another `measure` of shares; NaN where there is no chance.

        By chance and distance of the speeds: a share changes anywhere between two of them; where it turns back at once, what is
        narrower than their distance is hit or missed.
        """
        if not self.chance:
            return np.nan
        integral = measure or (lambda shares: float(np.trapezoid(shares, self.speeds)))
        changes = np.diff(self.shares)
        turns = np.concatenate([[False], changes[1:] * changes[:-1] < 0.0, [False]])[: len(changes) + 1]
        variance = np.where(turns[1:] | turns[:-1], 1.0 / 2.0, 1.0 / 12.0)
        steps = [integral(unit) for unit in np.eye(len(self.shares))]
        grid = variance @ np.square(changes * np.minimum(steps[1:], steps[:-1]))
        return float(np.sqrt(np.var([integral(shares) for shares in self.drawn]) + grid))

    @cached_property
    def drawn(self) -> ndarray:
        """Smoothed shares as chance could have had them, shape (draws, speeds); the same every time.

        Each speed's share is one of its neighbours', drawn by the weights.
        """
        random, indices = np.random.default_rng(_SEED), np.arange(len(self.speeds))
        chosen = np.array([random.choice(indices, _DRAWS, p=row) for row in self.weights])
        return (self.weights @ self.shares[chosen]).T

    @cached_property
    def ranges_drawn(self) -> Callable[[float], list[list[SpeedRange]]]:
        """Gives the ranges above a share, of each of the drawn shares."""
        return cache(lambda share: [ranges_above(self.speeds, drawn, share) for drawn in self.drawn])

    def scatter_of_length(
        self, share: float, measure: Callable[[Sequence[SpeedRange]], float] | None = None, *, chance: bool = True
    ) -> float:
        """Standard deviation (rad/s) of `length`, or of another `measure` of the ranges, by chance and distance of the speeds.

        A border may lie anywhere between the two speeds about it. Where fewer than RESOLVED speeds on a side of it are alike,
        the speeds hit or miss what is narrower than their distance, as throws of a coin. `chance`: whether chance is drawn.
        """
        length = measure or length_of
        drawn = [length(ranges) for ranges in self.ranges_drawn(share)] if self.chance and chance else [0.0]
        above = self.smoothed > share
        borders = np.flatnonzero(above[1:] != above[:-1])
        # what goes on beyond the first or last speed may be long
        alike = np.diff(np.concatenate([[-RESOLVED], borders, [len(above) + RESOLVED]]))
        variance = np.where(np.minimum(alike[:-1], alike[1:]) < RESOLVED, 1.0 / 2.0, 1.0 / 12.0)
        steps = [
            length([SpeedRange(*ends, truncated=False)])
            for ends in zip(self.speeds[borders], self.speeds[borders + 1], strict=True)
        ]
        return float(np.sqrt(np.var(drawn) + variance @ np.square(steps)))

    def scatter_of_border(self, share: float, of: SpeedRange, *, begins: bool) -> float:
        """How far (rad/s) chance moves the begin, or the end, of a range, in two of three cases.

        NaN where there is no chance, where the speeds begin or end there, and where the range itself is not there, or somewhere
        else, in one of three cases.
        """
        border = of.begin if begins else of.end
        if not self.chance or border in (self.speeds[0], self.speeds[-1]):
            return np.nan
        off = []
        for ranges in self.ranges_drawn(share):
            same = [part for part in ranges if part.begin <= of.end and part.end >= of.begin]
            drawn_border = (same[0].begin if begins else same[-1].end) if same else np.inf
            off.append(abs(drawn_border - border))
        scatter = float(np.quantile(off, 2.0 / 3.0))
        return scatter if np.isfinite(scatter) else np.nan


def exceedance_of(response: Dataset, share_of_revolutions: str = "share_of_revolutions_above_yield") -> Exceedance:
    """Exceedance of a response by a share of its revolutions; a run that diverged is above in all revolutions."""
    share = response[share_of_revolutions].where(response["status"] != RunStatus.DIVERGED, 1.0).dropna("speed")
    return Exceedance(share["speed"].values, share.values, not is_lined(response))


def is_lined(response: Dataset) -> bool:
    """True where a lining is worn, false where the tip meets the casing itself."""
    return bool(response["lined"]) if "lined" in response else True


def ranges_above(speeds: ndarray, values: ndarray, level: float) -> list[SpeedRange]:
    """Where `values` at ascending `speeds` (rad/s) are above a `level`; between speeds they are a straight line.

    From an infinite value half of the way to one below counts.
    """
    above = np.concatenate([[False], values > level, [False]])
    firsts, lasts = np.flatnonzero(~above[:-1] & above[1:]), np.flatnonzero(above[:-1] & ~above[1:]) - 1

    def crossing(inside: int, outside: int) -> float:
        if not 0 <= outside < len(speeds):
            return float(speeds[inside])
        way = (values[inside] - level) / (values[inside] - values[outside]) if np.isfinite(values[inside]) else 0.5
        return float(speeds[inside] + way * (speeds[outside] - speeds[inside]))

    return [
        SpeedRange(crossing(first, first - 1), crossing(last, last + 1), bool(first == 0 or last == len(speeds) - 1))
        for first, last in zip(firsts.tolist(), lasts.tolist(), strict=True)
    ]


def length_of(ranges: Iterable[SpeedRange]) -> float:
    """Length (rad/s) of all ranges together, which do not overlap."""
    return float(sum(part.length for part in ranges))


def joined(ranges: Sequence[SpeedRange]) -> list[SpeedRange]:
    """Ranges that overlap as one, ascending."""
    merged: list[SpeedRange] = []
    for current in sorted(ranges, key=lambda current: current.begin):
        if merged and current.begin <= merged[-1].end:
            before = merged.pop()
            current = SpeedRange(before.begin, max(before.end, current.end), before.truncated or current.truncated)
        merged.append(current)
    return merged


def outside(within: SpeedRange, reaches: Sequence[SpeedRange]) -> list[SpeedRange]:
    """The parts of a range that no other of the ranges has."""
    parts = [within]
    for reach in reaches:
        cut = [(part.begin, min(part.end, reach.begin)) for part in parts]
        cut += [(max(part.begin, reach.end), part.end) for part in parts]
        parts = [SpeedRange(begin, end, within.truncated) for begin, end in cut if begin <= end]
    return parts
