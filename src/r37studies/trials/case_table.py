"""The table of a preset's variations: a row for each, with its outcome, its effect and its cost."""

import re
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import SPEED
from r37core.results.closing import counted
from r37core.results.measures import leading_edge, motion
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus

ACCURATE, DEGRADED, DIVERGED, REFUSED, UNSOUND = OUTCOMES = ("accurate", "degraded", "diverged", "refused", "unsound")
"""Accurate: the mean rms is that of the case it is compared with, within ACCURATE_WITHIN; degraded: it is not; diverged: the
run reports it; refused: with a reason, before anything ran; unsound: a number that is not finite, an open energy balance or
violated contact conditions in a run that counts as completed."""

ACCURATE_WITHIN = 0.05
ENERGY_WITHIN = 1e-6
COMPLEMENTARITY_WITHIN = 1e-8

_NUMBERS = ["time_step_s", "share_in_contact", "rms_m"]

QUANTITIES = ["rms_normal", "rms_tangential", "peak_normal", "max_von_mises_last_revolution", "max_wear"]
"""Variables of a response whose means over the speeds are compared, where it has them; a motion is that of the leading edge."""

COSTS = ["cpu_s", "model_cpu_s"]
"""Mean CPU time of a run, and CPU time of making the model."""


def refusal(reason: str) -> xr.Dataset:
    """A response without speeds, whose attribute `refused` has the reason, without its remedies."""
    return xr.Dataset(coords={"speed": ("speed", np.empty(0), SPEED.attributes)}, attrs={"refused": reason.split(";")[0]})


def table(responses: Mapping[str, xr.Dataset], compared: Mapping[str, Sequence[str]]) -> pd.DataFrame:
    """A row for each case in `compared`, against the first of the cases named there that was run.

    `responses`: of cases called `what/value__scene`. Columns: these three words, `compared_with`, `outcome`, `detail`; time
    step, share of time in contact and mean rms of normal and tangential motion together; relative `error_` of QUANTITIES;
    COSTS.
    """
    columns = ["refused", "diverged", "unsound", *_NUMBERS, *QUANTITIES, *COSTS]
    cases = pd.DataFrame([numbers(each) for each in responses.values()], list(responses), columns)
    others = [next((each for each in names if not cases.refused[each]), names[0]) for names in compared.values()]
    ours, theirs = cases.loc[list(compared)], cases.loc[others]
    words = pd.DataFrame([re.split("/|__", name) for name in compared], ours.index, ["what", "value", "scene"])
    judged = [judge(*pair) for pair in zip(ours.to_dict("records"), theirs.to_dict("records"), strict=True)]
    means = theirs[QUANTITIES].astype(float)
    errors = (ours[QUANTITIES].astype(float) / means.where(means > 0.0).to_numpy() - 1.0).abs()
    return pd.concat(
        [
            words.assign(compared_with=others),
            pd.DataFrame(judged, ours.index, ["outcome", "detail"]),
            ours[_NUMBERS],
            errors.add_prefix("error_"),
            ours[COSTS],
        ],
        axis=1,
    )


def numbers(response: xr.Dataset) -> dict[str, Any]:
    """Attributes of a response, COSTS among them, and of one that was not refused what it is judged by."""
    if "refused" in response.attrs:
        return response.attrs
    edge = leading_edge(response)
    diverged = bool(edge["status"].any())
    return {
        "refused": "",
        **response.attrs,
        "diverged": diverged,
        "unsound": unsound(edge),
        "time_step_s": float(edge["time_step"].mean()),
        "share_in_contact": float(edge["share_of_time_in_contact"].mean()),
        "rms_m": np.nan if diverged else motion(edge).mean(),
        **{name: edge[name].values.mean() for name in QUANTITIES if name in edge},
    }


def judge(case: Mapping[str, Any], other: Mapping[str, Any]) -> tuple[str, str]:
    """Outcome and detail of a case, from its numbers and those of the case it is compared with."""
    if case["refused"]:
        return REFUSED, case["refused"]
    if case["unsound"]:
        return UNSOUND, case["unsound"]
    if other["refused"]:
        return DEGRADED, f"what it is compared with is refused: {other['refused']}"
    if other["unsound"]:
        return UNSOUND, f"what it is compared with: {other['unsound']}"
    if case["diverged"]:
        return DIVERGED, f"what it is compared with {'diverges, too' if other['diverged'] else 'does not'}"
    if other["diverged"]:
        return DEGRADED, "what it is compared with diverges"
    if case["rms_m"] == other["rms_m"] == 0.0:
        return ACCURATE, "nothing touches"
    change = np.abs(case["rms_m"] - other["rms_m"]) / other["rms_m"]
    return ACCURATE if change < ACCURATE_WITHIN else DEGRADED, f"mean rms differs by {100 * change:.2g}%"


def unsound(edge: xr.Dataset) -> str:
    """The wrong number of a run that counts as completed; empty where every run diverged or has finite, balanced numbers."""
    completed = edge.isel(speed=edge["status"].values == RunStatus.COMPLETED)
    for name in QUANTITIES[:3]:
        if not np.all(np.isfinite(completed[name])):
            return f"{name} is not finite"
    # what stays open, as a share of all that went in and out
    turned_over = np.abs(completed["contact_work"].values) + completed["damping_loss"].values
    residual = np.abs(completed["energy_residual"].values)
    energy = np.divide(residual, turned_over, out=np.zeros_like(residual), where=turned_over > 0.0)
    if not np.all(energy < ENERGY_WITHIN):
        return f"energy balance open by {energy.max():.2g} of the work"
    violation = completed["worst_complementarity"].values
    if not np.all(violation < COMPLEMENTARITY_WITHIN):
        return f"contact conditions violated by {violation.max():.2g} of the gap"
    return ""


def closing(preset: str, results: Path) -> str:
    """How many variations of a preset have each outcome."""
    outcomes = read_table(results / f"{preset}.csv")["outcome"]
    several = ", ".join(f"{number} {outcome}" for outcome, number in outcomes.value_counts().items())
    return f"{counted(len(outcomes), 'variation')}: {several}"


closing_of_tradeoff, closing_of_stability = partial(closing, "tradeoff"), partial(closing, "stability")
