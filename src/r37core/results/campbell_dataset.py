"""The Campbell diagram of one blade as a dataset, and those of all blades joined."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.dataset_file import SPEED, Variable, dataset_of, read_dataset
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.rotation import BucklingError

from .campbell import campbell_diagram, dynamic_clearance

VARIABLES = {
    "frequency": Variable(("mode", "speed"), "Hz", "natural frequency"),
    "crossing_speed": Variable(
        ("mode", "engine_order"), "rad s-1", "speed at which the frequency is the engine order times the speed"
    ),
    "dynamic_clearance": Variable(
        ("mode", "tangential_displacement"),
        "m",
        "change of the leading-edge clearance, normal to the tip's cone, as the blade swings along the mode",
    ),
    "smallest_mac": Variable(("mode",), "1", "smallest MAC between neighbouring speeds"),
}

AXES = {
    "speed": SPEED,
    "engine_order": Variable(("engine_order",), "1", "engine order", "i8"),
    "tangential_displacement": Variable(
        ("tangential_displacement",), "m", "tangential displacement of the leading edge, positive against the rotation"
    ),
}


def campbell_dataset(
    model: ReducedModel,
    *,
    speeds: np.ndarray,
    modes: int,
    highest_engine_order: int,
    largest_tangential_displacement: float,
    tip_line: str,
) -> xr.Dataset:
    """Frequencies at ascending `speeds` (rad/s) from 0, crossings with engine orders, dynamic clearance at rest.

    The displacement in m; `tip_line` carries the leading-edge node of the dynamic clearance.
    Raises ValueError for more modes than the model has coordinates, BucklingError where it has no stable position.
    """
    if modes > model.size:
        raise ValueError(f"campbell.modes in config.yaml: found {modes}; allowed: up to {model.size}, the reduced model's size")
    diagram = campbell_diagram(model, speeds, modes)
    unstable = np.flatnonzero((diagram.frequencies <= 0.0).any(axis=0))
    if len(unstable):
        raise BucklingError(speeds[unstable[0]])
    orders = np.arange(1, highest_engine_order + 1)
    displacement = np.linspace(-1.0, 1.0, 41) * largest_tangential_displacement
    values = {
        "frequency": diagram.frequencies,
        "crossing_speed": diagram.crossing_speeds(orders),
        "dynamic_clearance": dynamic_clearance(model, diagram.shapes[:, 0].T, tip_line, displacement),
        "smallest_mac": diagram.continuity,
        "speed": speeds,
        "engine_order": orders,
        "tangential_displacement": displacement,
    }
    dataset = dataset_of(VARIABLES, values, AXES, {"mode": list(diagram.mode_names)})
    return dataset.assign_attrs(
        dynamic_clearance_tip_line=tip_line, tip_cone_angle_deg=float(np.degrees(model.tip_lines[tip_line].cone_angle))
    )


def gather_blades(blades: Sequence[str], files: Iterable[Path | str]) -> xr.Dataset:
    """One dataset with the dimension `blade` from one file per blade; the files' coordinates must agree."""
    datasets = [read_dataset(file).drop_attrs(deep=False) for file in files]
    return xr.concat(datasets, pd.Index(blades, name="blade"), join="exact", combine_attrs="override")
