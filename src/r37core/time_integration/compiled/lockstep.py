"""Compiled engines of blades that press one elastic casing, step by step together. Light: numba is not imported."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..jump_numbers import LOSS_DD, LOSS_UD, LOSS_UU
from ..run_length import revolutions_at_once
from ..state import SimulationRecord, SimulationState
from .engine import CompiledEngine
from .passage import Passage


def advance_in_lockstep(
    engines: Sequence[CompiledEngine],
    states: Sequence[SimulationState],
    outs: Sequence[SimulationRecord],
    order: Sequence[int],
) -> tuple[list[int], list[float]]:
    """Do the steps of every row of the samples; returns the rows done of each, and what each has worn off the bars (m).

    `engines` of a rotor's blades, of one capacity; their forces on the casing are summed in this `order`. Each has the casing's
    modes; these are made alike to the last bit, and those of the first count for their loss.
    """
    first, blades = engines[order[0]], len(engines)
    for place in order[1:]:
        _take_casing(engines[place], first)
    addresses = np.array([engines[place].address for place in order], dtype=np.uint64)
    passages = [Passage(engine, state, out) for engine, state, out in zip(engines, states, outs, strict=True)]
    done, samples, grid = 0, len(outs[0].samples), first.problem.grid
    blocks = reached = revolutions_at_once(blades * grid.steps_per_revolution) * grid.choice.samples_per_revolution
    while done < samples and reached == blocks:
        blocks = min(blocks, samples - done)
        for passage in passages:
            passage.ask(blocks)
        reached = first.call_together(addresses)
        done += reached
        for passage in passages:
            passage.done = done
    for passage in passages:
        passage.end()
    return [done] * blades, [passage.worn for passage in passages]


def _take_casing(engine: CompiledEngine, first: CompiledEngine) -> None:
    """Give an engine the constants of the casing's modes of another one, but for their loss."""
    own, other = engine.record[0]["speed"], first.record[0]["speed"]
    mine, theirs = engine.casing_lanes, first.casing_lanes
    for name in ("keep", "pull", "inverse", "inverse_keep", "amplitude_by_u", "amplitude_by_d", "jumps"):
        own[name][..., mine] = other[name][..., theirs]
    own["loss"][mine] = 0.0
    own["jumps"][:, [LOSS_UU, LOSS_UD, LOSS_DD], mine] = 0.0
