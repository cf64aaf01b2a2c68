"""Speeds of a run-up over its revolutions: angle is its clock, so the samples of a revolution are the same at every speed.

At a constant rate a the squared speed is linear in the angle, Omega^2 = Omega_0^2 + 2 a theta. Over a segment of samples the
time integration keeps the mean of the speeds at its ends, which passes the segment in just the time that the run-up takes.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

LARGEST_LEAD = 2e-4
"""Angle (rad) by which the rotor may be elsewhere within a segment than at its mean speed (docs/run_ups.md)."""

LONGEST_SEGMENT = 8
"""Revolutions."""

LARGEST_STIFFENING = 0.05
"""Change of the first mode's squared frequency over which the modes are held (docs/run_ups.md)."""


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
"""Constant-speed segments of an interval."""


class SpeedSegment(NamedTuple):
    """A constant-speed segment: some samples at one speed (rad/s)."""

    speed: float
    samples: int


@dataclass(frozen=True)
class ModalInterval:
    """Constant-speed segments that are integrated in the modes of one `speed` (rad/s)."""

    speed: float
    segments: tuple[SpeedSegment, ...]

    @property
    def distinct_speeds(self) -> tuple[np.ndarray, np.ndarray]:
        """Different speeds (rad/s), shape (speeds,), and which of them each segment has, shape (segments,)."""
        return np.unique([segment.speed for segment in self.segments], return_inverse=True)

    @cached_property
    def lasting(self) -> np.ndarray:
        """Samples of each segment."""
        return np.array([segment.samples for segment in self.segments])

    def parts(self, samples: int) -> Iterator[slice]:
        """The segments in lots of about so many samples."""
        lots = (np.cumsum(self.lasting) - self.lasting) // samples
        for first, last in pairwise([*np.unique(lots, return_index=True)[1], len(lots)]):
            yield slice(first, last)


def schedule(run_up: RunUp, samples_per_revolution: int, squared_frequency_change: float) -> list[ModalInterval]:
    """The intervals of a run-up, of whole revolutions together.

    `squared_frequency_change` (s2): relative change of the first mode's squared frequency per squared speed. The change takes
    whole samples, so its rate differs from the given one by half a sample at most. A run-down is its run-up backwards.
    """
    per_revolution = samples_per_revolution
    samples = run_up.samples(per_revolution)
    low, high = sorted((run_up.start, run_up.stop))
    before, after = run_up.before * per_revolution, -samples % per_revolution + run_up.after * per_revolution
    if low == high:
        return [ModalInterval(low, tuple(_turns(low, before + samples + after, per_revolution)))]
    change = _rising(low, high, samples, per_revolution, squared_frequency_change)
    if run_up.stop < run_up.start:
        change = [replace(interval, segments=interval.segments[::-1]) for interval in reversed(change)]
    first = ModalInterval(run_up.start, tuple(_turns(run_up.start, before, per_revolution)))
    last = ModalInterval(run_up.stop, tuple(_turns(run_up.stop, after, per_revolution)))
    return [interval for interval in (first, *change, last) if interval.segments]


def _turns(speed: float, samples: int, per_revolution: int) -> list[SpeedSegment]:
    """Samples at one speed, in segments."""
    number, rest = divmod(samples, LONGEST_SEGMENT * per_revolution)
    whole = [SpeedSegment(speed, LONGEST_SEGMENT * per_revolution)] * number
    return [*whole, SpeedSegment(speed, rest)] if rest else whole


def _rising(low: float, high: float, samples: int, per_revolution: int, squared_frequency_change: float) -> list[ModalInterval]:
    """The intervals of a speed that rises."""
    rise = high**2 - low**2

    def speed_at(sample: float) -> float:
        return math.sqrt(low**2 + rise * sample / samples)

    rate = rise * per_revolution / (4.0 * np.pi * samples)
    # within a time T the rotor leads its mean speed by up to a T^2/8
    lasting = math.sqrt(8.0 * LARGEST_LEAD / rate)
    number = min(max(int(np.ceil(rise * abs(squared_frequency_change) / LARGEST_STIFFENING)), 1), samples)
    ends = [round(samples * part / number) for part in range(number + 1)]
    intervals = []
    for first, last in pairwise(ends):
        segments, first_sample = [], first
        while first_sample < last:
            longest = int(lasting * speed_at(first_sample) / (2.0 * np.pi) * per_revolution)
            following = min(first_sample + min(max(longest, 1), LONGEST_SEGMENT * per_revolution), last)
            segments.append(SpeedSegment(0.5 * (speed_at(first_sample) + speed_at(following)), following - first_sample))
            first_sample = following
        # some at a time: the numbers of all segments of an interval are in memory together
        parts = [tuple(segments[part : part + _AT_ONCE]) for part in range(0, len(segments), _AT_ONCE)]
        intervals += [ModalInterval(speed_at(0.5 * (first + last)), part) for part in parts]
    return intervals
