"""What happens at extremes: every case is a real run, judged against itself with half the step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.status import RunStatus

from .case import MOTION, Case, run_case

ACCURATE, DEGRADED, DIVERGED, REFUSED = "accurate", "degraded", "diverged", "refused"
"""Outcomes. Accurate: half the step gives the same mean rms within ACCURATE_WITHIN; degraded: it does not; diverged: the run
says so itself, and the half step tells whether it is the model or the step; refused: with a reason, before anything ran."""

ACCURATE_WITHIN = 0.05
ENERGY_WITHIN = 1e-6
COMPLEMENTARITY_WITHIN = 1e-8


def judge(model: ContactModel, scene: Scene, choice: IntegrationChoice, speed: float) -> dict[str, Any]:
    """Run three speeds within 0.3% of `speed` (rad/s), then with half the step. Returns outcome, detail and numbers.

    Raises AssertionError for a wrong number that nothing flags: not finite, open energy balance, violated contact conditions.
    """
    speeds = speed * np.array([0.997, 1.0, 1.003])
    try:
        case = run_case(model, scene, choice, speeds)
    except ValueError as error:
        return {"outcome": REFUSED, "detail": str(error).split(";")[0]}
    half = run_case(model, scene, replace(choice, time_step=0.5 * choice.time_step), speeds)
    for one in (case, half):
        _check_sound(one)
    numbers = {
        "rms": _motion(case),
        "contact": float(case.values["share_of_time_in_contact"].mean()),
        "energy_residual": float(np.abs(case.values["energy_residual"]).max()),
        "cpu_s": case.costs["cpu_s"],
    }
    if case.values["status"].any():
        also = "so does half the step" if half.values["status"].any() else "half the step does not"
        return numbers | {"outcome": DIVERGED, "detail": f"{also}; recorded as diverged"}
    mine, theirs = numbers["rms"], _motion(half)
    if half.values["status"].any():
        return numbers | {"outcome": DEGRADED, "detail": "half the step diverges"}
    if theirs == 0.0 and mine == 0.0:
        return numbers | {"outcome": ACCURATE, "detail": "nothing touches"}
    change = abs(mine - theirs) / theirs
    outcome = ACCURATE if change < ACCURATE_WITHIN else DEGRADED
    return numbers | {"outcome": outcome, "detail": f"mean rms changes by {100 * change:.2g}% with half the step"}


def _motion(case: Case) -> float:
    """Mean over the speeds of the rms (m) of the leading edge's normal and tangential motion together."""
    return float(np.hypot(case.values["rms_normal"], case.values["rms_tangential"]).mean())


def _check_sound(case: Case) -> None:
    """AssertionError unless every run either diverged and says so, or has finite, balanced numbers."""
    completed = case.values["status"] == RunStatus.COMPLETED
    for name in MOTION:
        assert np.all(np.isfinite(case.values[name][completed])), f"{name} is not finite in a run that counts as completed"
    energy = np.abs(case.values["energy_residual"][completed])
    assert np.all(energy < ENERGY_WITHIN), f"energy balance open by {energy.max():.2g} of the work"
    violation = case.values["worst_complementarity"][completed]
    assert np.all(violation < COMPLEMENTARITY_WITHIN), f"contact conditions violated by {violation.max():.2g} of the gap"


def stability_table(rows: Sequence[Mapping[str, Any]]) -> str:
    """The outcomes as Markdown: how many of each, then every case."""
    counts = {outcome: sum(row["outcome"] == outcome for row in rows) for outcome in (ACCURATE, DEGRADED, DIVERGED, REFUSED)}
    lines = [", ".join(f"{number} {outcome}" for outcome, number in counts.items()) + f", of {len(rows)} cases.", ""]
    lines += ["| what | value | scene | outcome | how it shows | rms (mm) | in contact |", "|---|---|---|---|---|---|---|"]
    for row in rows:
        rms = f"{1e3 * row['rms']:.3g}" if np.isfinite(row.get("rms", np.nan)) else ""
        contact = f"{100 * row['contact']:.0f}%" if "contact" in row else ""
        cells = [row["what"], row["value"], row["scene"], row["outcome"], row["detail"], rms, contact]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
