"""The time integration of a run-up: one blade, one scene, a speed that changes.

Casing, bars and steps are counted by angle, so they are those of a run at constant speed. From stretch to stretch the recursion
of the modes changes. Displacement and velocity go over as they are, and so into the modes of the next segment: these are
orthonormal, so the projection on all of them loses nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.clearance import check_room
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, Recursion
from r37core.time_integration.problem import Problem, stable_problem
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import energy_balance
from r37core.time_integration.state import Course
from r37core.time_integration.step_limit import UnstableStepError

from .schedule import RunUp, Segment, schedule

_AT_ONCE = 64
"""Revolutions that the engine does in one call."""


@dataclass(frozen=True)
class Stage:
    """What some stretches leave behind: `samples` and `snapshots` as a simulation records them; `diverged`.

    `speeds` (rad/s), shape (samples,); `wear` (m), shape (samples,): the largest by the end of a sample's stretch; `shapes`,
    shape (modes at rest, numbers): of the numbers of a snapshot; `snapshot_speeds` (rad/s), shape (snapshots,).
    """

    speeds: np.ndarray
    samples: np.ndarray
    wear: np.ndarray
    snapshots: np.ndarray
    snapshot_speeds: np.ndarray
    shapes: np.ndarray
    diverged: bool


class March:
    """A run-up as it goes: the `state` of the time integration, and the `velocity` of the modes, shape (modes,).

    `energy` (J): of the stepped modes; `stiffness_work` (J): what the change of the stiffness with the speed has brought to it.
    Both are those of the last stage's end. `wear` (m), shape (rings, bars): of a lining that is worn at the beginning.

    Raises what Problem raises at either end, with the steps of the lower speed, which are the longest; ValueError for a model
    with a Coriolis matrix: complex modes turn into each other as the speed changes.
    """

    def __init__(
        self, model: ContactModel, scene: Scene, choice: IntegrationChoice, run_up: RunUp, wear: np.ndarray | None = None
    ):
        if model.coriolis is not None:
            raise ValueError("run-ups do not carry the Coriolis force")
        low, high = sorted((run_up.start, run_up.stop))
        check_room(model, scene, np.array([low, *scene.casing.growth_speeds, high]).clip(low, high))
        coarsest = told_problem(model, low, scene, choice)
        self._model, self._scene = model, scene
        self._choice = replace(coarsest.choice, shorten=False, steps_per_sample=coarsest.steps_per_sample)
        # between two speeds with a stable position there are only such
        self._of_ends = {high: self._problem(high), low: coarsest}
        stiffening = model.stiffness_per_square[0, 0] / model.squared_frequencies[0]
        self.segments = schedule(run_up, choice.samples_per_revolution, float(stiffening))
        self._segment: Segment | None = None
        self._simulation: Simulation | None = None
        self.state = self._of(self.segments[0]).start()
        if wear is not None:
            assert self.state.wear is not None
            self.state.wear[:] = wear
        self.velocity = np.zeros(len(self.state.displacement))
        self.energy = self.stiffness_work = 0.0

    def _of(self, segment: Segment) -> Simulation:
        """The simulation of a segment, in the room of that of the segment before."""
        if self._simulation is None or segment is not self._segment:
            problem = self._of_ends.get(segment.speed) or self._problem(segment.speed)
            self._simulation = Simulation.at_speeds(problem, segment.paces.speeds, self._simulation)
            self._segment = segment
        return self._simulation

    def _problem(self, speed: float) -> Problem:
        return Problem(self._model, speed, self._scene, self._choice)

    def balance(self) -> dict[str, np.ndarray]:
        """Work, loss and energy (J) of all stages together: see energy_balance."""
        assert self._simulation is not None
        held = self._simulation.problem.static_energy(self.state.contact_force)
        loss = float(self.state.totals["loss"])
        return energy_balance(self._simulation.work(self.state), loss, self.energy + held, self.stiffness_work)

    def stages(self) -> Iterator[Stage]:
        """Do all stretches; ends with a stage that says so when the run diverges."""
        modes = None
        for segment in self.segments:
            simulation = self._of(segment)
            if modes is not None:
                turned = simulation.problem.modes.T @ modes
                # an elastic casing's modes, which come after the blade's, stay as they are
                self.state.displacement, self.velocity = (
                    np.concatenate([turned @ one[: modes.shape[1]], one[modes.shape[1] :]])
                    for one in (self.state.displacement, self.velocity)
                )
                # there may be more of them or fewer, where the fastest are left out
                self.state.increment = np.zeros_like(self.state.displacement)
            modes = simulation.problem.modes
            for stage in self._stages_of(simulation, segment):
                yield stage
                if stage.diverged:
                    return

    def _stages_of(self, simulation: Simulation, segment: Segment) -> Iterator[Stage]:
        state, problem, paces = self.state, simulation.problem, simulation.paces
        shapes = problem.state_shapes
        increments, begun = paces.increments, segment.paces.of_stretches[0]
        assert increments is not None
        simulation.engine.take(begun)
        state.increment[:] = increments.increment(begun, state.displacement, self.velocity)
        for stretches in segment.at_once(_AT_ONCE * self._choice.samples_per_revolution):
            places, lasting = segment.paces.of_stretches[stretches], segment.lasting[stretches]
            course, first = Course(places, lasting, len(state.displacement)), state.samples
            record = simulation.follow(state, course)
            lasted = np.diff(np.cumsum(lasting).clip(max=len(record.samples)), prepend=0)
            reached = np.count_nonzero(lasted)
            self.velocity = increments.velocity(places[reached - 1], state.displacement, state.increment)
            self._balance(paces.recursion[places[:reached]], course.ends[:reached])
            speeds = np.repeat(segment.paces.speeds[places], lasted)
            instants = problem.snapshots_between(first, first + len(speeds))
            yield Stage(
                speeds,
                record.samples,
                np.repeat(course.wear, lasted),
                record.snapshots,
                speeds[list(instants)],
                shapes,
                record.diverged,
            )

    def _balance(self, recursions: Recursion, ends: np.ndarray) -> None:
        """Add up the energies of stretches; `ends`, shape (stretches, 2, 2, modes): see Course."""
        begun, ended = (recursions.energy(ends[:, end, 0], ends[:, end, 1]) for end in range(2))
        self.stiffness_work += float(begun[0] - self.energy + np.sum(begun[1:] - ended[:-1]))
        self.energy = float(ended[-1])


_LARGEST_TURN = 3.0
"""Of a mode in a step (rad), up to which its velocity follows from two displacements."""


def told_problem(model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice) -> Problem:
    """The problem at a speed (rad/s), with steps so short that every mode tells its velocity.

    Raises what Problem raises; UnstableStepError for an explicit step that is too long.
    """
    problem = stable_problem(model, speed, scene, choice)
    fastest = problem.highest_frequency
    if choice.integrator == CENTRAL_DIFFERENCE or fastest * problem.time_step < _LARGEST_TURN:
        return problem
    limit = _LARGEST_TURN / fastest
    if not choice.shorten:
        raise UnstableStepError(
            f"time_step_s: {choice.time_step:g} s; allowed in run-ups: below {limit:.6g} s, so that the fastest mode "
            f"({fastest / 2e3 / np.pi:.1f} kHz) turns by less than {_LARGEST_TURN:g} rad in a step",
            limit,
        )
    return told_problem(model, speed, scene, replace(choice, time_step=0.99 * limit))
