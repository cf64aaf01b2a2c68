"""One speed of one scene, from model to the small set of numbers that its file keeps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.fft import rfft  # NumPy imports it when it is used, which would be in each of a server's jobs

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.of_revolutions import largest_of_revolutions
from r37core.stress.operator import StressOperator

from .casing_waves import casing_waves
from .initial_motion import InitialMotion
from .integration_choice import IntegrationChoice
from .simulate import DIRECTIONS, TIP_POINTS, Simulation
from .state import SimulationRecord, SimulationState
from .status import RunStatus

OF_RUNS = ("spectrum", "stress", "static_stress", "wear", "energy", "casing")
"""Results of a scene that its simulations give; others are made of them later."""

_WEAR_LOBES = 20
_KEPT = [DIRECTIONS.index("normal"), DIRECTIONS.index("tangential")]
"""Directions of the spectrum."""


def run_speed(
    model: ContactModel,
    speed: float,
    scene: Scene,
    choice: IntegrationChoice,
    results: Sequence[str],
    *,
    spectrum_highest_order: int,
    wear_angles: int,
    stress: StressOperator | None = None,
    motion: InitialMotion | None = None,
) -> dict[str, np.ndarray]:
    """Simulate one speed (rad/s) and keep what is asked for in `results` (OF_RUNS).

    Always: `status`, `diverged_revolution` and `diverged_time` (NaN unless diverged), `time_step`, the casing's `cone_angle`
    (rad), `lined`, 1 where there is a lining, `rms` and `peak` (m) over the last half, shape (2, 3): TIP_POINTS by DIRECTIONS,
    `revolution_maxima` (m), shape (revolutions, 2, 3), and contact statistics. `clearance` (m), shape (nodes,): where it
    changes with the speed. `amplitude`, shape (2, orders): spectrum of the leading edge's normal and tangential motion.
    `snapshots`: the reduced coordinates of the vibration in the last revolution and, with static_stress, the amplitudes of
    rotation's shapes. With a `stress` operator: `max_von_mises` (Pa) in the last revolution, `revolution_von_mises` (Pa), the
    largest of each of the last `choice.snapshot_revolutions`, `stress_region` and `static_stress`, 1 where rotation's is in
    them. `casing_...`: see casing_waves. A diverged run has NaN where a number would need the rest of the run.
    With `motion` the blade starts in it and not at rest: `initial_energy_left_out`, see InitialMotion, and of the energies
    `initial_energy` (J). Raises what Problem raises, and InitialMotionError.
    """
    simulation = Simulation(model, speed, scene, choice)
    left_out = None if motion is None else motion.left_out(simulation.problem)
    state = simulation.start(motion)
    begun = simulation.energy(state)
    record = simulation.advance(state, choice.revolutions)
    per_revolution = choice.samples_per_revolution
    sample_count = choice.revolutions * per_revolution
    samples = _whole(record.samples.reshape(-1, len(TIP_POINTS), len(DIRECTIONS)), sample_count, record.diverged)
    maxima = np.abs(samples).reshape(choice.revolutions, per_revolution, *samples.shape[1:]).max(axis=1)
    first = choice.revolutions // 2
    half = samples[first * per_revolution :]
    diverged_at = len(record.samples) / per_revolution if record.diverged else np.nan
    totals = state.totals
    numbers = {
        "status": np.array(int(RunStatus.DIVERGED if record.diverged else RunStatus.COMPLETED)),
        "speed": np.array(speed),
        "diverged_revolution": np.array(diverged_at),
        "diverged_time": np.array(diverged_at * 2.0 * np.pi / speed),
        "time_step": np.array(simulation.problem.grid.time_step),
        "cone_angle": np.array(simulation.problem.casing.cone_angle),
        "lined": np.array(int(scene.lining is not None)),
        "rms": np.sqrt(np.mean(half**2, axis=0)),
        "peak": maxima[first:].max(axis=0),
        "revolution_maxima": maxima,
        "share_of_time_in_contact": np.array(totals["steps_in_contact"] / totals["steps"]),
        "largest_normal_force": np.array(totals["largest_force"]),
        "casing_hits": np.array(totals["casing_hits"]),
        "worst_complementarity": np.array(totals["worst_complementarity"]),
    }
    if left_out is not None:
        numbers["initial_energy_left_out"] = np.array(left_out)
    if scene.casing.changes_with_speed:
        numbers["clearance"] = simulation.problem.casing.clearance
    if "spectrum" in results:
        numbers |= _spectrum(half[:, 0, _KEPT].T, len(half) // per_revolution, spectrum_highest_order)
    if "stress" in results:
        numbers |= _stress(simulation, record, stress, "static_stress" in results)
    if "wear" in results:
        assert scene.lining is not None
        numbers |= _wear(state, min(wear_angles, scene.lining.bars))
    if "energy" in results:
        numbers |= energy_balance(simulation.work(state), float(totals["loss"]), simulation.energy(state) - begun)
        if motion is not None:
            numbers["initial_energy"] = np.array(begun)
    if "casing" in results:
        ring = simulation.problem.casing.ring
        assert ring is not None and record.casing is not None
        casing = _whole(record.casing, sample_count, record.diverged)[first * per_revolution :]
        numbers |= casing_waves(casing, ring, speed, len(casing) // per_revolution, spectrum_highest_order)
    return numbers


def _whole(samples: np.ndarray, count: int, diverged: bool) -> np.ndarray:
    """As many samples as were asked for: NaN after a divergence, and in place of the last one, which may be infinite."""
    if not diverged:
        return samples
    missing = count - len(samples) + 1
    return np.concatenate([samples[:-1], np.full((missing, *samples.shape[1:]), np.nan)])


def _stress(
    simulation: Simulation, record: SimulationRecord, stress: StressOperator | None, static_stress: bool
) -> dict[str, np.ndarray]:
    """What is kept of the snapshots of a run: see `run_speed`."""
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


def _spectrum(displacement: np.ndarray, revolutions: int, highest_order: int) -> dict[str, np.ndarray]:
    """Amplitude (m) of displacements, shape (directions, samples), at multiples of 1/revolutions of the engine order."""
    amplitude = amplitudes(displacement)
    count = min(highest_order * revolutions + 1, amplitude.shape[1])
    return {"amplitude": amplitude[:, :count].astype(np.float32), "engine_order": np.arange(count) / revolutions}


def amplitudes(values: np.ndarray) -> np.ndarray:
    """Amplitudes of the Fourier series of real values, along the last axis; the first is the mean's size."""
    sizes = 2.0 * np.abs(rfft(values)) / values.shape[-1]
    sizes[..., 0] /= 2.0
    return sizes


def _wear(state: SimulationState, angles: int) -> dict[str, np.ndarray]:
    """Largest wear (m) over the rings: its profile as the maximum in each of `angles` sectors, and its lobes."""
    assert state.wear is not None
    profile = state.wear.max(axis=0)
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
