"""Interactions: peaks of the response over speed, matched with modes and engine orders; ranges above yield on a bare casing."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from operator import itemgetter
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from scipy.signal import find_peaks

from r37core.rom.naming import NAMED_MODES
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

from .closing import interaction_title
from .columns import DROP_WITHIN, INTERACTIONS, MOST_REVOLUTIONS, SOME_REVOLUTIONS, names
from .datasets import response_of
from .exceedance import HALF_WIDTH, Exceedance, SpeedRange, exceedance_of, is_lined, joined, ranges_above
from .interaction_choice import InteractionChoice
from .measures import (
    drop_after,
    largest_stress,
    lasts,
    leading_edge,
    motion,
    ratio_to_yield,
    speeds_above_yield,
    strongest_order,
)
from .variables import PLACES

QUIET = 0.1
"""Share of an interaction's peak below which the motion counts as outside, if it stays there."""

SPECTRA = {"normal": "amplitude", "tangential": "amplitude_tangential"}
"""Directions whose peaks are looked for, and the name of their spectrum in spectrum.nc."""

Interaction = dict[str, Any]
"""Column of INTERACTIONS -> value; NaN is what a scene does not compute.

Of a lined scene an interaction is a peak of the motion; of direct contact a range of speeds that may be above yield, for a
peak's crossing and one revolution's stress are chance there, and their columns are empty. `note` says why columns are, and
where the lining is worn through. Without a crossing that explains the peak `mode` is empty.

An interaction reaches, on both sides, to the lowest motion before the neighbouring peak, or to where the motion stays below
QUIET of its own peak for more than DROP_WITHIN: single speeds in between do not end it, for near the end of a branch the motion
is chaotic.
"""


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


def find_interactions(response: xr.Dataset, campbell: xr.Dataset, choice: InteractionChoice) -> list[Interaction]:
    """Interactions of one blade in one scene, by ascending speed, from its response and its Campbell diagram.

    Only the named modes 1B, 1T and 2B are matched, and only in a lined scene. Peaks of both directions are one interaction
    where they have the same crossing, are neighbours, or lie on each other's tops; peaks that no crossing explains, where they
    have the same engine order and one crossing could hold them. In direct contact peaks within a range of speeds that may be
    above yield are one row with it.
    """
    response = leading_edge(response.isel(speed=np.flatnonzero(response["status"].values != RunStatus.NOT_RUN)))
    if not response.sizes["speed"]:
        return []
    lined = is_lined(response)
    peaks = _interactions(response, campbell if lined else None, choice)
    if lined:
        return sorted([*peaks, *ranges_without_peak(response, peaks)], key=itemgetter("peak_speed_rad_s"))
    return rows_above_yield(response, peaks)


def _interactions(response: xr.Dataset, campbell: xr.Dataset | None, choice: InteractionChoice) -> list[Interaction]:
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


def _peaks(response: xr.Dataset, campbell: xr.Dataset | None, direction: str, choice: InteractionChoice) -> list[_Peak]:
    curve = response[f"rms_{direction}"].fillna(0.0).values
    largest = curve.max()
    if not largest > 0.0:
        return []
    # a floor at both ends gives peaks there too: no interactions themselves, they end the reach of their neighbours
    indices = find_peaks(np.concatenate([[0.0], curve, [0.0]]), prominence=choice.prominence * largest)[0] - 1
    inner = find_peaks(curve, prominence=choice.prominence * largest)[0]
    peaks = []
    for index in indices.tolist():
        low = np.flatnonzero(curve <= curve[index] - choice.prominence * largest)
        top = range(int(low[low < index].max(initial=-1)) + 1, int(low[low > index].min(initial=len(curve))))
        at = response.isel(speed=index)
        order = round(strongest_order(at[SPECTRA[direction]])) if SPECTRA[direction] in at else None
        crossing = _nearest_crossing(campbell, float(at["speed"]), order, choice)
        peaks.append(_Peak(direction, index, float(curve[index] / largest), top, index in inner, *crossing))
    return peaks


def _nearest_crossing(
    campbell: xr.Dataset | None, speed: float, strongest: int | None, choice: InteractionChoice
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


def _groups(peaks: list[_Peak], speed: np.ndarray, level: np.ndarray, choice: InteractionChoice) -> list[list[_Peak]]:
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


def _loud(speed: np.ndarray, level: np.ndarray, peak: int) -> tuple[int, int]:
    """First and last index about the peak before the motion stays below QUIET of it for more than DROP_WITHIN."""
    loud = np.flatnonzero(level >= QUIET * level[peak])
    ends = np.flatnonzero(np.diff(speed[loud]) > DROP_WITHIN)
    at = int(np.searchsorted(loud, peak))
    first, last = loud[ends[ends < at].max(initial=-1) + 1], loud[ends[ends >= at].min(initial=len(loud) - 1)]
    return max(int(first) - 1, 0), min(int(last) + 1, len(level) - 1)


def _strongest(group: list[_Peak], level: np.ndarray) -> int:
    """Index of the peak with the largest motion, of those within the speeds if there is one."""
    return max(group, key=lambda peak: (peak.inner, level[peak.index])).index


def _interaction(response: xr.Dataset, index: int, reach: xr.Dataset, group: list[_Peak]) -> Interaction:
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
    if "max_von_mises" in reach:
        above, (largest, at) = speeds_above_yield(reach), largest_stress(reach)
        columns |= {
            "first_yield_speed_rad_s": above.first,
            "width_above_yield_rad_s": above.width,
            "share_above_yield": above.share,
            "max_von_mises_pa": largest,
            "max_von_mises_speed_rad_s": at,
        }
    if "share_of_revolutions_above_yield" in reach:
        ends = SpeedRange(float(reach["speed"][0]), float(reach["speed"][-1]), truncated=False)
        columns |= range_columns(exceedance_of(reach), ends)
        columns["width_ever_above_yield_rad_s"] = speeds_above_yield(reach, "max_von_mises_ever").width
    return interaction_row(response, index, reach, columns)


def summarise(datasets: Mapping[str, xr.Dataset], choice: InteractionChoice) -> pd.DataFrame:
    """Table of all interactions, columns as in INTERACTIONS, from the datasets `campbell`, `rms` and, if there, others."""
    rows = [
        {"blade": blade, "scene": scene} | interaction
        for blade in datasets["rms"]["blade"].values
        for scene in datasets["rms"]["scene"].values
        for interaction in find_interactions(response_of(datasets, blade, scene), datasets["campbell"].sel(blade=blade), choice)
    ]
    return pd.DataFrame(rows, columns=names(INTERACTIONS)).astype({"engine_order": "Int64"})


LEAST_THICKNESS = "the sufficient thickness is a lower bound"


def range_columns(exceedance: Exceedance, within: SpeedRange) -> dict[str, Any]:
    """Where within a row's speeds a share of the revolutions is above yield, with the scatter of the borders."""
    columns: dict[str, Any] = {}
    for name, share in (("some_revolutions", SOME_REVOLUTIONS), ("most_revolutions", MOST_REVOLUTIONS)):
        ranges = [part for part in exceedance.ranges(share) if part.end >= within.begin and part.begin <= within.end]
        if name == "most_revolutions":
            columns["length_most_revolutions_rad_s"] = sum(
                min(part.end, within.end) - max(part.begin, within.begin) for part in ranges
            )
        if ranges:
            begin, end = max(ranges[0].begin, within.begin), min(ranges[-1].end, within.end)
            columns[f"{name}_from_rad_s"], columns[f"{name}_to_rad_s"] = begin, end
            columns[f"{name}_from_scatter_rad_s"] = exceedance.scatter_of_border(share, ranges[0], begins=True)
            columns[f"{name}_to_scatter_rad_s"] = exceedance.scatter_of_border(share, ranges[-1], begins=False)
    return columns


def interaction_row(
    response: xr.Dataset, index: int, reach: xr.Dataset, columns: Mapping[str, Any], note: str = ""
) -> Interaction:
    """The row of a `response` with its peak at an `index` among the speeds; `columns`: crossing and what is known already.

    The largest of everything, and how its runs ended, are those of all speeds of its `reach`.
    """
    speed, normal, tangential = (float(response[name][index]) for name in ("speed", "rms_normal", "rms_tangential"))
    worn_through, status = _largest(reach, "worn_through_share"), RunStatus(int(reach["status"].max()))
    why = ""
    if worn_through > 0.0:
        why = "worn through"
    elif status == RunStatus.DIVERGED and "used_thickness" in reach:
        why = status.text
    return {
        **dict.fromkeys(names(INTERACTIONS[2:]), np.nan),
        "peak_speed_rad_s": speed,
        "peak_rms_normal_m": normal,
        "peak_rms_tangential_m": tangential,
        "peak_motion_m": float(np.hypot(normal, tangential)),
        "drop": drop_after(response, index),
        **_place(reach),
        "stress_region": str(reach["stress_region"].item()) if "stress_region" in reach else "",
        "median_von_mises_pa": _largest(reach, "max_von_mises_median"),
        "high_von_mises_pa": _largest(reach, "max_von_mises_high"),
        "largest_goodman_share": _largest(reach, "goodman_share"),
        "max_wear_m": _largest(reach, "max_wear"),
        "worn_through_share": worn_through,
        "sufficient_thickness_m": _largest(reach, "used_thickness"),
        "largest_penetration_m": _largest(reach, "largest_penetration"),
        "status": status.text,
        "motion_at_end": MotionAtEnd(int(response["motion_at_end"][index])).text if "motion_at_end" in response else "",
        "lasting_share": float(lasts(reach).mean()) if "motion_at_end" in reach else np.nan,
        "note": "; ".join(filter(None, (note, f"{why}: {LEAST_THICKNESS}" if why else ""))),
        **columns,
        "shift_rad_s": speed - columns.get("campbell_speed_rad_s", np.nan),
    }


def _place(reach: xr.Dataset) -> dict[str, float]:
    """Where on the blade the largest stress of all speeds is."""
    if "max_von_mises_ever" not in reach or not (known := reach["max_von_mises_ever"].dropna("speed")).size:
        return {}
    worst = reach.sel(speed=known["speed"][int(np.argmax(known.values))])
    places = (f"max_von_mises_{name}" for name in PLACES)
    return {place: float(worst[place]) for place in places if place in worst}


def _largest(reach: xr.Dataset, name: str) -> float:
    return float(reach[name].max()) if name in reach else np.nan


NOTE = "direct contact: matches with modes and the stress of one revolution are chance"
NO_PEAK = "above yield without a peak of the motion: nothing to match with a mode"

_OF_NORMAL = 1.4826 / np.sqrt(1.5)
"""Standard deviation per median distance of a value from the line between its neighbours, of normal scatter."""


def rows_above_yield(response: xr.Dataset, peaks: Sequence[Interaction]) -> list[Interaction]:
    """Rows by ascending speed: every range that may be above yield, and of the `peaks` those that lie in none of them.

    A range is where the smoothed share of the revolutions above yield is above SOME_REVOLUTIONS, where a speed's own share is,
    or where its last revolution is above yield; so no such speed is in no row. `response`: of the leading edge.
    """
    exceedance = exceedance_of(response) if "share_of_revolutions_above_yield" in response else None
    ranges = _ranges(response, exceedance)
    rows = [_row(response, exceedance, within) for within in ranges]
    for peak in peaks:
        at = peak["peak_speed_rad_s"]
        if not any(within.begin <= at <= within.end for within in ranges):
            row = _row(response, exceedance, SpeedRange(at, at, truncated=False), peak_alone=True)
            rows.append(row | {"direction": peak["direction"]})
    return sorted(rows, key=itemgetter("peak_speed_rad_s"))


def ranges_without_peak(response: xr.Dataset, rows: Sequence[Interaction]) -> list[Interaction]:
    """Rows of ranges above yield that no interaction among the `rows` of a lined scene reaches into."""
    if "share_of_revolutions_above_yield" not in response:
        return []
    exceedance = exceedance_of(response)
    return [
        _row(response, exceedance, within, note=NO_PEAK)
        for within in _ranges(response, exceedance)
        if not any(
            row["some_revolutions_from_rad_s"] <= within.end and row["some_revolutions_to_rad_s"] >= within.begin
            for row in rows
        )
    ]


def _ranges(response: xr.Dataset, exceedance: Exceedance | None) -> list[SpeedRange]:
    if exceedance is None:
        return []
    ratio = ratio_to_yield(response)
    own = ranges_above(exceedance.speeds, exceedance.shares, SOME_REVOLUTIONS)
    return joined([*exceedance.ranges(SOME_REVOLUTIONS), *own, *ranges_above(ratio["speed"].values, ratio.values, 1.0)])


def _row(
    response: xr.Dataset, exceedance: Exceedance | None, within: SpeedRange, *, peak_alone: bool = False, note: str = NOTE
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
    if exceedance:
        columns |= range_columns(exceedance, within)
    if exceedance and not peak_alone:
        # ends of the row itself, which may be single speeds
        columns |= {"some_revolutions_from_rad_s": within.begin, "some_revolutions_to_rad_s": within.end}
    if ended:
        columns["peak_motion_scatter_m"] = _scatter(speeds, level, index)
        columns["fall_speed_rad_s"], columns["fall_speed_scatter_rad_s"] = _fall(speeds, level, index)
    return interaction_row(response, index, response.isel(speed=inside), columns, note)


def _scatter(speeds: np.ndarray, level: np.ndarray, index: int) -> float:
    """Standard deviation of the motion about the line between its neighbours, at the speeds nearest to a place; NaN for few."""
    if len(speeds) < 3:
        return np.nan
    share = (speeds[1:-1] - speeds[:-2]) / (speeds[2:] - speeds[:-2])
    off = np.abs(level[1:-1] - (1.0 - share) * level[:-2] - share * level[2:])
    distance = np.abs(speeds[1:-1] - speeds[index])
    # five at least
    near = distance <= max(HALF_WIDTH, np.sort(distance)[min(5, len(distance)) - 1])
    return float(_OF_NORMAL * np.median(off[near]))


def _fall(speeds: np.ndarray, level: np.ndarray, peak_index: int) -> tuple[float, float]:
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


_OF = (
    "length_most_revolutions_rad_s", "width_above_yield_rad_s", "most_revolutions_from_rad_s", "most_revolutions_to_rad_s",
    "peak_motion_m",
)  # fmt: skip


def sized(interactions: pd.DataFrame, rms: xr.Dataset) -> pd.DataFrame:
    """The table with columns `frequency`, `size`, `unit` and `onward`.

    `frequency` (Hz): of the engine order at the peak speed, NaN without one. `size`: length above yield in most revolutions,
    or the width where there is none (rad/s); in a scene without stress the motion (mm); `unit`: which of these. `onward`:
    whether the speeds above yield reach to an end of those that were run, by `rms`.
    """
    table = interactions.reindex(columns=[*interactions.columns, *(name for name in _OF if name not in interactions)])
    length, width, begin, end, motion = (table[name].astype(float) for name in _OF)
    length = length.fillna(width)
    stress = length.notna().groupby(table["scene"]).transform("any").astype(bool)
    ran = rms["speed"].where(rms["status"] != RunStatus.NOT_RUN)
    pairs = pd.MultiIndex.from_frame(table[["blade", "scene"]])
    first, last = (ends.to_series().reindex(pairs).to_numpy() for ends in (ran.min("speed"), ran.max("speed")))
    return interactions.assign(
        frequency=table["engine_order"].astype(float) * table["peak_speed_rad_s"] / (2.0 * np.pi),
        size=length.where(stress, 1e3 * motion).fillna(0.0),
        unit=np.where(stress, "rad/s", "mm"),
        onward=(begin <= first) | (end >= last),
    )
