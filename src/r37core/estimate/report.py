"""What a whole sweep will cost, projected from a sample of its runs."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr

from ..checks import ran
from ..tables import markdown_table

_IMPORTS = "import r37core.time_integration.speed_run, r37core.time_integration.speed_file"
"""What the script of a simulation imports."""


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, str]:
    """The projection from the cases' costs, as JSON and as a table."""
    samples = [sample_of(ran(response, name), values["runs"][name]) for name, response in responses.items()]
    estimate = project_costs(samples, time_start_up(), values["workflow_s_per_job"], values["cores"])
    return {"json": json.dumps(estimate, indent=1) + "\n", "table": describe(estimate, values["fidelity"])}


def sample_of(response: xr.Dataset, number: int) -> dict[str, float]:
    """CPU seconds that `number` runs of a blade and scene take, projected from those of a case.

    `time integration`: everything a job does after its imports; `reduction`: of all runs to one file, and `runs`.
    """
    share = number / response.sizes["speed"]
    costs = response.attrs
    per_run = float((response["cpu_s"] + response["file_cpu_s"]).sum()) + response.sizes["speed"] * costs["reading_cpu_s"]
    reduction = costs["recovery_cpu_s"] + share * costs["reduction_cpu_s"]
    return {"time integration": share * per_run, "reduction": reduction, "runs": number}


def time_start_up() -> float:
    """CPU seconds of an interpreter that does the imports of a job and ends: the median of seven."""
    spent = []
    for _ in range(7):
        before = os.times()
        subprocess.run([sys.executable, "-c", _IMPORTS], check=True)
        after = os.times()
        spent.append(after.children_user + after.children_system - before.children_user - before.children_system)
    return statistics.median(spent)


def project_costs(
    samples: Sequence[Mapping[str, float]], start_up: float, workflow_per_job: float, cores: int
) -> dict[str, float]:
    """Core seconds of each part, their sum, and the wall seconds on so many cores when all are kept busy."""
    runs = sum(sample["runs"] for sample in samples)
    parts = {
        "time integration": sum(sample["time integration"] for sample in samples),
        "start-up": start_up * runs,
        "workflow": workflow_per_job * runs,
        "reduction": sum(sample["reduction"] for sample in samples),
    }
    total = sum(parts.values())
    return parts | {"runs": runs, "total": total, "cores": cores, "wall": total / cores}


def describe(estimate: Mapping[str, float], fidelity: str) -> str:
    """The projection as a table in Markdown."""
    runs = estimate["runs"]
    head = f"Level `{fidelity}`: {runs:.0f} simulations, {estimate['wall'] / 3600:.2f} h on {estimate['cores']:.0f} cores."
    parts = ("time integration", "start-up", "workflow", "reduction", "total")
    rows = [[part, f"{estimate[part] / 3600:.2f}", f"{estimate[part] / runs:.3f}"] for part in parts]
    return f"{head}\n\n{markdown_table(['part', 'core hours', 'core seconds per simulation'], rows)}"
