"""What is read off a response inside the operating range."""

import numpy as np
import xarray as xr

from .exceedance import CERTAIN, exceedance_of
from .measures import has_strengths
from .operating_range import GOODMAN, INTEGRAL, LENGTH, MEASURES, SCATTER, OperatingRange


def operating_measures(response: xr.Dataset, operating: OperatingRange, *, chance_scatter: bool = True) -> dict[str, float]:
    """MEASURES of one blade in one scene; NaN without stress, and where the runs do not reach over the judged range.

    `chance_scatter`: whether chance is drawn.
    """
    measures = dict.fromkeys(MEASURES, np.nan)
    if "share_of_revolutions_above_yield" not in response:
        return measures
    exceedance = exceedance_of(response)
    if not operating.is_covered(exceedance.speeds):
        return measures
    measures[LENGTH] = operating.length(exceedance.ranges(CERTAIN))
    measures[INTEGRAL] = operating.integral(exceedance.speeds, exceedance.shares)
    if exceedance.chance and chance_scatter:
        drawn = [operating.integral(exceedance.speeds, shares) for shares in exceedance.drawn]
        measures[SCATTER] = float(np.std(drawn))
    if has_strengths(response):
        fatigue = exceedance_of(response, "share_of_revolutions_above_goodman")
        measures[GOODMAN] = operating.integral(fatigue.speeds, fatigue.shares)
    return measures
