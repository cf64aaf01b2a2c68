"""The time integration against SciPy's solve_ivp and against NLstep (docs/validation.md, section "Other programs").

NLstep needs GNU Octave and its own folder in the environment variable NLSTEP; without it the committed tables stay.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import Problem
from r37core.time_integration.simulate import Simulation

from .configuration import settings_of
from .equations_of_motion import (
    against_spring,
    bar_stiffness,
    blade_of,
    static_contact,
    with_static_modes,
    with_wear,
    without_yield,
)
from .massless_boundary import run_nlstep
from .pages import write_table

SPEED, SAMPLES, REVOLUTIONS = 1600.0, 200, 2
"""Speed (rad/s), samples per revolution and revolutions of the comparisons with solve_ivp."""

HIGHEST_FREQUENCY = 1e5
"""Modes up to it (Hz), in both programs, with solve_ivp: it takes steps of the fastest one."""

EXACT = {"rtol": 1e-9, "atol": 1e-13}
BARS = 1000
LIGHT_RUB = 1.1 * 3.56e-4
"""Height (m) of the lobes of the comparisons in direct contact, a tenth above the clearance: one light touch per lobe."""

MOVING_ABOVE = 6.4e-6
"""One over the angular frequency (s/rad) up to which modes move in comparisons with solve_ivp: as of `standard`."""


@cache
def shipped() -> Settings:
    """The shipped configuration."""
    return settings_of(Path.cwd(), scenes="all")


def scene_of(name: str, **casing: float) -> Scene:
    """A scene of the configuration, its casing lobed from the start."""
    scene = shipped().scenes[name].scene
    return replace(scene, casing=replace(scene.casing, **{"rise_fraction": 0.0} | casing))


def integrated(model: ContactModel, scene: Scene, step: float, revolutions: int, speed: float = SPEED, **choice: Any) -> Any:
    """Samples (m) of the leading edge's normal displacement, shape (samples,), the step (s) and the state at the end."""
    name = "direct" if scene.lining is None else "abradable"
    choice = {"samples_per_revolution": SAMPLES, "snapshot_revolutions": 0, "shorten": False} | choice
    chosen = replace(shipped().integration_choice("Ref", name, speed), time_step=step, revolutions=revolutions, **choice)
    simulation = Simulation(model, speed, scene, chosen)
    state = simulation.start()
    return simulation.advance(state, revolutions).samples[:, 0], simulation.problem.grid.time_step, state


def sample_times(speed: float, samples: int) -> np.ndarray:
    """Instants (s) of the first samples."""
    return (1 + np.arange(samples)) * 2.0 * np.pi / speed / SAMPLES


def error(ours: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference as a share of the largest value."""
    return np.abs(ours - exact).max() / np.abs(exact).max()


def with_orders(steps: Sequence[float], errors: Sequence[float]) -> list[list[str]]:
    """Cells of errors, and of the power of the step with which each fell from the one before."""
    orders = np.diff(np.log(errors)) / np.diff(np.log(steps))
    return [[f"{value:.1e}", of] for value, of in zip(errors, ["", *(f"{order:.1f}" for order in orders)], strict=True)]


def orders(
    model: ContactModel, scene: Scene, steps: np.ndarray, exact: np.ndarray, integrator: str, **choice: Any
) -> list[list[str]]:
    """Cells of the errors of runs at several steps, and of their order."""
    runs = [integrated(model, scene, step, REVOLUTIONS, integrator=integrator, **choice)[:2] for step in steps]
    return with_orders([step for _, step in runs], [error(ours, exact) for ours, _ in runs])


def at_t_n(model: ContactModel, scene: Scene, steps: np.ndarray) -> tuple[list[list[str]], float]:
    """The same with forces at t_n, against solve_ivp with the same static modes; their largest difference from each other."""
    blade, times = blade_of(model, SPEED, scene, np.inf), sample_times(SPEED, REVOLUTIONS * SAMPLES)
    runs = []
    choice = replace(shipped().integration_choice("Ref", "direct", SPEED), integrator=EXACT_MODAL, time_step=MOVING_ABOVE)
    blade = with_static_modes(blade, len(Problem(model, SPEED, scene, choice).blade.frequencies))
    stiffness = np.inf if scene.lining is None else bar_stiffness(blade)
    exact, checked = (static_contact(blade, times, stiffness, method, **EXACT) for method in ("DOP853", "LSODA"))
    for step in steps:
        moving = {"integrator": EXACT_MODAL, "static_above": step / MOVING_ABOVE}
        runs.append(integrated(model, scene, step, REVOLUTIONS, **moving)[:2])
    cells = with_orders([step for _, step in runs], [error(samples, exact) for samples, _ in runs])
    return cells, error(checked, exact)


def elastic(input: Any, output: Any, params: Any) -> None:
    """Bars that never yield. Input: model. Output: table."""
    model = read_contact_model(input.model)
    scene = scene_of("abradable")
    scene = replace(scene, lining=replace(scene.lining, yield_stress=1e30))
    steps = 6.4e-6 * 0.5 ** np.arange(7)
    ours, checked = at_t_n(model, scene, steps)
    bare, checked_bare = at_t_n(model, scene_of("direct", height=LIGHT_RUB), steps)
    exact = without_yield(
        blade_of(model, SPEED, scene, np.inf, HIGHEST_FREQUENCY), sample_times(SPEED, REVOLUTIONS * SAMPLES), **EXACT
    )
    published = [["", ""]] * 3 + orders(model, scene, steps[3:], exact, CENTRAL_DIFFERENCE, highest_frequency=HIGHEST_FREQUENCY)
    rows = [[f"{step:.1e}", *own, *other, *last] for step, own, other, last in zip(steps, ours, bare, published, strict=True)]
    rows.append(["DOP853 against LSODA", f"{checked:.0e}", "", f"{checked_bare:.0e}", "", "", ""])
    head = ["largest step (s)", "`exact_modal` on bars: error", "order", "on the bare casing: error", "order"]
    write_table([*head, "`central_difference` on bars: error", "order"], rows, output.table)


def worn(input: Any, output: Any, params: Any) -> None:
    """Bars that yield, few enough for steps that are short compared with the time on a bar. Input: model. Output: table."""
    model = read_contact_model(input.model)
    scene = scene_of("abradable")
    area = float(scene.lining.pressed_areas(model.tip_lengths, float(np.max(model.radius)))[0])
    few = replace(scene, lining=replace(scene.lining, bar_area=area))
    parts = 2 ** np.arange(2, 6)
    steps, motion, wear = on_yielding_bars(model, few, SPEED, parts)
    columns = [with_orders(steps, errors) for errors in (motion, wear)]
    rows = [[str(part), f"{step:.2e}", *chain(*cells)] for part, step, *cells in zip(parts, steps, *columns, strict=True)]
    write_table(["steps per bar", "step (s)", "motion", "order", "wear", "order"], rows, output.table)


def on_yielding_bars(
    model: ContactModel, scene: Scene, speed: float, parts: Sequence[int]
) -> tuple[list[float], list[float], list[float]]:
    """Steps (s) with so many `parts` on each of BARS bars, and errors of motion and wear of central differences there."""
    few = replace(scene, lining=replace(scene.lining, bars=BARS))
    times, on_a_bar = sample_times(speed, SAMPLES), 2.0 * np.pi / speed / BARS
    exact, wear = with_wear(blade_of(model, speed, few, np.inf, HIGHEST_FREQUENCY), times, **EXACT)
    choice = {"integrator": CENTRAL_DIFFERENCE, "highest_frequency": HIGHEST_FREQUENCY}
    runs = [integrated(model, few, on_a_bar / part, 1, speed, **choice) for part in parts]
    return [step for _, step, _ in runs], [error(run[0], exact) for run in runs], [error(run[2].wear, wear) for run in runs]


def material(input: Any, output: Any, params: Any) -> None:
    """The lining by its material on contact nodes that stand for different lengths of tip. Input: points, patches, other."""
    scene, rows, parts = scene_of("material_abradable"), [], (8, 32)
    for name, model, speed, length in (
        ("Ref, points", input.points, 1600.0, 1.585e-4),
        ("Ref, patches", input.patches, 1700.0, 5e-4),
        ("CS50, points", input.other, 1500.0, 5e-5),
    ):
        lining = replace(scene.lining, contact_length=length)
        _, motion, wear = on_yielding_bars(read_contact_model(model), replace(scene, lining=lining), speed, parts)
        cells = [f"{share:.1e}" for pair in zip(motion, wear, strict=True) for share in pair]
        rows.append([name, f"{speed:.0f}", f"{1e3 * length:.3g}", *cells])
    errors = [f"{part} steps per bar: {what}" for part in parts for what in ("motion", "wear")]
    write_table(["blade", "speed (rad/s)", "contact length (mm)", *errors], rows, output.table)


def direct(input: Any, output: Any, params: Any) -> None:
    """Direct contact of nodes with mass, the casing replaced by springs, damped or not. Input: model. Output: table."""
    model = read_contact_model(input.model)
    scene, half = scene_of("direct", height=LIGHT_RUB), SAMPLES // 2
    blade, times = blade_of(model, SPEED, scene, np.inf, HIGHEST_FREQUENCY), sample_times(SPEED, half)
    choice = {"highest_frequency": HIGHEST_FREQUENCY, "integrator": CENTRAL_DIFFERENCE}
    ours, coarse = (integrated(model, scene, step, 1, **choice)[0][:half] for step in (1e-7, 2e-7))
    stiffnesses, tolerances = (1e7, 1e8, 1e9, 1e10, 1e11), {"rtol": 1e-6, "atol": 1e-12}
    without, damped = ([against_spring(blade, times, k, ratio, **tolerances) for k in stiffnesses] for ratio in (0.0, 2.0))
    rows = [
        [f"{k:.0e}", f"{100.0 * error(bare, ours):.2f}%", f"{100.0 * error(damp, ours):.2f}%"]
        for k, bare, damp in zip(stiffnesses, without, damped, strict=True)
    ]
    rows.append(["extrapolated", *(share_at(limit(run), ours) for run in (without, damped))])
    rows.append(["central differences at twice the step", *2 * [f"{100.0 * error(coarse, ours):.2f}%"]])
    write_table(["stiffness (N/m)", "springs alone: difference", "with dashpots: difference"], rows, output.table)


def limit(runs: Sequence[np.ndarray]) -> np.ndarray | None:
    """Where the last three of several histories lead, if each comes nearer by the same factor; None where they do not."""
    before, last = (np.abs(near - far).max() for near, far in zip(runs[-3:-1], runs[-2:], strict=True))
    factor = before / last
    return runs[-1] + (runs[-1] - runs[-2]) / (factor - 1.0) if factor > 1.5 else None


def share_at(history: np.ndarray | None, ours: np.ndarray) -> str:
    """The difference as text."""
    return "no limit" if history is None else f"{100.0 * error(history, ours):.2f}%"


def histories(input: Any, output: Any, params: Any) -> None:
    """NLstep and the time integration on the first light touch, for several numbers of modes. Input: model. Output: table."""
    model = read_contact_model(input.model)
    scene, half = scene_of("direct", height=LIGHT_RUB), SAMPLES // 2
    blade, rows = blade_of(model, SPEED, scene, np.inf), []
    for moving_above in (9.6e-6, 6.4e-6, 3.2e-6, 2.4e-6):
        choice = {"integrator": EXACT_MODAL, "static_above": 2e-7 / moving_above}
        chosen = replace(shipped().integration_choice("Ref", "direct", SPEED), time_step=2e-7, **choice)
        modes = len(Problem(model, SPEED, scene, chosen).blade.frequencies)
        ours = integrated(model, scene, 2e-7, 1, **choice)[0][:half]
        cells = [str(modes), f"{blade.frequencies[modes - 1] / 2e3 / np.pi:.0f}"]
        for parts in (50, 100):
            theirs = run_nlstep(blade, modes, parts, SAMPLES, half)[0]
            cells.append(f"{100.0 * error(theirs, ours):.2f}%")
        rows.append(cells)
    steps = [f"difference at {2.0 * np.pi / SPEED / SAMPLES / parts:.1e} s" for parts in (50, 100)]
    write_table(["modes with mass", "up to (kHz)", *steps], rows, output.table)


RMS_REVOLUTIONS = 20
RMS_CASES = [(speed, 6.4e-6, 8) for speed in (1000.0, 1200.0, 1340.0, 1400.0, 1600.0, 1800.0)]
RMS_CASES += [(speed, 3.2e-6, 16) for speed in (1000.0, 1200.0, 1340.0, 1400.0)]
"""Speeds (rad/s), steps of ours (s), from which the modes with mass follow, and NLstep's steps per sample."""

PERTURBED = 1.0 + 1e-3 * np.arange(-2, 3)
"""Factors of the friction coefficient: what so little does to a run's rms."""


def rms(input: Any, output: Any, params: Any) -> None:
    """Rms of the last half of runs in direct contact, the casing rising, in NLstep and ours: the same modes have mass."""
    model, scene, rows = read_contact_model(input.model), scene_of("direct", rise_fraction=0.2), []
    for speed, step, parts in RMS_CASES:
        ours = []
        for factor in PERTURBED:
            rubbed = replace(scene, friction=replace(scene.friction, coefficient=factor * scene.friction.coefficient))
            ours.append(rms_of(integrated(model, rubbed, step, RMS_REVOLUTIONS, speed)[0]))
        choice = replace(shipped().integration_choice("Ref", "direct", speed), time_step=step)
        modes = len(Problem(model, speed, scene, choice).blade.frequencies)
        blade = blade_of(model, speed, scene, RMS_REVOLUTIONS * 2.0 * np.pi / speed)
        theirs = rms_of(run_nlstep(blade, modes, parts, SAMPLES, RMS_REVOLUTIONS * SAMPLES)[0])
        cells = [f"{speed:g}", str(modes), str(parts * SAMPLES), f"{1e3 * theirs:.4f}", f"{1e3 * np.mean(ours):.4f}"]
        rows.append(
            [*cells, f"{100.0 * (theirs / np.mean(ours) - 1.0):+.1f}%", f"{1e3 * min(ours):.4f} to {1e3 * max(ours):.4f}"]
        )
    head = ["speed (rad/s)", "modes with mass", "steps of NLstep per revolution", "its rms (mm)", "ours (mm)", "difference"]
    write_table([*head, "five of ours with up to 0.2% more or less friction"], rows, output.table)


def rms_of(samples: np.ndarray) -> float:
    """Rms of the last half."""
    return float(np.sqrt(np.mean(samples[len(samples) // 2 :] ** 2)))
