"""What a run says of its search when it ends."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from r37core.dataset_file import read_dataset
from r37core.results.closing import counted
from r37core.rounding import rounded_to
from r37core.units import shown_unit

from .plan import BEST, DATASET


def closing(results: Path) -> str:
    """How many designs there are, how many keep the constraints, and what the best one has in place of the start's."""
    search = read_dataset(results / DATASET.removeprefix("<results>/"))
    start, designs = search.isel(design=0), search.isel(design=slice(1, None))
    text = f"{counted(designs.sizes['design'], 'design')}, {int(designs['feasible'].sum())} of them keep all constraints"
    best = designs.isel(design=designs["order"].values == 1)
    if not best.sizes["design"]:
        return text
    (name,) = best["design"].values
    numbers = ", ".join(_against(best.isel(design=0), start, objective) for objective in search["objective"].values)
    return f"{text}; the best, {name}: {numbers}; entries and STEP files in {results / BEST.removeprefix('<results>/')}"


def _against(best: xr.Dataset, start: xr.Dataset, objective: str) -> str:
    """An objective of two designs, with the digits that the scatter of both bears."""
    unit, factor = shown_unit(best["objective_unit"].sel(objective=objective).item())
    values, scatters = (
        [factor * float(design[f"objective_{kind}"].sel(objective=objective)) for design in (best, start)]
        for kind in ("value", "scatter")
    )
    here, there = (rounded_to(value, 2.0 * max(scatters)) for value in values)
    return f"{objective} {here}{f' {unit}' if unit else ''} (the start {there})"
