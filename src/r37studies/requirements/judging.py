"""Requirements judged: the value of each, its margin, where it is worst, and how certain that is."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd

from r37core.results.danger import danger_ranges, grid_scatter
from r37core.results.datasets import overlaid
from r37core.results.exceedance import DEVIATIONS, SpeedRange, is_lined, ranges_above
from r37core.results.measures import has_strengths
from r37core.results.operating_range import OperatingRange
from r37core.results.other_motions import swept
from r37core.results.spectral_lines import crossing_of
from r37core.time_integration.integration_choice import PUBLISHED_REVOLUTIONS
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

from .choice import BRIEF, LONGEST, NEAR, STEP, Requirements
from .evidence import Evidence, beyond_model, extended, lacking, operated_alone, reach, worst_of

MEETS, FAILS, UNKNOWN, NOT_APPLICABLE = VERDICTS = ("meets", "fails", "cannot tell", "does not apply")

UP, DOWN, REST = "carried up", "carried down", "from rest"
RUN_UP, RUN_DOWN = "in a run-up", "in a run-down"
MORE_FRICTION, LESS_FRICTION, SLIGHTLY_MORE_FRICTION = "1% more friction", "1% less friction", "0.1% more friction"
HALF_STEP, COARSER_MESH = "half the step", "a mesh of half the nodes"
REPEATED = (MORE_FRICTION, LESS_FRICTION, SLIGHTLY_MORE_FRICTION, HALF_STEP, COARSER_MESH)
LOWEST_DAMPING, HIGHEST_DAMPING = "lowest damping", "highest damping"
FAST_RISE, SLOW_RISE = "lobes that rise ten times as fast", f"lobes that rise over {PUBLISHED_REVOLUTIONS} revolutions"
SLOWEST_RISE = f"lobes that rise over {LONGEST - PUBLISHED_REVOLUTIONS} revolutions"
BRIEF_RISE = f"lobes that rise over {BRIEF} revolutions"
SUDDEN_RISE = "lobes that rise over a revolution"
_OF_ERROR = {HALF_STEP: 1.0 / (1.0 - 0.5), COARSER_MESH: 1.0 / (2.0**0.5 - 1.0)}
"""Further run -> error of the runs themselves as a multiple of how far it comes out otherwise, by Richardson.

Of first order in the step and in the size of the elements, as contact leaves it: half the nodes on the same layers are elements
2^(1/2) as long.
"""

LARGE_CHANGES = (LOWEST_DAMPING, HIGHEST_DAMPING, FAST_RISE, SUDDEN_RISE, BRIEF_RISE, SLOW_RISE, SLOWEST_RISE)
GROWS = 0.5
"""Share of a limit from which a motion that still grows may come to it; of wear that was not followed, from 0 on."""

AT_LEAST = "the highest value is a lower bound"
"""Note on a highest value that finer speeds or longer runs may exceed."""

BETWEEN = "a peak between speeds, or one that drifts on, may come beyond the limit"
"""Note on a peak that finer speeds have not resolved."""

NOT_MEASURED = "the level's error was not measured: snakemake tradeoff measures it, fidelity.yaml has it as measured.error"
"""Note on runs of a level without a measured error: they meet no limit where the tip touches."""

CLEARLY = 1.15
"""Factor by which stress and wear may be smaller where a requirement fails clearly."""

VIBRATION_ALONE = "stress of vibration alone: add static_stress to the scene's results"
"""Note on a stress without that of rotation: it meets no limit."""

ON_POINTS = "contact acts on points, whose motion changes with the mesh: structure.boundary.contact: patches"
"""Note on contact that a finer mesh changes: where the tip touches it meets no limit."""

NO_CONTACT = "the tip touches nothing, which needs no further runs"
"""Note on a requirement that is met without contact."""

Columns = dict[str, Any]
"""Columns of a requirement that are known."""


MORE_SCATTER, LESS_SCATTER = "with twice its scatter added", "with twice its scatter subtracted"
"""Names of a trial by chance: two standard deviations of the value."""

COLUMNS = (
    "requirement",
    "verdict",
    "value",
    "value_lowest",
    "value_highest",
    "limit",
    "margin",
    "unit",
    "from_rad_s",
    "to_rad_s",
    "scatter",
    "members",
    "share_of_members",
    "margin_worst_motion",
    "further_runs",
    "note",
)
"""Columns of verdict.csv after blade and scene.

`value` and `limit` are in the `unit`; the value is NaN where it is not known, for the reason in `note`. `value_lowest`,
`value_highest`: of everything that was tried, each with the error of mesh and step, two standard deviations, unknown speeds and
what fewer speeds than those from rest miss.
`margin`: distance from the limit, below 0 where the requirement is broken. `from_rad_s`, `to_rad_s`: speeds where it is worst.
`scatter`: standard deviation of the value by friction, step and mesh, of a length also by distance of the speeds; `members`,
`share_of_members`: number of members under tolerances, and the share of them that meets it; `margin_worst_motion`: margin of
the worst of all motions; NaN each where not run. `further_runs`: how many there were, NaN of what is not judged by runs.
"""


def judge(requirements: Requirements, evidence: Evidence) -> Iterator[dict[str, Any]]:
    """Each requirement in turn: COLUMNS."""
    rows = zip(_required(requirements, _OF_RUNS), single_limits(requirements), strict=True)
    for (name, unit, limit, columns_of), only in rows:
        yield _judged_by_runs(name, unit, limit, columns_of, only, evidence)
    for name, unit, limit, columns_of in _required(requirements, _OF_BLADE):
        yield _row(name, unit, limit, columns_of(evidence), is_lower_limit=name == "clearance")
    for margin in requirements.campbell_margins:
        for order in margin.engine_orders:
            crossing = crossing_of(evidence.campbell, margin.mode, order)
            value = 100.0 * distance_from_operation(crossing, evidence.operating)
            name = f"campbell_margin {margin.mode}/{order}"
            yield _row(name, "%", 100.0 * margin.least, _worst_at(value, crossing), is_lower_limit=True)


def fails_clearly(requirements: Requirements, evidence: Evidence) -> list[str]:
    """Requirements that runs inside the operating range fail, with stress and wear smaller by CLEARLY, too."""
    smaller = operated_alone(evidence).scaled(1.0 / CLEARLY)
    required = _required(requirements, _OF_RUNS)
    return [name for name, _, limit, columns_of in required if _number(columns_of(smaller)) > limit]


def single_limits(requirements: Requirements) -> list[Requirements]:
    """Each of the requirements on runs alone."""
    return [Requirements(**{name: getattr(requirements, name)}) for name, *_ in _required(requirements, _OF_RUNS)]


def nearness(requirements: Requirements, evidence: Evidence) -> np.ndarray:
    """How near each run comes to a limit, shape (speeds,): 1 at the nearest limit, infinite where it diverged."""
    return np.where(evidence.diverged, np.inf, np.max(_shares_of_limits(requirements, evidence), axis=0))


def closeness(requirements: Requirements, evidence: Evidence) -> np.ndarray:
    """How close each run lies to a limit, below or above it, shape (speeds,): 1 at a limit, 0 far off or where it diverged."""
    shares = _shares_of_limits(requirements, evidence)
    return np.where(evidence.diverged, 0.0, np.max(np.minimum(shares, 1.0 / np.maximum(shares, 1.0)), axis=0))


def _shares_of_limits(requirements: Requirements, evidence: Evidence) -> np.ndarray:
    """Stress and wear of each run as a share of each limit, shape (limits + 1, speeds); the first row is 0."""
    runs, shares = evidence.response, [np.zeros(evidence.response.sizes["speed"])]
    if requirements.above_yield is not None and "max_von_mises_inside" in runs:
        shares.append((runs["max_von_mises_inside"] / runs["yield_stress"]).values)
    if requirements.goodman_share is not None and "goodman_share_inside" in runs:
        shares.append(runs["goodman_share_inside"].values / requirements.goodman_share)
    if requirements.used_lining is not None and "used_thickness" in runs:
        shares.append(runs["used_thickness"].values / evidence.thickness / requirements.used_lining)
    return np.nan_to_num(np.array(shares))


def _row(requirement: str, unit: str, limit: float, columns: Columns, *, is_lower_limit: bool = False) -> dict[str, Any]:
    """The row of a requirement, by the columns that are known."""
    value = columns.get("value", np.nan)
    margin = value - limit if is_lower_limit else limit - value
    verdict = UNKNOWN if np.isnan(margin) else MEETS if margin >= 0.0 else FAILS
    row = {"requirement": requirement, "verdict": verdict, "limit": limit, "margin": margin, "unit": unit, "note": ""}
    return dict.fromkeys(COLUMNS, np.nan) | row | columns


def _number(columns: Columns) -> float:
    """The value; infinite where the columns say that it fails, NaN if not known."""
    return np.inf if columns.get("verdict") == FAILS else columns.get("value", np.nan)


@dataclass(frozen=True)
class Trial:
    """A way in which runs may come out otherwise: a row of the table that a requirement on runs is judged by.

    `evidence`: these runs. `has_error`: whether the error of mesh and step is in them already; `repeats`: whether the motion is
    the same, so that its value is scatter; `is_motion`: whether it is another motion. `value`, and `raised` by the error:
    infinite where the requirement fails without a number, NaN where they are not known.
    """

    name: str
    evidence: Evidence
    has_error: bool = False
    repeats: bool = False
    is_motion: bool = False
    value: float = np.nan
    raised: float = np.nan


def _judged_by_runs(
    requirement: str, unit: str, limit: float, columns_of: Callable[[Evidence], Columns], only: Requirements, evidence: Evidence
) -> dict[str, Any]:
    """The row of a requirement on runs: it meets where all that was tried does, and fails where none of it meets."""
    further_runs = float(sum(runs.sizes["speed"] for runs in evidence.looks.values()))
    if REST in evidence.looks:
        evidence = evidence.replaced(evidence.looks[REST])
        evidence = replace(evidence, error=_measured_error(only, evidence))
    columns = columns_of(evidence)
    row = _row(requirement, unit, limit, columns) | _members(columns_of, limit, evidence) | {"further_runs": further_runs}
    if "verdict" in columns or np.isnan(row["value"]):
        return row
    # an error that was not measured may be as large as what fails clearly
    error = float(np.nan_to_num(evidence.error, nan=CLEARLY - 1.0))
    more, less = (f"{100.0 * error:.2g}% {change}" for change in ("more", "less"))
    scaled = {more: 1.0 + error, less: 1.0 / (1.0 + error)} if error else {}
    trials = _trials(evidence)
    with_error = [Trial(f"with {name}", evidence.scaled(scale), has_error=True) for name, scale in scaled.items()]
    is_length = requirement == "above_yield"
    # wherever its borders lie, a speed above yield is one
    is_sure = is_length and is_lined(evidence.response)
    table, ends = [], list[float]()
    for trial in (*trials, *with_error):
        scale = 1.0 if trial.has_error else 1.0 + error
        # what a length misses between speeds is its scatter
        missed = 1.0 if is_length else _missed(only, evidence, trial.evidence.speeds)
        own, raised, between = (columns_of(trial.evidence.scaled(factor)) for factor in (1.0, scale, missed * scale))
        table.append(replace(trial, value=_number(own), raised=np.nan if trial.has_error else _number(raised)))
        ends += [*_ends(own, is_sure=is_sure), *_ends(between, is_sure=is_sure)]

    repeated = [trial.value for trial in table if trial.repeats]
    if repeated or not np.isnan(row["scatter"]):
        deviation = np.nanstd([row["value"], *filter(np.isfinite, repeated)])
        row["scatter"] = float(np.linalg.norm(np.nan_to_num([row["scatter"], deviation])))
    lowest, highest = _ends(row | {"unknown": 0.0}, is_sure=is_sure)
    if row["scatter"] > 0.0:
        name, end = (MORE_SCATTER, highest) if row["verdict"] == MEETS else (LESS_SCATTER, lowest)
        table.append(Trial(name, evidence, value=end))
    # what leaves the model may be above yield
    highest += columns.get("unknown", 0.0)
    finite = [end for end in ends if np.isfinite(end)]
    operating = evidence.operating
    width = operating.last - operating.first
    most = width if is_length else np.inf
    row |= {"value_lowest": max(min([lowest, *finite]), 0.0), "value_highest": min(max([highest, *finite]), most)}
    in_motions = [max(trial.value, row["value"]) for trial in table if trial.is_motion and not np.isnan(trial.value)]
    row["margin_worst_motion"] = limit - max(in_motions, default=np.nan)

    near = nearness(only, evidence)
    known, may_be = reach(evidence, near)
    # a peak below the limit may come beyond it; or the worst value be larger, but of speeds above yield, which count in full
    beyond = REST in evidence.looks and bool(np.any((may_be >= 1.0) & (known < 1.0)))
    at_least = beyond if is_length else bool(may_be.max(initial=0.0) > (1.0 + error) * known.max(initial=0.0))
    # of what fails clearly nothing more was run
    at_least |= row["verdict"] == FAILS and REST not in evidence.looks and evidence.gap > STEP
    if requirement == "used_lining":
        at_least |= bool(np.any(evidence.response.get("motion_at_end", np.nan) == MotionAtEnd.GROWING))
    notes = [row["note"], AT_LEAST if at_least else ""]
    if row["verdict"] == FAILS:
        # another motion that keeps the limit takes nothing from one that does not
        kept = [trial.name for trial in table if trial.value <= limit and not trial.is_motion]
        doubts = [f"meets {' and '.join(kept)}" if kept else ""]
        response = evidence.response
        ranges = danger_ranges(response)[0] if is_length else ranges_above(response["speed"].values, near, 1.0)
        notes += [f"over {operating.length(ranges):.3g} of {width:.4g} rad/s", *beyond_model(evidence)]
    else:
        failing = {trial.name: trial.value for trial in table if trial.value > limit}
        also = [trial for trial in table if trial.raised > limit and trial.name not in failing]
        failing |= {f"{trial.name} and {more}": trial.raised for trial in also}
        suffix = "" if unit == "1" else f" {unit}"
        doubts = [
            "fails" + (f" by {value - limit:.3g}{suffix}" if np.isfinite(value) else "") + f" {name}"
            for name, value in failing.items()
        ]
        growing = filter(None, (_growing(only, trial) for trial in (Trial("", evidence), *trials)))
        doubts += [evidence.too_coarse, next(growing, ""), BETWEEN if beyond else ""]
        doubts += _left_out(only, evidence, row["note"])
        if row["share_of_members"] < 1.0:
            doubts.append(members_that_meet(row))
    row["note"] = "; ".join(dict.fromkeys(filter(None, [*doubts, *notes])))
    if any(doubts):
        row["verdict"] = UNKNOWN
    elif row["verdict"] == MEETS and not evidence.touches:
        row["note"] = NO_CONTACT
    return row


def _ends(columns: Columns, *, is_sure: bool) -> list[float]:
    """Ends of a value: two standard deviations off, with what is unknown; NaN where it is not known.

    `is_sure`: whether chance takes no value above 0 to 0.
    """
    value, chance = columns.get("value", np.nan), DEVIATIONS * np.nan_to_num(columns.get("scatter", 0.0))
    return [max(value - chance, 1e-9 * (is_sure and value > 0.0)), value + chance + columns.get("unknown", 0.0)]


def _missed(only: Requirements, evidence: Evidence, speeds: np.ndarray) -> float:
    """Factor by which the largest value of the runs exceeds that at other `speeds` (rad/s), which miss peaks between them."""
    near = np.where(evidence.operates, nearness(only, evidence), 0.0)
    at_speeds = np.interp(speeds, evidence.response["speed"].values, near).max(initial=0.0)
    largest = near.max()
    return float(largest / at_speeds) if np.isfinite(largest) and at_speeds > 0.0 else 1.0


def growing(requirements: Requirements, evidence: Evidence) -> np.ndarray:
    """Speeds (rad/s) in operation whose motion still grows as the run ends and may come to a limit, the nearest first."""
    near, runs = nearness(requirements, evidence), evidence.response
    # any wear is a lower bound unless it was followed; a speed above yield counts in full already
    is_bound = requirements.used_lining is not None and np.nan_to_num(runs.get("followed", 0.0)) == 0.0
    counts = is_bound | (near >= GROWS) & ((near < 1.0) | (requirements.above_yield is None))
    grows = counts & evidence.operates & np.asarray(runs.get("motion_at_end", np.nan) == MotionAtEnd.GROWING)
    order = np.argsort(-near, kind="stable")
    return runs["speed"].values[order[grows[order]]]


def _growing(only: Requirements, trial: Trial) -> str:
    """Where the motion of a trial still grows and may come to the one limit; empty where none does."""
    name = trial.name and f", {trial.name}"
    return next(
        (f"the motion still grows as the run ends, at {at:.5g} rad/s{name}" for at in growing(only, trial.evidence)), ""
    )


def _left_out(only: Requirements, evidence: Evidence, note: str) -> list[str]:
    """Reasons why runs cannot show that the one limit is met, by what they leave out; `note`: on the value."""
    reasons = [VIBRATION_ALONE] * (VIBRATION_ALONE in note)
    # further runs do not look closer either where all stays far below a limit
    far_below = evidence.fails_elsewhere and nearness(only, evidence).max(initial=0.0) < NEAR
    doubts = (
        not far_below and evidence.not_looked,
        evidence.point_contact and ON_POINTS,
        np.isnan(evidence.error) and NOT_MEASURED,
    )
    left = np.isfinite(evidence.response.get("exit_revolution", np.nan)) & evidence.operates
    beyond = beyond_model(evidence) or ["the model is left"] * bool(left.any())
    return reasons + [text for text in doubts if text and evidence.touches] + beyond


def _trials(evidence: Evidence) -> list[Trial]:
    """Runs with another damping, rise, friction, step or mesh, as they drift on, and in other motions.

    The motion from rest stands in for another where that does not reach over the operating range.
    """
    runs, looks = evidence.response, evidence.looks
    trials = [
        Trial(f"with {name}", evidence.replaced(overlaid(runs, looks[name])), name in _OF_ERROR, name in REPEATED)
        for name in (*LARGE_CHANGES, *REPEATED)
        if name in looks
    ]
    if "stress_drift" in runs and (runs["stress_drift"] > 0.0).any():
        trials.append(Trial("as it drifts on", evidence.scaled(1.0 + runs["stress_drift"].clip(min=0.0).fillna(0.0))))
    motions = {name: motion for name, motion in looks.items() if name.startswith((UP, DOWN, RUN_UP, RUN_DOWN))}
    if evidence.motions is not None and (worst := worst_of(swept(evidence.motions))).sizes["speed"]:
        motions["in the worst motion"] = extended(runs, worst)
    return trials + [Trial(name, evidence.replaced(motion), is_motion=True) for name, motion in motions.items()]


def _measured_error(only: Requirements, evidence: Evidence) -> float:
    """Relative error of mesh and step of this blade and one limit, at least that of its level.

    That of the level alone where no coarser mesh was run. Each run that ended both ways is extrapolated (_OF_ERROR):

        error = max_i(own_i + multiple |changed_i - own_i|) / max_i(own_i) - 1

    so that equal maxima at different speeds do not hide it. At least the level's error counts: chance may make this one small.
    """
    errors = []
    for look, multiple in _OF_ERROR.items():
        if look not in evidence.looks:
            return evidence.error
        other = evidence.looks[look]
        both = [nearness(only, evidence.replaced(runs)) for runs in (evidence.response.sel(speed=other["speed"]), other)]
        own, changed = np.compress(np.isfinite(both).all(axis=0), both, axis=1)
        if not len(own):
            return evidence.error
        largest = own.max()
        errors.append(np.max(own + multiple * np.abs(changed - own)) / largest - 1.0 if largest > 0.0 else 0.0)
    return float(np.fmax(np.linalg.norm(errors), evidence.error))


def _members(columns_of: Callable[[Evidence], Columns], limit: float, evidence: Evidence) -> Columns:
    """Members under tolerances, and the share of them that keeps the limit."""
    if evidence.members is None:
        return {}
    runs = (evidence.members.sel(member=name) for name in evidence.members["member"].values)
    ran = (member.isel(speed=np.flatnonzero(member["status"].values != RunStatus.NOT_RUN)) for member in runs)
    values = np.array([_number(columns_of(evidence.replaced(member))) for member in ran if member.sizes["speed"]])
    # a member that is not known keeps nothing
    is_known = not np.isnan(values).all()
    return {"members": float(values.size), "share_of_members": float(np.mean(values <= limit))} if is_known else {}


def members_that_meet(row: Mapping[str, Any] | pd.Series) -> str:
    """How many members under tolerances keep the limit, in words."""
    return f"{row['share_of_members'] * row['members']:.0f} of {row['members']:.0f} members meet"


def _worst_at(value: float, speed: float, note: str = "") -> Columns:
    """A value that is worst at one speed (rad/s)."""
    return {"value": value, "from_rad_s": speed, "to_rad_s": speed, "note": note}


def _not_known(evidence: Evidence, name: str, result: str) -> str:
    """Why a number of the runs, of a `result` of scenes, is not known in operation; empty where it is."""
    if name not in evidence.response:
        return f"{result} is not computed: add it to the scene's results"
    return evidence.not_covered or lacking(evidence, name)


def _above_yield(evidence: Evidence) -> Columns:
    operating, response = evidence.operating, evidence.response
    if reason := _not_known(evidence, "max_von_mises_inside", "stress"):
        return {"note": reason}
    dangerous, unknown = danger_ranges(response)
    inside = [part for part in dangerous if operating.overlap(part.begin, part.end) > 0.0]
    widest = max(inside, key=lambda part: operating.overlap(part.begin, part.end), default=SpeedRange(np.nan, np.nan, False))
    has_rotation = bool(response.get("static_stress", 0.0))
    left = operating.length(unknown)
    notes = [
        evidence.divergence,
        "" if has_rotation else VIBRATION_ALONE,
        f"over {left:.4g} rad/s the model is left before yield is passed" if left else "",
    ]
    return {
        "value": operating.length(inside),
        "from_rad_s": max(widest.begin, operating.first),
        "to_rad_s": min(widest.end, operating.last),
        "unknown": left,
        "scatter": grid_scatter(response, operating.length),
        "note": "; ".join(filter(None, notes)),
    }


def _goodman_share(evidence: Evidence) -> Columns:
    if "goodman_share_inside" in evidence.response and not has_strengths(evidence.response):
        return {"note": "the material has no strengths"}
    if reason := _not_known(evidence, "goodman_share_inside", "fatigue"):
        return {"note": reason}
    left = np.isfinite(evidence.response["exit_revolution"].values)
    inside = evidence.response["goodman_share_inside"].values
    share, speed = evidence.worst(np.where(evidence.diverged & ~left, np.inf, inside))
    if not np.isfinite(share):
        return _diverged(evidence, speed)
    return _worst_at(share, speed)


def _diverged(evidence: Evidence, speed: float) -> Columns:
    """A requirement that fails by runs that diverged: in the range, or next to its end at a `speed` (rad/s)."""
    inside = evidence.response["speed"].values[evidence.diverged & evidence.operates]
    if not len(inside):
        return _no_number(speed, "the run next to the range diverged")
    return _no_number(np.nan, evidence.divergence) | {"from_rad_s": inside.min(), "to_rad_s": inside.max()}


def _no_number(speed: float, note: str) -> Columns:
    """A requirement that fails at a speed (rad/s) without a number to say by how much."""
    return {"verdict": FAILS, **_worst_at(np.nan, speed, note)}


def _used_lining(evidence: Evidence) -> Columns:
    response = evidence.response
    if not np.isfinite(evidence.thickness):
        return {"verdict": NOT_APPLICABLE, "note": "no lining"}
    if reason := _not_known(evidence, "used_thickness", "wear"):
        return {"note": reason}
    # what is worn through has used all, and would use more
    through = (response.get("worn_through_share", 0.0 * response["status"]) > 0.0).values
    used = 100.0 * np.nan_to_num(response["used_thickness"].values) / evidence.thickness
    value, speed = evidence.worst(np.where(through | evidence.diverged, np.inf, used))
    if np.isinf(value):
        worn = evidence.worst(through.astype(float))[0] > 0.0
        return _no_number(speed, "worn through to the casing") if worn else _diverged(evidence, speed)
    return _worst_at(value, np.nan if value == 0.0 else speed)


def _clearance(evidence: Evidence) -> Columns:
    if "clearance" not in evidence.response or evidence.response["clearance"].isnull().all():
        return {"value": 1e3 * evidence.clearance}
    if evidence.not_covered:
        return {"note": evidence.not_covered}
    loss, speed = evidence.worst(-1e3 * evidence.response["clearance"].min("contact_node").values)
    return _worst_at(-loss, speed)


def _miner_sum(evidence: Evidence) -> Columns:
    if np.isnan(evidence.miner_sum):
        return {"note": "no run-up has it: run_ups, fatigue and stress of the scene, the material's fatigue_exponent"}
    if np.isinf(evidence.miner_sum):
        return _no_number(np.nan, "a run-up diverged, or breaks the blade at once")
    return {"value": evidence.miner_sum}


def _mass(evidence: Evidence) -> Columns:
    return {"value": evidence.mass, "note": "" if np.isfinite(evidence.mass) else "matrices do not say it"}


_Numbers = dict[str, tuple[str, float, Callable[[Evidence], Columns]]]
"""Requirement -> unit of its row, factor to it from that of the limit, and its columns."""


def _required(requirements: Requirements, numbers: _Numbers) -> Iterator[tuple[str, str, float, Callable[[Evidence], Columns]]]:
    """Name, unit, limit in this unit, and columns of each requirement among these `numbers` that there is."""
    for name, (unit, factor, columns_of) in numbers.items():
        if (limit := getattr(requirements, name)) is not None:
            yield name, unit, factor * limit, columns_of


_OF_RUNS: _Numbers = {
    "above_yield": ("rad/s", 1.0, _above_yield),
    "goodman_share": ("1", 1.0, _goodman_share),
    "used_lining": ("%", 100.0, _used_lining),
}

_OF_BLADE: _Numbers = {"miner_sum": ("1", 1.0, _miner_sum), "clearance": ("mm", 1e3, _clearance), "mass": ("kg", 1.0, _mass)}


def distance_from_operation(crossing: float, operating: OperatingRange) -> float:
    """Distance of a crossing (rad/s) from the nearest dwell, or without dwells from the range, as a share of its speed.

    0 inside; 1 for a mode that does not cross the engine order in the diagram, which reaches over all that is near.
    """
    if not np.isfinite(crossing):
        return 1.0
    ranges = [(dwell.start, dwell.stop) for dwell in operating.dwell] or [(operating.first, operating.last)]
    return min(max(begin - crossing, crossing - end, 0.0) for begin, end in ranges) / crossing
