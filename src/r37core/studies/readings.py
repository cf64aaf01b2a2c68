"""What a reading of the benchmark gives at one place."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr

from r37core.contact.scene import Scene
from r37core.dataset_file import about
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import DIRECTIONS
from r37core.time_integration.speed_run import run_speed

from .reading_places import Place

UNITS = {f"{kind}_{direction}": "m" for kind in ("rms", "peak") for direction in DIRECTIONS} | {
    "max_von_mises": "Pa",
    "max_wear": "m",
    "lobes": "1",
    "casing_hits": "1",
    "first_contact": "1",
    "status": "1",
}
"""What is kept of every speed; motion is the leading edge's, over the last half of the run."""

_KEPT = {"spectrum_highest_order": 12, "wear_angles": 1000}
_FIRST_LOBES = 3
_MOST_EXTRA = 40
"""Speeds added on each side of a window that ends above yield."""


@dataclass(frozen=True)
class Bench:
    """What all runs of one place share; `yield_stress` (Pa) of the blade."""

    model: ContactModel
    recovery: StressRecovery
    scene: Scene
    choice: IntegrationChoice
    yield_stress: float

    def run(self, speed: float, spectrum: bool = False) -> dict[str, np.ndarray]:
        """One speed (rad/s): the values of UNITS, and the spectrum if it is wanted."""
        run, stress = self._run(speed, 1, spectrum)
        values = {
            f"{kind}_{name}": number for kind in ("rms", "peak") for name, number in zip(DIRECTIONS, run[kind][0], strict=True)
        }
        values |= {name: run[name] for name in ("status", "casing_hits")}
        touched = run["revolution_maxima"].reshape(len(run["revolution_maxima"]), -1).max(axis=1) > 0.0
        values["first_contact"] = np.argmax(touched) + 1 if touched.any() else np.nan
        values["max_von_mises"] = np.nan if run["status"] else stress.max()
        values["max_wear"], values["lobes"] = run.get("max_wear", np.nan), np.nan
        if "wear_harmonic" in run:
            values["lobes"] = _FIRST_LOBES + np.argmax(run["wear_harmonic"][_FIRST_LOBES:13])
        if spectrum:
            values |= {name: run[name] for name in ("amplitude", "engine_order")}
        return values

    def history(self, speed: float) -> np.ndarray:
        """Largest stress (Pa) of every revolution at one speed (rad/s), NaN from where it diverged."""
        _, stress = self._run(speed, self.choice.revolutions, False)
        history = np.full(self.choice.revolutions, np.nan)
        whole = len(stress) // self.choice.snapshots_per_revolution
        history[:whole] = stress[: whole * self.choice.snapshots_per_revolution].reshape(whole, -1).max(axis=1)
        return history

    def revolution(self, speed: float, instants: int) -> np.ndarray:
        """Largest stress (Pa) at so many instants of the last revolution at one speed (rad/s), shape (instants,)."""
        return replace(self, choice=replace(self.choice, snapshots_per_revolution=instants))._run(speed, 1, False)[1]

    def _run(self, speed: float, kept: int, spectrum: bool) -> tuple[dict[str, np.ndarray], np.ndarray]:
        choice = replace(self.choice, snapshot_revolutions=kept)
        results = ["stress", *(["wear"] if self.scene.lining else []), *(["spectrum"] if spectrum else [])]
        run = run_speed(self.model, float(speed), self.scene, choice, results, **_KEPT)
        return run, self.recovery.max_von_mises(run["snapshots"])


def run_place(bench: Bench, place: Place) -> xr.Dataset:
    """All speeds of a place, those beyond its ends if it follows, and its histories."""
    runs = {speed: bench.run(speed, place.spectrum) for speed in place.speeds}
    histories = list(place.histories)
    if place.follow:
        _extend(runs, bench)
        histories.append(max(runs, key=lambda speed: float(motion(runs[speed]))))
    runs = dict(sorted(runs.items()))
    speed = ("speed", list(runs), about("rad s-1", "angular speed of the rotor"))
    dataset = xr.Dataset(coords={"speed": speed})
    for name, unit in UNITS.items():
        dataset[name] = ("speed", [float(run[name]) for run in runs.values()], about(unit, name.replace("_", " ")))
    if place.spectrum:
        dataset = dataset.assign_coords(engine_order=next(iter(runs.values()))["engine_order"])
        for row, (name, direction) in enumerate((("amplitude", "normal"), ("amplitude_tangential", "tangential"))):
            values = np.array([run["amplitude"][row] for run in runs.values()])
            about_it = about("m", f"amplitude of the {direction} displacement")
            dataset[name] = (("speed", "engine_order"), values, about_it)
    if histories:
        dataset = dataset.assign_coords(
            history_speed=sorted(set(histories)), revolution=1 + np.arange(bench.choice.revolutions)
        )
        stress = np.array([bench.history(speed) for speed in dataset["history_speed"].values])
        dataset["history"] = (("history_speed", "revolution"), stress, about("Pa", "largest stress of each revolution"))
    return dataset


def motion(run: Any) -> np.ndarray:
    """Rms (m) of the leading edge's normal and tangential motion together, of one run or of every speed of a dataset.

    0 where it diverged.
    """
    return np.nan_to_num(np.hypot(np.asarray(run["rms_normal"]), np.asarray(run["rms_tangential"])))


def _extend(runs: dict[float, dict[str, np.ndarray]], bench: Bench) -> None:
    """Add speeds beyond both ends, at the grid's step, until the stress is below yield there."""
    speeds = sorted(runs)
    step = speeds[1] - speeds[0] if len(speeds) > 1 else 1.0
    for end, towards in ((speeds[0], -step), (speeds[-1], step)):
        for number in range(1, _MOST_EXTRA + 1):
            if not runs[end + (number - 1) * towards]["max_von_mises"] > bench.yield_stress:
                break
            runs[end + number * towards] = bench.run(end + number * towards)
