"""Simulation of a blade at one speed in one scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .compiled.engine import CompiledEngine
from .initial_motion import InitialMotion
from .integration_choice import IntegrationChoice, revolutions_at_once
from .problem import Problem, stable_problem
from .reference.engine import ReferenceEngine
from .segments import own_segment, segments_at
from .state import Schedule, SimulationRecord, SimulationState

TIP_POINTS, DIRECTIONS = ("leading_edge", "trailing_edge"), ("normal", "radial", "tangential")
"""Content of the samples: every direction at the first tip point, then at the second."""

LEADING_EDGE = [DIRECTIONS.index("normal"), DIRECTIONS.index("tangential")]
"""Samples of the leading edge's motion, normal and tangential."""

_ENGINES: dict[str, type[CompiledEngine] | type[ReferenceEngine]] = {"compiled": CompiledEngine, "reference": ReferenceEngine}


class Simulation:
    """The time integration of one blade at one speed in one scene: its `problem`, and the `engine` that advances a state.

    Raises what Problem raises, of the step that `choice` leaves.
    """

    def __init__(self, model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice):
        if scene.rotor is not None:
            raise ValueError("a scene with a rotor: see BladesSimulation")
        self._take(stable_problem(model, speed, scene, choice))

    @classmethod
    def build(cls, problem: Problem, speeds: np.ndarray | None = None, before: Any = None, beside: Any = None) -> Simulation:
        """Simulation of a problem; with `speeds` (rad/s), shape (speeds,), its engine goes at these in the problem's modes.

        `before`, `beside`: engines of the same scene and choice, see CompiledEngine.
        """
        simulation = cls.__new__(cls)
        simulation._take(problem, speeds, before, beside)
        return simulation

    def _take(self, problem: Problem, speeds: np.ndarray | None = None, before: Any = None, beside: Any = None) -> None:
        self.problem, self.segments = problem, own_segment(problem) if speeds is None else segments_at(problem, speeds)
        # of one choice, so of one class
        self.engine: Any = _ENGINES[problem.choice.engine](problem, self.segments, before, beside)

    def start(self, motion: InitialMotion | None = None) -> SimulationState:
        """The blade at rest or in `motion`, in an unworn lining, or in one that it has cut its way into.

        Raises what InitialMotion.put raises.
        """
        state = rest_state(self.problem)
        if motion is not None:
            motion.put(self.problem, state)
        return state

    def advance(self, state: SimulationState, revolutions: int) -> SimulationRecord:
        """Go on by `revolutions` from `state`, which is changed."""
        return self.advance_samples(state, revolutions * self.problem.choice.samples_per_revolution)

    def advance_samples(self, state: SimulationState, samples: int) -> SimulationRecord:
        """Go on by a number of samples from `state`, which is changed."""
        first = state.samples
        out = self.room(first, samples)
        return self.recorded(first, out, self.fill(state, out, first, samples))

    def fill(self, state: SimulationState, out: SimulationRecord, first: int, samples: int) -> int:
        """Go on by a number of samples from `state`, which is changed, in the room `out` for those after the run's `first`.

        Returns the samples done: fewer when an output passes the limit or is NaN.
        """
        begun, done, reached, per_revolution = state.samples, 0, True, self.problem.choice.samples_per_revolution
        samples_at_once = revolutions_at_once(self.problem.grid.steps_per_revolution) * per_revolution
        while done < samples and reached:
            part, row = min(samples - done, samples_at_once - (begun + done) % per_revolution), begun + done - first
            snapshots = slice(self._snapshots(first, row), self._snapshots(first, row + part))
            rows = SimulationRecord(out.samples[row : row + part], out.snapshots[snapshots])
            state.samples = begun + done
            advanced = self.engine.advance(state, rows, Schedule([0], [part], len(state.displacement)))
            done, reached = done + advanced, advanced == part
        state.samples = begun + samples
        return done

    def follow(self, state: SimulationState, schedule: Schedule) -> SimulationRecord:
        """Go on in the constant-speed segments of a schedule from `state`, which is changed."""
        first = state.samples
        out = self.room(first, int(schedule.samples.sum()))
        done = self.engine.advance(state, out, schedule)
        state.samples = first + len(out.samples)
        return self.recorded(first, out, done)

    def room(self, first: int, samples: int) -> SimulationRecord:
        """Room for what an engine leaves behind in so many samples after the `first`."""
        outputs, numbers = self.problem.contact.output_operator.shape
        return SimulationRecord(np.empty((samples, outputs)), np.empty((self._snapshots(first, samples), numbers)))

    def recorded(self, first: int, out: SimulationRecord, done: int) -> SimulationRecord:
        """Record of what an engine has left in the room `out` when it has `done` so many samples."""
        tip_outputs = len(TIP_POINTS) * len(DIRECTIONS)
        casing = None if self.problem.casing.ring is None else out.samples[:done, tip_outputs:]
        return SimulationRecord(
            out.samples[:done, :tip_outputs], out.snapshots[: self._snapshots(first, done)], self.diverged(out, done), casing
        )

    def diverged(self, out: SimulationRecord, done: int) -> bool:
        """True where the last of `done` samples is beyond the limit, or is NaN."""
        return done > 0 and not np.abs(out.samples[done - 1]).max() < self.problem.scene.divergence_limit

    def _snapshots(self, first: int, samples: int) -> int:
        """Number of snapshots in so many samples after the `first`."""
        return self.problem.grid.snapshots_after(first + samples) - self.problem.grid.snapshots_after(first)

    def energy(self, state: SimulationState) -> float:
        """Energy (J) of the vibration, that of the static modes in it; see Recursion."""
        stepped = float(self.problem.contact.recursion.energy(state.displacement, state.increment))
        return stepped + self.problem.contact.static_energy(state.contact_force)

    def work(self, state: SimulationState) -> float:
        """Work (J) of the contact forces since the start: on the stepped modes, and all that the static ones hold."""
        return float(state.totals["work"]) + self.problem.contact.static_energy(state.contact_force)


def rest_state(problem: Problem) -> SimulationState:
    """A blade at rest, in an unworn lining, or in one that it has cut its way into."""
    directions, nodes, modes = problem.contact.displacement_operator.shape
    wear = None if problem.scene.lining is None else np.zeros((nodes, problem.casing.bars))
    if wear is not None and problem.scene.casing.changes_with_speed:
        wear += problem.casing.initial_wear
    motion, places = (np.zeros(modes), np.zeros(modes)), (np.zeros(nodes), np.zeros(nodes))
    state = SimulationState(*motion, wear, np.zeros(nodes, dtype=bool), np.zeros((directions, nodes)), *places)
    state.totals["largest_penetration"] = problem.edge.penetration_at_rest
    return state
