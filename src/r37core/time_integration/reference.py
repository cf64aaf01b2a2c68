"""The reference engine: the time integration as it reads on paper, in dense NumPy. Slow; the compiled engine must equal it.

Equations after section 5 of the benchmark, in the coordinates of the modes at rest, where the mass is the identity:
u* = A u_n + B u_{n-1} without contact, u_{n+1} = u* + C F with it. Work per step is of the order of modes squared.
"""

from __future__ import annotations

import numpy as np

from r37core.contact.scene import Lining

from .problem import Problem
from .state import SimulationRecord, SimulationState


class ReferenceEngine:
    """The time integration of one problem with dense matrices, in the coordinates of the modes at rest."""

    def __init__(self, problem: Problem):
        self.problem = problem
        modes, recursion = problem.modes, problem.recursion
        self.normal, self.tangential, self.meridional = problem.displacement_operator @ modes.T
        self.outputs = problem.output_operator @ modes.T
        # -B, I - A - B, C and the loss per squared central difference, as matrices
        self.keep, self.pull, self.inverse, self.loss = (
            modes @ np.diag(diagonal) @ modes.T
            for diagonal in (recursion.keep, recursion.pull, recursion.inverse, recursion.loss)
        )

    def advance(self, state: SimulationState, out: SimulationRecord) -> int:
        """Do the steps of every row of `out.samples`, as the compiled engine does; returns the rows done."""
        problem, modes = self.problem, self.problem.modes
        # u_n and d_n = u_n - u_{n-1}: A + B rounds to 1 - 1e-9 of omega^2 away, so the recursion is carried in these
        u, d = modes @ state.displacement, modes @ state.increment
        first = state.revolutions * problem.choice.samples_per_revolution
        done, kept, bounded = 0, 0, True
        while done < len(out.samples) and bounded:
            for n in range(1, problem.steps_per_sample + 1):
                u, d = self._step(u, d, (first + done) * problem.steps_per_sample + n, state)
            out.samples[done] = self.outputs @ u
            bounded = bool(np.all(np.abs(out.samples[done]) < problem.scene.divergence_limit))
            done += 1
            if problem.snapshots_after(first + done) > problem.snapshots_after(first) + kept:
                out.snapshots[kept] = modes.T @ u
                kept += 1
        state.displacement[:], state.increment[:] = modes.T @ u, modes.T @ d
        return done

    def _step(self, u: np.ndarray, d: np.ndarray, n: int, state: SimulationState) -> tuple[np.ndarray, np.ndarray]:
        """From u_{n-1}, d_{n-1} to u_n, d_n; changes wear, totals and the nodes on the casing."""
        lining, totals = self.problem.scene.lining, state.totals
        predicted = self.keep @ d - self.pull @ u
        gap, theta = self.gap(u + predicted, n)
        pushes = self._pushes(d)
        force = np.zeros(len(u))
        pressure = np.zeros(len(gap))
        if lining is not None and state.wear is not None:
            pressure = self._press_lining(gap, theta, lining, state.wear)
            force = pressure @ pushes
            # the casing lies behind the lining; what is left to it after the lining's forces
            gap = gap + lining.thickness - self.normal @ self.inverse @ force
        multipliers = self._press_casing(gap, pushes)
        force = force + multipliers @ pushes
        following = predicted + self.inverse @ force
        moved = d + following  # u_{n+1} - u_{n-1}
        normal_force = pressure + multipliers
        totals["steps"] += 1
        totals["steps_in_contact"] += np.any(normal_force > 0.0)
        totals["casing_hits"] += np.sum((multipliers > 0.0) & (state.on_casing == 0.0))
        totals["largest_force"] = max(totals["largest_force"], normal_force.max())
        totals["work"] += 0.5 * force @ moved
        totals["loss"] += moved @ self.loss @ moved
        state.on_casing[:] = multipliers > 0.0
        return u + following, following

    def gap(self, u: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray]:
        """Distance (m) of every node from casing or lining, and the angle (rad) at which it meets it."""
        problem = self.problem
        theta = problem.theta(n % problem.steps_per_revolution)
        position = self.normal @ u
        if problem.scene.exact_gap:
            # the displaced node's radius is sqrt((r + u_r)^2 + u_theta^2), its angle theta + atan(u_theta/(r + u_r))
            cosine, sine = np.cos(problem.cone_angle), np.sin(problem.cone_angle)
            radius = problem.model.radius + cosine * (self.normal @ u) + sine * (self.meridional @ u)
            across = self.tangential @ u
            position = position + cosine * (np.hypot(radius, across) - radius)
            theta = theta + np.arctan2(across, radius)
        distance = problem.scene.casing.distance(theta, np.array(n * problem.time_step), problem.duration)
        return distance - position, theta

    def _pushes(self, d: np.ndarray) -> np.ndarray:
        """Modal force per unit normal force on each node, shape (nodes, coordinates): towards the axis, with its friction."""
        friction, pushes = self.problem.scene.friction, -self.normal
        if friction is None:
            return pushes
        # sliding velocity over the casing: that of the rotation plus, in vector form, that of the last step's vibration
        along, across = self.problem.rotation_velocity, np.zeros(len(self.normal))
        if friction.vector:
            step = self.problem.time_step
            along, across = along + self.tangential @ d / step, self.meridional @ d / step
        size = np.hypot(along, across)[:, None]
        # Coulomb: mu times the normal force, opposite to the sliding
        return pushes - friction.coefficient * (along[:, None] * self.tangential + across[:, None] * self.meridional) / size

    def _press_lining(self, gap: np.ndarray, theta: np.ndarray, lining: Lining, wear: np.ndarray) -> np.ndarray:
        """Normal forces (N) of the bars that the nodes press, shape (nodes,); wears the bars.

        Return mapping with linear hardening: trial stress E (strain - plastic strain), yield stress plus K times the plastic
        strain; beyond it the plastic strain grows by the excess over E + K (Simo and Hughes, box 1.4).
        """
        force = np.zeros(len(gap))
        for k in np.flatnonzero(gap < 0.0):
            bar = int(np.floor(theta[k] / (2.0 * np.pi) * lining.bars)) % lining.bars
            ring = 0 if lining.shared_ring else k
            strain, plastic = -gap[k] / lining.thickness, wear[ring, bar] / lining.thickness
            if strain > plastic:
                excess = lining.elastic_modulus * (strain - plastic) - lining.yield_stress - lining.plastic_modulus * plastic
                if excess > 0.0:
                    # a bar worn through is gone
                    plastic = min(plastic + excess / (lining.elastic_modulus + lining.plastic_modulus), 1.0)
                wear[ring, bar] = plastic * lining.thickness
                force[k] = max(lining.elastic_modulus * (strain - plastic), 0.0) * self.problem.bar_area
        return force

    def _press_casing(self, gap: np.ndarray, pushes: np.ndarray) -> np.ndarray:
        """Multipliers (N), shape (nodes,), that leave no node beyond the casing."""
        if not np.any(gap < 0.0):
            return np.zeros(len(gap))
        friction = self.problem.scene.friction
        counted = -self.normal if friction is not None and not friction.coupled else pushes
        return complementary(-self.normal @ self.inverse @ counted.T, gap)


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
