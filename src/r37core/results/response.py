"""response.nc: all speeds of one blade and scene, written in blocks so that memory does not grow with the speeds."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import netCDF4
import numpy as np

from r37core.base.dataset_file import new_netcdf
from r37core.stress.statistic import UNKNOWN, Strengths, goodman_statistic, stress_statistic
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS
from r37core.time_integration.speed_file import read_speed

from .joining import create_axis, create_variable
from .limits import beyond_limits
from .measures import first_yield
from .variables import AXES, HISTORIES, OF_ALL_SPEEDS, PLACES, VARIABLES

_BLOCK = 32
"""Speeds that are in memory at once, since writing takes as long for one as for many."""


def write_response(
    files: Iterable[Path | str],
    speeds: Sequence[float],
    file: Path | str,
    *,
    stress_history_speeds: Sequence[float],
    yield_stress: float,
    strengths: Strengths = UNKNOWN,
    provenance: Mapping[str, object],
) -> None:
    """Reduce the files of the `speeds` (rad/s, ascending), in the same order, to one file; _BLOCK are in memory at a time.

    Speeds in `stress_history_speeds`, which have recorded it, keep the largest stress of every revolution. `yield_stress` (Pa)
    and `strengths`: of the blade's material. Raises InputFileError for a file that cannot be read.
    """
    history_speeds = [speed for speed in speeds if speed in stress_history_speeds]
    with new_netcdf(file, provenance) as dataset:
        runs = list(zip(speeds, files, strict=True))
        for first in range(0, len(runs), _BLOCK):
            block = slice(first, first + _BLOCK)
            rows = {speed: run_row(read_speed(file), yield_stress, strengths) for speed, file in runs[block]}
            values = next(iter(rows.values()))
            if first == 0:
                _create(dataset, speeds, values, history_speeds)
            for name in VARIABLES:
                if name in values:
                    dataset[name][block] = np.stack([row[name] for row in rows.values()])
            for speed in rows.keys() & history_speeds:
                history, number = rows[speed]["revolution_von_mises"], history_speeds.index(speed)
                dataset["max_von_mises_history"][number] = history
                dataset["first_yield_revolution"][number] = [first_yield(part, yield_stress) for part in history]


def run_row(run: Mapping[str, np.ndarray], yield_stress: float, strengths: Strengths) -> dict[str, np.ndarray]:
    """The variables of one speed, and the coordinates that they need."""
    values = {**run, "casing_cone_angle": run["cone_angle"]}
    for kind in ("rms", "peak"):
        values |= {f"{kind}_{direction}": column for direction, column in zip(DIRECTIONS, run[kind].T, strict=True)}
    values["revolution_maximum"] = run["revolution_maxima"][:, :, DIRECTIONS.index("normal")]
    values["revolution"] = np.arange(1, len(values["revolution_maximum"]) + 1)
    values["beyond_limits"] = beyond_limits(run)
    if "amplitude" in run:
        values["amplitude"], values["amplitude_tangential"] = run["amplitude"]
    if "wear" in run:
        sectors = len(run["wear"])
        values["angle"] = np.arange(sectors) * 2.0 * np.pi / sectors
        values["lobes"] = np.arange(len(run["wear_harmonic"]))
    if "clearance" in run:
        values["contact_node"] = np.arange(1, len(run["clearance"]) + 1)
    if "casing_energy" in run:
        values["casing_mode"] = np.arange(1, len(run["casing_energy"]) + 1)
    if "max_von_mises_last_revolution" in run:
        values["yield_stress"] = np.array(yield_stress)
    if "max_von_mises_place" in run:
        values |= {f"max_von_mises_{name}": part for name, part in zip(PLACES, run["max_von_mises_place"].T, strict=True)}
    if "revolution_von_mises" in run:
        values |= stress_statistic(in_statistic(run, "revolution_von_mises"), yield_stress)
        # histories of all revolutions are in single precision
        values["max_von_mises_ever"] = np.maximum(values["max_von_mises_ever"], run["max_von_mises_last_revolution"])
    if "alternating_stress" in run:
        values |= goodman_statistic(run, strengths)
        values["stress_node"] = np.arange(1, len(run["alternating_stress"]) + 1)
    return values


def in_statistic(run: Mapping[str, np.ndarray], name: str) -> np.ndarray:
    """A history of a run by its `name`, shape (rows, revolutions), over the revolutions in the statistic alone."""
    history, revolutions, end = run[name], len(run["revolution_maxima"]), int(run["statistic_end"])
    # a history of all revolutions has them in place, a shorter one is that of the last
    last = history[:, :end] if history.shape[1] == revolutions else history
    return last[:, -int(run["statistic_revolutions"]) :]


def _create(
    dataset: netCDF4.Dataset, speeds: Sequence[float], values: Mapping[str, np.ndarray], history_speeds: Sequence[float]
) -> None:
    coordinates = {name: values[name] for name in AXES if name in values} | {"speed": np.array(speeds)}
    if history_speeds:
        coordinates["history_speed"] = np.array(history_speeds)
    create_axis(dataset, "tip_point", TIP_POINTS)
    if "region" in values:
        create_axis(dataset, "region", values["region"])
    for name, numbers in coordinates.items():
        create_axis(dataset, name, np.asarray(numbers, AXES[name].dtype), AXES[name].attributes)
    for name, variable in VARIABLES.items():
        if name in values:
            create_variable(dataset, name, variable, ("speed",))
    for name, variable in HISTORIES.items() if history_speeds else ():
        create_variable(dataset, name, variable)
    for name, variable in OF_ALL_SPEEDS.items():
        if name in values:
            value = values[name]
            create_variable(dataset, name, variable)[...] = value.astype(object) if variable.dtype == "str" else value
