"""The compiled march (march.c), called with NumPy arrays."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from r37core.native import load_library

from .flight import COARSE, FlightPlan

STEPS_IN_CONTACT, CASING_HITS, LARGEST_FORCE, WORST_COMPLEMENTARITY, WORK, LOSS, STEPS, STEPS_JUMPED = range(8)
"""Places in the array of totals: steps with any contact force, onsets of casing contact, largest normal force (N), largest
relative complementarity violation, work of the contact forces (J), energy lost to damping (J), steps done, and those of
them that were part of a jump over free flight."""
TOTALS = 8

_VECTOR_BYTES = 64


@dataclass
class KernelInput:
    """What `advance` needs; fields that a scene lacks are None. See march.h for how each is used.

    `recursion` (-b, c omega^2, c), shape (3, modes); `rows`, shape (3, nodes, modes); `coupling` (m/N), shape (3, nodes,
    nodes): normal displacement of the last node per normal, tangential or meridional force on the one before; `casing`, shape
    (steps per revolution, nodes); `casing_most`: of r37core.march.flight.nearest_casing; `distance`: clearance (m),
    amplitude (m), rise rate times step; `lining`: thickness, moduli, yield stress, bar area, bars; `friction`: coefficient,
    1 for vector, 1 for coupled; `loss`, shape (modes,); `output_rows`, shape (outputs, modes).
    """

    step: float
    steps_per_block: int
    recursion: np.ndarray
    rows: np.ndarray
    coupling: np.ndarray
    casing: np.ndarray
    distance: tuple[float, float, float]
    output_rows: np.ndarray
    limit: float
    precision: type = np.float64
    radius: np.ndarray | None = None
    lining: tuple[float, float, float, float, float, float] | None = None
    bar_position: np.ndarray | None = None
    friction: tuple[float, float, float] | None = None
    rotation_velocity: np.ndarray | None = None
    loss: np.ndarray | None = None
    flight: FlightPlan | None = None
    casing_most: np.ndarray | None = None


def _fields(kind: type, names: str) -> list[tuple[str, type]]:
    return [(name, kind) for name in names.split()]


class _March(ctypes.Structure):
    """struct march of march.h."""

    _fields_ = [
        *_fields(ctypes.c_int64, "first_step steps_per_revolution steps_per_block blocks outputs bars rings levels"),
        *_fields(ctypes.c_double, "step clearance amplitude rise limit"),
        *_fields(ctypes.c_double, "thickness elastic_modulus plastic_modulus yield_stress bar_area"),
        *_fields(ctypes.c_double, "friction vector_friction coupled_friction"),
        *_fields(ctypes.c_void_p, "displacement increment recursion loss rows coupling casing casing_most radius"),
        *_fields(ctypes.c_void_p, "bar_position rotation_velocity wear on_casing jump_length jump_chunks jump jump_decay"),
        *_fields(ctypes.c_void_p, "amplitude_rows output_rows samples snapshot_of_block snapshots totals"),
    ]


def lanes(precision: type) -> int:
    """Numbers in a vector."""
    return _VECTOR_BYTES // np.dtype(precision).itemsize


class Kernel:
    """The march compiled for one model and scene, with its constant arrays laid out for it. Raises CompilerError."""

    def __init__(self, given: KernelInput):
        self._given = given
        _, self._nodes, self._modes = given.rows.shape
        self._lanes = lanes(given.precision)
        self._chunks = -(-self._modes // self._lanes)
        self._padded_nodes = -(-self._nodes // self._lanes) * self._lanes
        self._library = _library(
            HAS_LINING=int(given.lining is not None),
            HAS_FRICTION=int(given.friction is not None),
            HAS_EXACT_GAP=int(given.radius is not None),
            HAS_LOSS=int(given.loss is not None),
            NODES=self._nodes,
            CHUNKS=self._chunks,
            COARSE=COARSE,
            REAL="double" if given.precision is np.float64 else "float",
        )
        self._kept: list[np.ndarray] = []
        self._march = self._constants()

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

        Returns the blocks done: fewer when an output passed the limit or is NaN.
        """
        modal = [self._modal(displacement), self._modal(increment)]
        touching = self._nodal(on_casing)
        march = self._march
        march.first_step, march.blocks = first_step, len(samples)
        march.displacement, march.increment, march.on_casing = modal[0].ctypes.data, modal[1].ctypes.data, touching.ctypes.data
        march.samples, march.totals = samples.ctypes.data, totals.ctypes.data
        if wear is not None:
            march.rings, march.wear = wear.shape[0], wear.ctypes.data
        padded_snapshots = None
        march.snapshot_of_block = march.snapshots = None
        if snapshot_of_block is not None and snapshots is not None:
            padded_snapshots = self._modal(snapshots)
            rows = np.ascontiguousarray(snapshot_of_block, dtype=np.int64)
            march.snapshot_of_block, march.snapshots = rows.ctypes.data, padded_snapshots.ctypes.data
        done = int(self._library.advance(ctypes.byref(march)))
        displacement[:], increment[:] = modal[0][: self._modes], modal[1][: self._modes]
        on_casing[:] = touching[: self._nodes]
        if snapshots is not None and padded_snapshots is not None:
            snapshots[:] = padded_snapshots[:, : self._modes]
        return done

    def _constants(self) -> _March:
        given = self._given
        clearance, amplitude, rise = given.distance
        march = _March(
            steps_per_revolution=len(given.casing),
            steps_per_block=given.steps_per_block,
            outputs=len(given.output_rows),
            step=given.step,
            clearance=clearance,
            amplitude=amplitude,
            rise=rise,
            limit=given.limit,
            recursion=self._keep(self._modal(given.recursion)),
            rows=self._keep(self._rows()),
            coupling=self._keep(self._coupling()),
            casing=self._keep(self._nodal(given.casing)),
            output_rows=self._keep(self._modal(given.output_rows)),
        )
        if given.radius is not None:
            # a node that only pads the vector must not sit on the axis
            radius = self._nodal(given.radius)
            radius[self._nodes :] = 1.0
            march.radius = self._keep(radius)
        if given.lining is not None and given.bar_position is not None:
            march.thickness, march.elastic_modulus, march.plastic_modulus, march.yield_stress, march.bar_area = given.lining[:5]
            march.bars = int(given.lining[5])
            march.bar_position = self._keep(self._nodal(given.bar_position))
        if given.friction is not None and given.rotation_velocity is not None:
            march.friction, march.vector_friction, march.coupled_friction = given.friction
            march.rotation_velocity = self._keep(self._nodal(given.rotation_velocity))
        if given.loss is not None:
            march.loss = self._keep(self._modal(given.loss))
        if given.flight is not None and given.casing_most is not None:
            flight = given.flight
            march.levels = len(flight.lengths)
            march.jump_length = self._keep(flight.lengths)
            march.jump_chunks = self._keep(flight.slow_modes // self._lanes)
            march.jump = self._keep(self._modal(flight.jumps))
            march.jump_decay = self._keep(np.exp(-rise * flight.lengths) if np.isfinite(rise) else np.zeros(march.levels))
            march.amplitude_rows = self._keep(self._modal(flight.amplitude_rows))
            march.casing_most = self._keep(self._nodal(given.casing_most))
        return march

    def _keep(self, array: np.ndarray) -> int:
        """Address of an array that lives as long as the kernel."""
        self._kept.append(array)
        return int(array.ctypes.data)

    def _modal(self, array: np.ndarray) -> np.ndarray:
        return _aligned(array, self._chunks * self._lanes, self._given.precision)

    def _nodal(self, array: np.ndarray) -> np.ndarray:
        return _aligned(array, self._padded_nodes, self._given.precision)

    def _rows(self) -> np.ndarray:
        """Rows as (3, chunks, padded nodes, lanes)."""
        padded = np.zeros((3, self._padded_nodes, self._chunks * self._lanes))
        padded[:, : self._nodes, : self._modes] = self._given.rows
        chunked = padded.reshape(3, self._padded_nodes, self._chunks, self._lanes).transpose(0, 2, 1, 3)
        return _aligned(chunked, self._lanes, self._given.precision)

    def _coupling(self) -> np.ndarray:
        padded = np.zeros((3, self._padded_nodes, self._padded_nodes))
        padded[:, : self._nodes, : self._nodes] = self._given.coupling
        return _aligned(padded, self._padded_nodes, self._given.precision)


@cache
def _library(**definitions: str | int) -> ctypes.CDLL:
    library = load_library(Path(__file__).parent / "march.c", definitions)
    library.advance.restype = library.size_of_march.restype = ctypes.c_int64
    if library.size_of_march() != ctypes.sizeof(_March):
        raise AssertionError("struct march of march.h and of kernel.py differ")
    return library


def _aligned(array: np.ndarray, length: int, kind: type) -> np.ndarray:
    """A copy whose last axis is padded with zeros to `length`, starting on a vector's boundary."""
    shape = (*array.shape[:-1], length)
    size = int(np.prod(shape)) * np.dtype(kind).itemsize
    buffer = np.zeros(size + _VECTOR_BYTES, dtype=np.uint8)
    offset = -buffer.ctypes.data % _VECTOR_BYTES
    result = buffer[offset : offset + size].view(kind).reshape(shape)
    result[..., : array.shape[-1]] = array
    return result
