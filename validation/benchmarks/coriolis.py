"""What the Coriolis force changes for the seven blades, and what it costs: tables and picture of docs/coriolis.md.

Run: make claims ONLY=coriolis (about ten minutes), which makes the reduced models with structure.coriolis: true. Everything is
run with the force and without, from the same reduced models.
"""

import os
import time
from dataclasses import replace
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from r37core.figures.style import PAGE, plt
from r37core.io import write_text
from r37core.product.reading import read_settings
from validation.published import INTERACTIONS
from r37core.results.campbell import campbell_diagram
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model
from validation.studies.tables import markdown_table
from r37core.time_integration.gyroscopic import LARGEST_TURN
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

ROOT = Path(__file__).parents[2]
STUDIES = ROOT / "results/studies"
LINED, DIRECT = "abradable", "direct"
KEPT = {"spectrum_highest_order": 1, "wear_angles": 8}
BEFORE, AFTER = 15, 25
"""Speeds, in rad/s, about a published peak."""

DIRECT_SHARES = np.linspace(0.98, 1.06, 17)
"""Of the crossing of 1B with order 4."""

FREQUENCIES = 10

GRID = np.arange(800.0, 2000.0, 50.0)
ROUNDS = 3


def main():
    settings = read_settings(ROOT)
    models = {blade: models_of(blade, settings) for blade in settings.blades}
    write_text(frequencies_table(settings, models), STUDIES / "coriolis_frequencies.md")
    write_text(peaks_table(settings, models), STUDIES / "coriolis_peaks.md")
    write_text(cost_table(settings, models["Ref"]), STUDIES / "coriolis_cost.md")
    write_text(direct_table(settings, models), STUDIES / "coriolis_direct.md")


def models_of(blade, settings):
    """Reduced models of a blade without the Coriolis matrix and with it, each with its contact model."""
    model = read_reduced_model(ROOT / f"results/{blade}/rom_pressure_edge.nc")
    return [(rom, contact_model(rom, settings.structure.boundary.tip_line)) for rom in (replace(model, coriolis=None), model)]


def run(settings, blade, contact, scene, speed):
    """A run at a speed (rad/s) as the sweep does it, without stress."""
    choice = replace(settings.integration_choice(blade, scene, speed), snapshot_revolutions=0)
    return run_speed(contact, float(speed), settings.scenes[scene].scene, choice, (), **KEPT)


def moved(result):
    """Rms (m) of the leading edge's normal and tangential motion together: one blade hardly moves towards the casing."""
    return float(np.hypot(*result["rms"][0, [0, 2]]))


def crossing(model, order):
    """Speed (rad/s) at which 1B has the frequency of an engine order."""
    return campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array([order]))[0, 0]


def frequencies_table(settings, models):
    """Shift of the first ten frequencies at the highest speed, and what the modes that are not coupled leave out of it."""
    rows, speed = [], settings.structure.maximum_speed_rad_s
    for blade, ((without, _), (model, contact)) in models.items():
        exact = model.modes(speed, FREQUENCIES)[0]
        shift = exact / without.modes(speed, FREQUENCIES)[0] - 1.0
        cells = [blade, f"{100.0 * shift[0]:+.3f}%", f"{100.0 * shift[np.abs(shift).argmax()]:+.3f}%"]
        for scene in (LINED, DIRECT):
            choice = settings.integration_choice(blade, scene, speed)
            problem = Simulation(contact, speed, settings.scenes[scene].scene, choice).problem
            turns = problem.blade.frequencies * problem.grid.time_step
            left_out = np.abs(problem.blade.complex_modes.frequencies[:FREQUENCIES] / exact - 1.0).max()
            cells += [f"{np.count_nonzero(turns <= LARGEST_TURN)} of {len(contact.squared_frequencies)}", f"{left_out:.0e}"]
        rows.append(cells)
    head = ["blade", "1B", "largest of ten", "coupled modes, lined", "off by up to", "coupled modes, direct", "off by up to"]
    return markdown_table(head, rows)


def peaks_table(settings, models):
    """Peaks of the ten published interactions, every 1 rad/s about them; draws those of order 4, too."""
    rows = []
    figure, panels = plt.subplots(1, len(models), figsize=(PAGE, 1.9), sharey=True)
    axes_of = dict(zip(models, panels, strict=True))
    for row in INTERACTIONS:
        speeds = np.arange(round(row.peak) - BEFORE, round(row.peak) + AFTER + 1.0)
        cells = [f"{row.blade} 1B/{row.engine_order}"]
        crossings = [crossing(model, row.engine_order) for model, _ in models[row.blade]]
        rms = [[moved(run(settings, row.blade, contact, LINED, v)) for v in speeds] for _, contact in models[row.blade]]
        peaks = [int(np.argmax(values)) for values in rms]
        cells += [f"{crossings[0]:.1f}", f"{crossings[1] - crossings[0]:+.1f}", f"{speeds[peaks[0]]:.0f}"]
        cells += [f"{speeds[peaks[1]] - speeds[peaks[0]]:+.0f}", f"{1e3 * rms[0][peaks[0]]:.2f}"]
        cells += [f"{100.0 * (rms[1][peaks[1]] / rms[0][peaks[0]] - 1.0):+.1f}%"]
        rows.append(cells)
        print(cells, flush=True)
        if row.engine_order == 4:
            axes = axes_of[row.blade]
            for values, label in zip(rms, ("without", "with"), strict=True):
                axes.plot(speeds, 1e3 * np.array(values), label=label)
            axes.set(title=row.blade, xlabel="rad/s")
    panels[0].set_ylabel("rms (mm)")
    panels[0].legend()
    (STUDIES / "figures").mkdir(parents=True, exist_ok=True)
    figure.savefig(STUDIES / "figures/coriolis_peaks.png")
    head = ["interaction", "crossing without (rad/s)", "change", "peak without (rad/s)", "change", "its rms (mm)", "change"]
    return markdown_table(head, rows)


def direct_table(settings, models):
    """Direct contact about the crossing of 1B with order 4: means over the speeds, which little moves less than single runs."""
    rows = []
    for blade, pair in models.items():
        speeds = DIRECT_SHARES * crossing(pair[0][0], 4)
        runs = [[run(settings, blade, contact, DIRECT, speed) for speed in speeds] for _, contact in pair]
        rms = np.array([[1e3 * each["rms"][0, [0, 2]] for each in of_model] for of_model in runs])
        cells = [blade, f"{speeds[0]:.0f} to {speeds[-1]:.0f}"]
        for direction in range(2):
            without, with_force = rms[..., direction].mean(axis=1)
            cells += [f"{without:.4f}", f"{100.0 * (with_force / without - 1.0):+.1f}%"]
        rows.append(cells)
        print(cells, flush=True)
    head = ["blade", "speeds (rad/s)", "normal rms, mean, without (mm)", "change", "tangential", "change"]
    return markdown_table(head, rows)


def cost_table(settings, pair):
    """Ratio of CPU times of whole runs and of the time integration alone, the reference blade, in turns in one process."""
    rows = []
    for scene in (LINED, DIRECT):
        ratios = np.array([timed(settings, pair, scene, speed) for speed in GRID for _ in range(ROUNDS)])
        for what, column in (("whole run", 0), ("time integration", 1)):
            low, middle, high = np.percentile(ratios[:, column], [10, 50, 90])
            rows.append([scene, what, f"{middle:.2f}", f"{low:.2f} to {high:.2f}"])
        print(rows[-2:], flush=True)
    note = f"{len(GRID)} speeds from {GRID[0]:g} to {GRID[-1]:g} rad/s, {ROUNDS} rounds."
    return f"{markdown_table(['scene', 'of', 'ratio of CPU times, median', '10% to 90%'], rows)}\n{note}\n"


def timed(settings, pair, scene, speed):
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


if __name__ == "__main__":
    main()
