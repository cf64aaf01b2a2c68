"""A problem laid out for the compiled engine: all that its program needs of it lies in one record."""

from __future__ import annotations

from typing import Any, Self

import numpy as np

from r37core.contact.casing import rise_rate
from r37core.contact.ring import RingMotion
from r37core.contact.scene import Friction, Lining
from r37core.machine_code.alignment import LANES, NUMBER_BYTES, address_of, aligned_copy, aligned_zeros, padded

from ..integrators import CENTRAL_DIFFERENCE
from ..problem import Problem
from ..quadratic_motion import QuadraticMotion
from ..segments import Segments
from .edge_tables import EdgeTables
from .layout import LINING, Capacity, Kind, capacity_of, constants_record, integration_record

_ROWS_AT_ONCE = 2**17
"""Steps whose casing is computed at once."""


class LaidOutProblem:
    """A problem as its program reads it: its numbers in one `record`, sizes and choices that it is compiled for.

    It is at the first speed of its `segments` until `take`. Of one `before`, of the same scene and choice at another
    speed, it keeps what fits, and that one must not go on. With one `beside` it shares the tables of the casing, if they fit,
    and has its capacity where that is larger.
    """

    record: np.ndarray
    _corners: dict[tuple[str, tuple[int, ...]], np.ndarray]
    _tables: _CasingTables

    def __init__(self, problem: Problem, segments: Segments, before: Self | None = None, beside: Self | None = None):
        self.problem = problem
        _, self._nodes, self._modes = problem.contact.displacement_operator.shape
        blade, pairs = len(problem.blade.frequencies), len(problem.scene.casing.ring)
        # lanes that are used; the modes of an elastic casing begin whole vectors
        self._pairs, self._node_lanes = padded(pairs), padded(self._nodes)
        products = problem.contact.product_shapes.shape[1]
        self.mode_lanes = padded(blade + products) + 2 * self._pairs
        firsts = (self.mode_lanes - 2 * self._pairs, self.mode_lanes - self._pairs)
        ring_columns = [first + np.arange(pairs) for first in firsts]
        self.casing_lanes = slice(firsts[0], self.mode_lanes)
        # an array of indices costs more in every segment of a run-up
        self.mode_columns = np.concatenate([np.arange(blade), *ring_columns]) if pairs else slice(blade)
        self.product_columns = slice(blade, blade + products)
        scene, choice = problem.scene, problem.choice
        self.capacity = capacity_of(self.mode_lanes, self._node_lanes)
        if beside is not None:
            self.capacity = Capacity(*map(max, self.capacity, beside.capacity))
        follows_sliding = scene.friction is not None and scene.friction.vector
        self.kind = kind = Kind(choice.integrator == CENTRAL_DIFFERENCE, scene.exact_gap)
        self._flags = {"lined": scene.lined, "quadratic": problem.contact.quadratic is not None}
        self._take_room(before)
        self._lay_out(problem)
        if problem.casing.ring is not None:
            self._lay_out_ring(problem.casing.ring, problem)
        self._lay_out_casing(problem, before or beside)
        if scene.friction is not None:
            self._lay_out_friction(problem, scene.friction)
        if scene.lining is not None:
            self._lay_out_lining(problem, scene.lining)
        if not kind.published:
            self._lay_out_static_modes(problem)
        if problem.contact.quadratic is not None:
            self._lay_out_quadratic(problem.contact.quadratic, problem)
        if segments.increments is None:
            self._edge = EdgeTables(problem, kind, self)
            self._edge.put_into(self.record[0]["edge"])
        self.put(follows_sliding=follows_sliding, **self._flags)
        self.constants = self._table_of(segments)
        self.take(0)

    def take(self, speed_index: int) -> None:
        """Go on at this one of the speeds."""
        m = self.record[0]
        m["speed"] = self.constants[speed_index]
        m["call"]["speed_index"] = speed_index

    def _take_room(self, before: LaidOutProblem | None) -> None:
        if before is not None and self._shape == before._shape:
            self.record, self._corners = before.record, before._corners
        else:
            self.record, self._corners = aligned_zeros((1,), integration_record(self.capacity)), {}
        self.addresses = np.array([address_of(self.record)], dtype=np.uint64)

    @property
    def _shape(self) -> tuple[Any, ...]:
        """Numbers that decide the room of a record, and which parts of it are filled."""
        return self.capacity, self.kind, self._flags, self._nodes, self._modes, self.mode_lanes

    def _table_of(self, segments: Segments) -> np.ndarray:
        """The segments as they stand in the record, shape (segments,)."""
        _, recursion, coupling, clearance, increments = segments
        fields = {"clearance": clearance}
        if coupling is not None:
            fields["coupling"] = coupling
        modal_fields = {name: getattr(recursion, name) for name in ("keep", "pull", "inverse", "loss")}
        if increments is not None:
            modal_fields["increment_by_displacement"] = increments.displacement_factor
            modal_fields["increment_by_velocity"] = increments.velocity_factor
            modal_fields["velocity_by_increment"] = 1.0 / increments.velocity_factor
        fields |= {name: self._spread(values) for name, values in modal_fields.items()}
        table = aligned_zeros((len(clearance),), constants_record(*self.capacity))
        # a node that only pads the vector must not touch
        table["clearance"] = 1.0
        for name, values in fields.items():
            table[name][(slice(None), *map(slice, values.shape[1:]))] = values
        return table

    def _corner(self, name: str, shape: tuple[int, ...]) -> np.ndarray:
        """The part of a field of the record that an array fills; what pads it stays as it is."""
        if (name, shape) not in self._corners:
            self._corners[name, shape] = self.record[0][name][tuple(map(slice, shape))]
        return self._corners[name, shape]

    def put(self, **values: Any) -> None:
        """Put numbers and arrays into fields of the record."""
        m = self.record[0]
        for name, value in values.items():
            if isinstance(value, np.ndarray) and value.shape:
                self._corner(name, value.shape)[...] = value
            else:
                m[name] = value

    def put_modes(self, **values: np.ndarray) -> None:
        """Put arrays whose last axis is that of the modes into fields of the record."""
        self.put(**{name: self._spread(value) for name, value in values.items()})

    def _spread(self, values: np.ndarray) -> np.ndarray:
        """Arrays whose last axis is that of the modes, with these in their lanes; as they are if all lie together."""
        if not self._pairs:
            return values
        lanes = np.zeros((*values.shape[:-1], self.mode_lanes))
        lanes[..., self.mode_columns] = values
        return lanes

    @property
    def snapshot_width(self) -> int:
        """Numbers of a snapshot in whole vectors, the forces on the nodes after those of the modes."""
        return self.mode_lanes + (0 if self.kind.published else 3 * self._node_lanes)

    def _lay_out(self, problem: Problem) -> None:
        m = self.record[0]
        # a node that only pads the vector must not sit on the axis
        m["radius"] = 1.0
        m["contact"]["lanes"] = self._node_lanes
        m["call"]["constants_size"] = constants_record(*self.capacity).itemsize // NUMBER_BYTES
        self.put_modes(
            displacement_operator=problem.contact.displacement_operator,
            outputs=problem.contact.output_operator[None, :, : self._modes],
        )
        self.put(
            radius=problem.casing.tip.radius,
            theta=problem.casing.tip.theta,
            number_of_outputs=len(problem.contact.output_operator),
            limit=problem.scene.divergence_limit,
            nodes=self._nodes,
            vectors=np.array([self.mode_lanes, self._node_lanes]) // LANES,
            pairs=self._pairs,
            steps_per_revolution=problem.grid.steps_per_revolution,
            steps_per_block=problem.grid.steps_per_sample,
            samples_per_snapshot=problem.grid.samples_per_snapshot,
        )

    def _lay_out_ring(self, ring: RingMotion, problem: Problem) -> None:
        turns = 2.0 * np.pi / problem.grid.steps_per_revolution * ring.nodal_diameters
        self.put(turn_cosine=np.cos(turns), turn_sine=np.sin(turns))

    def _lay_out_casing(self, problem: Problem, before: LaidOutProblem | None) -> None:
        m, casing = self.record[0], problem.scene.casing
        rise = rise_rate(problem.casing.rise_time) * problem.grid.time_step
        numbers = {
            "amplitude": casing.lobe_height,
            "rise": rise,
            "period": 2.0 * np.pi / max(casing.lobes, 1),
            "width": casing.width,
            "cosine": np.cos(problem.casing.cone_angle),
            "sine": np.sin(problem.casing.cone_angle),
        }
        for name, number in numbers.items():
            m["casing"][name] = number
        kept = None if before is None else before._tables
        self._tables = kept if kept is not None and kept.fits(problem) else _CasingTables(problem, self._node_lanes)
        m["call"]["casing_shape"] = address_of(self._tables.shape)

    def _lay_out_friction(self, problem: Problem, friction: Friction) -> None:
        velocity = problem.casing.rotation_velocity
        rotation = velocity * problem.grid.time_step
        self.put(friction=friction.coefficient, sliding=np.stack([rotation, np.abs(rotation)]))
        if not friction.vector:
            self.put(friction_share=np.stack([friction.coefficient * np.sign(velocity), np.zeros(self._nodes)]))

    def _lay_out_lining(self, problem: Problem, lining: Lining) -> None:
        m, casing = self.record[0], problem.casing
        for name in LINING.names or ():
            value = getattr(lining, name)
            m["lining"][name] = np.nan if value is None else value
        m["contact"]["area"][: self._nodes] = casing.pressed_areas
        self.put(bar_position=casing.tip.theta / (2.0 * np.pi) * lining.bars, bar_surface=casing.bar_surfaces)

    def _lay_out_static_modes(self, problem: Problem) -> None:
        force_outputs = problem.contact.output_operator[:, -3 * self._nodes :].reshape(-1, 3, self._nodes)
        padded_forces = aligned_copy(force_outputs, self._node_lanes).reshape(1, len(force_outputs), -1)
        self.put(flexibility=problem.contact.contact_flexibility, force_outputs=padded_forces)

    def _lay_out_quadratic(self, quadratic: QuadraticMotion, problem: Problem) -> None:
        m, columns, (functionals, modes) = self.record[0], self.product_columns, quadratic.rows.shape
        products = columns.stop - columns.start
        m["displacement_operator"][:, : self._nodes, columns] = problem.contact.product_operator
        outputs = problem.contact.output_operator[:, self._modes : self._modes + products]
        m["outputs"][0, : len(outputs), columns] = outputs
        second = m["second"]
        second["rows"][0, :functionals, :modes] = quadratic.rows
        second["stepped"], second["stepped"][columns] = 1.0, 0.0
        second["weight"][:products], second["cubic"][:products, :products] = quadratic.weights, quadratic.cubic.T
        second["left"][:products, :products] = quadratic.left
        second["bound"], second["surely_within"] = quadratic.bound, quadratic.surely_within
        first, last = second["first"][:products], second["second"][:products] = quadratic.pairs
        second["product_of"][first, last] = second["product_of"][last, first] = np.arange(products)
        numbers = {"functionals": functionals, "lanes": padded(functionals), "products": products, "lane": columns.start}
        for name, number in numbers.items():
            second[name] = number


class _CasingTables:
    """f(theta) of the casing at every step of a revolution, for whole vectors of nodes."""

    def __init__(self, problem: Problem, nodes: int):
        steps, self._problem = problem.grid.steps_per_revolution, problem
        self.shape = aligned_zeros((steps, nodes))
        # in parts, between which Python sees an interrupt
        for first in range(0, steps, _ROWS_AT_ONCE):
            theta = problem.casing.theta(np.arange(first, min(first + _ROWS_AT_ONCE, steps))[:, None])
            self.shape[first : first + _ROWS_AT_ONCE, : theta.shape[1]] = problem.scene.casing.shape(theta)

    def fits(self, problem: Problem) -> bool:
        """True where this problem has the same tables."""
        mine, other = (
            (each.grid.steps_per_revolution, each.grid.steps_per_sample, each.scene.casing.lobes, each.scene.casing.width)
            for each in (self._problem, problem)
        )
        return mine == other and np.array_equal(self._problem.casing.tip.theta, problem.casing.tip.theta)
