"""Time integration as it reads on paper: dense matrices, plain NumPy, step by step. Slow; the compiled one must equal it.

Equations after section 5 of the benchmark, in the coordinates of the modes at rest, where the mass is the identity:
u* = A u_n + B u_{n-1} without contact, u_{n+1} = u* + C F with it. Work per step is of the order of modes squared.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .integrators import Recursion


@dataclass(frozen=True)
class Clock:
    """Time step (s), steps in a revolution and between samples, length of the whole run (s), speed (rad/s)."""

    step: float
    steps_per_revolution: int
    steps_per_sample: int
    duration: float
    speed: float


class ReferenceIntegration:
    """The time integration of one blade in one scene with dense matrices.

    `modes`, shape (modes at rest, modes): of the speed; `displacement_operator`, shape (3, nodes, modes): normal, tangential
    and meridional displacement of the contact nodes, and `output_rows`, shape (outputs, modes), in the speed's modes.
    """

    def __init__(
        self,
        model: ContactModel,
        scene: Scene,
        clock: Clock,
        cone_angle: float,
        modes: np.ndarray,
        recursion: Recursion,
        displacement_operator: np.ndarray,
        output_rows: np.ndarray,
    ):
        self.model, self.scene, self.clock, self.cone_angle, self.modes = model, scene, clock, cone_angle, modes
        self.normal, self.tangential, self.meridional = displacement_operator @ modes.T
        self.outputs = output_rows @ modes.T
        # -B, I - A - B, C and the loss per squared central difference, as matrices
        self.keep, self.pull, self.inverse, self.loss = (
            modes @ np.diag(diagonal) @ modes.T
            for diagonal in (recursion.keep, recursion.pull, recursion.inverse, recursion.loss)
        )

    def advance(
        self,
        displacement: np.ndarray,
        increment: np.ndarray,
        on_casing: np.ndarray,
        wear: np.ndarray | None,
        totals: np.ndarray,
        first_step: int,
        samples: np.ndarray,
        snapshot_of_block: np.ndarray | None,
        snapshots: np.ndarray | None,
    ) -> int:
        """Do one block of steps per row of `samples`, as the compiled time integration does; returns the blocks done."""
        # u_n and d_n = u_n - u_{n-1}: A + B rounds to 1 - 1e-9 of omega^2 away, so the recursion is carried in these
        u, d = self.modes @ displacement, self.modes @ increment
        done, bounded = 0, True
        while done < len(samples) and bounded:
            for n in range(1, self.clock.steps_per_sample + 1):
                u, d = self._step(u, d, first_step + done * self.clock.steps_per_sample + n, on_casing, wear, totals)
            samples[done] = self.outputs @ u
            if snapshot_of_block is not None and snapshots is not None and snapshot_of_block[done] >= 0:
                snapshots[snapshot_of_block[done]] = self.modes.T @ u
            bounded = bool(np.all(np.abs(samples[done]) < self.scene.divergence_limit))
            done += 1
        displacement[:], increment[:] = self.modes.T @ u, self.modes.T @ d
        return done

    def _step(
        self, u: np.ndarray, d: np.ndarray, n: int, on_casing: np.ndarray, wear: np.ndarray | None, totals: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """From u_{n-1}, d_{n-1} to u_n, d_n."""
        predicted = self.keep @ d - self.pull @ u
        gap, theta = self.gap(u + predicted, n)
        pushes = self._pushes(d)
        force = np.zeros(len(u))
        pressure = np.zeros(len(gap))
        if wear is not None:
            pressure = self._press_lining(gap, theta, wear)
            force = pressure @ pushes
            # the casing lies behind the lining; what is left to it after the lining's forces
            gap = gap + self.scene.lining.thickness - self.normal @ self.inverse @ force  # type: ignore[union-attr]
        multipliers = self._press_casing(gap, pushes)
        force = force + multipliers @ pushes
        following = predicted + self.inverse @ force
        moved = d + following  # u_{n+1} - u_{n-1}
        normal_force = pressure + multipliers
        totals["steps"] += 1
        totals["steps_in_contact"] += np.any(normal_force > 0.0)
        totals["casing_hits"] += np.sum((multipliers > 0.0) & (on_casing == 0.0))
        totals["largest_force"] = max(totals["largest_force"], normal_force.max())
        totals["work"] += 0.5 * force @ moved
        totals["loss"] += moved @ self.loss @ moved
        on_casing[:] = multipliers > 0.0
        return u + following, following

    def gap(self, u: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray]:
        """Distance (m) of every node from casing or lining, and the angle (rad) at which it meets it."""
        clock, casing = self.clock, self.scene.casing
        # the rotor turns towards negative theta
        theta = self.model.theta - 2.0 * np.pi * (n % clock.steps_per_revolution) / clock.steps_per_revolution
        position = self.normal @ u
        if self.scene.exact_gap:
            # the displaced node's radius is sqrt((r + u_r)^2 + u_theta^2), its angle theta + atan(u_theta/(r + u_r))
            cosine, sine = np.cos(self.cone_angle), np.sin(self.cone_angle)
            radius = self.model.radius + cosine * (self.normal @ u) + sine * (self.meridional @ u)
            across = self.tangential @ u
            position = position + cosine * (np.hypot(radius, across) - radius)
            theta = theta + np.arctan2(across, radius)
        return casing.distance(theta, np.array(n * clock.step), clock.duration) - position, theta

    def _pushes(self, d: np.ndarray) -> np.ndarray:
        """Modal force per unit normal force on each node, shape (nodes, coordinates): towards the axis, with its friction."""
        friction, pushes = self.scene.friction, -self.normal
        if friction is None:
            return pushes
        # sliding velocity over the casing: that of the rotation plus, in vector form, that of the last step's vibration
        rotation = self.model.radius * self.clock.speed * (-1.0 if friction.against_rotation else 1.0)
        along, across = rotation, np.zeros_like(rotation)
        if friction.vector:
            along, across = along + self.tangential @ d / self.clock.step, self.meridional @ d / self.clock.step
        size = np.hypot(along, across)[:, None]
        # Coulomb: mu times the normal force, opposite to the sliding
        return pushes - friction.coefficient * (along[:, None] * self.tangential + across[:, None] * self.meridional) / size

    def _press_lining(self, gap: np.ndarray, theta: np.ndarray, wear: np.ndarray) -> np.ndarray:
        """Normal forces (N) of the bars that the nodes press, shape (nodes,); wears the bars.

        Return mapping with linear hardening: trial stress E (strain - plastic strain), yield stress plus K times the plastic
        strain; beyond it the plastic strain grows by the excess over E + K (Simo and Hughes, box 1.4).
        """
        lining = self.scene.lining
        assert lining is not None
        area = lining.area(float(np.max(self.model.radius)))
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
                force[k] = max(lining.elastic_modulus * (strain - plastic), 0.0) * area
        return force

    def _press_casing(self, gap: np.ndarray, pushes: np.ndarray) -> np.ndarray:
        """Multipliers (N), shape (nodes,), that leave no node beyond the casing."""
        if not np.any(gap < 0.0):
            return np.zeros(len(gap))
        friction = self.scene.friction
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
