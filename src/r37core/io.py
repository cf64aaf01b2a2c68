"""Reading and writing files: atomic writes, one clear message for a file that cannot be read, common attributes."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import xarray as xr

from . import __version__


class InputFileError(RuntimeError):
    """A file that is missing, corrupt or of another make; the message names it and the remedy."""


@contextmanager
def atomic_write(file: Path | str) -> Iterator[Path]:
    """Give a temporary path beside `file`; it becomes `file` when the block ends well and vanishes when it does not."""
    file = Path(file)
    file.parent.mkdir(parents=True, exist_ok=True)
    partial = file.with_name(f".{file.stem}.partial{file.suffix}")
    try:
        yield partial
        os.replace(partial, file)
    finally:
        partial.unlink(missing_ok=True)


@contextmanager
def readable(file: Path | str) -> Iterator[None]:
    """Turn whatever goes wrong while reading `file` into an InputFileError that names it and the remedy."""
    try:
        yield
    except Exception as error:
        reason = f"{type(error).__name__}: {error}" if Path(file).exists() else "there is no such file"
        raise InputFileError(f"{file}: cannot be read ({reason}); if it is a result, delete it and run again") from error


def write_dataset(dataset: xr.Dataset, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write a dataset as netCDF4, atomically, with version and `provenance` as global attributes.

    Coordinates carry no fill value, as the CF conventions ask.
    """
    dataset = dataset.assign_attrs(Conventions="CF-1.11", r37core_version=__version__, **dict(provenance or {}))
    encoding: dict[str, dict[str, float | None]] = {str(name): {"_FillValue": None} for name in dataset.coords}
    for name, variable in dataset.data_vars.items():
        encoding[str(name)] = {"_FillValue": np.nan if variable.dtype.kind == "f" else None}
    with atomic_write(file) as partial:
        dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)


def read_dataset(file: Path | str) -> xr.Dataset:
    """Read a netCDF file into memory; InputFileError when it cannot be read."""
    with readable(file), xr.open_dataset(file, engine="netcdf4") as dataset:
        return dataset.load()
