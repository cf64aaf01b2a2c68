"""Compiled engines of blades that press one elastic casing, step by step together. Light: numba is not imported."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from r37core.native import Sources, cached_object, load_function

from ..jump_numbers import LOSS_DD, LOSS_UD, LOSS_UU
from ..run_length import revolutions_at_once
from ..state import SimulationRecord, SimulationState
from .engine import SOURCES, CompiledEngine
from .kind import Kind
from .layout import Capacity
from .passage import Passage

_SOURCES = Sources(*SOURCES.files, "time_integration/compiled/lockstep_program.py")


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
        reached = int(_program(first.capacity, first.kind)(addresses.ctypes.data, blades))
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


@cache
def _program(capacity: Capacity, kind: Kind) -> Callable:
    """The program of lockstep_program, compiled if it is not there yet."""

    def build() -> bytes:
        from .lockstep_program import compile_lockstep

        return compile_lockstep(capacity, kind)

    code = cached_object("rotor_in_an_elastic_casing", _SOURCES, (capacity, kind), build)
    return load_function(code, "advance", ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64)
