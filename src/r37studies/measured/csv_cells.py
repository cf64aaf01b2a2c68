"""Cells of a CSV file that a configuration or a call names."""

import io
from pathlib import Path

import pandas as pd

from r37core.base.io import TextFileError, read_text
from r37core.config.document import ConfigError
from r37core.config.messages import single_line


def read_cells(file: Path) -> pd.DataFrame:
    """Texts by the titles of the header, NaN where a field is empty; comma, semicolon or tab between them, # for comments.

    Raises ConfigError, without the file's name.
    """
    try:
        text = read_text(file)
        header = next((line for line in text.splitlines() if line.strip() and not line.startswith("#")), "")
        separator = max(",;\t", key=header.count)
        cells = pd.read_csv(io.StringIO(text), sep=separator, comment="#", dtype=str, skipinitialspace=True)
    except (OSError, TextFileError, ValueError) as error:
        # those of pandas are ValueErrors
        reason = single_line(getattr(error, "strerror", None) or str(error).strip())
        raise ConfigError(f"{reason}; allowed: a CSV with a header, and rows of as many cells") from None
    if not isinstance(cells.index, pd.RangeIndex):
        raise ConfigError("found rows with more cells than the header; allowed: as many, and decimal points")
    return cells.rename(columns=str.strip)
