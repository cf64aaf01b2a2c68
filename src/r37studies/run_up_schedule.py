"""A run-up in numbers, and its schedule.

Angle is its clock, so the samples of a revolution are the same at every speed.

At a constant rate a the squared speed is linear in the angle, Omega^2 = Omega_0^2 + 2 a theta. Over a segment of samples the
time integration keeps the mean of the speeds at its ends, which passes the segment in just the time that the run-up takes.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

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


class ModalInterval(NamedTuple):
    """Constant-speed segments that are integrated in the modes of one `speed` (rad/s).

    `speeds` (rad/s) and `samples` of each, shape (segments,).
    """

    speed: float
    speeds: np.ndarray
    samples: np.ndarray


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
        return [_held(low, before + samples + after, per_revolution)]
    change = _rising(low, high, samples, per_revolution, squared_frequency_change)
    if run_up.stop < run_up.start:
        change = [ModalInterval(speed, speeds[::-1], lasting[::-1]) for speed, speeds, lasting in reversed(change)]
    first, last = _held(run_up.start, before, per_revolution), _held(run_up.stop, after, per_revolution)
    return [interval for interval in (first, *change, last) if len(interval.samples)]


def _held(speed: float, samples: int, per_revolution: int) -> ModalInterval:
    """Samples at one speed, in segments."""
    lasting = np.diff([*range(0, samples, LONGEST_SEGMENT * per_revolution), samples])
    return ModalInterval(speed, np.full(len(lasting), speed), lasting)


def _rising(low: float, high: float, samples: int, per_revolution: int, squared_frequency_change: float) -> list[ModalInterval]:
    """The intervals of a speed that rises."""
    rise = high**2 - low**2

    def speed_at(sample: Any) -> Any:
        return np.sqrt(low**2 + rise * sample / samples)

    rate = rise * per_revolution / (4.0 * np.pi * samples)
    # within a time T the rotor leads its mean speed by up to a T^2/8
    lasting = np.sqrt(8.0 * LARGEST_LEAD / rate)
    number = min(max(int(np.ceil(rise * abs(squared_frequency_change) / LARGEST_STIFFENING)), 1), samples)
    intervals = []
    for first, last in pairwise(round(samples * part / number) for part in range(number + 1)):
        ends = [first]
        while ends[-1] < last:
            longest = int(lasting * speed_at(ends[-1]) / (2.0 * np.pi) * per_revolution)
            ends.append(min(ends[-1] + min(max(longest, 1), LONGEST_SEGMENT * per_revolution), last))
        speeds, modal_speed = speed_at(np.array(ends)), float(speed_at(0.5 * (first + last)))
        segments = 0.5 * (speeds[:-1] + speeds[1:]), np.diff(ends)
        # some at a time: the numbers of all segments of an interval are in memory together
        for part in range(0, len(ends) - 1, _AT_ONCE):
            intervals.append(ModalInterval(modal_speed, *(values[part : part + _AT_ONCE] for values in segments)))
    return intervals
