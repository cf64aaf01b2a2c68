"""What is done with the motions that sweeps have found: dwells where they differ, branches where they recur."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.linalg import LinAlgError

from r37core.time_integration.carrying import CarriedMotion
from r37core.time_integration.motion_kind import RECURS, PhaseSpace, recurrence_of
from r37core.time_integration.simulate import Simulation

from .branches import Bifurcation, branch_through, events_of, lies_on
from .choice import MOTIONS, BranchChoice, DwellChoice
from .dwelling import HIGH, LOW, RANDOM, Dwell, carried_state, dwell, finish_revolution, random_states
from .motion_files import SweptStates, levels_of
from .periodic import NoOrbitError, Orbit, PeriodicBlade, orbit_after
from .ranges import MotionLevels
from .sweeping import CarriedSweep

_SAME = 1e-3
"""Difference of two rms, as a share, below which an orbit counts as one of a branch."""

_NEARLY = 10.0 * RECURS
"""Recurrence below which a motion is worth an attempt of Newton's method."""


def speeds_dwelt_on(levels: MotionLevels, choice: DwellChoice) -> list[float]:
    """Speeds (rad/s) that are dwelt on, ascending: those that are given, and so many of each range of hysteresis.

    Of these one is the speed at which the motions differ most, the others are spread evenly.
    """
    speeds = set(choice.speeds)
    for part in levels.ranges() if choice.range_speeds else []:
        spread = np.linspace(part.start, part.stop - 1, choice.range_speeds - 1).round().astype(int)
        speeds |= set(levels.speeds[[levels.worst(part), *spread]].tolist())
    return sorted(speeds)


def dwells_of(
    carried: CarriedSweep, states: Mapping[str, SweptStates], choice: DwellChoice
) -> list[tuple[dict[str, Any], Dwell]]:
    """Dwells at all speeds that are dwelt on: from the largest and the smallest motion, and from random states.

    Each with its `speed`, its `start`, and the levels of the two motions: those at the nearest speed at which motions differ.
    """
    levels, rows = levels_of(states), []
    differing = np.flatnonzero(levels.differ)
    for speed in speeds_dwelt_on(levels, choice):
        nearest = int(np.argmin(np.abs(levels.speeds - speed)))
        judged = int(differing[np.argmin(np.abs(levels.speeds[differing] - speed))]) if len(differing) else nearest
        high, low = levels.high, levels.low
        about = {
            "speed": speed,
            "level_high": float(levels.mean[high[judged], judged]),
            "level_low": float(levels.mean[low[judged], judged]),
        }
        simulation = Simulation(carried.model, speed, carried.grown_scene, carried.unrecorded_choice)
        size = 0.0
        for start, place in ((HIGH, int(high[nearest])), (LOW, int(low[nearest]))):
            motion = states[MOTIONS[place]].motion(nearest)
            if motion is None:
                continue
            state = carried_state(simulation.problem, motion)
            size = max(size, float(np.linalg.norm(PhaseSpace(simulation.problem).coordinates(state))))
            rows.append((about | {"start": start, "motion": MOTIONS[place]}, dwell(simulation, state, choice.revolutions)))
        for number, state in enumerate(random_states(simulation.problem, size, choice.starts if size else 0, choice.seed), 1):
            finish_revolution(simulation, state)
            rows.append((about | {"start": RANDOM, "motion": f"random_{number}"}, dwell(simulation, state, choice.revolutions)))
    return rows


def branches_of(
    carried: CarriedSweep, states: Mapping[str, SweptStates], choice: BranchChoice
) -> list[tuple[list[Orbit], list[Bifurcation]]]:
    """Branches of the periodic motions among those of the sweeps, the largest motions first, with their bifurcations."""
    levels = levels_of(states)
    branches: list[tuple[list[Orbit], list[Bifurcation]]] = []
    order = np.argsort(-np.nan_to_num(levels.mean), axis=None, kind="stable")
    for row, place in zip(*np.unravel_index(order, levels.mean.shape), strict=True):
        if len(branches) == choice.number:
            break
        speed, motion = float(levels.speeds[place]), states[MOTIONS[row]].motion(int(place))
        if motion is None or _known(branches, speed, float(levels.mean[row, place])):
            continue
        try:
            blade, orbit = _orbit(carried, speed, motion)
            if not _known(branches, speed, orbit.size):
                ends = max(float(levels.speeds[0]), blade.lowest_speed), float(levels.speeds[-1])
                orbits = branch_through(blade, orbit, *ends, choice.points)
                branches.append((orbits, events_of(blade, orbits)))
        except (NoOrbitError, LinAlgError):
            continue
    return branches


def _orbit(carried: CarriedSweep, speed: float, motion: CarriedMotion) -> tuple[PeriodicBlade, Orbit]:
    """The periodic motion that a motion at a speed (rad/s) comes near. Raises NoOrbitError where it does not recur."""
    blade = PeriodicBlade.stepped(carried.model, carried.grown_scene, carried.unrecorded_choice, speed)
    simulation = Simulation(carried.model, speed, blade.scene, blade.choice)
    recurrence, periods = recurrence_of(simulation, carried_state(simulation.problem, motion))
    if recurrence > _NEARLY:
        raise NoOrbitError("does not recur")
    return blade, orbit_after(blade, simulation, carried_state(simulation.problem, motion), periods)


def _known(branches: list[tuple[list[Orbit], list[Bifurcation]]], speed: float, rms: float) -> bool:
    """Whether a motion of this rms (m) at a speed (rad/s) is one of the branches that there are."""
    return any(lies_on(orbits, speed, rms, _SAME) for orbits, _ in branches)
