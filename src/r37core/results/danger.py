"""Danger of speeds: which are dangerous, which unknown and which sustained, for verdict, tables, pictures and closing lines.

Dangerous: yield is passed in some revolution, before the run leaves the model's limits. Unknown: these are left first.
Sustained: above yield in most of the later revolutions, wherever the model is. All in the region of the stress that decides
(results.regions).
"""

from collections.abc import Callable, Sequence

import numpy as np
from xarray import DataArray, Dataset

from r37core.time_integration.status import RunStatus

from .columns import DANGER, LEFT_BY, LENGTHS, MOST_REVOLUTIONS, names
from .exceedance import Exceedance, SpeedRange, exceedance_of, length_of, outside, ranges_above

STRESSES = {
    "largest_median_stress_pa": "max_von_mises_median",
    "largest_high_stress_pa": "max_von_mises_high",
    "largest_stress_pa": "max_von_mises_ever",
    "largest_stress_inside_pa": "max_von_mises_inside",
    "largest_goodman_share": "goodman_share",
}
"""Column of DANGER -> variable of a response whose largest value it is."""


def ratio_to_yield(response: Dataset, stress: str) -> DataArray:
    """A stress as a share of yield, over the speeds that were run; infinite if diverged."""
    ratio = response[stress] / response["yield_stress"]
    return ratio.where(response["status"] != RunStatus.DIVERGED, np.inf).dropna("speed")


def ratio_inside(response: Dataset) -> DataArray:
    """The largest stress before the model's limits are left, as a share of yield, over the speeds that were run.

    Infinite where a run diverged that had not left them before.
    """
    left = response["exit_revolution"].notnull()
    return ratio_to_yield(response.assign(status=response["status"].where(~left, RunStatus.COMPLETED)), "max_von_mises_inside")


def danger_ranges(response: Dataset, factor: float = 1.0) -> tuple[list[SpeedRange], list[SpeedRange]]:
    """Ranges of dangerous speeds, and of unknown ones, which do not overlap; with stresses that are larger by a `factor`.

    Between two speeds the stress is a straight line; an unknown speed reaches half of the way to the next one.
    """
    ratio = ratio_inside(response)
    speeds, above = ratio["speed"].values, factor * ratio.values > 1.0
    left = response["exit_revolution"].sel(speed=ratio["speed"]).notnull().values
    dangerous = ranges_above(speeds, ratio.values, 1.0 / factor)
    reached = ranges_above(speeds, (left & ~above).astype(float), 0.5)
    return dangerous, [part for within in reached for part in outside(within, dangerous) if part.length > 0.0]


def ranges_of(response: Dataset) -> dict[str, list[SpeedRange]]:
    """Ranges of dangerous, unknown and sustained speeds, by the name of the column that has their length."""
    sustained = exceedance_of(response).ranges(MOST_REVOLUTIONS)
    return dict(zip(names(LENGTHS), (*danger_ranges(response), sustained), strict=True))


def grid_scatter(response: Dataset, measure: Callable[[Sequence[SpeedRange]], float] | None = None) -> float:
    """Standard deviation (rad/s) of the length, or another `measure`, of the dangerous speeds by the distance of the speeds."""
    ratio = ratio_inside(response)
    # an infinite one has no mean
    return Exceedance(ratio["speed"].values, ratio.clip(max=1e6).values, chance=False).scatter_of_length(1.0, measure)


def largest_of(response: Dataset) -> dict[str, float]:
    """Columns of DANGER but for LENGTHS: the largest over all speeds; NaN of what is not computed."""
    measures = dict.fromkeys(names(DANGER[len(LENGTHS) :]), np.nan)
    if "share_of_revolutions_above_yield" in response and (shares := exceedance_of(response).shares).size:
        measures["share_of_revolutions_above_yield"] = float(shares.max())
    for column, name in STRESSES.items():
        if name in response:
            measures[column] = float(response[name].max())
    if "max_von_mises_inside" in response and (known := response["max_von_mises_inside"].dropna("speed")).size:
        measures["largest_stress_speed_rad_s"] = float(known["speed"][int(np.argmax(known.values))])
        measures["largest_stress_over_yield"] = float(known.max() / response["yield_stress"])
    if "exit_cause" in response:
        causes = response["exit_cause"].values
        measures |= {column.name: float(np.count_nonzero(causes == cause)) for cause, column in LEFT_BY.items()}
    return measures


def danger_of(response: Dataset) -> dict[str, float]:
    """DANGER of all speeds of a response; NaN of what is not computed."""
    measures = dict.fromkeys(names(DANGER), np.nan) | largest_of(response)
    if "max_von_mises_inside" in response and response.sizes["speed"]:
        measures |= {name: length_of(parts) for name, parts in ranges_of(response).items()}
    return measures


def moved_by_error(response: Dataset, error: float) -> float:
    """Largest change of the length (rad/s) of the dangerous speeds if the stress has a relative `error`.

    NaN where the error is not known.
    """
    if np.isnan(error):
        return np.nan
    nominal, *others = (length_of(danger_ranges(response, factor)[0]) for factor in (1.0, 1.0 + error, 1.0 / (1.0 + error)))
    return max(abs(other - nominal) for other in others)
