"""The range of speeds that an engine flies in, and the time at each speed. Light: the configuration imports it."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Annotated, Any

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key, speed_keys

_ROUNDING = 1e-9
"""Share of a speed by which a margin in percent may miss a whole number."""


@dataclass(frozen=True)
class OperatingDwell:
    """A `share` of the operating time that the speed (rad/s) lies between `start` and `stop`."""

    start: Annotated[float, speed_keys("Lowest speed of the dwell", "from")]
    stop: Annotated[float, speed_keys("Highest speed of the dwell", "to")]
    share: Annotated[float, Key("Share of the operating time", "_percent", ge=1e-6, le=100)]


@dataclass(frozen=True)
class OperatingRange:
    """Speeds (rad/s) from `idle` to `redline`, with dwells; the rest of the time is spread evenly over the range.

    `margin`: share of the speed by which the judged range reaches beyond both ends.
    """

    idle: Annotated[float, speed_keys("Lowest speed in operation")]
    redline: Annotated[float, speed_keys("Highest speed in operation")]
    margin: Annotated[
        float, Key("Share of the speed by which the judged range reaches beyond both ends", "_percent", ge=0, lt=100)
    ] = 0.0
    dwell: tuple[OperatingDwell, ...] = field(default=())
    rate: Annotated[
        float | None,
        Key(
            "Rate of the run-ups and run-downs that a verdict tries; by default three",
            "_rad_s2",
            ge=1e-3,
            le=1e9,
            optional=True,
        ),
        Key("The same rate in revolutions per minute per second", "_rpm_s", ge=1e-2, le=1e10, optional=True),
    ] = None

    @property
    def first(self) -> float:
        """Lowest speed (rad/s) that is judged."""
        return self.idle * (1.0 - self.margin)

    @property
    def last(self) -> float:
        """Highest speed (rad/s) that is judged."""
        return self.redline * (1.0 + self.margin)

    @property
    def ends(self) -> tuple[float, ...]:
        """Speeds (rad/s) that are run themselves: idle, redline, and the ends of the judged range."""
        return (self.first, self.idle, self.redline, self.last)

    def is_covered(self, speeds: ndarray) -> bool:
        """True if runs at these ascending speeds (rad/s) reach over the whole judged range, but for rounding."""
        return bool(len(speeds) and speeds[0] <= self.first * (1.0 + _ROUNDING) and speeds[-1] >= self.last * (1.0 - _ROUNDING))

    def overlap(self, begin: float, end: float) -> float:
        """Length (rad/s) of a range of speeds inside the judged range; below 0 by its distance where it lies outside."""
        return min(end, self.last) - max(begin, self.first)

    def length(self, ranges: Iterable[Any]) -> float:
        """Length (rad/s) of ranges of speeds, each with a `begin` and an `end` (rad/s), inside the judged range."""
        return float(sum(max(0.0, self.overlap(part.begin, part.end)) for part in ranges))

    def time_density(self, speeds: ndarray) -> ndarray:
        """Density of the operating time over speed, relative to an even one, at each of these speeds (rad/s)."""
        whole = self.redline - self.idle
        flown = (speeds >= self.idle) & (speeds <= self.redline)
        density = np.where(flown, 1.0 - sum(dwell.share for dwell in self.dwell), 0.0)
        for dwell in self.dwell:
            there = (speeds >= dwell.start) & (speeds <= dwell.stop)
            density = density + np.where(there, dwell.share * whole / (dwell.stop - dwell.start), 0.0)
        return density

    def integral(self, speeds: ndarray, values: ndarray) -> float:
        r"""Integral (rad/s) of `values` at ascending `speeds` from idle to redline, weighted by the operating time.

        (redline - idle) \int values(speed) p(speed) d speed, with p the density of the operating time; without dwells the plain
        integral. Between speeds the values are a straight line, and the density is constant between the ends of dwells."""
        ends = [self.idle, self.redline, *(side for dwell in self.dwell for side in (dwell.start, dwell.stop))]
        inside = np.unique([speed for speed in (*speeds, *ends) if self.idle <= speed <= self.redline])
        pieces = 0.5 * (np.interp(inside[1:], speeds, values) + np.interp(inside[:-1], speeds, values)) * np.diff(inside)
        return float(np.sum(pieces * self.time_density(0.5 * (inside[1:] + inside[:-1]))))
