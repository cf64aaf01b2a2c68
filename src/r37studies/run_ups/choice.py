"""A run-up as it is asked for, between speeds or about a crossing of the blade's Campbell diagram, and its schedule.

Angle is its clock, so the samples of a revolution are the same at every speed.

At a constant rate a the squared speed is linear in the angle, Omega^2 = Omega_0^2 + 2 a theta. Over a segment of samples the
time integration keeps the mean of the speeds at its ends, which passes the segment in just the time that the run-up takes.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np

from r37core.base.declared import Key, speed_keys
from r37core.rom.naming import NAMED_MODES

if TYPE_CHECKING:
    # it takes longer to import than all else here
    import xarray as xr

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


LARGEST_CHANGE_PER_SAMPLE = 0.01
"""Largest relative change of the speed in a sample."""

SHORTEST, LONGEST = 1e-3, 100_000
"""Revolutions of a change of speed."""


class RunUpError(ValueError):
    """A run-up that cannot be done as it is asked for."""


@dataclass(frozen=True)
class Crossing:
    """Crossing: the speed at which a `mode` has the frequency of an `engine_order`."""

    mode: Annotated[str, Key("Mode of the crossing", one_of=NAMED_MODES)]
    engine_order: Annotated[int, Key("Engine order of the crossing", ge=1, le=100)]


@dataclass(frozen=True)
class RunUpChoice:
    """A run-up from `start` to `stop` (rad/s), or with a `crossing` so far above its speed, as shares of it.

    Of `rate` (rad/s2, positive) and `revolutions` one is given; `before`, `after` and `worn`: see RunUp.
    """

    start: Annotated[float, speed_keys("First speed, at which the lobes grow", "from")]
    stop: Annotated[float, speed_keys("Last speed; a lower one makes a run-down", "to")]
    crossing: Crossing | None
    rate: Annotated[
        float | None,
        Key("Change of the speed per second, without sign", "_rad_s2", ge=1e-3, le=1e9, optional=True),
        Key("The same rate in revolutions per minute per second", "_rpm_s", ge=1e-2, le=1e10, optional=True),
    ]
    revolutions: Annotated[
        float | None, Key("Revolutions of the change, in place of a rate", ge=SHORTEST, le=LONGEST, optional=True)
    ]
    before: Annotated[
        int,
        Key(
            "Revolutions at the first speed, while the lobes grow; by default the scene's",
            name="revolutions_before",
            ge=1,
            le=20000,
            optional=True,
        ),
    ]
    after: Annotated[int, Key("Revolutions at the last speed", name="revolutions_after", ge=0, le=20000)] = 0
    worn: Annotated[
        bool,
        Key(
            "Abradable lining at the start; worn: by the same run-up before", name="lining", words={"new": False, "worn": True}
        ),
    ] = False

    def run_up(self, samples_per_revolution: int, crossing_speed: float | None = None) -> RunUp:
        """The run-up in numbers; `crossing_speed` (rad/s): of the crossing, where there is one.

        Raises RunUpError for one of too few or too many revolutions.
        """
        start, stop = self.start, self.stop
        if crossing_speed is not None:
            start, stop = crossing_speed * (1.0 + start), crossing_speed * (1.0 + stop)
        low, high = sorted((start, stop))
        squares = high**2 - low**2
        # the squared speed is linear in the angle, so the first sample above the lower speed changes it most
        samples = max(((high / low) ** 2 - 1.0) / ((1.0 + LARGEST_CHANGE_PER_SAMPLE) ** 2 - 1.0), 1.0)
        fewest = max(samples / samples_per_revolution, SHORTEST)
        if fewest > LONGEST:
            raise RunUpError(
                f"found speeds from {low:g} to {high:g} rad/s; allowed: nearer ones, because the speed may change by "
                f"{100 * LARGEST_CHANGE_PER_SAMPLE:g}% in a sample, and a change take {LONGEST} revolutions"
            )
        revolutions = self.revolutions
        if revolutions is None:
            assert self.rate is not None
            revolutions = squares / (4.0 * np.pi * self.rate)
        if not fewest <= revolutions <= LONGEST:
            slowest, fastest = (squares / (4.0 * np.pi * number) for number in (LONGEST, fewest))
            raise RunUpError(
                f"found a change from {start:.15g} to {stop:.15g} rad/s within {revolutions:.4g} revolutions; "
                f"allowed: {fewest:.3g} to {LONGEST:g} of them (rates from {slowest:.3g} to {fastest:.3g} rad/s2)"
            )
        return RunUp(start, stop, revolutions, self.before, self.after, self.worn)

    def blade_run_up(self, samples_per_revolution: int, campbell: xr.Dataset | None, name: str) -> RunUp:
        """The run-up called `name` of a blade with this Campbell diagram, which one about a crossing needs.

        Raises RunUpError where there is no crossing, and for speeds beyond the diagram's.
        """
        try:
            if self.crossing is None:
                return self.run_up(samples_per_revolution)
            assert campbell is not None
            mode, order, highest = self.crossing.mode, self.crossing.engine_order, float(campbell["speed"].max())
            speed = float(campbell["crossing_speed"].sel(mode=mode, engine_order=order))
            if not np.isfinite(speed):
                raise RunUpError(
                    f"found a run-up about {mode} and engine order {order}, which do not cross up to {highest:g} rad/s; "
                    "allowed: crossings of the Campbell diagram (`blades` of a run-up says which it is for)"
                )
            run_up = self.run_up(samples_per_revolution, speed)
            check_highest(max(run_up.start, run_up.stop), highest)
            return run_up
        except RunUpError as error:
            raise RunUpError(f"config.yaml: run_ups.{name}: {error}") from None


def check_highest(speed: float, highest: float) -> None:
    """RunUpError for a speed (rad/s) beyond the `highest` that the reduced model is made for."""
    if speed > highest:
        raise RunUpError(f"found {speed:g} rad/s; allowed: up to structure.maximum_speed_rad_s, {highest:g}")
