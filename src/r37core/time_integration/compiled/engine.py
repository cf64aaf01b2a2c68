"""The compiled engine: runs of laid-out problems by their program. Light: simulation jobs never import numba."""

import ctypes
from collections.abc import Callable, Sequence
from functools import cache
from typing import Self

import numpy as np

from r37core.machine_code.alignment import NUMBER_BYTES, address_of
from r37core.machine_code.native import Sources, cached_object, load_function

from ..integration_choice import MARKED, revolutions_at_once
from ..problem import Problem
from ..segments import Segments
from ..state import Schedule, SimulationRecord, SimulationState
from .laid_out import LaidOutProblem, put
from .layout import NORMAL, TANGENTIAL, Capacity, Kind

_COMPILED = ("contact_steps", "edge_steps", "layout", "quadratic_steps", "segment_steps", "program", "steps")
SOURCES = Sources(
    *(f"machine_code/{name}.py" for name in ("alignment", "code_hash", "kept", "lanes", "native", "program_constants")),
    "base/declared.py",
    "base/units.py",
    *(f"contact/{name}.py" for name in ("casing", "laws", "node_forces", "ring", "scene")),
    *(f"time_integration/compiled/{name}.py" for name in _COMPILED),
    "rom/quadratic_terms.py",
    "time_integration/state.py",
)
"""Files that the compiled time integration is made from: a change of what one of them does compiles it again."""


class CompiledEngine(LaidOutProblem):
    """The time integration of one problem, compiled for what its scene has; `beside`: see LaidOutProblem."""

    def __init__(self, problem: Problem, segments: Segments, beside: Self | None = None):
        super().__init__(problem, segments, beside)
        self.program = _program(self.capacity, self.kind)

    def advance(self, state: SimulationState, out: SimulationRecord, schedule: Schedule | None = None) -> int:
        """Do one block of steps per row of `out.samples`, from `state`, which is changed, and fill samples and snapshots.

        They are done as the `schedule` says, whose ends and wear are filled; without one at the first speed. Returns the blocks
        done: fewer when an output passed the limit or is NaN.
        """
        passage = Passage(self, state, out, schedule)
        go_on([passage], len(out.samples))
        passage.end()
        return passage.done


class Passage:
    """Blocks of steps from a `state` on, as a `schedule` says, with samples and snapshots into `out`; `done`: how many.

    The run starts so many samples after the blade has last `passed` angle 0, and `late`, a share of a sample, after time 0.
    The state is laid into the record once, and read at the `end`. Without a schedule it goes on in parts at the first speed.
    """

    def __init__(
        self,
        engine: CompiledEngine,
        state: SimulationState,
        out: SimulationRecord,
        schedule: Schedule | None = None,
        passed: int = 0,
        late: float = 0.0,
    ):
        self.engine, self._state, self._out, self._in_parts = engine, state, out, schedule is None
        self._schedule = schedule or Schedule([0], [0], len(state.displacement))
        self._grid, self._passed = engine.problem.grid, passed
        # where nothing pads the vectors the program writes into `out` itself
        width = engine.mode_lanes + (0 if engine.kind.published else 3 * engine.node_lanes)
        plain = np.array_equal(engine.snapshot_columns, np.arange(width))
        self._snapshots = out.snapshots if plain else np.empty((len(out.snapshots), width))
        self._ends = np.empty((*self._schedule.ends.shape[:-1], engine.mode_lanes))
        self.done = 0
        put(engine.record, u=engine.lane_values(state.displacement), increment=engine.lane_values(state.increment))
        touched = np.packbits(state.touched, bitorder="little")
        put(engine.record, worn=0.0, largest_wear=state.wear.max(initial=0.0), touched=touched)
        put(engine.record, totals=state.totals, penetration=state.penetration, last_position=state.bar_position)
        if self._grid.choice.second_order:
            normal = state.contact_force[NORMAL]
            put(engine.record, force=normal, friction_force=state.contact_force[TANGENTIAL:], follows=np.any(normal < 0.0))
        self._openings = engine.problem.casing.opening(state.samples + np.arange(len(out.samples)))
        arrays = {
            "speed_indices": self._schedule.speed_indices,
            "lasting": self._schedule.samples,
            "ends": self._ends,
            "worn": self._schedule.wear,
            "wear": state.wear,
            "openings": self._openings,
            "samples": out.samples,
            "snapshots": self._snapshots,
            "constants": engine.constants,
        }
        addresses = {name: address_of(array, NUMBER_BYTES) for name, array in arrays.items()}
        put(engine.record["call"], **addresses, ahead=(late - passed) * self._grid.steps_per_sample)
        # steps are counted from the last pass of angle 0 on
        put(engine.record, samples_before_snapshots=self._grid.samples_before_snapshots + passed)

    def blocks_at_once(self, blades: int) -> int:
        """Blocks of one call in which so many blades go on: about STEPS_AT_ONCE up to the end of a revolution, at most MARKED.

        A run may be stopped there with the same bits. With a schedule they are what that has.
        """
        if not self._in_parts:
            return len(self._out.samples)
        grid, per_revolution = self._grid, self._grid.choice.samples_per_revolution
        since = (self._state.samples + self._passed + self.done) % per_revolution
        return min(revolutions_at_once(blades * grid.steps_per_revolution), MARKED) * per_revolution - since

    def ask(self, blocks: int) -> None:
        """Have the record say that so many more are to be done."""
        grid, first = self._grid, self._state.samples
        step = (first + self._passed + self.done) * grid.steps_per_sample
        kept = grid.snapshots_after(first + self.done) - grid.snapshots_after(first)
        put(self.engine.record["call"], first_step=step, blocks=blocks, done=self.done, kept=kept)
        if self._in_parts:
            self._schedule.samples[0] = blocks

    def go_on(self, blocks: int) -> None:
        """Take so many more blocks as done, and mark the totals up to there."""
        self.done += blocks
        self._state.marks.append((self._state.samples + self.done, self.engine.record[0]["totals"].copy()))

    @property
    def worn(self) -> float:
        """Wear (m3) of the lining by this blade, up to now."""
        return float(self.engine.record[0]["worn"])

    def end(self) -> None:
        """Read the state that is reached, but for the number of samples."""
        engine, state, m = self.engine, self._state, self.engine.record[0]
        nodes, columns = len(state.touched), engine.mode_columns
        state.displacement[:], state.increment[:] = m["u"][columns], m["increment"][columns]
        self._schedule.ends[:] = self._ends[..., columns]
        state.touched[:] = np.unpackbits(m["touched"].astype(np.uint8), bitorder="little")[:nodes]
        state.totals[()] = m["totals"]
        state.penetration[:], state.bar_position[:] = m["penetration"][:nodes], m["last_position"][:nodes]
        if self._grid.choice.second_order:
            state.contact_force[NORMAL] = m["force"][:nodes]
            state.contact_force[TANGENTIAL:] = m["friction_force"][:, :nodes]
        if self._snapshots is not self._out.snapshots:
            self._out.snapshots[:] = self._snapshots[:, engine.snapshot_columns]


def go_on(passages: Sequence[Passage], blocks: int) -> None:
    """Do so many more blocks of blades that go step by step together; fewer when an output passes the limit or is NaN.

    An interrupt is seen between two calls.
    """
    engine, part, reached = passages[0].engine, 0, 0
    addresses = np.concatenate([passage.engine.addresses for passage in passages])
    while blocks > 0 and reached == part:
        part = min(blocks, passages[0].blocks_at_once(len(passages)))
        for passage in passages:
            passage.ask(part)
        reached = engine.program(addresses.ctypes.data, len(addresses))
        for passage in passages:
            passage.go_on(reached)
        blocks -= reached


def advance_in_lockstep(
    engines: Sequence[CompiledEngine], states: Sequence[SimulationState], outs: Sequence[SimulationRecord], order: Sequence[int]
) -> tuple[list[int], list[float]]:
    """Do the steps of every row of the samples; returns the rows done of each, and what each has worn off the lining (m3).

    `engines` of a rotor's blades, of one capacity; their forces on the casing are summed in this `order`. Each has the casing's
    modes; these are made alike to the last bit, and those of the first count for their loss.
    """
    for place in order[1:]:
        _take_casing(engines[place], engines[order[0]])
    passages = [Passage(engine, state, out) for engine, state, out in zip(engines, states, outs, strict=True)]
    go_on([passages[place] for place in order], len(outs[0].samples))
    for passage in passages:
        passage.end()
    return [passage.done for passage in passages], [passage.worn for passage in passages]


def _take_casing(engine: CompiledEngine, first: CompiledEngine) -> None:
    """Give an engine the constants of the casing's modes of another one, but for their loss."""
    own, other = engine.record[0]["speed"], first.record[0]["speed"]
    mine, theirs = engine.casing_lanes, first.casing_lanes
    for name in ("keep", "pull", "inverse"):
        own[name][..., mine] = other[name][..., theirs]
    own["loss"][mine] = 0.0


@cache
def _program(capacity: Capacity, kind: Kind) -> Callable:
    """The program of time_integration.compiled.program, compiled if it is not there yet."""

    def build() -> bytes:
        from .program import compile_integration

        return compile_integration(capacity, kind)

    code = cached_object("time_integration", SOURCES, (capacity, kind), build)
    return load_function(code, "advance", ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64)
