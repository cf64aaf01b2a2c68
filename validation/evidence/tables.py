"""Tables of the evidence: CSV files whose cells are as a reader sees them."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

import xarray as xr

from r37core.base.io import atomic_write
from r37core.results.danger import ranges_of
from r37core.results.exceedance import length_of


def write_table(head: Sequence[str], rows: Iterable[Sequence[str]], file: Path | str) -> None:
    """Write a table as CSV, its cells as a reader sees them."""
    with atomic_write(file) as new, open(new, "w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows([head, *rows])


def read_table(file: Path | str) -> list[list[str]]:
    """Rows of a table, the head first."""
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.reader(stream))


def danger_cell(response: xr.Dataset) -> str:
    """Lengths (rad/s) of dangerous, unknown and sustained speeds of a response, as a cell."""
    return " / ".join(f"{length_of(parts):.0f}" for parts in ranges_of(response).values())
