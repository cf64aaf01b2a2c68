"""The steps of the compiled engine in the order of docs/simulation.md, a function for each thing that happens in one.

Recursion (section 5 of the benchmark, diagonal in the modes of one speed): u* = a u_n + b u_{n-1}; where a tip node passes the
lining or the casing, u_{n+1} = u* + c F. It is carried in displacement u and increment d = u_n - u_{n-1}, which is the same
recursion without its loss of digits: d* = keep d - pull u, u* = u + d*, with keep = -b, pull = 1 - a - b, inverse = c.

`m` is a record of layout; tip nodes are lanes (r37core.machine_code.lanes), sets of nodes are bits, eight nodes to an
integer. Names in capitals that choose are those of layout.Kind, constants of each program.
"""

import numpy as np

from r37core.contact.laws import displaced_position, friction_direction, line_of_wear, lobe_shape, return_mapping
from r37core.contact.node_forces import set_laws, settle_forces
from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import (
    bits_of,
    first_bit,
    flag_at,
    flags_of,
    inlined,
    lanes_used,
    largest_of_lanes,
    load,
    numbers_at,
    spread,
    store,
    sum_of_lanes,
    sums_of_lanes,
)

from .layout import EXACT_GAP, MERIDIONAL, NORMAL, PUBLISHED, TANGENTIAL

_friction_direction = inlined(friction_direction)
_return_mapping = inlined(return_mapping)
_displaced_position = inlined(displaced_position)
_lobe_shape = inlined(lobe_shape)
_line_of_wear = inlined(line_of_wear)


# Numbers of a record


@inlined
def mode_lanes(m):
    """Number of lanes that the modes fill."""
    return m.mode_lanes


@inlined
def node_lanes(m):
    """Number of lanes that the nodes fill; of a single vector the compiler knows it."""
    return lanes_used(m.contact.gap, m.contact.lanes)


@inlined
def first_of_casing(m):
    """The lane of the first mode of the casing."""
    return mode_lanes(m) - 2 * m.pairs


@inlined
def nodes_from(m, g):
    """Bits of those of the eight lanes from g on that are nodes."""
    return (1 << min(m.nodes - g, LANES)) - 1


@inlined
def along(rows, direction, modal, g, used):
    """Displacement in a direction of the eight nodes from g on, by the first `used` modes; `rows`: displacement_operator."""
    s = t = u = v = w = x = y = z = spread(0.0)
    for i in range(0, used, LANES):
        amplitude = load(modal, i)
        s += load(rows, (direction, g, i)) * amplitude
        t += load(rows, (direction, g + 1, i)) * amplitude
        u += load(rows, (direction, g + 2, i)) * amplitude
        v += load(rows, (direction, g + 3, i)) * amplitude
        w += load(rows, (direction, g + 4, i)) * amplitude
        x += load(rows, (direction, g + 5, i)) * amplitude
        y += load(rows, (direction, g + 6, i)) * amplitude
        z += load(rows, (direction, g + 7, i)) * amplitude
    return sums_of_lanes((s, t, u, v, w, x, y, z))


@inlined
def displaced(m, direction, g):
    """Displacement of the eight nodes from g on, by all modes."""
    return along(m.displacement_operator, direction, m.u, g, mode_lanes(m))


# Time integration


@inlined
def predict(m):
    """The free step of every mode, and the energy it loses."""
    lost = load(m.block_energy, (1, 0))
    for i in range(0, mode_lanes(m), LANES):
        u, last, keep, pull = load(m.u, i), load(m.increment, i), load(m.speed.keep, i), load(m.speed.pull, i)
        d = keep * last - pull * u
        store(m.last_increment, i, last)
        store(m.increment, i, d)
        store(m.u, i, u + d)
        lost += load(m.speed.loss, i) * ((d + last) * (d + last))
    store(m.block_energy, (1, 0), lost)


@inlined
def sum_pushes(m):
    """Put into the pushes what the forces on all pressed nodes are to the modes; returns whether any node is pressed."""
    pressed, count = m.contact.pressed, list_pressed(m)
    if count == 0:
        return False
    m.totals.steps_in_contact += 1.0
    largest = m.totals.largest_force
    for j in range(count):
        largest = max(largest, -m.force[pressed[j]])
    m.totals.largest_force = largest
    if count % 2 != 0:
        add_pushes(m, pressed[0], pressed[0], False)
    for j in range(count % 2, count, 2):
        add_pushes(m, pressed[j], pressed[j + 1], True)
    return True


@inlined
def add_pushes(m, first, second, both):
    """Add what the forces of two nodes, or of the first alone, are to all modes.

    Two at once, because a sum that is kept in memory waits for its last store.
    """
    # loaded once: a store may change them, for all that the compiler knows
    first_force = m.force[first], m.friction_force[0, first], m.friction_force[1, first]
    second_force = m.force[second], m.friction_force[0, second], m.friction_force[1, second]
    for i in range(0, mode_lanes(m), LANES):
        push = pushed(m.displacement_operator, first, i, first_force, load(m.push, i))
        if both:
            push = pushed(m.displacement_operator, second, i, second_force, push)
        store(m.push, i, push)


@inlined
def pushed(rows, k, i, force, push):
    """`push` on the eight modes from i on and what a node's `force`, normal, tangential and meridional, adds to it."""
    normal, tangential, meridional = force
    push += load(rows, (NORMAL, k, i)) * normal
    push += load(rows, (TANGENTIAL, k, i)) * tangential
    push += load(rows, (MERIDIONAL, k, i)) * meridional
    return push


@inlined
def push_lanes(m, first, end, work, lost):
    """Push the modes from the `first` lane to the `end`; adds the work, doubled, and the energy lost."""
    for i in range(first, end, LANES):
        work, lost = push_modes(m, i, load(m.push, i), work, lost)
        # the sums of the next step begin so
        store(m.push, i, 0.0)
    return work, lost


@inlined
def push_modes(m, i, push, work, lost):
    """Add a push to the eight modes from i on; adds its work, doubled, and loss."""
    free = load(m.increment, i) + load(m.last_increment, i)
    pushed = load(m.speed.inverse, i) * push
    store(m.increment, i, load(m.increment, i) + pushed)
    store(m.u, i, load(m.u, i) + pushed)
    return work + push * (free + pushed), lost + load(m.speed.loss, i) * (pushed * (free + free + pushed))


@inlined
def turn_step(m):
    """Write the pairs of the casing's modes in the rotor's frame after a step, which has turned on."""
    _turn(m, m.u)
    _turn(m, m.increment)
    _turn(m, m.last_increment)


@inlined
def _turn(m, amplitudes):
    pairs, first = m.pairs, first_of_casing(m)
    for j in range(0, pairs, LANES):
        cosine, sine = load(m.turn_cosine, j), load(m.turn_sine, j)
        c, s = load(amplitudes, first + j), load(amplitudes, first + pairs + j)
        store(amplitudes, first + j, cosine * c - sine * s)
        store(amplitudes, first + pairs + j, sine * c + cosine * s)


# Gap


@inlined
def _measure_exact_gaps(m, place, lobes):
    """Gaps between the displaced nodes and the lobed cone: see r37core.contact.casing. Whether any is passed."""
    turned = place * (2.0 * np.pi / m.steps_per_revolution)
    c, casing, any_beyond = m.contact, m.casing, False
    for g in range(0, node_lanes(m), LANES):
        # room that is free before contact
        store(c.pressure, g, displaced(m, NORMAL, g))
        store(c.slope, g, displaced(m, TANGENTIAL, g))
        store(c.intercept, g, displaced(m, MERIDIONAL, g))
    for k in range(m.nodes):
        position, m.shift[k] = _displaced_position(
            c.pressure[k], c.slope[k], c.intercept[k], m.radius[k], casing.cosine, casing.sine
        )
        shape = _lobe_shape(m.theta[k] - turned + m.shift[k], casing.period, casing.width)
        c.gap[k] = m.speed.clearance[k] + m.opening - lobes * shape - position
        any_beyond |= c.gap[k] < 0.0
    return any_beyond


@inlined
def measure_gaps(m, place, lobes):
    """Linear gaps: clearance, less the lobes at the undeformed angle, less the normal displacement. Whether any is passed."""
    if EXACT_GAP:
        return _measure_exact_gaps(m, place, lobes)
    shape = numbers_at(m.call.casing_shape)
    any_beyond = 0
    for g in range(0, node_lanes(m), LANES):
        normal = displaced(m, NORMAL, g)
        gap = load(m.speed.clearance, g) + m.opening - lobes * load(shape, place * node_lanes(m) + g) - normal
        store(m.contact.gap, g, gap)
        any_beyond |= bits_of(gap < 0.0)
    return any_beyond != 0


# Friction


@inlined
def set_friction_of_listed(m, listed, count):
    """Vector friction on `listed` nodes.

    With forces at t_n it is against the sliding then, extrapolated from the last two increments, else in the last step.
    """
    for g in range(0, node_lanes(m), LANES):
        tangential = meridional = spread(0.0)
        for j in range(count):
            k = listed[j]
            if g <= k < g + LANES:
                t = r = spread(0.0)
                for i in range(0, mode_lanes(m), LANES):
                    last = load(m.last_increment, i)
                    if not PUBLISHED:
                        last = 0.5 * (3.0 * load(m.increment, i) - last)
                    t += load(m.displacement_operator, (TANGENTIAL, k, i)) * last
                    r += load(m.displacement_operator, (MERIDIONAL, k, i)) * last
                # put into lanes here: loading together what was stored one by one stalls the processor
                tangential = np.where(flag_at(k - g), sum_of_lanes(t), tangential)
                meridional = np.where(flag_at(k - g), sum_of_lanes(r), meridional)
        tangential += load(m.sliding, (0, g))
        # a normal force is negative
        along_tangent, along_meridian = _friction_direction(tangential, meridional, -m.friction)
        store(m.sliding, (1, g), np.sqrt(tangential * tangential + meridional * meridional))
        store(m.friction_share, (0, g), along_tangent)
        store(m.friction_share, (1, g), along_meridian)


@inlined
def friction_response(m, table, k, g):
    """Effect of a unit normal force on a node on the nodes from g on, with the vector friction that comes with it.

    `table`: what forces along the normal, the tangent and the meridian do.
    """
    response = load(table, (NORMAL, k, g)) + load(table, (TANGENTIAL, k, g)) * m.friction_share[0, k]
    return response + load(table, (MERIDIONAL, k, g)) * m.friction_share[1, k]


@inlined
def set_friction_force(m):
    """Friction of the forces on all nodes, and its work against their sliding in this step."""
    for g in range(0, node_lanes(m), LANES):
        normal = load(m.force, g)
        store(m.friction_force, (0, g), normal * load(m.friction_share, (0, g)))
        store(m.friction_force, (1, g), normal * load(m.friction_share, (1, g)))
        m.totals.friction_heat -= m.friction * sum_of_lanes(normal * load(m.sliding, (1, g)))


@inlined
def list_lanes(bits, g, listed, count):
    """List after `count` others the nodes from g on whose bits are set; returns how many there are."""
    while bits:
        listed[count] = g + first_bit(bits)
        count += 1
        bits &= bits - 1
    return count


@inlined
def list_pressed(m):
    """List the nodes that a force presses; returns how many."""
    count = int(np.int64(0))
    for g in range(0, node_lanes(m), LANES):
        count = list_lanes(bits_of(load(m.force, g) < 0.0), g, m.contact.pressed, count)
    return count


@inlined
def largest_gap(m):
    """Size (m) of the largest gap."""
    largest = 0.0
    for g in range(0, node_lanes(m), LANES):
        # of the lanes of nodes; NaN does not count
        size = np.where(flags_of(nodes_from(m, g)), np.abs(load(m.contact.gap, g)), 0.0)
        largest = max(largest, largest_of_lanes(np.where(size > 0.0, size, 0.0)))
    return largest


# Direct contact


@inlined
def press_casing(m):
    """Add the forces of direct contact, keep the set of touching nodes."""
    c = m.contact
    for g in range(0, node_lanes(m), LANES):
        c.found[g // LANES] = nodes_from(m, g)
        store(c.pressure, g, 0.0)
    # the others' reaction may bring any of them to the casing
    for k in range(m.nodes):
        c.listed[k] = k
    if m.follows_sliding != 0:
        set_friction_of_listed(m, c.listed, m.nodes)
    for k in range(m.nodes):
        set_column(m, m.speed.coupling, k)
    set_laws(c, m.nodes, m.lining, False)
    violation = settle_forces(c, m.nodes, largest_gap(m), 0.0, False)
    m.totals.worst_complementarity = max(m.totals.worst_complementarity, violation)
    for g in range(0, node_lanes(m), LANES):
        pressure = load(c.pressure, g)
        store(m.force, g, load(m.force, g) - pressure)
        touch(m, g, bits_of(pressure > 0.0))


@inlined
def set_column(m, table, k):
    """Opening of the gaps by a normal force on a node with its friction; `table`: see friction_response."""
    for g in range(0, node_lanes(m), LANES):
        store(m.contact.columns, (k, g), friction_response(m, table, k, g))


@inlined
def touch(m, g, touching):
    """Keep which of the nodes from g on are `touching` the casing, and count those that were not."""
    onsets = touching & ~m.touched[g // LANES]
    m.touched[g // LANES] = touching
    while onsets:
        m.totals.casing_hits += 1.0
        onsets &= onsets - 1


@inlined
def leave_casing(m):
    """Note that no node touches the casing."""
    for g in range(node_lanes(m) // LANES):
        m.touched[g] = 0


# Lining


@inlined
def press_lining(m, place):
    """Normal forces of the bars that the nodes press, which wear them; whether a node reaches the casing behind the lining."""
    c, lining, wear = m.contact, m.lining, numbers_at(m.call.wear)
    count = int(np.int64(0))
    for g in range(0, node_lanes(m), LANES):
        count = list_lanes(bits_of(load(c.gap, g) < 0.0), g, c.listed, count)
    if m.follows_sliding != 0:
        set_friction_of_listed(m, c.listed, count)
    for j in range(count):
        k = c.listed[j]
        bar = bar_at(m, k, place)
        stress, new = _return_mapping(-c.gap[k], wear[bar], lining.elastic_modulus, lining)
        wear_bar(m, k, bar, new)
        m.force[k] = -stress * c.area[k]
    any_closed = 0
    for g in range(0, node_lanes(m), LANES):
        gap = load(c.gap, g) + lining.thickness
        for j in range(count):
            k = c.listed[j]
            gap -= friction_response(m, m.speed.coupling, k, g) * m.force[k]
        store(c.gap, g, gap)
        any_closed |= bits_of(gap < 0.0)
    return any_closed != 0


@inlined
def turned_bars(m, place):
    """Bars by which the rotor has turned at a step of a revolution."""
    return place * m.lining.bars / m.steps_per_revolution


@inlined
def bar_position(m, k, turned):
    """The angle that a node is at, in bars, when the rotor has turned by so many."""
    position = m.bar_position[k] - turned
    if EXACT_GAP:
        position += m.shift[k] * (m.lining.bars / (2.0 * np.pi))
    return position


@inlined
def bar_number(m, k, position):
    """The number of the bar of a node's ring at an angle in bars, counted over all rings."""
    bars = int(m.lining.bars)
    return int(np.floor(position)) % bars + k * bars


@inlined
def bar_at(m, k, place):
    """The number of the bar that a node is at, counted over all rings."""
    return bar_number(m, k, bar_position(m, k, turned_bars(m, place)))


@inlined
def wear_bar(m, k, bar, new):
    """Wear a bar of a node's ring to a new depth (m), if that is more than it has."""
    wear = numbers_at(m.call.wear)
    if new > wear[bar]:
        m.worn += (new - wear[bar]) * m.bar_surface[k]
        m.largest_wear = max(m.largest_wear, new)
        wear[bar] = new


@inlined
def follow_gaps(m, gaps, place):
    """Take the gaps (m) to the unworn lining at a step's end, and wear the bars that nodes have passed while pressing them."""
    for g in range(0, node_lanes(m), LANES):
        passing = bits_of(load(gaps, g) < 0.0) | bits_of(load(m.penetration, g) > 0.0)
        if passing != 0:
            wear_passed_rings(m, g, passing, gaps, place)
    take_gaps(m, gaps, place)


@inlined
def wear_passed_rings(m, g, passing, gaps, place):
    """Wear the bars that the `passing` ones of the eight nodes from g on have passed in a step, with `gaps` (m) at its end."""
    turned = turned_bars(m, place)
    turned_before = turned_bars(m, (place if place > 0 else m.steps_per_revolution) - 1)
    line = _line_of_wear(m.lining)
    while passing:
        k = g + first_bit(passing)
        passing &= passing - 1
        wear_passed_bars(m, k, -gaps[k], turned, turned_before, line)


@inlined
def wear_passed_bars(m, k, penetration, turned, turned_before, line):
    """Wear the bars that a node has passed between the last step's bar and this one's.

    They are worn as its `penetration` (m) says, linear between that at t_n and the one given, at t_{n+1}. `turned`,
    `turned_before`: bars by which the rotor has turned then, less where it begins a revolution; `line`: of the wear.
    """
    position, bars = bar_position(m, k, turned), int(m.lining.bars)
    # the begin of a revolution is one round further
    turn = bars if turned < turned_before else 0
    last = m.last_position[k] if EXACT_GAP else bar_position(m, k, turned_before)
    first, end = int(np.floor(position)) + 1, int(np.floor(last)) + turn
    if first >= end:
        return
    per_bar = (m.penetration[k] - penetration) / (last + turn - position)
    depth, bar, left = penetration + per_bar * (first + 0.5 - position), bar_number(m, k, first + 0.5), end - first
    # up to the end of the ring, and from its begin on
    while left > 0:
        count = min(left, (k + 1) * bars - bar)
        wear_along(m, k, bar, count, depth, per_bar, line)
        depth += per_bar * count
        left -= count
        bar = k * bars


@inlined
def wear_along(m, k, bar, count, depth, per_bar, line):
    """Wear so many bars of a node's ring as they are pressed to a depth (m) that changes from bar to bar."""
    # loaded once: a store may change them, for all that the compiler knows
    thickness, wear = m.lining.thickness, numbers_at(m.call.wear)
    slope, offset = line
    grows = 0
    # most passes wear nothing, and finding that takes little
    for i in range(count):
        grows |= int(slope * min(depth + per_bar * i, thickness) + offset > wear[bar + i])
    if grows == 0:
        return
    largest, worn_off = m.largest_wear, 0.0
    for i in range(count):
        new, before = slope * min(depth + per_bar * i, thickness) + offset, wear[bar + i]
        if new > before:
            worn_off += new - before
            largest = max(largest, new)
            wear[bar + i] = new
    m.worn += worn_off * m.bar_surface[k]
    m.largest_wear = largest


@inlined
def take_gaps(m, gaps, place):
    """Take the gaps (m) to the unworn lining as those at t_n."""
    for g in range(0, node_lanes(m), LANES):
        store(m.penetration, g, -load(gaps, g))
    if EXACT_GAP:
        for k in range(m.nodes):
            m.last_position[k] = bar_position(m, k, turned_bars(m, place))


# Record


@inlined
def record(m, block, row):
    """Samples and, unless `row` is -1, a snapshot at the end of a block; returns whether the outputs are within the limit."""
    samples, snapshots = numbers_at(m.call.samples), numbers_at(m.call.snapshots)
    outputs, modes, nodes = m.number_of_outputs, mode_lanes(m), node_lanes(m)
    if not PUBLISHED:
        for g in range(0, nodes, LANES):
            store(m.static_force, g, load(m.force, g))
            store(m.static_force, nodes + g, load(m.friction_force, (0, g)))
            store(m.static_force, 2 * nodes + g, load(m.friction_force, (1, g)))
    beyond = 0
    for g in range(0, outputs, LANES):
        total = along(m.outputs, 0, m.u, g, modes)
        if not PUBLISHED and m.follows != 0:
            # the static modes follow the forces
            total += along(m.force_outputs, 0, m.static_force, g, 3 * nodes)
        store(m.sample, g, total)
        # written so that NaN fails as well
        beyond |= ~bits_of(np.abs(total) < m.limit) & ((1 << LANES) - 1)
    for o in range(outputs):
        samples[block * outputs + o] = m.sample[o]
    if row >= 0:
        width = modes + (0 if PUBLISHED else 3 * nodes)
        for i in range(modes):
            snapshots[row * width + i] = m.u[i]
        for k in range(width - modes):
            snapshots[row * width + modes + k] = m.static_force[k]
    return beyond == 0
