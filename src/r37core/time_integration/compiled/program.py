"""The program of the compiled engine: its loop over steps, compiled for this processor. Imports numba, so only when needed.

It takes one blade, or all blades that press one elastic casing: these do a step before any does the next. Every blade has a
record, and in it the casing's modes, in the rotor's frame that all share. Between contacts these move by themselves, alike in
all records. A step's pushes on them are summed over the blades, and each record takes the sum: so the casing's motion has the
same bits in all. Its work and loss count in the first record; the others are laid out without its loss.

A step follows docs/simulation.md. Equations in the order of that page, and the functions that are them:

| equation | function |
|---|---|
| Motion: modes of one speed | rom.contact_model.ContactModel.modes_at |
| Time integration: a, b, c | time_integration.integrators: exact_modal, central_difference |
| ... d = k d - p q, q + d | steps.predict |
| ... + c F, work and loss | steps.push_lanes; F = phi^T f of the nodes: steps.sum_pushes |
| Directions: n, y, m | contact.casing.casing_axes; sums over modes: steps.displaced |
| Gap: c0 - A (1 - e^(-rho t)) f - n | steps.measure_gaps; f at every step: contact.laws.lobe_shape |
| ... exact | steps._measure_exact_gaps, contact.laws.displaced_position |
| Friction: -mu N v/|v| | contact.laws.friction_direction, steps.set_friction |
| Direct contact, at t_n | contact.node_forces.settle_forces |
| ... for q_{n+1} | steps.press_casing, contact.node_forces.settle_forces |
| Lining: return mapping | contact.laws.return_mapping, for q_{n+1}: steps.press_lining |
| ... at t_n, in series with the node | contact.laws.lines_of_bar, contact.node_forces.take_laws; wear: contact.laws.worn |
| Contact at long steps: R, G | time_integration.static_modes.residual_flexibility, contact_steps.set_column |
| ... all nodes one problem | contact_steps.press_contact |
| ... every bar passed is worn | steps.follow_gaps, steps.wear_passed_bars |
| Large displacements: V, f | quadratic_steps.set_products, quadratic_steps.push_quadratic |
| Flexible casing: its modes in the rotor's frame | steps.turn_step |
"""

import numba
import numpy as np
from numba import types

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import OPTIONS, bits_of, inlined, load, numbers_at, pointed_at, spread, store, sum_of_lanes
from r37core.machine_code.native import object_code
from r37core.machine_code.program_constants import specialised

from .contact_steps import press_contact, release_contact
from .edge_steps import measure_edge
from .layout import PUBLISHED, Capacity, Kind, integration_record
from .quadratic_steps import begin_quadratic, follow_quadratic, push_quadratic
from .segment_steps import begin_segment, end_segment
from .steps import (
    first_of_casing,
    follow_gaps,
    leave_casing,
    measure_gaps,
    mode_lanes,
    node_lanes,
    predict,
    press_casing,
    press_lining,
    push_lanes,
    record,
    set_friction_force,
    sum_pushes,
    take_gaps,
    turn_step,
)


@inlined
def _begin_part(addresses, blades, place, lobes):
    """Find what follows from the motion at t_n, so that a run that was stopped here goes on with the same bits.

    Where no node has a force or is beyond the unworn lining, its gaps may have been those at another speed.
    """
    any_pressing = False
    for b in range(blades):
        m = pointed_at(addresses[b])
        if m.quadratic != 0:
            begin_quadratic(m)
        any_pressing |= m.follows != 0
        for g in range(0, node_lanes(m), LANES):
            any_pressing |= bits_of(load(m.penetration, g) > 0.0) != 0
    if not any_pressing:
        for b in range(blades):
            m = pointed_at(addresses[b])
            if m.lined != 0:
                measure_gaps(m, place, lobes)
                take_gaps(m, m.contact.gap, place)


@inlined
def _begin_block(addresses, blades, block):
    for b in range(blades):
        m = pointed_at(addresses[b])
        m.opening = numbers_at(m.call.openings)[block]
        store(m.block_energy, (0, 0), 0.0)
        store(m.block_energy, (1, 0), 0.0)


@inlined
def _fly(addresses, blades):
    """The free step of all blades, and what the forces on each are to its modes; returns whether there are any."""
    pushed = False
    for b in range(blades):
        m = pointed_at(addresses[b])
        predict(m)
        if not PUBLISHED and m.follows != 0:
            sum_pushes(m)
            pushed = True
        if m.quadratic != 0:
            push_quadratic(m)
            pushed = True
    return pushed


@inlined
def _share_pushes(addresses, blades):
    """Give every record the pushes of all blades on the casing's modes."""
    first = pointed_at(addresses[0])
    for i in range(0, 2 * first.pairs, LANES):
        total = spread(0.0)
        for b in range(blades):
            m = pointed_at(addresses[b])
            if m.follows != 0:
                total += load(m.push, first_of_casing(m) + i)
        for b in range(blades):
            m = pointed_at(addresses[b])
            store(m.push, first_of_casing(m) + i, total)


@inlined
def _push(m, counted):
    """Push a blade and the casing, whose work is `counted` with one of them."""
    work, lost, casing = load(m.block_energy, (0, 0)), load(m.block_energy, (1, 0)), first_of_casing(m)
    work, lost = push_lanes(m, 0, casing, work, lost)
    work_of_both, lost_of_both = push_lanes(m, casing, mode_lanes(m), work, lost)
    if counted:
        work, lost = work_of_both, lost_of_both
    if m.quadratic != 0:
        work = follow_quadratic(m, work)
    store(m.block_energy, (0, 0), work)
    store(m.block_energy, (1, 0), lost)


@inlined
def _meet(m, place, lobes):
    """The forces on a blade after a step."""
    beyond = measure_gaps(m, place, lobes)
    if PUBLISHED:
        _correct(m, beyond, place)
    else:
        _press(m, beyond, place)
    if beyond and (PUBLISHED or m.follows != 0):
        measure_edge(m, place, lobes)


@inlined
def _correct(m, beyond, place):
    """Correct the prediction by forces on nodes that are beyond lining or casing, as published."""
    if m.lined != 0:
        # before the forces open the gaps
        follow_gaps(m, m.contact.gap, place)
    if not beyond:
        leave_casing(m)
        return
    for g in range(0, node_lanes(m), LANES):
        store(m.force, g, 0.0)
    if m.lined == 0 or press_lining(m, place):
        press_casing(m)
    else:
        leave_casing(m)
    set_friction_force(m)
    if sum_pushes(m):
        _push(m, True)


@inlined
def _press(m, beyond, place):
    """Find the forces at t_n, which the next step follows."""
    if beyond:
        m.follows = int(press_contact(m, place))
    else:
        release_contact(m)
        m.follows = 0
    if m.lined != 0:
        follow_gaps(m, m.contact.opened, place)


@inlined
def _end_block(addresses, blades, block, row):
    """Add up a block of steps, keep its samples and, unless `row` is -1, snapshots; whether all are within the limit."""
    within = True
    for b in range(blades):
        m = pointed_at(addresses[b])
        m.totals.work += 0.5 * sum_of_lanes(load(m.block_energy, (0, 0)))
        m.totals.loss += sum_of_lanes(load(m.block_energy, (1, 0)))
        m.totals.steps += m.steps_per_block
        within &= record(m, block, row)
    return within


@inlined
def _integrate(addresses, blades):
    """Do the blocks of steps asked for; returns how many were done, fewer when an output passed the limit or is NaN."""
    first = pointed_at(addresses[0])
    immediate = np.isinf(first.casing.rise)
    decay = 0.0 if immediate else np.exp(-first.casing.rise)
    steps_per_block = first.steps_per_block
    # any integer for numba: what it gives a plain 0 to is compiled for just that, too
    zero = int(np.int64(0))
    within = True
    done = segment = until = zero
    kept = first.call.kept
    first_block = first.call.first_step // steps_per_block
    place = first.call.first_step % first.steps_per_revolution
    while done < first.call.blocks and within:
        begins = done == until
        if begins:
            for b in range(blades):
                lasting = begin_segment(pointed_at(addresses[b]), segment)
            until += lasting
        start = first.call.first_step + done * steps_per_block
        remaining = 0.0 if immediate else np.exp(-first.casing.rise * (start + first.call.ahead))
        _begin_block(addresses, blades, first.call.done + done)
        if place == 0 or begins:
            _begin_part(addresses, blades, place, first.casing.amplitude * (1.0 - remaining))
        for position in range(place + 1, place + steps_per_block + 1):
            remaining *= decay
            here = position if position < first.steps_per_revolution else 0
            lobes = first.casing.amplitude * (1.0 - remaining)
            pushed = _fly(addresses, blades)
            if pushed:
                _share_pushes(addresses, blades)
            for b in range(blades):
                m = pointed_at(addresses[b])
                if not PUBLISHED and pushed:
                    _push(m, b == 0)
                if m.pairs > 0:
                    turn_step(m)
                _meet(m, here, lobes)
        # of the samples from the first snapshot's revolution on, every so many-th
        due = first_block + done + 1 - first.samples_before_snapshots
        taken = first.samples_per_snapshot > 0 and due > 0 and due % first.samples_per_snapshot == 0
        within = _end_block(addresses, blades, first.call.done + done, kept if taken else -1)
        kept += taken
        done += 1
        # counted on, not divided: a block may have two steps
        place += steps_per_block
        if place == first.steps_per_revolution:
            place = zero
        if done == until or not within:
            for b in range(blades):
                end_segment(pointed_at(addresses[b]), segment)
            segment += 1
    return done


def compile_integration(capacity: Capacity, kind: Kind) -> bytes:
    """Object code of `advance(records, count)`: a function of the records' addresses that returns the blocks of steps done."""
    records = types.CPointer(types.CPointer(numba.from_dtype(integration_record(capacity))))
    integrate = specialised(_integrate, kind.constants)
    # the loop itself, not a function around it: what a compiled function calls was optimised and emitted once already
    advance = numba.cfunc(types.int64(records, types.int64), **OPTIONS)(integrate.py_func)
    return object_code(advance.inspect_llvm(), advance.native_name, "advance")
