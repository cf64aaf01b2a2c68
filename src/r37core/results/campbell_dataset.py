"""The Campbell diagram of one blade as a dataset."""

from __future__ import annotations

import numpy as np
import xarray as xr

from r37core.dataset_file import SPEED_RPM, about
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.rotation import BucklingError
from r37core.units import RPM

from .campbell import campbell_diagram, dynamic_clearance

_CLEARANCE_POINTS = 41


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
    return xr.Dataset(
        {
            "frequency": (("mode", "speed"), diagram.frequencies, about("Hz", "natural frequency")),
            "crossing_speed": (
                ("mode", "engine_order"),
                diagram.crossing_speeds(orders),
                about("rad s-1", "speed at which the frequency is the engine order times the speed"),
            ),
            "dynamic_clearance": (
                ("mode", "tangential_displacement"),
                clearance,
                about(
                    "m",
                    "change of the leading-edge clearance, normal to the tip's cone, as the blade swings along the mode",
                ),
            ),
            "smallest_mac": ("mode", diagram.continuity, about("1", "smallest MAC between neighbouring speeds")),
        },
        coords={
            "mode": list(diagram.mode_names),
            "speed": ("speed", speeds, about("rad s-1", "angular speed of the rotor")),
            "speed_rpm": ("speed", RPM * speeds, SPEED_RPM),
            "engine_order": ("engine_order", orders, about("1", "engine order")),
            "tangential_displacement": (
                "tangential_displacement",
                displacement,
                about("m", "tangential displacement of the leading edge, positive against the rotation"),
            ),
        },
        attrs={
            "dynamic_clearance_tip_line": tip_line,
            "tip_cone_angle_deg": float(np.degrees(model.tip_lines[tip_line].cone_angle)),
        },
    )
