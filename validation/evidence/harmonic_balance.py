"""Second motions on a lining, again by the harmonic balance of another program: mousai (Slater 2017).

The equations are those of evidence.equations_of_motion, with bars as they were worn when the motion settled. mousai finds where
all of its harmonics balance. It begins with our motion, made smaller by a tenth, and steps nowhere through time.
"""

import copy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.sparse.linalg import LinearOperator

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.time_integration.carrying import CarriedMotion
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.state import SimulationState

from .configuration import settings_of
from .equations_of_motion import bar_stiffness, blade_of, static_pressure, with_static_modes
from .pages import write_table

MOTIONS = {"Ref": (1690.0, 1706.0), "L50": (1630.0, 1650.0), "CS100": (1380.0, 1390.0)}
"""Blade -> speeds (rad/s) at which a motion begins from rest, and to which it is carried."""

STEP, REVOLUTIONS, SETTLING = 2.0, 200, 1500
"""Step of the speed (rad/s), revolutions at each, and those at the last one."""

HARMONICS, SMALLER = 48, 0.9
"""Harmonics of the speed; share of our motion that mousai begins with."""


def held(input: Any, output: Any, params: Any) -> None:
    """Motions that are carried to a speed on the lining, and from rest there, and by harmonic balance. Inputs: models."""
    settings, rows = settings_of(Path.cwd()), []
    lined = settings.scenes["abradable"].scene
    scene = replace(lined, casing=replace(lined.casing, rise_fraction=0.0))
    for (name, (first, last)), file in zip(MOTIONS.items(), input.models, strict=True):
        model, choice = read_contact_model(file), settings.integration_choice(name, "abradable", 0.0)
        choice = replace(choice, revolutions=10**4, until_settled=False, snapshots_per_revolution=0, snapshot_revolutions=0)
        resting = Simulation(model, last, scene, choice)
        rest = resting.start()
        resting.advance(rest, SETTLING)
        simulation, state = carried(model, scene, choice, first, last)
        ours, balanced = _edge(simulation, state), by_harmonic_balance(simulation, state)
        sizes = [1e3 * _rms(_edge(resting, rest)), 1e3 * _rms(ours), 1e3 * _rms(balanced)]
        rows.append([name, f"{last:g}", *(f"{size:.4f}" for size in sizes), f"{100.0 * (sizes[2] / sizes[1] - 1.0):.2f}%"])
    head = ["blade", "speed (rad/s)", "rms from rest (mm)", "carried (mm)", "by harmonic balance (mm)", "difference"]
    write_table(head, rows, output.table)


def carried(
    model: ContactModel, scene: Scene, choice: IntegrationChoice, first: float, last: float
) -> tuple[Simulation, SimulationState]:
    """A motion from rest at the `first` speed (rad/s), carried in its worn lining to the `last` one, and the run there."""
    simulation = Simulation(model, first, scene, choice)
    state = simulation.start()
    simulation.advance(state, REVOLUTIONS)
    for speed in [*np.arange(first, last, STEP)[1:].tolist(), last]:
        motion = CarriedMotion.ended(simulation.problem, state, keep_wear=True)
        simulation = Simulation(model, speed, scene, choice)
        state = simulation.start()
        motion.put(simulation.problem, state)
        simulation.advance(state, SETTLING if speed == last else REVOLUTIONS)
    return simulation, state


def by_harmonic_balance(simulation: Simulation, state: SimulationState) -> np.ndarray:
    """Leading edge's normal displacement (m) over a revolution near a settled motion's `state`, by mousai."""
    import mousai

    problem, wear = simulation.problem, state.wear
    modes, speed = len(state.displacement), problem.speed
    blade = with_static_modes(blade_of(problem.model, speed, problem.scene, 1.0), modes)
    bars = wear.shape[1]

    def worn(time: float) -> np.ndarray:
        return wear[np.arange(blade.nodes), np.floor(blade.angle(time) / (2.0 * np.pi / bars)).astype(int) % bars]

    pressure = static_pressure(blade, bar_stiffness(blade), worn)

    def acceleration(displacement: np.ndarray, velocity: np.ndarray, params: dict[str, Any]) -> np.ndarray:
        moving = np.concatenate([displacement, velocity])
        return blade.motion(moving, pressure(params["cur_time"], moving))[modes:, None]

    times = np.arange(2 * HARMONICS + 1) / (2 * HARMONICS + 1) * 2.0 * np.pi / speed
    start = SMALLER * _modal_motion(simulation, state, times)
    orders = np.fft.fftfreq(len(times), 1.0 / len(times)) * speed
    ratio = problem.scene.damping_ratio
    assert isinstance(ratio, float)
    damping = 2.0 * ratio * blade.frequencies[:, None]
    free = orders**2 - blade.frequencies[:, None] ** 2 - 1j * damping * orders

    def of_free_blade(residual: np.ndarray) -> np.ndarray:
        return np.fft.ifft(np.fft.fft(residual.reshape(start.shape)) / free).real.ravel()

    near = LinearOperator((start.size, start.size), matvec=of_free_blade, dtype=float)
    tolerance = 1e-6 * float(np.abs(blade.frequencies[0] ** 2 * start[0]).max())
    _, found, *_ = mousai.hb_time(
        acceleration, start, speed, num_harmonics=HARMONICS, params={}, f_tol=tolerance, inner_M=near, inner_maxiter=80
    )
    rates = np.fft.ifft(1j * orders * np.fft.fft(found)).real
    edge = []
    for time, displacement, velocity in zip(times, found.T, rates.T, strict=True):
        forces = blade.push(velocity, pressure(time, np.concatenate([displacement, velocity])))
        edge.append(blade.edge @ displacement - blade.edge_flexibility @ forces)
    return np.array(edge)


def _modal_motion(simulation: Simulation, state: SimulationState, times: np.ndarray) -> np.ndarray:
    """Displacement of the stepped modes at `times` (s) of a revolution, in the modes of blade_of, shape (modes, times)."""
    problem, going = simulation.problem, copy.deepcopy(state)
    model, samples = problem.model, problem.choice.samples_per_revolution
    _, modes = np.linalg.eigh(np.diag(model.squared_frequencies) + problem.speed**2 * model.stiffness_per_square)
    to_theirs = modes[:, : len(state.displacement)].T @ problem.blade.modes
    first, motion = state.samples % samples, []
    for _ in range(samples):
        motion.append(to_theirs @ going.displacement)
        simulation.advance_samples(going, 1)
    whole = np.roll(motion, first, axis=0)
    turn = np.arange(samples + 1) / samples * 2.0 * np.pi / problem.speed
    return CubicSpline(turn, np.concatenate([whole, whole[:1]]), bc_type="periodic")(times).T


def _edge(simulation: Simulation, state: SimulationState) -> np.ndarray:
    """Leading edge's normal displacement (m) over the next revolution."""
    revolution = simulation.problem.choice.samples_per_revolution
    return simulation.advance_samples(copy.deepcopy(state), revolution).samples[:, 0]


def _rms(motion: np.ndarray) -> float:
    return float(np.sqrt(np.mean(motion**2)))
