"""What a reading of the benchmark gives where it has results."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr

from r37core.contact.scene import Scene
from r37core.dataset_file import about
from r37core.march.choice import MarchChoice
from r37core.march.speed_run import run_speed
from r37core.results.stress import StressRecovery
from r37core.rom.contact_model import ContactModel

WINDOWS = {4: (1660.0, 1756.0), 5: (1220.0, 1288.0), 6: (960.0, 1012.0), 7: (804.0, 856.0)}
"""Engine order of 1B -> speeds (rad/s) about its interaction."""

OUTSIDE = (880.0, 1100.0, 1400.0, 1500.0, 1800.0, 1900.0)
"""Speeds (rad/s) away from interactions."""

HISTORIES = {"lined": 1717.0, "rigid": 1344.0}
"""Speed (rad/s) whose first yield the benchmark reports."""


def lined_speeds(step: float) -> np.ndarray:
    """All windows every `step` rad/s, the speeds outside and the one with a history."""
    windows = [np.arange(first, last + 0.5 * step, step) for first, last in WINDOWS.values()]
    return np.unique(np.concatenate([*windows, OUTSIDE, [HISTORIES["lined"]]]))


def rigid_speeds(step: float) -> np.ndarray:
    """The whole range every ten steps, and about the published maximum every two steps."""
    return np.unique(
        np.concatenate([np.arange(750.0, 2001.0, 10 * step), np.arange(1320.0, 1369.0, 2 * step), OUTSIDE, [1344.0]])
    )


def run_reading(
    model: ContactModel,
    recovery: StressRecovery,
    scene: Scene,
    choice: MarchChoice,
    speeds: np.ndarray,
    history_speed: float,
    yield_stress: float,
) -> xr.Dataset:
    """Run all speeds (rad/s): rms, stress, wear and lobes of each, and the first revolution beyond yield at `history_speed`."""
    names = ("rms_radial", "rms_tangential", "max_von_mises", "max_wear", "lobes", "first_yield_revolution", "status")
    values = {name: np.full(len(speeds), np.nan) for name in names}
    results = ["stress", *(["wear"] if scene.lining else [])]
    for row, speed in enumerate(speeds):
        kept = choice.revolutions if speed == history_speed else 1
        one = replace(choice, snapshot_revolutions=kept)
        run = run_speed(model, float(speed), scene, one, results, 20, 1, 1000)
        values["rms_radial"][row], values["rms_tangential"][row] = run["rms"][0]
        values["status"][row] = run["status"]
        if "max_wear" in run:
            values["max_wear"][row] = run["max_wear"]
            values["lobes"][row] = 3 + np.argmax(run["wear_harmonic"][3:13])
        if len(run["snapshots"]):
            instants = recovery.max_von_mises(run["snapshots"])
            values["max_von_mises"][row] = instants[-choice.snapshots_per_revolution :].max()
            if kept > 1:
                beyond = np.flatnonzero(instants > yield_stress)
                values["first_yield_revolution"][row] = (
                    beyond[0] // choice.snapshots_per_revolution + 1 if len(beyond) else np.nan
                )
    units = {"rms_radial": "m", "rms_tangential": "m", "max_von_mises": "Pa", "max_wear": "m"}
    data = {name: ("speed", values[name], about(units.get(name, "1"), name.replace("_", " "))) for name in names}
    return xr.Dataset(data, coords={"speed": ("speed", speeds, about("rad s-1", "angular speed of the rotor"))})
