"""netCDF files, opened by one thread at a time: two threads inside the library end the process, whatever their files are."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import netCDF4
import xarray as xr

from .io import FILE_ATTRIBUTES, atomic_write, readable


class ThreadLock:
    """A lock that its thread may take again; xarray keeps it in datasets, so a copy of it is the lock itself."""

    def __init__(self) -> None:
        self._lock = threading.RLock()

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Take the lock; whether it was free before the `timeout` (s)."""
        return self._lock.acquire(blocking, timeout)

    def release(self) -> None:
        """Give the lock back."""
        self._lock.release()

    def __enter__(self) -> None:
        self.acquire()

    def __exit__(self, *_: object) -> None:
        self.release()

    def __reduce__(self) -> str:
        return "NETCDF_LOCK"


NETCDF_LOCK = ThreadLock()
"""Lock that r37 holds while it reads or writes a netCDF file; other threads of yours that do so must hold it too."""


@contextmanager
def open_netcdf(file: Path | str) -> Iterator[netCDF4.Dataset]:
    """A netCDF file to read from. Raises InputFileError when it cannot be read."""
    with NETCDF_LOCK, readable(file), netCDF4.Dataset(file) as dataset:
        yield dataset


@contextmanager
def new_netcdf(file: Path | str, provenance: Mapping[str, object]) -> Iterator[netCDF4.Dataset]:
    """A netCDF file to write, atomically, with version and `provenance` as global attributes."""
    with NETCDF_LOCK, atomic_write(file) as partial, netCDF4.Dataset(partial, "w") as dataset:
        dataset.setncatts(FILE_ATTRIBUTES | {name: str(value) for name, value in provenance.items()})
        yield dataset


@contextmanager
def open_dataset(file: Path | str) -> Iterator[xr.Dataset]:
    """A netCDF file as a dataset to read from. Raises InputFileError when it cannot be read."""
    with NETCDF_LOCK, readable(file), xr.open_dataset(file, engine="netcdf4") as dataset:
        yield dataset


def lazy_dataset(file: Path | str) -> xr.Dataset:
    """A netCDF file as a dataset whose values are read when they are used. Raises InputFileError when it cannot be read."""
    with NETCDF_LOCK, readable(file):
        return xr.open_dataset(file, engine="netcdf4", lock=NETCDF_LOCK)
