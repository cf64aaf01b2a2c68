"""Measures of a response, each declared once: for the summary, designs, refinement, studies, figures and the explorer.

A `response` is one blade in one scene, with the variables of response.nc over ascending `speed` (rad/s); those of the tip may
have the leading edge alone instead of the dimension `tip_point`.
"""

import numpy as np
from numpy import ndarray
from xarray import DataArray, Dataset

from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

from .columns import DROP_WITHIN

_RESPONDS = 2e-3
"""Motion (m) below which a range of speeds holds no interaction."""


def leading_edge(response: Dataset) -> Dataset:
    """The response with the leading edge's motion alone."""
    return response.sel(tip_point="leading_edge", drop=True) if "tip_point" in response.dims else response


def ran(response: Dataset) -> Dataset:
    """The response over the speeds that were run alone."""
    return response.isel(speed=np.flatnonzero(response["status"].values != RunStatus.NOT_RUN))


def motion(response: Dataset) -> ndarray:
    """Rms (m) of the leading edge's normal and tangential motion together, shape (speeds,); 0 where a run diverged."""
    edge = leading_edge(response)
    return np.nan_to_num(np.hypot(edge["rms_normal"].values, edge["rms_tangential"].values))


def peak_of(response: Dataset) -> Dataset:
    """The response at the speed of the largest motion: one definition for all blades, S100 moves hardly along the normal."""
    return response.isel(speed=int(np.argmax(motion(response))))


def peak_speed(response: Dataset) -> float:
    """Speed (rad/s) of the peak; NaN where nothing answers, or what answers falls from the first speed on."""
    index = int(np.argmax(motion(response)))
    return float(response["speed"][index]) if index and motion(response)[index] >= _RESPONDS else np.nan


def drop_after(response: Dataset, index: int | None = None) -> float:
    """Share of the motion at an `index` among the speeds, by default the peak, that is lost within DROP_WITHIN above it.

    NaN without a speed there.
    """
    level, speed = motion(response), response["speed"].values
    peak = int(np.argmax(level)) if index is None else index
    after = level[(speed > speed[peak]) & (speed <= speed[peak] + DROP_WITHIN + 1e-6)]
    return float(1.0 - after.min() / level[peak]) if after.size and level[peak] > 0.0 else np.nan


def strongest_order(amplitude: DataArray) -> float:
    """Engine order of the largest amplitude, of all from 0.5 on; `amplitude` over `engine_order` alone.

    The offset of the mean position, order 0, is no vibration.
    """
    vibration = amplitude.where(amplitude["engine_order"] >= 0.5, 0.0).fillna(0.0)
    return float(vibration["engine_order"][int(np.argmax(vibration.values))])


def has_strengths(response: Dataset) -> bool:
    """True for a response with shares of the Goodman line: fatigue of a blade whose material has strengths."""
    return "fatigue_strength" in response and bool(np.isfinite(response["fatigue_strength"]))


def lasts(response: Dataset) -> DataArray:
    """Runs whose motion lasts or grows at the end, or that diverged: true or false over the speeds."""
    return ~response["motion_at_end"].isin([MotionAtEnd.QUIET, MotionAtEnd.CUT_FREE])


def first_yield(history: ndarray, yield_stress: float) -> float:
    """Number of the first revolution of a stress history (Pa) beyond yield; NaN if none is."""
    above = np.flatnonzero(history > yield_stress)
    return float(above[0] + 1) if len(above) else np.nan
