"""Stress of the last revolution, as the published figures have it; everything else judges all later revolutions."""

import numpy as np
import xarray as xr

from r37core.results.danger import ratio_to_yield
from r37core.results.exceedance import ranges_above


def width_above_yield(response: xr.Dataset) -> float:
    """Width (rad/s) from the first to the last speed above yield; 0 for none, NaN where the speeds begin or end above it."""
    ratio = ratio_to_yield(response, "max_von_mises_last_revolution")
    ranges = ranges_above(ratio["speed"].values, ratio.values, 1.0)
    if not ranges:
        return 0.0
    return np.nan if ranges[0].truncated or ranges[-1].truncated else ranges[-1].end - ranges[0].begin
