"""What is read off the runs of one place, whose yield stress (Pa) is not among them."""

from __future__ import annotations

import numpy as np
import xarray as xr

from r37core.results import measures
from r37core.results.measures import (
    drop_after,
    interactions_above,
    median_over_speed,
    motion,
    overtakes,
    peak_of,
    peak_speed,
    slope_of_clearance,
    steepest_fall,
)

__all__ = [
    "drop_after",
    "first_yield",
    "history_of",
    "interactions_above",
    "median_over_speed",
    "motion",
    "overtakes",
    "peak_of",
    "peak_speed",
    "slope_of_clearance",
    "steepest_fall",
    "width_above_yield",
]


def width_above_yield(run: xr.Dataset, yield_stress: float) -> float:
    """Width (rad/s) from the first to the last speed above yield; NaN where the run begins or ends above it."""
    return measures.width_above_yield(run.assign(yield_stress=yield_stress))


def history_of(run: xr.Dataset, speed: float) -> np.ndarray:
    """Largest stress (Pa) of every revolution at a speed (rad/s) whose history was kept, shape (revolutions,)."""
    return run["history"].sel(history_speed=speed).values


def first_yield(run: xr.Dataset, speed: float, yield_stress: float) -> float:
    """Number of the first revolution beyond yield at a speed (rad/s) whose history was kept; NaN if none is."""
    return measures.first_yield(history_of(run, speed), yield_stress)
