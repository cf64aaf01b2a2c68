"""The table of the estimate: the cost of a whole sweep, projected from a sample of its runs."""

import os
import statistics
import subprocess
import sys
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.table_file import read_table

_IMPORTS = "import r37core.time_integration.speed_run, r37core.time_integration.speed_file"
"""Imports of the script of a simulation."""


def time_start_up() -> float:
    """CPU seconds of an interpreter that does the imports of a job and ends: the median of three."""
    spent = [_cpu_of_children()]
    for _ in range(3):
        subprocess.run([sys.executable, "-c", _IMPORTS], check=True)
        spent.append(_cpu_of_children())
    return statistics.median(after - before for before, after in pairwise(spent))


def _cpu_of_children() -> float:
    times = os.times()
    return times.children_user + times.children_system


def table(responses: Mapping[str, xr.Dataset], runs: Mapping[str, int], workflow_per_job: float, cores: int) -> pd.DataFrame:
    """A row for each part and one of all: core hours, core seconds of a simulation, simulations, and hours on `cores`.

    `responses`: of cases, with their costs as attributes; `runs`: number of simulations that each stands for. Raises ValueError
    for a refused case.
    """
    costs = pd.DataFrame([response.attrs for response in responses.values()], list(responses))
    for reason in costs["refused"].dropna() if "refused" in costs else ():
        raise ValueError(f"estimate: {reason}")
    number = pd.Series(runs)[costs.index]
    seconds = {
        # with everything that a job does after its imports
        "time integration": (number * costs[["cpu_s", "file_cpu_s", "reading_cpu_s"]].sum(axis=1)).sum(),
        "start-up": time_start_up() * number.sum(),
        "workflow": workflow_per_job * number.sum(),
        "reduction": (costs["recovery_cpu_s"] + number * costs["reduction_cpu_s"]).sum(),
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
