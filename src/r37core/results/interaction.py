"""One row of summary.csv: numbers of an interaction, by column."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from xarray import Dataset

from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.speed_arrays import PLACE_OF_STRESS
from r37core.time_integration.status import RunStatus

from .columns import INTERACTIONS, MOST_REVOLUTIONS, names
from .danger import largest_of, ranges_of
from .exceedance import Exceedance, SpeedRange
from .measures import drop_after, lasts

LEAST_THICKNESS = "the sufficient thickness is a lower bound"

Interaction = dict[str, Any]
"""Column of INTERACTIONS -> value; NaN is what a scene does not compute.

Of a lined scene an interaction is a peak of the motion; of direct contact a range of speeds that may be above yield, for a
peak's crossing and one revolution's stress are chance there, and their columns are empty. `note` says why columns are, and
where the lining is worn through. Without a crossing that explains the peak `mode` is empty.

An interaction reaches (`reach`, which is no column), on both sides, to the lowest motion before the neighbouring peak, or to
where the motion stays below QUIET of its own peak for more than DROP_WITHIN: single speeds in between do not end it, for near
the end of a branch the motion is chaotic.
"""


def range_columns(response: Dataset, exceedance: Exceedance, within: SpeedRange) -> dict[str, Any]:
    """How long a row's speeds are dangerous, unknown and sustained, and where, with the scatter of the borders of the last."""
    columns: dict[str, Any] = {}
    for length, parts in ranges_of(response).items():
        ranges = [part for part in parts if part.end >= within.begin and part.begin <= within.end]
        columns[length] = float(sum(min(part.end, within.end) - max(part.begin, within.begin) for part in ranges))
        name = length.removeprefix("length_").removesuffix("_rad_s")
        if ranges and name != "unknown":
            begin, end = max(ranges[0].begin, within.begin), min(ranges[-1].end, within.end)
            columns[f"{name}_from_rad_s"], columns[f"{name}_to_rad_s"] = begin, end
        if ranges and name == "most_revolutions":
            columns[f"{name}_from_scatter_rad_s"] = exceedance.scatter_of_border(MOST_REVOLUTIONS, ranges[0], begins=True)
            columns[f"{name}_to_scatter_rad_s"] = exceedance.scatter_of_border(MOST_REVOLUTIONS, ranges[-1], begins=False)
    return columns


def interaction_row(response: Dataset, index: int, reach: Dataset, columns: Mapping[str, Any], note: str = "") -> Interaction:
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
    danger = largest_of(reach)
    # where on the blade the largest stress of all speeds is
    at = danger["largest_stress_speed_rad_s"]
    worst = reach.sel(speed=at) if at > 0.0 else Dataset()
    return {
        **dict.fromkeys(names(INTERACTIONS[2:]), np.nan),
        "peak_speed_rad_s": speed,
        "peak_rms_normal_m": normal,
        "peak_rms_tangential_m": tangential,
        "peak_motion_m": float(np.hypot(normal, tangential)),
        "drop": drop_after(response, index),
        **{place: float(worst[place]) for place in PLACE_OF_STRESS if place in worst},
        "stress_region": str(reach["stress_region"].item()) if "stress_region" in reach else "",
        **danger,
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


def _largest(reach: Dataset, name: str) -> float:
    return float(reach[name].max()) if name in reach else np.nan
