"""The time integration of a run-up: one blade, one scene, a speed that changes.

Casing, bars and steps are counted by angle, so they are those of a run at constant speed. From segment to segment the recursion
of the modes changes. Displacement and velocity go over as they are, and so into the modes of the next interval: these are
orthonormal, so the projection on all of them loses nothing.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.carrying import resolved_problem
from r37core.time_integration.clearance import check_room
from r37core.time_integration.integration_choice import IntegrationChoice, revolutions_at_once
from r37core.time_integration.kept_numbers import energy_balance
from r37core.time_integration.problem import Problem
from r37core.time_integration.segments import segments_at
from r37core.time_integration.simulate import Simulation, rest_state
from r37core.time_integration.state import Schedule

from .run_up_schedule import RunUp, schedule

_AT_ONCE = 64
"""Revolutions that the engine does in one call, fewer where they have many steps."""


@dataclass(frozen=True)
class IntegratedSegments:
    """Record of some segments: `samples` and `snapshots` as a simulation records them; `diverged`.

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
    Both are those of the last stage's end.

    Raises what Problem raises at either end, with the steps of the lower speed, which are the longest.
    """

    simulation_class: ClassVar[type[Simulation]] = Simulation
    """Class of the simulation of each interval."""

    def __init__(self, model: ContactModel, scene: Scene, choice: IntegrationChoice, run_up: RunUp):
        low, high = sorted((run_up.start, run_up.stop))
        check_room(model, scene, np.array([low, *scene.casing.growth_speeds, high]).clip(low, high))
        coarsest = resolved_problem(model, low, scene, choice)
        self.model, self.run_up, self._scene = model, run_up, scene
        self.choice = replace(coarsest.choice, shorten=False, steps_per_sample=coarsest.grid.steps_per_sample)
        # between two speeds with a stable position there are only such
        self._end_problems = {low: coarsest}
        self._end_problems[high] = self._problem(high)
        stiffening = model.stiffness_per_square[0, 0] / model.squared_frequencies[0]
        self.intervals = schedule(run_up, choice.samples_per_revolution, float(stiffening))
        self.start()

    def start(self, wear: np.ndarray | None = None) -> None:
        """Put the blade at rest at the first speed, in a lining with this `wear` (m), shape (rings, bars), None: as new."""
        self._simulation: Simulation | None = None
        self.state = rest_state(self._problem(self.intervals[0].speed))
        if wear is not None:
            self.state.wear[:] = wear
        self.velocity = np.zeros(len(self.state.displacement))
        self.energy = self.stiffness_work = 0.0

    def _problem(self, speed: float) -> Problem:
        return self._end_problems.get(speed) or Problem(self.model, speed, self._scene, self.choice)

    @property
    def balance(self) -> dict[str, np.ndarray]:
        """Work, loss and energy (J) of all stages together: see energy_balance."""
        assert self._simulation is not None
        held = self._simulation.problem.contact.static_energy(self.state.contact_force)
        loss = float(self.state.totals["loss"])
        return energy_balance(self._simulation.work(self.state), loss, self.energy + held, self.stiffness_work)

    def segments(self) -> Iterator[IntegratedSegments]:
        """Do all segments; ends with some that say so when the run diverges."""
        state, modes = self.state, None
        for interval in self.intervals:
            problem = self._problem(interval.speed)
            distinct_speeds, segment_indices = np.unique(interval.speeds, return_inverse=True)
            constants = segments_at(problem, distinct_speeds)
            # with the casing of the one before
            before = None if self._simulation is None else self._simulation.engine
            self._simulation = simulation = self.simulation_class.build(problem, constants, before)
            increments = constants.increments
            assert increments is not None
            if modes is not None:
                # an elastic casing's modes, which come after the blade's, stay as they are
                turned, blade = problem.blade.modes.T @ modes, modes.shape[1]
                state.displacement, self.velocity = (
                    np.concatenate([turned @ values[:blade], values[blade:]]) for values in (state.displacement, self.velocity)
                )
                # there may be more of them or fewer, where the fastest are left out
                state.increment = np.zeros_like(state.displacement)
                problem.contact.put_followers(state.displacement, self.velocity)
            modes = problem.blade.modes
            simulation.engine.take(segment_indices[0])
            state.increment[:] = increments.increment(segment_indices[0], state.displacement, self.velocity)
            samples_in_call = self.choice.samples_per_revolution * min(
                _AT_ONCE, revolutions_at_once(problem.grid.steps_per_revolution)
            )
            calls = (np.cumsum(interval.samples) - interval.samples) // samples_in_call
            for part in np.split(np.arange(len(calls)), np.flatnonzero(np.diff(calls)) + 1):
                indices, lasting = segment_indices[part], interval.samples[part]
                call, first = Schedule(indices, lasting, len(state.displacement)), state.samples
                record = simulation.advance_samples(state, int(lasting.sum()), call)
                lasted = np.diff(np.cumsum(lasting).clip(max=len(record.samples)), prepend=0)
                reached = np.count_nonzero(lasted)
                self.velocity = increments.velocity(indices[reached - 1], state.displacement, state.increment)
                begun, ended = (
                    constants.recursion[indices[:reached]].energy(*motion) + problem.contact.second_order_energy(*motion)
                    for motion in (call.ends[:reached, end].swapaxes(0, 1) for end in range(2))
                )
                self.stiffness_work += float(begun[0] - self.energy + np.sum(begun[1:] - ended[:-1]))
                self.energy = float(ended[-1])
                speeds = np.repeat(distinct_speeds[indices], lasted)
                yield IntegratedSegments(
                    speeds,
                    record.samples,
                    np.repeat(call.wear, lasted),
                    record.snapshots,
                    speeds[list(problem.grid.snapshots_between(first, first + len(speeds)))],
                    problem.contact.state_shapes,
                    record.diverged,
                )
                if record.diverged:
                    return
