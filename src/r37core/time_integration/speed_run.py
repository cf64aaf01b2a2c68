"""One speed of one scene, from model to the small set of numbers that its file keeps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.stress.operator import StressOperator

from .initial_motion import InitialMotion, InitialMotionError
from .integration_choice import IntegrationChoice
from .kept_numbers import (
    KEPT,
    casing_numbers,
    energy_balance,
    largest_of_each,
    snapshot_numbers,
    spectrum,
    status_numbers,
    stress_history,
    wear_numbers,
    whole,
)
from .rotor_run import run_rotor
from .simulate import DIRECTIONS, TIP_POINTS, Simulation

OF_RUNS = ("spectrum", "stress", "static_stress", "wear", "energy", "casing")
"""Results of a scene that its simulations give; others are made of them later."""


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
    With a rotor the numbers are those of all its blades: see run_rotor. With `motion` the blade starts in it and not at rest:
    `initial_energy_left_out`, see InitialMotion, and of the energies `initial_energy` (J).
    Raises what Problem raises, and InitialMotionError.
    """
    if scene.rotor is not None:
        if motion is not None:
            raise InitialMotionError("initial_displacement, initial_velocity: the blades of a rotor start at rest")
        kept = {"spectrum_highest_order": spectrum_highest_order, "wear_angles": wear_angles}
        return run_rotor(model, speed, scene, choice, results, **kept, stress=stress)
    simulation = Simulation(model, speed, scene, choice)
    left_out = None if motion is None else motion.left_out(simulation.problem)
    state = simulation.start(motion)
    begun = simulation.energy(state)
    record = simulation.advance(state, choice.revolutions)
    per_revolution = choice.samples_per_revolution
    sample_count = choice.revolutions * per_revolution
    samples = whole(record.samples.reshape(-1, len(TIP_POINTS), len(DIRECTIONS)), sample_count, record.diverged)
    maxima = largest_of_each(choice.revolutions, samples)
    first = choice.revolutions // 2
    half = samples[first * per_revolution :]
    totals = state.totals
    numbers = status_numbers(simulation.problem, len(record.samples) / per_revolution if record.diverged else None)
    numbers |= {
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
        numbers |= spectrum(half[:, 0, KEPT].T, len(half) // per_revolution, spectrum_highest_order)
    if "stress" in results:
        wanted = simulation.problem, record, stress, "static_stress" in results
        numbers |= snapshot_numbers(*wanted) | stress_history(*wanted)
    if "wear" in results:
        assert scene.lining is not None and state.wear is not None
        numbers |= wear_numbers(state.wear, min(wear_angles, scene.lining.bars), scene.lining)
    if "energy" in results:
        numbers |= energy_balance(simulation.work(state), float(totals["loss"]), simulation.energy(state) - begun)
        if motion is not None:
            numbers["initial_energy"] = np.array(begun)
    if "casing" in results:
        numbers |= casing_numbers(simulation.problem, record, spectrum_highest_order)
    return numbers
