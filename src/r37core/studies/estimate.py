"""What a whole sweep will cost, projected from a sample of its runs."""

from __future__ import annotations

import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np

from r37core.fem.material import Material
from r37core.results.response import write_response
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.reduced_model import ReducedModel
from r37core.time_integration.speed_file import write_speed

PARTS = ("time integration", "start-up", "workflow", "reduction")


def time_runs(
    run: Callable[[float], Mapping[str, np.ndarray]],
    speeds: Sequence[float],
    number: int,
    model: ReducedModel | None,
    material: Material | None,
    stress_instants: int,
) -> dict[str, float]:
    """CPU seconds that `number` runs of a blade and scene take, projected from runs at `speeds`.

    `run(speed)`: the arrays of one run, everything a job does after its imports but writing. `model` and
    `material`: for the stress, None when it is not wanted. Returns `time integration`, `reduction` and `runs`.
    """
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{row}.npz" for row in range(len(speeds))]
        start = time.process_time()
        for speed, file in zip(speeds, files, strict=True):
            write_speed(run(speed), file, {})
        simulation = time.process_time() - start
        start = time.process_time()
        recovery = StressRecovery(model, material) if model and material else None
        fixed = time.process_time() - start
        write_response(
            files,
            speeds,
            Path(folder) / "response.nc",
            recovery,
            stress_history_speeds=(),
            stress_instants=stress_instants,
            yield_stress=material.yield_stress if material else math.inf,
            provenance={},
        )
        reduction = time.process_time() - start - fixed
    share = number / len(speeds)
    return {"time integration": share * simulation, "reduction": fixed + share * reduction, "runs": number}


def time_start_up(imports: str, rounds: int = 7) -> float:
    """CPU seconds of an interpreter that does the imports of a job and ends: the median of some rounds."""
    spent = []
    for _ in range(rounds):
        before = os.times()
        subprocess.run([sys.executable, "-c", imports], check=True)
        after = os.times()
        used = after.children_user + after.children_system - before.children_user - before.children_system
        spent.append(used)
    return statistics.median(spent)


def project_costs(
    samples: Sequence[Mapping[str, float]], start_up: float, workflow_per_job: float, cores: int
) -> dict[str, float]:
    """Core seconds of each part, their sum, and the wall seconds on so many cores when all are kept busy."""
    runs = sum(one["runs"] for one in samples)
    parts = {
        "time integration": sum(one["time integration"] for one in samples),
        "start-up": start_up * runs,
        "workflow": workflow_per_job * runs,
        "reduction": sum(one["reduction"] for one in samples),
    }
    total = sum(parts.values())
    return parts | {"runs": runs, "total": total, "cores": cores, "wall": total / cores}


def describe(estimate: Mapping[str, float], fidelity: str) -> str:
    """The projection as a table in Markdown."""
    runs = estimate["runs"]
    lines = [
        f"Level `{fidelity}`: {runs:.0f} simulations, {estimate['wall'] / 3600:.2f} h on {estimate['cores']:.0f} cores.",
        "",
        "| part | core hours | core seconds per simulation |",
        "|---|---|---|",
    ]
    for part in (*PARTS, "total"):
        lines.append(f"| {part} | {estimate[part] / 3600:.2f} | {estimate[part] / runs:.3f} |")
    return "\n".join(lines) + "\n"
