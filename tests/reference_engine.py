"""The time integration as it reads on paper, in dense NumPy: slow, and the twin that the compiled engine must equal.

Equations after section 5 of the benchmark, in the coordinates of the modes at rest, where the mass is the identity:
u* = A u_n + B u_{n-1} without contact, u_{n+1} = u* + C F with it (reference_motion). Work per step is of the order of modes
squared. Forces at t_n, and the static modes with them: time_integration.compiled.contact_steps. An elastic casing is followed
in the frame that does not turn.
"""

import numpy as np
from reference_motion import MotionWithCasing, motion_of

from r37core.contact.casing import casing_axes
from r37core.time_integration.rotor_simulation import RotorSimulation
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.state import Schedule, SimulationRecord

MOST_SWEEPS = 200


class ReferenceEngine:
    """The time integration of one problem with dense matrices.

    `angle` (rad): at which the blade stands at time 0, beyond that of its model; `worn` (m3): wear of the lining by the blade.
    """

    angle = worn = 0.0

    def __init__(self, problem, segments, beside=None):
        self.problem, self._segments = problem, segments
        self._blade_rows, self._edge_rows = (rows_of(each, problem) for each in (problem.contact, problem.edge.motion))
        self.step = self._pushed_step if problem.choice.second_order else self._step
        self._turn(0)
        self.take(0)

    def take(self, speed_index):
        """Go on at this one of the speeds."""
        self._speed_index, recursion = speed_index, self._segments.recursion[speed_index]
        self.motion = motion_of(self.problem, recursion)
        self.clearance = self._segments.clearance[speed_index]
        # a revolution has as many steps at every speed
        faster = self._segments.speeds[speed_index] / self.problem.speed
        self.time_step = self.problem.grid.time_step / faster
        self.rotation_velocity = self.problem.casing.rotation_velocity * faster

    def _turn(self, n):
        """Take the rows of the nodes where they are at t_n: of the blade's modes at rest, and of an elastic casing's."""
        self.rows = self._rows_at(n, self._blade_rows, self.problem.casing)
        self.normal, self.tangential, self.meridional = self.rows

    def _rows_at(self, n, blade_rows, casing):
        if casing.ring is None:
            return blade_rows
        casing_rows = -casing_axes(casing.ring.displacement(casing.theta(n)), casing.cone_angle)
        return np.concatenate([blade_rows, casing_rows], axis=-1)

    def advance(self, state, out, schedule=None):
        """Do the steps of every row of `out.samples`, as the compiled engine does; returns the rows done."""
        first, schedule = state.samples, schedule or Schedule([0], [len(out.samples)], len(state.displacement))
        for segment, (speed_index, samples) in enumerate(zip(schedule.speed_indices, schedule.samples, strict=True)):
            self._go_over(state, speed_index)
            schedule.ends[segment, 0] = state.displacement, state.increment
            done, kept = state.samples - first, len(self.problem.grid.snapshots_between(first, state.samples))
            part = SimulationRecord(out.samples[done : done + samples], out.snapshots[kept:])
            reached, bounded = go_on([self], [state], [part], [0])
            state.samples += reached
            schedule.ends[segment, 1] = state.displacement, state.increment
            schedule.wear[segment] = state.wear.max(initial=0.0)
            if not bounded:
                break
        return state.samples - first

    def _go_over(self, state, speed_index):
        """Take another speed; displacement and velocity go over to it."""
        if speed_index != self._speed_index:
            increments = self._segments.increments
            velocity = increments.velocity(self._speed_index, state.displacement, state.increment)
            self.take(speed_index)
            state.increment[:] = increments.increment(speed_index, state.displacement, velocity)

    def begin(self, motion, n, state):
        """Go on from a motion at t_n: where no node presses the lining, the gaps are those of this speed."""
        self._turn(n)
        if state.wear.size and not (state.contact_force.any() or np.any(state.penetration > 0.0)):
            gap, theta = self.gap(self.motion.displacement(motion), n)
            state.penetration[:], state.bar_position[:] = -gap, theta / (2.0 * np.pi) * state.wear.shape[1]

    def record(self, motion, first, done, state, out):
        """Keep sample number `done` after the `first`, and a snapshot where one is due; True within the limit."""
        problem = self.problem
        static = state.contact_force.ravel() if problem.choice.second_order else np.empty(0)
        numbers = np.concatenate([self.motion.numbers(motion), static])
        out.samples[done] = problem.contact.output_operator @ numbers
        kept, following = (len(problem.grid.snapshots_between(first, first + done + more)) for more in (0, 1))
        if following > kept:
            out.snapshots[kept] = numbers
        return bool(np.all(np.abs(out.samples[done]) < problem.scene.divergence_limit))

    def _step(self, before, n, state, _):
        """Motion at t_n from that at t_{n-1}, by forces that correct the prediction of t_n.

        Changes wear, totals and the nodes on the casing.
        """
        lining = self.problem.scene.lining
        self._turn(n)
        predicted = self.motion.flown(before)
        gap, theta = self.gap(self.motion.displacement(predicted), n)
        directions = self._directions(self.motion.slid(before))
        force, pressure = np.zeros(self.rows.shape[-1]), np.zeros(len(gap))
        if lining is not None:
            self._follow_gaps(gap, theta, n, state, lining)
            pressure = self._press_lining(gap, theta, lining, state.wear)
            force = self._modal(pressure * directions)
            # the casing lies behind the lining; what is left to it after the lining's forces
            gap = gap + lining.thickness - self.normal @ self.motion.response @ force
        multipliers = self._press_casing(gap, directions)
        force = force + self._modal(multipliers * directions)
        after = self.motion.pushed(predicted, force)
        self._add_up(state, self.motion.work_and_loss(before, after, force), pressure + multipliers, multipliers > 0.0)
        if np.any(pressure + multipliers > 0.0):
            self._measure_edge(state, after, n)
        state.totals["friction_heat"] += self._heat(pressure + multipliers)
        return after

    def force(self, state):
        """Modal forces of those that the state has."""
        return self._modal(state.contact_force)

    def _pushed_step(self, before, n, state, force):
        """The same under modal forces at t_{n-1}, in an elastic casing of all blades; the state gets those at t_n."""
        after, slid = self.motion.pushed(self.motion.flown(before), force), self.motion.slid(before)
        self._turn(n)
        gap, theta = self.gap(self.motion.displacement(after), n)
        directions = self._directions(1.5 * self.motion.slid(after) - 0.5 * slid)
        pressure, opened, touching = self._press_nodes(gap, theta, directions, state.wear)
        if self.problem.scene.lining is not None:
            self._follow_gaps(opened, theta, n, state, self.problem.scene.lining)
        self._add_up(state, self.motion.work_and_loss(before, after, force), -state.contact_force[0], touching)
        state.contact_force[:] = pressure * directions
        state.totals["friction_heat"] += self._heat(pressure)
        if np.any(pressure > 0.0):
            self._measure_edge(state, after, n)
        return after

    def _measure_edge(self, state, motion, n):
        """Keep the largest penetration of the tip's edge into the casing, if it is at t_n."""
        if self._segments.increments is not None:
            return
        edge = self.problem.edge
        displacement = self._rows_at(n, self._edge_rows, edge.casing) @ self.motion.displacement(motion)
        gap, _ = edge.casing.gaps(edge.room, displacement, n, self.angle)
        if self.problem.choice.second_order:
            gap = gap - edge.flexibility @ state.contact_force.ravel()
        state.totals["largest_penetration"] = max(state.totals["largest_penetration"], -gap.min())

    def _add_up(self, state, work_and_loss, normal_force, touched):
        """Totals of a step, pushed by a `normal_force` (N) on each node; `touched`: which of them touch the casing."""
        totals = state.totals
        totals["steps"] += 1
        totals["steps_in_contact"] += np.any(normal_force > 0.0)
        totals["casing_hits"] += np.sum(touched & ~state.touched)
        totals["largest_force"] = max(totals["largest_force"], normal_force.max())
        for name, part in zip(("work", "loss"), work_and_loss, strict=True):
            totals[name] += part
        state.touched[:] = touched

    def gap(self, u, n):
        """Distance (m) of every node from casing or lining, and the angle (rad) at which it meets it."""
        return self.problem.casing.gaps(self.clearance, np.array([rows @ u for rows in self.rows]), n, self.angle)

    def _directions(self, d):
        """Forces per unit normal force on each node, shape (3, nodes): towards the axis, with friction against the sliding.

        `d`: displacement of the blade in a step, by which its vibration slides.
        """
        friction, towards_axis = self.problem.scene.friction, -np.ones(len(self.normal))
        if friction is None:
            return np.array([towards_axis, 0.0 * towards_axis, 0.0 * towards_axis])
        # sliding velocity over the casing: that of the rotation plus, in vector form, that of the vibration
        along, across = self.rotation_velocity, np.zeros(len(self.normal))
        if friction.vector:
            along, across = along + self.tangential @ d / self.time_step, self.meridional @ d / self.time_step
        # Coulomb: mu times the normal force, opposite to the sliding
        self._sliding = np.hypot(along, across) * self.time_step
        share = -friction.coefficient / np.hypot(along, across)
        return np.array([towards_axis, share * along, share * across])

    def _heat(self, pressure):
        """Work (J) of the friction in a step, of normal forces (N) on the nodes, against their sliding."""
        friction = self.problem.scene.friction
        return 0.0 if friction is None else friction.coefficient * float(pressure @ self._sliding)

    def _modal(self, forces):
        """Modal forces of forces (N) on the nodes, shape (3, nodes, ...)."""
        return np.einsum("dk...,dki->...i", forces, self.rows)

    def _press_nodes(self, gap, theta, directions, wear):
        """Normal forces (N) of the contact problem at t_n, gaps (m) with them, and the nodes that touch the casing.

        Wears the bars. Node by node the force that its law says while the others keep theirs, until none changes by more than
        round-off.
        """
        lining, nodes = self.problem.scene.lining, range(len(gap))
        opening = -np.einsum("dk,dkg->gk", directions, self.problem.contact.contact_flexibility)
        bars = [bar_of(theta[k], k, wear) for k in nodes if lining is not None]
        worn = [wear[bar] for bar in bars]
        pressure, touching = np.zeros(len(gap)), np.zeros(len(gap), dtype=bool)
        for _ in range(MOST_SWEEPS):
            before = pressure.copy()
            for k in nodes:
                own, penetration = opening[k, k], opening[k, k] * pressure[k] - gap[k] - opening[k] @ pressure
                if lining is None:
                    pressure[k] = max(penetration, 0.0) / own
                    touching[k] = pressure[k] > 0.0
                else:
                    pressure[k], worn[k], touching[k] = self._press_bar_and_casing(k, penetration, own, wear[bars[k]], lining)
            if not np.any(np.abs(pressure - before) > 1e-14 * pressure.max()):
                break
        for bar, new in zip(bars, worn, strict=True):
            self._wear(wear, bar, new)
        return pressure, gap + opening @ pressure, touching

    def _follow_gaps(self, gap, theta, n, state, lining):
        """Wear the bars between those of the last step and of this one, as the penetration says, linear between the two."""
        wear, before, last = state.wear, state.penetration.copy(), state.bar_position.copy()
        bars, steps = wear.shape[1], self.problem.grid.steps_per_revolution
        if not self.problem.scene.exact_gap:
            # not as the state has it: in the last modal interval of a run-up the nodes had other angles
            last = (self.problem.casing.theta((n - 1) % steps) + self.angle) / (2.0 * np.pi) * bars
        state.penetration[:], state.bar_position[:] = -gap, theta / (2.0 * np.pi) * bars
        turn = bars if n % steps == 0 else 0
        for k in map(int, np.flatnonzero((before > 0.0) | (gap < 0.0))):
            position = state.bar_position[k]
            for bar in range(int(np.floor(position)) + 1, int(np.floor(last[k])) + turn):
                share = (bar + 0.5 - position) / (last[k] + turn - position)
                depth = float((before[k] + gap[k]) * share - gap[k])
                _, worn = self._press_bar(k, min(depth, lining.thickness), 0.0, lining, lining.elastic_modulus)
                self._wear(wear, (k, bar % bars), worn)

    def _wear(self, wear, bar, new):
        """Wear a bar, by ring and number, to a new depth (m), if that is more than it has."""
        if new > wear[bar]:
            self.worn += float(new - wear[bar]) * self.problem.casing.bar_surfaces[bar[0]]
            wear[bar] = new

    def _press_bar_and_casing(self, node, penetration, own, wear, lining):
        """Force (N) on a node of flexibility `own` (m/N), new wear (m), and whether it touches the casing behind the bar."""
        stiffness = self.problem.casing.lining_stiffness[node]
        force, worn = self._press_bar(node, penetration, wear, lining, lining.elastic_modulus / (1.0 + stiffness * own))
        if penetration - own * force > lining.thickness:
            _, worn = self._press_bar(node, lining.thickness, wear, lining, lining.elastic_modulus)
            return (penetration - lining.thickness) / own, worn, True
        return force, worn, False

    def _press_bar(self, node, penetration, wear, lining, modulus):
        """Normal force (N) and new wear (m) of a node's bar of elastic `modulus` (Pa) that is pressed to a `penetration` (m).

        Return mapping with linear hardening: trial stress E (strain - plastic strain), yield stress plus K times the plastic
        strain; beyond it the plastic strain grows by the excess over E + K (Simo and Hughes, box 1.4).
        """
        strain, plastic = penetration / lining.thickness, wear / lining.thickness
        if strain <= plastic:
            return 0.0, wear
        excess = modulus * (strain - plastic) - lining.yield_stress - lining.plastic_modulus * plastic
        if excess > 0.0:
            # a bar worn through is gone
            plastic = min(plastic + excess / (modulus + lining.plastic_modulus), 1.0)
        return max(modulus * (strain - plastic), 0.0) * self.problem.casing.pressed_areas[node], plastic * lining.thickness

    def _press_lining(self, gap, theta, lining, wear):
        """Normal forces (N) of the bars that the nodes of a prediction press, shape (nodes,); wears the bars."""
        force = np.zeros(len(gap))
        for k in map(int, np.flatnonzero(gap < 0.0)):
            bar = bar_of(theta[k], k, wear)
            force[k], worn = self._press_bar(k, -gap[k], wear[bar], lining, lining.elastic_modulus)
            self._wear(wear, bar, worn)
        return force

    def _press_casing(self, gap, directions):
        """Multipliers (N), shape (nodes,), that leave no node beyond the casing."""
        if not np.any(gap < 0.0):
            return np.zeros(len(gap))
        # of each node's unit multiplier, along the last axis
        forces = directions[:, :, None] * np.eye(len(gap))
        return complementary(-self.normal @ self.motion.response @ self._modal(forces).T, gap)


def rows_of(operators, problem):
    """Displacement of nodes per displacement of the modes at rest, as far as they are stepped, and per product."""
    stepped = problem.blade.modes @ problem.blade.modes.T
    return np.concatenate([operators.operator_at_rest @ stepped, operators.product_operator], axis=-1)


def bar_of(theta, node, wear):
    """Ring and number of the bar that a node at an angle (rad) meets; `wear`, shape (rings, bars)."""
    bars = wear.shape[1]
    return node, int(np.floor(theta / (2.0 * np.pi) * bars)) % bars


def complementary(matrix, gap):
    """Multipliers >= 0 with gap + matrix multipliers >= 0, the two never both positive.

    Murty's least-index rule, which ends for every P-matrix (Cottle, Pang and Stone, The Linear Complementarity Problem, 4.2).
    """
    tolerance = 1e-12 * np.abs(gap).max()
    touching = np.zeros(len(gap), dtype=bool)
    while True:
        multipliers = np.zeros(len(gap))
        multipliers[touching] = np.linalg.solve(matrix[np.ix_(touching, touching)], -gap[touching])
        opened = gap + matrix @ multipliers
        wrong = np.where(touching, multipliers * np.diag(matrix) < -tolerance, opened < -tolerance)
        if not wrong.any():
            return np.maximum(multipliers, 0.0)
        first = int(np.argmax(wrong))
        touching[first] = not touching[first]


def go_on(engines, states, outs, order):
    """Do the steps of every row of the samples at one speed; returns the rows done, and whether they are within the limit.

    In a step the blades follow each other in `order`. All end with the sample in which one passes the limit. An elastic casing
    is one: each engine has its motion, under the forces of all blades.
    """
    motions, first, steps = [], states[0].samples, engines[0].problem.grid.steps_per_sample
    for engine, state in zip(engines, states, strict=True):
        motions.append(engine.motion.read(state))
        engine.begin(motions[-1], first * steps, state)
    casing, done, bounded = engines[0].motion, 0, True
    while done < len(outs[0].samples) and bounded:
        for n in range(1, steps + 1):
            forces = [engines[place].force(states[place]) for place in order]
            if isinstance(casing, MotionWithCasing):
                forces = casing.pressed_by_all(forces)
            for place, force in zip(order, forces, strict=True):
                motions[place] = engines[place].step(motions[place], (first + done) * steps + n, states[place], force)
        for engine, motion, state, out in zip(engines, motions, states, outs, strict=True):
            bounded &= engine.record(motion, first, done, state, out)
        done += 1
    for engine, motion, state in zip(engines, motions, states, strict=True):
        engine.motion.write(motion, state)
    return done, bounded


class ReferenceSimulation(Simulation):
    """The simulation of one blade by the reference engine."""

    engine_class = ReferenceEngine


class ReferenceRotor(RotorSimulation):
    """The simulation of a rotor by the reference engine: all blades go step by step together, each at its angle."""

    blade_class = ReferenceSimulation

    def advance(self, states, outs):
        engines = [blade.engine for blade in self.blades]
        for engine, angle in zip(engines, self.rotor.angles, strict=True):
            if isinstance(engine.motion, MotionWithCasing):
                # the problems have the angles, and the first in order counts the casing's work
                engine.motion.counted = engine is engines[self.rotor.order[0]]
            else:
                engine.angle = angle
        done, _ = go_on(engines, states, outs, self.rotor.order)
        return [done] * len(engines), [engine.worn for engine in engines], np.zeros(len(engines))
