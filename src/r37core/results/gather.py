"""Joining the datasets of single blades."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import pandas as pd
import xarray as xr

from r37core.dataset_file import read_dataset


def gather_blades(blades: Sequence[str], files: Iterable[Path | str]) -> xr.Dataset:
    """One dataset with the dimension `blade` from one file per blade; the files' coordinates must agree."""
    datasets = [read_dataset(file).drop_attrs(deep=False) for file in files]
    return xr.concat(datasets, pd.Index(blades, name="blade"), join="exact", combine_attrs="override")
