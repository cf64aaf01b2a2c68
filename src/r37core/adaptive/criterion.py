"""Criterion for the speeds that adaptive sampling runs next: windows above crossings first, then where the response changes."""

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy import ndarray
from xarray import Dataset

from r37core.base.peaks import prominent_peaks
from r37core.base.speeds import RefinedRange

from .refinement_choice import RefinementChoice, Window

CURVES = ("rms_normal", "rms_tangential", "stress")
"""Curves over speed: rms (m) of the leading edge in two directions, largest stress inside the model as a share of yield."""

LEAST_OF_A_ROUND = 16
"""Speeds that a round may ask for where so many are left: each round makes Snakemake plan the whole run again."""


def dense_ranges(campbell: Dataset, windows: Sequence[Window]) -> list[tuple[float, float, float]]:
    """Windows above the crossings of one blade's Campbell diagram: first and last speed, longest interval (rad/s)."""
    windowed = []
    for window in windows:
        crossings = campbell["crossing_speed"].sel(mode=window.mode)
        window_orders = crossings["engine_order"] <= window.highest_engine_order
        for crossing in crossings.sel(engine_order=window_orders).dropna("engine_order").values.tolist():
            windowed.append(((1.0 + window.first) * crossing, (1.0 + window.last) * crossing, window.step))
    return windowed


def window_speeds(grid: RefinedRange, expected: Sequence[tuple[float, float, float]]) -> list[float]:
    """Speeds of the grid, beyond its coarse ones, that `dense_ranges` ask for, ascending."""
    added: list[int] = []
    waiting = list(pairwise(grid.coarse_indices()))
    while waiting:
        first, last = waiting.pop()
        start, end, length = grid.speed(first), grid.speed(last), (last - first) * grid.interval
        too_long = any(low < end and start < high and length > (1.0 + 1e-9) * step for low, high, step in expected)
        if too_long and last - first > 1:
            middle = (first + last) // 2
            added.append(middle)
            waiting += [(first, middle), (middle, last)]
    return [grid.speed(index) for index in sorted(added)]


def next_speeds(grid: RefinedRange, measured: Mapping[float, Sequence[float]], choice: RefinementChoice) -> list[float]:
    """Speeds (rad/s), ascending, in the middle of the intervals that are worth halving; none when all is known.

    `measured`: Danger and CURVES, NaN for no number, at each speed (rad/s), of one run or of several members of a sample after
    each other; an interval has their mean worth, of equal ones the longest comes first. Every coarse speed of the grid must be
    known.
    """
    speeds = np.array(sorted(measured))
    rows = np.array([measured[speed] for speed in speeds], dtype=float).reshape(len(speeds), -1, 1 + len(CURVES))
    indices = _grid_indices(grid, speeds)
    places = np.flatnonzero(indices >= 0)
    indices = indices[places]
    room = int(choice.largest_share * (grid.last + 1)) - len(indices)
    worth = np.mean([_worth(member.T, places, choice) for member in rows.swapaxes(0, 1)], axis=0)
    lengths = np.diff(indices)
    open_intervals = np.flatnonzero((lengths > 1) & (worth > 0.0))
    # half of the room, so that later rounds can follow what this one finds
    most = max(-(-room // 2), min(room, LEAST_OF_A_ROUND), 0)
    chosen = sorted(open_intervals, key=lambda i: (-worth[i], -lengths[i], i))[:most]
    return [grid.speed(int(indices[i] + indices[i + 1]) // 2) for i in sorted(chosen)]


def _grid_indices(grid: RefinedRange, speeds: ndarray) -> ndarray:
    """Index on the grid of each speed, -1 for one that is not on it."""
    nearest = np.rint((speeds / grid.unit - grid.start) / grid.refine_to).astype(int)
    pairs = zip(nearest, speeds, strict=True)
    return np.where([0 <= index <= grid.last and grid.speed(int(index)) == speed for index, speed in pairs], nearest, -1)


def _worth(measured: ndarray, places: ndarray, choice: RefinementChoice) -> ndarray:
    """Worth of halving each interval, shape (places - 1,): 0 for nothing, else the height in shares of a curve's top.

    Where the danger changes it is that of a top: borders of dangerous and unknown speeds make the lengths that blades are
    ranked by. `measured`: Danger and curves of one member, shape (1 + CURVES, speeds), of which those on the grid are at
    `places`.
    """
    danger, curves = measured[0, places], np.nan_to_num(measured[1:], nan=0.0)
    worth = (danger[:-1] != danger[1:]).astype(float)
    for values in curves:
        # a curve without numbers marks nothing
        top = values.max(initial=0.0) or 1.0
        curve = values[places] / top
        larger, change = np.maximum(curve[:-1], curve[1:]), np.abs(np.diff(curve))
        seen = (change > choice.change * larger) & (larger > choice.prominence)
        seen |= (change > choice.steep_change * larger) & (larger > choice.steep_prominence)
        seen |= _near_a_peak(curve, choice)
        worth = np.maximum(worth, np.where(seen, np.maximum(change, larger), 0.0))
    return worth


def _near_a_peak(curve: ndarray, choice: RefinementChoice) -> ndarray:
    """Mask of the intervals that touch a peak or, next to it without a gap, points within the share `peak` of its height."""
    # the lowest value at both ends, so that a peak on the first or last speed counts and a level curve has none
    peaks = prominent_peaks(np.concatenate([[curve.min()], curve, [curve.min()]]), choice.prominence)
    near = np.zeros(len(curve), dtype=bool)
    for peak in peaks - 1:
        high = curve >= (1.0 - choice.peak) * curve[peak]
        low = np.flatnonzero(~high[:peak])
        after = np.flatnonzero(~high[peak:])
        near[(low[-1] + 1 if len(low) else 0) : (peak + after[0] if len(after) else len(curve))] = True
    return near[:-1] | near[1:]
