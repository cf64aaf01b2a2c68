"""The casing of a run as its contact nodes meet it: its axes, clearance, own modes, and the bars of its lining."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy import ndarray

from r37core.contact.ring import RingMotion
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .clearance import clearances
from .time_grid import TimeGrid


@dataclass(frozen=True, eq=False)
class CasingOfRun:
    """Casing that the contact nodes of a `model` meet in a `scene` at the speed of a `grid`."""

    model: ContactModel
    scene: Scene
    grid: TimeGrid

    @cached_property
    def ring(self) -> RingMotion | None:
        """The modes of an elastic casing; None for a rigid one."""
        return RingMotion(self.scene.casing.ring) if self.scene.casing.ring else None

    @property
    def cone_angle(self) -> float:
        """Half angle (rad) of the casing's cone."""
        return self.scene.casing.angle(self.model.tip_cone_angle)

    @cached_property
    def tip(self) -> ContactModel:
        """The model whose contact nodes are where the rotation holds them, if the blade grows, or moves, about that place."""
        displaced = self.scene.casing.centrifugal or self.model.is_displaced
        return self.model.spun(self.grid.speed) if displaced else self.model

    @cached_property
    def clearance(self) -> ndarray:
        """Clearance of the round casing at each contact node (m), shape (nodes,)."""
        return clearances(self.model, self.scene, np.array([self.grid.speed]))[0]

    @property
    def rise_time(self) -> float:
        """Time (s) in which the lobes grow to 99% of their height."""
        return self.scene.casing.rise_time(self.grid.duration, self.grid.choice.length_of_rise_fraction)

    @property
    def rotation_velocity(self) -> ndarray:
        """Sliding of the nodes over the casing by the rotation (m/s), positive along the tangent, shape (nodes,)."""
        return -self.tip.radius * self.grid.speed

    @cached_property
    def pressed_areas(self) -> ndarray:
        """Area (m2) of lining that each contact node presses at a time, shape (nodes,); 0 without lining."""
        return self.scene.wear_law.pressed_areas(self.model.tip_lengths, self.model.tip_radius)

    @property
    def lining_stiffness(self) -> ndarray:
        """Elastic stiffness (N/m) of the lining under each contact node, shape (nodes,); 0 without lining."""
        return self.pressed_areas * self.scene.wear_law.stiffness

    @property
    def bar_surfaces(self) -> ndarray:
        """Surface (m2) of the casing under a bar of each contact node's ring, shape (nodes,); 0 without lining."""
        return self.scene.wear_law.bar_surfaces(self.model.tip_lengths, self.model.tip_radius)

    @property
    def bars(self) -> int:
        """Number of bars in each ring; 0 without lining."""
        return self.scene.wear_law.bars

    def theta(self, step: ndarray | int) -> ndarray:
        """Angle (rad) of the undeformed contact nodes at a step of a revolution; the rotor turns towards negative theta."""
        return self.tip.theta - 2.0 * np.pi * step / self.grid.steps_per_revolution

    def opening(self, samples: ndarray) -> ndarray:
        """Clearance (m) that a run adds up to each sample, from the start on, in their shape."""
        return self.scene.casing.change_at((samples + 0.5) / self.grid.choice.samples_per_revolution)

    @property
    def initial_wear(self) -> ndarray:
        """Wear (m) of each ring of the lining where the tip reaches into it before anything vibrates, shape (rings, 1).

        The speed was reached slowly, so the tip has cut its way and presses nothing.
        """
        return np.maximum(-self.clearance, 0.0)[:, None]

    def gaps(self, clearance: ndarray, displacement: ndarray, step: int, angle: float) -> tuple[ndarray, ndarray]:
        """Distance (m) of every node from casing or lining, and the angle (rad) at which it meets it, shape (nodes,) both.

        `clearance` (m) of the round casing, shape (nodes,); `displacement` (m) of the nodes along its normal, tangent and
        meridian, shape (3, nodes), relative to a flexible casing; `step`: counted from the start of the run; `angle` (rad): at
        which the blade stands beyond that of its model.
        """
        theta = self.theta(step % self.grid.steps_per_revolution) + angle
        normal, across, meridional = displacement
        position = normal
        if self.scene.exact_gap:
            # the displaced node's radius is sqrt((r + u_r)^2 + u_theta^2), its angle theta + atan(u_theta/(r + u_r))
            cosine, sine = np.cos(self.cone_angle), np.sin(self.cone_angle)
            radius = self.tip.radius + cosine * normal + sine * meridional
            position = position + cosine * (np.hypot(radius, across) - radius)
            theta = theta + np.arctan2(across, radius)
        clearance = clearance + self.opening(np.array(max(step - 1, 0) // self.grid.steps_per_sample))
        lobes = self.scene.casing.lobe(theta, np.array(step * self.grid.time_step), self.rise_time)
        return clearance - lobes - position, theta
