"""The blade against lining or casing as ordinary differential equations, written a second time: SciPy's solve_ivp.

Written from docs/simulation.md (model, gap, lining, friction); of r37core it takes only the classes that hold the numbers.
Continuous in time: nothing here knows of a step. In the modes of the speed, of unit mass,

    q'' = -omega^2 q - 2 xi omega q' - N^T P - T^T f_t - M^T f_m,

with rows N, T and M of the contact nodes along the casing's normal, tangent and meridian, normal forces P and friction f. Modes
that are static follow these forces at once, and the nodes have no mass: `static_contact`.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Blade:
    """A blade spinning at `speed` (rad/s) in a scene with a linear gap, vector friction against the rotation and `clearance_m`.

    `frequencies` (rad/s), shape (modes,); `rows`, shape (3 nodes, modes): normal, then tangential, then meridional
    displacement of the nodes; `edge`, shape (modes,): normal displacement of the tip's leading edge; `theta` (rad), `radius`
    (m) and `tip_lengths` (m), which they stand for, shape (nodes,); `duration` (s): of the run of which the casing rises in a
    share. `flexibility` (m/N), shape (3 nodes, 3 nodes), and `edge_flexibility`, shape (3 nodes,): displacements by static
    modes per force, in the order of `rows`; None without them.
    """

    frequencies: np.ndarray
    rows: np.ndarray
    edge: np.ndarray
    theta: np.ndarray
    radius: np.ndarray
    tip_lengths: np.ndarray
    speed: float
    scene: Any
    duration: float
    flexibility: np.ndarray | None = None
    edge_flexibility: np.ndarray | None = None

    @property
    def nodes(self):
        return len(self.theta)

    def angle(self, time):
        """Angles (rad) of the nodes: the rotor turns towards negative theta."""
        return self.theta - self.speed * time

    def surface(self, time):
        """Distance (m) from the undeformed tip to casing or lining, shape (nodes,), and its rate (m/s)."""
        casing = self.scene.casing
        period = 2.0 * np.pi / casing.lobes
        from_top = np.mod(self.angle(time), period) / period - 0.5
        lobe = casing.lobe_height * np.exp(-((from_top / casing.width) ** 2))
        moving = lobe * 2.0 * from_top / casing.width**2 * self.speed / period
        risen, rising = 1.0, 0.0
        if casing.rise_fraction > 0.0:
            rate = np.log(100.0) / (casing.rise_fraction * self.duration)
            risen, rising = -np.expm1(-rate * time), rate * np.exp(-rate * time)
        return casing.clearance - risen * lobe, -risen * moving - rising * lobe

    def penetration(self, time, state):
        """How far (m) the nodes are beyond that surface, negative before it, and its rate (m/s)."""
        position, velocity = np.split(state, 2)
        surface, rate = self.surface(time)
        normal = self.rows[: self.nodes]
        return normal @ position - surface, normal @ velocity - rate

    def motion(self, state, pressure):
        """Rate of change of positions and velocities under normal forces (N), shape (nodes,)."""
        position, velocity = np.split(state, 2)
        damping = 2.0 * self.scene.damping_ratio * self.frequencies * velocity
        acceleration = -(self.frequencies**2) * position - damping
        if pressure.any():
            acceleration -= self.rows.T @ self.push(velocity, pressure)
        return np.concatenate([velocity, acceleration])

    def push(self, velocity, pressure):
        """Forces (N) with which the nodes press on casing or lining, in the order of `rows`: normal, and Coulomb's friction."""
        if self.scene.friction is None:
            return np.concatenate([pressure, np.zeros(2 * self.nodes)])
        along, across = np.split(self.rows[self.nodes :] @ velocity, 2)
        along = along - self.radius * self.speed
        share = self.scene.friction.coefficient * pressure / np.hypot(along, across)
        return np.concatenate([pressure, share * along, share * across])


def blade_of(model, speed, scene, duration, highest_frequency=np.inf):
    """The `Blade` of a contact model (r37core.rom.contact_model) at a speed (rad/s), with its modes up to a frequency (Hz)."""
    squares, modes = np.linalg.eigh(np.diag(model.squared_frequencies) + speed**2 * model.stiffness_per_square)
    below = np.sqrt(squares) <= 2.0 * np.pi * highest_frequency
    squares, modes = squares[below], modes[:, below]
    cone = scene.casing.cone_angle if scene.casing.cone_angle is not None else model.tip_cone_angle
    cosine, sine = np.cos(cone), np.sin(cone)
    radial, tangential, axial = model.displacement_operator @ modes
    edge_radial, _, edge_axial = model.tip_displacement_operator[:, 0] @ modes
    rows = np.vstack([cosine * radial - sine * axial, tangential, sine * radial + cosine * axial])
    edge = cosine * edge_radial - sine * edge_axial
    return Blade(np.sqrt(squares), rows, edge, model.theta, model.radius, model.tip_lengths, speed, scene, duration)


def with_static_modes(blade, first):
    """The blade whose modes from number `first` on follow the contact forces at once."""
    static = blade.rows[:, first:] / blade.frequencies[first:]
    of_edge = (blade.edge[first:] / blade.frequencies[first:]) @ static.T
    moving = {"frequencies": blade.frequencies[:first], "rows": blade.rows[:, :first], "edge": blade.edge[:first]}
    return replace(blade, **moving, flexibility=static @ static.T, edge_flexibility=of_edge)


def static_pressure(blade, stiffness, worn=lambda time: 0.0):
    """Normal forces (N), shape (nodes,), at a time and a state, with static modes: a function of both.

    On bars of `stiffness` (N/m) or, if infinite, the casing; `worn`: how much shorter (m) the bars before the nodes are then.
    """

    def pressure(time, state):
        depth = blade.penetration(time, state)[0] - worn(time)
        pressed = depth > 0.0
        if not pressed.any():
            return np.zeros(blade.nodes)
        velocity = np.split(state, 2)[1]
        # penetration that a unit pressure on each node, with its friction, takes from the others, and the bars' own
        units = np.array([blade.push(velocity, unit) for unit in np.eye(blade.nodes)]).T
        taken = blade.flexibility[: blade.nodes] @ units + np.eye(blade.nodes) / stiffness
        while True:
            forces = np.zeros(blade.nodes)
            forces[pressed] = np.linalg.solve(taken[np.ix_(pressed, pressed)], depth[pressed])
            wrong = np.where(pressed, forces < 0.0, depth - taken @ forces > 1e-15)
            if not wrong.any():
                return forces
            first = int(np.argmax(wrong))
            pressed[first] = not pressed[first]

    return pressure


def static_contact(blade, times, stiffness, method="DOP853", **tolerances):
    """Leading edge's normal displacement (m) with static modes, on bars of `stiffness` (N/m) or, if infinite, the casing."""
    pressure = static_pressure(blade, stiffness)

    def rate(time, state):
        return blade.motion(state, pressure(time, state))

    states = _solved(blade, rate, times, method, tolerances)
    forces = [blade.push(np.split(state, 2)[1], pressure(time, state)) for time, state in zip(times, states.T, strict=True)]
    return _edge(blade, states) - np.array(forces) @ blade.edge_flexibility


def without_yield(blade, times, method="DOP853", **tolerances):
    """Leading edge's normal displacement (m) at ascending `times` (s), on bars that never yield: springs E A/t, no memory."""
    stiffness = bar_stiffness(blade)

    def rate(time, state):
        return blade.motion(state, stiffness * np.maximum(blade.penetration(time, state)[0], 0.0))

    return _edge(blade, _solved(blade, rate, times, method, tolerances))


def against_spring(blade, times, stiffness, ratio, method="DOP853", **tolerances):
    """The same in direct contact, the rigid casing replaced by springs of `stiffness` (N/m), which push only.

    `ratio`: of each spring's dashpot to the critical one of its node alone, whose mass is 1/(N N^T). Far above one, a node
    that hits does not bounce.
    """
    normal = blade.rows[: blade.nodes]
    dashpot = 2.0 * ratio * np.sqrt(stiffness / np.sum(normal**2, axis=1))

    def rate(time, state):
        depth, speed = blade.penetration(time, state)
        return blade.motion(state, np.where(depth > 0.0, np.maximum(stiffness * depth + dashpot * speed, 0.0), 0.0))

    return _edge(blade, _solved(blade, rate, times, method, tolerances))


def bar_stiffness(blade):
    """Of the elastic lining under each node (N/m), shape (nodes,)."""
    lining = blade.scene.lining
    areas = lining.pressed_areas(blade.tip_lengths, float(np.max(blade.radius)))
    return lining.elastic_modulus * areas / lining.thickness


def _solved(blade, rate, times, method, tolerances):
    rest = np.zeros(2 * len(blade.frequencies))
    # at rest nothing tells the solver how soon the lobes come
    longest = 2e-3 * 2.0 * np.pi / blade.speed
    solution = solve_ivp(rate, (0.0, times[-1]), rest, method, times, max_step=longest, **tolerances)
    if not solution.success:
        raise RuntimeError(solution.message)
    return solution.y


def _edge(blade, states):
    return blade.edge @ states[: len(blade.frequencies)]


NEAR = 1e-4
"""Nodes farther from the lining (m) than this are not asked for their bar: they cannot reach it within WATCH."""

WATCH = 5e-6
"""Longest time (s) over which far nodes stay far; checked at its end."""


class WornBars:
    """Plastic shortening (m) of every node's ring of bars, `wear` of shape (nodes, bars), and which bar each node is on.

    While a node stays on a bar and presses it further, the bar yields: w = (E p - sigma t)/(E + K) with the penetration p.
    When the node draws back w stays, until p is past where it yielded last. `yielding`, shape (nodes,): which of the two holds.
    """

    def __init__(self, blade):
        self.blade, self.lining = blade, blade.scene.lining
        self.wear = np.zeros((blade.nodes, self.lining.bars))
        self.bar, self.yielding, self.near = (np.zeros(blade.nodes, dtype=kind) for kind in (int, bool, bool))

    @property
    def worn(self):
        """Shortening (m) of the bars that the nodes are on, shape (nodes,)."""
        return self.wear[np.arange(self.blade.nodes), self.bar % self.lining.bars]

    def by_yielding(self, depth):
        """Plastic shortening (m) of bars that yield at penetrations `depth` (m)."""
        stress = self.lining.elastic_modulus * depth - self.lining.yield_stress * self.lining.thickness
        return stress / (self.lining.elastic_modulus + self.lining.plastic_modulus)

    def pressure(self, depth):
        """Normal forces (N) of the bars at penetrations `depth` (m), shape (nodes,)."""
        worn = np.where(self.yielding, self.by_yielding(depth), self.worn)
        return bar_stiffness(self.blade) * np.maximum(depth - worn, 0.0)

    def keep(self, depth):
        """Write what the yielding bars have worn up to now into them."""
        node = np.flatnonzero(self.yielding)
        self.wear[node, self.bar[node] % self.lining.bars] = self.by_yielding(depth[node])

    def meet(self, node, depth, speed):
        """The node meets its bar at a penetration (m) that grows with `speed` (m/s): what is past yield yields at once."""
        worn, past = self.worn[node], self.by_yielding(depth)
        self.yielding[node] = past >= worn and speed > 0.0
        self.wear[node, self.bar[node] % self.lining.bars] = max(worn, past)

    def watch(self, time, depth, speed):
        """Put nodes that have come near on the bars that they are before."""
        near = depth > -NEAR
        for node in np.flatnonzero(near & ~self.near):
            self.bar[node] = np.floor(self.blade.angle(time)[node] / self.width)
            self.meet(node, depth[node], speed[node])
        self.near = near

    @property
    def width(self):
        """Of a bar (rad)."""
        return 2.0 * np.pi / self.lining.bars

    def passing(self):
        """Times (s) at which the nodes leave their bars; never for those that are far, shape (nodes,)."""
        return np.where(self.near, (self.blade.theta - self.bar * self.width) / self.blade.speed, np.inf)

    def switches(self):
        """Events for solve_ivp: of each near node, that its yielding bar is pressed no further, or its bar begins to yield."""
        return [self._drawn_back(node) if self.yielding[node] else self._yields(node) for node in np.flatnonzero(self.near)]

    def _drawn_back(self, node):
        return _ending(lambda time, state: self.blade.penetration(time, state)[1][node], -1, node)

    def _yields(self, node):
        worn = self.worn[node]
        return _ending(lambda time, state: self.by_yielding(self.blade.penetration(time, state)[0][node]) - worn, 1, node)


def _ending(event, direction, node):
    event.terminal, event.direction, event.node = True, direction, node
    return event


def with_wear(blade, times, method="DOP853", **tolerances):
    """Leading edge's normal displacement (m) at `times` (s) on bars that yield, and their wear (m), shape (nodes, bars).

    Integrated from one event to the next: a node passes to its next bar, a bar begins or ends to yield, a sample is due.
    The casing behind the bars is left out: they must not be worn through.
    """
    bars = WornBars(blade)
    time, state, edge = 0.0, np.zeros(2 * len(blade.frequencies)), []

    def rate(now, moving):
        return blade.motion(moving, bars.pressure(blade.penetration(now, moving)[0]))

    for sample in times:
        while time < sample:
            bars.watch(time, *blade.penetration(time, state))
            passing, events = bars.passing(), bars.switches()
            end = min(sample, time + WATCH, passing.min())
            solution = solve_ivp(rate, (time, end), state, method, first_step=end - time, events=events, **tolerances)
            time, state = solution.t[-1], solution.y[:, -1]
            depth, speed = blade.penetration(time, state)
            if np.any(depth[~bars.near] > 0.0):
                raise RuntimeError(f"a node came from {NEAR:g} m away within {WATCH:g} s")
            bars.keep(depth)
            for event, when in zip(events, solution.t_events, strict=True):
                bars.yielding[event.node] ^= len(when) > 0
            for node in np.flatnonzero(passing == time):
                bars.bar[node] -= 1
                bars.meet(node, depth[node], speed[node])
        edge.append(blade.edge @ state[: len(blade.frequencies)])
    return np.array(edge), bars.wear
