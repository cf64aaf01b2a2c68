"""A search for a better blade: its start, its best designs and what its objectives depend on."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.dataset_file import read_dataset
from r37core.results.exceedance import exceedance_of
from r37core.search.problem import START

from .pages import write_table
from .which_blade import length_text

BEST = 4
OBJECTIVES = {"lined": ("material_abradable", "lining"), "direct": ("direct", "bare casing")}


def designs(input: Any, output: Any, params: Any) -> None:
    """The start and the best designs, and what they vary. Input: search. Output: best, variables, all."""
    search = read_dataset(input.search)
    keys = [str(key) for key in search["variable"].values]
    names, folder = best_of(search), Path(input.search).parent
    head = ["design", *(f"{words}{what}" for _, words in OBJECTIVES.values() for what in (" (rad/s)", ": integral (rad/s)"))]
    rows = [_measures(search, name, folder) for name in names]
    write_table([*head, "1B (Hz)", "static stress (MPa)"], rows, output.best)
    write_table(["design", *keys], [[named(search, name), *_values(search, name)] for name in names], output.variables)
    everything = [
        [str(name), *_values(search, name), *_objectives(search, name), "yes" if search["feasible"].sel(design=name) else "no"]
        for name in search["design"].values
    ]
    write_table(["design", *keys, *search["objective"].values, "keeps the constraints"], everything, output.all)


def best_of(search: xr.Dataset) -> list[str]:
    """Names of the start and of the best designs, in order."""
    order = search["order"].values
    places = np.argsort(np.where(order > 0, order, len(order) + 1), kind="stable")[: min(BEST, np.count_nonzero(order))]
    return [START, *(str(name) for name in search["design"].values[places])]


def named(search: xr.Dataset, name: str) -> str:
    """The design as the product writes it into its entries."""
    return "Free" if name == START else f"Free_best{int(search['order'].sel(design=name))}"


def _values(search: xr.Dataset, name: str) -> list[str]:
    return [f"{float(value):.3g}" for value in search["value"].sel(design=name)]


def _objectives(search: xr.Dataset, name: str) -> list[str]:
    of = search.sel(design=name)
    pairs = zip(of["objective_value"].values, of["objective_scatter"].values, strict=True)
    return ["" if np.isnan(value) else length_text(value, scatter) for value, scatter in pairs]


def _measures(search: xr.Dataset, name: str, folder: Path) -> list[str]:
    cells = [named(search, name)]
    of_design = folder / "search" / name / "Free"
    for text, (scene, _) in zip(_objectives(search, name), OBJECTIVES.values(), strict=True):
        cells += [text, f"{integral(read_dataset(of_design / scene / 'response.nc')):.0f}"]
    first_bending, static = search["constraint_value"].sel(design=name).values
    return [*cells, f"{first_bending:.0f}", f"{1e-6 * static:.0f}"]


def integral(response: xr.Dataset) -> float:
    """Share of the revolutions above yield, integrated over speed (rad/s)."""
    exceedance = exceedance_of(response)
    return float(np.trapezoid(exceedance.shares, exceedance.speeds))


def depends(input: Any, output: Any, params: Any) -> None:
    """Total index of each variable for each objective, and how well the surrogate predicts. Input: search."""
    search = read_dataset(input.search)
    rows = []
    for objective, (_, words) in OBJECTIVES.items():
        of = search.sel(objective=objective)
        indices = [f"{float(index):.2f}" for index in of["sensitivity_total"]]
        rows.append([words, *indices, f"{float(of['surrogate_q2']):.2f}"])
    write_table(["objective", *(str(key) for key in search["variable"].values), "predicted share"], rows, output.table)
