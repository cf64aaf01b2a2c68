"""run_ups.nc: all run-ups of all blades and scenes, revolution by revolution."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import Variable, new_netcdf
from r37core.base.io import readable
from r37core.results.netcdf import create_axis, create_labels, create_variable, state_flags
from r37core.results.variables import AXES
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS
from r37core.time_integration.speed_file import read_speed

_TURN, _TIP, _ORDER = ("revolution",), ("revolution", "tip_point"), ("revolution", "engine_order")

VARIABLES = {
    "start_speed": Variable((), "rad s-1", "speed before the change"),
    "stop_speed": Variable((), "rad s-1", "speed after the change"),
    "rate": Variable((), "rad s-2", "rate of the change, negative where the speed falls"),
    "revolutions_before": Variable((), "1", "revolutions at the start speed, in which the casing becomes lobed", "i4"),
    "revolutions_after": Variable((), "1", "revolutions at the stop speed, beyond the one in which the change ends", "i4"),
    "worn": Variable((), "1", "1: the lining is worn by the same run-up, done once before", "i1"),
    "status": Variable((), "1", "how the run ended", "i1"),
    "diverged_revolution": Variable((), "1", "revolution at which the run diverged"),
    "yield_stress": Variable((), "Pa", "yield stress of the blade's material"),
    "largest_normal_force": Variable((), "N", "largest normal force on a tip node"),
    "casing_hits": Variable((), "1", "how often a tip node came upon the casing"),
    "contact_work": Variable((), "J", "work of the contact forces on the blade"),
    "damping_loss": Variable((), "J", "energy lost to damping"),
    "stiffness_work": Variable((), "J", "energy that the change of the stiffness with the speed brings to the vibration"),
    "energy_change": Variable((), "J", "energy of the vibration at the end"),
    "energy_residual": Variable((), "J", "energy change minus both works plus damping loss"),
    "speed": Variable(_TURN, "rad s-1", "mean angular speed of the revolution"),
    "time": Variable(_TURN, "s", "time at the end of the revolution"),
    **{
        f"{kind}_{direction}": Variable(_TIP, "m", f"{measure} {direction} displacement in the revolution", "f4")
        for kind, measure in (("rms", "rms of the"), ("maximum", "largest"))
        for direction in DIRECTIONS
    },
    "amplitude": Variable(_ORDER, "m", "amplitude of the leading edge's normal displacement in the revolution", "f4"),
    "amplitude_tangential": Variable(
        _ORDER, "m", "amplitude of the leading edge's tangential displacement in the revolution", "f4"
    ),
    "max_von_mises": Variable(_TURN, "Pa", "largest von Mises stress on the submesh in the revolution"),
    "max_wear": Variable(
        _TURN, "m", "largest wear of the lining by the end of the constant-speed segment, up to 7 revolutions on"
    ),
}
"""Dimensions are those beyond the run."""

LABELS = ("blade", "scene", "run_up")
"""Labels of a run."""


def write_run_ups(files: Mapping[tuple[str, str, str], Path | str], file: Path | str, provenance: Mapping[str, object]) -> None:
    """Join the files of all runs, by blade, scene and name, along the dimension `run`; one is in memory at a time.

    Shorter runs have NaN after their last revolution. Raises InputFileError for a file that cannot be read.
    """
    revolutions, orders, names = 0, 0, set[str]()
    for _, values in _runs(files):
        revolutions = max(revolutions, len(values["speed"]))
        orders = max(orders, values["amplitude"].shape[-1] if "amplitude" in values else 0)
        names |= set(values)
    with new_netcdf(file, provenance) as target:
        target.createDimension("run", len(files))
        create_labels(target, "tip_point", TIP_POINTS)
        create_axis(target, "revolution", np.arange(1, revolutions + 1), AXES["revolution"])
        if orders:
            create_axis(target, "engine_order", np.arange(orders), AXES["engine_order"])
        for name in LABELS:
            target.createVariable(name, str, ("run",))
        for name in (variable for variable in VARIABLES if variable in names):
            create_variable(target, name, VARIABLES[name], ("run",), coordinates=" ".join(LABELS))
        target["status"].setncatts(state_flags("status"))
        for row, (run, values) in enumerate(_runs(files)):
            for name, label in zip(LABELS, run, strict=True):
                target[name][row] = label
            for name in (variable for variable in VARIABLES if variable in values):
                value = values[name]
                target[name][(row, *(slice(length) for length in value.shape))] = value


def _runs(files: Mapping[tuple[str, str, str], Path | str]) -> Iterator[tuple[tuple[str, str, str], dict[str, np.ndarray]]]:
    for run, file in files.items():
        values = read_speed(file)
        with readable(file):
            revolutions = len(values["speed"])
            for kind in ("rms", "maximum"):
                if values[kind].shape != (revolutions, len(TIP_POINTS), len(DIRECTIONS)):
                    raise ValueError(f"{kind} is not of {revolutions} revolutions")
                values |= {f"{kind}_{name}": values[kind][:, :, column] for column, name in enumerate(DIRECTIONS)}
            if "amplitude" in values:
                values["amplitude"], values["amplitude_tangential"] = values["amplitude"].swapaxes(0, 1)
        yield run, values


def runs_of(dataset: xr.Dataset, **labels: str) -> list[xr.Dataset]:
    """The runs with these labels, each with the revolutions that it has after the casing has become lobed."""
    runs = []
    for number in range(dataset.sizes["run"]):
        run = dataset.isel(run=number)
        if all(str(run[name].values) == value for name, value in labels.items()):
            after = (run["revolution"] > run["revolutions_before"]) & np.isfinite(run["speed"])
            runs.append(run.isel(revolution=after.values))
    return runs
