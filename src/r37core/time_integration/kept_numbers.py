"""What is kept of a run at one speed: numbers of its samples, snapshots and wear, as its file has them."""

from __future__ import annotations

import numpy as np
from numpy.fft import rfft  # NumPy imports it when it is used, which would be in each of a server's jobs

from r37core.rom.contact_model import ContactModel
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.of_revolutions import largest_of_revolutions
from r37core.stress.operator import StressOperator

from .simulate import DIRECTIONS, Simulation
from .state import SimulationRecord

_WEAR_LOBES = 20
KEPT = [DIRECTIONS.index("normal"), DIRECTIONS.index("tangential")]
"""Directions of the spectrum."""


def whole(samples: np.ndarray, count: int, diverged: bool) -> np.ndarray:
    """As many samples as were asked for: NaN after a divergence, and in place of the last one, which may be infinite."""
    if not diverged:
        return samples
    missing = count - len(samples) + 1
    return np.concatenate([samples[:-1], np.full((missing, *samples.shape[1:]), np.nan)])


def stress_numbers(
    simulation: Simulation, record: SimulationRecord, stress: StressOperator | None, static_stress: bool
) -> dict[str, np.ndarray]:
    """What is kept of the snapshots of a run: see run_speed."""
    model, speed, choice = simulation.problem.model, simulation.problem.speed, simulation.problem.choice
    shapes, per_revolution = model.to_reduced @ simulation.problem.contact.state_shapes, choice.snapshots_per_revolution
    coordinates = record.snapshots[-per_revolution:] @ shapes.T
    if static_stress:
        coordinates = with_rotation(coordinates, model, speed)
    # a stress of them differs by 1e-7 of the largest, in two thirds of the file
    coordinates = coordinates.astype(np.float32)
    if stress is None:
        return {"snapshots": coordinates}
    whole = len(record.snapshots) // per_revolution
    history = np.full(choice.snapshot_revolutions, np.nan, dtype=np.float32)
    if whole:
        rotation = rotation_amplitudes(model.rotation_stiffening, speed) if static_stress else np.empty(0)
        states = record.snapshots[: whole * per_revolution]
        history[:whole] = largest_of_revolutions(stress, states, shapes, rotation, per_revolution)
    return {
        "snapshots": coordinates,
        "max_von_mises": np.array(np.nan if record.diverged else stress.max_von_mises(coordinates).max()),
        "revolution_von_mises": history,
        "stress_region": np.array(stress.region),
        "static_stress": np.array(int(stress.have_rotation(coordinates))),
    }


def with_rotation(coordinates: np.ndarray, model: ContactModel, speeds: float | np.ndarray) -> np.ndarray:
    """Coordinates of the vibration, shape (instants, coordinates), and after them the amplitudes of rotation's shapes.

    `speeds` (rad/s): one of all, or that of each instant.
    """
    amplitudes = rotation_amplitudes(model.rotation_stiffening, speeds)
    return np.hstack([coordinates, np.broadcast_to(amplitudes, (len(coordinates), amplitudes.shape[-1]))])


def spectrum(displacement: np.ndarray, revolutions: int, highest_order: int) -> dict[str, np.ndarray]:
    """Amplitude (m) of displacements, shape (directions, samples), at multiples of 1/revolutions of the engine order."""
    amplitude = amplitudes(displacement)
    count = min(highest_order * revolutions + 1, amplitude.shape[1])
    return {"amplitude": amplitude[:, :count].astype(np.float32), "engine_order": np.arange(count) / revolutions}


def amplitudes(values: np.ndarray) -> np.ndarray:
    """Amplitudes of the Fourier series of real values, along the last axis; the first is the mean's size."""
    sizes = 2.0 * np.abs(rfft(values)) / values.shape[-1]
    sizes[..., 0] /= 2.0
    return sizes


def wear_numbers(wear: np.ndarray, angles: int) -> dict[str, np.ndarray]:
    """Of the `wear` (m), shape (rings, bars), the largest over the rings: in each of `angles` sectors, and its lobes."""
    profile = wear.max(axis=0)
    sectors = np.linspace(0, len(profile), angles, endpoint=False).astype(int)
    depths = np.maximum.reduceat(profile, sectors) if len(profile) >= angles else profile[sectors]
    return {
        "wear": depths.astype(np.float32),
        "max_wear": np.array(profile.max()),
        "wear_harmonic": amplitudes(profile)[: _WEAR_LOBES + 1],
    }


def energy_balance(work: float, loss: float, change: float, stiffness_work: float = 0.0) -> dict[str, np.ndarray]:
    """Work of the contact forces, loss to damping, change of energy, and what does not close (all J).

    `stiffness_work`: what a changing speed brings to the vibration.
    """
    return {
        "contact_work": np.array(work),
        "damping_loss": np.array(loss),
        "energy_change": np.array(change),
        "energy_residual": np.array(change - work + loss - stiffness_work),
    }
