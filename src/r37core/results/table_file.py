"""The tables of a run (CSV): names stay texts, whatever a blade is called."""

from pathlib import Path

import pandas as pd
from pandas import DataFrame

from r37core.base.io import atomic_write, readable


def write_table(table: DataFrame, file: Path | str, digits: int | None = None) -> None:
    """Write a table without its index; numbers in full, or with so many digits."""
    with atomic_write(file) as partial:
        table.to_csv(partial, index=False, float_format=None if digits is None else f"%.{digits}g")


def read_table(file: Path | str) -> DataFrame:
    """A table that a rule wrote; an empty field is NaN. Raises InputFileError where it cannot be read.

    A blade may be called NA, inf or 1e5.
    """
    with readable(file):
        return pd.read_csv(file, dtype=dict.fromkeys(("blade", "scene", "mode"), str), keep_default_na=False, na_values=[""])
