"""Segments of constant speed: what of a problem changes with the speed while its modes are held."""

from typing import NamedTuple

import numpy as np
from numpy import ndarray

from r37core.rom.rotation import BucklingError

from .clearance import clearances
from .integrators import Increments, Recursion, increments, recursion
from .problem import Problem


class Segments(NamedTuple):
    """Parts of a problem that change with the speed while its modes are held: all with a first axis of `speeds` (rad/s).

    `coupling`: of central differences alone. `increments`: None of a single speed.
    """

    speeds: ndarray
    recursion: Recursion
    coupling: ndarray | None
    clearance: ndarray
    increments: Increments | None


def own_segment(problem: Problem) -> Segments:
    """Segments of the problem's own speed alone."""
    several = problem.contact.recursion[None]
    coupling = None if problem.choice.second_order else problem.contact.coupling[None]
    speeds = np.array([problem.speed])
    return Segments(speeds, several, coupling, problem.casing.clearance[None], None)


def segments_at(problem: Problem, speeds: ndarray) -> Segments:
    """Segments at other `speeds` (rad/s), (speeds,), in the modes of the problem's speed and with its steps per revolution.

    A mode's squared frequency is its stiffness at the speed, phi^T K(Omega) phi; the stiffness between modes is left out.
    Raises BucklingError where it is not positive.
    """
    motion = _motion_at(problem, speeds)
    several = recursion(problem.choice.integrator, *motion)
    rooms = clearances(problem.model, problem.scene, speeds)
    modal_increments = increments(problem.choice.integrator, *motion)
    coupling = None if problem.choice.second_order else problem.contact.coupling_of(several.inverse)
    return Segments(speeds, several, coupling, rooms, modal_increments)


def own_increments(problem: Problem) -> Increments:
    """Increments at the problem's own speed, of all modes, shape (1, modes)."""
    return increments(problem.choice.integrator, *_motion_at(problem, np.array([problem.speed])))


def _motion_at(problem: Problem, speeds: ndarray) -> tuple[ndarray, float | ndarray, ndarray]:
    """Frequencies (rad/s) of all modes at each of the speeds, damping ratio, and steps (s)."""
    blade, ring = problem.blade, problem.casing.ring
    ratio = 1.0 + (speeds[:, None] ** 2 - problem.speed**2) * blade.stiffening
    if not np.all(ratio > 0.0):
        raise BucklingError(float(speeds[np.argmin(ratio.min(axis=1))]))
    steps = 2.0 * np.pi / speeds[:, None] / problem.grid.steps_per_revolution
    frequencies = blade.frequencies * np.sqrt(ratio)
    damping = problem.scene.damping(frequencies, speeds)
    if ring is None:
        return frequencies, damping, steps
    ring_part, ring_damping = (np.tile(part, (len(speeds), 1)) for part in (ring.frequencies, ring.damping_ratios))
    damping = np.broadcast_to(damping, frequencies.shape)
    return np.hstack([frequencies, ring_part]), np.hstack([damping, ring_damping]), steps
