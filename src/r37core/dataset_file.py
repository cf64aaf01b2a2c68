"""Datasets as netCDF4 files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from .io import FILE_ATTRIBUTES, atomic_write, readable

SPEED_RPM = {"units": "rpm", "long_name": "angular speed of the rotor in revolutions per minute"}
"""Of the coordinate `speed_rpm`, which stands beside `speed`."""


def about(units: str, long_name: str) -> dict[str, str]:
    """Attributes of a variable, after the CF conventions."""
    return {"units": units, "long_name": long_name}


def write_dataset(dataset: xr.Dataset, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write a dataset as netCDF4, atomically, with version and `provenance` as global attributes.

    Coordinates carry no fill value, as the CF conventions ask. Arrays carry checksums, so that reading finds a flipped bit.
    """
    dataset = dataset.assign_attrs(FILE_ATTRIBUTES | dict(provenance or {}))
    encoding: dict[str, dict[str, float | bool | None]] = {}
    for name, variable in dataset.variables.items():
        filled = name in dataset.data_vars and variable.dtype.kind == "f"
        encoding[str(name)] = {"_FillValue": np.nan if filled else None}
        if variable.ndim and variable.size and variable.dtype.kind in "fiu":
            encoding[str(name)]["fletcher32"] = True
    with atomic_write(file) as partial:
        dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)


def read_dataset(file: Path | str) -> xr.Dataset:
    """Read a netCDF file into memory; InputFileError when it cannot be read."""
    with readable(file), xr.open_dataset(file, engine="netcdf4") as dataset:
        return dataset.load()
