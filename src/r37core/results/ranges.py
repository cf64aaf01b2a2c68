"""The range of an interaction's numbers over the members of a sample: its columns, in a table of its own and in the summary."""

from pathlib import Path

import numpy as np
import pandas as pd

from r37core.base.io import readable
from r37core.base.rounding import rounded_to

from .table_file import read_table

ENDS = {"low": 0.05, "median": 0.5, "high": 0.95}
"""End of a column's name -> quantile of the members: nine tenths of them lie between the outer two."""

RANGED = ("peak_speed_rad_s", "width_above_yield_rad_s", "first_yield_speed_rad_s", "max_von_mises_pa")
"""Columns of summary.csv that have a range."""

RANGES = tuple(f"{name}_{end}" for name in RANGED for end in ENDS)

KEY = ["blade", "scene", "mode", "engine_order"]
_WITH_RANGES = [name for key in RANGED for name in (key, *(f"{key}_{end}" for end in ENDS))]
COLUMNS = [*KEY, "members", "share_of_members", "robust", *_WITH_RANGES]
"""Columns of the table: those without an end are of the nominal run."""


def read_ranges(file: Path | str) -> pd.DataFrame:
    """The table of ranges. Raises InputFileError where it cannot be read."""
    table = read_table(file)
    with readable(file):
        if list(table.columns) != COLUMNS:
            raise ValueError(f"its columns are not {', '.join(COLUMNS)}")
        kinds = {"engine_order": "Int64", "robust": bool, **dict.fromkeys(_WITH_RANGES, float)}
        # what no crossing explains has no mode
        return table.fillna({"mode": ""}).astype(kinds)


def as_ranges_bear(summary: pd.DataFrame) -> pd.DataFrame:
    """The summary with as many digits of what has a range as its width bears, but for the nominal peaks, which are runs."""
    table = summary.copy()
    for key in RANGED:
        columns = [name for name in (key, *(f"{key}_{end}" for end in ENDS)) if name in table and name != "peak_speed_rad_s"]
        if f"{key}_low" in columns:
            rows = table[f"{key}_low"].notna() & table[f"{key}_high"].notna()
            spread = table.loc[rows, f"{key}_high"] - table.loc[rows, f"{key}_low"]
            for name in columns:
                values = zip(table.loc[rows, name], spread, strict=True)
                table.loc[rows, name] = [float(rounded_to(value, width) or np.nan) for value, width in values]
    return table


def ranged_summary(summary: pd.DataFrame, table: pd.DataFrame) -> pd.DataFrame:
    """summary.csv with the share of members and the ranges of each interaction; empty for those without members."""
    beside = table[table["peak_speed_rad_s"].notna()][[*KEY, "peak_speed_rad_s", "share_of_members", "robust", *RANGES]]
    # an empty table has columns of no type
    summary = summary.astype({"peak_speed_rad_s": float, "engine_order": "Int64"})
    return summary.merge(beside, "left", [*KEY, "peak_speed_rad_s"])
