"""Requirements judged: the value of each, its margin, where it is worst, and how certain that is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
import xarray as xr

from r37core.results.columns import CERTAIN
from r37core.results.exceedance import Exceedance, SpeedRange, exceedance_of
from r37core.results.measures import has_strengths
from r37core.results.operating_range import OperatingRange
from r37core.results.other_motions import swept, worst_exceedance
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

from .choice import CampbellMargin, Requirements

MEETS, FAILS, UNKNOWN = VERDICTS = ("meets", "fails", "unknown")


@dataclass(frozen=True)
class JudgedMembers:
    """Members under tolerances: their `number`, and the `share` of them that meets a requirement; NaN without any."""

    number: float = np.nan
    share: float = np.nan


@dataclass(frozen=True)
class Judgement:
    """One requirement of one blade in one scene: `value` and `limit` in the `unit`; the value is NaN where it is not known.

    `begin`, `end`: speeds (rad/s) where it is worst. `scatter`: standard deviation of the value by chance; `members`: how
    many there are under tolerances, and the share that meets it; `worst_motion`: margin of the worst of all motions; NaN each
    where not run.
    """

    requirement: str
    value: float
    limit: float
    unit: str
    is_lower_limit: bool = False
    begin: float = np.nan
    end: float = np.nan
    scatter: float = np.nan
    members: JudgedMembers = JudgedMembers()
    worst_motion: float = np.nan
    note: str = ""

    @property
    def margin(self) -> float:
        """Distance from the limit, in the unit, above 0 where the requirement is met."""
        return self.value - self.limit if self.is_lower_limit else self.limit - self.value

    @property
    def verdict(self) -> str:
        """One of VERDICTS."""
        if np.isnan(self.margin):
            return UNKNOWN
        return MEETS if self.margin >= 0.0 else FAILS

    @property
    def columns(self) -> dict[str, object]:
        """The row of verdict.csv."""
        return {
            "requirement": self.requirement,
            "verdict": self.verdict,
            "value": self.value,
            "limit": self.limit,
            "margin": self.margin,
            "unit": self.unit,
            "from_rad_s": self.begin,
            "to_rad_s": self.end,
            "scatter": self.scatter,
            "members": self.members.number,
            "share_of_members": self.members.share,
            "margin_worst_motion": self.worst_motion,
            "note": self.note,
        }


COLUMNS = ("blade", "scene", *Judgement("", 0.0, 0.0, "").columns)
"""Columns of verdict.csv."""


@dataclass(frozen=True)
class Evidence:
    """What is known of one blade in one scene. `response`: rms with stress and wear, if computed; `campbell`: of the blade.

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
        """Whether each run diverged, shape (speeds,)."""
        return self.response["status"].values == RunStatus.DIVERGED


def judge(requirements: Requirements, evidence: Evidence) -> Iterator[Judgement]:
    """Each requirement in turn."""
    if requirements.above_yield is not None:
        yield _above_yield(requirements.above_yield, evidence)
    if requirements.goodman_share is not None:
        yield _goodman_share(requirements.goodman_share, evidence)
    if requirements.used_lining is not None:
        yield _used_lining(requirements.used_lining, evidence)
    if requirements.clearance is not None:
        yield _clearance(requirements.clearance, evidence)
    if requirements.mass is not None:
        note = "" if np.isfinite(evidence.mass) else "matrices do not say it"
        yield Judgement("mass", evidence.mass, requirements.mass, "kg", note=note)
    for margin in requirements.campbell_margins:
        yield from _campbell_margins(margin, evidence)


def _above_yield(limit: float, evidence: Evidence) -> Judgement:
    name, unit, operating = "above_yield", "rad/s", evidence.operating
    if "share_of_revolutions_above_yield" not in evidence.response:
        return Judgement(name, np.nan, limit, unit, note="stress is not computed")
    if evidence.not_covered:
        return Judgement(name, np.nan, limit, unit, note=evidence.not_covered)
    exceedance = exceedance_of(evidence.response)
    inside = [part for part in exceedance.ranges(CERTAIN) if operating.overlap(part.begin, part.end) > 0.0]
    widest = max(inside, key=lambda part: operating.overlap(part.begin, part.end), default=SpeedRange(np.nan, np.nan, False))
    return Judgement(
        name,
        operating.length(inside),
        limit,
        unit,
        begin=max(widest.begin, operating.first),
        end=min(widest.end, operating.last),
        scatter=_scatter(exceedance, operating),
        worst_motion=_worst_motion(limit, evidence),
        note="" if _has_rotation(evidence.response) else "stress of vibration alone",
        members=_members(limit, evidence),
    )


def _has_rotation(response: xr.Dataset) -> bool:
    """Whether the stress of rotation is in that of the response."""
    return "static_stress" in response and bool(response["static_stress"] > 0.0)


def _goodman_share(limit: float, evidence: Evidence) -> Judgement:
    name = "goodman_share"
    if "goodman_share" not in evidence.response:
        return Judgement(name, np.nan, limit, "1", note="fatigue is not computed")
    if not has_strengths(evidence.response):
        return Judgement(name, np.nan, limit, "1", note="the material has no strengths")
    if evidence.not_covered:
        return Judgement(name, np.nan, limit, "1", note=evidence.not_covered)
    share, speed = evidence.worst(np.where(evidence.diverged, np.inf, evidence.response["goodman_share"].values))
    return Judgement(name, share, limit, "1", begin=speed, end=speed, note="a run diverged" if np.isinf(share) else "")


def _scatter(exceedance: Exceedance, operating: OperatingRange) -> float:
    """Standard deviation by chance of the length above yield in operation; NaN where there is none."""
    if not exceedance.chance:
        return np.nan
    scatter = np.std([operating.length(ranges) for ranges in exceedance.ranges_drawn[CERTAIN]])
    # of equal lengths what rounding leaves
    return float(scatter.round(9))


def _members(limit: float, evidence: Evidence) -> JudgedMembers:
    """Members under tolerances, and the share of them whose speeds above yield keep the limit."""
    if evidence.members is None or "share_of_revolutions_above_yield" not in evidence.members:
        return JudgedMembers()
    lengths = []
    for name in evidence.members["member"].values:
        member = evidence.members.sel(member=name)
        if (member["status"] != RunStatus.NOT_RUN).any():
            member = member.isel(speed=np.flatnonzero(member["status"].values != RunStatus.NOT_RUN))
            lengths.append(evidence.operating.length(exceedance_of(member).ranges(CERTAIN)))
    return JudgedMembers(float(len(lengths)), float(np.mean(np.array(lengths) <= limit))) if lengths else JudgedMembers()


def _worst_motion(limit: float, evidence: Evidence) -> float:
    """Margin of the length above yield by the worst motion at each speed; NaN where the sweeps do not cover the range."""
    if evidence.motions is None or "share_of_revolutions_above_yield" not in evidence.motions:
        return np.nan
    pair = swept(evidence.motions)
    if not evidence.operating.is_covered(pair["speed"].values):
        return np.nan
    return limit - evidence.operating.length(worst_exceedance(pair).ranges(CERTAIN))


def _used_lining(limit: float, evidence: Evidence) -> Judgement:
    name, unit, response = "used_lining", "%", evidence.response
    if not np.isfinite(evidence.thickness):
        return Judgement(name, 0.0, 100.0 * limit, unit, note="no lining")
    if "used_thickness" not in response:
        return Judgement(name, np.nan, 100.0 * limit, unit, note="wear is not computed")
    if evidence.not_covered:
        return Judgement(name, np.nan, 100.0 * limit, unit, note=evidence.not_covered)
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
    if value == 0.0:
        speed = np.nan
    return Judgement(name, value, 100.0 * limit, unit, begin=speed, end=speed, note=note)


def _clearance(limit: float, evidence: Evidence) -> Judgement:
    name, unit = "clearance", "mm"
    if "clearance" not in evidence.response or evidence.response["clearance"].isnull().all():
        return Judgement(name, 1e3 * evidence.clearance, 1e3 * limit, unit, is_lower_limit=True)
    if evidence.not_covered:
        return Judgement(name, np.nan, 1e3 * limit, unit, is_lower_limit=True, note=evidence.not_covered)
    loss, speed = evidence.worst(-1e3 * evidence.response["clearance"].min("contact_node").values)
    return Judgement(name, -loss, 1e3 * limit, unit, is_lower_limit=True, begin=speed, end=speed)


def _campbell_margins(margin: CampbellMargin, evidence: Evidence) -> Iterator[Judgement]:
    crossings = evidence.campbell["crossing_speed"].sel(mode=margin.mode)
    for order in margin.engine_orders:
        crossing = float(crossings.sel(engine_order=order))
        value = 100.0 * distance_from_operation(crossing, evidence.operating)
        title, limit = f"campbell_margin {margin.mode}/{order}", 100.0 * margin.least
        yield Judgement(title, value, limit, "%", is_lower_limit=True, begin=crossing, end=crossing)


def distance_from_operation(crossing: float, operating: OperatingRange) -> float:
    """Distance of a crossing (rad/s) from the nearest dwell, or without dwells from the range, as a share of its speed.

    0 inside; 1 for a mode that does not cross the engine order in the diagram, which reaches over all that is near.
    """
    if not np.isfinite(crossing):
        return 1.0
    ranges = [(dwell.start, dwell.stop) for dwell in operating.dwell] or [(operating.first, operating.last)]
    return min(max(begin - crossing, crossing - end, 0.0) for begin, end in ranges) / crossing


@dataclass(frozen=True)
class Numbers:
    """Numbers of the configuration that evidence needs: by scene, and the mass (kg) by blade, where they are known."""

    clearance: Mapping[str, float] = field(default_factory=dict)
    thickness: Mapping[str, float] = field(default_factory=dict)
    mass: Mapping[str, float] = field(default_factory=dict)
