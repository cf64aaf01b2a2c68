"""What happens at extremes: every case is a real run, judged against itself with half the step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from r37core.results.measures import leading_edge, motion
from r37core.time_integration.status import RunStatus

from ..checks import energy_share
from ..tables import markdown_table
from .cases import HALF

ACCURATE, DEGRADED, DIVERGED, REFUSED = "accurate", "degraded", "diverged", "refused"
"""Outcomes. Accurate: half the step gives the same mean rms within ACCURATE_WITHIN; degraded: it does not; diverged: the run
says so itself, and the half step tells whether it is the model or the step; refused: with a reason, before anything ran."""

ACCURATE_WITHIN = 0.05
ENERGY_WITHIN = 1e-6
COMPLEMENTARITY_WITHIN = 1e-8
_FINITE = ("rms_normal", "rms_tangential", "peak_normal")


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, str]:
    """The outcome of every extreme."""
    rows = [words | judge(responses[name], responses[f"{name}{HALF}"]) for name, words in values.items()]
    return {"table": stability_table(rows)}


def judge(case: xr.Dataset, half: xr.Dataset) -> dict[str, Any]:
    """Outcome, detail and numbers of a case, from its response and that with half the step.

    Raises AssertionError for a wrong number that nothing flags: not finite, open energy balance, violated contact conditions.
    """
    if "refused" in case.attrs:
        return {"outcome": REFUSED, "detail": case.attrs["refused"]}
    _check_sound(case)
    numbers = {
        "rms": _mean_motion(case),
        "contact": float(case["share_of_time_in_contact"].mean()),
        "step": float(case["time_step"].mean()),
    }
    if "refused" in half.attrs:
        return numbers | {"outcome": DEGRADED, "detail": f"half the step is refused: {half.attrs['refused']}"}
    _check_sound(half)
    if case["status"].any():
        also = "so does half the step" if half["status"].any() else "half the step does not"
        return numbers | {"outcome": DIVERGED, "detail": f"{also}; recorded as diverged"}
    mine, theirs = numbers["rms"], _mean_motion(half)
    if half["status"].any():
        return numbers | {"outcome": DEGRADED, "detail": "half the step diverges"}
    if theirs == 0.0 and mine == 0.0:
        return numbers | {"outcome": ACCURATE, "detail": "nothing touches"}
    change = abs(mine - theirs) / theirs
    outcome = ACCURATE if change < ACCURATE_WITHIN else DEGRADED
    return numbers | {"outcome": outcome, "detail": f"mean rms changes by {100 * change:.2g}% with half the step"}


def _mean_motion(response: xr.Dataset) -> float:
    """Mean over the speeds of the rms (m) of the leading edge's normal and tangential motion together; NaN if one diverged."""
    return np.nan if response["status"].any() else float(motion(response).mean())


def _check_sound(response: xr.Dataset) -> None:
    """AssertionError unless every run either diverged and says so, or has finite, balanced numbers."""
    completed = response["status"].values == RunStatus.COMPLETED
    edge = leading_edge(response)
    for name in _FINITE:
        assert np.all(np.isfinite(edge[name].values[completed])), f"{name} is not finite in a run that counts as completed"
    energy = np.abs(energy_share(response)[completed])
    assert np.all(energy < ENERGY_WITHIN), f"energy balance open by {energy.max():.2g} of the work"
    violation = response["worst_complementarity"].values[completed]
    assert np.all(violation < COMPLEMENTARITY_WITHIN), f"contact conditions violated by {violation.max():.2g} of the gap"


def stability_table(rows: Sequence[Mapping[str, Any]]) -> str:
    """The outcomes as Markdown: how many of each, then every case."""
    counts = {outcome: sum(row["outcome"] == outcome for row in rows) for outcome in (ACCURATE, DEGRADED, DIVERGED, REFUSED)}
    counted = ", ".join(f"{number} {outcome}" for outcome, number in counts.items()) + f", of {len(rows)} cases."
    head, lines = ["what", "value", "scene", "step (s)", "outcome", "how it shows", "rms (mm)", "in contact"], []
    for row in rows:
        step = f"{row['step']:.3g}" if "step" in row else ""
        rms = f"{1e3 * row['rms']:.3g}" if np.isfinite(row.get("rms", np.nan)) else ""
        contact = f"{100 * row['contact']:.0f}%" if "contact" in row else ""
        lines.append([row["what"], row["value"], row["scene"], step, row["outcome"], row["detail"], rms, contact])
    return f"{counted}\n\n{markdown_table(head, lines)}"
