"""What is read off a response inside the operating range."""

import numpy as np
import xarray as xr

from .exceedance import CERTAIN, exceedance_of
from .operating_range import OperatingRange

MEASURES = LENGTH, INTEGRAL, SCATTER = (
    "length_certain_operating_rad_s",
    "exceedance_integral_operating_rad_s",
    "exceedance_integral_operating_scatter_rad_s",
)
"""What is read off a response inside the operating range; in words: glossary.RANKING."""

RANK = "rank_operating"
"""Column of ranking.csv: place by the integral inside the operating range."""


def operating_measures(response: xr.Dataset, operating: OperatingRange) -> dict[str, float]:
    """MEASURES of one blade in one scene; NaN without stress, and where the runs do not reach over the judged range."""
    measures = dict.fromkeys(MEASURES, np.nan)
    if "share_of_revolutions_above_yield" not in response:
        return measures
    exceedance = exceedance_of(response)
    if not operating.is_covered(exceedance.speeds):
        return measures
    measures[LENGTH] = operating.length(exceedance.ranges(CERTAIN))
    measures[INTEGRAL] = operating.integral(exceedance.speeds, exceedance.shares)
    if exceedance.chance:
        drawn = [operating.integral(exceedance.speeds, shares) for shares in exceedance.drawn]
        measures[SCATTER] = float(np.std(drawn))
    return measures
