"""Creating axes and variables in an open netCDF4 file, for the datasets that are written row by row."""

from collections.abc import Mapping, Sequence
from typing import Any

import netCDF4
import numpy as np

from r37core.base.dataset_file import SPEED_RPM, Variable
from r37core.base.units import RPM


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


def create_variable(dataset: netCDF4.Dataset, name: str, variable: Variable, along: Sequence[str] = ()) -> netCDF4.Variable:
    """A variable as its table has it, with the dimensions `along` before its own."""
    return add_variable(dataset, name, (*along, *variable.dims), variable.dtype, variable.attributes)


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
