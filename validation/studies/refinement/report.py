"""What adaptive speed sampling finds, of how many runs, against every speed of its grid."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from r37core.adaptive.criterion import RefinementChoice
from r37core.adaptive.rounds import first_round, round_after
from r37core.dataset_file import read_dataset
from r37core.plain import from_plain
from r37core.results.interactions import Interaction, InteractionChoice, find_interactions
from r37core.results.measures import leading_edge
from r37core.speeds import SpeedPlan
from r37core.tolerances.table import ROBUST, shares_of_members
from validation.studies.checks import ran
from validation.studies.tables import markdown_table

TOLERANCE = 2.0
"""Difference (rad/s) of a peak's speed or width above yield up to which it counts as the same."""


@dataclass(frozen=True)
class Comparison:
    """One interaction above yield of the whole grid, and the `nearest` that the adaptive speeds show within its width.

    `nearest`: above yield, too, and within TOLERANCE at least; None where there is none. `share_of_members`: how many of a
    sample's show it above yield, at every speed of the grid; NaN without members.
    """

    interaction: Interaction
    nearest: Interaction | None
    share_of_members: float

    @property
    def robust(self) -> bool:
        """Whether at least half of the members show it."""
        return self.share_of_members >= ROBUST

    @property
    def same(self) -> bool:
        """Whether peak and width agree."""
        if self.nearest is None:
            return False
        pairs = zip(_peak_and_width(self.interaction), _peak_and_width(self.nearest), strict=True)
        return all(abs(theirs - ours) <= TOLERANCE for ours, theirs in pairs)


@dataclass(frozen=True)
class Outcome:
    """One way to choose speeds of one blade and scene: its runs, its rounds, and the interactions above yield.

    `errors`: of a line drawn through its speeds, see `errors_between`.
    """

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
    """Status and adaptive.criterion.CURVES of each speed (rad/s)."""
    edge = leading_edge(response)
    stress = (
        response["max_von_mises"] / response["yield_stress"] if "max_von_mises" in response else edge["rms_normal"] * np.nan
    )
    columns = [edge["status"], edge["rms_normal"], edge["rms_tangential"], stress]
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
    compared = [Comparison(row, _nearest(row, got), share) for row, share in zip(wanted, shares, strict=True)]
    return Outcome(len(run), len(speeds), compared, errors_between(response, run))


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
    return [row for row in find_interactions(response, campbell, interactions) if _peak_and_width(row)[1] > 0.0]


def _peak_and_width(row: Interaction) -> tuple[float, float]:
    """Speed of the peak and width above yield (rad/s): of the last revolution, in direct contact of what is certain."""
    every = row.all_revolutions
    width = every.certain_to_rad_s - every.certain_from_rad_s if row.note else row.last_revolution.width_above_yield_rad_s
    return row.peak.peak_speed_rad_s, 0.0 if math.isnan(width) else width


def _nearest(row: Interaction, got: Sequence[Interaction]) -> Interaction | None:
    """The nearest of some interactions within an interaction's width, or TOLERANCE, of its peak."""
    peak, width = _peak_and_width(row)
    near = [other for other in got if abs(other.peak.peak_speed_rad_s - peak) <= max(width, TOLERANCE)]
    return min(near, key=lambda other: abs(other.peak.peak_speed_rad_s - peak), default=None)


def refinement_table(outcomes: Mapping[str, Mapping[tuple[str, str], Outcome]], every: Mapping[tuple[str, str], int]) -> str:
    """What each way to choose speeds finds, of all interactions and of the robust ones where there are members.

    `outcomes`: way -> (blade, scene) -> outcome, the first way is adaptive.

    `every`: number of speeds of the whole grid of each blade and scene.
    """
    first = next(iter(outcomes.values()))
    scenes = dict.fromkeys(scene for _, scene in first)
    lines = [(pair, [pair]) for pair in first]
    lines += [(("all", scene), [pair for pair in first if pair[1] == scene]) for scene in scenes]
    rows = []
    for names, pairs in lines:
        cells = [_cell([ways[pair] for pair in pairs]) for ways in outcomes.values()]
        rows.append([*names, _whole([first[pair] for pair in pairs], sum(every[pair] for pair in pairs)), *cells])
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
    matched = [row for row in together if row.nearest is not None]
    robust = f", {sum(row.robust for row in matched)} of the robust" if _with_members(together) else ""
    rounds = f" in {outcomes[0].rounds} rounds" if len(outcomes) == 1 and outcomes[0].rounds > 1 else ""
    same, runs = sum(row.same for row in together), sum(run.runs for run in outcomes)
    return f"{len(matched)} found{robust}, {same} the same, {runs} runs{rounds}"


def _with_members(interactions: Sequence[Comparison]) -> bool:
    return any(not math.isnan(row.share_of_members) for row in interactions)


def _of_missed(missed: Sequence[tuple[str, str, Comparison]]) -> str:
    if not missed:
        return "Nothing is missed.\n"
    rows = []
    for blade, scene, row in missed:
        crossing, every, last = row.interaction.crossing, row.interaction.all_revolutions, row.interaction.last_revolution
        order = "" if crossing.engine_order is None or math.isnan(crossing.engine_order) else f"/{crossing.engine_order}"
        name = f"{crossing.mode}{order}" if crossing.mode else f"no crossing, order {crossing.engine_order}"
        stress = every.median_von_mises_pa if row.interaction.note else last.max_von_mises_pa
        ours, theirs = (_shown(each) for each in (row.interaction, row.nearest))
        share = "" if math.isnan(row.share_of_members) else f"{100 * row.share_of_members:.0f}%"
        rows.append([blade, scene, name, ours, f"{1e-9 * stress:.2f}", theirs, share])
    head = ["blade", "scene", "interaction", "peak, width (rad/s)", "largest stress (GPa)", "found peak, width", "members"]
    return f"Missed, or off by more:\n\n{markdown_table(head, rows)}"


def _shown(row: Interaction | None) -> str:
    return "none" if row is None else "{:g}, {:.1f}".format(*_peak_and_width(row))
