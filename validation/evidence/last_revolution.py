"""Stress of the last revolution, as the published figures have it; everything else judges all later revolutions."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from r37core.results.danger import ratio_to_yield
from r37core.results.exceedance import length_of, ranges_above


@dataclass(frozen=True)
class YieldRange:
    """Speeds (rad/s) above yield: the `first` and `last`, NaN for none, and the `length` of all between that are above.

    `truncated`: whether the speeds begin or end above yield, and it may go on beyond.
    """

    first: float
    last: float
    length: float
    truncated: bool

    @property
    def width(self) -> float:
        """Width (rad/s) from the first to the last speed above yield; 0 where none is above."""
        return 0.0 if np.isnan(self.first) else self.last - self.first

    @property
    def share(self) -> float:
        """Share of the width that is above yield; NaN without a width."""
        return min(self.length / self.width, 1.0) if self.width > 0.0 else np.nan


def speeds_above_yield(response: xr.Dataset) -> YieldRange:
    """Where the stress of the last revolution is above yield, over all speeds of a response."""
    ratio = ratio_to_yield(response, "max_von_mises_last_revolution")
    ranges = ranges_above(ratio["speed"].values, ratio.values, 1.0)
    if not ranges:
        return YieldRange(np.nan, np.nan, 0.0, False)
    return YieldRange(ranges[0].begin, ranges[-1].end, length_of(ranges), ranges[0].truncated or ranges[-1].truncated)


def width_above_yield(response: xr.Dataset) -> float:
    """Width (rad/s) from the first to the last speed above yield; NaN where the speeds begin or end above it."""
    above = speeds_above_yield(response)
    return np.nan if above.truncated else above.width
