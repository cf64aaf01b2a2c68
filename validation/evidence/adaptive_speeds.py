"""What adaptive speed sampling finds, of how many runs, against every speed of its grid."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import xarray as xr

from r37core.adaptive.refinement_choice import RefinementChoice
from r37core.adaptive.rounds import first_round, round_after
from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.base.speeds import SpeedPlan
from r37core.config import plain
from r37core.plans.sweep_plan import Sweep
from r37core.results.interactions import Interaction, InteractionChoice, find_interactions
from r37core.results.measures import leading_edge
from r37core.results.regions import read_judged

from .configuration import settings_of
from .pages import write_table

STEPS = (5.0, 20.0)
"""Plain grids (rad/s): as many runs as a fifth of every 1 rad/s, and those of the level `draft`."""

TOLERANCE = 2.0
"""Difference (rad/s) of a peak's speed or width above yield up to which it counts as the same."""


@dataclass(frozen=True)
class Comparison:
    """One interaction above yield of the whole grid, and the `nearest` that the adaptive speeds show within its width.

    `nearest`: above yield, too, and within TOLERANCE at least; None where there is none.
    """

    interaction: Interaction
    nearest: Interaction | None

    @property
    def same(self) -> bool:
        """Whether peak and width agree."""
        if self.nearest is None:
            return False
        pairs = zip(_peak_and_width(self.interaction), _peak_and_width(self.nearest), strict=True)
        return all(abs(theirs - ours) <= TOLERANCE for ours, theirs in pairs)

    @property
    def name(self) -> str:
        """Mode and engine order of the interaction."""
        mode, engine_order = (self.interaction[name] for name in ("mode", "engine_order"))
        order = "" if engine_order is None or math.isnan(engine_order) else f"/{engine_order}"
        return f"{mode}{order}" if mode else f"no crossing, order {engine_order}"


@dataclass(frozen=True)
class Outcome:
    """One way to choose speeds of one blade and scene: its runs, its rounds, and the interactions above yield.

    `errors`: of a line drawn through its speeds, see `errors_between`.
    """

    runs: int
    rounds: int
    interactions: list[Comparison]
    errors: tuple[float, float, float]


Outcomes = Mapping[tuple[str, str], Mapping[str, Outcome]]
"""(Blade, scene) -> way -> outcome; the first way is adaptive."""


def tables(input: Any, output: Any, params: Any) -> None:
    """Each way to choose speeds against every speed. Input: Campbell diagrams of all blades, and `files`, their responses."""
    settings = settings_of(Path.cwd())
    diagrams, rounds = read_dataset(input.campbell), Sweep(settings)
    interactions = from_plain(InteractionChoice, plain(settings.config.interactions))
    outcomes: dict[tuple[str, str], dict[str, Outcome]] = {}
    for file in as_list(input.files):
        blade, scene = Path(file).parts[-3:-1]
        response, campbell, plan = read_judged(file), diagrams.sel(blade=blade), settings.speed_plans[blade, scene]
        choice = from_plain(RefinementChoice, rounds.refinement_choice(SimpleNamespace(blade=blade, scene=scene)))
        ways = {"adaptive": replay(response, campbell, plan, choice)}
        ways |= {f"every {step:g} rad/s": [plain_grid(plan, step)] for step in STEPS}
        outcomes[blade, scene] = {way: compare(response, campbell, speeds, interactions) for way, speeds in ways.items()}
    write_table(*summary(outcomes), output.table)
    write_table(*by_blade(outcomes), output.blades)
    write_table(*missed(outcomes), output.missed)


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
    name = "max_von_mises_last_revolution"
    stress = edge[name] / edge["yield_stress"] if name in edge else edge["rms_normal"] * np.nan
    columns = [edge["status"], edge["rms_normal"], edge["rms_tangential"], stress]
    rows = np.stack([column.values.astype(float) for column in columns], axis=1)
    return dict(zip(map(float, response["speed"].values), rows.tolist(), strict=True))


def plain_grid(plan: SpeedPlan, step: float) -> list[float]:
    """Every so many rad/s of the grids of a plan, ascending."""
    return sorted(
        grid.speed(index) for grid in plan.refined for index in range(0, grid.last + 1, max(1, round(step / grid.interval)))
    )


def compare(
    response: xr.Dataset, campbell: xr.Dataset, speeds: Sequence[Sequence[float]], interactions: InteractionChoice
) -> Outcome:
    """The interactions above yield that the `speeds` (rad/s) of each round show, against those of the whole grid."""
    run = sorted(speed for new in speeds for speed in new)
    wanted, got = (above_yield(part, campbell, interactions) for part in (response, response.sel(speed=run)))
    compared = [Comparison(row, _nearest(row, got)) for row in wanted]
    return Outcome(len(run), len(speeds), compared, errors_between(response, run))


def errors_between(response: xr.Dataset, run: Sequence[float]) -> tuple[float, float, float]:
    """What straight lines between the speeds `run` (rad/s) miss of every speed of the grid that has numbers.

    Mean errors of the leading edge's rms and of the largest stress, as shares of their means, then the share of the largest
    stress that is not seen; NaN without stress.
    """
    rms = leading_edge(response)["rms_normal"].values
    name = "max_von_mises_last_revolution"
    stress = response[name].values if name in response else np.full_like(rms, np.nan)
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
    """Interactions of a response that pass yield, on a bare casing in most revolutions."""
    return [row for row in find_interactions(response, campbell, interactions) if _peak_and_width(row)[1] > 0.0]


def _peak_and_width(row: Interaction) -> tuple[float, float]:
    """Speed of the peak and length above yield (rad/s): in any later revolution, on a bare casing in most of them."""
    width = row["length_most_revolutions_rad_s" if row["note"] else "length_ever_rad_s"]
    return row["peak_speed_rad_s"], 0.0 if math.isnan(width) else width


def _nearest(row: Interaction, got: Sequence[Interaction]) -> Interaction | None:
    """The nearest of some interactions within an interaction's width, or TOLERANCE, of its peak."""
    peak, width = _peak_and_width(row)
    near = [other for other in got if abs(other["peak_speed_rad_s"] - peak) <= max(width, TOLERANCE)]
    return min(near, key=lambda other: abs(other["peak_speed_rad_s"] - peak), default=None)


def summary(outcomes: Outcomes) -> tuple[list[str], list[list[str]]]:
    """Of all blades: runs, interactions above yield that are found and found the same, and what lines between speeds miss."""
    rows = []
    for scene in dict.fromkeys(scene for _, scene in outcomes):
        of_scene = [ways for (_, name), ways in outcomes.items() if name == scene]
        for way in of_scene[0]:
            several = [ways[way] for ways in of_scene]
            together = [row for outcome in several for row in outcome.interactions]
            found = sum(row.nearest is not None for row in together)
            errors = [f"{100.0 * error:.1f}%" for error in np.mean([outcome.errors for outcome in several], axis=0)[[0, 2]]]
            runs = f"{sum(outcome.runs for outcome in several):,}"
            rows.append([scene, way, runs, f"{found} of {len(together)}", f"{sum(row.same for row in together)}", *errors])
    head = ["scene", "speeds", "runs", "found", f"peak and width within {TOLERANCE:g} rad/s"]
    return [*head, "error of rms between speeds", "largest stress not seen"], rows


def by_blade(outcomes: Outcomes) -> tuple[list[str], list[list[str]]]:
    """The same counts of each blade and scene."""
    rows = [
        [*pair, way, f"{outcome.runs}", f"{outcome.rounds}", f"{len(outcome.interactions)}", *_counts(outcome)]
        for pair, ways in outcomes.items()
        for way, outcome in ways.items()
    ]
    return ["blade", "scene", "speeds", "runs", "rounds", "interactions above yield", "found", "the same"], rows


def _counts(outcome: Outcome) -> tuple[str, str]:
    found = sum(row.nearest is not None for row in outcome.interactions)
    return f"{found}", f"{sum(row.same for row in outcome.interactions)}"


def missed(outcomes: Outcomes) -> tuple[list[str], list[list[str]]]:
    """Interactions that the adaptive speeds do not find, or find with another peak or width."""
    rows = []
    for pair, ways in outcomes.items():
        for row in ways["adaptive"].interactions:
            if not row.same:
                found = ["", ""] if row.nearest is None else _numbers(row.nearest)
                rows.append([*pair, row.name, *_numbers(row.interaction), *found])
    head = ["peak (rad/s)", "width above yield (rad/s)"]
    return ["blade", "scene", "interaction", *head, *(f"found: {name}" for name in head)], rows


def _numbers(interaction: Interaction) -> list[str]:
    peak, width = _peak_and_width(interaction)
    return [f"{peak:g}", f"{width:.1f}"]
