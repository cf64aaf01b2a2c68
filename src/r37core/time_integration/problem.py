"""All numbers of one simulation that do not change while it runs, made once: both engines read them here."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from r37core.alignment import LANES, padded
from r37core.contact.casing import casing_axes
from r37core.contact.ring import RingMotion
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.rom.rotation import BucklingError

from .clearance import check_ring, check_room, clearances
from .gyroscopic import LARGEST_TURN, ComplexModes, complex_modes, complex_recursion
from .integration_choice import LARGEST_TABLE, IntegrationChoice
from .integrators import CENTRAL_DIFFERENCE, EXACT_MODAL, Increments, Recursion, increments, joined, recursion
from .jump_plan import JumpPlan, plan_jumps
from .static_modes import relaxation, residual_flexibility, stepped_modes
from .step_limit import UnstableStepError, check_step, largest_pressed_ratio, ratio_of_pressed_nodes

NO_CORIOLIS = "central differences do not carry the Coriolis force; use the integrator exact_modal"
NO_EXACT_GAP = "an elastic casing needs the linear gap: the exact one is that of a casing which keeps its shape"
"""Why a problem is refused."""


class LongRevolutionError(ValueError):
    """A revolution of so many steps that the casing's table would not fit in memory."""


class SpeedConstants(NamedTuple):
    """What of a problem changes with the speed while its modes are held: all with a first axis of speeds.

    `coupling`: of central differences alone. `increments`: None of a single speed.
    """

    recursion: Recursion
    coupling: np.ndarray | None
    jumps: JumpPlan | None
    clearance: np.ndarray
    increments: Increments | None


@dataclass(frozen=True, eq=False)
class Problem:
    """A blade's `model` at one `speed` (rad/s) in one `scene`, stepped as `choice` says, and what follows from these four.

    With the integrator exact_modal the contact forces are those at t_n (`second_order`), and modes faster than
    `choice.static_above` per step follow them statically: they are none of `frequencies` and `modes`; see
    r37core.time_integration.static_modes. With central differences all modes are stepped.

    A model with a Coriolis matrix has its stepped modes coupled by it (`complex_modes`). The modes of an elastic
    casing follow those of the blade wherever "all modes" are meant: the recursion, the operators, a snapshot.

    Raises UnstableStepError for a step at or above the stability limit 2/omega_max of central differences, or that of pressed
    nodes; TooFewStaticModesError where the contact forces would not be unique; LongRevolutionError for a revolution of too
    many steps; NoRoomError for a tip inside of the casing, and for a ring far from it; ValueError for a Coriolis matrix with
    central differences, and an elastic casing with the exact gap.
    """

    model: ContactModel
    speed: float
    scene: Scene
    choice: IntegrationChoice

    def __post_init__(self) -> None:
        if self.model.coriolis is not None and self.choice.integrator == CENTRAL_DIFFERENCE:
            raise ValueError(NO_CORIOLIS)
        if self.scene.casing.ring and self.scene.exact_gap:
            raise ValueError(NO_EXACT_GAP)
        self._check_length()
        check_ring(self.model, self.scene)
        check_room(self.model, self.scene, np.array([self.speed]))
        check_step(self)

    @property
    def second_order(self) -> bool:
        """Whether the contact forces are those at t_n, and not, as published, those that correct the prediction of t_n+1."""
        return self.choice.integrator == EXACT_MODAL

    @property
    def frequencies(self) -> np.ndarray:
        """Of the blade's modes that are stepped (rad/s), ascending, without the Coriolis force."""
        return self._modes_of_speed[0][: self._stepped]

    @property
    def highest_frequency(self) -> float:
        """Of all modes that are stepped (rad/s), the casing's among them."""
        of_ring = self.ring.frequencies.max() if self.ring is not None else 0.0
        return float(max(self.frequencies[-1], of_ring))

    @cached_property
    def ring(self) -> RingMotion | None:
        """The modes of an elastic casing; None for a rigid one."""
        return RingMotion(self.scene.casing.ring) if self.scene.casing.ring else None

    @cached_property
    def modes(self) -> np.ndarray:
        """Those that are stepped, of the speed, shape (modes at rest, modes)."""
        return np.ascontiguousarray(self._modes_of_speed[1][:, : self._stepped])

    @cached_property
    def gyroscopic_coupling(self) -> np.ndarray | None:
        """What couples the stepped modes at the speed (rad/s), skew-symmetric, shape (modes, modes); None without Coriolis.

        Modes that turn by more than LARGEST_TURN in a step are not coupled.
        """
        if self.model.coriolis is None:
            return None
        slow = self.frequencies * self.time_step <= LARGEST_TURN
        return np.where(np.outer(slow, slow), self.speed * self.modes.T @ self.model.coriolis @ self.modes, 0.0)

    @cached_property
    def complex_modes(self) -> ComplexModes | None:
        """Of the stepped modes as the Coriolis force couples them; None for a model without it."""
        return None if self.gyroscopic_coupling is None else complex_modes(self.frequencies, self.gyroscopic_coupling)

    @cached_property
    def _stepped(self) -> int:
        """How many modes are stepped: with central differences all up to the highest frequency, else see static_modes."""
        frequencies, _ = self._modes_of_speed
        below = int(np.count_nonzero(frequencies <= 2.0 * np.pi * self.choice.highest_frequency))
        if below == 0:
            raise ValueError(
                f"highest_frequency_hz: found {self.choice.highest_frequency:g}; allowed: more than the first mode's, "
                f"{frequencies[0] / 2.0 / np.pi:.6g} Hz at {self.speed:g} rad/s"
            )
        if not self.second_order:
            return below
        frequencies, rows = self._at_rest
        choice = self.choice

        def is_stable(stepped: int) -> bool:
            of = recursion(choice.integrator, frequencies[:stepped], self.scene.damping_ratio, choice.time_step)
            flexibility = residual_flexibility(frequencies[stepped:], rows[..., stepped:])[0]
            ratio = ratio_of_pressed_nodes(of, rows[0, :, :stepped], flexibility)
            return ratio < largest_pressed_ratio(self.scene)

        step, above = choice.time_step, choice.static_above
        return stepped_modes(frequencies, rows, self.coupled_friction, step, above, below, is_stable)

    @cached_property
    def relaxation(self) -> float:
        """Of the sweeps over the nodes, the same at every speed: see static_modes.relaxation; 1 with central differences."""
        if not self.second_order:
            return 1.0
        frequencies, rows = self._at_rest
        flexibility = residual_flexibility(frequencies[self._stepped :], rows[..., self._stepped :])
        return relaxation(flexibility, self.coupled_friction)

    @property
    def _at_rest(self) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies (rad/s) of all modes at rest, and the contact nodes' displacement by them, shape (3, nodes, modes)."""
        return np.sqrt(self.model.squared_frequencies), casing_axes(self.model.displacement_operator, self.cone_angle)

    @property
    def coupled_friction(self) -> float:
        """Coefficient of the friction that is part of the contact problem."""
        friction = self.scene.friction
        return friction.coefficient if friction is not None and friction.coupled else 0.0

    @cached_property
    def _modes_of_speed(self) -> tuple[np.ndarray, np.ndarray]:
        return self.model.modes_at(self.speed)

    @cached_property
    def steps_per_sample(self) -> int:
        """So many that a step is not above the chosen one, and a revolution has whole samples; or as the choice says."""
        if self.choice.steps_per_sample is not None:
            return self.choice.steps_per_sample
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
        """How a mode goes from step to step: a complex one in the real part of its amplitude, the casing's without turning."""
        own = self._blade_recursion
        if self.ring is not None:
            ring = self.ring
            of_ring = recursion(self.choice.integrator, ring.frequencies, ring.damping_ratios, self.time_step)
            own = joined(own, of_ring)
        return own if self.complex_modes is None else complex_recursion(own)

    @cached_property
    def _blade_recursion(self) -> Recursion:
        coupled = self.complex_modes
        frequencies = self.frequencies if coupled is None else coupled.frequencies
        return recursion(self.choice.integrator, frequencies, self.scene.damping_ratio, self.time_step)

    @cached_property
    def _shapes(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacement in the modes at rest per u and per d of all modes; no column of the second without Coriolis.

        The casing's move no mode of the blade.
        """
        none = np.zeros((len(self.modes), len(self._ring_rows[0, 0])))
        if self.complex_modes is None:
            return np.hstack([self.modes, none]), np.empty((len(self.modes), 0))
        by_u, by_d = self.complex_modes.real_shapes(self._blade_recursion)
        return np.hstack([self.modes @ by_u, none]), np.hstack([self.modes @ by_d, none])

    @cached_property
    def _ring_rows(self) -> np.ndarray:
        """What the casing's modes add to `displacement_operator`, with which the nodes come nearer to it."""
        if self.ring is None:
            return np.empty((3, len(self.tip.radius), 0))
        return -casing_axes(self.ring.displacement(self.tip.theta), self.cone_angle)

    @property
    def cone_angle(self) -> float:
        """Half angle (rad) of the casing's cone."""
        return self.scene.casing.angle(self.model.tip_cone_angle)

    @cached_property
    def tip(self) -> ContactModel:
        """The model whose contact nodes are where the rotation holds them, if the blade grows with the speed."""
        return self.model.spun(self.speed) if self.scene.casing.centrifugal else self.model

    @cached_property
    def clearance(self) -> np.ndarray:
        """Of the round casing at each contact node (m), shape (nodes,)."""
        return clearances(self.model, self.scene, np.array([self.speed]))[0]

    @cached_property
    def operator_at_rest(self) -> np.ndarray:
        """`displacement_operator` of the modes at rest."""
        return casing_axes(self.tip.displacement_operator, self.cone_angle)

    @cached_property
    def displacement_operator(self) -> np.ndarray:
        """Displacement of the contact nodes along the casing's normal, tangent and meridian, shape (3, nodes, modes).

        Per displacement u of all modes; a coupled one's increment d moves the nodes by `increment_operator`, too. It is that
        relative to the casing, whose modes count against it.
        """
        operator = self.operator_at_rest @ self._shapes[0]
        if self.ring is not None:
            operator[..., len(self.frequencies) :] = self._ring_rows
        return operator

    @cached_property
    def increment_operator(self) -> np.ndarray:
        """The same per increment d, shape (3, nodes, modes); no column without Coriolis."""
        return self.operator_at_rest @ self._shapes[1]

    @cached_property
    def complex_operator(self) -> np.ndarray | None:
        """The same per complex amplitude, shape (3, nodes, modes)."""
        if self.complex_modes is None:
            return None
        blade = self.operator_at_rest @ self.modes @ self.complex_modes.shapes
        return np.concatenate([blade, self._ring_rows], axis=-1)

    @property
    def size_operator(self) -> np.ndarray:
        """Largest displacement of the nodes per amplitude of each mode alone, in the shape of `displacement_operator`."""
        operator = self.displacement_operator if self.complex_operator is None else self.complex_operator
        sizes = np.abs(operator)
        if self.ring is not None:
            # a pair turns into each other
            blade = len(self.frequencies)
            first, second = np.split(sizes[..., blade:], 2, axis=-1)
            sizes[..., blade:] = np.tile(np.hypot(first, second), 2)
        return sizes

    @cached_property
    def _static_modes(self) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies (rad/s) and shapes of the modes that are not stepped."""
        frequencies, modes = self._modes_of_speed
        return frequencies[self._stepped :], modes[:, self._stepped :]

    @cached_property
    def static_shapes(self) -> np.ndarray:
        """Displacement that follows forces on the contact nodes at once, shape (modes at rest, 3 nodes).

        That of the modes that are not stepped, of forces in the directions of `displacement_operator`: see static_modes. With
        Coriolis also half of the kick by which a force at t_n acts on the stepped modes. No column where the forces are not
        those at t_n.
        """
        if not self.second_order:
            return np.empty((len(self.modes), 0))
        frequencies, modes = self._static_modes
        rows = (self.operator_at_rest @ modes).reshape(3 * len(self.tip.radius), len(frequencies))
        residual = (modes / frequencies**2) @ rows.T
        return residual if self.complex_modes is None else residual + self._half_kick

    def static_energy(self, forces: np.ndarray) -> float:
        """Elastic energy (J) of the static modes under `forces` (N) on the nodes, shape (3, nodes).

        It is all the work that the forces have done on them: what follows at once is elastic.
        """
        frequencies, modes = self._static_modes
        of_modes = np.einsum("dk,dkm->m", forces, self.operator_at_rest @ modes) / frequencies
        return 0.5 * float(of_modes @ of_modes)

    @property
    def _half_kick(self) -> np.ndarray:
        """Half of what a kick moves the stepped modes by, in the shape of `static_shapes`; see ComplexRecursion."""
        by_u, by_d = self._shapes
        size = 0.5 * self.recursion.inverse / self.recursion.keep
        rows, increment_rows = (of.reshape(-1, len(size)) for of in (self.displacement_operator, self.increment_operator))
        return (by_d * size) @ rows.T - (by_u * size) @ increment_rows.T

    @property
    def state_shapes(self) -> np.ndarray:
        """Displacement in the modes at rest per number of a snapshot.

        They are the stepped modes' u, with Coriolis their d, then the contact forces (N).
        """
        return np.hstack([*self._shapes, self.static_shapes])

    @cached_property
    def output_operator(self) -> np.ndarray:
        """Rows of the samples, shape (6, numbers of a snapshot): see time_integration.simulate, TIP_POINTS and DIRECTIONS.

        After them one row for each of the casing's oscillators: displacement at the antinode of its mode (m).
        """
        radial, tangential, _ = self.model.tip_displacement_operator
        normal = casing_axes(self.model.tip_displacement_operator, self.cone_angle)[0]
        rows = np.stack([normal, radial, tangential], axis=1)
        outputs = rows.reshape(-1, rows.shape[-1]) @ self.state_shapes
        if self.ring is None:
            return outputs
        of_ring = np.zeros((len(self.ring.size), outputs.shape[1]))
        np.fill_diagonal(of_ring[:, len(self.frequencies) :], self.ring.size)
        return np.concatenate([outputs, of_ring])

    @cached_property
    def contact_flexibility(self) -> np.ndarray:
        """Normal displacement (m/N) of the last node by `static_shapes` per force on the first, along each direction.

        Shape (3, nodes, nodes). That of the static modes; with Coriolis half of a kick in it, which is skew-symmetric.
        """
        nodes = len(self.tip.radius)
        if not self.static_shapes.size:
            return np.zeros((3, nodes, nodes))
        return (self.operator_at_rest[0] @ self.static_shapes).T.reshape(3, nodes, nodes)

    @cached_property
    def coupling(self) -> np.ndarray:
        """Normal displacement (m/N) of the last node, one step on, per normal, tangential or meridional force on the first.

        Shape (3, nodes, nodes).
        """
        return self._coupling(self.recursion.inverse)

    def _coupling(self, inverse: np.ndarray) -> np.ndarray:
        """`coupling` of the recursion's `inverse`, shape (..., modes); shape (..., 3, nodes, nodes)."""
        normal = self.displacement_operator[0]
        return np.stack([(rows * inverse[..., None, :]) @ normal.T for rows in self.displacement_operator], axis=-3)

    @property
    def own_constants(self) -> SpeedConstants:
        """Of the problem's own speed alone."""
        several = self.recursion[None]
        coupling = None if self.second_order else self.coupling[None]
        return SpeedConstants(several, coupling, self._jumps(several), self.clearance[None], None)

    def _jumps(self, recursion: Recursion) -> JumpPlan | None:
        if not self.choice.jumps:
            return None
        # the casing's modes turn as they go, and so do not follow a tangent
        return plan_jumps(recursion, self.steps_per_sample, LANES, followed=len(self.frequencies))

    def constants_at(self, speeds: np.ndarray) -> SpeedConstants:
        """At other `speeds` (rad/s), shape (speeds,), in the modes of the problem's speed and with its steps per revolution.

        A mode's squared frequency is its stiffness at the speed, phi^T K(Omega) phi; the stiffness between modes is left out.
        Raises BucklingError where it is not positive.
        """
        motion = self._motion_at(speeds)
        several = recursion(self.choice.integrator, *motion)
        rooms, of_modes = clearances(self.model, self.scene, speeds), increments(self.choice.integrator, *motion)
        coupling = None if self.second_order else self._coupling(several.inverse)
        return SpeedConstants(several, coupling, self._jumps(several), rooms, of_modes)

    @cached_property
    def _stiffening(self) -> np.ndarray:
        """Relative change of the modes' squared frequencies per squared speed (s2), shape (modes,)."""
        return np.sum(self.modes * (self.model.stiffness_per_square @ self.modes), axis=0) / self.frequencies**2

    def _motion_at(self, speeds: np.ndarray) -> tuple[np.ndarray, float | np.ndarray, np.ndarray]:
        """Frequencies (rad/s) of all modes at each of the speeds, damping ratio, and steps (s)."""
        ratio = 1.0 + (speeds[:, None] ** 2 - self.speed**2) * self._stiffening
        if not np.all(ratio > 0.0):
            raise BucklingError(float(speeds[np.argmin(ratio.min(axis=1))]))
        steps = 2.0 * np.pi / speeds[:, None] / self.steps_per_revolution
        frequencies, damping = self.frequencies * np.sqrt(ratio), self.scene.damping_ratio
        if self.ring is None:
            return frequencies, damping, steps
        of_ring = np.tile(self.ring.frequencies, (len(speeds), 1))
        dampings = np.concatenate([np.full(len(self.frequencies), damping), self.ring.damping_ratios])
        return np.hstack([frequencies, of_ring]), dampings, steps

    @property
    def rotation_velocity(self) -> np.ndarray:
        """What the rotation adds to the nodes' sliding over the casing (m/s), positive along the tangent, shape (nodes,)."""
        friction = self.scene.friction
        return self.tip.radius * self.speed * (-1.0 if friction and friction.against_rotation else 1.0)

    @property
    def bar_area(self) -> float:
        """Area of a bar of the lining (m2), at the largest radius of the contact nodes; 0 without lining."""
        return self.scene.lining.area(float(np.max(self.model.radius))) if self.scene.lining else 0.0

    @property
    def bar_stiffness(self) -> float:
        """Of an elastic bar (N/m); 0 without lining."""
        lining = self.scene.lining
        return 0.0 if lining is None else lining.elastic_modulus * self.bar_area / lining.thickness

    @property
    def bars(self) -> int:
        """How many bars of each ring are told apart: with steps longer than a bar, one for each step of a revolution.

        All bars that a step passes over are then worn as the one it ends on; a force is still that of a single bar.
        """
        lining = self.scene.lining
        if lining is None:
            return 0
        return min(lining.bars, self.steps_per_revolution) if self.second_order else lining.bars

    @property
    def rings(self) -> int:
        """How many rings of bars the lining has."""
        lining = self.scene.lining
        return 0 if lining is None else 1 if lining.shared_ring else len(self.tip.radius)

    def theta(self, step: np.ndarray | int) -> np.ndarray:
        """Angle (rad) of the undeformed contact nodes at a step of a revolution; the rotor turns towards negative theta."""
        return self.tip.theta - 2.0 * np.pi * step / self.steps_per_revolution

    @property
    def samples_before_snapshots(self) -> int:
        """Samples up to the revolutions of which snapshots are kept."""
        return (self.choice.revolutions - self.choice.snapshot_revolutions) * self.choice.samples_per_revolution

    @property
    def samples_per_snapshot(self) -> int:
        """Samples from one snapshot to the next; 0: there are none."""
        choice = self.choice
        wanted = choice.snapshots_per_revolution > 0 and choice.snapshot_revolutions > 0
        return choice.samples_per_revolution // choice.snapshots_per_revolution if wanted else 0

    def snapshots_after(self, samples: int) -> int:
        """How many snapshots the first `samples` of the run have."""
        every = self.samples_per_snapshot
        return max(samples - self.samples_before_snapshots, 0) // every if every else 0

    def snapshots_between(self, first: int, last: int) -> range:
        """The samples from number `first` of the run on, up to `last`, that have a snapshot, counted from the former."""
        every, before = self.samples_per_snapshot, self.samples_before_snapshots - first
        number = self.snapshots_after(first)
        return range(before + (number + 1) * every - 1, last - first, every) if every else range(0)

    def _check_length(self) -> None:
        table = 8 * self.steps_per_revolution * padded(len(self.model.theta))
        if table > LARGEST_TABLE:
            steps = f"{self.steps_per_revolution} steps of {self.time_step:.3g} s"
            raise LongRevolutionError(
                f"speeds: at {self.speed:g} rad/s a revolution has {steps}, "
                f"and the casing's shape at each would take {table / 2**30:.1f} GiB; use a higher speed or a longer step"
            )


def stable_problem(model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice) -> Problem:
    """The problem, with a shorter step than the chosen one where that is unstable and the choice allows it.

    Raises what Problem raises.
    """
    while True:
        try:
            return Problem(model, speed, scene, choice)
        except UnstableStepError as error:
            if not choice.shorten:
                raise
            choice = replace(choice, time_step=error.shortened)
