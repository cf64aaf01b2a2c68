"""Peaks of a curve by their prominence, the same as scipy.signal finds, whose import takes as long as ten runs. Light."""

import numpy as np
from numpy import ndarray


def peaks_with_prominence(curve: ndarray) -> tuple[ndarray, ndarray]:
    """Indices of the peaks of a `curve`, shape (points,), ascending, and the prominence of each.

    A peak is higher than what stands on both of its sides: the ends are none. Of a plateau it is the middle. Its prominence is
    its height above the higher one of two lowest places: those between it and, on either side, a higher place or the end.
    """
    starts = np.flatnonzero(np.diff(curve, prepend=np.nan) != 0.0)
    heights, middles = curve[starts], (starts + np.append(starts[1:], len(curve)) - 1) // 2
    places = np.flatnonzero((heights[1:-1] > heights[:-2]) & (heights[1:-1] > heights[2:])) + 1
    prominences = np.empty(len(places))
    for number, place in enumerate(places):
        # no number ends the reach of a peak, too
        higher = np.flatnonzero(~(heights <= heights[place]))
        before = heights[higher[higher < place].max(initial=-1) + 1 : place]
        after = heights[place + 1 : higher[higher > place].min(initial=len(heights))]
        prominences[number] = heights[place] - max(before.min(initial=heights[place]), after.min(initial=heights[place]))
    return middles[places], prominences


def prominent_peaks(curve: ndarray, prominence: float = 0.0) -> ndarray:
    """Indices of the peaks of a curve of at least this prominence, ascending."""
    peaks, prominences = peaks_with_prominence(curve)
    return peaks[prominences >= prominence]


def half_width(curve: ndarray, index: int) -> int:
    """Number of points about the peak at an index that are not below half of its prominence; 0 of what is not a peak."""
    peaks, prominences = peaks_with_prominence(curve)
    if index not in peaks:
        return 0
    height = curve[index] - 0.5 * prominences[peaks == index].item()
    low = np.flatnonzero(curve[:index] <= height)[-1]
    high = index + np.flatnonzero(curve[index:] <= height)[0]
    return int(high - low - 1 + np.sum(curve[[low, high]] == height))
