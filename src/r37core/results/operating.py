"""Measures of a response inside the operating range."""

import numpy as np
import xarray as xr

from .columns import CERTAIN, OPERATING, names
from .exceedance import exceedance_of
from .measures import has_strengths
from .operating_range import OperatingRange


def operating_measures(response: xr.Dataset, operating: OperatingRange, *, chance_scatter: bool = True) -> dict[str, float]:
    """OPERATING of one blade in one scene; NaN without stress, and where the runs do not reach over the judged range.

    `chance_scatter`: whether chance is drawn.
    """
    measures = dict.fromkeys(names(OPERATING), np.nan)
    if "share_of_revolutions_above_yield" not in response:
        return measures
    exceedance = exceedance_of(response)
    if not operating.is_covered(exceedance.speeds):
        return measures
    measures["length_certain_operating_rad_s"] = operating.length(exceedance.ranges(CERTAIN))
    measures["exceedance_integral_operating_rad_s"] = operating.integral(exceedance.speeds, exceedance.shares)
    if exceedance.chance and chance_scatter:
        drawn = [operating.integral(exceedance.speeds, shares) for shares in exceedance.drawn]
        measures["exceedance_integral_operating_scatter_rad_s"] = float(np.std(drawn))
    if has_strengths(response):
        fatigue = exceedance_of(response, "share_of_revolutions_above_goodman")
        measures["goodman_integral_operating_rad_s"] = operating.integral(fatigue.speeds, fatigue.shares)
    return measures
