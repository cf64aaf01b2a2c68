"""Danger of runs: how far the stress of their judged revolutions goes, for verdict, tables, pictures and closing lines.

Judged are the later revolutions, in the region of the stress that decides (results.regions). A run that diverged is above yield
in all of them.
"""

import numpy as np
import xarray as xr

from r37core.time_integration.status import RunStatus

from .columns import DANGER, LENGTHS, MOST_REVOLUTIONS, SOME_REVOLUTIONS, names
from .exceedance import Exceedance, SpeedRange, exceedance_of, joined, length_of, ranges_above

STRESSES = {
    "largest_median_stress_pa": "max_von_mises_median",
    "largest_high_stress_pa": "max_von_mises_high",
    "largest_stress_pa": "max_von_mises_ever",
    "largest_goodman_share": "goodman_share",
}
"""Column of DANGER -> variable of a response whose largest value it is."""


def ratio_to_yield(response: xr.Dataset, stress: str = "max_von_mises_ever") -> xr.DataArray:
    """A stress, by default the largest, as a share of yield, over the speeds that were run; infinite if diverged."""
    ratio = response[stress] / response["yield_stress"]
    return ratio.where(response["status"] != RunStatus.DIVERGED, np.inf).dropna("speed")


def ranges_of(response: xr.Dataset, exceedance: Exceedance) -> dict[str, list[SpeedRange]]:
    """Ranges of speeds above yield, by the name of the column that has their length: in most and some revolutions, and ever."""
    ratio = ratio_to_yield(response)
    most, some = (exceedance.ranges(share) for share in (MOST_REVOLUTIONS, SOME_REVOLUTIONS))
    # between speeds the share's straight line is above its limit longer than the stress is above yield
    ever = joined([*some, *ranges_above(ratio["speed"].values, ratio.values, 1.0)])
    return dict(zip(names(LENGTHS), (most, some, ever), strict=True))


def largest_of(response: xr.Dataset) -> dict[str, float]:
    """Columns of DANGER but for LENGTHS: the largest over all speeds; NaN of what is not computed."""
    measures = dict.fromkeys(names(DANGER[len(LENGTHS) :]), np.nan)
    if "share_of_revolutions_above_yield" in response and (shares := exceedance_of(response).shares).size:
        measures["share_of_revolutions_above_yield"] = float(shares.max())
    for column, name in STRESSES.items():
        if name in response:
            measures[column] = float(response[name].max())
    if "max_von_mises_ever" in response and (known := response["max_von_mises_ever"].dropna("speed")).size:
        measures["largest_stress_speed_rad_s"] = float(known["speed"][int(np.argmax(known.values))])
        measures["largest_stress_over_yield"] = float(known.max() / response["yield_stress"])
    return measures


def danger_of(response: xr.Dataset) -> dict[str, float]:
    """DANGER of all speeds of a response; NaN of what is not computed."""
    measures = dict.fromkeys(names(DANGER), np.nan) | largest_of(response)
    if "share_of_revolutions_above_yield" in response and response.sizes["speed"]:
        ranges = ranges_of(response, exceedance_of(response))
        measures |= {name: length_of(parts) for name, parts in ranges.items()}
    return measures


def moved_by_error(response: xr.Dataset, stress: str, error: float) -> float:
    """Largest change of the length (rad/s) of the speeds at which a stress is above yield, if it has a relative `error`.

    NaN where the error is not known.
    """
    if np.isnan(error):
        return np.nan
    ratio = ratio_to_yield(response, stress)
    levels = (1.0, 1.0 + error, 1.0 / (1.0 + error))
    ranges = [ranges_above(ratio["speed"].values, ratio.values, level) for level in levels]
    nominal, *others = map(length_of, ranges)
    return max(abs(other - nominal) for other in others)
