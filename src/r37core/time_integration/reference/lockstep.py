"""Blades of a rotor step by step: all do a step of time before any does the next."""

from __future__ import annotations

from collections.abc import Sequence

from ..state import SimulationRecord, SimulationState
from .engine import ReferenceEngine
from .motion import MotionWithCasing


def advance_together(
    engines: Sequence[ReferenceEngine],
    states: Sequence[SimulationState],
    outs: Sequence[SimulationRecord],
    angles: Sequence[float],
    order: Sequence[int],
) -> tuple[list[int], list[float]]:
    """Do the steps of every row of the samples, as each blade stands at its angle (rad); returns the rows done of each and
    what each has worn off the bars (m).

    In a step the blades follow each other in `order`. All end with the sample in which one passes the limit. An elastic casing
    is one: each engine has its motion, under the forces of all blades, and the first in `order` counts its work.
    """
    motions, worn = [], [0.0] * len(engines)
    for engine, state, angle in zip(engines, states, angles, strict=True):
        engine.angle = angle
        motions.append(engine.motion.read(state))
    casings = [engine.motion for engine in engines if isinstance(engine.motion, MotionWithCasing)]
    for casing in casings:
        casing.counted = casing is engines[order[0]].motion
    steps, kept, done, bounded = engines[0].problem.grid.steps_per_sample, [0] * len(engines), 0, True
    while done < len(outs[0].samples) and bounded:
        for n in range(1, steps + 1):
            own = [engines[place].force(states[place]) for place in order]
            for place, force in zip(order, casings[0].pressed_by_all(own) if casings else own, strict=True):
                before = states[place].worn
                motions[place] = engines[place].step(motions[place], done * steps + n, states[place], force)
                worn[place] += states[place].worn - before
        for place, engine in enumerate(engines):
            out = SimulationRecord(outs[place].samples, outs[place].snapshots[kept[place] :])
            within, taken = engine.record(motions[place], 0, done, states[place], out)
            kept[place] += taken
            bounded &= within
        done += 1
    for engine, motion, state in zip(engines, motions, states, strict=True):
        engine.motion.write(motion, state)
    return [done] * len(engines), worn
