"""The time integration compiled to an object file for this processor: imports numba, so only where it is not there yet."""

from __future__ import annotations

import numba
import numpy as np
from numba import types

from r37core.lanes import OPTIONS, inlined, pointed_at, spread, sum_of_lanes
from r37core.native import object_code

from .jumps import bound_amplitudes, choose_jump, jump_ahead
from .layout import COARSE, STRIDES, Kind, Layout, integration_record
from .steps import leave_casing, measure_exact_gaps, measure_gaps, meet, predict, record


@inlined
def _integrate(m, casing, casing_most, wear, samples, rows, snapshots, first_step, blocks, kind):
    """Do up to `blocks` blocks of steps; returns how many were done, fewer when an output passed the limit or is NaN."""
    at_once = np.isinf(m.casing.rise)
    decay = 0.0 if at_once else np.exp(-m.casing.rise)
    coarse_per_block = (m.steps_per_block + COARSE - 1) // COARSE
    beyond, bounded, first_stride = False, False, 1
    done = 0
    while done < blocks:
        start = first_step + done * m.steps_per_block
        place = start % m.steps_per_revolution
        remaining = 0.0 if at_once else np.exp(-m.casing.rise * start)
        if place == 0:
            # so that a run stopped after a revolution goes on with the same bits
            beyond, bounded, first_stride = False, False, 1
        work = lost = spread(0.0)
        position = 0
        while position < m.steps_per_block:
            if kind.jumps and not beyond and position % COARSE == 0:
                if not bounded:
                    bound_amplitudes(m, kind.exact_gap)
                    bounded = True
                nearest = (place // m.steps_per_block * coarse_per_block + position // COARSE) * len(m.force)
                left = m.steps_per_block - position
                stride = choose_jump(m, casing_most, nearest, first_stride, left, remaining, kind.exact_gap)
                first_stride = max(min(stride + 1, STRIDES - 1), 1)
                if stride >= 0:
                    lost = jump_ahead(m, stride, kind.energy, lost)
                    remaining *= m.decay[stride]
                    position += m.lengths[stride]
                    m.totals.steps_jumped += m.lengths[stride]
                    leave_casing(m)
                    continue
            position += 1
            remaining *= decay
            lost = predict(m, kind.energy, lost)
            here = place + position if place + position < m.steps_per_revolution else 0
            lobes = m.casing.amplitude * (1.0 - remaining)
            beyond = measure_exact_gaps(m, here, lobes) if kind.exact_gap else measure_gaps(m, casing, here, lobes)
            if beyond:
                work, lost = meet(m, wear, here, kind, work, lost)
                bounded = False
            else:
                leave_casing(m)
        m.totals.work += 0.5 * sum_of_lanes(work)
        m.totals.loss += sum_of_lanes(lost)
        m.totals.steps += m.steps_per_block
        within = record(m, done, rows[done], samples, snapshots)
        done += 1
        if not within:
            break
    return done


def compile_integration(layout: Layout, kind: Kind) -> bytes:
    """Object code of `advance(record, casing, casing_most, wear, samples, rows, snapshots, first_step, blocks)`.

    `record`: address of the state and constants; `casing` and `casing_most`: f(theta), as in KernelInput, nodes padded;
    `wear`; `samples` and `snapshots` to be filled, `rows`: the row of `snapshots` for each block, -1 for none. Returns the
    blocks done.
    """
    record = types.CPointer(numba.from_dtype(integration_record(layout)))
    numbers, integers = types.CPointer(types.float64), types.CPointer(types.int64)
    signature = types.int64(record, numbers, numbers, numbers, numbers, integers, numbers, types.int64, types.int64)

    @numba.cfunc(signature, **OPTIONS)
    def advance(record, casing, casing_most, wear, samples, rows, snapshots, first_step, blocks):
        return _integrate(pointed_at(record), casing, casing_most, wear, samples, rows, snapshots, first_step, blocks, kind)

    return object_code(advance.inspect_llvm(), advance.native_name, "advance")
