"""A step of exact_modal in contact, compiled: the contact forces at t_n are a static law of the displacement at t_n.

u_{n+1} = a u_n + b u_{n-1} + c F_n, F_n from the gaps at u_n: the leapfrog of Stoermer and Verlet for modes between forces
(Hairer, Lubich and Wanner, Geometric Numerical Integration, sections I.1.4 and XIII.2). The modes that are not stepped follow
the forces at once by their residual flexibility, so that forces and gaps at t_n are one small problem of all nodes
(r37core.contact.node_forces): bars, the casing behind them, or the bare casing, with friction against the sliding at t_n. It is
the massless boundary of Monjaraz-Tec, Gross and Krack, Computers & Structures 260 (2022), with exact modal steps.
"""

import numpy as np

from r37core.contact.node_forces import set_laws, settle_forces, wear_bars
from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import bits_of, first_bit, flags_of, inlined, load, numbers_at, store

from .steps import (
    bar_at,
    largest_gap,
    leave_casing,
    node_lanes,
    set_column,
    set_friction_force,
    set_friction_of_listed,
    touch,
    wear_bar,
)


@inlined
def press_contact(m, place):
    """The contact forces at u_n from the gaps there, and the wear; returns whether there are any."""
    c, thickness = m.contact, m.lining.thickness
    largest, violation = largest_gap(m), 0.0
    for g in range(0, node_lanes(m), LANES):
        store(c.opened, g, load(c.gap, g))
        c.found[g // LANES] = 0
    count = int(np.int64(0))
    while True:
        joined = list_beyond(m, count, place)
        if joined == count:
            break
        if m.follows_sliding != 0:
            set_friction_of_listed(m, c.listed, joined)
        for j in range(count, joined):
            set_column(m, m.flexibility, c.listed[j])
        for g in range(0, node_lanes(m), LANES):
            # from the forces a step ago
            store(c.pressure, g, np.where(flags_of(c.found[g // LANES]), -load(m.force, g), 0.0))
        count = joined
        set_laws(c, count, m.lining, m.lined)
        violation = settle_forces(c, count, largest, thickness, m.lined)
    if count == 0:
        release_contact(m)
        return False
    m.totals.worst_complementarity = max(m.totals.worst_complementarity, violation)
    return keep_forces(m, count)


@inlined
def release_contact(m):
    """Release all nodes."""
    leave_casing(m)
    for g in range(0, node_lanes(m), LANES):
        store(m.contact.opened, g, load(m.contact.gap, g))
        store(m.force, g, 0.0)
        store(m.friction_force, (0, g), 0.0)
        store(m.friction_force, (1, g), 0.0)


@inlined
def list_beyond(m, count, place):
    """List more nodes that pass the casing, or what is left of their bar, after `count` of them; returns how many there are."""
    c = m.contact
    for g in range(0, node_lanes(m), LANES):
        bits = bits_of(load(c.opened, g) < 0.0) & ~c.found[g // LANES]
        while bits:
            bit = bits & -bits
            bits &= bits - 1
            k = g + first_bit(bit)
            if m.lined != 0:
                c.bar[k] = bar_at(m, k, place)
                c.wear[k] = numbers_at(m.call.wear)[c.bar[k]]
                # it may be clear of what is left of its bar
                if not c.opened[k] + c.wear[k] < 0.0:
                    continue
            c.found[g // LANES] |= bit
            c.listed[count] = k
            count += 1
    return count


@inlined
def keep_forces(m, count):
    """Make the normal forces found those on the nodes, with their friction, and wear the bars; whether there are any."""
    c = m.contact
    any_pressed = 0
    for g in range(0, node_lanes(m), LANES):
        normal = -load(c.pressure, g)
        store(m.force, g, normal)
        pressed = bits_of(normal < 0.0)
        any_pressed |= pressed
        touch(m, g, wear_bars(c, g, m.lining) if m.lined != 0 else pressed)
    if m.lined != 0:
        for j in range(count):
            k = c.listed[j]
            wear_bar(m, k, c.bar[k], c.wear[k])
    set_friction_force(m)
    return any_pressed != 0
