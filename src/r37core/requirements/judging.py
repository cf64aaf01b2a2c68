"""Requirements judged: the value of each, its margin, where it is worst, and how certain that is."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from r37core.results.columns import CERTAIN
from r37core.results.exceedance import Exceedance, SpeedRange, exceedance_of
from r37core.results.measures import has_strengths
from r37core.results.operating_range import OperatingRange
from r37core.results.other_motions import swept, worst_exceedance
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

from .choice import Requirements

MEETS, FAILS, UNKNOWN = VERDICTS = ("meets", "fails", "unknown")

Columns = dict[str, Any]
"""Columns of a requirement that are known."""


COLUMNS = (
    "requirement",
    "verdict",
    "value",
    "limit",
    "margin",
    "unit",
    "from_rad_s",
    "to_rad_s",
    "scatter",
    "members",
    "share_of_members",
    "margin_worst_motion",
    "note",
)
"""Columns of verdict.csv after blade and scene.

`value` and `limit` are in the `unit`; the value is NaN where it is not known, for the reason in `note`. `margin`: distance from
the limit, above 0 where the requirement is met. `from_rad_s`, `to_rad_s`: speeds where it is worst. `scatter`: standard
deviation of the value by chance; `members`, `share_of_members`: number of members under tolerances, and the share of them that
meets it; `margin_worst_motion`: margin of the worst of all motions; NaN each where not run.
"""


@dataclass(frozen=True)
class Evidence:
    """Results of one blade in one scene. `response`: rms with stress and wear, if computed; `campbell`: of the blade.

    `members`, `motions`: parts of the datasets of members under tolerances and of more motions. `clearance` (m): of a casing
    whose clearance is the same at every speed; `thickness` (m) of the lining; `mass` (kg); NaN each where not known.
    """

    response: xr.Dataset
    campbell: xr.Dataset
    operating: OperatingRange
    members: xr.Dataset | None = None
    motions: xr.Dataset | None = None
    clearance: float = np.nan
    thickness: float = np.nan
    mass: float = np.nan

    @property
    def not_covered(self) -> str:
        """Why nothing can be said of the operating range; empty where its speeds are run."""
        speeds = self.response["speed"].values[self.response["status"].values != RunStatus.NOT_RUN]
        first, last = self.operating.first, self.operating.last
        return "" if self.operating.is_covered(speeds) else f"speeds are not run from {first:.6g} to {last:.6g} rad/s"

    def worst(self, values: np.ndarray) -> tuple[float, float]:
        """Largest value in the operating range, and its speed (rad/s); between runs values are a straight line.

        `values`, shape (speeds,), of all runs: where one is infinite, so is everything up to the next runs.
        """
        speeds, infinite = self.response["speed"].values, np.isinf(values)
        ends = (self.operating.first, self.operating.last)
        places = np.unique([*ends, *speeds[(speeds > ends[0]) & (speeds < ends[1])]])
        inside = np.interp(places, speeds, np.where(infinite, 0.0, values))
        inside = np.where(np.interp(places, speeds, infinite.astype(float)) > 0.0, np.inf, inside)
        place = int(inside.argmax())
        return float(inside[place]), float(places[place])

    @property
    def diverged(self) -> np.ndarray:
        """Runs that diverged: true or false, shape (speeds,)."""
        return self.response["status"].values == RunStatus.DIVERGED


def judge(requirements: Requirements, evidence: Evidence) -> Iterator[dict[str, object]]:
    """Each requirement in turn: COLUMNS."""
    for name, (unit, factor, columns_of) in _NUMBERS.items():
        limit = getattr(requirements, name)
        if limit is not None:
            yield _judged(name, unit, factor * limit, columns_of(evidence, limit), is_lower_limit=name == "clearance")
    for margin in requirements.campbell_margins:
        crossings = evidence.campbell["crossing_speed"].sel(mode=margin.mode)
        for order in margin.engine_orders:
            crossing = float(crossings.sel(engine_order=order))
            value = 100.0 * distance_from_operation(crossing, evidence.operating)
            name = f"campbell_margin {margin.mode}/{order}"
            yield _judged(name, "%", 100.0 * margin.least, _worst_at(value, crossing), is_lower_limit=True)


def _judged(requirement: str, unit: str, limit: float, columns: Columns, *, is_lower_limit: bool) -> dict[str, object]:
    """The row of a requirement, by the columns that are known."""
    value = columns.get("value", np.nan)
    margin = value - limit if is_lower_limit else limit - value
    verdict = UNKNOWN if np.isnan(margin) else MEETS if margin >= 0.0 else FAILS
    row = {"requirement": requirement, "verdict": verdict, "limit": limit, "margin": margin, "unit": unit, "note": ""}
    return dict.fromkeys(COLUMNS, np.nan) | row | columns


def _worst_at(value: float, speed: float, note: str = "") -> Columns:
    """A value that is worst at one speed (rad/s)."""
    return {"value": value, "from_rad_s": speed, "to_rad_s": speed, "note": note}


def _above_yield(evidence: Evidence, limit: float) -> Columns:
    operating = evidence.operating
    if "share_of_revolutions_above_yield" not in evidence.response:
        return {"note": "stress is not computed"}
    if evidence.not_covered:
        return {"note": evidence.not_covered}
    exceedance = exceedance_of(evidence.response)
    inside = [part for part in exceedance.ranges(CERTAIN) if operating.overlap(part.begin, part.end) > 0.0]
    widest = max(inside, key=lambda part: operating.overlap(part.begin, part.end), default=SpeedRange(np.nan, np.nan, False))
    return {
        "value": operating.length(inside),
        "from_rad_s": max(widest.begin, operating.first),
        "to_rad_s": min(widest.end, operating.last),
        "scatter": _scatter(exceedance, operating),
        "margin_worst_motion": _worst_motion(limit, evidence),
        "note": "" if _has_rotation(evidence.response) else "stress of vibration alone",
        **_members(limit, evidence),
    }


def _has_rotation(response: xr.Dataset) -> bool:
    """True where the stress of rotation is in that of the response."""
    return "static_stress" in response and bool(response["static_stress"] > 0.0)


def _goodman_share(evidence: Evidence, _: float) -> Columns:
    if "goodman_share" not in evidence.response:
        return {"note": "fatigue is not computed"}
    if not has_strengths(evidence.response):
        return {"note": "the material has no strengths"}
    if evidence.not_covered:
        return {"note": evidence.not_covered}
    share, speed = evidence.worst(np.where(evidence.diverged, np.inf, evidence.response["goodman_share"].values))
    return _worst_at(share, speed, "a run diverged" if np.isinf(share) else "")


def _scatter(exceedance: Exceedance, operating: OperatingRange) -> float:
    """Standard deviation by chance of the length above yield in operation; NaN where there is none."""
    if not exceedance.chance:
        return np.nan
    scatter = np.std([operating.length(ranges) for ranges in exceedance.ranges_drawn[CERTAIN]])
    # of equal lengths what rounding leaves
    return float(scatter.round(9))


def _members(limit: float, evidence: Evidence) -> Columns:
    """Members under tolerances, and the share of them whose speeds above yield keep the limit."""
    if evidence.members is None or "share_of_revolutions_above_yield" not in evidence.members:
        return {}
    lengths = []
    for name in evidence.members["member"].values:
        member = evidence.members.sel(member=name)
        if (member["status"] != RunStatus.NOT_RUN).any():
            member = member.isel(speed=np.flatnonzero(member["status"].values != RunStatus.NOT_RUN))
            lengths.append(evidence.operating.length(exceedance_of(member).ranges(CERTAIN)))
    kept = np.array(lengths) <= limit
    return {"members": float(kept.size), "share_of_members": float(kept.mean())} if lengths else {}


def _worst_motion(limit: float, evidence: Evidence) -> float:
    """Margin of the length above yield by the worst motion at each speed; NaN where the sweeps do not cover the range."""
    if evidence.motions is None or "share_of_revolutions_above_yield" not in evidence.motions:
        return np.nan
    pair = swept(evidence.motions)
    if not evidence.operating.is_covered(pair["speed"].values):
        return np.nan
    return limit - evidence.operating.length(worst_exceedance(pair).ranges(CERTAIN))


def _used_lining(evidence: Evidence, _: float) -> Columns:
    response = evidence.response
    if not np.isfinite(evidence.thickness):
        return {"value": 0.0, "note": "no lining"}
    if "used_thickness" not in response:
        return {"note": "wear is not computed"}
    if evidence.not_covered:
        return {"note": evidence.not_covered}
    # what is worn through has used all, and would use more
    through = response["worn_through_share"].values > 0.0
    used = 100.0 * np.nan_to_num(response["used_thickness"].values) / evidence.thickness
    value, speed = evidence.worst(np.where(through | evidence.diverged, np.inf, used))
    note = ""
    if np.isinf(value):
        note = "worn through to the casing" if evidence.worst(through.astype(float))[0] > 0.0 else "a run diverged"
    elif "motion_at_end" in response:
        nearest = int(np.abs(response["speed"].values - speed).argmin())
        if response["motion_at_end"][nearest] == MotionAtEnd.GROWING:
            note = "wear still grows at the end: a lower bound"
    return _worst_at(value, np.nan if value == 0.0 else speed, note)


def _clearance(evidence: Evidence, _: float) -> Columns:
    if "clearance" not in evidence.response or evidence.response["clearance"].isnull().all():
        return {"value": 1e3 * evidence.clearance}
    if evidence.not_covered:
        return {"note": evidence.not_covered}
    loss, speed = evidence.worst(-1e3 * evidence.response["clearance"].min("contact_node").values)
    return _worst_at(-loss, speed)


def _mass(evidence: Evidence, _: float) -> Columns:
    return {"value": evidence.mass, "note": "" if np.isfinite(evidence.mass) else "matrices do not say it"}


_NUMBERS: dict[str, tuple[str, float, Callable[[Evidence, float], Columns]]] = {
    "above_yield": ("rad/s", 1.0, _above_yield),
    "goodman_share": ("1", 1.0, _goodman_share),
    "used_lining": ("%", 100.0, _used_lining),
    "clearance": ("mm", 1e3, _clearance),
    "mass": ("kg", 1.0, _mass),
}
"""Requirement -> unit of its row, factor to it from that of the limit, and its columns for a limit."""


def distance_from_operation(crossing: float, operating: OperatingRange) -> float:
    """Distance of a crossing (rad/s) from the nearest dwell, or without dwells from the range, as a share of its speed.

    0 inside; 1 for a mode that does not cross the engine order in the diagram, which reaches over all that is near.
    """
    if not np.isfinite(crossing):
        return 1.0
    ranges = [(dwell.start, dwell.stop) for dwell in operating.dwell] or [(operating.first, operating.last)]
    return min(max(begin - crossing, crossing - end, 0.0) for begin, end in ranges) / crossing
