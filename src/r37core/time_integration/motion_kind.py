"""Kind of a motion: whether it repeats itself, and how fast neighbouring motions part (largest Lyapunov exponent).

The motion goes on next to a twin that starts a little beside it. After each period of the casing the twin is brought back to
its first distance along the same direction; the mean logarithm of what is taken away is the exponent: Benettin, Galgani,
Giorgilli, Strelcyn, Meccanica 15 (1980) 9-20. The state is displacement and velocity of all modes. The contact forces at that
instant and the lining's wear are brought back in the same proportion.
"""

import copy
from math import gcd
from typing import NamedTuple

import numpy as np
from numpy import ndarray

from .problem import Problem
from .segments import own_increments
from .simulate import Simulation
from .speed_arrays import OF_KIND
from .state import SimulationState
from .status import MotionKind

COUNTED = 100
"""Revolutions over which a motion is looked at, after those in which the twin finds its direction."""

MOST_PERIODS = 24
"""Most periods of the casing after which a motion is looked for again."""

RECURS = 1e-3
"""Relative distance from an earlier state below which a motion recurs."""

_ALIGNING = 20
"""Revolutions in which the twin finds the direction that grows fastest."""

_DISTANCE, _SEED = 1e-7, 0
"""First distance of the twin, as a share of the state's size, and the seed of its direction."""

_BATCHES, _ERRORS = 10, 2.0
"""Parts whose means tell how far the exponent scatters, and standard errors by which it has to differ from 0."""


class KindNumbers(NamedTuple):
    """`kind` of a motion; `exponent`, the largest Lyapunov exponent per revolution, and its standard `error`.

    `recurrence`: distance of the state from that `period` (revolutions) before, as a share of its size, the largest in
    MOST_PERIODS. NaN of a motion that diverged; no period of one without contact.
    """

    kind: MotionKind
    exponent: float = np.nan
    error: float = np.nan
    recurrence: float = np.nan
    period: float = np.nan

    @property
    def values(self) -> dict[str, float]:
        """Name of each number in datasets -> its value."""
        return dict(zip(OF_KIND, self, strict=True))


class PhaseSpace:
    """Coordinates of a state whose squared length is twice the energy of free modes: omega u and velocity, shape (2 modes,)."""

    def __init__(self, problem: Problem):
        ring, blade = problem.casing.ring, problem.blade.frequencies
        self.frequencies = blade if ring is None else np.concatenate([blade, ring.frequencies])
        self._increments = own_increments(problem)

    def coordinates(self, state: SimulationState) -> ndarray:
        """Coordinates of a state."""
        velocity = self._increments.velocity(0, state.displacement, state.increment)
        return np.concatenate([self.frequencies * state.displacement, velocity])

    def put(self, coordinates: ndarray, state: SimulationState) -> None:
        """Give a state the displacement and increment of these coordinates."""
        displacement, velocity = np.split(coordinates, 2)
        state.displacement = displacement / self.frequencies
        state.increment = self._increments.increment(0, state.displacement, velocity)


def samples_of_period(problem: Problem) -> int:
    """Samples after which a casing is as before: a revolution of linings and elastic casings, and where they are not whole."""
    samples, lobes = problem.choice.samples_per_revolution, problem.scene.casing.lobes
    if problem.scene.lined or problem.casing.ring is not None:
        return samples
    return samples // gcd(samples, max(lobes, 1))


def kind_of_motion(simulation: Simulation, state: SimulationState) -> KindNumbers:
    """Kind of the motion that goes on from a `state` with full-grown lobes; that is left as it is."""
    state, space = copy.deepcopy(state), PhaseSpace(simulation.problem)
    samples = samples_of_period(simulation.problem)
    per_revolution = simulation.problem.choice.samples_per_revolution / samples
    periods, aligning = round(COUNTED * per_revolution), round(_ALIGNING * per_revolution)
    start, contact = space.coordinates(state), 0.0
    size = _size(start)
    twin, beside = copy.deepcopy(state), np.random.default_rng(_SEED).normal(size=len(start))
    space.put(start + _DISTANCE * size / np.linalg.norm(beside) * beside, twin)
    states, growths = [start], []
    parts = (simulation.parts(each, (aligning + periods) * [samples]) for each in (state, twin))
    for number, (own, other) in enumerate(zip(*parts, strict=False)):
        if own.diverged or other.diverged:
            return KindNumbers(MotionKind.UNKNOWN)
        here = space.coordinates(state)
        apart = space.coordinates(twin) - here
        growth = max(float(np.linalg.norm(apart)) / (_DISTANCE * size), np.finfo(float).tiny)
        space.put(here + apart / growth, twin)
        _bring_back(twin, state, growth)
        states.append(here)
        growths.append(np.log(growth))
        if number < aligning:
            contact = float(state.totals["steps_in_contact"])
    batches = np.array([part.mean() for part in np.array_split(np.array(growths[aligning:]), _BATCHES)]) * per_revolution
    exponent, error = float(batches.mean()), float(batches.std(ddof=1) / np.sqrt(_BATCHES))
    recurrence, period = _recurrence(np.array(states), size)
    if state.totals["steps_in_contact"] == contact:
        return KindNumbers(MotionKind.FREE, exponent, error, recurrence)
    return KindNumbers(_kind(exponent, error, recurrence, period), exponent, error, recurrence, period / per_revolution)


def kind_numbers(problem: Problem, state: SimulationState, *, diverged: bool) -> dict[str, float]:
    """Numbers of the kind of the motion after a run, as its file has them; unknown of one that has `diverged`."""
    motion = KindNumbers(MotionKind.UNKNOWN) if diverged else kind_of_motion(Simulation.build(problem), state)
    return motion.values


def _size(coordinates: ndarray) -> float:
    """Size of a state, above 0."""
    return max(float(np.linalg.norm(coordinates)), np.finfo(float).tiny)


def _bring_back(twin: SimulationState, state: SimulationState, growth: float) -> None:
    """Divide by `growth` how far the twin's forces and wear are from the state's."""
    for name in ("contact_force", "penetration", "bar_position", "wear"):
        other, own = getattr(twin, name), getattr(state, name)
        other[...] = own + (other - own) / growth
    twin.touched[...] = state.touched


def _recurrence(states: ndarray, size: float) -> tuple[float, int]:
    """Smallest distance of the last states from those some periods before, as a share of the size, and that many periods.

    Of several multiples of a period that a motion has, the smallest.
    """
    last = states[-MOST_PERIODS:]
    counts = range(1, min(MOST_PERIODS, len(states) - len(last)) + 1)
    distances = [float(np.linalg.norm(last - states[-MOST_PERIODS - count : -count], axis=1).max()) / size for count in counts]
    recurring = [count for count, distance in zip(counts, distances, strict=True) if distance < RECURS]
    count = recurring[0] if recurring else counts[int(np.argmin(distances))]
    return distances[count - 1], count


def _kind(exponent: float, error: float, recurrence: float, period: int) -> MotionKind:
    if recurrence < RECURS:
        return MotionKind.PERIODIC if period == 1 else MotionKind.MULTIPLE
    if exponent < -_ERRORS * error:
        return MotionKind.CONVERGING
    return MotionKind.CHAOTIC if exponent > _ERRORS * error else MotionKind.QUASI_PERIODIC
