"""How fast the time integration is, against plain ways to write it: ratios inside one run, on the reference blade.

Run: make bench   (builds the reduced model first; about three minutes). Writes integration_speed.json beside this file and the
tables of docs/speed.md into results/studies. Fails if results of the ways differ by more than round-off.
"""

import copy
import json
import os
import platform
import time
from dataclasses import replace
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from plain_integration import PlainProblem

from r37core.config import checked_scene
from r37core.io import write_text
from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE
from r37core.time_integration.simulate import Simulation

ROOT = Path(__file__).parents[2]
SPEEDS = (900.0, 1344.0, 1660.0)
GRID = np.arange(750.0, 2000.0, 62.5)
STEP = 1e-7
"""The published step (s)."""

LINING = {
    "thickness_m": 5e-3,
    "elastic_modulus_pa": 20e9,
    "plastic_modulus_pa": 5e9,
    "yield_stress_pa": 1.5,
    "bar_width_m": 0.028,
    "rings": "shared",
}
"""One shared ring of wide bars: more contact, and more expensive, than in the shipped scenes."""
SCENES = {
    f"{name}{', constant friction' if form == 'constant' else ''}": checked_scene(
        {"casing": {"clearance_m": 3.56e-4}, "friction": {"coefficient": 0.15, "form": form}} | lining
    )
    for form in ("vector", "constant")
    for name, lining in (("abradable", {"lining": LINING}), ("direct", {}))
}
CHOICE = IntegrationChoice(STEP, 200, 496, CENTRAL_DIFFERENCE, "compiled")

SETTLED = 40
ROUNDS = 3
WAYS = ("dense NumPy, recursion alone", "scalar modes, numba", "r37, every step", "r37, jumps")
DENSE, SCALAR, STEPPING, JUMPING = WAYS


def main():
    model = read_contact_model(ROOT / "results/Ref/contact_pressure_edge.npz")
    cases = [compare(model, scene, name, speed) for name, scene in SCENES.items() for speed in SPEEDS]
    grids = {name: over_grid(model, scene) for name, scene in SCENES.items()}
    report = {
        "machine": machine(),
        "modes": len(model.squared_frequencies),
        "nodes": model.displacement_operator.shape[1],
        "step_s": STEP,
        "cases": cases,
        "speed_grid": grids,
    }
    (Path(__file__).parent / "integration_speed.json").write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    text = tables(report)
    print(text)
    write_text(text + "\n", ROOT / "results/studies/integration_speed.md")


def settled(model, scene, speed, jumps):
    """A time integration and its state after some revolutions: the timed ones are like most of a run."""
    simulation = Simulation(model, speed, scene, replace(CHOICE, jumps=jumps))
    state = simulation.start()
    simulation.advance(state, SETTLED)
    return simulation, state


def compare(model, scene, name, speed):
    """Nanoseconds per step of each way, from the same state, the best of some rounds that take turns."""
    stepping, state = settled(model, scene, speed, jumps=False)
    jumping = Simulation(model, speed, scene, CHOICE)
    problem = stepping.problem
    plain = PlainProblem(problem)
    first, steps = SETTLED * problem.grid.steps_per_revolution, problem.grid.steps_per_revolution
    best = dict.fromkeys(WAYS, np.inf)
    answers = {}
    for _ in range(ROUNDS):
        for way in WAYS:
            trial = copy.deepcopy(state)
            wear = np.zeros((1, 1)) if trial.wear is None else trial.wear
            u, d = trial.displacement, trial.increment
            count = steps
            start = time.process_time()
            if way == DENSE:
                count = steps // 20
                plain.dense_recursion_numpy(problem.blade.modes @ u, problem.blade.modes @ d, count)
            elif way == SCALAR:
                plain.modal(u, d, wear, first, steps)
            else:
                (stepping if way == STEPPING else jumping).advance(trial, 1)
            best[way] = min(best[way], (time.process_time() - start) * 1e9 / count)
            answers[way] = u
            if way == JUMPING:
                contact, jumped = (gained(trial, state, total) / steps for total in ("steps_in_contact", "steps_jumped"))
    for way in (SCALAR, JUMPING):
        np.testing.assert_allclose(answers[way], answers[STEPPING], rtol=0, atol=1e-9 * np.abs(answers[STEPPING]).max())
    return {"scene": name, "speed": speed, "contact": contact, "jumped": jumped, "ns_per_step": best}


def gained(after, before, total):
    """What a total grew by between two states."""
    return float(after.totals[total] - before.totals[total])


def over_grid(model, scene):
    """Mean cost over the published range of speeds, with jumps and without, in turns."""
    spent, steps, contact = {True: 0.0, False: 0.0}, 0.0, 0.0
    for speed in GRID:
        for jumps in (True, False):
            simulation, state = settled(model, scene, float(speed), jumps)
            before = copy.deepcopy(state)
            start = time.process_time()
            simulation.advance(state, 8)
            spent[jumps] += time.process_time() - start
        steps += gained(state, before, "steps")
        contact += gained(state, before, "steps_in_contact")
    return {"contact": contact / steps, "every_step_ns": spent[False] * 1e9 / steps, "jumps_ns": spent[True] * 1e9 / steps}


def machine():
    """Processor, and whether it has 512-bit vectors."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace")
    except OSError:
        return platform.processor() or platform.machine()
    name = next((line.split(":")[1].strip() for line in text.splitlines() if line.startswith("model name")), platform.machine())
    return f"{name}, {'with' if 'avx512f' in text else 'without'} AVX-512"


def tables(report):
    size = f"{report['modes']} modes, {report['nodes']} nodes, steps of {report['step_s']:g} s"
    lines = [
        f"Machine: {report['machine']}; {size}. Nanoseconds per step.",
        "",
        "| scene | rad/s | steps in contact | " + " | ".join(WAYS) + " | times (a) | times (b) |",
        "|---" * 9 + "|",
    ]
    for case in report["cases"]:
        times = [case["ns_per_step"][way] for way in WAYS]
        cells = [case["scene"], f"{case['speed']:g}", f"{100 * case['contact']:.0f}%", *[f"{t:,.0f}" for t in times]]
        lines.append("| " + " | ".join([*cells, f"{times[0] / times[3]:.0f}", f"{times[1] / times[3]:.1f}"]) + " |")
    lines += [
        "",
        "| scene, 20 speeds from 750 to 1940 rad/s | steps in contact | every step | jumps | ratio |",
        "|---|---|---|---|---|",
    ]
    for name, grid in report["speed_grid"].items():
        ratio = grid["jumps_ns"] / grid["every_step_ns"]
        lines.append(
            f"| {name} | {100 * grid['contact']:.0f}% | {grid['every_step_ns']:.1f} | {grid['jumps_ns']:.1f} | {ratio:.2f} |"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    main()
