"""The table of the estimate: the cost of a whole sweep, projected from a sample of its runs."""

import os
import statistics
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.table_file import read_table

from .case_table import case_table


def tables(responses: Mapping[str, xr.Dataset], **values: Any) -> dict[str, pd.DataFrame]:
    """The projected cost; `values` as of estimate.values."""
    return {"table": projected_costs(case_table(responses, numbers), start_up=time_start_up(), **values)}


_IMPORTS = "import r37core.time_integration.speed_run, r37core.time_integration.speed_file"
"""Imports of the script of a simulation."""


def numbers(response: xr.Dataset) -> dict[str, float]:
    """CPU seconds of a run of a case, with everything a job does after its imports, and of its share of the reduction."""
    runs, costs = response.sizes["speed"], response.attrs
    own = float((response["cpu_s"] + response["file_cpu_s"]).sum()) / runs
    return {"run_cpu_s": own + costs["reading_cpu_s"], "run_reduction_cpu_s": costs["reduction_cpu_s"] / runs}


def time_start_up() -> float:
    """CPU seconds of an interpreter that does the imports of a job and ends: the median of three."""
    spent = []
    for _ in range(3):
        before = os.times()
        subprocess.run([sys.executable, "-c", _IMPORTS], check=True)
        after = os.times()
        spent.append(after.children_user + after.children_system - before.children_user - before.children_system)
    return statistics.median(spent)


def projected_costs(
    cases: pd.DataFrame, runs: Mapping[str, int], start_up: float, workflow_per_job: float, cores: int
) -> pd.DataFrame:
    """A row for each part and one of all: core hours, core seconds of a simulation, simulations, and hours on `cores`.

    `cases`: the table of cases; `runs`: number of simulations that each stands for. Raises ValueError for a refused case.
    """
    for reason in filter(None, cases["refused"]):
        raise ValueError(f"estimate: {reason}")
    number = pd.Series(runs)[cases.index]
    seconds = {
        "time integration": (number * cases["run_cpu_s"]).sum(),
        "start-up": start_up * number.sum(),
        "workflow": workflow_per_job * number.sum(),
        "reduction": (cases["recovery_cpu_s"] + number * cases["run_reduction_cpu_s"]).sum(),
    }
    seconds["total"] = sum(seconds.values())
    return pd.DataFrame(
        {
            "part": part,
            "core_hours": spent / 3600.0,
            "core_s_per_simulation": spent / number.sum(),
            "simulations": number.sum(),
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
