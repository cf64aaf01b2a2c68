"""One row of summary.csv, and what all rows are given by the revolutions of their runs."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import xarray as xr

from r37core.time_integration.status import RunStatus

from .exceedance import CERTAIN, POSSIBLE, Exceedance
from .interaction_title import interaction_title
from .speed_ranges import SpeedRange


@dataclass(frozen=True)
class Interaction:
    """One row of summary.csv; units are part of the names.

    Of a lined scene it is a peak of the motion; of direct contact a range of speeds that may be above yield (results.
    contact_ranges), for a peak's crossing and one revolution's stress are chance there, and their columns are empty. `note`
    says why columns are.

    glossary.INTERACTIONS says what each field is. What is named peak is at the peak speed, what is named max the largest
    within the interaction. An interaction reaches, on both sides, to the lowest motion before the neighbouring peak, or to
    where the motion stays below QUIET of its own peak for more than measures.DROP_WITHIN: single speeds in between do not
    end it, for near the end of a branch the motion is chaotic. `mode` is empty and the Campbell speed NaN for a peak that no
    crossing of a named mode explains; NaN is also what a scene does not compute. What ends in scatter is the standard
    deviation by chance of what stands before it (results.exceedance).
    """

    mode: str
    engine_order: int | None
    direction: str
    campbell_speed_rad_s: float
    peak_speed_rad_s: float
    shift_rad_s: float
    peak_rms_normal_m: float
    peak_rms_tangential_m: float
    drop: float
    first_yield_speed_rad_s: float = np.nan
    width_above_yield_rad_s: float = np.nan
    share_above_yield: float = np.nan
    max_von_mises_pa: float = np.nan
    max_von_mises_speed_rad_s: float = np.nan
    stress_region: str = ""
    max_wear_m: float = np.nan
    status: str = ""
    width_ever_above_yield_rad_s: float = np.nan
    possible_from_rad_s: float = np.nan
    possible_from_scatter_rad_s: float = np.nan
    possible_to_rad_s: float = np.nan
    possible_to_scatter_rad_s: float = np.nan
    certain_from_rad_s: float = np.nan
    certain_from_scatter_rad_s: float = np.nan
    certain_to_rad_s: float = np.nan
    certain_to_scatter_rad_s: float = np.nan
    certain_length_rad_s: float = np.nan
    median_von_mises_pa: float = np.nan
    high_von_mises_pa: float = np.nan
    peak_motion_m: float = np.nan
    peak_motion_scatter_m: float = np.nan
    fall_speed_rad_s: float = np.nan
    fall_speed_scatter_rad_s: float = np.nan
    note: str = ""

    @property
    def title(self) -> str:
        """What meets there: 1B/4, or the engine order alone."""
        return interaction_title(self.mode, self.engine_order)


COLUMNS = ("blade", "scene", *(field.name for field in fields(Interaction)))
"""Columns of summary.csv."""


def range_columns(exceedance: Exceedance, within: SpeedRange) -> dict[str, Any]:
    """Where within a row's speeds a share of the revolutions is above yield, with the scatter of the borders."""
    columns: dict[str, Any] = {}
    for name, share in (("possible", POSSIBLE), ("certain", CERTAIN)):
        ranges = [part for part in exceedance.ranges(share) if part.end >= within.begin and part.begin <= within.end]
        if name == "certain":
            columns["certain_length_rad_s"] = sum(min(part.end, within.end) - max(part.begin, within.begin) for part in ranges)
        if ranges:
            begin, end = max(ranges[0].begin, within.begin), min(ranges[-1].end, within.end)
            columns[f"{name}_from_rad_s"], columns[f"{name}_to_rad_s"] = begin, end
            columns[f"{name}_from_scatter_rad_s"] = exceedance.scatter_of_border(share, ranges[0], begins=True)
            columns[f"{name}_to_scatter_rad_s"] = exceedance.scatter_of_border(share, ranges[-1], begins=False)
    return columns


def peak_columns(peak: xr.Dataset) -> dict[str, Any]:
    """What a row says of the response at its peak speed."""
    normal, tangential = float(peak["rms_normal"]), float(peak["rms_tangential"])
    return {
        "peak_speed_rad_s": float(peak["speed"]),
        "peak_rms_normal_m": normal,
        "peak_rms_tangential_m": tangential,
        "peak_motion_m": float(np.hypot(normal, tangential)),
    }


def largest_columns(reach: xr.Dataset) -> dict[str, Any]:
    """The largest of everything within the `reach` of a row that has one, and how its runs ended."""
    columns: dict[str, Any] = {"status": RunStatus(int(reach["status"].max())).text, "stress_region": ""}
    if "stress_region" in reach:
        columns["stress_region"] = str(reach["stress_region"].item())
    for column, name in _LARGEST.items():
        columns[column] = float(reach[name].max()) if name in reach else np.nan
    return columns


_LARGEST = {
    "max_wear_m": "max_wear",
    "median_von_mises_pa": "max_von_mises_median",
    "high_von_mises_pa": "max_von_mises_high",
}
