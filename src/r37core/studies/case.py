"""One case of a study: a blade's model in one scene at some speeds, what came out and what it cost."""

from __future__ import annotations

import resource
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from r37core.contact.scene import Scene
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import run_speed

MOTION = {"rms_normal": "m", "rms_tangential": "m", "peak_normal": "m"}
"""Of the leading edge, as name -> unit: named after a kind and a direction of the time integration."""

QUANTITIES = {**MOTION, "max_von_mises": "Pa", "max_wear": "m"}
"""What a case keeps of every run, name -> unit; the stress over the last revolution, the wear at the end."""

CHECKS = ("status", "energy_residual", "worst_complementarity", "share_of_time_in_contact")
_KEPT = {"spectrum_highest_order": 20, "wear_angles": 1000}
COSTS = ("cpu_s", "wall_s", "peak_memory_bytes", "bytes_written")


class Stopwatch:
    """Adds up CPU and wall seconds of this process over the blocks it is used for."""

    def __init__(self) -> None:
        self.cpu = self.wall = 0.0

    def __enter__(self) -> None:
        self._start = time.process_time(), time.perf_counter()

    def __exit__(self, *_: object) -> None:
        self.cpu += time.process_time() - self._start[0]
        self.wall += time.perf_counter() - self._start[1]


def peak_memory() -> float:
    """Largest memory (bytes) of this process so far."""
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)


@dataclass(frozen=True)
class Case:
    """Arrays of shape (speeds,) by the names of QUANTITIES and CHECKS, NaN where a scene has none, and costs per run."""

    speeds: np.ndarray
    values: dict[str, np.ndarray]
    costs: dict[str, float]


def run_case(
    model: ContactModel,
    scene: Scene,
    choice: IntegrationChoice,
    speeds: np.ndarray,
    recovery: StressRecovery | None = None,
) -> Case:
    """Run all `speeds` (rad/s), with the energy balance. Costs are means over the runs; memory: see peak_memory.

    Raises UnstableStepError for a step beyond the stability limit.
    """
    choice = replace(choice, energy=True)
    results = ["energy", "spectrum", *(["stress"] if recovery else []), *(["wear"] if scene.lining else [])]
    values = {name: np.full(len(speeds), np.nan) for name in (*QUANTITIES, *CHECKS)}
    written = 0
    clock = Stopwatch()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "speed.npz"
        for row, speed in enumerate(speeds):
            with clock:
                run = run_speed(model, speed, scene, choice, results, **_KEPT)
            write_speed(run, file, {})
            written += file.stat().st_size
            _keep(values, row, run, recovery, choice)
    costs = {
        "cpu_s": clock.cpu / len(speeds),
        "wall_s": clock.wall / len(speeds),
        "peak_memory_bytes": peak_memory(),
        "bytes_written": written / len(speeds),
    }
    return Case(np.array(speeds, dtype=float), values, costs)


def _keep(
    values: dict[str, np.ndarray],
    row: int,
    run: dict[str, np.ndarray],
    recovery: StressRecovery | None,
    choice: IntegrationChoice,
) -> None:
    for name in MOTION:
        kind, direction = name.split("_")
        values[name][row] = run[kind][TIP_POINTS.index("leading_edge"), DIRECTIONS.index(direction)]
    for name in ("status", "worst_complementarity", "share_of_time_in_contact"):
        values[name][row] = run[name]
    # what the energy balance does not close, as a share of all that went in and out
    turned_over = abs(run["contact_work"]) + run["damping_loss"]
    values["energy_residual"][row] = run["energy_residual"] / turned_over if turned_over > 0.0 else 0.0
    if "max_wear" in run:
        values["max_wear"][row] = run["max_wear"]
    if recovery and len(run["snapshots"]):
        values["max_von_mises"][row] = recovery.max_von_mises(run["snapshots"]).max()
