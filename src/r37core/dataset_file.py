"""Datasets as netCDF4 files."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from .io import FILE_ATTRIBUTES, atomic_write
from .netcdf_access import NETCDF_LOCK, open_dataset, open_netcdf
from .units import RPM


@dataclass(frozen=True)
class Variable:
    """Variable of a dataset's table: `dims` beyond those that a file adds to all, meaning, `dtype` as stored."""

    dims: tuple[str, ...]
    units: str
    long_name: str
    dtype: str = "f8"

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the variable in a file."""
        return about(self.units, self.long_name)


def about(units: str, long_name: str) -> dict[str, str]:
    """Attributes of a variable, after the CF conventions."""
    return {"units": units, "long_name": long_name}


SPEED = Variable(("speed",), "rad s-1", "angular speed of the rotor")
SPEED_RPM = Variable(("speed",), "rpm", "angular speed of the rotor in revolutions per minute")
"""Description of the coordinate `speed_rpm`, which stands next to `speed`."""


def dataset_of(
    variables: Mapping[str, Variable],
    values: Mapping[str, Any],
    coordinates: Mapping[str, Variable],
    labels: Mapping[str, Any],
    along: Sequence[str] = (),
) -> xr.Dataset:
    """The dataset of the `values`, by name, that tables of variables and coordinates describe; speeds are there in rpm, too.

    `labels`: of dimensions that are counted by names; `along`: dimensions of all variables, before their own.
    """

    def described(table: Mapping[str, Variable], first: Sequence[str]) -> dict[str, Any]:
        return {
            name: ((*first, *entry.dims), np.asarray(values[name], entry.dtype), entry.attributes)
            for name, entry in table.items()
            if name in values
        }

    speed_rpm = SPEED_RPM.dims, RPM * np.asarray(values["speed"]), SPEED_RPM.attributes
    speeds = described({"speed": coordinates["speed"]}, ()) | {"speed_rpm": speed_rpm}
    return xr.Dataset(described(variables, along), {**labels, **speeds, **described(coordinates, ())})


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
    with NETCDF_LOCK, atomic_write(file) as partial:
        dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)


def read_dataset(file: Path | str, part: Mapping[str, object] | None = None) -> xr.Dataset:
    """Read a netCDF file into memory; InputFileError when it cannot be read.

    `part`: labels of dimensions, as far as the file has these, at which alone it is read.
    """
    with open_dataset(file) as dataset:
        return dataset.sel({name: label for name, label in (part or {}).items() if name in dataset.dims}).load()


def hash_of_parts(files: Iterable[Path | str]) -> str:
    """Input hash of a file that joins others: of what each of them, in any order, says of its making.

    Raises InputFileError for a file that cannot be read.
    """
    attributes = []
    for file in files:
        with open_netcdf(file) as dataset:
            names = sorted(set(dataset.ncattrs()) - set(FILE_ATTRIBUTES))
            attributes.append([(name, str(dataset.getncattr(name))) for name in names])
    return hashlib.sha256(repr(sorted(attributes)).encode()).hexdigest()[:16]
