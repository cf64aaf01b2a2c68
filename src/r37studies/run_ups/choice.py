"""A run-up as it is asked for, between speeds or about a crossing of the blade's Campbell diagram."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import numpy as np

from r37core.base.declared import Key, speed_keys
from r37core.rom.naming import NAMED_MODES
from r37studies.run_up_schedule import RunUp

if TYPE_CHECKING:
    # it takes longer to import than all else here
    import xarray as xr

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
