"""Creating labels, axes and variables in an open netCDF4 file, for the datasets that are written row by row."""

from collections.abc import Sequence
from typing import Any

import netCDF4
import numpy as np

from r37core.base.dataset_file import SPEED_RPM, Variable
from r37core.base.units import RPM
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import MotionKind, RunStatus

FLAGGED: dict[str, type[RunStatus] | type[MotionAtEnd] | type[MotionKind]] = {
    "status": RunStatus,
    "motion_at_end": MotionAtEnd,
    "motion_kind": MotionKind,
}
"""Variables that hold a state as a number -> what the numbers mean."""


def state_flags(name: str) -> dict[str, Any]:
    """Attributes of a variable of FLAGGED, after the CF conventions."""
    states: list[Any] = list(FLAGGED[name])
    return {"flag_values": np.array(states, dtype="i1"), "flag_meanings": " ".join(state.text for state in states)}


def create_labels(dataset: netCDF4.Dataset, name: str, labels: Sequence[str]) -> None:
    """A dimension with text labels."""
    dataset.createDimension(name, len(labels))
    dataset.createVariable(name, str, (name,))[:] = np.array(labels, dtype=object)


def create_axis(dataset: netCDF4.Dataset, name: str, values: np.ndarray, variable: Variable) -> None:
    """A dimension with numbers; coordinates carry no fill value, as the CF conventions ask. Speeds are there in rpm too."""
    dataset.createDimension(name, len(values))
    coordinates = {name: (variable, values)}
    if name == "speed":
        coordinates["speed_rpm"] = SPEED_RPM, RPM * np.asarray(values)
        dataset.setncattr("coordinates", "speed_rpm")
    for coordinate, (description, numbers) in coordinates.items():
        axis = dataset.createVariable(coordinate, "f8", (name,), fill_value=False, fletcher32=True)
        axis.setncatts(description.attributes)
        axis[:] = numbers


def create_variable(
    dataset: netCDF4.Dataset, name: str, variable: Variable, along: Sequence[str] = (), **more: object
) -> netCDF4.Variable:
    """A variable as its table has it, with the dimensions `along` before its own, and `more` attributes.

    Floats are NaN where nothing is written. Arrays carry checksums, so that reading finds a flipped bit. They are
    compressed: those over all blades and speeds are three quarters empty. Texts have neither.
    """
    dims = (*along, *variable.dims)
    if variable.dtype == "str":
        created = dataset.createVariable(name, str, dims)
    else:
        fill, array = np.nan if np.dtype(variable.dtype).kind == "f" else False, bool(dims)
        created = dataset.createVariable(name, variable.dtype, dims, fill_value=fill, zlib=array, complevel=1, fletcher32=array)
    created.setncatts(variable.attributes | more)
    return created
