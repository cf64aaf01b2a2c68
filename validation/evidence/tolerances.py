"""Interactions under tolerances: their ranges, and the numbers that these come from."""

from typing import Any

import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.rounding import rounded_to
from r37core.results.table_file import read_table

from .tables import write_table

COLUMNS = {
    "peak (rad/s)": ("peak_speed_rad_s", 1.0, 0),
    "above yield in most revolutions (rad/s)": ("length_most_revolutions_rad_s", 1.0, 0),
    "largest stress (GPa)": ("largest_stress_pa", 1e-9, 1),
}
"""Column of the table, and that of tolerances.csv with its factor and digits."""

UNKNOWN = "-"


def ranges(input: Any, output: Any, params: Any) -> None:
    """Nominal value and range of an interaction of each blade. Input: table. Params: mode, order. Output: table."""
    table = read_table(input.table)
    chosen = table[(table["mode"] == params.mode) & (table["engine_order"] == params.order)]
    rows = [[row["blade"], *(ranged(row, *column) for column in COLUMNS.values())] for _, row in chosen.iterrows()]
    write_table(["blade", *COLUMNS], rows, output.table)


def ranged(row: pd.Series, name: str, factor: float, digits: int) -> str:
    """Nominal value times a factor and, in brackets, both ends of its range."""
    return "{} ({} to {})".format(*(f"{factor * row[f'{name}{end}']:.{digits}f}" for end in ("", "_low", "_high")))


def numbers(input: Any, output: Any, params: Any) -> None:
    """Rank coefficient of each number for each measure and blade. Input: members. Output: table."""
    members = read_dataset(input.members).squeeze("scene")
    columns = {
        f"{blade}: {str(measure).replace('_', ' ')}": members.sel(blade=blade, measure=measure)
        for blade in members["blade"].values
        for measure in members["measure"].values
    }
    rows = [
        [f"`{number}`", *(coefficient(column.sel(number=number)) for column in columns.values())]
        for number in members["number"].values
    ]
    rows.append(
        ["explained by all together", *(f"{100.0 * float(column['rank_explained']):.0f}%" for column in columns.values())]
    )
    write_table(["number", *columns], rows, output.table)


def coefficient(column: xr.Dataset) -> str:
    """A number's coefficient and, in brackets, its interval; a dash where that holds zero."""
    value, low, high = (float(column[f"rank_coefficient{end}"]) for end in ("", "_low", "_high"))
    if not low * high > 0.0:
        return UNKNOWN
    return "{} ({} to {})".format(*(rounded_to(each, high - low) for each in (value, low, high)))
