"""The reference engine: the time integration as it reads on paper, in dense NumPy. Slow; the compiled engine must equal it.

Equations after section 5 of the benchmark, in the coordinates of the modes at rest, where the mass is the identity:
u* = A u_n + B u_{n-1} without contact, u_{n+1} = u* + C F with it (reference_motion). Work per step is of the order of modes
squared. A lining of second order, and the static modes with it: see r37core.time_integration.lined_steps. An elastic casing is
followed in the frame that does not turn.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from r37core.contact.casing import casing_axes
from r37core.contact.laws import series_modulus
from r37core.contact.scene import Lining

from .problem import Paces, Problem
from .reference_motion import CoupledMotion, Motion, MotionWithCasing, RealMotion
from .state import Course, SimulationRecord, SimulationState


class ReferenceEngine:
    """The time integration of one problem with dense matrices, in the coordinates of the modes at rest."""

    def __init__(self, problem: Problem, paces: Paces, before: ReferenceEngine | None = None):
        self.problem, self._paces = problem, paces
        self._blade_rows = problem.operator_at_rest @ problem.modes @ problem.modes.T
        self._turn(0)
        self.flexibility = problem.residual_flexibility
        # what all forces (N) on the nodes do to the static modes
        self.static_force = np.zeros((3, len(problem.tip.radius)))
        self.take(0)

    def take(self, place: int) -> None:
        """Go on at the pace of this place."""
        self._place, recursion = place, self._paces.recursion[place]
        blade = (RealMotion if self.problem.complex_modes is None else CoupledMotion)(self.problem, recursion)
        self.motion: Motion = blade if self.problem.ring is None else MotionWithCasing(blade, self.problem, recursion)
        self.clearance = self._paces.clearance[place]

    def _turn(self, n: int) -> None:
        """Take the rows of the nodes where they are at t_n: of the blade's modes at rest, and of an elastic casing's."""
        problem, self.rows = self.problem, self._blade_rows
        if problem.ring is not None:
            of_casing = -casing_axes(problem.ring.displacement(problem.theta(n)), problem.cone_angle)
            self.rows = np.concatenate([self._blade_rows, of_casing], axis=-1)
        self.normal, self.tangential, self.meridional = self.rows

    def advance(self, state: SimulationState, out: SimulationRecord, course: Course) -> int:
        """Do the steps of every row of `out.samples`, as the compiled engine does; returns the rows done."""
        first, snapshots_before = state.samples, self.problem.snapshots_after(state.samples)
        for stretch, (place, samples) in enumerate(zip(course.places, course.samples, strict=True)):
            self._go_over(state, place)
            course.ends[stretch, 0] = state.displacement, state.increment
            done, kept = state.samples - first, self.problem.snapshots_after(state.samples) - snapshots_before
            part = SimulationRecord(out.samples[done : done + samples], out.snapshots[kept:])
            reached, bounded = self._stretch(state, part)
            state.samples += reached
            course.ends[stretch, 1] = state.displacement, state.increment
            course.wear[stretch] = 0.0 if state.wear is None else state.wear.max()
            if not bounded:
                break
        return state.samples - first

    def _go_over(self, state: SimulationState, place: int) -> None:
        """Take a pace; displacement and velocity go over to it."""
        if place == self._place:
            return
        increments = self._paces.increments
        assert increments is not None
        velocity = increments.velocity(self._place, state.displacement, state.increment)
        self.take(place)
        state.increment[:] = increments.increment(place, state.displacement, velocity)

    def _stretch(self, state: SimulationState, out: SimulationRecord) -> tuple[int, bool]:
        """Go on at one pace; returns the rows done, and whether they are within the limit."""
        problem, motion, first = self.problem, self.motion.read(state), state.samples
        done, kept, bounded = 0, 0, True
        step = self._second_order_step if problem.second_order else self._step
        self.static_force = state.lining_force.copy()
        self._turn(first * problem.steps_per_sample)
        while done < len(out.samples) and bounded:
            for n in range(1, problem.steps_per_sample + 1):
                motion = step(motion, (first + done) * problem.steps_per_sample + n, state)
            static = self.static_force.ravel() if problem.second_order else np.empty(0)
            numbers = np.concatenate([self.motion.numbers(motion), static])
            out.samples[done] = problem.output_operator @ numbers
            bounded = bool(np.all(np.abs(out.samples[done]) < problem.scene.divergence_limit))
            done += 1
            if problem.snapshots_after(first + done) > problem.snapshots_after(first) + kept:
                out.snapshots[kept] = numbers
                kept += 1
        self.motion.write(motion, state)
        return done, bounded

    def _step(self, before: Any, n: int, state: SimulationState) -> Any:
        """The motion at t_n from that at t_{n-1}; changes wear, totals and the nodes on the casing."""
        lining = self.problem.scene.lining
        self._turn(n)
        predicted = self.motion.flown(before)
        gap, theta = self.gap(self.motion.displacement(predicted), n)
        directions = self._directions(self.motion.slid(before))
        force = np.zeros(self.rows.shape[-1])
        pressure = np.zeros(len(gap))
        if lining is not None and state.wear is not None:
            modulus = np.full(len(gap), lining.elastic_modulus)
            pressure = self._press_lining(gap, theta, lining, state.wear, modulus)
            force = self._modal(pressure * directions)
            # the casing lies behind the lining; what is left to it after the lining's forces
            gap = gap + lining.thickness - self.normal @ self.motion.response @ force
        multipliers = self._press_casing(gap, directions)
        force = force + self._modal(multipliers * directions)
        after = self.motion.pushed(predicted, force)
        self._add_up(state, self.motion.work_and_loss(before, after, force), pressure + multipliers, multipliers)
        return after

    def _second_order_step(self, before: Any, n: int, state: SimulationState) -> Any:
        """The same with the lining's force at t_{n-1}, which the state has, and that at t_n, for the next step."""
        lining = self.problem.scene.lining
        assert lining is not None and state.wear is not None
        force = self._modal(state.lining_force)
        after, slid = self.motion.pushed(self.motion.flown(before), force), self.motion.slid(before)
        self._turn(n)
        own = np.diagonal(self.flexibility, axis1=1, axis2=2)
        settled = self._settled(state.lining_force) - np.sum(own * state.lining_force, axis=0)
        gap, theta = self.gap(self.motion.displacement(after), n)
        directions = self._directions(slid)
        multipliers = self._press_casing(gap - settled + lining.thickness, directions)
        casing_force = multipliers * directions
        if multipliers.any():
            force = force + self._modal(casing_force)
            after = self.motion.pushed(after, self._modal(casing_force))
            gap, theta = self.gap(self.motion.displacement(after), n)
            settled = settled + self._settled(casing_force)
        # the lining's is of t_{n-1}, the casing's of t_n
        normal_force = np.maximum(-state.lining_force[0], multipliers)
        self._add_up(state, self.motion.work_and_loss(before, after, force), normal_force, multipliers)
        directions = self._directions(1.5 * self.motion.slid(after) - 0.5 * slid)
        flexibility = np.maximum(-np.sum(directions * own, axis=0), 0.0)
        modulus = series_modulus(lining.elastic_modulus, self.problem.bar_stiffness, flexibility)
        pressure = self._press_lining(gap - settled, theta, lining, state.wear, modulus)
        state.lining_force[:] = pressure * directions
        self.static_force = state.lining_force + casing_force
        return after

    def _add_up(
        self, state: SimulationState, work_and_loss: tuple[float, float], normal_force: np.ndarray, multipliers: np.ndarray
    ) -> None:
        """Totals of a step."""
        totals = state.totals
        totals["steps"] += 1
        totals["steps_in_contact"] += np.any(normal_force > 0.0)
        totals["casing_hits"] += np.sum((multipliers > 0.0) & (state.on_casing == 0.0))
        totals["largest_force"] = max(totals["largest_force"], normal_force.max())
        work, loss = work_and_loss
        totals["work"] += work
        totals["loss"] += loss
        state.on_casing[:] = multipliers > 0.0

    def gap(self, u: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray]:
        """Distance (m) of every node from casing or lining, and the angle (rad) at which it meets it."""
        problem = self.problem
        theta = problem.theta(n % problem.steps_per_revolution)
        position = self.normal @ u
        if problem.scene.exact_gap:
            # the displaced node's radius is sqrt((r + u_r)^2 + u_theta^2), its angle theta + atan(u_theta/(r + u_r))
            cosine, sine = np.cos(problem.cone_angle), np.sin(problem.cone_angle)
            radius = problem.tip.radius + cosine * (self.normal @ u) + sine * (self.meridional @ u)
            across = self.tangential @ u
            position = position + cosine * (np.hypot(radius, across) - radius)
            theta = theta + np.arctan2(across, radius)
        lobes = problem.scene.casing.lobe(theta, np.array(n * problem.time_step), problem.duration)
        return self.clearance - lobes - position, theta

    def _directions(self, d: np.ndarray) -> np.ndarray:
        """Forces per unit normal force on each node, shape (3, nodes): towards the axis, with friction against the sliding.

        `d`: displacement of the blade in a step, by which its vibration slides.
        """
        friction, towards_axis = self.problem.scene.friction, -np.ones(len(self.normal))
        if friction is None:
            return np.array([towards_axis, 0.0 * towards_axis, 0.0 * towards_axis])
        # sliding velocity over the casing: that of the rotation plus, in vector form, that of the vibration
        along, across = self.problem.rotation_velocity, np.zeros(len(self.normal))
        if friction.vector:
            step = self.problem.time_step
            along, across = along + self.tangential @ d / step, self.meridional @ d / step
        # Coulomb: mu times the normal force, opposite to the sliding
        share = -friction.coefficient / np.hypot(along, across)
        return np.array([towards_axis, share * along, share * across])

    def _modal(self, forces: np.ndarray) -> np.ndarray:
        """Modal forces of forces (N) on the nodes, shape (3, nodes, ...)."""
        return np.einsum("dk...,dki->...i", forces, self.rows)

    def _settled(self, forces: np.ndarray) -> np.ndarray:
        """Normal displacement (m) of the nodes by the static modes under forces (N) on them, shape (3, nodes)."""
        return np.einsum("dk,dkg->g", forces, self.flexibility)

    def _press_lining(
        self, gap: np.ndarray, theta: np.ndarray, lining: Lining, wear: np.ndarray, modulus: np.ndarray
    ) -> np.ndarray:
        """Normal forces (N) of the bars of elastic `modulus` (Pa) that the nodes press, shape (nodes,); wears the bars.

        Return mapping with linear hardening: trial stress E (strain - plastic strain), yield stress plus K times the plastic
        strain; beyond it the plastic strain grows by the excess over E + K (Simo and Hughes, box 1.4).
        """
        force = np.zeros(len(gap))
        for k in np.flatnonzero(gap < 0.0):
            bar = int(np.floor(theta[k] / (2.0 * np.pi) * wear.shape[1])) % wear.shape[1]
            ring = 0 if lining.shared_ring else k
            strain, plastic = -gap[k] / lining.thickness, wear[ring, bar] / lining.thickness
            if strain > plastic:
                excess = modulus[k] * (strain - plastic) - lining.yield_stress - lining.plastic_modulus * plastic
                if excess > 0.0:
                    # a bar worn through is gone
                    plastic = min(plastic + excess / (modulus[k] + lining.plastic_modulus), 1.0)
                wear[ring, bar] = plastic * lining.thickness
                force[k] = max(modulus[k] * (strain - plastic), 0.0) * self.problem.bar_area
        return force

    def _press_casing(self, gap: np.ndarray, directions: np.ndarray) -> np.ndarray:
        """Multipliers (N), shape (nodes,), that leave no node beyond the casing."""
        if not np.any(gap < 0.0):
            return np.zeros(len(gap))
        friction = self.problem.scene.friction
        if friction is not None and not friction.coupled:
            directions = directions * [[1.0], [0.0], [0.0]]
        # of each node's unit multiplier, along the last axis
        forces = directions[:, :, None] * np.eye(len(gap))
        static = np.einsum("dkj,dkg->gj", forces, self.flexibility)
        return complementary(-self.normal @ self.motion.response @ self._modal(forces).T - static, gap)


def complementary(matrix: np.ndarray, gap: np.ndarray) -> np.ndarray:
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
