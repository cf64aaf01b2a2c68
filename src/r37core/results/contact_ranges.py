"""Rows of direct contact: ranges of speed that may be above yield, and what else is loud."""

from collections.abc import Callable, Mapping, Sequence
from operator import itemgetter
from typing import Any

import numpy as np
from numpy import ndarray
from xarray import Dataset

from r37core.base.peaks import half_width

from .columns import DROP_WITHIN, MOST_REVOLUTIONS, NOT_RESOLVED
from .danger import ranges_of, ratio_inside
from .exceedance import HALF_WIDTH, Exceedance, SpeedRange, exceedance_of, joined, outside, ranges_above
from .interaction import Interaction, interaction_row, range_columns
from .measures import motion, strongest_order

NO_NAME = "not named: no clear line of a spectrum lies at a mode"
NO_PEAK = "above yield without a peak of the motion: nothing to match with a mode"

_OF_NORMAL = 1.4826 / np.sqrt(1.5)
"""Standard deviation per median distance of a value from the line between its neighbours, of normal scatter."""


def rows_above_yield(
    response: Dataset, peaks: Sequence[Interaction], name: Callable[[Dataset], Mapping[str, Any]]
) -> list[Interaction]:
    """Rows by ascending speed: every range that may be above yield, and of the `peaks` those that lie in none of them.

    `name`: columns that name the response at one speed, see spectral_lines.named_by_lines.

    A range has speeds that are dangerous or sustained, one after another. `response`: of the leading edge.
    """
    exceedance = exceedance_of(response) if "share_of_revolutions_above_yield" in response else None
    ranges = _ranges(response, exceedance)
    rows = [_row(response, exceedance, within, name) for within in ranges]
    for peak in peaks:
        at = peak["peak_speed_rad_s"]
        if not any(within.begin <= at <= within.end for within in ranges):
            row = _row(response, exceedance, SpeedRange(at, at, truncated=False), name, peak_alone=True)
            rows.append(row | {"direction": peak["direction"]})
    return sorted(rows, key=itemgetter("peak_speed_rad_s"))


def ranges_without_peak(response: Dataset, reaches: Sequence[SpeedRange]) -> list[Interaction]:
    """Rows of ranges above yield, as far as they lie outside of the `reaches` of all interactions of a lined scene."""
    if "max_von_mises_inside" not in response:
        return []
    exceedance = exceedance_of(response)
    ratio = ratio_inside(response)
    above = ratio["speed"].values[ratio.values > 1.0]
    parts = [part for within in _ranges(response, exceedance) for part in outside(within, reaches)]
    alone = above[[not any(reach.begin <= speed <= reach.end for reach in reaches) for speed in above]]
    return [
        _row(response, exceedance, part, note=NO_PEAK) for part in parts if np.any((alone >= part.begin) & (alone <= part.end))
    ]


def _ranges(response: Dataset, exceedance: Exceedance | None) -> list[SpeedRange]:
    if exceedance is None:
        return []
    own = ranges_above(exceedance.speeds, exceedance.shares, MOST_REVOLUTIONS)
    dangerous, _, sustained = ranges_of(response).values()
    return joined([*own, *dangerous, *sustained])


def _row(
    response: Dataset,
    exceedance: Exceedance | None,
    within: SpeedRange,
    name: Callable[[Dataset], Mapping[str, Any]] = lambda _: {},
    *,
    peak_alone: bool = False,
    note: str = NO_NAME,
) -> Interaction:
    """The row of a range, or of a peak that lies in none: then the range is its speed."""
    speeds, level = response["speed"].values, motion(response)
    inside = np.flatnonzero((speeds >= within.begin) & (speeds <= within.end))
    at = int(np.argmax(level[inside]))
    index = int(inside[at])
    peak = response.isel(speed=index)
    largest = [name for name in ("normal", "tangential") if np.argmax(response[f"rms_{name}"].fillna(0.0).values[inside]) == at]
    ended = bool(np.isfinite(peak["rms_normal"]))
    order = round(strongest_order(peak["amplitude"])) if ended and "amplitude" in peak else None
    columns: dict[str, Any] = {"mode": "", "engine_order": order, "direction": largest[0] if len(largest) == 1 else "both"}
    columns |= name(peak) if ended else {}
    notes = [] if columns["mode"] else [note]
    if exceedance:
        columns |= range_columns(response, exceedance, within)
    if exceedance and not peak_alone:
        # ends of the row itself, which may be single speeds
        columns |= {"from_rad_s": within.begin, "to_rad_s": within.end}
        if len(inside) <= 2 and 0 < half_width(level, index) <= 2:
            gap = np.diff(speeds[index - 1 : index + 2]).max()
            notes.append(f"{NOT_RESOLVED}: one or two speeds show the peak, {gap:.3g} rad/s apart")
    if ended:
        columns["peak_motion_scatter_m"] = _scatter(speeds, level, index)
        columns["fall_speed_rad_s"], columns["fall_speed_scatter_rad_s"] = _fall(speeds, level, index)
    return interaction_row(response, index, response.isel(speed=inside), columns, "; ".join(notes))


def _scatter(speeds: ndarray, level: ndarray, index: int) -> float:
    """Standard deviation of the motion about the line between its neighbours, at the speeds nearest to a place; NaN for few."""
    if len(speeds) < 3:
        return np.nan
    share = (speeds[1:-1] - speeds[:-2]) / (speeds[2:] - speeds[:-2])
    off = np.abs(level[1:-1] - (1.0 - share) * level[:-2] - share * level[2:])
    distance = np.abs(speeds[1:-1] - speeds[index])
    # five at least
    near = distance <= max(HALF_WIDTH, np.sort(distance)[min(5, len(distance)) - 1])
    return float(_OF_NORMAL * np.median(off[near]))


def _fall(speeds: ndarray, level: ndarray, peak_index: int) -> tuple[float, float]:
    """Speed (rad/s) above a peak from which on the motion is below half of the peak's, and half of where it is so by turns."""
    loud = level[peak_index:] >= 0.5 * level[peak_index]
    quiet = np.flatnonzero(~loud)
    if not len(quiet):
        return np.nan, np.nan
    first = peak_index + int(quiet[0])
    again = np.flatnonzero(loud & (speeds[peak_index:] <= speeds[first] + DROP_WITHIN))
    last = max(first, peak_index + int(again[-1]) + 1)
    low, high = float(speeds[first - 1]), float(speeds[min(last, len(speeds) - 1)])
    return 0.5 * (low + high), 0.5 * (high - low)
