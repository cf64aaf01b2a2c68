"""The Campbell diagram of one blade as a dataset."""

from __future__ import annotations

import numpy as np
import xarray as xr

from r37core.dataset_file import SPEED, Variable, dataset_of
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.rotation import BucklingError

from .campbell import campbell_diagram, dynamic_clearance

_CLEARANCE_POINTS = 41

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
    maximum_speed: float,
    speed_step: float,
    modes: int,
    highest_engine_order: int,
    largest_tangential_displacement: float,
    tip_line: str,
) -> xr.Dataset:
    """Frequencies from 0 to `maximum_speed` (rad/s), crossings with engine orders, dynamic clearance at rest.

    Speeds and the step in rad/s, displacement in m; `tip_line` carries the leading-edge node of the dynamic clearance.
    Raises ValueError for more modes than the model has coordinates, BucklingError where it has no stable position.
    """
    if modes > model.size:
        raise ValueError(f"campbell.modes in config.yaml: found {modes}; allowed: up to {model.size}, the reduced model's size")
    speeds = np.linspace(0.0, maximum_speed, max(4, round(maximum_speed / speed_step) + 1))
    diagram = campbell_diagram(model, speeds, modes)
    unstable = np.flatnonzero((diagram.frequencies <= 0.0).any(axis=0))
    if len(unstable):
        raise BucklingError(speeds[unstable[0]])
    orders = np.arange(1, highest_engine_order + 1)
    displacement = np.linspace(-1.0, 1.0, _CLEARANCE_POINTS) * largest_tangential_displacement
    clearance = dynamic_clearance(model, diagram.shapes[:, 0].T, tip_line, displacement)
    values = {
        "frequency": diagram.frequencies,
        "crossing_speed": diagram.crossing_speeds(orders),
        "dynamic_clearance": clearance,
        "smallest_mac": diagram.continuity,
        "speed": speeds,
        "engine_order": orders,
        "tangential_displacement": displacement,
    }
    dataset = dataset_of(VARIABLES, values, AXES, {"mode": list(diagram.mode_names)})
    return dataset.assign_attrs(
        dynamic_clearance_tip_line=tip_line, tip_cone_angle_deg=float(np.degrees(model.tip_lines[tip_line].cone_angle))
    )
