"""The time integration against SciPy's solve_ivp (docs/validation.md, section "Other programs")."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
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
from .equations_of_motion import bar_stiffness, blade_of, static_contact, with_static_modes, with_wear
from .tables import write_table

SPEED, SAMPLES, REVOLUTIONS = 1600.0, 200, 1
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
    """A scene of the configuration, its casing lobed from the start, its friction along the sliding."""
    scene = shipped().scenes[name].scene
    lobed = replace(scene.casing, **{"rise_fraction": 0.0} | casing)
    return replace(scene, casing=lobed, friction=replace(scene.friction, vector=True))


def integrated(model: ContactModel, scene: Scene, step: float, revolutions: int, speed: float = SPEED, **choice: Any) -> Any:
    """Samples (m) of the leading edge's normal displacement, shape (samples,), the step (s) and the state at the end."""
    name = "direct" if scene.lining is None else "abradable"
    choice = {"samples_per_revolution": SAMPLES, "snapshot_revolutions": 0, "shorten": False} | choice
    chosen = replace(shipped().integration_choice("Ref", name), time_step=step, revolutions=revolutions, **choice)
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


def at_t_n(model: ContactModel, scene: Scene, steps: np.ndarray) -> tuple[list[list[str]], float]:
    """Cells of the errors of exact modal steps against solve_ivp, and the largest difference of two of its methods."""
    blade, times = blade_of(model, SPEED, scene, np.inf), sample_times(SPEED, REVOLUTIONS * SAMPLES)
    choice = replace(shipped().integration_choice("Ref", "direct"), integrator=EXACT_MODAL, time_step=MOVING_ABOVE)
    blade = with_static_modes(blade, len(Problem(model, SPEED, scene, choice).blade.frequencies))
    stiffness = np.inf if scene.lining is None else bar_stiffness(blade)
    exact, checked = (static_contact(blade, times, stiffness, method, **EXACT) for method in ("DOP853", "LSODA"))
    runs = []
    for step in steps:
        moving = {"integrator": EXACT_MODAL, "static_above": step / MOVING_ABOVE}
        runs.append(integrated(model, scene, step, REVOLUTIONS, **moving)[:2])
    cells = with_orders([step for _, step in runs], [error(samples, exact) for samples, _ in runs])
    return cells, error(checked, exact)


def elastic(input: Any, output: Any, params: Any) -> None:
    """Table of the error of motion on bars that never yield and on the bare casing, by step. Input: model."""
    model = read_contact_model(input.model)
    scene = scene_of("abradable")
    scene = replace(scene, lining=replace(scene.lining, yield_stress=1e30))
    steps = 6.4e-6 * 0.25 ** np.arange(4)
    bars, checked = at_t_n(model, scene, steps)
    bare, checked_bare = at_t_n(model, scene_of("direct", height=LIGHT_RUB), steps)
    rows = [[f"{step:.1e}", *cells, *others] for step, cells, others in zip(steps, bars, bare, strict=True)]
    rows.append(["DOP853 against LSODA", f"{checked:.0e}", "", f"{checked_bare:.0e}", ""])
    write_table(["largest step (s)", "on bars: error", "order", "on the bare casing: error", "order"], rows, output.table)


def on_yielding_bars(model: ContactModel, scene: Scene, speed: float, parts: Sequence[int]) -> tuple[list[float], list[float]]:
    """Errors of motion and wear of central differences, with so many `parts` of a step on each of BARS bars."""
    few = replace(scene, lining=replace(scene.lining, bars=BARS))
    times, on_a_bar = sample_times(speed, SAMPLES), 2.0 * np.pi / speed / BARS
    exact, wear = with_wear(blade_of(model, speed, few, np.inf, HIGHEST_FREQUENCY), times, **EXACT)
    choice = {"integrator": CENTRAL_DIFFERENCE, "highest_frequency": HIGHEST_FREQUENCY}
    runs = [integrated(model, few, on_a_bar / part, 1, speed, **choice) for part in parts]
    return [error(run[0], exact) for run in runs], [error(run[2].wear, wear) for run in runs]


def material(input: Any, output: Any, params: Any) -> None:
    """Table of the error on a lining by its material, by blade and contact length. Inputs: a model by blade."""
    scene, rows, parts = scene_of("material_abradable"), [], (8, 32)
    for blade, speed, length in (("Ref", 1600.0, 1.585e-4), ("CS50", 1500.0, 5e-5)):
        lining = replace(scene.lining, contact_length=length)
        model = read_contact_model(input[blade])
        pairs = zip(*on_yielding_bars(model, replace(scene, lining=lining), speed, parts), strict=True)
        cells = [f"{share:.1e}" for pair in pairs for share in pair]
        rows.append([blade, f"{speed:.0f}", f"{1e3 * length:.3g}", *cells])
    errors = [f"{part} steps per bar: {what}" for part in parts for what in ("motion", "wear")]
    write_table(["blade", "speed (rad/s)", "contact length (mm)", *errors], rows, output.table)
