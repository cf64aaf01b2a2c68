"""One simulation: a blade at one speed in one scene."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from r37core.alignment import LANES
from r37core.contact.casing import casing_axes
from r37core.contact.scene import Lining, Scene
from r37core.rom.contact_model import ContactModel

from . import kernel
from .flight import nearest_casing, plan_flight
from .integration_choice import LARGEST_TABLE, IntegrationChoice
from .integrators import CENTRAL_DIFFERENCE, recursion
from .reference import Clock, ReferenceIntegration


class UnstableStepError(ValueError):
    """A time step beyond a stability limit."""


class LongRevolutionError(ValueError):
    """A revolution of so many steps that the casing's table would not fit in memory."""


TIP_POINTS, DIRECTIONS = ("leading_edge", "trailing_edge"), ("normal", "radial", "tangential")
"""What the samples are of: every direction at the first tip point, then at the second."""
OUTPUTS = len(TIP_POINTS) * len(DIRECTIONS)


@dataclass
class SimulationState:
    """Where a run stands; a run may be stopped after any revolution and go on from its state.

    `displacement` u_n and `increment` u_n - u_{n-1}, shape (modes,), in the speed's modes; `wear` (m), shape (rings, bars);
    `on_casing`, shape (nodes,): whether a node touched the casing in the last step; `totals`: see layout.TOTALS.
    """

    displacement: np.ndarray
    increment: np.ndarray
    wear: np.ndarray | None
    on_casing: np.ndarray
    revolutions: int = 0
    totals: np.ndarray = field(default_factory=kernel.no_totals)


@dataclass(frozen=True)
class SimulationRecord:
    """What a stretch of revolutions left behind.

    `samples` (m), shape (samples, 6): normal, radial and tangential displacement of the leading edge, then of the trailing
    edge; `snapshots`, shape (snapshots, modes), in the speed's modes; `diverged`.
    """

    samples: np.ndarray
    snapshots: np.ndarray
    diverged: bool


class Simulation:
    """The time integration of one blade at one speed in one scene.

    Attributes: `frequencies` (rad/s), `modes` (in modes at rest), `time_step` (s): the largest one not above the chosen one
    that divides a revolution into whole samples, `steps_per_revolution`; `displacement_operator`, shape (3, nodes, modes):
    displacement of the contact nodes along the casing's normal, tangent and meridian.

    Raises UnstableStepError for a step at or above the stability limit 2/omega_max of central differences, or that of a node
    pressed on the lining's bars; LongRevolutionError for a revolution of too many steps.
    """

    def __init__(self, model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice):
        self.model, self.speed, self.scene, self.choice = model, speed, scene, choice
        self.frequencies, self.modes = model.modes_at(speed)
        kept = self.frequencies <= 2.0 * np.pi * choice.highest_frequency
        if not kept.any():
            raise ValueError(
                f"highest_frequency_hz: found {choice.highest_frequency:g}; allowed: more than the first mode's, "
                f"{self.frequencies[0] / 2.0 / np.pi:.6g} Hz at {speed:g} rad/s"
            )
        self.frequencies, self.modes = self.frequencies[kept], np.ascontiguousarray(self.modes[:, kept])
        period = 2.0 * np.pi / speed
        self.steps_per_sample = int(np.ceil(period / (choice.samples_per_revolution * choice.time_step) - 1e-9))
        self.steps_per_revolution = self.steps_per_sample * choice.samples_per_revolution
        self.time_step = period / self.steps_per_revolution
        self._check_length()
        self.cone_angle = scene.casing.angle(model.tip_cone_angle)
        self.displacement_operator = casing_axes(model.displacement_operator, self.cone_angle) @ self.modes
        self.integration = recursion(choice.integrator, self.frequencies, scene.damping_ratio, self.time_step)
        self.recursion = self.integration.coefficients
        self.coupling = np.array(
            [(rows * self.integration.inverse) @ self.displacement_operator[0].T for rows in self.displacement_operator]
        )
        self._check_stability()
        self._made: kernel.Kernel | ReferenceIntegration | None = None

    @property
    def duration(self) -> float:
        """Length of the whole run (s)."""
        return self.choice.revolutions * self.steps_per_revolution * self.time_step

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
        bar_stiffness = lining.elastic_modulus * self._bar_area(lining) / lining.thickness
        ratio = bar_stiffness * float(np.linalg.eigvalsh(self.coupling[0])[-1]) * 0.75
        if not ratio < 1.0:
            raise UnstableStepError(
                f"time_step_s: {self.choice.time_step:g} s gives steps of {self.time_step:.6g} s, not below the limit for this "
                f"lining, about {self.time_step / np.sqrt(ratio):.6g} s (bars of {bar_stiffness:.4g} N/m); use a smaller one, "
                "or a softer, thicker or narrower lining"
            )

    def compile(self) -> None:
        """Compile the time integration for this model and scene, unless it is there already."""
        self._engine()

    def start(self) -> SimulationState:
        """The blade at rest in an unworn lining."""
        lining = self.scene.lining
        wear = None
        if lining is not None:
            wear = np.zeros((1 if lining.shared_ring else self.displacement_operator.shape[1], lining.bars))
        zero = np.zeros(len(self.frequencies))
        return SimulationState(zero.copy(), zero.copy(), wear, np.zeros(self.displacement_operator.shape[1], dtype=bool))

    def advance(self, state: SimulationState, revolutions: int) -> SimulationRecord:
        """Go on by `revolutions` from `state`, which is changed."""
        choice = self.choice
        blocks = revolutions * choice.samples_per_revolution
        samples = np.zeros((blocks, OUTPUTS))
        which, snapshots = self._snapshot_plan(state.revolutions, blocks)
        done = self._engine().advance(
            state.displacement,
            state.increment,
            state.on_casing,
            state.wear,
            state.totals,
            state.revolutions * self.steps_per_revolution,
            samples,
            which,
            snapshots,
        )
        state.revolutions += revolutions
        if which is None or snapshots is None:
            kept = np.empty((0, len(self.frequencies)))
        else:
            kept = snapshots[: np.count_nonzero(which[:done] >= 0)]
        diverged = done < blocks or not np.all(np.abs(samples[done - 1]) < self.scene.divergence_limit)
        return SimulationRecord(samples[:done], kept, bool(diverged))

    def energy(self, state: SimulationState) -> float:
        """Energy (J) of the vibration; see Recursion."""
        return self.integration.energy(state.displacement, state.increment)

    def _engine(self) -> kernel.Kernel | ReferenceIntegration:
        if self._made is None:
            self._made = self._reference() if self.choice.engine == "reference" else kernel.Kernel(self._kernel_input())
        return self._made

    def _reference(self) -> ReferenceIntegration:
        clock = Clock(self.time_step, self.steps_per_revolution, self.steps_per_sample, self.duration, self.speed)
        return ReferenceIntegration(
            self.model,
            self.scene,
            clock,
            self.cone_angle,
            self.modes,
            self.integration,
            self.displacement_operator,
            self._output_operator(),
        )

    def _kernel_input(self) -> kernel.KernelInput:
        model, scene = self.model, self.scene
        angle = model.theta - 2.0 * np.pi * np.arange(self.steps_per_revolution)[:, None] / self.steps_per_revolution
        shape = scene.casing.shape(angle)
        loss = self._loss_numbers()
        flight = None
        if self.choice.jumps:
            flight = plan_flight(self.recursion, loss, self.steps_per_sample, LANES)
        casing, lining, friction = scene.casing, scene.lining, scene.friction
        # without lobes f is 0 everywhere, and so is what it is multiplied by
        amplitude = casing.amplitude * casing.clearance if casing.lobes else 0.0
        return kernel.KernelInput(
            step=self.time_step,
            steps_per_block=self.steps_per_sample,
            recursion=self.recursion,
            displacement_operator=self.displacement_operator,
            coupling=self.coupling,
            casing=shape,
            distance=(casing.clearance, amplitude, casing.rise_rate(self.duration) * self.time_step),
            output_rows=self._output_operator(),
            limit=scene.divergence_limit,
            radius=model.radius,
            theta=model.theta,
            lobes=(2.0 * np.pi / max(casing.lobes, 1), casing.width),
            cone_angle=self.cone_angle,
            exact_gap=scene.exact_gap,
            lining=lining,
            area=self._bar_area(lining) if lining else 0.0,
            friction=friction,
            rotation_velocity=model.radius * self.speed * (-1.0 if friction.against_rotation else 1.0) if friction else None,
            loss=loss,
            flight=flight,
            casing_most=nearest_casing(shape, self.steps_per_sample) if flight else None,
        )

    def _output_operator(self) -> np.ndarray:
        """Rows of the samples, shape (OUTPUTS, modes)."""
        radial, tangential, _ = self.model.tip_displacement_operator
        normal = casing_axes(self.model.tip_displacement_operator, self.cone_angle)[0]
        return np.stack([normal, radial, tangential], axis=1).reshape(OUTPUTS, -1) @ self.modes

    def _bar_area(self, lining: Lining) -> float:
        return lining.area(float(np.max(self.model.radius)))

    def _loss_numbers(self) -> np.ndarray | None:
        return self.integration.loss if self.choice.energy else None

    def _snapshot_plan(self, revolutions_done: int, blocks: int) -> tuple[np.ndarray | None, np.ndarray | None]:
        choice = self.choice
        if choice.snapshots_per_revolution == 0 or choice.snapshot_revolutions == 0:
            return None, None
        every = choice.samples_per_revolution // choice.snapshots_per_revolution
        number = revolutions_done * choice.samples_per_revolution + np.arange(1, blocks + 1)
        first = (choice.revolutions - choice.snapshot_revolutions) * choice.samples_per_revolution
        taken = (number > first) & ((number - first) % every == 0)
        which = np.where(taken, np.cumsum(taken) - 1, -1)
        return which, np.zeros((int(taken.sum()), len(self.frequencies)))
