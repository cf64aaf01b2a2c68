"""Readings of what the benchmark leaves open, and what they give where it has results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr

from r37core.contact.scene import Scene
from r37core.dataset_file import about
from r37core.march.choice import MarchChoice
from r37core.march.speed_run import run_speed
from r37core.results.stress import StressRecovery
from r37core.rom.contact_model import ContactModel


@dataclass(frozen=True)
class Reading:
    """One reading: `changes`: dotted path in the scene's entry of scenes.yaml -> value; `model`: parts of a model's name.

    `steps`: time step as a multiple of the base level's; comparing readings does not need the published one.
    """

    what: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    model: Mapping[str, Any] = field(default_factory=dict)
    steps: float = 2.0


_NUMERICAL = {
    "double_step": Reading("twice the published step"),
    "mesh_10000": Reading("mesh of 10,000 nodes", model={"nodes": 10000}),
    "mesh_40000": Reading("mesh of 40,000 nodes", model={"nodes": 40000}),
}

LINED = {
    "benchmark": Reading("as shipped", steps=1.0),
    "vector": Reading("friction along rotation and vibration", {"friction.form": "vector"}),
    "against": Reading("friction against the rotation", {"friction.direction": "against_rotation"}),
    "shared": Reading("one ring shared by the nodes", {"lining.rings": "shared"}),
    "against_shared": Reading(
        "vector friction against the rotation, one shared ring, the whole tip's area at every node",
        {
            "friction.form": "vector",
            "friction.direction": "against_rotation",
            "lining.rings": "shared",
            "lining.natural_bar_areas": 7.0,
        },
    ),
    "exact_gap": Reading("radius of the displaced node in the gap", {"gap": "exact"}),
    "area_half": Reading("half the natural bar area", {"lining.natural_bar_areas": 0.5}),
    "area_double": Reading("twice the natural bar area", {"lining.natural_bar_areas": 2.0}),
    "yield_mpa": Reading("yield stress in MPa", {"lining.yield_stress_pa": 1.5e6}),
    "camber": Reading("nodes on the camber line", model={"line": "camber"}),
    "inside": Reading("corners not among the nodes", model={"ends": "inside"}),
    "half_step": Reading("half the published step", steps=0.5),
} | _NUMERICAL
"""Readings of the abradable scene, and numerical variants of the shipped one."""

RIGID = {
    "benchmark": Reading("as shipped", steps=1.0),
    "vector": Reading("friction along rotation and vibration", {"friction.form": "vector"}),
    "against": Reading("friction against the rotation", {"friction.direction": "against_rotation"}),
    "against_vector": Reading(
        "vector friction against the rotation", {"friction.direction": "against_rotation", "friction.form": "vector"}
    ),
    "after": Reading("friction added after the normal solve", {"friction.coupling": "after"}),
    "exact_gap": Reading("radius of the displaced node in the gap", {"gap": "exact"}),
    "camber": Reading("nodes on the camber line", model={"line": "camber"}),
    "inside": Reading("corners not among the nodes", model={"ends": "inside"}),
} | _NUMERICAL
"""Readings of the direct scene."""

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
    """The whole range every ten steps, and about the published maximum every step."""
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
        one = MarchChoice(**{**vars(choice), "snapshot_revolutions": kept})
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
