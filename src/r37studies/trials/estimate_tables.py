"""The table of the estimate: the cost of a whole run, projected from a sample of its sweep."""

from collections.abc import Mapping
from pathlib import Path

import pandas as pd
import xarray as xr

from r37core.plans.extent import SWEEP
from r37core.results.closing import counted
from r37core.results.table_file import read_table

_PARTS = {"time integration": ["cpu_s"], "files": ["file_cpu_s"]}
"""Part of the sweep -> costs of one of its simulations: with stress and statistic, and with its part of the response."""


def table(
    responses: Mapping[str, xr.Dataset], runs: Mapping[str, Mapping[str, tuple[float, float]]], jobs: float, fixed: float
) -> pd.DataFrame:
    """A row for each part and one of all: number of simulations, and core minutes.

    `responses`: of cases, with their costs as attributes; `runs`: of each part and case the number of simulations, and of how
    many of the case's own they have the length together; `jobs`, `fixed`: core seconds of a simulation's job, and of what has
    none. Raises ValueError for a refused case.
    """
    costs = pd.DataFrame([response.attrs for response in responses.values()], list(responses))
    for reason in costs["refused"].dropna() if "refused" in costs else ():
        raise ValueError(f"estimate: {reason}")
    numbers = {part: sum(number for number, _ in several.values()) for part, several in runs.items()}
    rows = [("jobs", numbers[SWEEP], jobs * numbers[SWEEP]), ("models, pictures", 0.0, fixed)]
    for part, several in runs.items():
        for name, kinds in _PARTS.items() if part == SWEEP else [(part, ["cpu_s", "file_cpu_s"])]:
            each = costs[kinds].sum(axis=1)
            rows.append((name, numbers[part], sum(each[case] * length for case, (_, length) in several.items())))
    rows.append(("total", sum(numbers.values()), sum(seconds for *_, seconds in rows)))
    return pd.DataFrame(
        {"part": part, "simulations": round(number), "core_min": seconds / 60.0} for part, number, seconds in rows
    )


def closing(results: Path) -> str:
    """How many simulations there are, and how long all takes."""
    total = read_table(results / "estimate.csv").set_index("part").loc["total"]
    return f"about {counted(int(total['simulations']), 'simulation')}, {total['core_min']:.3g} core minutes"
