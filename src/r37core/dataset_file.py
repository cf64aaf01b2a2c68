"""Datasets as netCDF4 files."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from pathlib import Path

import netCDF4
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


def hash_of_parts(files: Iterable[Path | str]) -> str:
    """Input hash of a file that joins others: of what each of them, in any order, says of its making.

    Raises InputFileError for a file that cannot be read.
    """
    said = []
    for file in files:
        with readable(file), netCDF4.Dataset(file) as dataset:
            names = sorted(set(dataset.ncattrs()) - set(FILE_ATTRIBUTES))
            said.append([(name, str(dataset.getncattr(name))) for name in names])
    return hashlib.sha256(repr(sorted(said)).encode()).hexdigest()[:16]
