"""The largest penetration of the tip's edge in a step with contact forces, compiled: see time_integration.contact_operators.

The edge has some hundred nodes, as many times eight as the contact nodes. A few of them are looked at in each such step, and
all where these come near the largest penetration so far. Nodes are lanes.
"""

import numpy as np

from r37core.contact.laws import displaced_position, lobe_shape
from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import bits_of, inlined, integers_at, largest_of_lanes, load, numbers_at, spread, store

from .layout import EXACT_GAP, MERIDIONAL, NORMAL, PUBLISHED, TANGENTIAL
from .steps import list_pressed, mode_lanes, node_lanes

NEAR = 0.8
"""Share of the largest penetration beyond which all nodes are looked at."""

_displaced_position = inlined(displaced_position)
_lobe_shape = inlined(lobe_shape)


@inlined
def measure_edge(m, place, lobes):
    """Keep the largest penetration of the edge, if it is now, under contact forces."""
    e, largest = m.edge, m.totals.largest_penetration
    pressed = 0
    if e.groups > 0 and _near_the_casing(m):
        pressed = list_pressed(m)
    if pressed > 0:
        few = _penetration(m, 0, e.few, pressed, place, lobes)
        if few > NEAR * largest:
            m.totals.largest_penetration = max(largest, few, _penetration(m, e.few, e.groups, pressed, place, lobes))


@inlined
def _near_the_casing(m):
    """True where a contact node is so far into the lining that the edge may pass the casing; without a lining it is."""
    if m.lined != 0:
        near = 0
        for g in range(0, node_lanes(m), LANES):
            # what is left to the casing
            left = load(m.contact.gap, g) if PUBLISHED else load(m.contact.opened, g) + m.lining.thickness
            near |= bits_of(left < m.edge.near)
        return near != 0
    return True


@inlined
def _penetration(m, first, end, pressed, place, lobes):
    """Largest penetration (m) of the nodes of some groups of eight into the casing, negative where all are clear of it."""
    e = m.edge
    clearance, deepest = numbers_at(e.clearance), spread(-1.0)
    for group in range(first, end):
        normal = _displaced(m, group, NORMAL)
        if EXACT_GAP:
            _measure_exactly(m, group, normal, place, lobes)
        else:
            _take_shape(m, group, place)
            store(e.position, 0, normal + lobes * load(e.shape, 0))
        position = load(e.position, 0)
        if not PUBLISHED:
            position += _displaced_at_once(m, group, pressed)
        deepest = np.maximum(deepest, position - (load(clearance, group * LANES) + m.opening))
    return largest_of_lanes(deepest)


@inlined
def _displaced(m, group, direction):
    """Displacement of eight nodes in a direction, by all modes."""
    e, modes = m.edge, mode_lanes(m)
    return _along(numbers_at(e.rows), (direction * e.groups + group) * modes * LANES, m.u, modes)


@inlined
def _along(rows, at, modal, modes):
    """Sum over the modes of rows of eight nodes, which begin at a place, times the modal numbers."""
    a = b = c = d = spread(0.0)
    for i in range(0, modes, 4):
        a += load(rows, at + i * LANES) * modal[i]
        b += load(rows, at + (i + 1) * LANES) * modal[i + 1]
        c += load(rows, at + (i + 2) * LANES) * modal[i + 2]
        d += load(rows, at + (i + 3) * LANES) * modal[i + 3]
    return (a + b) + (c + d)


@inlined
def _displaced_at_once(m, group, pressed):
    """Normal displacement of eight nodes that follows the contact forces at once."""
    nodes, flexibility = node_lanes(m), numbers_at(m.edge.flexibility)
    total, first = spread(0.0), group * 3 * nodes * LANES
    for j in range(pressed):
        k = m.contact.pressed[j]
        total += load(flexibility, first + k * LANES) * m.force[k]
        total += load(flexibility, first + (nodes + k) * LANES) * m.friction_force[0, k]
        total += load(flexibility, first + (2 * nodes + k) * LANES) * m.friction_force[1, k]
    return total


@inlined
def _take_shape(m, group, place):
    """Shape of the casing at eight nodes: a cubic through its values at the four steps round each node's angle."""
    e = m.edge
    table, steps, shares = numbers_at(e.table), integers_at(e.steps), numbers_at(e.shares)
    for lane in range(LANES):
        node = group * LANES + lane
        step = place + steps[node]
        shape = shares[4 * node] * table[step] + shares[4 * node + 1] * table[step + 1]
        e.shape[lane] = shape + shares[4 * node + 2] * table[step + 2] + shares[4 * node + 3] * table[step + 3]


@inlined
def _measure_exactly(m, group, normal, place, lobes):
    """Positions of eight displaced nodes along the casing's normal, with the lobes where they are: contact.casing."""
    e, casing = m.edge, m.casing
    radius, theta = numbers_at(e.radius), numbers_at(e.theta)
    turned = place * (2.0 * np.pi / m.steps_per_revolution)
    store(e.position, 0, normal)
    store(e.shape, 0, _displaced(m, group, TANGENTIAL))
    store(e.meridional, 0, _displaced(m, group, MERIDIONAL))
    for lane in range(LANES):
        node = group * LANES + lane
        position, shift = _displaced_position(
            e.position[lane], e.shape[lane], e.meridional[lane], radius[node], casing.cosine, casing.sine
        )
        shape = _lobe_shape(theta[node] - turned + shift, casing.period, casing.width)
        e.position[lane] = position + lobes * shape
