"""Branches of periodic motions over the speed, by pseudo-arc-length, and where they turn or lose their stability.

After each orbit the next is looked for at a distance along the tangent of the branch, in state and speed together (Keller 1977;
Seydel, Practical Bifurcation and Stability Analysis, Springer 2010, section 4.5). Contact makes a branch bend sharply, so the
distance is halved where no orbit is found.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from scipy.linalg import solve

from .periodic import CLOSED, NoOrbitError, Orbit, PeriodicBlade

SPEED_SCALE = 30.0
"""Change of speed (rad/s) that counts in the arc length as much as a change of the state by its own size."""

FIRST, LEAST, LARGEST, GROWTH = 0.02, 1e-5, 0.2, 1.4
"""Arc length to the first orbit, the least and the largest to the next, and by how much it grows after an easy one."""

MOST_UNSTABLE = 60
"""Unstable orbits in a row after which a branch is not followed any farther."""

_FAILED = (NoOrbitError, ValueError)
"""Errors of an orbit that is not there, of a step that is too long at its speed, and of matrices that are singular."""

_AGAIN, _SAME = 3, 1e-4
"""Orbits in a row that lie on the branch as it was followed before, and relative difference of the rms that counts as none."""

_SPEED_DIFFERENCE = 1e-3
_MOST_CORRECTIONS, _EASY, _HALVINGS = 12, 4, 6


class Event(StrEnum):
    """Change of a branch between two of its orbits: see `events_of`."""

    FOLD = "fold"
    PERIOD_DOUBLING = "period_doubling"
    TORUS = "torus"
    OTHER = "other"


@dataclass(frozen=True)
class Bifurcation:
    """An `event` of a branch at a `speed` (rad/s), before the orbit of this number."""

    event: Event
    speed: float
    orbit: int


class _Point:
    """An orbit with the map at its speed, and the derivative of P by the speed."""

    def __init__(self, blade: PeriodicBlade, orbit: Orbit):
        self.orbit, self.map = orbit, blade.map_at(orbit.speed)
        self.speed_derivative = _speed_derivative(blade, orbit.speed, orbit.z, orbit.phase, orbit.samples, orbit.z)

    def tangent(self, before: np.ndarray | None, direction: float) -> np.ndarray:
        """Unit tangent of the branch, in state over its size and speed over its scale, on from the one `before`."""
        orbit = self.orbit
        speed_derivative = solve(np.eye(len(orbit.z)) - orbit.derivative, self.speed_derivative)
        tangent = np.append(speed_derivative / np.linalg.norm(orbit.z), 1.0 / SPEED_SCALE)
        tangent /= np.linalg.norm(tangent)
        forward = np.sign(tangent[-1]) * direction if before is None else np.sign(tangent @ before)
        return tangent * (forward or 1.0)


def _speed_derivative(
    blade: PeriodicBlade, speed: float, z: np.ndarray, phase: int, samples: int, mapped: np.ndarray
) -> np.ndarray:
    """Derivative of P by the speed; `mapped`: P(z) at the speed."""
    return (blade.map_at(speed + _SPEED_DIFFERENCE)(z, phase, samples) - mapped) / _SPEED_DIFFERENCE


def branch_through(blade: PeriodicBlade, start: Orbit, first: float, last: float, most: int) -> list[Orbit]:
    """Orbits of the branch through one, in their order along it, as far as the speeds (rad/s) `first` to `last`.

    At most so many on each side of it. A branch also ends where no orbit is found in the least arc length, where it has turned
    back at a sharp bend and lies on itself, and after MOST_UNSTABLE unstable orbits in a row: with little damping it would wind
    through chaotic speeds without end.
    """
    down, up = (list(_followed(blade, start, direction, first, last, most)) for direction in (-1.0, 1.0))
    return [*down[::-1], start, *up]


def _followed(blade: PeriodicBlade, start: Orbit, direction: float, first: float, last: float, most: int) -> Iterator[Orbit]:
    orbit, length, tangent, unstable, again = start, FIRST, None, 0, 0
    orbits: list[Orbit] = [start]
    for _ in range(most):
        try:
            point = _Point(blade, orbit)
            tangent = point.tangent(tangent, direction)
        except _FAILED:
            return
        following = None
        while following is None:
            with suppress(*_FAILED):
                following = _next(blade, point, tangent, length)
            if following is None:
                length *= 0.5
                if length < LEAST:
                    return
        pressed, corrections = following
        if not first <= pressed.speed <= last:
            yield from _end_orbit(blade, point, pressed, min(max(pressed.speed, first), last))
            return
        if corrections <= _EASY:
            length = min(length * GROWTH, LARGEST)
        free = _free_orbit(blade, pressed)
        if free is None:
            yield pressed
            return
        orbit = free
        if orbit is not pressed:
            # at another instant the tangent is another one, too
            tangent = _way(point, orbit)
        yield orbit
        unstable = 0 if orbit.stable else unstable + 1
        again = again + 1 if lies_on(orbits[:-_AGAIN], orbit.speed, orbit.size, _SAME) else 0
        orbits.append(orbit)
        if unstable == MOST_UNSTABLE or again == _AGAIN:
            return


def lies_on(orbits: list[Orbit], speed: float, size: float, tolerance: float) -> bool:
    """True if a motion of this size (m), normal and tangential rms, at a speed (rad/s) lies on the line through some orbits.

    `tolerance`: relative difference of the size.
    """
    speeds, sizes = np.array([orbit.speed for orbit in orbits]), np.array([orbit.size for orbit in orbits])
    for first in np.flatnonzero((speeds[:-1] - speed) * (speeds[1:] - speed) <= 0.0):
        way = speeds[first + 1] - speeds[first]
        share = (speed - speeds[first]) / way if way else 0.0
        if abs(sizes[first] + share * (sizes[first + 1] - sizes[first]) - size) < tolerance * size:
            return True
    return False


def _way(point: _Point, orbit: Orbit) -> np.ndarray:
    """Way from a point to the next orbit, at the instant of that, as a tangent has it."""
    before = point.map.state(point.orbit.z, point.orbit.phase)
    point.map.simulation.advance_samples(before, orbit.phase - point.orbit.phase)
    change = orbit.z - point.map.coordinates(before)
    return np.append(change / np.linalg.norm(orbit.z), (orbit.speed - point.orbit.speed) / SPEED_SCALE)


def _end_orbit(blade: PeriodicBlade, point: _Point, beyond: Orbit, speed: float) -> list[Orbit]:
    """The orbit at the speed (rad/s) between a point of the branch and an orbit, if it is found."""
    if speed == point.orbit.speed:
        return []
    share = (speed - point.orbit.speed) / (beyond.speed - point.orbit.speed)
    z = point.orbit.z + share * (beyond.z - point.orbit.z)
    try:
        return [blade.map_at(speed).orbit(z, beyond.phase, beyond.samples, beyond.derivative)]
    except _FAILED:
        return []


def _next(blade: PeriodicBlade, point: _Point, tangent: np.ndarray, length: float) -> tuple[Orbit, int] | None:
    """The orbit at an arc length along the tangent, and the corrections that it took; None, or one of _FAILED, without one."""
    orbit, size = point.orbit, float(np.linalg.norm(point.orbit.z))
    along_z, along_speed = tangent[:-1] * size, tangent[-1] * SPEED_SCALE
    z, speed = orbit.z + length * along_z, orbit.speed + length * along_speed
    derivative, speed_derivative, before = orbit.derivative, point.speed_derivative, np.inf
    for correction in range(_MOST_CORRECTIONS):
        period_map = blade.map_at(speed)
        distance = period_map(z, orbit.phase, orbit.samples) - z
        error = float(np.linalg.norm(distance)) / size
        if error < CLOSED:
            return period_map.closed(z, orbit.phase, orbit.samples), correction
        if correction and error > 5.0 * before:
            return None
        if error > 0.3 * before or correction == 0:
            derivative = period_map.derivative(z, orbit.phase, orbit.samples, distance + z)
            speed_derivative = _speed_derivative(blade, speed, z, orbit.phase, orbit.samples, distance + z)
        before = error
        left = length - tangent @ np.append((z - orbit.z) / size, (speed - orbit.speed) / SPEED_SCALE)
        matrix = np.block(
            [[np.eye(len(z)) - derivative, -speed_derivative[:, None]], [tangent[:-1] / size, tangent[-1] / SPEED_SCALE]]
        )
        change = solve(matrix, np.append(distance, left))
        z, speed = z + change[:-1], speed + change[-1]
    return None


def _free_orbit(blade: PeriodicBlade, orbit: Orbit) -> Orbit | None:
    """The orbit as it is where nothing is pressed at its instant, else at another one; None where there is none."""
    period_map = blade.map_at(orbit.speed)
    state = period_map.state(orbit.z, orbit.phase)
    period_map.simulation.advance_samples(state, orbit.samples)
    if not state.contact_force.any():
        return orbit
    try:
        # with its forces the state is not exactly the one without
        return period_map.orbit(*period_map.free_instant(state, orbit.samples), orbit.samples)
    except _FAILED:
        return None


def events_of(blade: PeriodicBlade, orbits: list[Orbit]) -> list[Bifurcation]:
    """Where a branch becomes stable or unstable: it turns in the speed, or a multiplier passes the unit circle.

    Where a multiplier passes through -1 the period doubles, a pair makes a torus; what passes through +1 apart from a fold is
    `other`. Speeds are found by orbits between those of the branch.
    """
    events = []
    for number in range(1, len(orbits)):
        before, after = orbits[number - 1], orbits[number]
        if before.stable == after.stable:
            continue
        turn = next((turned for turned in (number - 1, number) if _turns(orbits, turned)), None)
        if turn is not None:
            events.append(Bifurcation(Event.FOLD, _turn(blade, orbits[turn - 1 : turn + 2]), number))
        else:
            events.append(Bifurcation(*_passing(blade, before, after), number))
    return events


def _turns(orbits: list[Orbit], number: int) -> bool:
    """True if a branch turns in the speed at the orbit of this number."""
    if not 0 < number < len(orbits) - 1:
        return False
    before, here, after = orbits[number - 1 : number + 2]
    return (here.speed - before.speed) * (after.speed - here.speed) < 0.0


def _between(blade: PeriodicBlade, before: Orbit, after: Orbit, share: float) -> Orbit | None:
    """The orbit of the branch nearest to a share of the way between two of its orbits at the same instant; None without one."""
    if before.phase != after.phase:
        return None
    size = float(np.linalg.norm(before.z))
    chord = np.append((after.z - before.z) / size, (after.speed - before.speed) / SPEED_SCALE)
    length = float(np.linalg.norm(chord))
    try:
        following = _next(blade, _Point(blade, before), chord / length, share * length)
    except _FAILED:
        return None
    return following[0] if following else None


def _turn(blade: PeriodicBlade, orbits: list[Orbit]) -> float:
    """Extreme speed (rad/s) of the branch about the second of three orbits, halving the distance to both neighbours."""
    first, middle, last = orbits
    sense = np.sign(middle.speed - first.speed)
    for _ in range(_HALVINGS):
        sides = [_between(blade, first, middle, 0.5), _between(blade, middle, last, 0.5)]
        known = [first, sides[0], middle, sides[1], last]
        if None in sides:
            break
        best = 1 + int(np.argmax([sense * orbit.speed for orbit in known[1:4] if orbit is not None]))
        first, middle, last = (orbit for orbit in known[best - 1 : best + 2] if orbit is not None)
    return middle.speed


def _passing(blade: PeriodicBlade, before: Orbit, after: Orbit) -> tuple[Event, float]:
    """Event by which a multiplier passes the unit circle between a stable and an unstable orbit, and its speed (rad/s)."""
    inner, outer = (before, after) if before.stable else (after, before)
    for _ in range(_HALVINGS):
        middle = _between(blade, inner, outer, 0.5)
        if middle is None:
            break
        inner, outer = (middle, outer) if middle.stable else (inner, middle)
    value, speed = outer.multipliers[0], 0.5 * (inner.speed + outer.speed)
    if abs(value.imag) > 1e-6 * abs(value):
        return Event.TORUS, speed
    return (Event.PERIOD_DOUBLING if value.real < 0.0 else Event.OTHER), speed
