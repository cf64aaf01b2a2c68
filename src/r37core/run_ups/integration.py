"""The time integration of a run-up: one blade, one scene, a speed that changes.

Casing, bars and steps are counted by angle, so they are those of a run at constant speed. From segment to segment the recursion
of the modes changes. Displacement and velocity go over as they are, and so into the modes of the next interval: these are
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
from r37core.time_integration.kept_numbers import energy_balance
from r37core.time_integration.problem import Problem, stable_problem
from r37core.time_integration.run_length import revolutions_at_once
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.state import Schedule
from r37core.time_integration.step_limit import UnstableStepError

from .schedule import ModalInterval, RunUp, schedule

_AT_ONCE = 64
"""Revolutions that the engine does in one call, fewer where they have many steps."""


@dataclass(frozen=True)
class IntegratedSegments:
    """What some segments leave behind: `samples` and `snapshots` as a simulation records them; `diverged`.

    `speeds` (rad/s), shape (samples,); `wear` (m), shape (samples,): the largest by the end of a sample's segment; `shapes`,
    shape (modes at rest, numbers): of the numbers of a snapshot; `snapshot_speeds` (rad/s), shape (snapshots,).
    """

    speeds: np.ndarray
    samples: np.ndarray
    wear: np.ndarray
    snapshots: np.ndarray
    snapshot_speeds: np.ndarray
    shapes: np.ndarray
    diverged: bool


class RunUpIntegration:
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
        coarsest = resolved_problem(model, low, scene, choice)
        self._model, self._scene = model, scene
        self._choice = replace(coarsest.choice, shorten=False, steps_per_sample=coarsest.grid.steps_per_sample)
        # between two speeds with a stable position there are only such
        self._of_ends = {high: self._problem(high), low: coarsest}
        stiffening = model.stiffness_per_square[0, 0] / model.squared_frequencies[0]
        self.intervals = schedule(run_up, choice.samples_per_revolution, float(stiffening))
        self._interval: ModalInterval | None = None
        self._simulation: Simulation | None = None
        self.state = self._of(self.intervals[0]).start()
        if wear is not None:
            assert self.state.wear is not None
            self.state.wear[:] = wear
        self.velocity = np.zeros(len(self.state.displacement))
        self.energy = self.stiffness_work = 0.0

    def _of(self, interval: ModalInterval) -> Simulation:
        """The simulation of an interval, in the memory of that of the interval before."""
        if self._simulation is None or interval is not self._interval:
            problem = self._of_ends.get(interval.speed) or self._problem(interval.speed)
            self._simulation = Simulation.at_speeds(problem, interval.distinct_speeds.speeds, self._simulation)
            self._interval = interval
        return self._simulation

    def _problem(self, speed: float) -> Problem:
        return Problem(self._model, speed, self._scene, self._choice)

    def balance(self) -> dict[str, np.ndarray]:
        """Work, loss and energy (J) of all stages together: see energy_balance."""
        assert self._simulation is not None
        held = self._simulation.problem.contact.static_energy(self.state.contact_force)
        loss = float(self.state.totals["loss"])
        return energy_balance(self._simulation.work(self.state), loss, self.energy + held, self.stiffness_work)

    def segments(self) -> Iterator[IntegratedSegments]:
        """Do all segments; ends with a stage that says so when the run diverges."""
        modes = None
        for interval in self.intervals:
            simulation = self._of(interval)
            if modes is not None:
                turned = simulation.problem.blade.modes.T @ modes
                # an elastic casing's modes, which come after the blade's, stay as they are
                self.state.displacement, self.velocity = (
                    np.concatenate([turned @ values[: modes.shape[1]], values[modes.shape[1] :]])
                    for values in (self.state.displacement, self.velocity)
                )
                # there may be more of them or fewer, where the fastest are left out
                self.state.increment = np.zeros_like(self.state.displacement)
            modes = simulation.problem.blade.modes
            for stage in self._segments_of(simulation, interval):
                yield stage
                if stage.diverged:
                    return

    def _segments_of(self, simulation: Simulation, interval: ModalInterval) -> Iterator[IntegratedSegments]:
        state, problem, constants = self.state, simulation.problem, simulation.segments
        shapes = problem.contact.state_shapes
        increments, begun = constants.increments, interval.distinct_speeds.of_segments[0]
        assert increments is not None
        simulation.engine.take(begun)
        state.increment[:] = increments.increment(begun, state.displacement, self.velocity)
        at_once = min(_AT_ONCE, revolutions_at_once(problem.grid.steps_per_revolution))
        for segments in interval.at_once(at_once * self._choice.samples_per_revolution):
            speed_indices, lasting = interval.distinct_speeds.of_segments[segments], interval.lasting[segments]
            call, first = Schedule(speed_indices, lasting, len(state.displacement)), state.samples
            record = simulation.follow(state, call)
            lasted = np.diff(np.cumsum(lasting).clip(max=len(record.samples)), prepend=0)
            reached = np.count_nonzero(lasted)
            self.velocity = increments.velocity(speed_indices[reached - 1], state.displacement, state.increment)
            self._balance(constants.recursion[speed_indices[:reached]], call.ends[:reached])
            speeds = np.repeat(interval.distinct_speeds.speeds[speed_indices], lasted)
            instants = problem.grid.snapshots_between(first, first + len(speeds))
            yield IntegratedSegments(
                speeds,
                record.samples,
                np.repeat(call.wear, lasted),
                record.snapshots,
                speeds[list(instants)],
                shapes,
                record.diverged,
            )

    def _balance(self, recursions: Recursion, ends: np.ndarray) -> None:
        """Add up the energies of segments; `ends`, shape (segments, 2, 2, modes): see Schedule."""
        begun, ended = (recursions.energy(ends[:, end, 0], ends[:, end, 1]) for end in range(2))
        self.stiffness_work += float(begun[0] - self.energy + np.sum(begun[1:] - ended[:-1]))
        self.energy = float(ended[-1])


_LARGEST_TURN = 3.0
"""Of a mode in a step (rad), up to which its velocity follows from two displacements."""


def resolved_problem(model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice) -> Problem:
    """The problem at a speed (rad/s), with steps so short that the velocity of every mode follows from two displacements.

    Raises what Problem raises; UnstableStepError for an explicit step that is too long.
    """
    problem = stable_problem(model, speed, scene, choice)
    fastest = problem.contact.highest_frequency
    if choice.integrator == CENTRAL_DIFFERENCE or fastest * problem.grid.time_step < _LARGEST_TURN:
        return problem
    limit = _LARGEST_TURN / fastest
    if not choice.shorten:
        raise UnstableStepError(
            f"time_step_s: {choice.time_step:g} s; allowed in run-ups: below {limit:.6g} s, so that the fastest mode "
            f"({fastest / 2e3 / np.pi:.1f} kHz) turns by less than {_LARGEST_TURN:g} rad in a step",
            limit,
        )
    return resolved_problem(model, speed, scene, replace(choice, time_step=0.99 * limit))
