"""When a run-up has which speed: angle is its clock, so the samples of a revolution are the same at every speed.

At a constant rate a the squared speed is linear in the angle, Omega^2 = Omega_0^2 + 2 a theta. Over a stretch of samples the
time integration keeps the mean of the speeds at its ends, which passes the stretch in just the time that the run-up takes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

LARGEST_LEAD = 2e-4
"""Angle (rad) by which the rotor may be elsewhere within a stretch than at its mean speed (docs/accuracy.md)."""

LARGEST_STRETCH = 8
"""Revolutions."""

LARGEST_STIFFENING = 0.05
"""Change of the first mode's squared frequency over which the modes are held (docs/accuracy.md)."""


@dataclass(frozen=True)
class RunUp:
    """A change of speed from `start` to `stop` (rad/s), either the larger, at a constant rate within some `revolutions`.

    `before` and `after`: whole revolutions at the first speed, in which the casing becomes lobed, and at the last one. `worn`:
    whether the lining is worn by the same run-up done once before.
    """

    start: float
    stop: float
    revolutions: float
    before: int
    after: int
    worn: bool

    def samples(self, per_revolution: int) -> int:
        """Samples that the change takes: whole ones, of which a revolution has so many."""
        return max(round(self.revolutions * per_revolution), 1)

    def rate(self, per_revolution: int) -> float:
        """Rate (rad/s2) that these samples make, negative where the speed falls."""
        angle = 2.0 * np.pi * self.samples(per_revolution) / per_revolution
        return (self.stop**2 - self.start**2) / (2.0 * angle)


_AT_ONCE = 500
"""Stretches of a segment."""


class Stretch(NamedTuple):
    """Some samples at one speed (rad/s)."""

    speed: float
    samples: int


class PacesOfStretches(NamedTuple):
    """Different `speeds` (rad/s), shape (speeds,), and which of them each stretch has."""

    speeds: np.ndarray
    of_stretches: np.ndarray


@dataclass(frozen=True)
class Segment:
    """Stretches in which the modes of one `speed` (rad/s) are held."""

    speed: float
    stretches: tuple[Stretch, ...]

    @cached_property
    def paces(self) -> PacesOfStretches:
        """The speeds of the stretches."""
        speeds, of_stretches = np.unique([one.speed for one in self.stretches], return_inverse=True)
        return PacesOfStretches(speeds, of_stretches)

    @cached_property
    def lasting(self) -> np.ndarray:
        """Samples of each stretch."""
        return np.array([one.samples for one in self.stretches])

    def at_once(self, samples: int) -> Iterator[slice]:
        """The stretches in lots of about so many samples."""
        lots = (np.cumsum(self.lasting) - self.lasting) // samples
        for first, last in pairwise([*np.unique(lots, return_index=True)[1], len(lots)]):
            yield slice(first, last)


def schedule(run_up: RunUp, samples_per_revolution: int, squared_frequency_change: float) -> list[Segment]:
    """The segments of a run-up, of whole revolutions together.

    `squared_frequency_change` (s2): relative change of the first mode's squared frequency per squared speed. The change takes
    whole samples, so its rate differs from the given one by half a sample at most. A run-down is its run-up backwards.
    """
    per_revolution = samples_per_revolution
    samples = run_up.samples(per_revolution)
    low, high = sorted((run_up.start, run_up.stop))
    before, after = run_up.before * per_revolution, -samples % per_revolution + run_up.after * per_revolution
    if low == high:
        return [Segment(low, tuple(_turns(low, before + samples + after, per_revolution)))]
    change = _rising(low, high, samples, per_revolution, squared_frequency_change)
    if run_up.stop < run_up.start:
        change = [replace(one, stretches=one.stretches[::-1]) for one in reversed(change)]
    first = Segment(run_up.start, tuple(_turns(run_up.start, before, per_revolution)))
    last = Segment(run_up.stop, tuple(_turns(run_up.stop, after, per_revolution)))
    return [one for one in (first, *change, last) if one.stretches]


def _turns(speed: float, samples: int, per_revolution: int) -> list[Stretch]:
    """Samples at one speed, in stretches."""
    number, rest = divmod(samples, LARGEST_STRETCH * per_revolution)
    whole = [Stretch(speed, LARGEST_STRETCH * per_revolution)] * number
    return [*whole, Stretch(speed, rest)] if rest else whole


def _rising(low: float, high: float, samples: int, per_revolution: int, squared_frequency_change: float) -> list[Segment]:
    """The segments of a speed that rises."""
    rise = high**2 - low**2

    def speed_at(sample: float) -> float:
        return math.sqrt(low**2 + rise * sample / samples)

    rate = rise * per_revolution / (4.0 * np.pi * samples)
    # within a time T the rotor leads its mean speed by up to a T^2/8
    lasting = math.sqrt(8.0 * LARGEST_LEAD / rate)
    number = min(max(int(np.ceil(rise * abs(squared_frequency_change) / LARGEST_STIFFENING)), 1), samples)
    ends = [round(samples * part / number) for part in range(number + 1)]
    segments = []
    for first, last in pairwise(ends):
        stretches, at = [], first
        while at < last:
            longest = int(lasting * speed_at(at) / (2.0 * np.pi) * per_revolution)
            following = min(at + min(max(longest, 1), LARGEST_STRETCH * per_revolution), last)
            stretches.append(Stretch(0.5 * (speed_at(at) + speed_at(following)), following - at))
            at = following
        # some at a time: the numbers of all stretches of a segment are in memory together
        parts = [tuple(stretches[part : part + _AT_ONCE]) for part in range(0, len(stretches), _AT_ONCE)]
        segments += [Segment(speed_at(0.5 * (first + last)), part) for part in parts]
    return segments
