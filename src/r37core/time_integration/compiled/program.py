"""The program of the compiled engine: its loop over steps, compiled for this processor. Imports numba, so only when needed."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
from numba import types

from r37core.lanes import OPTIONS, inlined, pointed_at, spread, sum_of_lanes
from r37core.native import object_code
from r37core.program_constants import with_constants

from ..jump_numbers import COARSE, STRIDES
from .contact_steps import press_contact, release_contact
from .jump_steps import bound_amplitudes, choose_jump, jump_ahead
from .kind import EXACT_GAP, PUBLISHED, Kind
from .layout import MODAL_ROWS, Capacity, constants_record, integration_record
from .ring_steps import turn_jump, turn_step
from .segment_steps import begin_segment, end_segment
from .steps import leave_casing, list_pressed, measure_exact_gaps, measure_gaps, meet, node_lanes, predict, push_blade, record


@inlined
def _integrate(address):
    """Do the blocks of steps asked for; returns how many were done, fewer when an output passed the limit or is NaN."""
    m = pointed_at(address)
    at_once = np.isinf(m.casing.rise)
    decay = 0.0 if at_once else np.exp(-m.casing.rise)
    coarse_per_block = (m.steps_per_block + COARSE - 1) // COARSE
    # any integers for numba: what it gives a plain 0 or 1 to is compiled for just that, too
    zero, one = int(np.int64(0)), int(np.int64(1))
    beyond, bounded, first_stride = False, False, one
    # whether there are forces at t_n, which the next step follows
    follows = False
    done = kept = segment = until = zero
    first_block = m.call.first_step // m.steps_per_block
    place = m.call.first_step % m.steps_per_revolution
    # of the steps' intervals in which the casing's nearest is known, the first of this block
    interval = place // m.steps_per_block * coarse_per_block
    while done < m.call.blocks:
        begins = done == until
        if begins:
            until += begin_segment(m, segment)
        start = m.call.first_step + done * m.steps_per_block
        remaining = 0.0 if at_once else np.exp(-m.casing.rise * (start + m.call.ahead))
        if place == 0 or begins:
            # so that a run stopped after a revolution goes on with the same bits
            beyond, bounded, first_stride = False, False, one
            if not PUBLISHED:
                follows = list_pressed(m) > 0
        work = lost = spread(0.0)
        position = 0
        while position < m.steps_per_block:
            if position % COARSE == 0 and m.jumping != 0 and not beyond and not follows:
                if not bounded:
                    bound_amplitudes(m)
                    bounded = True
                nearest = (interval + position // COARSE) * node_lanes(m)
                left = m.steps_per_block - position
                stride = choose_jump(m, nearest, first_stride, left, remaining)
                first_stride = max(min(stride + 1, STRIDES - 1), 1)
                if stride >= 0:
                    lost = jump_ahead(m, stride, lost)
                    if m.pairs > 0:
                        turn_jump(m, stride)
                    remaining *= m.flight.decay[stride]
                    position += m.flight.lengths[stride]
                    m.totals.steps_jumped += m.flight.lengths[stride]
                    leave_casing(m)
                    continue
            position += 1
            remaining *= decay
            lost = predict(m, lost)
            here = place + position if place + position < m.steps_per_revolution else 0
            lobes = m.casing.amplitude * (1.0 - remaining)
            if not PUBLISHED and follows:
                work, lost = push_blade(m, work, lost)
                bounded = False
            if m.pairs > 0:
                turn_step(m)
            beyond = measure_exact_gaps(m, here, lobes) if EXACT_GAP else measure_gaps(m, here, lobes)
            if PUBLISHED and beyond:
                work, lost = meet(m, here, work, lost)
                bounded = False
            elif beyond:
                follows = press_contact(m, here)
            elif not PUBLISHED and follows:
                release_contact(m)
                follows = False
            else:
                leave_casing(m)
        m.totals.work += 0.5 * sum_of_lanes(work)
        m.totals.loss += sum_of_lanes(lost)
        m.totals.steps += m.steps_per_block
        # of the samples from the first snapshot's revolution on, every so many-th
        due = first_block + done + 1 - m.samples_before_snapshots
        taken = m.samples_per_snapshot > 0 and due > 0 and due % m.samples_per_snapshot == 0
        within = record(m, done, kept if taken else -1, follows)
        kept += taken
        done += 1
        # counted on, not divided: a block may have two steps
        place, interval = place + m.steps_per_block, interval + coarse_per_block
        if place == m.steps_per_revolution:
            place = interval = zero
        if done == until or not within:
            end_segment(m, segment)
            segment += 1
        if not within:
            break
    return done


def compile_integration(capacity: Capacity, kind: Kind) -> bytes:
    """Object code of `advance(record)`: a function of the record's address that returns the blocks of steps done."""
    return compile_loop(_integrate, types.int64(address_of(capacity)), capacity, kind)


def address_of(capacity: Capacity) -> types.CPointer:
    """The type of a record's address."""
    return types.CPointer(numba.from_dtype(integration_record(capacity)))


def compile_loop(integrate: Any, signature: Any, capacity: Capacity, kind: Kind) -> bytes:
    """Object code of a loop over steps of this signature, called `advance`."""
    others = constants_record(*capacity).itemsize // 8 - MODAL_ROWS * capacity.modes
    integrate = with_constants(integrate, kind.constants | {"OTHERS": others})
    # the loop itself, not a function around it: what a compiled function calls was optimised and emitted once already
    advance = numba.cfunc(signature, **OPTIONS)(integrate.py_func)
    return object_code(advance.inspect_llvm(), advance.native_name, "advance")
