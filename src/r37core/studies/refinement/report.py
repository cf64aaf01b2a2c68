"""What adaptive speed sampling finds, of how many runs, against every speed of its grid."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from r37core.adaptive.criterion import CURVES, RefinementChoice
from r37core.adaptive.rounds import first_round, round_after
from r37core.dataset_file import read_dataset
from r37core.plain import from_plain
from r37core.results.interactions import Interaction, InteractionChoice, find_interactions
from r37core.results.measures import leading_edge
from r37core.speeds import SpeedPlan
from r37core.tolerances.table import ROBUST, shares_of_members

from ..checks import ran
from ..tables import markdown_table

TOLERANCE = 2.0
"""Difference (rad/s) of a peak's speed or width above yield up to which it counts as the same."""


@dataclass(frozen=True)
class Comparison:
    """One interaction above yield of the whole grid, and what the adaptive speeds have of it.

    Speeds and widths in rad/s, `stress` in Pa; `found_peak` and `found_width` NaN where there is no interaction
    above yield within the width, or TOLERANCE, of it. `share_of_members`: how many of a sample's show it above yield, at
    every speed of the grid; NaN without members.
    """

    mode: str
    engine_order: int | None
    peak: float
    width: float
    stress: float
    found_peak: float
    found_width: float
    share_of_members: float

    @property
    def robust(self) -> bool:
        """Whether at least half of the members show it."""
        return self.share_of_members >= ROBUST

    @property
    def is_found(self) -> bool:
        """Whether there is one at all."""
        return not math.isnan(self.found_peak)

    @property
    def same(self) -> bool:
        """Whether peak and width agree."""
        return abs(self.found_peak - self.peak) <= TOLERANCE and abs(self.found_width - self.width) <= TOLERANCE


@dataclass(frozen=True)
class Outcome:
    """One way to choose speeds of one blade and scene: runs of its first round, of all, and the interactions above yield.

    `errors`: of a line drawn through its speeds, see `errors_between`.
    """

    first: int
    runs: int
    rounds: int
    interactions: list[Comparison]
    errors: tuple[float, float, float]


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, str]:
    """Each way to choose speeds against every speed of the grids."""
    interactions = from_plain(InteractionChoice, values["interactions"])
    diagrams = read_dataset(files.campbell)
    ways: dict[str, dict[tuple[str, str], Outcome]] = {"adaptive": {}}
    every = {}
    for name, (blade, scene) in values["pairs"].items():
        response = ran(responses[name], name)
        campbell, plan = diagrams.sel(blade=blade), from_plain(SpeedPlan, values["plans"][name])
        choice = from_plain(RefinementChoice, values["choices"][name])
        cases = values["members"].get(name, {})
        members = {member: above_yield(ran(responses[case], case), campbell, interactions) for member, case in cases.items()}
        every[blade, scene] = response.sizes["speed"]
        speeds = {"adaptive": replay(response, campbell, plan, choice)}
        speeds |= {f"every {step:g} rad/s": [plain_grid(plan, step)] for step in values["steps"]}
        for way, several in speeds.items():
            ways.setdefault(way, {})[blade, scene] = compare(response, campbell, several, interactions, members)
    return {"table": refinement_table(ways, every)}


def replay(response: xr.Dataset, campbell: xr.Dataset, plan: SpeedPlan, choice: RefinementChoice) -> list[list[float]]:
    """New speeds (rad/s) of each round, as the sweep would ask for them, with the runs looked up in the whole grid."""
    rows = _measured(response)
    current = first_round(plan, campbell, choice)
    rounds = []
    while current.new:
        rounds.append(list(current.new))
        current = round_after(current, {speed: rows[speed] for speed in current.new}, plan, choice)
    return rounds


def _measured(response: xr.Dataset) -> dict[float, list[float]]:
    """Status and CURVES of each speed (rad/s)."""
    edge = leading_edge(response)
    stress = (
        response["max_von_mises"] / response["yield_stress"] if "max_von_mises" in response else edge["rms_normal"] * np.nan
    )
    columns = [edge["status"], edge["rms_normal"], edge["rms_tangential"], stress]
    assert len(columns) == 1 + len(CURVES)
    rows = np.stack([column.values.astype(float) for column in columns], axis=1)
    return dict(zip(map(float, response["speed"].values), rows.tolist(), strict=True))


def plain_grid(plan: SpeedPlan, step: float) -> list[float]:
    """Every so many rad/s of the grids of a plan, ascending."""
    return sorted(
        grid.speed(index) for grid in plan.refined for index in range(0, grid.last + 1, max(1, round(step / grid.interval)))
    )


def compare(
    response: xr.Dataset,
    campbell: xr.Dataset,
    speeds: Sequence[Sequence[float]],
    interactions: InteractionChoice,
    members: Mapping[str, Sequence[Interaction]] | None = None,
) -> Outcome:
    """Hold the interactions above yield that the `speeds` (rad/s) of each round show against those of the whole grid.

    `members`: interactions above yield of the members of a sample, on the whole grid, by name.
    """
    run = sorted(speed for new in speeds for speed in new)
    wanted, got = (above_yield(part, campbell, interactions) for part in (response, response.sel(speed=run)))
    shares = shares_of_members(wanted, members, interactions) if members else [math.nan] * len(wanted)
    compared = [_held_against(row, got, share) for row, share in zip(wanted, shares, strict=True)]
    return Outcome(len(speeds[0]), len(run), len(speeds), compared, errors_between(response, run))


def errors_between(response: xr.Dataset, run: Sequence[float]) -> tuple[float, float, float]:
    """What straight lines between the speeds `run` (rad/s) miss of every speed of the grid that has numbers.

    Mean errors of the leading edge's rms and of the largest stress, as shares of their means, then the share of the largest
    stress that is not seen; NaN without stress.
    """
    rms = leading_edge(response)["rms_normal"].values
    stress = response["max_von_mises"].values if "max_von_mises" in response else np.full_like(rms, np.nan)
    speed = response["speed"].values
    (of_rms, _), (of_stress, unseen) = (_missed(speed, curve, run) for curve in (rms, stress))
    return of_rms, of_stress, unseen


def _missed(speed: np.ndarray, curve: np.ndarray, run: Sequence[float]) -> tuple[float, float]:
    """Mean error of a curve's lines, and the share of its top above them; NaN where it has no numbers at the speeds `run`."""
    finite = np.isfinite(curve)
    known = finite & np.isin(speed, run)
    if not known.any():
        return math.nan, math.nan
    lines = np.interp(speed[finite], speed[known], curve[known])
    error = np.mean(np.abs(lines - curve[finite])) / np.mean(curve[finite])
    return float(error), float(1.0 - np.max(curve[known]) / np.max(curve[finite]))


def above_yield(response: xr.Dataset, campbell: xr.Dataset, interactions: InteractionChoice) -> list[Interaction]:
    """Interactions of a response that pass yield, in direct contact certainly."""
    return [row for row in find_interactions(response, campbell, interactions) if _width(row) > 0.0]


def _width(row: Interaction) -> float:
    """Width above yield (rad/s): of the last revolution, in direct contact of what is certain."""
    every = row.all_revolutions
    width = every.certain_to_rad_s - every.certain_from_rad_s if row.note else row.last_revolution.width_above_yield_rad_s
    return 0.0 if math.isnan(width) else width


def _held_against(row: Interaction, got: Sequence[Interaction], share_of_members: float) -> Comparison:
    """One interaction beside the nearest of those that were found."""
    peak, width = row.peak.peak_speed_rad_s, _width(row)
    near = [other for other in got if abs(other.peak.peak_speed_rad_s - peak) <= max(width, TOLERANCE)]
    nearest = min(near, key=lambda other: abs(other.peak.peak_speed_rad_s - peak), default=None)
    return Comparison(
        mode=row.crossing.mode,
        engine_order=row.crossing.engine_order,
        peak=peak,
        width=width,
        stress=row.all_revolutions.median_von_mises_pa if row.note else row.last_revolution.max_von_mises_pa,
        found_peak=nearest.peak.peak_speed_rad_s if nearest else math.nan,
        found_width=_width(nearest) if nearest else math.nan,
        share_of_members=share_of_members,
    )


def refinement_table(outcomes: Mapping[str, Mapping[tuple[str, str], Outcome]], every: Mapping[tuple[str, str], int]) -> str:
    """What each way to choose speeds finds, of all interactions and of the robust ones where there are members.

    `outcomes`: way -> (blade, scene) -> outcome, the first way is adaptive.

    `every`: number of speeds of the whole grid of each blade and scene.
    """
    first = next(iter(outcomes.values()))
    rows = []
    for blade, scene in first:
        cells = [_cell([ways[blade, scene]]) for ways in outcomes.values()]
        rows.append([blade, scene, _whole([first[blade, scene]], every[blade, scene]), *cells])
    scenes = dict.fromkeys(scene for _, scene in first)
    for scene in scenes:
        totals = [_cell([run for pair, run in ways.items() if pair[1] == scene]) for ways in outcomes.values()]
        of_scene = [pair for pair in first if pair[1] == scene]
        rows.append(["all", scene, _whole([first[pair] for pair in of_scene], sum(every[pair] for pair in of_scene)), *totals])
    missed = [(*pair, row) for pair, outcome in first.items() for row in outcome.interactions if not row.same]
    return (
        f"Interactions above yield that are found at all, and with peak and width within {TOLERANCE:g} rad/s; runs of each way "
        f"to choose speeds. Robust: at least half of the members show it.\n\n"
        f"{markdown_table(['blade', 'scene', 'whole grid', *outcomes], rows)}\n"
        f"{_of_errors(outcomes, scenes)}\n{_of_missed(missed)}"
    )


def _of_errors(outcomes: Mapping[str, Mapping[tuple[str, str], Outcome]], scenes: Iterable[str]) -> str:
    """Means over the blades."""
    rows = []
    for scene in scenes:
        for way, of_pairs in outcomes.items():
            errors = np.mean([run.errors for pair, run in of_pairs.items() if pair[1] == scene], axis=0)
            rows.append([scene, way, *(f"{100 * error:.1f}%" for error in errors)])
    head = ["scene", "speeds", "rms", "largest stress", "largest stress of all"]
    return (
        "Straight lines between the speeds that are run, means over the blades: error of the leading edge's normal rms and of "
        "the largest stress, over all speeds and as a share of the mean; what is not seen of the largest stress of all.\n\n"
        f"{markdown_table(head, rows)}"
    )


def _whole(outcomes: Sequence[Outcome], runs: int) -> str:
    together = [row for outcome in outcomes for row in outcome.interactions]
    robust = f", {sum(row.robust for row in together)} robust," if _with_members(together) else ""
    return f"{len(together)}{robust} in {runs} runs"


def _cell(outcomes: Sequence[Outcome]) -> str:
    together = [row for outcome in outcomes for row in outcome.interactions]
    robust = f", {sum(row.is_found and row.robust for row in together)} of the robust" if _with_members(together) else ""
    rounds = f" in {outcomes[0].rounds} rounds" if len(outcomes) == 1 and outcomes[0].rounds > 1 else ""
    matched, same = (sum(getattr(row, name) for row in together) for name in ("is_found", "same"))
    return f"{matched} found{robust}, {same} the same, {sum(run.runs for run in outcomes)} runs{rounds}"


def _with_members(interactions: Sequence[Comparison]) -> bool:
    return any(not math.isnan(row.share_of_members) for row in interactions)


def _of_missed(missed: Sequence[tuple[str, str, Comparison]]) -> str:
    if not missed:
        return "Nothing is missed.\n"
    rows = []
    for blade, scene, row in missed:
        order = "" if row.engine_order is None or math.isnan(row.engine_order) else f"/{row.engine_order}"
        name = f"{row.mode}{order}" if row.mode else f"no crossing, order {row.engine_order}"
        matched = f"{row.found_peak:g}, {row.found_width:.1f}" if row.is_found else "none"
        share = "" if math.isnan(row.share_of_members) else f"{100 * row.share_of_members:.0f}%"
        rows.append([blade, scene, name, f"{row.peak:g}, {row.width:.1f}", f"{1e-9 * row.stress:.2f}", matched, share])
    head = ["blade", "scene", "interaction", "peak, width (rad/s)", "largest stress (GPa)", "found peak, width", "members"]
    return f"Missed, or off by more:\n\n{markdown_table(head, rows)}"
