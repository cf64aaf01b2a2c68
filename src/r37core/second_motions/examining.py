"""Examination of the motions that sweeps have found: dwells where they differ."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from r37core.time_integration.motion_kind import PhaseSpace
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.state import SimulationState

from .choice import DOWN, MOTIONS, UP, DwellChoice
from .dwelling import HIGH, LOW, RANDOM, Dwell, dwell, finish_revolution, random_states
from .motion_files import SweptStates, levels_of
from .ranges import MotionLevels
from .sweeping import CarriedSweep

NEAR = 5
"""Steps of the sweeps up to which the motions of a range are looked for at a speed that is dwelt on."""


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

    Each with its `speed`, its `start`, and the levels of the two motions: those at the nearest speed at which motions differ,
    NaN where that is more than NEAR steps away.
    """
    levels, rows = levels_of(states), []
    differing = np.flatnonzero(levels.differ)
    for speed in speeds_dwelt_on(levels, choice):
        places = {HIGH: levels.high, LOW: levels.low}
        nearest = int(np.argmin(np.abs(levels.speeds - speed)))
        close = differing[np.abs(levels.speeds[differing] - speed) <= NEAR * carried.sweep.step]
        level = dict.fromkeys(places, np.nan)
        if len(close):
            judged = close[np.argmin(np.abs(levels.speeds[close] - speed))]
            level = {start: float(levels.mean[several[judged], judged]) for start, several in places.items()}
        about = {"speed": speed, "lined": int(carried.scene.lining is not None)}
        about |= {f"level_{start}": value for start, value in level.items()}
        simulation, size = Simulation(carried.model, speed, carried.grown_scene, carried.unrecorded_choice), 0.0
        for start, several in places.items():
            motion = MOTIONS[several[nearest]]
            begun = begun_as(carried, states, motion, nearest, simulation)
            if begun is not None:
                size = max(size, float(np.linalg.norm(PhaseSpace(simulation.problem).coordinates(begun[1]))))
                rows.append((about | {"start": start, "motion": motion}, dwell(*begun, choice.revolutions)))
        for number, state in enumerate(random_states(simulation.problem, size, choice.starts, choice.seed), 1):
            finish_revolution(simulation, state)
            rows.append((about | {"start": RANDOM, "motion": f"random_{number}"}, dwell(simulation, state, choice.revolutions)))
    return rows


def begun_as(
    carried: CarriedSweep, states: Mapping[str, SweptStates], motion: str, place: int, simulation: Simulation
) -> tuple[Simulation, SimulationState] | None:
    """Simulation and state that a dwell in a motion of the sweeps starts from; None where there is none.

    It goes on where the sweep has left the speed at this place. On a lining that is new at each speed it begins as the sweep
    did there, since the motion belongs to the lining that it has worn.
    """
    kept = states[motion]
    if carried.scene.lining is None or kept.worn:
        ended = kept.motion(place)
        return None if ended is None else (simulation, simulation.start(ended))
    before = {UP: place - 1, DOWN: place + 1}.get(motion, -1)
    ended = kept.motion(before) if 0 <= before < len(kept.speeds) else None
    if ended is not None:
        return simulation, simulation.start(ended)
    rising = Simulation(carried.model, simulation.problem.speed, carried.rising_scene, carried.unrecorded_choice)
    return rising, rising.start()
