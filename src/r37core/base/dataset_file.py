"""Datasets as netCDF4 files, opened by one thread at a time: two inside the library end the process, whatever the files."""

import hashlib
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr
from xarray import Dataset

from .io import FILE_ATTRIBUTES, atomic_write, readable
from .units import RPM
from .variable import Variable


class ThreadLock:
    """An RLock that can be copied: xarray keeps it in datasets, so a copy of it is the lock itself."""

    def __init__(self) -> None:
        lock = threading.RLock()
        self.acquire, self.release = lock.acquire, lock.release

    def __enter__(self) -> None:
        self.acquire()

    def __exit__(self, *_: object) -> None:
        self.release()

    def __reduce__(self) -> str:
        return "NETCDF_LOCK"


NETCDF_LOCK = ThreadLock()
"""Lock that r37 holds while it reads or writes a netCDF file; other threads of yours that do so must hold it too."""


@contextmanager
def new_netcdf(file: Path | str, provenance: Mapping[str, object]) -> Iterator[netCDF4.Dataset]:
    """A netCDF file to write, atomically, with version and `provenance` as global attributes."""
    with NETCDF_LOCK, atomic_write(file) as partial, netCDF4.Dataset(partial, "w") as dataset:
        dataset.setncatts(FILE_ATTRIBUTES | {name: str(value) for name, value in provenance.items()})
        yield dataset


@contextmanager
def open_dataset(file: Path | str, group: str | None = None) -> Iterator[Dataset]:
    """A netCDF file, or a group of it, as a dataset to read from. Raises InputFileError when it cannot be read."""
    with NETCDF_LOCK, readable(file), xr.open_dataset(file, engine="netcdf4", group=group) as dataset:
        yield dataset


def lazy_dataset(file: Path | str) -> Dataset:
    """A netCDF file as a dataset whose values are read when they are used. Raises InputFileError when it cannot be read."""
    with NETCDF_LOCK, readable(file):
        return xr.open_dataset(file, engine="netcdf4", lock=NETCDF_LOCK)


SPEED = Variable(("speed",), "rad s-1", "angular speed of the rotor")
SPEED_RPM = Variable(("speed",), "rpm", "angular speed of the rotor in revolutions per minute")
"""Description of the coordinate `speed_rpm`, which stands next to `speed`."""


def dataset_of(
    variables: Mapping[str, Variable],
    values: Mapping[str, Any],
    coordinates: Mapping[str, Variable],
    labels: Mapping[str, Any],
    along: Sequence[str] = (),
) -> Dataset:
    """The dataset of the `values`, by name, that tables of variables and coordinates describe; an axis of speeds also in rpm.

    `labels`: of dimensions that are counted by names; `along`: dimensions of all variables, before their own.
    """

    def described(table: Mapping[str, Variable], first: Sequence[str]) -> dict[str, Any]:
        return {
            name: ((*first, *entry.dims), np.asarray(values[name], entry.dtype), entry.attributes)
            for name, entry in table.items()
            if name in values
        }

    axes = described(coordinates, ())
    if "speed" in axes:
        speeds = {"speed": axes["speed"], "speed_rpm": (SPEED_RPM.dims, RPM * axes["speed"][1], SPEED_RPM.attributes)}
        axes = speeds | axes
    return Dataset(described(variables, along), {**labels, **axes})


def write_dataset(dataset: Dataset, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write a dataset as netCDF4, atomically, with version and `provenance` as global attributes.

    Coordinates carry no fill value, as the CF conventions ask. Arrays carry checksums, so that reading finds a flipped bit.
    """
    attributes = FILE_ATTRIBUTES | dict(provenance or {})
    write_groups([("/", dataset.assign_attrs(attributes))], file, {})


def write_groups(groups: Iterable[tuple[str, Dataset]], file: Path | str, provenance: Mapping[str, object]) -> None:
    """Write datasets as the groups of these names of one netCDF4 file, as `write_dataset` does, one after another."""
    with new_netcdf(file, provenance) as opened:
        for name, dataset in groups:
            # to_netcdf would import dask's scheduler wherever it is installed
            dataset.dump_to_store(xr.backends.NetCDF4DataStore(opened, name, "a"), encoding=_encoding(dataset))


def _encoding(dataset: Dataset) -> dict[str, dict[str, Any]]:
    encoding: dict[str, dict[str, Any]] = {}
    for name, variable in dataset.variables.items():
        filled = name in dataset.data_vars and variable.dtype.kind == "f"
        encoding[str(name)] = {"_FillValue": np.nan if filled else None}
        if variable.ndim and variable.size and variable.dtype.kind in "fiu":
            encoding[str(name)]["fletcher32"] = True
    return encoding


def read_dataset(file: Path | str, part: Mapping[str, object] | None = None, group: str | None = None) -> Dataset:
    """Read a netCDF file, or a group of it, into memory; InputFileError when it cannot be read.

    `part`: label of a dimension, as far as the file has this, at which alone it is read; or several, of which it may lack some.
    """
    with open_dataset(file, group) as dataset:
        there = {name: wanted for name, wanted in (part or {}).items() if name in dataset.dims}
        several = {name: np.isin(dataset[name], wanted) for name, wanted in there.items() if isinstance(wanted, list)}
        return dataset.isel(several).sel({name: there[name] for name in there.keys() - several.keys()}).load()


def attributes_of(files: Iterable[Path | str]) -> list[dict[str, Any]]:
    """Global attributes of each file but for those of all; InputFileError for a file that cannot be read."""
    attributes = []
    for file in files:
        with NETCDF_LOCK, readable(file), netCDF4.Dataset(file) as dataset:
            attributes.append({name: dataset.getncattr(name) for name in dataset.ncattrs() if name not in FILE_ATTRIBUTES})
    return attributes


def joined_hash(attributes: Iterable[Mapping[str, object]]) -> str:
    """Input hash of a file that joins others, by the attributes of these in any order."""
    texts = [sorted((name, str(value)) for name, value in several.items()) for several in attributes]
    return hashlib.sha256(repr(sorted(texts)).encode()).hexdigest()[:16]
