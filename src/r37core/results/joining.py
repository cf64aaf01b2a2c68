"""Joining of the datasets of several runs into one file, slab by slab: one of them is in memory at a time."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pandas as pd
import xarray as xr
from xarray import Dataset

from r37core.base.dataset_file import SPEED_RPM, attributes_of, joined_hash, new_netcdf, open_dataset
from r37core.base.origin import origin
from r37core.base.units import RPM
from r37core.base.variable import about


@dataclass(frozen=True)
class Along:
    """Place of the datasets of runs in the joined one: a cell of the dimensions `labels`, or rows of one dimension.

    `rows`: name of that dimension, in which they stand one after another with their labels; `dim`: dimension of the datasets
    that becomes it, empty where each is a single row. `names`: variables that are joined, by default all; `coordinates`: those
    of them, and of the labels, that are coordinates.
    """

    labels: tuple[str, ...] = ("blade", "scene")
    rows: str = ""
    dim: str = ""
    names: Sequence[str] = ()
    coordinates: Sequence[str] = ()


def join(
    sources: Mapping[Any, Any],
    along: Along,
    file: Path | str,
    title: str,
    provenance: Mapping[str, object],
    read: Callable[[Any], AbstractContextManager[Dataset]] = open_dataset,
) -> None:
    """Join the datasets of the `sources`, by their labels, in a file with this `title`.

    They are files unless `read` opens something else.

    Axes are the unions of theirs. What no dataset has is NaN, and of states the last one, which is not run or unknown; other
    whole numbers have no gaps. Raises InputFileError for a file that cannot be read.
    """
    variables: dict[str, xr.Variable] = {}
    axes: dict[str, pd.Index] = {}
    rows = []
    for source in sources.values():
        with read(source) as dataset:
            rows.append(dataset.sizes[along.dim] if along.dim else 1)
            indexes = {str(name): index for name, index in dataset.indexes.items() if name != along.dim}
            # texts, such as the regions of the stress, keep their order
            orders = {name: False if index.dtype.kind in "OU" else None for name, index in indexes.items()}
            axes |= {name: axes.get(name, index).union(index, sort=orders[name]) for name, index in indexes.items()}
            described = {str(name): variable for name, variable in dataset.variables.items()}
            # texts without any rows are read as numbers
            variables = variables | described if rows[-1] else described | variables
    wanted = [name for name in along.names or variables if name in variables]
    names = [name for name in wanted if name not in axes]
    texts = [name for name in names if variables[name].dtype.kind in "OU"]
    states = {name: max(variables[name].attrs["flag_values"]) for name in names if "flag_values" in variables[name].attrs}
    columns = {label: [key[number] for key in sources] for number, label in enumerate(along.labels)}
    with new_netcdf(file, {}) as target:
        target.setncatts(origin(title) | dict(provenance))
        dims, places = _rows(target, along, columns, rows) if along.rows else _cells(target, columns)
        used = {str(dim) for name in names for dim in variables[name].dims} | {*wanted}
        for name in (name for name in axes if name in used):
            create_axis(target, name, axes[name].to_numpy(), variables[name].attrs)
        for name in names:
            variable = variables[name]
            own = [str(dim) for dim in variable.dims if dim != along.dim]
            more = {"coordinates": " ".join(along.coordinates)} if along.coordinates and name not in along.coordinates else {}
            created = add_variable(target, name, (*dims, *own), variable.dtype, variable.attrs | more)
            # a dimension without rows would get one
            if name in states and created.size:
                created[:] = states[name]
        for place, count, source in zip(places, rows, sources.values(), strict=True):
            if not count:
                continue
            with read(source) as dataset:
                there = [name for name in names if name in dataset.variables]
                wider = {name: axes[name] for name in axes if name in dataset.dims}
                part = dataset[there].reindex(wider, fill_value=states | dict.fromkeys(texts, ""))
                for name in there:
                    values = part[name]
                    if along.rows and along.dim not in values.dims:
                        values = values.expand_dims(row=count)
                    target[name][place] = values.values[()]


def join_runs(
    files: Sequence[str], runs: Iterable[Sequence[str]], along: Along, file: Path | str, title: str, fidelity: str
) -> None:
    """Join the files of the `runs` (blade, scene); global attributes are those that all share, level and hash of the inputs."""
    attributes = attributes_of(files)
    first = attributes[0] if attributes else {}
    shared = {name: value for name, value in first.items() if all(several.get(name) == value for several in attributes)}
    made = shared | {"fidelity": fidelity, "input_hash": joined_hash(attributes)}
    join(dict(zip(map(tuple, runs), files, strict=True)), along, file, title, made)


def _rows(
    target: netCDF4.Dataset, along: Along, columns: Mapping[str, list[str]], rows: list[int]
) -> tuple[tuple[str, ...], list[Any]]:
    """Make the dimension of the rows, with their labels; its name, and the rows of each dataset."""
    target.createDimension(along.rows, sum(rows))
    for label, texts in columns.items():
        labels = add_variable(target, label, (along.rows,), "str", about("1", f"name of the {label}"))
        labels[:] = np.repeat(np.array(texts, dtype=object), rows)
    ends = np.cumsum(rows).tolist()
    return (along.rows,), [slice(end - count, end) for end, count in zip(ends, rows, strict=True)]


def _cells(target: netCDF4.Dataset, columns: Mapping[str, list[str]]) -> tuple[tuple[str, ...], list[Any]]:
    """Make the dimensions of the labels; their names, and the cell of each dataset."""
    places = []
    for label, texts in columns.items():
        names = list(dict.fromkeys(texts))
        create_axis(target, label, np.array(names, dtype=object))
        places.append(list(map(names.index, texts)))
    return tuple(columns), list(zip(*places, strict=True))


def create_axis(dataset: netCDF4.Dataset, name: str, values: Any, attributes: Mapping[str, Any] | None = None) -> None:
    """A dimension with its values, numbers or texts; speeds are there in rpm too.

    Coordinates carry no fill value, as the CF conventions ask.
    """
    values = np.asarray(values)
    dataset.createDimension(name, len(values))
    if values.dtype.kind in "OU":
        dataset.createVariable(name, str, (name,))[:] = values.astype(object)
        return
    coordinates = {name: (attributes or {}, values)}
    if name == "speed":
        coordinates["speed_rpm"] = SPEED_RPM.attributes, RPM * values
        dataset.setncattr("coordinates", "speed_rpm")
    for coordinate, (described, numbers) in coordinates.items():
        axis = dataset.createVariable(coordinate, numbers.dtype, (name,), fill_value=False, fletcher32=True)
        axis.setncatts(described)
        axis[:] = numbers


def add_variable(
    dataset: netCDF4.Dataset, name: str, dims: Sequence[str], dtype: Any, attributes: Mapping[str, Any]
) -> netCDF4.Variable:
    """A variable of these dimensions.

    Floats are NaN where nothing is written. Arrays carry checksums, so that reading finds a flipped bit. They are
    compressed: those over all blades and speeds are three quarters empty. Texts have neither.
    """
    if dtype in ("str", object):
        created = dataset.createVariable(name, str, dims)
    else:
        fill, array = np.nan if np.dtype(dtype).kind == "f" else False, bool(dims)
        created = dataset.createVariable(name, dtype, dims, fill_value=fill, zlib=array, complevel=1, fletcher32=array)
    created.setncatts(attributes)
    return created
