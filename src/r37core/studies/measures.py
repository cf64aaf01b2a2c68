"""What is read off the runs of one place: peak, drop, width above yield, first yield."""

from __future__ import annotations

import numpy as np
import xarray as xr

from .readings import motion

_RESPONDS = 2e-3
"""Rms of the motion (m) below which a window holds no interaction."""

_DROP_WITHIN = 24.0
_IN_A_ROW = 5


def peak_of(run: xr.Dataset) -> xr.Dataset:
    """The speed of the largest motion: one definition for all blades, for S100 moves hardly along the casing's normal."""
    return run.isel(speed=int(np.argmax(motion(run))))


def peak_speed(run: xr.Dataset) -> float:
    """Speed (rad/s) of the peak; NaN where nothing answers, or what answers falls from the window's first speed on."""
    peak = peak_of(run)
    speed = float(peak["speed"])
    return speed if motion(peak) >= _RESPONDS and speed > float(run["speed"][0]) else np.nan


def drop_after(run: xr.Dataset, within: float = _DROP_WITHIN) -> float:
    """Share of the peak's motion that is lost within so many rad/s above it; NaN without a speed there."""
    peak = peak_of(run)
    speed = float(peak["speed"])
    after = motion(run.sel(speed=slice(speed + 1e-6, speed + within + 1e-6)))
    return float(1.0 - after.min() / motion(peak)) if after.size else np.nan


def steepest_fall(run: xr.Dataset) -> tuple[float, float]:
    """Speed (rad/s) before which the motion loses its largest share to the next speed of the grid, and that share."""
    rms = motion(run)
    shares = 1.0 - rms[1:] / np.maximum(rms[:-1], np.finfo(float).tiny)
    row = int(np.argmax(shares))
    return float(run["speed"][row]), float(shares[row])


def width_above_yield(run: xr.Dataset, yield_stress: float) -> float:
    """Length (rad/s) of the range of speeds about the peak whose last revolution is above yield, its ends interpolated.

    A single speed below yield does not end it: near the end of a branch the motion is chaotic. NaN where the window ends
    above yield.
    """
    return _width(run, yield_stress, allowed=1)


def span_above_yield(run: xr.Dataset, yield_stress: float) -> float:
    """The same from the first to the last speed of the window above yield, whatever lies between."""
    return _width(run, yield_stress, allowed=run.sizes["speed"])


def _width(run: xr.Dataset, yield_stress: float, allowed: int) -> float:
    """Width, with up to `allowed` speeds in a row below yield."""
    largest = np.nan_to_num(run["max_von_mises"].values, nan=np.inf)
    speed, excess = run["speed"].values, largest / yield_stress - 1.0
    above = np.flatnonzero(excess > 0.0)
    if not len(above):
        return 0.0
    stretches = np.split(above, np.flatnonzero(np.diff(above) > allowed + 1) + 1)
    peak = int(np.argmax(motion(run)))
    stretch = min(stretches, key=lambda rows: float(np.abs(rows - peak).min()))
    first, last = stretch[0], stretch[-1]
    if first == 0 or last == len(speed) - 1:
        return np.nan
    return _crossing(speed, excess, last, last + 1) - _crossing(speed, excess, first, first - 1)


def _crossing(speed: np.ndarray, excess: np.ndarray, inside: int, outside: int) -> float:
    if not np.isfinite(excess[inside]):
        return float(speed[inside])
    share = excess[inside] / (excess[inside] - excess[outside])
    return float(speed[inside] + share * (speed[outside] - speed[inside]))


def history_of(run: xr.Dataset, speed: float) -> np.ndarray:
    """Largest stress (Pa) of every revolution at a speed (rad/s) whose history was kept, shape (revolutions,)."""
    return run["history"].sel(history_speed=speed).values


def first_yield(run: xr.Dataset, speed: float, yield_stress: float) -> float:
    """Number of the first revolution beyond yield at a speed (rad/s) whose history was kept; NaN if none is."""
    above = np.flatnonzero(history_of(run, speed) > yield_stress)
    return float(above[0] + 1) if len(above) else np.nan


def overtakes(ours: np.ndarray, theirs: np.ndarray) -> float:
    """First revolution from which `ours` stays above `theirs` for some revolutions; NaN if it never does."""
    above = np.lib.stride_tricks.sliding_window_view(ours > theirs, _IN_A_ROW).all(axis=1)
    return float(np.argmax(above) + 1) if above.any() else np.nan


def interactions_above(run: xr.Dataset, floor: float) -> int:
    """Separate stretches of speeds whose normal rms is above `floor` (m)."""
    above = np.concatenate([[0], run["rms_normal"].fillna(np.inf).values > floor])
    return int(np.count_nonzero(np.diff(above.astype(int)) == 1))


def median_over_speed(run: xr.Dataset, name: str) -> float:
    """Value that half of the range of speeds lies below; each counts for its length of the range, for a grid may be refined."""
    values = run[name].values
    length = np.where(np.isfinite(values), np.gradient(run["speed"].values), 0.0)
    order = np.argsort(values)
    summed = np.cumsum(length[order])
    return float(values[order][np.searchsorted(summed, 0.5 * summed[-1])])


def slope_of_clearance(campbell: xr.Dataset, mode: str) -> float:
    """Change of the dynamic clearance per tangential displacement at rest."""
    clearance = campbell["dynamic_clearance"].sel(mode=mode)
    slope = np.gradient(clearance.values, clearance["tangential_displacement"].values)
    return float(abs(slope[len(slope) // 2]))
