"""What a run costs: tables of docs/speed.md."""

from __future__ import annotations

import copy
import platform
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from r37core.base.io import as_list
from r37core.rom.contact_model import read_contact_model
from r37core.rom.reduction_choice import PATCHES
from r37core.time_integration.simulate import Simulation

from .accuracy import Of, Runs
from .configuration import settings_of
from .contact_runs import BARE, CENTRAL, LINED, MOST, SMALL, STEPS, USUAL
from .pages import write_table

LEVELS, SHOWN = ("standard", "paper"), ("time integration", "start-up", "workflow", "reduction")
SPEEDS = np.arange(800.0, 2000.0, 120.0)
"""Speeds (rad/s) of the time of a step."""

SETTLED, TIMED = 40, 8
"""Revolutions before those that are timed: these are like most of a run."""


def steps(input: Any, output: Any, params: Any) -> None:
    """Time of a step with jumps over free flight and without. Input: model, of the reference blade."""
    model, rows = read_contact_model(input.model), []
    for level in LEVELS:
        settings = settings_of(Path.cwd(), fidelity=level)
        for name in (BARE, LINED):
            times = [_times(model, settings, name, speed) for speed in SPEEDS]
            contact, jumping, stepping, modes = np.mean(times, axis=0)
            cells = [f"{modes:.0f}", f"{100.0 * contact:.0f}%", f"{stepping:.0f} ns", f"{jumping:.0f} ns"]
            rows.append([f"`{level}`", name, *cells])
    head = ["level", "scene", "modes stepped", "steps in contact", "a step, all stepped", "with jumps"]
    write_table(head, rows, output.table)
    print(machine())


def _times(model: Any, settings: Any, scene: str, speed: float) -> tuple[float, float, float, float]:
    """Share of the steps in contact, nanoseconds of a step with jumps and without, and modes that are stepped."""
    choice = settings.integration_choice("Ref", scene, speed)
    spent = []
    for jumps in (True, False):
        simulation = Simulation(model, speed, settings.scenes[scene].scene, replace(choice, jumps=jumps))
        state = simulation.start()
        simulation.advance(state, SETTLED)
        before, begun = copy.deepcopy(state), time.process_time()
        simulation.advance(state, TIMED)
        seconds = time.process_time() - begun
        steps, contact = (float(state.totals[key] - before.totals[key]) for key in ("steps", "steps_in_contact"))
        spent.append(1e9 * seconds / steps)
    return contact / steps, *spent, len(simulation.problem.blade.frequencies)


def machine() -> str:
    """Processor, for the log."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace")
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.split(":")[1].strip() for line in text.splitlines() if line.startswith("model name")), platform.machine())


def growth(input: Any, output: Any, params: Any) -> None:
    """How cost grows with mesh, step, revolutions and contact nodes: medians of CPU time. Input: files of contact_runs."""
    files = as_list(input.files)
    runs = Runs(files)
    every = pd.concat([pd.read_csv(file) for file in files])
    models = every[(every.what == "the model") & (every["count"] == USUAL) & (every.modes == 10) & (every.contact == PATCHES)]
    of_mesh = models.groupby("nodes").cpu_s.median()

    def cost(**changes: Any) -> float:
        return float(runs.of(Of(BARE, PATCHES, **changes), "cpu_s").median())

    of_step = pd.Series({step: cost(what=f"step {step:g} s") for step in STEPS} | {1e-7: cost(what=CENTRAL)})
    of_length = pd.Series({number: cost(what=f"{number} revolutions") for number in (100, 400)})
    counts = {4: 4, 8: 8, 12: USUAL, MOST: MOST}
    of_count = pd.Series({number: cost(nodes=SMALL, count=count) for number, count in counts.items()})
    grown = [
        ("reduced model", "nodes of the mesh", of_mesh),
        ("one run", "step (s)", of_step),
        ("one run", "revolutions", of_length),
        ("one run", "contact nodes", of_count),
    ]
    rows = [[cost_of, parameter, *_grown(costs)] for cost_of, parameter, costs in grown]
    write_table(["cost", "grows with", "range", "CPU from", "to", "exponent"], rows, output.table)


def _grown(costs: pd.Series) -> list[str]:
    """Range, both costs (s), and the exponent of the power law between the more expensive values."""
    costs = costs.sort_values()
    dearest = costs.iloc[-3:]
    exponent = np.polyfit(np.log(dearest.index.to_numpy(float)), np.log(dearest.to_numpy()), 1)[0]
    ends = [f"{cost:.3g} s" for cost in costs.iloc[[0, -1]]]
    return [f"{costs.index[0]:,g} to {costs.index[-1]:,g}", *ends, f"{exponent:.2f}"]


def campaign(input: Any, output: Any, params: Any) -> None:
    """Cost of all blades at every 1 rad/s, projected from a sample. Input: a table of the extension `estimate` per level."""
    rows = []
    for level, file in zip(LEVELS, as_list(input.files), strict=True):
        costs = pd.read_csv(file).set_index("part")
        total = costs.loc["total"]
        hours = [f"{costs.core_hours[part]:.2f}" for part in SHOWN]
        rows.append([f"`{level}`", f"{total.simulations:,.0f}", *hours, f"{total.wall_hours:.1f} h on {total.cores:.0f} cores"])
    write_table(["level", "simulations", *(f"{part} (core h)" for part in SHOWN), "all"], rows, output.table)
