"""A problem laid out for the compiled engine: all that its program needs of it lies in one record."""

from __future__ import annotations

from typing import Any, Self

import numpy as np

from r37core.contact.casing import rise_rate
from r37core.contact.ring import RingMotion
from r37core.contact.scene import Friction, Lining
from r37core.machine_code.alignment import NUMBER_BYTES, address_of, aligned_zeros, padded

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

    It is at the first speed of its `segments` until `take`. With one `beside`, of the same scene and choice, it shares the
    tables of the casing, if they fit, and has its capacity where that is larger.
    """

    _tables: _CasingTables

    def __init__(self, problem: Problem, segments: Segments, beside: Self | None = None):
        self.problem = problem
        _, self._nodes, self._modes = problem.contact.displacement_operator.shape
        blade, pairs = len(problem.blade.frequencies), len(problem.scene.casing.ring)
        # lanes that are used; the modes of an elastic casing begin whole vectors
        self._pairs, self.node_lanes = padded(pairs), padded(self._nodes)
        products = problem.contact.product_shapes.shape[1]
        self.mode_lanes = padded(blade + products) + 2 * self._pairs
        firsts = (self.mode_lanes - 2 * self._pairs, self.mode_lanes - self._pairs)
        ring_columns = [first + np.arange(pairs) for first in firsts]
        self.casing_lanes = slice(firsts[0], self.mode_lanes)
        # an array of indices costs more in every segment of a run-up
        self.mode_columns = np.concatenate([np.arange(blade), *ring_columns]) if pairs else slice(blade)
        self.product_columns = slice(blade, blade + products)
        scene, choice = problem.scene, problem.choice
        self.capacity = capacity_of(self.mode_lanes, self.node_lanes)
        if beside is not None:
            self.capacity = Capacity(*map(max, self.capacity, beside.capacity))
        follows_sliding = scene.friction is not None and scene.friction.vector
        self.kind = kind = Kind(choice.integrator == CENTRAL_DIFFERENCE, scene.exact_gap)
        self.record = aligned_zeros((1,), integration_record(self.capacity))
        self.addresses = np.array([address_of(self.record)], dtype=np.uint64)
        self.snapshot_columns = self._columns_of_snapshots()
        self._lay_out(problem)
        if problem.casing.ring is not None:
            self._lay_out_ring(problem.casing.ring, problem)
        self._lay_out_casing(problem, beside)
        if scene.friction is not None:
            self._lay_out_friction(problem, scene.friction)
        if scene.lining is not None:
            self._lay_out_lining(problem, scene.lining)
        if not kind.published:
            self._lay_out_static_modes(problem)
        if problem.contact.quadratic is not None:
            self._lay_out_quadratic(problem.contact.quadratic)
        if segments.increments is None:
            motion = problem.edge.motion
            rows = self.lane_values(motion.displacement_operator, motion.product_operator)
            self._edge = EdgeTables(problem, rows if kind.exact_gap else rows[:1], self.node_lanes)
            put(self.record["edge"], **self._edge.fields)
        quadratic = problem.contact.quadratic is not None
        put(self.record, follows_sliding=follows_sliding, lined=scene.lined, quadratic=quadratic)
        self.constants = self._table_of(segments)
        self.take(0)

    def take(self, speed_index: int) -> None:
        """Go on at this one of the speeds."""
        self.record["speed"] = self.constants[speed_index]
        put(self.record["call"], speed_index=speed_index)

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
        fields |= {name: self.lane_values(values) for name, values in modal_fields.items()}
        table = aligned_zeros((len(clearance),), constants_record(*self.capacity))
        # a node that only pads the vector must not touch
        table["clearance"] = 1.0
        for name, values in fields.items():
            table[name][(slice(None), *map(slice, values.shape[1:]))] = values
        return table

    def lane_values(self, values: np.ndarray, products: np.ndarray | None = None) -> np.ndarray:
        """Arrays whose last axis is that of the modes, with these in their lanes and, where given, `products` in theirs."""
        lanes = np.zeros((*values.shape[:-1], self.mode_lanes))
        lanes[..., self.mode_columns] = values
        if products is not None:
            lanes[..., self.product_columns] = products
        return lanes

    def _columns_of_snapshots(self) -> np.ndarray:
        """Lanes of a snapshot, of modes and then of the forces on nodes, that are not padding, in the order of a record."""
        lanes, nodes = np.arange(self.mode_lanes), 0 if self.kind.published else self.node_lanes
        forces = self.mode_lanes + np.arange(3 * nodes).reshape(3, nodes)[:, : self._nodes]
        return np.concatenate([lanes[self.mode_columns], lanes[self.product_columns], forces.ravel()])

    def _lay_out(self, problem: Problem) -> None:
        contact, columns = problem.contact, self._modes + problem.contact.product_shapes.shape[1]
        # a node that only pads the vector must not sit on the axis
        self.record["radius"] = 1.0
        put(self.record["contact"], lanes=self.node_lanes)
        put(self.record["call"], constants_size=constants_record(*self.capacity).itemsize // NUMBER_BYTES)
        outputs = contact.output_operator[None]
        put(
            self.record,
            displacement_operator=self.lane_values(contact.displacement_operator, contact.product_operator),
            outputs=self.lane_values(outputs[..., : self._modes], outputs[..., self._modes : columns]),
            radius=problem.casing.tip.radius,
            theta=problem.casing.tip.theta,
            number_of_outputs=len(contact.output_operator),
            limit=problem.scene.divergence_limit,
            nodes=self._nodes,
            mode_lanes=self.mode_lanes,
            pairs=self._pairs,
            steps_per_revolution=problem.grid.steps_per_revolution,
            steps_per_block=problem.grid.steps_per_sample,
            samples_per_snapshot=problem.grid.samples_per_snapshot,
        )

    def _lay_out_ring(self, ring: RingMotion, problem: Problem) -> None:
        turns = 2.0 * np.pi / problem.grid.steps_per_revolution * ring.nodal_diameters
        put(self.record, turn_cosine=np.cos(turns), turn_sine=np.sin(turns))

    def _lay_out_casing(self, problem: Problem, beside: LaidOutProblem | None) -> None:
        casing = problem.scene.casing
        put(
            self.record["casing"],
            amplitude=casing.lobe_height,
            rise=rise_rate(problem.casing.rise_time) * problem.grid.time_step,
            period=2.0 * np.pi / max(casing.lobes, 1),
            width=casing.width,
            cosine=np.cos(problem.casing.cone_angle),
            sine=np.sin(problem.casing.cone_angle),
        )
        kept = None if beside is None else beside._tables
        self._tables = kept if kept is not None and kept.fits(problem) else _CasingTables(problem, self.node_lanes)
        put(self.record["call"], casing_shape=address_of(self._tables.shape))

    def _lay_out_friction(self, problem: Problem, friction: Friction) -> None:
        velocity = problem.casing.rotation_velocity
        rotation = velocity * problem.grid.time_step
        put(self.record, friction=friction.coefficient, sliding=np.stack([rotation, np.abs(rotation)]))
        if not friction.vector:
            put(self.record, friction_share=np.stack([friction.coefficient * np.sign(velocity), np.zeros(self._nodes)]))

    def _lay_out_lining(self, problem: Problem, lining: Lining) -> None:
        casing, numbers = problem.casing, {name: getattr(lining, name) for name in LINING.names or ()}
        put(self.record["lining"], **{name: np.nan if value is None else value for name, value in numbers.items()})
        put(self.record["contact"], area=casing.pressed_areas)
        position = casing.tip.theta / (2.0 * np.pi) * lining.bars
        put(self.record, bar_position=position, bar_surface=casing.bar_surfaces)

    def _lay_out_static_modes(self, problem: Problem) -> None:
        outputs = problem.contact.output_operator
        by_force = np.zeros((len(outputs), 3, self.node_lanes))
        by_force[..., : self._nodes] = outputs[:, -3 * self._nodes :].reshape(-1, 3, self._nodes)
        put(self.record, flexibility=problem.contact.contact_flexibility, force_outputs=by_force.reshape(1, len(outputs), -1))

    def _lay_out_quadratic(self, quadratic: QuadraticMotion) -> None:
        columns, functionals, (first, second) = self.product_columns, len(quadratic.rows), quadratic.pairs
        products, stepped = len(first), np.ones(self.mode_lanes)
        stepped[columns] = 0.0
        product_of = np.zeros((functionals - products,) * 2, dtype=int)
        product_of[first, second] = product_of[second, first] = np.arange(products)
        put(
            self.record["second"],
            rows=quadratic.rows[None],
            stepped=stepped,
            weight=quadratic.weights,
            cubic=quadratic.cubic.T,
            left=quadratic.left,
            bound=quadratic.bound,
            surely_within=quadratic.surely_within,
            first=first,
            second=second,
            product_of=product_of,
            functionals=functionals,
            lanes=padded(functionals),
            products=products,
            lane=columns.start,
        )


def put(records: np.ndarray, **values: Any) -> None:
    """Put numbers, and arrays into the first places of fields of the first of some records; what pads them stays as it is."""
    for name, value in values.items():
        corner: Any = (0, *map(slice, np.shape(value)))
        records[name][corner] = value


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
