"""round_*.json: which speeds of one blade and scene a round of refinement asks for, and what the rounds before it gave."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

import numpy as np
from xarray import Dataset

from r37core.base.io import read_json, readable, write_json
from r37core.base.speeds import SpeedPlan
from r37core.results.events import exit_of, yield_events
from r37core.time_integration.simulate import TIP_POINTS
from r37core.time_integration.speed_file import read_speed

from .criterion import RefinementChoice, dense_ranges, next_speeds, window_speeds


@dataclass(frozen=True)
class Round:
    """Round: its `new` speeds (rad/s), ascending, none in the last; `measured` of each speed before: Danger, CURVES.

    Of several members of a sample these follow one after the other.
    """

    new: tuple[float, ...]
    measured: Mapping[float, Sequence[float]] = field(default_factory=dict)


def first_round(plan: SpeedPlan, campbell: Dataset, choice: RefinementChoice) -> Round:
    """The certain speeds of the plan, and those in the windows above the crossings of one blade's Campbell diagram."""
    expected = dense_ranges(campbell, choice.windows)
    windows = {speed for grid in plan.refined for speed in window_speeds(grid, expected)}
    return Round(tuple(sorted({*plan.certain, *windows})))


def round_after(before: Round, gave: Mapping[float, Sequence[float]], plan: SpeedPlan, choice: RefinementChoice) -> Round:
    """The round after one whose new speeds `gave` a Danger and CURVES each."""
    measured = {**before.measured, **gave}
    new = {speed for grid in plan.refined for speed in next_speeds(grid, measured, choice)}
    return Round(tuple(sorted(new)), measured)


def measure_members(yields: Sequence[float], speeds: Sequence[float], files: Iterable[Path | str]) -> dict[float, list[float]]:
    """Danger and CURVES at each speed (rad/s), one member after the other, as Round has them; one blade alone is one member.

    Both are by the region that decides. Without stress a speed is dangerous where it diverges inside the model, and CURVES have
    NaN. `yields`: yield stress (Pa) of each; `files`: member by member those of all speeds. Raises InputFileError for a file
    that cannot be read.
    """
    gave: dict[float, list[float]] = {speed: [] for speed in speeds}
    edge = TIP_POINTS.index("leading_edge")
    for (yield_stress, speed), file in zip(product(yields, speeds), files, strict=True):
        run = {"revolution_von_mises": np.full((1, 0), np.nan)} | read_speed(file)
        events = yield_events(run, yield_stress, float(exit_of(run)["exit_revolution"]))
        stress = events["max_von_mises_inside"][0] / yield_stress if run["revolution_von_mises"].size else np.nan
        curves = (float(run[f"rms_{name}"][edge]) for name in ("normal", "tangential"))
        gave[speed] += [int(events["yield_danger"][0]), *curves, float(stress)]
    return gave


def write_round(finished: Round, file: Path | str) -> None:
    """Write it, atomically; what is no number is null."""
    rows = [[speed, *(None if math.isnan(value) else value for value in row)] for speed, row in finished.measured.items()]
    write_json({"new": list(finished.new), "measured": rows}, file)


def read_round(file: Path | str) -> Round:
    """Read what `write_round` wrote; InputFileError when it cannot be read."""
    content = read_json(file)
    with readable(file):
        rows = {row[0]: [math.nan if value is None else value for value in row[1:]] for row in content["measured"]}
        return Round(tuple(map(float, content["new"])), rows)
