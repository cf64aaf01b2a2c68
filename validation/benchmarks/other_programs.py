"""The time integration against SciPy's solve_ivp and against NLstep: tables of docs/validation.md, section "Other programs".

Run: make claims ONLY=other_programs, or python validation/benchmarks/other_programs.py [elastic worn direct histories rms]. The last two
need GNU Octave and NLSTEP=/path/to/NLstep: then make claims ONLY=nlstep TAKEN=yes. Ten minutes in all.
Cases that `rms` has a row of are not run again.
"""

import json
import os
import sys
from dataclasses import replace
from itertools import chain
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from equations_of_motion import (
    against_spring,
    bar_stiffness,
    blade_of,
    static_contact,
    with_static_modes,
    with_wear,
    without_yield,
)
from massless_boundary import run_nlstep

from r37core.io import write_text
from r37core.product.reading import read_settings
from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import Problem
from r37core.time_integration.simulate import Simulation
from validation.studies.tables import markdown_table

ROOT = Path(__file__).parents[2]
STUDIES = ROOT / "results/studies"
SPEED, SAMPLES, REVOLUTIONS = 1600.0, 200, 2
"""Speed (rad/s), samples per revolution and revolutions of the comparisons with solve_ivp."""

HIGHEST_FREQUENCY = 1e5
"""Modes up to it (Hz), in both programs, with solve_ivp: it takes steps of the fastest one."""

EXACT = {"rtol": 1e-9, "atol": 1e-13}
BARS = 1000
LIGHT_RUB = 1.1
"""Lobes of the comparisons in direct contact, in clearances: one light touch per lobe."""


def main():
    parts = sys.argv[1:] or ["elastic", "worn", "direct", "histories", "rms"]
    model, settings = read_contact_model(ROOT / "results/Ref/contact_pressure_edge.npz"), read_settings(ROOT)
    for name in parts:
        made = {"elastic": elastic, "worn": worn, "direct": direct, "histories": histories, "rms": rms}[name](model, settings)
        print(made, flush=True)
        write_text(made, STUDIES / f"other_programs_{name}.md")


def scene_of(settings, name, **casing):
    """A scene of the configuration, its casing lobed from the start."""
    scene = settings.scenes[name].scene
    return replace(scene, casing=replace(scene.casing, **{"rise_fraction": 0.0} | casing))


def integrated(model, settings, scene, step, revolutions, speed=SPEED, **choice):
    """Samples (m) of the leading edge's normal displacement, shape (samples,), the step (s) and the state at the end."""
    name = "direct" if scene.lining is None else "abradable"
    choice = {"samples_per_revolution": SAMPLES, "snapshot_revolutions": 0, "shorten": False} | choice
    chosen = replace(settings.integration_choice("Ref", name, speed), time_step=step, revolutions=revolutions, **choice)
    simulation = Simulation(model, speed, scene, chosen)
    state = simulation.start()
    return simulation.advance(state, revolutions).samples[:, 0], simulation.problem.grid.time_step, state


def sample_times(speed, samples):
    return (1 + np.arange(samples)) * 2.0 * np.pi / speed / SAMPLES


def error(ours, exact):
    """Largest difference as a share of the largest value."""
    return np.abs(ours - exact).max() / np.abs(exact).max()


def from_itself(coarse, fine):
    share = 100.0 * error(coarse, fine)
    return f"Central differences at 1e-7 s differ by {share:.2f}% from themselves at twice the step."


def with_orders(steps, errors):
    """Cells of errors, and of the power of the step with which each fell from the one before."""
    orders = np.diff(np.log(errors)) / np.diff(np.log(steps))
    return [[f"{value:.1e}", of] for value, of in zip(errors, ["", *(f"{order:.1f}" for order in orders)], strict=True)]


MOVING_ABOVE = 6.4e-6
"""One over the angular frequency (s/rad) up to which modes move in comparisons with solve_ivp: as of `standard`."""


def orders(model, settings, scene, steps, exact, integrator, **choice):
    """Cells of the errors of runs at several steps, and of their order."""
    runs = [integrated(model, settings, scene, step, REVOLUTIONS, integrator=integrator, **choice)[:2] for step in steps]
    return with_orders([step for _, step in runs], [error(ours, exact) for ours, _ in runs])


def at_t_n(model, settings, scene, steps):
    """The same with forces at t_n, against solve_ivp with the same static modes; their largest difference from each other."""
    blade, times = blade_of(model, SPEED, scene, np.inf), sample_times(SPEED, REVOLUTIONS * SAMPLES)
    runs = []
    choice = replace(settings.integration_choice("Ref", "direct", SPEED), integrator=EXACT_MODAL, time_step=MOVING_ABOVE)
    blade = with_static_modes(blade, len(Problem(model, SPEED, scene, choice).blade.frequencies))
    stiffness = np.inf if scene.lining is None else bar_stiffness(blade)
    exact, checked = (static_contact(blade, times, stiffness, method, **EXACT) for method in ("DOP853", "LSODA"))
    for step in steps:
        moving = {"integrator": EXACT_MODAL, "static_above": step / MOVING_ABOVE}
        runs.append(integrated(model, settings, scene, step, REVOLUTIONS, **moving)[:2])
    cells = with_orders([step for _, step in runs], [error(samples, exact) for samples, _ in runs])
    return cells, error(checked, exact)


def elastic(model, settings):
    """Bars that never yield."""
    scene = scene_of(settings, "abradable")
    scene = replace(scene, lining=replace(scene.lining, yield_stress=1e30))
    steps = 6.4e-6 * 0.5 ** np.arange(7)
    ours, checked = at_t_n(model, settings, scene, steps)
    bare, checked_bare = at_t_n(model, settings, scene_of(settings, "direct", amplitude=LIGHT_RUB), steps)
    exact = without_yield(
        blade_of(model, SPEED, scene, np.inf, HIGHEST_FREQUENCY), sample_times(SPEED, REVOLUTIONS * SAMPLES), **EXACT
    )
    published = [["", ""]] * 3 + orders(
        model, settings, scene, steps[3:], exact, CENTRAL_DIFFERENCE, highest_frequency=HIGHEST_FREQUENCY
    )
    rows = [[f"{step:.1e}", *own, *other, *last] for step, own, other, last in zip(steps, ours, bare, published, strict=True)]
    head = ["largest step (s)", "`exact_modal` on bars: error", "order", "in direct contact: error", "order"]
    note = f"DOP853 and LSODA, two methods of solve_ivp, differ by {checked:.0e} on bars, {checked_bare:.0e} in direct contact."
    return f"{markdown_table([*head, '`central_difference` on bars: error', 'order'], rows)}\n{note}\n"


def worn(model, settings):
    """Bars that yield, few enough for steps that are short beside the time on a bar."""
    scene = scene_of(settings, "abradable")
    area = scene.lining.area(float(np.max(model.radius)))
    few = replace(scene, lining=replace(scene.lining, bars=BARS, bar_area=area))
    times, on_a_bar = sample_times(SPEED, SAMPLES), 2.0 * np.pi / SPEED / BARS
    exact, wear = with_wear(blade_of(model, SPEED, few, np.inf, HIGHEST_FREQUENCY), times, **EXACT)
    parts, choice = 2 ** np.arange(2, 6), {"integrator": CENTRAL_DIFFERENCE, "highest_frequency": HIGHEST_FREQUENCY}
    runs = [integrated(model, settings, few, on_a_bar / part, 1, **choice) for part in parts]
    steps, columns = [step for _, step, _ in runs], []
    for errors in ([error(run[0], exact) for run in runs], [error(run[2].wear, wear) for run in runs]):
        columns.append(with_orders(steps, errors))
    rows = [[str(part), f"{on_a_bar / part:.2e}", *chain(*cells)] for part, *cells in zip(parts, *columns, strict=True)]
    return markdown_table(["steps per bar", "step (s)", "motion", "order", "wear", "order"], rows)


def direct(model, settings):
    """Direct contact of nodes with mass, the casing replaced by springs: with dashpots, which stop a node, and without."""
    scene, half = scene_of(settings, "direct", amplitude=LIGHT_RUB), SAMPLES // 2
    blade, times = blade_of(model, SPEED, scene, np.inf, HIGHEST_FREQUENCY), sample_times(SPEED, half)
    choice = {"highest_frequency": HIGHEST_FREQUENCY, "integrator": CENTRAL_DIFFERENCE}
    ours, coarse = (integrated(model, settings, scene, step, 1, **choice)[0][:half] for step in (1e-7, 2e-7))
    stiffnesses, tolerances = (1e7, 1e8, 1e9, 1e10, 1e11), {"rtol": 1e-6, "atol": 1e-12}
    without, damped = ([against_spring(blade, times, k, ratio, **tolerances) for k in stiffnesses] for ratio in (0.0, 2.0))
    rows = [
        [f"{k:.0e}", f"{100.0 * error(bare, ours):.2f}%", f"{100.0 * error(damp, ours):.2f}%"]
        for k, bare, damp in zip(stiffnesses, without, damped, strict=True)
    ]
    rows.append(["extrapolated", *(share_at(limit(run), ours) for run in (without, damped))])
    head = ["stiffness (N/m)", "springs alone: difference", "with dashpots: difference"]
    return f"{markdown_table(head, rows)}\n{from_itself(coarse, ours)}\n"


def limit(runs):
    """Where the last three of several histories lead, if each comes nearer by the same factor; None where they do not."""
    before, last = (np.abs(near - far).max() for near, far in zip(runs[-3:-1], runs[-2:], strict=True))
    factor = before / last
    return runs[-1] + (runs[-1] - runs[-2]) / (factor - 1.0) if factor > 1.5 else None


def share_at(history, ours):
    return "no limit" if history is None else f"{100.0 * error(history, ours):.2f}%"


def histories(model, settings):
    """NLstep and the time integration on the first light touch, with more and more modes that have mass in both."""
    scene, half = scene_of(settings, "direct", amplitude=LIGHT_RUB), SAMPLES // 2
    blade, rows = blade_of(model, SPEED, scene, np.inf), []
    for moving_above in (9.6e-6, 6.4e-6, 3.2e-6, 2.4e-6):
        choice = {"integrator": EXACT_MODAL, "static_above": 2e-7 / moving_above}
        chosen = replace(settings.integration_choice("Ref", "direct", SPEED), time_step=2e-7, **choice)
        modes = len(Problem(model, SPEED, scene, chosen).blade.frequencies)
        ours = integrated(model, settings, scene, 2e-7, 1, **choice)[0][:half]
        cells = [str(modes), f"{blade.frequencies[modes - 1] / 2e3 / np.pi:.0f}"]
        for parts in (50, 100):
            theirs = run_nlstep(blade, modes, parts, SAMPLES, half)[0]
            cells.append(f"{100.0 * error(theirs, ours):.2f}%")
        rows.append(cells)
    steps = [f"difference at {2.0 * np.pi / SPEED / SAMPLES / parts:.1e} s" for parts in (50, 100)]
    return markdown_table(["modes with mass", "up to (kHz)", *steps], rows)


RMS_REVOLUTIONS = 20
RMS_CASES = [(speed, 6.4e-6, 8) for speed in (1000.0, 1200.0, 1340.0, 1400.0, 1600.0, 1800.0)]
RMS_CASES += [(speed, 3.2e-6, 16) for speed in (1000.0, 1200.0, 1340.0, 1400.0)]
"""Speeds (rad/s), steps of ours (s), from which the modes with mass follow, and NLstep's steps per sample."""

PERTURBED = 1.0 + 1e-3 * np.arange(-2, 3)
"""Factors of the friction coefficient: what so little does to a run's rms."""


def rms(model, settings):
    """Rms of the last half of runs in direct contact, the casing rising, in NLstep and ours: the same modes have mass."""
    scene, file = scene_of(settings, "direct", rise_fraction=0.2), STUDIES / "other_programs_rms.json"
    rows = json.loads(file.read_text()) if file.exists() else {}
    for speed, step, parts in RMS_CASES:
        if (name := f"{speed:g}, {step:g} s") in rows:
            continue
        duration = RMS_REVOLUTIONS * 2.0 * np.pi / speed
        ours = []
        for factor in PERTURBED:
            rubbed = replace(scene, friction=replace(scene.friction, coefficient=factor * scene.friction.coefficient))
            ours.append(rms_of(integrated(model, settings, rubbed, step, RMS_REVOLUTIONS, speed)[0]))
        choice = replace(settings.integration_choice("Ref", "direct", speed), time_step=step)
        modes = len(Problem(model, speed, scene, choice).blade.frequencies)
        samples = RMS_REVOLUTIONS * SAMPLES
        theirs = run_nlstep(blade_of(model, speed, scene, duration), modes, parts, SAMPLES, samples)[0]
        cells = [f"{speed:g}", str(modes), str(parts * SAMPLES), f"{1e3 * rms_of(theirs):.4f}", f"{1e3 * np.mean(ours):.4f}"]
        cells += [f"{100.0 * (rms_of(theirs) / np.mean(ours) - 1.0):+.1f}%", f"{1e3 * min(ours):.4f} to {1e3 * max(ours):.4f}"]
        rows[name] = cells
        write_text(json.dumps(rows), file)
    head = [
        "speed (rad/s)",
        "modes with mass",
        "steps of NLstep per revolution",
        "its rms (mm)",
        "ours (mm)",
        "difference",
        "five of ours with up to 0.2% more or less friction",
    ]
    return markdown_table(head, [rows[f"{speed:g}, {step:g} s"] for speed, step, _ in RMS_CASES])


def rms_of(samples):
    return float(np.sqrt(np.mean(samples[len(samples) // 2 :] ** 2)))


if __name__ == "__main__":
    main()
