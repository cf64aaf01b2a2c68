"""Periodic motions in a bare casing: the map of a period, Newton's method, Floquet multipliers.

A motion is periodic where the map P over one or more periods of the casing has a fixed point, P(z) = z (shooting: Nayfeh,
Balachandran, Applied Nonlinear Dynamics, Wiley 1995, section 6.4). The state z is displacement and velocity of the stepped
modes at an instant at which nothing is pressed, when these two are all of the state. Its Floquet multipliers are the
eigenvalues of dP/dz; the motion is stable where all of them are within the unit circle.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.linalg import eigvals, solve

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.motion_kind import samples_of_period
from r37core.time_integration.segments import own_increments
from r37core.time_integration.simulate import LEADING_EDGE, Simulation, rest_state
from r37core.time_integration.state import SimulationState

CLOSED = 1e-10
"""Distance of a motion from its start after a period, as a share of its size, at which it counts as closed."""

LONGEST = 1.5
"""Longest step of a branch, as its steps per sample are held, over the chosen one."""

_DIFFERENCE = 1e-6
"""Size of the differences by which derivatives are taken, as a share of that of the state."""

UNIT_CIRCLE = 1.0 + _DIFFERENCE
"""Size of the largest Floquet multiplier below which a motion is stable: by differences, one on the circle may lie outside."""

_PHASES = 62
"""Instants of a motion's period at which it is looked whether a node is pressed."""

_MOST_STEPS, _HALVINGS, _GAIN = 25, 6, 0.1
"""Newton steps; halvings of one; factor of the distance in a step above which the derivative is taken anew."""


class NoOrbitError(ArithmeticError):
    """A motion that diverges, is pressed at every instant, or does not close."""


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic motion at a `speed` (rad/s): its state z, shape (2 modes,), at the sample of this number (`phase`).

    `samples`: of its period; `derivative`: dP/dz; `rms`, shape (2,), and `peak` (m) of the leading edge, normal and tangential.
    """

    speed: float
    z: np.ndarray
    phase: int
    samples: int
    derivative: np.ndarray
    rms: np.ndarray
    peak: float

    @cached_property
    def multipliers(self) -> np.ndarray:
        """Floquet multipliers, the largest first."""
        values = eigvals(self.derivative)
        return values[np.argsort(-np.abs(values), kind="stable")]

    @property
    def size(self) -> float:
        """Rms (m) of the normal and tangential motion together."""
        return float(np.linalg.norm(self.rms))

    @property
    def stable(self) -> bool:
        """True if all multipliers are within the unit circle, or on it where nothing is damped."""
        return bool(abs(self.multipliers[0]) < UNIT_CIRCLE)


@dataclass(frozen=True, eq=False)
class PeriodicBlade:
    """A blade's `model` in a `scene` with full-grown lobes. All its maps have the steps per sample of a `reference` speed.

    `choice`: the time integration with these, and nothing recorded.
    """

    model: ContactModel
    scene: Scene
    choice: IntegrationChoice
    reference: float

    @classmethod
    def stepped(cls, model: ContactModel, scene: Scene, choice: IntegrationChoice, reference: float) -> "PeriodicBlade":
        """Blade with the steps per sample that the `reference` speed (rad/s) has."""
        bare = replace(choice, snapshot_revolutions=0, snapshots_per_revolution=0, until_settled=False)
        problem = Simulation(model, reference, scene, bare).problem
        # as it may have been shortened
        held = replace(problem.choice, shorten=False, steps_per_sample=problem.grid.steps_per_sample)
        return cls(model, scene, held, reference)

    @property
    def lowest_speed(self) -> float:
        """Lowest speed (rad/s) at which these steps are not too long: LONGEST of the chosen one."""
        assert self.choice.steps_per_sample is not None
        steps = self.choice.steps_per_sample * self.choice.samples_per_revolution
        return 2.0 * np.pi / steps / (LONGEST * self.choice.time_step)

    @cached_property
    def basis(self) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies (rad/s) and modes of the reference speed, in which states are given at all speeds."""
        blade = Simulation(self.model, self.reference, self.scene, self.choice).problem.blade
        return blade.frequencies, blade.modes

    def map_at(self, speed: float) -> "PeriodMap":
        """The map at a speed (rad/s). Raises NoOrbitError where other modes are stepped there."""
        return PeriodMap(Simulation(self.model, speed, self.scene, self.choice), *self.basis)


class PeriodMap:
    """States of a `simulation` before and after some samples, as z = (omega u, velocity) in the reference speed's modes."""

    def __init__(self, simulation: Simulation, frequencies: np.ndarray, modes: np.ndarray):
        self.simulation, self._frequencies = simulation, frequencies
        self._to_own = simulation.problem.blade.modes.T @ modes
        if self._to_own.shape[0] != len(frequencies):
            raise NoOrbitError("other modes are stepped")
        self._from_own, self._increments = np.linalg.inv(self._to_own), own_increments(simulation.problem)

    def state(self, z: np.ndarray, phase: int) -> SimulationState:
        """The state at z without contact forces."""
        displacement, velocity = np.split(z, 2)
        state = rest_state(self.simulation.problem)
        state.displacement = self._to_own @ (displacement / self._frequencies)
        state.increment = self._increments.increment(0, state.displacement, self._to_own @ velocity)
        state.samples = phase
        return state

    def coordinates(self, state: SimulationState) -> np.ndarray:
        """z of a state."""
        velocity = self._increments.velocity(0, state.displacement, state.increment)
        return np.concatenate([self._frequencies * (self._from_own @ state.displacement), self._from_own @ velocity])

    def __call__(self, z: np.ndarray, phase: int, samples: int) -> np.ndarray:
        """P(z). Raises NoOrbitError for a motion that diverges."""
        state = self.state(z, phase)
        if self.simulation.advance_samples(state, samples).diverged:
            raise NoOrbitError("diverged")
        return self.coordinates(state)

    def derivative(self, z: np.ndarray, phase: int, samples: int, mapped: np.ndarray) -> np.ndarray:
        """dP/dz by differences; `mapped`: P(z)."""
        size = _DIFFERENCE * float(np.linalg.norm(z))
        moved = (z + size * direction for direction in np.eye(len(z)))
        return np.stack([(self(each, phase, samples) - mapped) / size for each in moved], axis=1)

    def free_instant(self, state: SimulationState, samples: int) -> tuple[np.ndarray, int]:
        """z and phase in the middle of the longest time of a period of so many samples in which no node is pressed.

        The motion goes on from a `state`, which is changed. Raises NoOrbitError where a node is pressed at every instant.
        """
        every = max(samples // _PHASES, 1)
        instants: list[tuple[np.ndarray, int]] = []
        free: list[bool] = []
        for _ in range(samples // every):
            self.simulation.advance_samples(state, every)
            instants.append((self.coordinates(state), state.samples))
            free.append(not state.contact_force.any())
        count = len(free)
        # of the runs of free instants round the period
        lengths = [next((n for n in range(count) if not free[(first + n) % count]), count) for first in range(count)]
        longest = int(np.argmax(lengths))
        if not lengths[longest]:
            raise NoOrbitError("pressed at every instant")
        return instants[(longest + lengths[longest] // 2) % count]

    def orbit(self, z: np.ndarray, phase: int, samples: int, derivative: np.ndarray | None = None) -> Orbit:
        """The periodic motion nearest to z, by Newton's method with steps that are halved where the distance does not fall.

        `derivative`: dP/dz near it, where it is known. Raises NoOrbitError where the motion does not close.
        """
        if not z.any():
            raise NoOrbitError("at rest")
        distance, fresh = self(z, phase, samples) - z, False
        for _ in range(_MOST_STEPS):
            if np.linalg.norm(distance) < CLOSED * np.linalg.norm(z):
                return self.closed(z, phase, samples)
            if derivative is None:
                derivative, fresh = self.derivative(z, phase, samples, distance + z), True
            step = solve(np.eye(len(z)) - derivative, distance)
            nearer = self._nearer(z, step, distance, phase, samples, _HALVINGS if fresh else 1)
            if nearer is None and fresh:
                break
            if nearer is None:
                derivative = None
                continue
            gain = np.linalg.norm(nearer[1]) / np.linalg.norm(distance)
            z, distance = nearer
            fresh = False
            if gain > _GAIN:
                derivative = None
        raise NoOrbitError("does not close")

    def _nearer(
        self, z: np.ndarray, step: np.ndarray, distance: np.ndarray, phase: int, samples: int, tries: int
    ) -> tuple[np.ndarray, np.ndarray] | None:
        """z and its distance after the largest share of a step that brings it nearer; None without one."""
        for share in 0.5 ** np.arange(tries):
            try:
                moved = z + share * step
                there = self(moved, phase, samples) - moved
            except NoOrbitError:
                continue
            if np.linalg.norm(there) < (1.0 - 0.1 * share) * np.linalg.norm(distance):
                return moved, there
        return None

    def closed(self, z: np.ndarray, phase: int, samples: int) -> Orbit:
        """The orbit through z, at which the motion closes."""
        state = self.state(z, phase)
        motion = self.simulation.advance_samples(state, samples).samples[:, LEADING_EDGE]
        derivative = self.derivative(z, phase, samples, self.coordinates(state))
        rms, peak = np.sqrt(np.mean(motion**2, axis=0)), float(np.abs(motion[:, 0]).max())
        return Orbit(self.simulation.problem.speed, z, phase, samples, derivative, rms, peak)


def orbit_after(blade: PeriodicBlade, simulation: Simulation, state: SimulationState, periods: int) -> Orbit:
    """The periodic motion of so many periods of the casing to which a motion comes near, from a `state` of it at angle 0 on.

    The state is of a `simulation` at the blade's reference speed. Raises NoOrbitError.
    """
    period_map = PeriodMap(simulation, *blade.basis)
    samples = periods * samples_of_period(simulation.problem)
    return period_map.orbit(*period_map.free_instant(state, samples), samples)
