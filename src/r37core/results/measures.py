"""What is read off a response, each number once: for the summary, designs, refinement, studies, figures and the explorer.

A `response` is one blade in one scene, with the variables of response.nc over ascending `speed` (rad/s); those of the tip may
have the leading edge alone instead of the dimension `tip_point`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS
from r37core.time_integration.status import RunStatus

from .speed_ranges import ranges_above

DROP_WITHIN = 24.0
"""Speeds (rad/s) above a peak over which its motion counts as dropped."""

_RESPONDS = 2e-3
"""Motion (m) below which a range of speeds holds no interaction."""


def leading_edge(response: xr.Dataset) -> xr.Dataset:
    """The response with the leading edge's motion alone."""
    return response.sel(tip_point="leading_edge", drop=True) if "tip_point" in response.dims else response


def motion(response: xr.Dataset) -> np.ndarray:
    """Rms (m) of the leading edge's normal and tangential motion together, shape (speeds,); 0 where a run diverged."""
    edge = leading_edge(response)
    return np.nan_to_num(np.hypot(edge["rms_normal"].values, edge["rms_tangential"].values))


def peak_of(response: xr.Dataset) -> xr.Dataset:
    """The response at the speed of the largest motion: one definition for all blades, S100 moves hardly along the normal."""
    return response.isel(speed=int(np.argmax(motion(response))))


def peak_speed(response: xr.Dataset) -> float:
    """Speed (rad/s) of the peak; NaN where nothing answers, or what answers falls from the first speed on."""
    index = int(np.argmax(motion(response)))
    return float(response["speed"][index]) if index and motion(response)[index] >= _RESPONDS else np.nan


def drop_after(response: xr.Dataset, index: int | None = None) -> float:
    """Share of the motion at an `index` among the speeds, by default the peak, that is lost within DROP_WITHIN above it.

    NaN without a speed there.
    """
    level, speed = motion(response), response["speed"].values
    peak = int(np.argmax(level)) if index is None else index
    after = level[(speed > speed[peak]) & (speed <= speed[peak] + DROP_WITHIN + 1e-6)]
    return float(1.0 - after.min() / level[peak]) if after.size and level[peak] > 0.0 else np.nan


def steepest_fall(response: xr.Dataset) -> tuple[float, float]:
    """Speed (rad/s) before which the motion loses its largest share to the next speed, and that share."""
    level = motion(response)
    shares = 1.0 - np.divide(level[1:], level[:-1], out=np.ones(len(level) - 1), where=level[:-1] > 0.0)
    index = int(np.argmax(shares))
    return float(response["speed"][index]), float(shares[index])


def interactions_above(response: xr.Dataset, floor: float) -> int:
    """Separate ranges of speeds whose normal rms is above `floor` (m); a run that diverged is above."""
    above = np.concatenate([[0], leading_edge(response)["rms_normal"].fillna(np.inf).values > floor])
    return int(np.count_nonzero(np.diff(above.astype(int)) == 1))


def median_over_speed(response: xr.Dataset, name: str) -> float:
    """Value of a tip variable that half of the range of speeds lies below; each counts for its length of the range."""
    values = leading_edge(response)[name].values
    length = np.where(np.isfinite(values), np.gradient(response["speed"].values), 0.0)
    order = np.argsort(values)
    summed = np.cumsum(length[order])
    return float(values[order][np.searchsorted(summed, 0.5 * summed[-1])])


def strongest_order(amplitude: xr.DataArray, above: float = 0.5) -> float:
    """Engine order of the largest amplitude, of all not below `above`; `amplitude` over `engine_order` alone.

    The offset of the mean position, order 0, is no vibration.
    """
    vibration = amplitude.where(amplitude["engine_order"] >= above, 0.0).fillna(0.0)
    return float(vibration["engine_order"][int(np.argmax(vibration.values))])


def strongest_lobes(response: xr.Dataset) -> np.ndarray:
    """Number of lobes (3 to 12) of the largest harmonic of the wear, shape (speeds,)."""
    harmonics = response["wear_harmonic"].sel(lobes=slice(3, 12)).fillna(0.0)
    return harmonics["lobes"].values[harmonics.argmax("lobes").values].astype(float)


def first_contact(response: xr.Dataset) -> np.ndarray:
    """Number of the first revolution in which a tip point moves beyond its position at rest, shape (speeds,); NaN for none."""
    touched = response["revolution_maximum"].max("tip_point").transpose("speed", "revolution").values > 0.0
    return np.where(touched.any(axis=1), touched.argmax(axis=1) + 1.0, np.nan)


@dataclass(frozen=True)
class YieldRange:
    """Speeds (rad/s) above yield: the `first` and `last`, NaN for none, and the `length` of all between that are above.

    The length is NaN without any speed. `truncated`: whether the speeds begin or end above yield, and it may go on beyond.
    """

    first: float
    last: float
    length: float
    truncated: bool

    @property
    def width(self) -> float:
        """From the first to the last (rad/s); 0 where none is above."""
        return 0.0 if np.isnan(self.first) else self.last - self.first

    @property
    def share(self) -> float:
        """Share of the width that is above yield; NaN without a width."""
        return min(self.length / self.width, 1.0) if self.width > 0.0 else np.nan


def range_above_yield(speeds: np.ndarray, ratio: np.ndarray) -> YieldRange:
    """Where the stress, a `ratio` of yield at ascending `speeds` (rad/s), infinite of a run that diverged, is above it."""
    ranges = ranges_above(speeds, ratio, 1.0)
    if not ranges:
        return YieldRange(np.nan, np.nan, 0.0 if len(speeds) else np.nan, False)
    length = sum(part.length for part in ranges)
    return YieldRange(ranges[0].begin, ranges[-1].end, length, ranges[0].truncated or ranges[-1].truncated)


def ratio_to_yield(response: xr.Dataset, stress: str = "max_von_mises") -> xr.DataArray:
    """A stress, by default the last revolution's, as a share of yield, over the speeds that were run; infinite if diverged."""
    ratio = response[stress] / response["yield_stress"]
    return ratio.where(response["status"] != RunStatus.DIVERGED, np.inf).dropna("speed")


def speeds_above_yield(response: xr.Dataset, stress: str = "max_von_mises") -> YieldRange:
    """Where a stress of a response, by default the last revolution's, is above yield, over all its speeds."""
    ratio = ratio_to_yield(response, stress)
    return range_above_yield(ratio["speed"].values, ratio.values)


def width_above_yield(response: xr.Dataset) -> float:
    """Width (rad/s) from the first to the last speed above yield; NaN where the speeds begin or end above it."""
    above = speeds_above_yield(response)
    return np.nan if above.truncated else above.width


def largest_stress(response: xr.Dataset) -> tuple[float, float]:
    """Largest stress (Pa) over all speeds and its speed (rad/s); NaN where no run has one."""
    series = response["max_von_mises"].dropna("speed")
    if not series.size:
        return np.nan, np.nan
    index = int(np.argmax(series.values))
    return float(series[index]), float(series["speed"][index])


def motion_of_run(run: Mapping[str, np.ndarray]) -> float:
    """`motion` of one run (m), from the variables of its file."""
    edge = run["rms"][TIP_POINTS.index("leading_edge")]
    return float(np.nan_to_num(np.hypot(*(edge[DIRECTIONS.index(name)] for name in ("normal", "tangential")))))


def history_of(response: xr.Dataset, speed: float) -> np.ndarray:
    """Largest stress (Pa) of every revolution at a speed (rad/s) whose history was kept, shape (revolutions,)."""
    return response["max_von_mises_history"].sel(history_speed=speed).values


def first_yield(history: np.ndarray, yield_stress: float) -> float:
    """Number of the first revolution of a stress history (Pa) beyond yield; NaN if none is."""
    above = np.flatnonzero(history > yield_stress)
    return float(above[0] + 1) if len(above) else np.nan


def overtakes(ours: np.ndarray, theirs: np.ndarray) -> float:
    """First revolution from which `ours` stays above `theirs` for five revolutions; NaN if it never does."""
    above = np.lib.stride_tricks.sliding_window_view(ours > theirs, 5).all(axis=1)
    return float(np.argmax(above) + 1) if above.any() else np.nan


def slope_of_clearance(campbell: xr.Dataset, mode: str) -> float:
    """Change of the dynamic clearance per tangential displacement at rest, of one blade's Campbell diagram."""
    clearance = campbell["dynamic_clearance"].sel(mode=mode)
    slope = np.gradient(clearance.values, clearance["tangential_displacement"].values)
    return float(abs(slope[len(slope) // 2]))
