"""Run at one speed in one scene, from model to the small set of numbers that its file keeps."""

from collections.abc import Sequence

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.stress.operator import StressOperator

from .fatigue_numbers import fatigue_numbers
from .initial_motion import InitialMotion
from .integration_choice import IntegrationChoice
from .kept_numbers import (
    KEPT,
    casing_numbers,
    energy_balance,
    extended,
    largest_of_each,
    snapshot_numbers,
    spectrum,
    status_numbers,
    stress_histories,
    wear_numbers,
    whole,
)
from .lining_at_tip import lining_at_tip
from .motion_kind import kind_numbers
from .rotor_numbers import rotor_numbers, stress_of_blades
from .rotor_simulation import BladesRecord, BladesSimulation
from .settling import motion_at_end, revolution_rms, wear_of
from .simulate import DIRECTIONS, LEADING_EDGE, TIP_POINTS
from .state import SimulationState

OF_RUNS = ("spectrum", "stress", "static_stress", "fatigue", "wear", "energy", "casing", "motion_kind")
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
    (rad), `lined`, 1 where there is a lining, and what lining_at_tip says of it, `rms` and `peak` (m) over the revolutions in
    the statistic, shape (2, 3): TIP_POINTS by DIRECTIONS, `revolution_maxima` (m), shape (revolutions, 2, 3), NaN after the end
    of a run that settled, `motion_at_end`, `settled_revolution` and others of ending_numbers, and contact statistics,
    `largest_penetration` (m) of the tip's edge into the casing among them. `clearance` (m), shape (nodes,): where it changes
    with the speed. `amplitude`, shape (2, orders): spectrum of the leading edge's normal and tangential motion.
    `snapshots`: the reduced coordinates of the vibration in the last revolution and, with static_stress, the amplitudes
    of rotation's shapes. With a `stress` operator: `max_von_mises` (Pa) in the last revolution, `revolution_von_mises` (Pa),
    the largest of each of the last `choice.snapshot_revolutions`, `stress_region` and `static_stress`, 1 where rotation's is in
    them; with fatigue: see fatigue_numbers. `casing_...`: see casing_waves. A diverged run has NaN where a number would need
    the rest of the run. With a rotor: the largest of all blades' rms, peaks, maxima, forces and stresses; the sum of hits and
    energies; the spectrum of the leading blade, the snapshots of the one with the largest stress; and numbers of each blade,
    see rotor_numbers and stress_of_blades. `status` is that of the rotor: all blades end when one diverges, whose snapshots are
    kept then. With `motion` the blade starts in it and not at rest: `initial_energy_left_out`, see InitialMotion, and of the
    energies `initial_energy` (J).
    Raises what Problem raises, and InitialMotionError.
    """
    simulation = BladesSimulation(model, speed, scene, choice)
    left_out = None if motion is None else motion.left_out(simulation.problem)
    states = simulation.start(motion)
    begun = simulation.energy(states)
    numbers = numbers_of_run(
        simulation,
        states,
        simulation.run(states),
        results,
        begun,
        spectrum_highest_order=spectrum_highest_order,
        wear_angles=wear_angles,
        stress=stress,
    )
    if left_out is not None:
        numbers["initial_energy_left_out"] = np.array(left_out)
        if "energy" in results:
            numbers["initial_energy"] = np.array(begun)
    return numbers


def numbers_of_run(
    simulation: BladesSimulation,
    states: list[SimulationState],
    record: BladesRecord,
    results: Sequence[str],
    begun: float,
    *,
    spectrum_highest_order: int,
    wear_angles: int,
    stress: StressOperator | None = None,
) -> dict[str, np.ndarray]:
    """Numbers of a run that is done (see run_speed): `states` at its end, its `record`, and its energy `begun` (J)."""
    problem, scene = simulation.problem, simulation.problem.scene
    choice, model = problem.choice, problem.model
    totals = np.array([state.totals for state in states])
    per_revolution, revolutions, ended = choice.samples_per_revolution, record.ending.revolutions, record.first_diverged
    first = max(revolutions - choice.revolutions_in_statistic, 0)
    samples = [
        whole(part.samples.reshape(-1, len(TIP_POINTS), len(DIRECTIONS)), revolutions * per_revolution, part.diverged)
        for part in record.blades
    ]
    half = [part[first * per_revolution :] for part in samples]
    maxima = [extended(largest_of_each(revolutions, part), choice.revolutions) for part in samples]
    numbers = status_numbers(problem, None if ended is None else len(record.blades[ended].samples) / per_revolution)
    numbers |= lining_at_tip(model, scene)
    numbers |= {
        "rms": np.max([np.sqrt(np.mean(part**2, axis=0)) for part in half], axis=0),
        "peak": np.max([part[first:revolutions].max(axis=0) for part in maxima], axis=0),
        "revolution_maxima": np.max(maxima, axis=0),
        "share_of_time_in_contact": np.array((totals["steps_in_contact"] / np.maximum(totals["steps"], 1.0)).max()),
        "largest_normal_force": np.array(totals["largest_force"].max()),
        # a tip line that is known at its contact nodes alone does not say it
        "largest_penetration": np.array(totals["largest_penetration"].max() if model.edge_is_known else np.nan),
        "casing_hits": np.array(totals["casing_hits"].sum()),
        "worst_complementarity": np.array(totals["worst_complementarity"].max()),
    }
    numbers |= ending_numbers(simulation, record, samples, states)
    leader = 0
    if simulation.rotor is not None:
        numbers |= rotor_numbers(simulation, record, samples, totals)
        leader = simulation.rotor.numbers.index(int(numbers["leader"]))
    if scene.casing.changes_with_speed:
        numbers["clearance"] = np.min([problem.casing.clearance for problem in simulation.problems], axis=0)
    if "spectrum" in results:
        numbers |= spectrum(half[leader][:, 0, KEPT].T, len(half[leader]) // per_revolution, spectrum_highest_order)
    if "stress" in results:
        numbers |= _stress(simulation, record, stress, results)
    if "wear" in results:
        assert scene.lining is not None
        wear = np.max([state.wear for state in states if state.wear is not None], axis=0)
        numbers |= wear_numbers(wear, min(wear_angles, scene.lining.bars), scene.lining, simulation.initial_wear)
        numbers["wear_growth"] = np.array(record.ending.wear_growth)
    if "energy" in results:
        work = sum(blade.work(state) for blade, state in zip(simulation.blades, states, strict=True))
        numbers |= energy_balance(work, float(totals["loss"].sum()), simulation.energy(states) - begun)
    if "casing" in results:
        # the record of any blade has it
        numbers |= casing_numbers(problem, record.blades[0], revolutions, spectrum_highest_order)
    if "motion_kind" in results:
        numbers |= kind_numbers(simulation.blades[0], states[0], diverged=ended is not None)
    return numbers


def ending_numbers(
    simulation: BladesSimulation, record: BladesRecord, samples: Sequence[np.ndarray], states: Sequence[SimulationState]
) -> dict[str, np.ndarray]:
    """How a run ended, from the displacement `samples` (m) of each blade, shape (samples, 2, 3).

    `motion_at_end`: the worst MotionAtEnd of all blades; `settled_revolution`: after which a run ended as it had settled, else
    NaN; `statistic_end`, `statistic_revolutions`: last revolution of the statistic, and how many it has.
    """
    ending, per_revolution = record.ending, simulation.problem.choice.samples_per_revolution
    casing, wear = simulation.problem.casing, max(float(wear_of(state).max()) for state in states)
    clearance = float(np.min(casing.clearance))
    if clearance <= 0.0:
        # a tip that has cut its way into the lining has none
        clearance = casing.scene.casing.clearance
    rms = [revolution_rms(part[:, 0, LEADING_EDGE], per_revolution) for part in samples]
    motions = [motion_at_end(part, clearance, wear, ending.wear_growth, ending.contact_steps) for part in rms]
    return {
        "motion_at_end": np.array(int(max(motions))),
        "settled_revolution": np.array(float(ending.revolutions) if ending.settled else np.nan),
        "statistic_end": np.array(ending.revolutions),
        "statistic_revolutions": np.array(simulation.problem.choice.revolutions_in_statistic),
    }


def _stress(
    simulation: BladesSimulation, record: BladesRecord, stress: StressOperator | None, results: Sequence[str]
) -> dict[str, np.ndarray]:
    """Numbers of the blade with the largest stress (snapshot_numbers), the largest history, fatigue, and those of a rotor."""
    shown, history, rotor = record.first_diverged or 0, None, simulation.rotor
    static_stress = "static_stress" in results
    if stress is not None:
        factors = rotor.frequency_factors if rotor else (1.0,)
        history = stress_histories(simulation.problems, record.blades, factors, stress, static_stress)
        if record.first_diverged is None:
            shown = int(np.nan_to_num(history[:, -1]).argmax())
    # a blade that another one ends may have no snapshots: of a diverged run they are of the one that diverged
    numbers = snapshot_numbers(simulation.problems[shown], record.blades[shown], stress, static_stress)
    if stress is None or history is None:
        return numbers
    if "fatigue" in results:
        numbers |= fatigue_numbers(simulation.problems, record, stress, shown)
    return numbers | {"revolution_von_mises": history.max(axis=0)} | (stress_of_blades(history) if rotor else {})
