"""All numbers of one simulation that do not change while it runs, made once: both engines read them here."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from r37core.contact.casing import casing_axes
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .integration_choice import LARGEST_TABLE, IntegrationChoice
from .integrators import CENTRAL_DIFFERENCE, Recursion, recursion


class UnstableStepError(ValueError):
    """A time step beyond a stability limit."""


class LongRevolutionError(ValueError):
    """A revolution of so many steps that the casing's table would not fit in memory."""


@dataclass(frozen=True, eq=False)
class Problem:
    """A blade's `model` at one `speed` (rad/s) in one `scene`, stepped as `choice` says, and what follows from these four.

    Raises UnstableStepError for a step at or above the stability limit 2/omega_max of central differences, or that of a node
    pressed on the lining's bars; LongRevolutionError for a revolution of too many steps.
    """

    model: ContactModel
    speed: float
    scene: Scene
    choice: IntegrationChoice

    def __post_init__(self) -> None:
        self._check_length()
        self._check_stability()

    @property
    def frequencies(self) -> np.ndarray:
        """Of the modes (rad/s), ascending."""
        return self._kept_modes[0]

    @property
    def modes(self) -> np.ndarray:
        """Of the speed, shape (modes at rest, modes)."""
        return self._kept_modes[1]

    @cached_property
    def _kept_modes(self) -> tuple[np.ndarray, np.ndarray]:
        frequencies, modes = self.model.modes_at(self.speed)
        highest = self.choice.highest_frequency
        kept = frequencies <= 2.0 * np.pi * highest
        if not kept.any():
            raise ValueError(
                f"highest_frequency_hz: found {highest:g}; allowed: more than the first mode's, "
                f"{frequencies[0] / 2.0 / np.pi:.6g} Hz at {self.speed:g} rad/s"
            )
        return frequencies[kept], np.ascontiguousarray(modes[:, kept])

    @cached_property
    def steps_per_sample(self) -> int:
        """So many that a step is not above the chosen one, and a revolution has whole samples."""
        shortest = 2.0 * np.pi / self.speed / (self.choice.samples_per_revolution * self.choice.time_step)
        return int(np.ceil(shortest - 1e-9))

    @property
    def steps_per_revolution(self) -> int:
        """Whole samples of them."""
        return self.steps_per_sample * self.choice.samples_per_revolution

    @property
    def time_step(self) -> float:
        """Time step (s)."""
        return 2.0 * np.pi / self.speed / self.steps_per_revolution

    @property
    def duration(self) -> float:
        """Length of the whole run (s)."""
        return self.choice.revolutions * self.steps_per_revolution * self.time_step

    @cached_property
    def recursion(self) -> Recursion:
        """How a mode goes from step to step."""
        return recursion(self.choice.integrator, self.frequencies, self.scene.damping_ratio, self.time_step)

    @property
    def cone_angle(self) -> float:
        """Half angle (rad) of the casing's cone."""
        return self.scene.casing.angle(self.model.tip_cone_angle)

    @cached_property
    def displacement_operator(self) -> np.ndarray:
        """Displacement of the contact nodes along the casing's normal, tangent and meridian, shape (3, nodes, modes)."""
        return casing_axes(self.model.displacement_operator, self.cone_angle) @ self.modes

    @cached_property
    def output_operator(self) -> np.ndarray:
        """Rows of the samples, shape (6, modes): see time_integration.simulate, TIP_POINTS and DIRECTIONS."""
        radial, tangential, _ = self.model.tip_displacement_operator
        normal = casing_axes(self.model.tip_displacement_operator, self.cone_angle)[0]
        rows = np.stack([normal, radial, tangential], axis=1)
        return rows.reshape(-1, rows.shape[-1]) @ self.modes

    @cached_property
    def coupling(self) -> np.ndarray:
        """Normal displacement (m/N) of the last node, one step on, per normal, tangential or meridional force on the first.

        Shape (3, nodes, nodes).
        """
        normal = self.displacement_operator[0]
        return np.array([(rows * self.recursion.inverse) @ normal.T for rows in self.displacement_operator])

    @property
    def rotation_velocity(self) -> np.ndarray:
        """What the rotation adds to the nodes' sliding over the casing (m/s), positive along the tangent, shape (nodes,)."""
        friction = self.scene.friction
        return self.model.radius * self.speed * (-1.0 if friction and friction.against_rotation else 1.0)

    @property
    def bar_area(self) -> float:
        """Area of a bar of the lining (m2), at the largest radius of the contact nodes; 0 without lining."""
        return self.scene.lining.area(float(np.max(self.model.radius))) if self.scene.lining else 0.0

    @property
    def rings(self) -> int:
        """How many rings of bars the lining has."""
        lining = self.scene.lining
        return 0 if lining is None else 1 if lining.shared_ring else len(self.model.radius)

    def theta(self, step: np.ndarray | int) -> np.ndarray:
        """Angle (rad) of the undeformed contact nodes at a step of a revolution; the rotor turns towards negative theta."""
        return self.model.theta - 2.0 * np.pi * step / self.steps_per_revolution

    @property
    def samples_before_snapshots(self) -> int:
        """Samples up to the revolutions of which snapshots are kept."""
        return (self.choice.revolutions - self.choice.snapshot_revolutions) * self.choice.samples_per_revolution

    @property
    def samples_per_snapshot(self) -> int:
        """Samples from one snapshot to the next; 0: there are none."""
        choice = self.choice
        asked = choice.snapshots_per_revolution > 0 and choice.snapshot_revolutions > 0
        return choice.samples_per_revolution // choice.snapshots_per_revolution if asked else 0

    def snapshots_after(self, samples: int) -> int:
        """How many snapshots the first `samples` of the run have."""
        every = self.samples_per_snapshot
        return max(samples - self.samples_before_snapshots, 0) // every if every else 0

    def _check_length(self) -> None:
        table = 8 * self.steps_per_revolution * len(self.model.radius)
        if table > LARGEST_TABLE:
            steps = f"{self.steps_per_revolution} steps of {self.time_step:.3g} s"
            raise LongRevolutionError(
                f"speeds: at {self.speed:g} rad/s a revolution has {steps}, "
                f"and the casing's shape at each would take {table / 2**30:.1f} GiB; use a higher speed or a larger time_step_s"
            )

    def _check_stability(self) -> None:
        limit = 2.0 / self.frequencies[-1]
        if self.choice.integrator == CENTRAL_DIFFERENCE and not self.time_step < limit:
            raise UnstableStepError(
                f"time_step_s: {self.choice.time_step:g} s gives steps of {self.time_step:.6g} s, not below the stability "
                f"limit of this reduced model, {limit:.6g} s (highest mode {self.frequencies[-1] / 2e3 / np.pi:.1f} kHz); "
                "use a smaller one, raise basis_tolerance to drop the highest modes, or take the integrator exact_modal"
            )
        lining = self.scene.lining
        if lining is None:
            return
        # a node pressed by x on an elastic bar follows x_{n+1} = (1 - g)(2 x_n - x_{n-1}), g = bar stiffness times c at the
        # node; both roots of the recursion lie inside the unit circle for 0 < g < 4/3
        bar_stiffness = lining.elastic_modulus * self.bar_area / lining.thickness
        ratio = bar_stiffness * float(np.linalg.eigvalsh(self.coupling[0])[-1]) * 0.75
        if not ratio < 1.0:
            raise UnstableStepError(
                f"time_step_s: {self.choice.time_step:g} s gives steps of {self.time_step:.6g} s, not below the limit for this "
                f"lining, about {self.time_step / np.sqrt(ratio):.6g} s (bars of {bar_stiffness:.4g} N/m); use a smaller one, "
                "or a softer, thicker or narrower lining"
            )
