"""A search for a better blade: its start and its best design."""

from typing import Any

import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.search.problem import START

from .pages import write_table


def best(input: Any, output: Any, params: Any) -> None:
    """Start and best design of a search, and how many designs keep all constraints. Input: search. Output: table."""
    search = read_dataset(input.search)
    tried = search.sel(design=search["design"] != START)
    feasible = int(tried["feasible"].sum())
    rows = [_row("start", search, START)]
    if feasible:
        rows.append(_row(f"best of {feasible} of {tried.sizes['design']} designs", search, best_of(search)))
    head = ["design", "lining (rad/s)", "bare casing (rad/s)", "stress of rotation (%)", "mass (%)", "1B (%)"]
    write_table(head, rows, output.table)


def best_of(search: xr.Dataset) -> str:
    """Name of the best design that keeps all constraints."""
    return str(search["design"].values[search["order"].values == 1][0])


def _row(words: str, search: xr.Dataset, design: str) -> list[str]:
    """Integrals over speed in both scenes, and other numbers in percent of the start's."""
    chosen = search.sel(design=design)
    integrals = (chosen["objective_value"].sel(objective="lined"), chosen["constraint_value"].sel(constraint="bare"))
    shares = 100.0 * chosen["constraint_value"] / search["constraint_value"].sel(design=START)
    relative = (shares.sel(constraint=name) for name in ("static", "mass", "first_bending"))
    return [words, *(f"{float(value):.0f}" for value in integrals), *(f"{float(share):.1f}" for share in relative)]
