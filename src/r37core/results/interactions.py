"""Interactions: peaks of the response over speed, matched with modes and engine orders; ranges above yield on a bare casing.

Rows of direct contact are ranges of speed that may be above yield, and what else is loud.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from operator import itemgetter
from typing import Any

import numpy as np
import pandas as pd
from numpy import ndarray
from pandas import DataFrame
from xarray import Dataset

from r37core.base.peaks import half_width, prominent_peaks
from r37core.rom.naming import NAMED_MODES
from r37core.time_integration.status import RunStatus

from .closing import interaction_title
from .columns import DROP_WITHIN, INTERACTIONS, MOST_REVOLUTIONS, NOT_RESOLVED, names
from .danger import ranges_of, ratio_inside
from .datasets import response_of
from .events import Danger
from .exceedance import HALF_WIDTH, Exceedance, SpeedRange, exceedance_of, is_lined, joined, outside, ranges_above
from .interaction import Interaction, interaction_row, range_columns
from .interaction_choice import InteractionChoice
from .measures import leading_edge, motion, ran, strongest_order
from .spectral_lines import named_by_lines

QUIET = 0.1
"""Share of an interaction's peak below which the motion counts as outside, if it stays there."""

SPECTRA = {"normal": "amplitude", "tangential": "amplitude_tangential"}
"""Directions whose peaks are looked for, and the name of their spectrum in spectrum.nc."""


@dataclass(frozen=True)
class _Peak:
    """A peak of the rms in one direction, at an `index` among the speeds, and the crossing that explains it.

    `height`: share of the direction's largest; `top`: indices about it that are less than the prominence lower;
    `inner`: whether it falls by the prominence on both sides, as one at an end of the speeds does not.
    """

    direction: str
    index: int
    height: float
    top: range
    inner: bool
    mode: str
    engine_order: int | None
    crossing: float


def find_interactions(response: Dataset, campbell: Dataset, choice: InteractionChoice) -> list[Interaction]:
    """Interactions of one blade in one scene, by ascending speed, from its response and its Campbell diagram.

    In a lined scene peaks are matched with 1B, 1T and 2B; in direct contact lines of the spectrum name them (named_by_lines).
    Peaks of both directions are one interaction where they have the same crossing, are neighbours, or lie on each other's tops;
    peaks that no crossing explains, where they have the same engine order and one crossing could hold them. In direct contact
    peaks within a range of speeds that may be above yield are one row with it.
    """
    response = leading_edge(ran(response))
    if not response.sizes["speed"]:
        return []
    lined = is_lined(response)
    peaks = _interactions(response, campbell if lined else None, choice)
    if lined:
        ranges = ranges_without_peak(response, [peak["reach"] for peak in peaks])
        return sorted([*peaks, *ranges], key=itemgetter("peak_speed_rad_s"))
    return rows_above_yield(response, peaks, partial(named_by_lines, campbell=campbell, choice=choice))


def _interactions(response: Dataset, campbell: Dataset | None, choice: InteractionChoice) -> list[Interaction]:
    """Interactions by the peaks alone; without a Campbell diagram none is matched with a mode."""
    speed, level = response["speed"].values, motion(response)
    peaks = [peak for direction in SPECTRA for peak in _peaks(response, campbell, direction, choice)]
    groups = sorted(_groups(peaks, speed, level, choice), key=lambda group: _strongest(group, level))
    if not groups:
        return []
    peak_indices = [_strongest(group, level) for group in groups]
    lowest = [first + int(np.argmin(level[first : last + 1])) for first, last in pairwise(peak_indices)]
    interactions = []
    for group, peak_index, low, high in zip(groups, peak_indices, [0, *lowest], [*lowest, len(level) - 1], strict=True):
        if any(peak.inner for peak in group):
            begin, end = _loud(speed[low : high + 1], level[low : high + 1], peak_index - low)
            reach = response.isel(speed=slice(low + begin, low + end + 1))
            interactions.append(_interaction(response.isel(speed=slice(high + 1)), peak_index, reach, group))
    return interactions


def titles(interactions: Iterable[Interaction]) -> dict[float, str]:
    """Peak speed (rad/s) -> title."""
    return {row["peak_speed_rad_s"]: interaction_title(row["mode"], row["engine_order"]) for row in interactions}


def _peaks(response: Dataset, campbell: Dataset | None, direction: str, choice: InteractionChoice) -> Iterator[_Peak]:
    curve = response[f"rms_{direction}"].fillna(0.0).values
    largest = curve.max()
    if not largest > 0.0:
        return
    # a floor at both ends gives peaks there too: no interactions themselves, they end the reach of their neighbours
    indices = prominent_peaks(np.concatenate([[0.0], curve, [0.0]]), choice.prominence * largest) - 1
    inner = prominent_peaks(curve, choice.prominence * largest)
    for index in indices.tolist():
        low = np.flatnonzero(curve <= curve[index] - choice.prominence * largest)
        top = range(int(low[low < index].max(initial=-1)) + 1, int(low[low > index].min(initial=len(curve))))
        at = response.isel(speed=index)
        order = round(strongest_order(at[SPECTRA[direction]])) if SPECTRA[direction] in at else None
        crossing = _nearest_crossing(campbell, float(at["speed"]), order, choice)
        yield _Peak(direction, index, float(curve[index] / largest), top, index in inner, *crossing)


def _nearest_crossing(
    campbell: Dataset | None, speed: float, strongest: int | None, choice: InteractionChoice
) -> tuple[str, int | None, float]:
    """Mode, engine order and speed of the nearest Campbell crossing of the strongest order in the allowed window.

    Without a spectrum the order is not known, and of the many crossings the nearest says nothing.
    """
    if campbell is None or strongest is None:
        return "", strongest, float("nan")
    candidates: list[tuple[float, str, int, float]] = []
    for mode in NAMED_MODES:
        for order, crossing in campbell["crossing_speed"].sel(mode=mode).to_series().dropna().items():
            if order == strongest and -choice.below * crossing <= speed - crossing <= choice.above * crossing:
                candidates.append((abs(speed - crossing), mode, int(order), float(crossing)))
    return min(candidates)[1:] if candidates else ("", strongest, float("nan"))


def _groups(peaks: list[_Peak], speed: ndarray, level: ndarray, choice: InteractionChoice) -> list[list[_Peak]]:
    """Peaks that are one interaction together; the first of each has its crossing or, without one, its engine order."""
    ranked = sorted(peaks, key=lambda peak: (not peak.mode, -level[peak.index], -peak.height))

    def one_peak(peak: _Peak, other: _Peak) -> bool:
        explained_otherwise = peak.mode and other.mode and peak.crossing != other.crossing
        near = abs(peak.index - other.index) <= 1 or (peak.index in other.top and other.index in peak.top)
        return peak.index == other.index or (peak.direction != other.direction and near and not explained_otherwise)

    def one_interaction(both: list[_Peak], group: list[_Peak]) -> bool:
        if both[0].mode:
            return both[0].crossing == group[0].crossing
        indices = [peak.index for peak in group]
        low, high = sorted((speed[both[0].index], speed[group[0].index]))
        orders = {peak.engine_order for peak in both} & {peak.engine_order for peak in group} - {None}
        one_crossing = not group[0].mode and bool(orders) and high <= choice.span * low
        return one_crossing or min(indices) < both[0].index < max(indices)

    joined_directions = _joined([[peak] for peak in ranked], lambda new, group: any(one_peak(new[0], old) for old in group))
    return _joined(joined_directions, one_interaction)


def _joined(parts: list[list[_Peak]], belongs: Callable[[list[_Peak], list[_Peak]], bool]) -> list[list[_Peak]]:
    """The parts, each put to the first group before it that it belongs to."""
    groups: list[list[_Peak]] = []
    for part in parts:
        home = next((group for group in groups if belongs(part, group)), None)
        if home is None:
            groups.append(list(part))
        else:
            home += part
    return groups


def _loud(speed: ndarray, level: ndarray, peak: int) -> tuple[int, int]:
    """First and last index about the peak before the motion stays below QUIET of it for more than DROP_WITHIN."""
    loud = np.flatnonzero(level >= QUIET * level[peak])
    ends = np.flatnonzero(np.diff(speed[loud]) > DROP_WITHIN)
    at = int(np.searchsorted(loud, peak))
    first, last = loud[ends[ends < at].max(initial=-1) + 1], loud[ends[ends >= at].min(initial=len(loud) - 1)]
    return max(int(first) - 1, 0), min(int(last) + 1, len(level) - 1)


def _strongest(group: list[_Peak], level: ndarray) -> int:
    """Index of the peak with the largest motion, of those within the speeds if there is one."""
    return max(group, key=lambda peak: (peak.inner, level[peak.index])).index


def _interaction(response: Dataset, index: int, reach: Dataset, group: list[_Peak]) -> Interaction:
    """The row of a group, from the response up to where it drops, the `index` of its peak, and the response in its reach."""
    first = group[0]
    directions = {peak.direction for peak in group if peak.index == index}
    direction = "both" if len(directions) == len(SPECTRA) else min(directions)
    columns: dict[str, Any] = {
        "mode": first.mode,
        "engine_order": first.engine_order,
        "direction": direction,
        "campbell_speed_rad_s": first.crossing,
    }
    ends = SpeedRange(float(reach["speed"][0]), float(reach["speed"][-1]), truncated=False)
    if "share_of_revolutions_above_yield" in reach:
        columns |= range_columns(reach, exceedance_of(reach), ends)
    return interaction_row(response, index, reach, columns) | {"reach": ends}


def summarise(datasets: Mapping[str, Dataset], choice: InteractionChoice) -> DataFrame:
    """Table of all interactions, columns as in INTERACTIONS, from the datasets `campbell`, `rms` and, if there, others."""
    rows = [
        {"blade": blade, "scene": scene} | interaction
        for blade in datasets["rms"]["blade"].values
        for scene in datasets["rms"]["scene"].values
        for interaction in find_interactions(response_of(datasets, blade, scene), datasets["campbell"].sel(blade=blade), choice)
    ]
    return DataFrame(rows, columns=names(INTERACTIONS)).astype({"engine_order": "Int64"})


_OF = (
    "length_dangerous_rad_s", "length_unknown_rad_s", "dangerous_from_rad_s", "dangerous_to_rad_s", "peak_motion_m",
)  # fmt: skip


def sized(interactions: DataFrame, rms: Dataset) -> DataFrame:
    """The table with columns `frequency`, `size`, `unit`, `danger` and `onward`.

    `frequency` (Hz): of the engine order at the peak speed, NaN without one. `size`: length of the dangerous speeds
    (rad/s); in a scene without stress the motion (mm); `unit`: which of these. `danger`: Danger of the worst of its
    speeds in a word, empty without stress. `onward`: whether dangerous speeds reach to an end of those that were run, by `rms`.
    """
    table = interactions.reindex(columns=[*interactions.columns, *(name for name in _OF if name not in interactions)])
    length, unknown, begin, end, motion = (table[name].astype(float) for name in _OF)
    stress = length.notna().groupby(table["scene"]).transform("any").astype(bool)
    ran = rms["speed"].where(rms["status"] != RunStatus.NOT_RUN)
    pairs = pd.MultiIndex.from_frame(table[["blade", "scene"]])
    first, last = (ends.to_series().reindex(pairs).to_numpy() for ends in (ran.min("speed"), ran.max("speed")))
    return interactions.assign(
        frequency=table["engine_order"].astype(float) * table["peak_speed_rad_s"] / (2.0 * np.pi),
        size=length.where(stress, 1e3 * motion).fillna(0.0),
        unit=np.where(stress, "rad/s", "mm"),
        danger=np.select([length > 0.0, unknown > 0.0, length.notna()], [each.text for each in reversed(Danger)], ""),
        onward=(begin <= first) | (end >= last),
    )


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
