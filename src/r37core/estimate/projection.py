"""What a whole sweep will cost, projected from a sample of its runs."""

import os
import statistics
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.table_file import read_table

_IMPORTS = "import r37core.time_integration.speed_run, r37core.time_integration.speed_file"
"""What the script of a simulation imports."""


def sample_of(response: xr.Dataset, number: int) -> dict[str, float]:
    """CPU seconds that `number` runs of a blade and scene take, projected from those of a case.

    `time integration`: everything a job does after its imports; `reduction`: of all runs to one file, and `runs`. Raises
    ValueError for a case that was refused.
    """
    if "refused" in response.attrs:
        raise ValueError(f"estimate: {response.attrs['refused']}")
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


def projected_costs(
    samples: Sequence[Mapping[str, float]], start_up: float, workflow_per_job: float, cores: int
) -> pd.DataFrame:
    """A row for each part and one of all: core hours, core seconds of a simulation, simulations, and hours on `cores`."""
    runs = sum(sample["runs"] for sample in samples)
    seconds = {
        "time integration": sum(sample["time integration"] for sample in samples),
        "start-up": start_up * runs,
        "workflow": workflow_per_job * runs,
        "reduction": sum(sample["reduction"] for sample in samples),
    }
    seconds["total"] = sum(seconds.values())
    return pd.DataFrame(
        {
            "part": part,
            "core_hours": spent / 3600.0,
            "core_s_per_simulation": spent / runs,
            "simulations": int(runs),
            "cores": cores,
            "wall_hours": spent / 3600.0 / cores,
        }
        for part, spent in seconds.items()
    )


def closing(results: Path) -> str:
    """How many simulations there are, and how long they take."""
    total = read_table(results / "estimate.csv").set_index("part").loc["total"]
    length = f"{total['wall_hours']:.2f} h on {counted(int(total['cores']), 'core')}"
    return f"{counted(int(total['simulations']), 'simulation')} at most, {length}"
