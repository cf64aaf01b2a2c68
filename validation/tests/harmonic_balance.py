"""A settled motion on a lining by the harmonic balance of another program: mousai (Slater 2017).

The equations are those of evidence.equations_of_motion, with bars as they were worn when the motion settled. mousai finds where
all of its harmonics balance. It begins with our motion, made smaller by a tenth, and steps nowhere through time.
"""

import copy
from typing import Any

import mousai
import numpy as np
from evidence.equations_of_motion import bar_stiffness, blade_of, static_pressure, with_static_modes
from scipy.interpolate import CubicSpline
from scipy.sparse.linalg import LinearOperator

from r37core.time_integration.simulate import Simulation
from r37core.time_integration.state import SimulationState

HARMONICS, SMALLER = 48, 0.9
"""Harmonics of the speed; share of our motion that mousai begins with."""


def by_harmonic_balance(simulation: Simulation, state: SimulationState) -> np.ndarray:
    """Leading edge's normal displacement (m) over a revolution near a settled motion's `state`, by mousai."""
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
    _, balanced, *_ = mousai.hb_time(
        acceleration, start, speed, num_harmonics=HARMONICS, params={}, f_tol=tolerance, inner_M=near, inner_maxiter=80
    )
    rates = np.fft.ifft(1j * orders * np.fft.fft(balanced)).real
    edge = []
    for time, displacement, velocity in zip(times, balanced.T, rates.T, strict=True):
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
