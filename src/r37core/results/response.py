"""response.nc: all speeds of one blade and scene, written row by row so that memory does not grow with the speeds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import netCDF4
import numpy as np

from r37core.io import FILE_ATTRIBUTES, atomic_write
from r37core.stress.statistic import stress_statistic
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS
from r37core.time_integration.speed_file import read_speed

from .measures import first_yield
from .netcdf import create_axis, create_labels, create_text, create_variable, status_flags
from .variables import OF_CASING, VARIABLES


def write_response(
    files: Iterable[Path | str],
    speeds: Sequence[float],
    file: Path | str,
    *,
    stress_history_speeds: Sequence[float],
    yield_stress: float,
    provenance: Mapping[str, object],
) -> None:
    """Reduce the files of the `speeds` (rad/s, ascending), in the same order, to one file; one is in memory at a time.

    Speeds in `stress_history_speeds`, which have recorded it, keep the largest stress of every revolution. `yield_stress`: of
    the blade's material (Pa). Raises InputFileError for a file that cannot be read.
    """
    history_speeds = [speed for speed in speeds if speed in stress_history_speeds]
    with atomic_write(file) as partial, netCDF4.Dataset(partial, "w") as dataset:
        dataset.setncatts(FILE_ATTRIBUTES | {name: str(value) for name, value in provenance.items()})
        for row, (speed, source) in enumerate(zip(speeds, files, strict=True)):
            values = _row(read_speed(source), yield_stress)
            if row == 0:
                _create(dataset, speeds, values, history_speeds)
                about = {"units": "rad", "long_name": "half angle of the casing's cone, negative where it narrows downstream"}
                create_variable(dataset, "casing_cone_angle", "f8", (), about)[...] = values["cone_angle"]
                if "lined" in values:
                    about = {"units": "1", "long_name": "1 where a lining is worn, 0: the tip meets the casing itself"}
                    create_variable(dataset, "lined", "f4", (), about)[...] = values["lined"]
                for name, variable in OF_CASING.items():
                    if name in values:
                        create_variable(dataset, name, variable.dtype, variable.dims, variable.attributes)[...] = values[name]
                if "max_von_mises" in values:
                    about = {"units": "Pa", "long_name": "yield stress of the blade's material"}
                    create_variable(dataset, "yield_stress", "f8", (), about)[...] = yield_stress
                    region = str(values["stress_region"])
                    create_text(dataset, "stress_region", (), "where max_von_mises is looked for")[...] = region
                    about = {"units": "1", "long_name": "1 where max_von_mises has the stress of rotation, 0: vibration alone"}
                    create_variable(dataset, "static_stress", "f4", (), about)[...] = values["static_stress"]
            for name in VARIABLES:
                if name in values:
                    dataset[name][row] = values[name]
            if speed in history_speeds:
                history, number = values["revolution_von_mises"], history_speeds.index(speed)
                dataset["max_von_mises_history"][number] = history
                dataset["first_yield_revolution"][number] = first_yield(history, yield_stress)


def _row(run: Mapping[str, np.ndarray], yield_stress: float) -> dict[str, np.ndarray]:
    """The variables of one speed, and the coordinates they need."""
    values = dict(run)
    for kind in ("rms", "peak"):
        values |= {f"{kind}_{direction}": column for direction, column in zip(DIRECTIONS, run[kind].T, strict=True)}
    values["revolution_maximum"] = run["revolution_maxima"][:, :, DIRECTIONS.index("normal")]
    if "amplitude" in run:
        values["amplitude"], values["amplitude_tangential"] = run["amplitude"]
    if "revolution_von_mises" in run:
        revolutions = len(values["revolution_maximum"])
        values |= stress_statistic(run["revolution_von_mises"][revolutions // 2 - revolutions :], yield_stress)
        # those of all revolutions are in single precision
        values["max_von_mises_ever"] = np.maximum(values["max_von_mises_ever"], run["max_von_mises"])
    return values


def _create(
    dataset: netCDF4.Dataset, speeds: Sequence[float], values: Mapping[str, np.ndarray], history_speeds: Sequence[float]
) -> None:
    coordinates: dict[str, tuple[np.ndarray, str, str]] = {"speed": (np.array(speeds), "rad s-1", "angular speed of the rotor")}
    revolutions = len(values["revolution_maximum"])
    coordinates["revolution"] = (np.arange(1, revolutions + 1), "1", "number of the revolution")
    if "amplitude" in values:
        coordinates["engine_order"] = (values["engine_order"], "1", "engine order")
    if "wear" in values:
        sectors = len(values["wear"])
        coordinates["angle"] = (np.arange(sectors) * 2.0 * np.pi / sectors, "rad", "start of the sector round the casing")
        coordinates["lobes"] = (np.arange(len(values["wear_harmonic"])), "1", "number of lobes")
    if "clearance" in values:
        nodes = np.arange(1, len(values["clearance"]) + 1)
        coordinates["contact_node"] = (nodes, "1", "number of the contact node, from the leading edge on")
    if "casing_order" in values:
        modes = np.arange(1, len(values["casing_energy"]) + 1)
        coordinates["casing_mode"] = (modes, "1", "number of the casing's mode")
        order = "frequency over speed, not turning; positive with the rotor, negative against it"
        coordinates["casing_order"] = (values["casing_order"], "1", order)
    if history_speeds:
        coordinates["history_speed"] = (np.array(history_speeds), "rad s-1", "speed with a stress history")
    create_labels(dataset, "tip_point", TIP_POINTS)
    for name, (data, units, long_name) in coordinates.items():
        create_axis(dataset, name, data, {"units": units, "long_name": long_name})
    for name, about in VARIABLES.items():
        if name in values:
            create_variable(dataset, name, about.dtype, ("speed", *about.dims), about.attributes)
    dataset["status"].setncatts(status_flags())
    if history_speeds:
        history = {"units": "Pa", "long_name": "largest von Mises stress of each revolution"}
        create_variable(dataset, "max_von_mises_history", "f4", ("history_speed", "revolution"), history)
        first = {"units": "1", "long_name": "first revolution whose largest stress exceeds yield"}
        create_variable(dataset, "first_yield_revolution", "f8", ("history_speed",), first)
