"""Simulation of one blade at one speed in one scene."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import ClassVar, Self

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .carrying import CarriedMotion
from .compiled.engine import CompiledEngine
from .finished_run import FinishedRun
from .integration_choice import IntegrationChoice
from .problem import Problem, stable_problem
from .segments import Segments, own_segment
from .settling import Ending, has_settled, parts_of_run, revolution_rms
from .state import Schedule, SimulationRecord, SimulationState

TIP_POINTS, DIRECTIONS = ("leading_edge", "trailing_edge"), ("normal", "radial", "tangential")
"""Content of the samples: every direction at the first tip point, then at the second."""

LEADING_EDGE = [DIRECTIONS.index("normal"), DIRECTIONS.index("tangential")]
"""Samples of the leading edge's motion, normal and tangential."""


class Simulation:
    """The time integration of one blade at one speed in one scene: its `problem`, and the `engine` that advances a state.

    Raises what Problem raises, of the step that `choice` leaves.
    """

    engine_class: ClassVar[type[CompiledEngine]] = CompiledEngine
    """Class of the engine; another one can take its place in a subclass."""

    def __init__(self, model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice):
        if scene.rotor is not None:
            raise ValueError("a scene with a rotor: see RotorSimulation")
        self.problem = stable_problem(model, speed, scene, choice)
        self.engine = self.engine_class(self.problem, own_segment(self.problem))

    @classmethod
    def build(cls, problem: Problem, segments: Segments | None = None, beside: CompiledEngine | None = None) -> Self:
        """Simulation of a problem, in the `segments` of several speeds if they are given.

        `beside`: an engine of the same scene and choice, see LaidOutProblem.
        """
        simulation = cls.__new__(cls)
        simulation.problem = problem
        simulation.engine = cls.engine_class(problem, segments or own_segment(problem), beside)
        return simulation

    def start(self, motion: CarriedMotion | None = None) -> SimulationState:
        """The blade at rest or in `motion`, in an unworn lining, or in one that it has cut its way into."""
        state = rest_state(self.problem)
        if motion is not None:
            motion.put(self.problem, state)
        return state

    def run(self, motion: CarriedMotion | None = None) -> FinishedRun:
        """The run of the choice from the start on, which ends as it has settled where that is chosen; see has_settled.

        Snapshots are those of the last `snapshot_revolutions`.
        """
        problem, choice, state = self.problem, self.problem.choice, self.start(motion)
        per_revolution, energy = choice.samples_per_revolution, self.energy(state)
        risen = problem.casing.rise_time / (problem.grid.steps_per_revolution * problem.grid.time_step)
        risen = max((risen, *problem.scene.casing.change_revolutions[-1:]))
        parts, out = parts_of_run(choice), self.room(0, choice.revolutions * per_revolution)
        done, settled, growth, steps, rms = 0, False, 0.0, 0.0, np.empty(0)
        wear, contact = state.wear.copy(), float(state.totals["steps_in_contact"])
        for part in self.parts(state, [count * per_revolution for count in parts], out):
            done += len(part.samples)
            growth, steps = float(np.max(state.wear - wear, initial=0.0)), float(state.totals["steps_in_contact"]) - contact
            wear, contact = state.wear.copy(), contact + steps
            if choice.until_settled and not part.diverged:
                rms = np.concatenate([rms, revolution_rms(part.samples[:, LEADING_EDGE], per_revolution)])
                settled = has_settled(rms, parts[-1], growth, risen)
            if settled:
                break
        record = self.recorded(0, out, done)
        if choice.until_settled:
            instants = choice.snapshots_per_revolution * choice.snapshot_revolutions
            record = replace(record, snapshots=record.snapshots[max(len(record.snapshots) - instants, 0) :])
        return FinishedRun(
            problems=[problem],
            states=[state],
            records=[record],
            ending=Ending(state.samples // per_revolution, settled, growth, steps),
            energy_change=self.energy(state) - energy,
            contact_work=self.work(state),
        )

    def parts(
        self, state: SimulationState, samples: Iterable[int], out: SimulationRecord | None = None
    ) -> Iterator[SimulationRecord]:
        """Go on by these numbers of samples one after another from `state`, which is changed, until a part diverges.

        Yields the record of each; with `out`, the room for all of them, they lie there one after another.
        """
        first, grid = state.samples, self.problem.grid
        for count in samples:
            done, room = state.samples - first, None
            if out is not None:
                snapshots = slice(*(len(grid.snapshots_between(first, first + end)) for end in (done, done + count)))
                room = SimulationRecord(out.samples[done : done + count], out.snapshots[snapshots])
            record = self.advance_samples(state, count, room=room)
            yield record
            if record.diverged:
                return

    def advance(self, state: SimulationState, revolutions: int) -> SimulationRecord:
        """Go on by `revolutions` from `state`, which is changed."""
        return self.advance_samples(state, revolutions * self.problem.choice.samples_per_revolution)

    def advance_samples(
        self, state: SimulationState, samples: int, schedule: Schedule | None = None, room: SimulationRecord | None = None
    ) -> SimulationRecord:
        """Go on by a number of samples from `state`, which is changed: at one speed, or in the segments of a `schedule`.

        Fewer are done where an output passes the limit or is NaN. `room`: for what the engine leaves behind, if there is some.
        """
        first = state.samples
        out = room or self.room(first, samples)
        done = self.engine.advance(state, out, schedule)
        state.samples = first + samples
        return self.recorded(first, out, done)

    def room(self, first: int, samples: int) -> SimulationRecord:
        """Room for what an engine leaves behind in so many samples after the `first`."""
        outputs, numbers = self.problem.contact.output_operator.shape
        snapshots = len(self.problem.grid.snapshots_between(first, first + samples))
        return SimulationRecord(np.empty((samples, outputs)), np.empty((snapshots, numbers)))

    def recorded(self, first: int, out: SimulationRecord, done: int) -> SimulationRecord:
        """Record of what an engine has left in the room `out` when it has `done` so many samples."""
        tip_outputs = len(TIP_POINTS) * len(DIRECTIONS)
        casing = None if self.problem.casing.ring is None else out.samples[:done, tip_outputs:]
        snapshots = out.snapshots[: len(self.problem.grid.snapshots_between(first, first + done))]
        return SimulationRecord(out.samples[:done, :tip_outputs], snapshots, self.diverged(out, done), casing)

    def diverged(self, out: SimulationRecord, done: int) -> bool:
        """True where the last of `done` samples is beyond the limit, or is NaN."""
        return done > 0 and not np.abs(out.samples[done - 1]).max() < self.problem.scene.divergence_limit

    def energy(self, state: SimulationState) -> float:
        """Energy (J) of the vibration, that of the static modes in it; see Recursion."""
        contact = self.problem.contact
        stepped = float(contact.recursion.energy(state.displacement, state.increment))
        stepped += float(contact.second_order_energy(state.displacement, state.increment))
        return stepped + contact.static_energy(state.contact_force)

    def work(self, state: SimulationState) -> float:
        """Work (J) of the contact forces since the start: on the stepped modes, and all that the static ones hold."""
        return float(state.totals["work"]) + self.problem.contact.static_energy(state.contact_force)


def rest_state(problem: Problem) -> SimulationState:
    """A blade at rest, in an unworn lining, or in one that it has cut its way into."""
    directions, nodes, modes = problem.contact.displacement_operator.shape
    wear = np.zeros((nodes, problem.casing.bars))
    if problem.scene.casing.changes_with_speed:
        wear += problem.casing.initial_wear
    motion, places = (np.zeros(modes), np.zeros(modes)), (np.zeros(nodes), np.zeros(nodes))
    state = SimulationState(*motion, wear, np.zeros(nodes, dtype=bool), np.zeros((directions, nodes)), *places)
    state.totals["largest_penetration"] = problem.edge.penetration_at_rest
    return state
