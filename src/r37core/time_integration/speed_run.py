"""Run at one speed in one scene, from model to the small set of numbers that its file keeps."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy import ndarray

from r37core.contact.casing import least_change
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.rom.quadratic_terms import PATH_ERROR
from r37core.stress.operator import StressOperators, operators_at

from . import kept_numbers
from .carrying import CarriedMotion
from .finished_run import FinishedRun
from .integration_choice import IntegrationChoice
from .motion_kind import kind_numbers
from .rotor_simulation import RotorSimulation
from .settling import motion_at_end, revolution_rms
from .simulate import DIRECTIONS, LEADING_EDGE, TIP_POINTS, Simulation

OF_RUNS = ("spectrum", "stress", "static_stress", "fatigue", "wear", "energy", "casing", "motion_kind")
"""Results of a scene that its simulations give; others are made of them later."""


def run_speed(
    model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice, results: Sequence[str], **kept: Any
) -> dict[str, ndarray]:
    """Simulate one speed (rad/s) and keep what is asked for in `results` (OF_RUNS).

    Returned are arrays of speed_arrays.ARRAYS, by name: those of `results` and all others that blade and scene have.
    `kept`: sizes and operators of the stress, see numbers_of_run. A rotor ends when one of its blades diverges, whose
    snapshots are kept then. Raises what Problem raises.
    """
    return numbers_of_run(simulation_of(model, speed, scene, choice).run(), results, **kept)


def simulation_of(model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice) -> Simulation | RotorSimulation:
    """Simulation of a blade at one speed (rad/s), or of all blades of the scene's rotor. Raises what these raise."""
    if scene.rotor is None:
        return Simulation(model, speed, scene, choice)
    return RotorSimulation(model, speed, scene, choice)


def numbers_of_run(
    run: FinishedRun,
    results: Sequence[str],
    *,
    spectrum_highest_order: int,
    wear_angles: int,
    stress: StressOperators | None = None,
) -> dict[str, ndarray]:
    """Numbers of a run that is done: see run_speed.

    `spectrum_highest_order`: of the kept spectrum; `wear_angles`: of the kept wear; `stress`: operators by region.
    """
    problem, scene, ended = run.problem, run.problem.scene, run.first_diverged
    choice, model = problem.choice, problem.model
    stress = None if stress is None else operators_at(stress, problem.speed)
    edge_is_known = len(model.edge.theta) > len(model.theta)
    totals = np.array([state.totals for state in run.states])
    # a run that diverges early ends before the statistic is full, which keeps its shape
    per_revolution, revolutions = choice.samples_per_revolution, run.kept_revolutions
    first = revolutions - choice.revolutions_in_statistic
    count, shape = revolutions * per_revolution, (-1, len(TIP_POINTS), len(DIRECTIONS))
    samples = [kept_numbers.whole(part.samples.reshape(shape), count, part.diverged) for part in run.records]
    statistic = [part[first * per_revolution :] for part in samples]
    maxima = [kept_numbers.extended(kept_numbers.largest_of_each(revolutions, part), choice.revolutions) for part in samples]
    numbers = kept_numbers.status_numbers(problem, None if ended is None else len(run.records[ended].samples) / per_revolution)
    reached = np.max(maxima, axis=0)
    numbers |= kept_numbers.lining_at_tip(model, scene)
    numbers |= {
        **kept_numbers.in_directions("rms", np.max([np.sqrt(np.mean(part**2, axis=0)) for part in statistic], axis=0)),
        **kept_numbers.in_directions("peak", np.max([part[first:revolutions].max(axis=0) for part in maxima], axis=0)),
        "revolution_maximum": reached[..., DIRECTIONS.index("normal")],
        "share_of_time_in_contact": (totals["steps_in_contact"] / np.maximum(totals["steps"], 1.0)).max(),
        "largest_normal_force": totals["largest_force"].max(),
        # a tip line that is known at its contact nodes alone does not say it
        "largest_penetration": totals["largest_penetration"].max() if edge_is_known else np.nan,
        "casing_hits": totals["casing_hits"].sum(),
        "worst_complementarity": totals["worst_complementarity"].max(),
    }
    if model.quadratic is not None:
        # as far as a run got that diverged
        numbers["peak_share_of_height"] = np.max(reached, where=np.isfinite(reached), initial=0.0) / model.quadratic.height
        numbers["share_of_height_limit"] = model.quadratic.share_within(PATH_ERROR * scene.casing.clearance)
        numbers["revolution_share_of_height"] = reached[:revolutions].max(axis=(1, 2)) / model.quadratic.height
    numbers |= kept_numbers.limit_numbers(run, totals)
    numbers |= ending_numbers(run, samples)
    if scene.rotor is None:
        numbers |= CarriedMotion.ended(problem, run.states[0]).arrays
    if scene.casing.changes_with_speed:
        numbers["clearance"] = np.min([each.casing.clearance for each in run.problems], axis=0) + least_change(scene.casing)
    if "spectrum" in results:
        leading = statistic[run.leader(statistic)]
        motion = leading[:, 0, LEADING_EDGE].T
        numbers |= kept_numbers.spectrum(motion, len(leading) // per_revolution, spectrum_highest_order)
    history = None
    if "stress" in results:
        if stress is not None:
            history, nodes = kept_numbers.stress_histories(run, stress, "static_stress" in results)
            numbers |= kept_numbers.worst_places(run, stress, history, nodes)
        numbers |= _stress(run, stress, history, results)
    if "wear" in results:
        assert scene.lining is not None
        wear = np.max([state.wear for state in run.states], axis=0)
        cut = np.max([each.casing.initial_wear for each in run.problems], axis=0)
        numbers |= kept_numbers.wear_numbers(wear, min(wear_angles, scene.lining.bars), scene.lining, cut)
        numbers["wear_growth"] = run.ending.wear_growth
    if "energy" in results:
        numbers |= kept_numbers.energy_balance(run.contact_work, float(totals["loss"].sum()), run.energy_change)
    if "casing" in results:
        # the record of any blade has it
        numbers |= kept_numbers.casing_numbers(problem, run.records[0], revolutions, spectrum_highest_order)
    if "motion_kind" in results:
        numbers |= kind_numbers(problem, run.states[0], diverged=ended is not None)
    numbers |= run.numbers_of_each(samples, None if history is None else history[0])
    return {name: np.asarray(value) for name, value in numbers.items()}


def ending_numbers(run: FinishedRun, samples: Sequence[ndarray]) -> dict[str, Any]:
    """How a run ended, from the displacement `samples` (m) of each blade, shape (samples, 2, 3).

    `motion_at_end`: the worst MotionAtEnd of all blades; `settled_revolution`: after which a run ended as it had settled, else
    NaN; `statistic_end`, `statistic_revolutions`: last revolution of the statistic, and how many it has; `revolution_rms` (m),
    of each revolution until the end: of the leading edge, normal and tangential together, of all blades the largest.
    """
    ending, choice, casing = run.ending, run.problem.choice, run.problem.casing
    wear, clearance = max(float(state.wear.max(initial=0.0)) for state in run.states), float(np.min(casing.clearance))
    if clearance <= 0.0:
        # a tip that has cut its way into the lining has none
        clearance = casing.scene.casing.clearance
    rms = [revolution_rms(part[:, 0, LEADING_EDGE], choice.samples_per_revolution) for part in samples]
    motions = [motion_at_end(part, clearance, wear, ending.wear_growth, ending.contact_steps) for part in rms]
    return {
        "motion_at_end": int(max(motions)),
        "settled_revolution": float(ending.revolutions) if ending.settled else np.nan,
        "statistic_end": ending.revolutions,
        "statistic_revolutions": choice.revolutions_in_statistic,
        "revolution_rms": np.max(rms, axis=0),
    }


def _stress(
    run: FinishedRun, stress: StressOperators | None, history: ndarray | None, results: Sequence[str]
) -> dict[str, Any]:
    """Numbers of the blade with the largest stress (snapshot_numbers), the largest of the `history`, and fatigue."""
    shown = run.first_diverged or 0
    if history is not None and run.first_diverged is None:
        shown = int(np.nan_to_num(history[0, :, -1]).argmax())
    # a blade that another one ends may have no snapshots: of a diverged run they are of the one that diverged
    numbers = kept_numbers.snapshot_numbers(run.problems[shown], run.records[shown], stress, "static_stress" in results)
    if stress is None or history is None:
        return numbers
    if "fatigue" in results:
        numbers |= kept_numbers.fatigue_numbers(run, stress, shown)
    return numbers | {"revolution_von_mises": history.max(axis=1)}
