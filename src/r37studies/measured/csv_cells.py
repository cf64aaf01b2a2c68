"""Cells of a CSV file that a configuration or a call names."""

from pathlib import Path

import numpy as np
import pandas as pd

from r37core.base.io import TextFileError, read_text
from r37core.base.table_text import table_rows
from r37core.base.units import LENGTH_UNITS
from r37core.config.document import ConfigError
from r37core.config.messages import single_line

LENGTHS = LENGTH_UNITS | dict.fromkeys(("mil", "mils", "thou"), 2.54e-5) | {"micron": 1e-6, "microns": 1e-6, "inch": 0.0254}
"""Units of length in files of tests -> m."""


def read_cells(file: Path) -> pd.DataFrame:
    """Texts by the titles of the header, NaN where a field is empty; comma, semicolon or tab between them, # for comments.

    Raises ConfigError, without the file's name.
    """
    try:
        rows = [cells for _, cells in table_rows(read_text(file))]
    except (OSError, TextFileError) as error:
        reason = single_line(getattr(error, "strerror", None) or str(error).strip())
        raise ConfigError(f"{reason}; allowed: a CSV with a header, and rows of as many cells") from None
    if not rows:
        raise ConfigError("found no header; allowed: a CSV with a header, and rows of as many cells")
    # spreadsheets end each line with separators of empty columns
    header, rows = rows[0], [row[: len(rows[0])] if not any(row[len(rows[0]) :]) else row for row in rows[1:]]
    if any(len(row) > len(header) for row in rows):
        raise ConfigError("found rows with more cells than the header; allowed: as many, and decimal points")
    if twice := [title for title in header if title and header.count(title) > 1]:
        raise ConfigError(f"found the column '{twice[0]}' twice; allowed: each title once")
    padded = [row + [""] * (len(header) - len(row)) for row in rows]
    cells = pd.DataFrame(padded, columns=header, dtype=str).replace("", np.nan)
    return cells.loc[:, [bool(title) for title in header]]
