"""The compiled time integration, called with NumPy arrays. Light: simulation jobs import it and find it compiled."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from r37core.alignment import aligned_copy, aligned_zeros
from r37core.contact.scene import Friction, Lining
from r37core.native import Sources, cached_object, load_function

from .flight import FlightPlan
from .layout import (
    LINING,
    NEVER,
    NORMAL,
    TANGENTIAL,
    TOTALS,
    Kind,
    Layout,
    integration_record,
    layout_of,
)

SOURCES = Sources(
    "alignment.py",
    "lanes.py",
    "native.py",
    "contact/exact_gap.py",
    "contact/casing.py",
    "contact/complementarity.py",
    "contact/friction.py",
    "contact/lining.py",
    "contact/scene.py",
    "time_integration/compiled.py",
    "time_integration/jumps.py",
    "time_integration/layout.py",
    "time_integration/steps.py",
)
"""What the compiled time integration is made from: a change in one of these compiles it anew."""


@dataclass
class KernelInput:
    """What `advance` needs; what a scene lacks is None.

    `step` (s); `recursion` (keep, pull, inverse: see time_integration.steps), shape (3, modes); `displacement_operator`,
    shape (3, nodes, modes): normal, tangential, meridional; `coupling` (m/N), shape (3, nodes, nodes): normal displacement of
    the last node per normal, tangential or meridional force on the one before; `casing`, shape (steps per revolution, nodes):
    f(theta); `casing_most`: of r37core.time_integration.flight.nearest_casing; `distance`: clearance (m), amplitude (m), rise
    rate times step; `lobes`: angle between two (rad), and width of one relative to it; `cone_angle` (rad); `exact_gap`:
    measure it to the lobed cone; `radius` (m), `theta` (rad) of the nodes; `area` (m2) of a bar; `rotation_velocity` (m/s),
    signed; `loss`, shape (modes,); `output_rows`, shape (outputs, modes); `limit` (m) of the outputs.
    """

    step: float
    steps_per_block: int
    recursion: np.ndarray
    displacement_operator: np.ndarray
    coupling: np.ndarray
    casing: np.ndarray
    distance: tuple[float, float, float]
    output_rows: np.ndarray
    limit: float
    radius: np.ndarray
    theta: np.ndarray
    lobes: tuple[float, float] = (2.0 * np.pi, 1.0)
    cone_angle: float = 0.0
    exact_gap: bool = False
    lining: Lining | None = None
    area: float = 0.0
    friction: Friction | None = None
    rotation_velocity: np.ndarray | None = None
    loss: np.ndarray | None = None
    flight: FlightPlan | None = None
    casing_most: np.ndarray | None = None


class Kernel:
    """The time integration compiled for one model and scene, with its constants laid out for it."""

    def __init__(self, given: KernelInput):
        _, self._nodes, self._modes = given.displacement_operator.shape
        self._layout = layout_of(self._modes, self._nodes, len(given.output_rows))
        vector = given.friction is not None and given.friction.vector
        self._advance = _compiled(
            self._layout,
            Kind(
                lined=given.lining is not None,
                vector_friction=vector,
                coupled=given.friction is None or given.friction.coupled,
                exact_gap=given.exact_gap,
                energy=given.loss is not None,
                jumps=given.flight is not None,
            ),
        )
        self._record = aligned_zeros((1,), integration_record(self._layout))
        self._casing = aligned_copy(given.casing, self._layout.nodes)
        self._casing_most = None if given.casing_most is None else aligned_copy(given.casing_most, self._layout.nodes)
        self._fill(given)
        if given.friction is not None:
            self._fill_friction(given)
        if given.lining is not None:
            self._fill_lining(given.lining, given)
        if given.flight is not None:
            self._fill_flight(given.flight)

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
        """Do one block of steps per row of `samples`; changes the state and fills samples and snapshots.

        `on_casing`, bool, shape (nodes,); `totals`: a record of layout.TOTALS, added to. Returns the blocks done: fewer when
        an output passed the limit or is NaN.
        """
        m, blocks = self._record[0], len(samples)
        m["u"][: self._modes], m["now"][: self._modes] = displacement, increment
        m["on_casing"] = np.packbits(aligned_copy(on_casing, self._layout.nodes) > 0, bitorder="little")
        m["totals"] = totals
        rows = np.full(blocks, -1) if snapshot_of_block is None else np.ascontiguousarray(snapshot_of_block, dtype=np.int64)
        kept = np.zeros((0 if snapshots is None else len(snapshots), self._layout.modes))
        if wear is not None:
            m["rings"] = len(wear)
        arrays = (self._record, self._casing, self._casing_most, wear, samples, rows, kept)
        done = int(self._advance(*(None if array is None else array.ctypes.data for array in arrays), first_step, blocks))
        displacement[:], increment[:] = m["u"][: self._modes], m["now"][: self._modes]
        on_casing[:] = np.unpackbits(m["on_casing"].astype(np.uint8), bitorder="little")[: self._nodes]
        totals[()] = m["totals"]
        if snapshots is not None:
            snapshots[:] = kept[:, : self._modes]
        return done

    def _fill(self, given: KernelInput) -> None:
        m, nodes, modes = self._record[0], self._nodes, self._modes
        m["keep"][:modes], m["pull"][:modes], m["inverse"][:modes] = given.recursion
        m["displacement_operator"].reshape(3, -1, self._layout.modes)[:, :nodes, :modes] = given.displacement_operator
        m["push_operator"][:nodes, :modes] = given.displacement_operator[NORMAL]
        m["coupling"][:, :nodes, :nodes] = given.coupling
        m["response"][:nodes, :nodes] = m["columns"][:nodes, :nodes] = given.coupling[NORMAL]
        # a node that only pads the vector must neither sit on the axis nor cancel a pivot
        m["radius"], m["towards"], m["problem"]["diagonal"] = 1.0, 1.0, 1.0
        m["radius"][:nodes], m["theta"][:nodes] = given.radius, given.theta
        m["problem"]["diagonal"][:nodes] = np.diag(given.coupling[NORMAL])
        m["outputs"][:, :modes] = given.output_rows
        m["casing"] = (*given.distance, *given.lobes, np.cos(given.cone_angle), np.sin(given.cone_angle))
        m["limit"], m["nodes"] = given.limit, nodes
        m["steps_per_revolution"], m["steps_per_block"] = len(given.casing), given.steps_per_block
        if given.loss is not None:
            m["loss"][:modes] = given.loss

    def _fill_friction(self, given: KernelInput) -> None:
        """Friction; one of constant direction becomes part of what a normal force does."""
        m, nodes, modes = self._record[0], self._nodes, self._modes
        assert given.friction is not None and given.rotation_velocity is not None
        m["friction"] = given.friction.coefficient
        m["rotation"][:nodes] = given.rotation_velocity * given.step
        if given.friction.vector:
            return
        share = given.friction.coefficient * np.sign(given.rotation_velocity)[:, None]
        m["push_operator"][:nodes, :modes] += share * given.displacement_operator[TANGENTIAL]
        m["response"][:nodes, :nodes] += share * given.coupling[TANGENTIAL]

    def _fill_lining(self, lining: Lining, given: KernelInput) -> None:
        m = self._record[0]
        for name in LINING.names or ():
            value = given.area if name == "area" else getattr(lining, name)
            m["lining"][name] = np.nan if value is None else value
        m["bar_position"][: self._nodes] = given.theta / (2.0 * np.pi) * lining.bars

    def _fill_flight(self, flight: FlightPlan) -> None:
        m, modes, strides = self._record[0], self._modes, len(flight.lengths)
        m["lengths"] = NEVER
        m["lengths"][:strides], m["slow_modes"][:strides] = flight.lengths, flight.slow_modes
        m["jumps"][:strides, :, :modes] = flight.jumps
        m["amplitude_by_u"][:modes], m["amplitude_by_d"][:modes] = flight.amplitude_rows
        rise = m["casing"]["rise"]
        m["decay"][:strides] = np.exp(-rise * flight.lengths) if np.isfinite(rise) else 0.0


@cache
def _compiled(layout: Layout, kind: Kind) -> Callable:
    """The compiled time integration of time_integration.compiled, made if it is not there yet."""

    def build() -> bytes:
        from .compiled import compile_integration

        return compile_integration(layout, kind)

    code = cached_object("time_integration", SOURCES, (layout, kind), build)
    pointers, numbers = [ctypes.c_void_p] * 7, [ctypes.c_int64] * 2
    return load_function(code, "advance", ctypes.c_int64, *pointers, *numbers)


def no_totals() -> np.ndarray:
    """Totals of a run that has not begun, shape ()."""
    return np.zeros((), TOTALS)
