"""Adaptive speed sampling where every speed of its grid has been run: which of them it would have asked for."""

import numpy as np
import xarray as xr

from r37core.base.speeds import SpeedPlan
from r37core.results.measures import leading_edge

from .criterion import RefinementChoice
from .rounds import first_round, round_after


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
    stress = edge["max_von_mises"] / edge["yield_stress"] if "max_von_mises" in edge else edge["rms_normal"] * np.nan
    columns = [edge["status"], edge["rms_normal"], edge["rms_tangential"], stress]
    rows = np.stack([column.values.astype(float) for column in columns], axis=1)
    return dict(zip(map(float, response["speed"].values), rows.tolist(), strict=True))
