"""One row of summary.csv by its subjects, and what all rows are given by the revolutions of their runs."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, TypeVar, get_type_hints

import numpy as np
import xarray as xr

from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

from .closing import interaction_title
from .exceedance import CERTAIN, POSSIBLE, Exceedance, SpeedRange
from .measures import drop_after, lasts

LEAST_THICKNESS = "the sufficient thickness is a lower bound"


@dataclass(frozen=True)
class Crossing:
    """What meets: `mode` is empty and the Campbell speed NaN for a peak that no crossing of a named mode explains."""

    mode: str
    engine_order: int | None
    direction: str
    campbell_speed_rad_s: float = np.nan

    @property
    def title(self) -> str:
        """What meets there: 1B/4, or the engine order alone."""
        return interaction_title(self.mode, self.engine_order)


@dataclass(frozen=True)
class Peak:
    """The response at the peak speed, and what is lost of it above that."""

    peak_speed_rad_s: float
    shift_rad_s: float
    peak_rms_normal_m: float
    peak_rms_tangential_m: float
    drop: float


@dataclass(frozen=True)
class LastRevolution:
    """Speeds above yield and the largest stress, by the last revolution of each run. Of direct contact the region alone."""

    first_yield_speed_rad_s: float = np.nan
    width_above_yield_rad_s: float = np.nan
    share_above_yield: float = np.nan
    max_von_mises_pa: float = np.nan
    max_von_mises_speed_rad_s: float = np.nan
    stress_region: str = ""


@dataclass(frozen=True)
class AllRevolutions:
    """Speeds above yield and the largest stress, by all revolutions in the last half of each run (results.exceedance)."""

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
    largest_goodman_share: float = np.nan


@dataclass(frozen=True)
class PeakMotion:
    """The motion at the peak speed in both directions together, and where it falls above that; the scatter of both."""

    peak_motion_m: float
    peak_motion_scatter_m: float = np.nan
    fall_speed_rad_s: float = np.nan
    fall_speed_scatter_rad_s: float = np.nan


@dataclass(frozen=True)
class Interaction:
    """One row of summary.csv; its columns are the fields of its parts in their order, with units in their names.

    Of a lined scene it is a peak of the motion; of direct contact a range of speeds that may be above yield (results.
    contact_ranges), for a peak's crossing and one revolution's stress are chance there, and their columns are empty. `note`
    says why columns are, and where the lining is worn through.

    glossary.INTERACTIONS says what each column is. What is named peak is at the peak speed, what is named max the largest
    within the interaction. An interaction reaches, on both sides, to the lowest motion before the neighbouring peak, or to
    where the motion stays below QUIET of its own peak for more than measures.DROP_WITHIN: single speeds in between do not
    end it, for near the end of a branch the motion is chaotic. NaN is what a scene does not compute. What ends in scatter is
    the standard deviation by chance of what stands before it (results.exceedance).
    """

    crossing: Crossing
    peak: Peak
    last_revolution: LastRevolution
    max_wear_m: float
    worn_through_share: float
    sufficient_thickness_m: float
    largest_penetration_m: float
    status: str
    motion_at_end: str
    lasting_share: float
    all_revolutions: AllRevolutions
    peak_motion: PeakMotion
    note: str = ""

    @property
    def columns(self) -> dict[str, Any]:
        """The row: column -> value."""
        columns: dict[str, Any] = {}
        for field in fields(self):
            part = getattr(self, field.name)
            columns |= vars(part) if is_dataclass(part) else {field.name: part}
        return columns


def _columns() -> Iterator[str]:
    for name, kind in get_type_hints(Interaction).items():
        yield from (field.name for field in fields(kind)) if is_dataclass(kind) else [name]


COLUMNS = ("blade", "scene", *_columns())
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


_Part = TypeVar("_Part", LastRevolution, AllRevolutions, PeakMotion)


def interaction_row(
    response: xr.Dataset, index: int, reach: xr.Dataset, crossing: Crossing, more: Mapping[str, Any], note: str = ""
) -> Interaction:
    """The row of a `response` with its peak at an `index` among the speeds; `more`: other columns of the parts, by name.

    The largest of everything, and how its runs ended, are those of all speeds of its `reach`.
    """
    speed, normal, tangential = (float(response[name][index]) for name in ("speed", "rms_normal", "rms_tangential"))
    columns = {
        "stress_region": str(reach["stress_region"].item()) if "stress_region" in reach else "",
        "median_von_mises_pa": _largest(reach, "max_von_mises_median"),
        "high_von_mises_pa": _largest(reach, "max_von_mises_high"),
        "largest_goodman_share": _largest(reach, "goodman_share"),
        "peak_motion_m": float(np.hypot(normal, tangential)),
        **more,
    }

    worn_through, status = _largest(reach, "worn_through_share"), RunStatus(int(reach["status"].max()))
    why = ""
    if worn_through > 0.0:
        why = "worn through"
    elif status == RunStatus.DIVERGED and "used_thickness" in reach:
        why = status.text

    def part(kind: type[_Part]) -> _Part:
        return kind(**{field.name: columns[field.name] for field in fields(kind) if field.name in columns})

    return Interaction(
        crossing,
        Peak(speed, speed - crossing.campbell_speed_rad_s, normal, tangential, drop_after(response, index)),
        part(LastRevolution),
        _largest(reach, "max_wear"),
        worn_through,
        _largest(reach, "used_thickness"),
        _largest(reach, "largest_penetration"),
        status.text,
        MotionAtEnd(int(response["motion_at_end"][index])).text if "motion_at_end" in response else "",
        float(lasts(reach).mean()) if "motion_at_end" in reach else np.nan,
        part(AllRevolutions),
        part(PeakMotion),
        "; ".join(filter(None, (note, f"{why}: {LEAST_THICKNESS}" if why else ""))),
    )


def _largest(reach: xr.Dataset, name: str) -> float:
    return float(reach[name].max()) if name in reach else np.nan
