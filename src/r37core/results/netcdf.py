"""Creating labels, axes and variables in an open netCDF4 file, for the datasets that are written row by row."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import netCDF4
import numpy as np

from r37core.dataset_file import SPEED_RPM
from r37core.time_integration.status import RunStatus
from r37core.units import RPM


def status_flags() -> dict[str, Any]:
    """Attributes of a variable that holds a RunStatus, after the CF conventions."""
    return {"flag_values": np.array(list(RunStatus), dtype="i1"), "flag_meanings": " ".join(how.text for how in RunStatus)}


def create_labels(dataset: netCDF4.Dataset, name: str, labels: Sequence[str]) -> None:
    """A dimension with text labels."""
    dataset.createDimension(name, len(labels))
    dataset.createVariable(name, str, (name,))[:] = np.array(labels, dtype=object)


def create_axis(dataset: netCDF4.Dataset, name: str, values: np.ndarray, attributes: Mapping[str, Any]) -> None:
    """A dimension with numbers; coordinates carry no fill value, as the CF conventions ask. Speeds are there in rpm too."""
    dataset.createDimension(name, len(values))
    axis = dataset.createVariable(name, "f8", (name,), fill_value=False, fletcher32=True)
    axis.setncatts(attributes)
    axis[:] = values
    if name == "speed":
        beside = dataset.createVariable("speed_rpm", "f8", (name,), fill_value=False, fletcher32=True)
        beside.setncatts(SPEED_RPM)
        beside[:] = RPM * np.asarray(values)
        dataset.setncattr("coordinates", "speed_rpm")


def create_text(dataset: netCDF4.Dataset, name: str, dims: Sequence[str], long_name: str) -> netCDF4.Variable:
    """A variable of texts, empty where nothing is written; texts have no unit, compression or checksum."""
    variable = dataset.createVariable(name, str, tuple(dims))
    variable.setncatts({"units": "1", "long_name": long_name})
    return variable


def create_variable(
    dataset: netCDF4.Dataset, name: str, dtype: str | np.dtype, dims: Sequence[str], attributes: Mapping[str, Any]
) -> netCDF4.Variable:
    """A variable; floats are NaN where nothing is written. Arrays carry checksums, so that reading finds a flipped bit.

    They are compressed: those over all blades and speeds are three quarters empty.
    """
    fill = np.nan if np.dtype(dtype).kind == "f" else False
    array = bool(dims)
    variable = dataset.createVariable(name, dtype, tuple(dims), fill_value=fill, zlib=array, complevel=1, fletcher32=array)
    variable.setncatts(attributes)
    return variable
