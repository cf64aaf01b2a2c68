"""run_ups.nc: all run-ups of all blades and scenes, revolution by revolution."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import Variable, dataset_of
from r37core.base.io import readable
from r37core.results.joining import Along, join
from r37core.results.variables import AXES as RESPONSE_AXES
from r37core.results.variables import OF_STRESS
from r37core.time_integration import speed_arrays as of_run
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
    **of_run.STATUS,
    "yield_stress": OF_STRESS["yield_stress"],
    "largest_stress_range": Variable((), "Pa", "largest range of the stress of a node, along its deviator's largest change"),
    "miner_sum": Variable((), "1", "share of the life that the run-up's stress cycles use, by Miner's rule"),
    **{name: of_run.ARRAYS[name] for name in ("largest_normal_force", "casing_hits", "contact_work", "damping_loss")},
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
    "max_von_mises": Variable(_TURN, "Pa", "largest von Mises stress in the region that decides, in the revolution"),
    "goodman_share": Variable(_TURN, "1", "largest share of the Goodman line in the revolution"),
    "max_wear": Variable(
        _TURN, "m", "largest wear of the lining by the end of the constant-speed segment, up to 7 revolutions on"
    ),
}
"""Dimensions are those beyond the run."""

AXES = {name: RESPONSE_AXES[name] for name in ("revolution", "engine_order")}

_LABELS = ("blade", "scene", "run_up")


def write_run_ups(files: Mapping[tuple[str, ...], Path | str], file: Path | str, provenance: Mapping[str, object]) -> None:
    """Join the files of all runs, by blade, scene and name, along the dimension `run`; one is in memory at a time.

    Shorter runs have NaN after their last revolution. Raises InputFileError for a file that cannot be read.
    """
    join(files, Along(_LABELS, rows="run", coordinates=_LABELS), file, "Run-ups of rubbing blades", provenance, _opened)


@contextmanager
def _opened(file: Path | str) -> Iterator[xr.Dataset]:
    """The dataset of one run-up."""
    values = read_speed(file, VARIABLES)
    with readable(file):
        values["revolution"] = np.arange(1, len(values["speed"]) + 1)
        if "amplitude" in values:
            values["engine_order"] = np.arange(values["amplitude"].shape[-1])
    yield dataset_of(VARIABLES, values, AXES, {"tip_point": list(TIP_POINTS)})


def runs_of(dataset: xr.Dataset, **labels: str) -> list[xr.Dataset]:
    """The runs with these labels, each with the revolutions that it has after the casing has become lobed."""
    runs = []
    for number in range(dataset.sizes["run"]):
        run = dataset.isel(run=number)
        if all(str(run[name].values) == value for name, value in labels.items()):
            after = (run["revolution"] > run["revolutions_before"]) & np.isfinite(run["speed"])
            runs.append(run.isel(revolution=after.values))
    return runs
