"""The table of extremes: their outcomes, each a real run judged by another with half its step."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.measures import leading_edge, motion
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus

from .case import HALF_STEP
from .case_table import case_table, energy_share

ACCURATE, DEGRADED, DIVERGED, REFUSED, UNSOUND = OUTCOMES = ("accurate", "degraded", "diverged", "refused", "unsound")
"""Accurate: half the step gives the same mean rms within ACCURATE_WITHIN; degraded: it does not; diverged: the run reports it,
and the half step tells whether it is the model or the step; refused: with a reason, before anything ran; unsound: a number that
is not finite, an open energy balance or violated contact conditions in a run that counts as completed."""

ACCURATE_WITHIN = 0.05
ENERGY_WITHIN = 1e-6
COMPLEMENTARITY_WITHIN = 1e-8
_FINITE = ("rms_normal", "rms_tangential", "peak_normal")


def numbers(response: xr.Dataset) -> dict[str, Any]:
    """Numbers of a case: columns of the table, whether a run of it diverged, and what is `unsound`."""
    diverged = bool(response["status"].any())
    return {
        "time_step_s": float(response["time_step"].mean()),
        # mean over the speeds of the leading edge's normal and tangential motion together
        "rms_m": np.nan if diverged else float(motion(response).mean()),
        "share_in_contact": float(response["share_of_time_in_contact"].mean()),
        "diverged": diverged,
        "unsound": unsound(response),
    }


def judge(case: Mapping[str, Any], half: Mapping[str, Any]) -> tuple[str, str]:
    """Outcome and detail of a case, from its row in the table of cases and from that with half the step."""
    if case["refused"]:
        return REFUSED, case["refused"]
    if case["unsound"]:
        return UNSOUND, case["unsound"]
    if half["refused"]:
        return DEGRADED, f"half the step is refused: {half['refused']}"
    if half["unsound"]:
        return UNSOUND, f"half the step: {half['unsound']}"
    if case["diverged"]:
        also = "so does half the step" if half["diverged"] else "half the step does not"
        return DIVERGED, f"{also}; recorded as diverged"
    if half["diverged"]:
        return DEGRADED, "half the step diverges"
    mine, theirs = case["rms_m"], half["rms_m"]
    if theirs == 0.0 and mine == 0.0:
        return ACCURATE, "nothing touches"
    change = abs(mine - theirs) / theirs
    return ACCURATE if change < ACCURATE_WITHIN else DEGRADED, f"mean rms changes by {100 * change:.2g}% with half the step"


def unsound(response: xr.Dataset) -> str:
    """The wrong number of a run that counts as completed; empty where every run diverged or has finite, balanced numbers."""
    completed = response["status"].values == RunStatus.COMPLETED
    edge = leading_edge(response)
    for name in _FINITE:
        if not np.all(np.isfinite(edge[name].values[completed])):
            return f"{name} is not finite"
    energy = np.abs(energy_share(response)[completed])
    if not np.all(energy < ENERGY_WITHIN):
        return f"energy balance open by {energy.max():.2g} of the work"
    violation = response["worst_complementarity"].values[completed]
    if not np.all(violation < COMPLEMENTARITY_WITHIN):
        return f"contact conditions violated by {violation.max():.2g} of the gap"
    return ""


def closing(results: Path) -> str:
    """How many extremes have each outcome."""
    outcomes = read_table(results / "stability.csv")["outcome"]
    several = ", ".join(f"{number} {outcome}" for outcome, number in outcomes.value_counts().items())
    return f"{counted(len(outcomes), 'extreme')}: {several}"


COLUMNS = ("what", "value", "scene", "outcome", "detail", "time_step_s", "rms_m", "share_in_contact")


def tables(responses: Mapping[str, xr.Dataset]) -> dict[str, pd.DataFrame]:
    """The outcome of every extreme."""
    cases = case_table(responses, numbers).to_dict("index")
    rows = []
    for name in [name for name in cases if not name.endswith(HALF_STEP)]:
        outcome, detail = judge(cases[name], cases.get(f"{name}{HALF_STEP}", {}))
        # the name has what is extreme, its value and the scene
        extreme, _, scene = name.partition("__")
        what, _, value = extreme.rpartition("_")
        words = {"what": what, "value": value, "scene": scene}
        rows.append({**words, **cases[name], "outcome": outcome, "detail": detail})
    return {"table": pd.DataFrame(rows, columns=list(COLUMNS))}
