"""Interactions under tolerances: their ranges, and the numbers that these come from."""

from typing import Any

import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.rounding import rounded_to
from r37core.results.danger import danger_ranges
from r37core.results.table_file import read_table

from .tables import write_table

COLUMNS = {
    "peak (rad/s)": ("peak_speed_rad_s", 1.0, 0),
    "dangerous (rad/s)": ("length_dangerous_rad_s", 1.0, 0),
    "unknown (rad/s)": ("length_unknown_rad_s", 1.0, 0),
    "sustained (rad/s)": ("length_most_revolutions_rad_s", 1.0, 0),
    "largest stress (GPa)": ("largest_stress_pa", 1e-9, 1),
}
"""Column of the table, and that of tolerances.csv with its factor and digits."""

FARTHEST = "farthest dangerous or unknown, from the crossing (%)"
"""Column of the highest speed at which any member is not below yield inside the model."""

UNKNOWN = "-"


def ranges(input: Any, output: Any, params: Any) -> None:
    """Nominal value and range of an interaction of each blade, and how far from the crossing a member is dangerous or unknown.

    Inputs: table, members, campbell. Params: mode, order. Output: table.
    """
    table, members = read_table(input.table), read_dataset(input.members).squeeze("scene")
    crossings = read_dataset(input.campbell)["crossing_speed"].sel(mode=params.mode, engine_order=params.order)
    chosen = table[(table["mode"] == params.mode) & (table["engine_order"] == params.order)]
    rows = [
        [
            blade,
            *(ranged(row, *column) for column in COLUMNS.values()),
            farthest(members.sel(blade=blade), crossings.sel(blade=blade)),
        ]
        for blade, row in chosen.set_index("blade").iterrows()
    ]
    write_table(["blade", *COLUMNS, FARTHEST], rows, output.table)


def farthest(members: xr.Dataset, crossing: Any) -> str:
    """Highest speed at which any member is dangerous or unknown, in percent from a `crossing` (rad/s)."""
    runs = (members.sel(member=member) for member in members["member"])
    ends = [part.end for run in runs for ranges in danger_ranges(run) for part in ranges]
    return f"{100.0 * (max(ends) / float(crossing) - 1.0):+.1f}" if ends else UNKNOWN


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
