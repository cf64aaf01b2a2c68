"""What the time integration of a run-up costs beside that of a run at constant speed: table of docs/run_ups.md.

Run: make claims ONLY=run_up_cost (under a minute). CPU times, in turns in one process.
"""

import os
import time
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from r37core.io import write_text
from r37core.product.reading import read_settings
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.run_ups.integration import RunUpIntegration
from r37core.run_ups.schedule import RunUp
from validation.studies.tables import markdown_table
from r37core.time_integration import compiled
from r37core.time_integration.simulate import Simulation

ROOT = Path(__file__).parents[2]
SCENES, RATES = ("abradable", "direct"), (30.0, 100.0, 300.0, 1000.0)
FROM, TO = 1644.0, 1786.0
"""Speeds (rad/s) of config/run_ups.yaml, about 1B/4 of the reference blade."""

BEFORE, AFTER, ROUNDS = 200, 50, 5


class Cost(NamedTuple):
    """CPU times (s) of a time integration with the start of its simulation, and of its compiled steps alone; its totals."""

    whole: float
    steps: float
    totals: np.ndarray

    @property
    def per_step(self):
        """CPU times per step (s): of the whole, and of the compiled steps."""
        return np.array([self.whole, self.steps]) / self.totals["steps"]

    def share(self, name):
        """Share of the steps that a total counts."""
        return f"{100.0 * self.totals[name] / self.totals['steps']:.0f}%"


def main():
    settings = read_settings(ROOT)
    model = contact_model(read_reduced_model(ROOT / "results/Ref/rom_pressure_edge.nc"), settings.structure.boundary.tip_line)
    rows = [row(settings, model, scene, rate) for scene in SCENES for rate in RATES]
    head = ["scene", "rate (rad/s2)", "steps", "jumped: run-up, constant", "in contact: run-up, constant"]
    head += ["CPU time per step (ns)", "per step at constant speed (ns)", "ratio", "ratio of the compiled steps"]
    head += ["beside the compiled steps", "the same at constant speed", "ratio for the same motion"]
    note = f"{FROM:g} to {TO:g} rad/s, {BEFORE} revolutions before and {AFTER} after; medians of {ROUNDS} rounds."
    write_text(f"{markdown_table(head, rows)}\n{note}\n", ROOT / "results/studies/run_up_cost.md")


def row(settings, model, scene, rate):
    """Cells of one run-up and of runs at its mean speed."""
    choice = settings.integration_choice("Ref", scene, FROM)
    run_up = RunUp(FROM, TO, (TO**2 - FROM**2) / (4.0 * np.pi * rate), BEFORE, AFTER, False)
    scene_of = settings.scenes[scene].scene
    lasting = round(run_up.revolutions) + BEFORE + AFTER
    constant = replace(choice, revolutions=lasting)

    def change():
        integration = RunUpIntegration(model, scene_of, choice, run_up)
        for _ in integration.segments():
            pass
        return integration.state.totals

    def same():
        simulation = Simulation(model, 0.5 * (FROM + TO), scene_of, constant)
        state = simulation.start()
        simulation.advance(state, lasting)
        return state.totals

    change(), same()
    rounds = [(cost(change), cost(same)) for _ in range(ROUNDS)]
    changing, holding = (np.median([pair[which].per_step for pair in rounds], axis=0) for which in range(2))
    ratio, of_steps = np.median([ours.per_step / theirs.per_step for ours, theirs in rounds], axis=0)
    beside, beside_constant = (
        np.median([both[which].whole / both[which].steps - 1.0 for both in rounds]) for which in range(2)
    )
    first, second = rounds[0]
    cells = [scene, f"{rate:g}", f"{first.totals['steps']:.0f}"]
    cells += [f"{first.share(name)}, {second.share(name)}" for name in ("steps_jumped", "steps_in_contact")]
    cells += [f"{1e9 * changing[0]:.0f}", f"{1e9 * holding[0]:.0f}", f"{ratio:.2f}", f"{of_steps:.2f}"]
    cells += [f"{100.0 * beside:.0f}%", f"{100.0 * beside_constant:.0f}%", f"{(1.0 + beside) / (1.0 + beside_constant):.2f}"]
    print(cells, flush=True)
    return cells


def cost(integrate):
    """What a time integration costs."""
    with timed_steps() as steps:
        began = time.process_time()
        totals = integrate()
        return Cost(time.process_time() - began, sum(steps), totals)


@contextmanager
def timed_steps():
    """A list that gets the CPU time (s) of every call of a compiled time integration."""
    taken, program = [], compiled._program

    def timed(layout, kind):
        advance = program(layout, kind)

        def call(record):
            began = time.process_time()
            done = advance(record)
            taken.append(time.process_time() - began)
            return done

        return call

    compiled._program = timed
    try:
        yield taken
    finally:
        compiled._program = program


if __name__ == "__main__":
    main()
