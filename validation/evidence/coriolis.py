"""The Coriolis force: what it changes for the seven blades, and what it costs.

The reduced models have the Coriolis matrix. Each run is made with it and without it, from the same model.
"""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from published import INTERACTIONS

from r37core.config import Settings
from r37core.results.campbell import campbell_diagram
from r37core.rom.contact_model import ContactModel
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.time_integration.gyroscopic import LARGEST_TURN
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .pages import write_table

Models = tuple[ReducedModel, ContactModel]

SCENES = {"abradable lining": "abradable", "bare casing": "direct"}
FREQUENCIES = 10

BEFORE, AFTER = 15, 25
"""Speeds, in rad/s, about a published peak."""

SHARES = np.linspace(0.98, 1.06, 17)
"""Speeds on the bare casing, as shares of the crossing of 1B with engine order 4."""

TIMED = np.arange(800.0, 2000.0, 50.0)
ROUNDS = 3


def models(files: list[str], tip_line: str) -> dict[str, list[Models]]:
    """Blade -> its models without the Coriolis matrix and with it."""
    read = {Path(file).parent.name: read_reduced_model(file) for file in files}
    return {
        blade: [(rom, contact_model(rom, tip_line)) for rom in (replace(model, coriolis=None), model)]
        for blade, model in read.items()
    }


def frequencies(input: Any, output: Any, params: Any) -> None:
    """Table of the shift of ten frequencies at the highest speed, and of what uncoupled modes leave out of it."""
    settings = settings_of(Path.cwd())
    rows, speed = [], settings.structure.maximum_speed_rad_s
    for blade, ((without, _), (model, contact)) in models(input.models, settings.structure.boundary.tip_line).items():
        exact = model.modes(speed, FREQUENCIES)[0]
        shift = exact / without.modes(speed, FREQUENCIES)[0] - 1.0
        cells = [blade, f"{100.0 * shift[0]:+.3f}%", f"{100.0 * shift[np.abs(shift).argmax()]:+.3f}%"]
        for scene in SCENES.values():
            choice = settings.integration_choice(blade, scene, speed)
            problem = Simulation(contact, speed, settings.scenes[scene].scene, choice).problem
            turns = problem.blade.frequencies * problem.grid.time_step
            left_out = np.abs(problem.blade.complex_modes.frequencies[:FREQUENCIES] / exact - 1.0).max()
            cells += [f"{np.count_nonzero(turns <= LARGEST_TURN)} of {len(contact.squared_frequencies)}", f"{left_out:.0e}"]
        rows.append(cells)
    head = ["blade", "1B", "largest of ten", "coupled, lining", "error up to", "coupled, bare casing", "error up to"]
    write_table(head, rows, output.table)


def peaks(input: Any, output: Any, params: Any) -> None:
    """Table of the peaks of the ten published interactions, every 1 rad/s."""
    settings, rows = settings_of(Path.cwd()), []
    pairs = models(input.models, settings.structure.boundary.tip_line)
    for row in INTERACTIONS:
        speeds, pair = np.arange(round(row.peak) - BEFORE, round(row.peak) + AFTER + 1.0), pairs[row.blade]
        crossings = [_crossing(model, row.engine_order) for model, _ in pair]
        rms = [[_motion(_run(settings, row.blade, contact, "abradable", v)) for v in speeds] for _, contact in pair]
        highest = [int(np.argmax(values)) for values in rms]
        rows.append(
            [
                f"{row.blade} 1B/{row.engine_order}",
                f"{crossings[0]:.1f}",
                f"{crossings[1] - crossings[0]:+.1f}",
                f"{speeds[highest[0]]:.0f}",
                f"{speeds[highest[1]] - speeds[highest[0]]:+.0f}",
                f"{1e3 * rms[0][highest[0]]:.2f}",
                f"{100.0 * (rms[1][highest[1]] / rms[0][highest[0]] - 1.0):+.1f}%",
            ]
        )
    head = ["interaction", "crossing without (rad/s)", "change of crossing (rad/s)"]
    head += ["peak without (rad/s)", "change of peak (rad/s)", "its rms (mm)", "change of rms"]
    write_table(head, rows, output.table)


def bare_casing(input: Any, output: Any, params: Any) -> None:
    """Table of the bare casing about the crossing of 1B with engine order 4, as means over speeds."""
    settings, rows = settings_of(Path.cwd()), []
    for blade, pair in models(input.models, settings.structure.boundary.tip_line).items():
        speeds = SHARES * _crossing(pair[0][0], 4)
        runs = [[_run(settings, blade, contact, "direct", speed) for speed in speeds] for _, contact in pair]
        rms = np.array([[1e3 * each["rms"][0, [0, 2]] for each in some] for some in runs])
        cells = [blade, f"{speeds[0]:.0f} to {speeds[-1]:.0f}"]
        for direction in range(2):
            without, with_force = rms[..., direction].mean(axis=1)
            cells += [f"{without:.4f}", f"{100.0 * (with_force / without - 1.0):+.1f}%"]
        rows.append(cells)
    head = ["blade", "speeds (rad/s)", "normal rms, mean, without (mm)", "change", "tangential rms", "change"]
    write_table(head, rows, output.table)


def cost(input: Any, output: Any, params: Any) -> None:
    """Table of the CPU time with the force as a multiple of that without, of whole runs and of their steps, in turns."""
    settings, rows = settings_of(Path.cwd()), []
    pair = models(input.models, settings.structure.boundary.tip_line)["Ref"]
    for shown, scene in SCENES.items():
        ratios = np.array([_ratios(settings, pair, scene, speed) for speed in TIMED for _ in range(ROUNDS)])
        for what, column in (("whole run", 0), ("time integration", 1)):
            low, middle, high = np.percentile(ratios[:, column], [10, 50, 90])
            rows.append([shown, what, f"{middle:.2f}", f"{low:.2f} to {high:.2f}"])
    write_table(["scene", "part", "ratio of CPU times, median", "10% to 90%"], rows, output.table)


def _run(settings: Settings, blade: str, contact: ContactModel, scene: str, speed: float) -> dict[str, np.ndarray]:
    """A run at a speed (rad/s) as the sweep makes it, without stress."""
    choice = replace(settings.integration_choice(blade, scene, speed), snapshot_revolutions=0)
    kept = {"spectrum_highest_order": 1, "wear_angles": 8}
    return run_speed(contact, float(speed), settings.scenes[scene].scene, choice, (), **kept)


def _motion(result: dict[str, np.ndarray]) -> float:
    """Rms (m) of the leading edge's normal and tangential motion together: S100 hardly moves towards the casing."""
    return float(np.hypot(*result["rms"][0, [0, 2]]))


def _crossing(model: ReducedModel, order: int) -> float:
    """Speed (rad/s) at which 1B has the frequency of an engine order."""
    return campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array([order]))[0, 0]


def _ratios(settings: Settings, pair: list[Models], scene: str, speed: float) -> tuple[float, float]:
    """CPU time with the force as a multiple of that without: of a whole run, and of its steps."""
    whole, steps = [], []
    choice = settings.integration_choice("Ref", scene, speed)
    for _, contact in pair:
        began = time.process_time()
        simulation = Simulation(contact, float(speed), settings.scenes[scene].scene, choice)
        state = simulation.start()
        laid_out = time.process_time()
        simulation.advance(state, choice.revolutions)
        whole.append(time.process_time() - began)
        steps.append(time.process_time() - laid_out)
    return whole[1] / whole[0], steps[1] / steps[0]
