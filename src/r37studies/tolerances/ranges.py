"""The range of an interaction's numbers over the members of a sample: its columns, in a table of its own and in the summary."""

from pathlib import Path

import pandas as pd

from r37core.base.io import readable
from r37core.results.columns import INTERACTIONS, Column, names
from r37core.results.table_file import read_table

_WITH_RANGE = ("peak_speed_rad_s", "length_dangerous_rad_s", "length_most_revolutions_rad_s", "largest_stress_inside_pa")
RANGED = tuple(column for name in _WITH_RANGE for column in INTERACTIONS if column.name == name)
"""Columns of summary.csv to which a range over the members is added."""

MEMBERS_SHOWING = (
    Column("share_of_members", "share of the members that show the interaction"),
    Column("robust", "whether at least half of the members show it"),
)
"""Columns that are added to summary.csv, before the ranges of RANGED."""

KEY = ["blade", "scene", "mode", "engine_order"]
_WITH_RANGES = [name for column in RANGED for name in (column.name, *column.range_names)]
COLUMNS = [*KEY, "members", *names(MEMBERS_SHOWING), *_WITH_RANGES]
"""Columns of the table: those without an end are of the nominal run."""


def ranged_summary(summary: pd.DataFrame, file: Path | str) -> pd.DataFrame:
    """summary.csv with the share of members and the ranges in the file of each interaction; empty for those without members.

    Raises InputFileError where the file, of the columns COLUMNS, cannot be read.
    """
    table = read_table(file)
    with readable(file):
        kinds = {"engine_order": "Int64", "robust": bool, **dict.fromkeys(_WITH_RANGES, float)}
        # what no crossing explains has no mode
        table = table[COLUMNS].fillna({"mode": ""}).astype(kinds)
    # an empty table has columns of no type
    summary = summary.astype({"peak_speed_rad_s": float, "engine_order": "Int64"})
    nominal = table[table["peak_speed_rad_s"].notna()].drop(columns=["members", *_WITH_RANGE[1:]])
    return summary.merge(nominal, "left", [*KEY, "peak_speed_rad_s"])
