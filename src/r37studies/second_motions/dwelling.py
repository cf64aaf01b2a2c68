"""Dwells: long runs at one speed, from the motions that sweeps have found there and from random states."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from r37core.time_integration.motion_kind import KindNumbers, MotionKind, PhaseSpace, kind_of_motion
from r37core.time_integration.problem import Problem
from r37core.time_integration.settling import revolution_rms
from r37core.time_integration.simulate import LEADING_EDGE, Simulation, rest_state
from r37core.time_integration.state import SimulationState

from .choice import DOWN, MOTIONS, UP, DwellChoice
from .lasting import HIGH, LOW, RANDOM
from .states import MotionLevels, SweptStates, levels_of
from .sweeping import CarriedSweep

AT_ONCE = 100
"""Revolutions that are recorded at a time."""

NEAR = 5
"""Steps of the sweeps up to which the motions of a range are looked for at a speed that is dwelt on."""

_SIZES = 0.2, 2.0
"""Sizes of random states, as a share of that of the largest motion."""


def speeds_dwelt_on(levels: MotionLevels, choice: DwellChoice) -> list[float]:
    """Speeds (rad/s) that are dwelt on, ascending: those that are given, and so many of each range of hysteresis.

    Of these one is the speed at which the motions differ most, the others are spread evenly.
    """
    speeds = set(choice.speeds)
    for part in levels.ranges() if choice.range_speeds else []:
        spread = np.linspace(part.start, part.stop - 1, choice.range_speeds - 1).round().astype(int)
        speeds |= set(levels.speeds[[levels.worst(part), *spread]].tolist())
    return sorted(speeds)


def dwells_at(
    speed: float, carried: CarriedSweep, states: Mapping[str, SweptStates], choice: DwellChoice
) -> list[dict[str, Any]]:
    """Dwells at a speed (rad/s): from the largest and the smallest motion, and from random states.

    Each with its `speed`, its `start`, and the levels of the two motions: those at the nearest speed at which motions differ,
    NaN where that is more than NEAR steps away.
    """
    levels, rows = levels_of(states), []
    distances = np.abs(levels.speeds - speed)
    nearest, apart = int(np.argmin(distances)), np.where(levels.differ, distances, np.inf)
    place, largest_and_smallest = int(np.argmin(apart)), {HIGH: levels.high, LOW: levels.low}
    about = {"speed": speed, "lined": int(carried.scene.lined)}
    for start, motions in largest_and_smallest.items():
        is_near = apart[place] <= NEAR * carried.sweep.step
        about[f"level_{start}"] = float(levels.mean[motions[place], place]) if is_near else np.nan
    simulation, size = Simulation(carried.model, speed, carried.scene.grown, carried.unrecorded_choice), 0.0
    for start, motions in largest_and_smallest.items():
        motion = MOTIONS[motions[nearest]]
        begun = begun_as(carried, states, motion, nearest, simulation)
        if begun is not None:
            size = max(size, float(np.linalg.norm(PhaseSpace(simulation.problem).coordinates(begun[1]))))
            rows.append({**about, "start": start, "motion": motion, **dwell(*begun, choice.revolutions)})
    for number, state in enumerate(random_states(simulation.problem, size, choice.starts, choice.seed), 1):
        finish_revolution(simulation, state)
        motion = f"random_{number}"
        rows.append({**about, "start": RANDOM, "motion": motion, **dwell(simulation, state, choice.revolutions)})
    return rows


def begun_as(
    carried: CarriedSweep, states: Mapping[str, SweptStates], motion: str, place: int, simulation: Simulation
) -> tuple[Simulation, SimulationState] | None:
    """Simulation and state that a dwell in a motion of the sweeps starts from; None where there is none.

    It goes on where the sweep has left the speed at this place. On a lining that is new at each speed it begins as the sweep
    did there, since the motion belongs to the lining that it has worn.
    """
    kept = states[motion]
    if kept.worn or not carried.scene.lined:
        ended = kept.motion(place)
        return None if ended is None else (simulation, simulation.start(ended))
    before = {UP: place - 1, DOWN: place + 1}.get(motion, -1)
    ended = kept.motion(before) if 0 <= before < len(kept.speeds) else None
    if ended is not None:
        return simulation, simulation.start(ended)
    # its lobes grow as in a run of the pipeline, however long the dwell is
    scene = carried.scene.rising_over(carried.choice.length_of_rise_fraction)
    rising = Simulation(carried.model, simulation.problem.speed, scene, carried.unrecorded_choice)
    return rising, rising.start()


def dwell(simulation: Simulation, state: SimulationState, revolutions: int) -> dict[str, Any]:
    """Go on by so many `revolutions` from a `state`, which is changed: rms (m) of each, and the kind of the last motion.

    NaN from the revolution on in which the motion diverges.
    """
    per_revolution, rms = simulation.problem.choice.samples_per_revolution, np.full(revolutions, np.nan)
    firsts = range(0, revolutions, AT_ONCE)
    parts = simulation.parts(state, [min(AT_ONCE, revolutions - first) * per_revolution for first in firsts])
    for first, record in zip(firsts, parts, strict=False):
        reached = (len(record.samples) - record.diverged) // per_revolution
        motion = record.samples[: reached * per_revolution, LEADING_EDGE]
        rms[first : first + reached] = revolution_rms(motion, per_revolution)
        if record.diverged:
            return {"revolution_rms": rms, **KindNumbers(MotionKind.UNKNOWN).values}
    return {"revolution_rms": rms, **kind_of_motion(simulation, state).values}


def random_states(problem: Problem, size: float, number: int, seed: int) -> list[SimulationState]:
    """Random states outside of the casing and lining, at the sample at which the blade at rest has most room.

    The energy is spread over the stepped modes alike; the states' sizes are shares of `size`, a motion's, and of at least that
    with which the first mode reaches the casing. Displacements that reach into the casing are made smaller. None where the
    casing has no room for the blade at rest.
    """
    space, random = PhaseSpace(problem), np.random.default_rng(seed)
    steps = problem.grid.steps_per_sample
    instants = range(problem.choice.samples_per_revolution)
    room = [_room(problem, np.zeros(len(space.frequencies)), instant * steps) for instant in instants]
    phase = int(np.argmax(room))
    reach = np.abs(problem.contact.displacement_operator[0, :, 0]).max()
    size = max(size, space.frequencies[0] * max(room[phase], 0.0) / max(reach, np.finfo(float).tiny))
    states: list[SimulationState] = []
    while len(states) < number and room[phase] > 0.0:
        state = rest_state(problem)
        direction = random.normal(size=2 * len(space.frequencies))
        space.put(random.uniform(*_SIZES) * size / np.linalg.norm(direction) * direction, state)
        displacement, velocity = np.split(space.coordinates(state), 2)
        while _room(problem, displacement / space.frequencies, phase * steps) < 0.0:
            displacement = 0.5 * displacement
        space.put(np.concatenate([displacement, velocity]), state)
        state.samples = phase
        states.append(state)
    return states


def _room(problem: Problem, displacement: np.ndarray, step: int) -> float:
    """Smallest distance (m) of a contact node from the casing or unworn lining, by the displacement of all stepped modes."""
    nodes = problem.contact.displacement_operator @ displacement
    return float(problem.casing.gaps(problem.casing.clearance, nodes, step, 0.0)[0].min())


def finish_revolution(simulation: Simulation, state: SimulationState) -> None:
    """Go on to the end of the revolution that a `state` is in, which is changed."""
    per_revolution = simulation.problem.choice.samples_per_revolution
    left = -state.samples % per_revolution
    if left:
        simulation.advance_samples(state, left)
