"""What happens at extremes: every case is a real run, judged against itself with half the step."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.cases.runner import energy_share
from r37core.results.closing import counted
from r37core.results.measures import leading_edge, motion
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus

ACCURATE, DEGRADED, DIVERGED, REFUSED, UNSOUND = OUTCOMES = ("accurate", "degraded", "diverged", "refused", "unsound")
"""Accurate: half the step gives the same mean rms within ACCURATE_WITHIN; degraded: it does not; diverged: the run reports it,
and the half step tells whether it is the model or the step; refused: with a reason, before anything ran; unsound: a number that
is not finite, an open energy balance or violated contact conditions in a run that counts as completed."""

ACCURATE_WITHIN = 0.05
ENERGY_WITHIN = 1e-6
COMPLEMENTARITY_WITHIN = 1e-8
_FINITE = ("rms_normal", "rms_tangential", "peak_normal")


def judge(case: xr.Dataset, half: xr.Dataset) -> dict[str, Any]:
    """Outcome, detail and numbers of a case, from its response and that with half the step."""
    if "refused" in case.attrs:
        return {"outcome": REFUSED, "detail": case.attrs["refused"]}
    numbers = {
        "time_step_s": float(case["time_step"].mean()),
        "rms_m": _mean_motion(case),
        "share_in_contact": float(case["share_of_time_in_contact"].mean()),
    }
    outcome, detail = _compared(case, half)
    return {"outcome": outcome, "detail": detail, **numbers}


def _compared(case: xr.Dataset, half: xr.Dataset) -> tuple[str, str]:
    if wrong := unsound(case):
        return UNSOUND, wrong
    if "refused" in half.attrs:
        return DEGRADED, f"half the step is refused: {half.attrs['refused']}"
    if wrong := unsound(half):
        return UNSOUND, f"half the step: {wrong}"
    if case["status"].any():
        also = "so does half the step" if half["status"].any() else "half the step does not"
        return DIVERGED, f"{also}; recorded as diverged"
    if half["status"].any():
        return DEGRADED, "half the step diverges"
    mine, theirs = _mean_motion(case), _mean_motion(half)
    if theirs == 0.0 and mine == 0.0:
        return ACCURATE, "nothing touches"
    change = abs(mine - theirs) / theirs
    return ACCURATE if change < ACCURATE_WITHIN else DEGRADED, f"mean rms changes by {100 * change:.2g}% with half the step"


def _mean_motion(response: xr.Dataset) -> float:
    """Mean over the speeds of the rms (m) of the leading edge's normal and tangential motion together; NaN if one diverged."""
    return np.nan if response["status"].any() else float(motion(response).mean())


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
