"""The steps of the compiled engine, one function for each thing that happens in a step. Compiled for what a scene has.

Recursion (section 5 of the benchmark, diagonal in the modes of one speed): u* = a u_n + b u_{n-1}; where a tip node passes the
lining or the casing, u_{n+1} = u* + c F. It is carried in displacement u and increment d = u_n - u_{n-1}, which is the same
recursion without its loss of digits: d* = keep d - pull u, u* = u + d*, with keep = -b, pull = 1 - a - b, inverse = c.
With Coriolis u is the real part of a complex amplitude, whose increment moves the nodes, too: time_integration.gyroscopic.

`m` is a record of layout; tip nodes are lanes (r37core.lanes), sets of nodes are bits, eight nodes to an
integer. Arguments that choose (`kind`, `energy`, ...) are constants where the time integration is compiled.
"""

from __future__ import annotations

import numpy as np

from r37core.alignment import LANES
from r37core.contact.complementarity import list_nodes, solve_complementarity
from r37core.contact.laws import displaced_position, friction_direction, lobe_shape, return_mapping
from r37core.lanes import bits_of, flag_at, inlined, load, numbers_at, spread, store, sum_of_lanes, sums_of_lanes

from .layout import MERIDIONAL, NORMAL, TANGENTIAL

_friction_direction = inlined(friction_direction)
_return_mapping = inlined(return_mapping)
_displaced_position = inlined(displaced_position)
_lobe_shape = inlined(lobe_shape)


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
    return sums_of_lanes(s, t, u, v, w, x, y, z)


@inlined
def displaced(m, direction, g, coriolis):
    """Displacement of the eight nodes from g on, by all modes."""
    total = along(m.displacement_operator, direction, m.u, g, len(m.u))
    if coriolis:
        total += along(m.increment_operator, direction, m.increment, g, len(m.u))
    return total


@inlined
def second_difference(m, i):
    """Increment of the increments of the eight modes from i on: d_n - d_{n-1} of the free motion through u_n, d_n."""
    u, d, keep = load(m.u, i), load(m.increment, i), load(m.keep, i)
    return ((keep - 1.0) * d - load(m.pull, i) * (u - d)) * load(m.inverse_keep, i)


@inlined
def predict(m, energy, lost, coriolis):
    """The free step of every mode; returns `lost` and the energy it loses, in lanes."""
    for i in range(0, len(m.u), LANES):
        if coriolis:
            store(m.last_second_difference, i, second_difference(m, i))
        u, last = load(m.u, i), load(m.increment, i)
        d = load(m.keep, i) * last - load(m.pull, i) * u
        store(m.last_increment, i, last)
        store(m.increment, i, d)
        store(m.u, i, u + d)
        if energy and coriolis:
            keep, pull = load(m.keep, i), load(m.pull, i)
            lost += load(m.loss, i) * (pull * u * (u - last) + ((1.0 - keep) * u + keep * last) * last)
        elif energy:
            lost += load(m.loss, i) * (d + last) * (d + last)
    return lost


@inlined
def measure_gaps(m, place, lobes, coriolis):
    """Linear gaps: clearance, less the lobes at the undeformed angle, less the normal displacement. Whether any is passed."""
    shape = numbers_at(m.casing_shape)
    any_beyond = 0
    for g in range(0, len(m.force), LANES):
        normal = displaced(m, NORMAL, g, coriolis)
        gap = load(m.clearance, g) - lobes * load(shape, place * len(m.force) + g) - normal
        store(m.problem.gap, g, gap)
        beyond = bits_of(gap < 0.0)
        m.beyond[g // LANES] = beyond
        any_beyond |= beyond
    return any_beyond != 0


@inlined
def measure_exact_gaps(m, place, lobes, coriolis):
    """Gaps between the displaced nodes and the lobed cone: see r37core.contact.casing. Whether any is passed."""
    turned = place * (2.0 * np.pi / m.steps_per_revolution)
    any_beyond = False
    for g in range(0, len(m.force), LANES):
        # room that is free before contact
        store(m.problem.multiplier, g, displaced(m, NORMAL, g, coriolis))
        store(m.problem.answer, g, displaced(m, TANGENTIAL, g, coriolis))
        store(m.problem.short, g, displaced(m, MERIDIONAL, g, coriolis))
        m.beyond[g // LANES] = 0
    for k in range(m.nodes):
        p, casing = m.problem, m.casing
        position, m.shift[k] = _displaced_position(
            p.multiplier[k], p.answer[k], p.short[k], m.radius[k], casing.cosine, casing.sine
        )
        shape = _lobe_shape(m.theta[k] - turned + m.shift[k], casing.period, casing.width)
        p.gap[k] = m.clearance[k] - lobes * shape - position
        if p.gap[k] < 0.0:
            m.beyond[k // LANES] |= 1 << (k % LANES)
            any_beyond = True
    return any_beyond


@inlined
def set_friction(m, g, tangential, meridional):
    """Vector friction per normal force on the nodes from g on, against their sliding in the last step (m)."""
    along_tangent, along_meridian = _friction_direction(load(m.rotation, g) + tangential, meridional)
    store(m.friction_share, (0, g), along_tangent * (0.0 - m.friction))
    store(m.friction_share, (1, g), along_meridian * (0.0 - m.friction))


@inlined
def set_friction_of_listed(m, listed, count, centred, coriolis):
    """Vector friction on `listed` nodes: more costly for each than `set_friction_of_all`, but they are few.

    `centred`: against the sliding at t_n, extrapolated from the last two increments, else in the last step.
    """
    for g in range(0, len(m.force), LANES):
        tangential = meridional = spread(0.0)
        for j in range(count):
            k = listed[j]
            if g <= k < g + LANES:
                t = r = spread(0.0)
                for i in range(0, len(m.u), LANES):
                    last = load(m.last_increment, i)
                    if centred:
                        last = 1.5 * load(m.increment, i) - 0.5 * last
                    t += load(m.displacement_operator, (TANGENTIAL, k, i)) * last
                    r += load(m.displacement_operator, (MERIDIONAL, k, i)) * last
                    if coriolis:
                        last = load(m.last_second_difference, i)
                        if centred:
                            last = 1.5 * second_difference(m, i) - 0.5 * last
                        t += load(m.increment_operator, (TANGENTIAL, k, i)) * last
                        r += load(m.increment_operator, (MERIDIONAL, k, i)) * last
                # put into lanes here: loading together what was stored one by one stalls the processor
                tangential = np.where(flag_at(k - g), sum_of_lanes(t), tangential)
                meridional = np.where(flag_at(k - g), sum_of_lanes(r), meridional)
        set_friction(m, g, tangential, meridional)


@inlined
def set_friction_of_all(m):
    """Vector friction on all nodes, and the gaps' response with it."""
    for g in range(0, len(m.force), LANES):
        tangential = along(m.displacement_operator, TANGENTIAL, m.last_increment, g, len(m.u))
        meridional = along(m.displacement_operator, MERIDIONAL, m.last_increment, g, len(m.u))
        set_friction(m, g, tangential, meridional)
    for k in range(m.nodes):
        for g in range(0, len(m.force), LANES):
            store(m.response, (k, g), response_with_friction(m, k, g))


@inlined
def response_with_friction(m, k, g):
    """Opening of gaps per unit multiplier of a node, with the vector friction that comes with it."""
    response = load(m.coupling, (NORMAL, k, g)) + load(m.coupling, (TANGENTIAL, k, g)) * m.friction_share[0, k]
    return response + load(m.coupling, (MERIDIONAL, k, g)) * m.friction_share[1, k]


@inlined
def bar_at(m, k, place, exact_gap):
    """The number of the bar that a node is at, counted over all rings."""
    bars = int(m.lining.bars)
    position = m.bar_position[k] - place * m.lining.bars / m.steps_per_revolution
    if exact_gap:
        position += m.shift[k] * (m.lining.bars / (2.0 * np.pi))
    bar = int(np.floor(position))
    while bar < 0:
        bar += bars
    if exact_gap:
        while bar >= bars:
            bar -= bars
    if m.rings > 1:
        bar += k * bars
    return bar


@inlined
def press_bars(m, place, kind):
    """Normal forces of the bars that the nodes press; wears them. Returns how many nodes are listed as pressing."""
    p, lining, wear = m.problem, m.lining, numbers_at(m.wear)
    count = list_nodes(m.beyond, p.listed)
    if kind.vector_friction:
        set_friction_of_listed(m, p.listed, count, False, False)
    for j in range(count):
        k = p.listed[j]
        bar = bar_at(m, k, place, kind.exact_gap)
        stress, wear[bar] = _return_mapping(-p.gap[k], wear[bar], lining.elastic_modulus, lining)
        m.force[k] = -stress * lining.area
    return count


@inlined
def press_lining(m, place, kind):
    """Normal forces of the lining; how many nodes are listed as pressing, and whether one reaches the casing behind it."""
    p, lining = m.problem, m.lining
    count = press_bars(m, place, kind)
    any_closed = 0
    for g in range(0, len(m.force), LANES):
        gap = load(p.gap, g) + lining.thickness
        for j in range(count):
            k = p.listed[j]
            if kind.vector_friction:
                gap -= response_with_friction(m, k, g) * m.force[k]
            else:
                gap -= load(m.response, (k, g)) * m.force[k]
        store(p.gap, g, gap)
        any_closed |= bits_of(gap < 0.0)
    return count, any_closed != 0


@inlined
def press_casing(m, kind):
    """Add the Lagrange multipliers of direct contact, keep the set of touching nodes; returns how many are pressed."""
    p = m.problem
    if kind.vector_friction:
        # the others' reaction may bring any of them to the casing
        set_friction_of_all(m)
    guessed = 0
    for g in range(len(m.on_casing)):
        p.touching[g] = m.on_casing[g]
        guessed |= m.on_casing[g]
    if guessed == 0:
        for g in range(0, len(m.force), LANES):
            p.touching[g // LANES] = bits_of(load(p.gap, g) < 0.0)
    violation = solve_complementarity(p, m.response if kind.coupled else m.columns)
    m.totals.worst_complementarity = max(m.totals.worst_complementarity, violation)
    for g in range(0, len(m.force), LANES):
        multiplier = load(p.multiplier, g)
        store(m.force, g, load(m.force, g) - multiplier)
        touching = bits_of(multiplier > 0.0)
        p.wrong[g // LANES] = touching & ~m.on_casing[g // LANES]
        m.on_casing[g // LANES] = touching
    m.totals.casing_hits += list_nodes(p.wrong, p.listed)
    return list_pressed(m)


@inlined
def list_pressed(m):
    """List the nodes that a force presses; returns how many."""
    for g in range(0, len(m.force), LANES):
        m.problem.wrong[g // LANES] = bits_of(load(m.force, g) < 0.0)
    return list_nodes(m.problem.wrong, m.problem.listed)


@inlined
def clear_force(m):
    """No node is pressed."""
    for g in range(0, len(m.force), LANES):
        store(m.force, g, 0.0)


@inlined
def set_friction_force(m):
    """Friction of the forces on all nodes."""
    for g in range(0, len(m.force), LANES):
        normal = load(m.force, g)
        store(m.friction_force, (0, g), normal * load(m.friction_share, (0, g)))
        store(m.friction_force, (1, g), normal * load(m.friction_share, (1, g)))


@inlined
def force_on_modes(rows, constant_rows, k, i, force, vector):
    """What a node's `force`, normal, tangential and meridional, is to the eight modes from i on.

    `constant_rows` have friction of constant direction in them, for the normal force alone.
    """
    normal, tangential, meridional = force
    if vector:
        push = load(rows, (NORMAL, k, i)) * normal
        push += load(rows, (TANGENTIAL, k, i)) * tangential
        push += load(rows, (MERIDIONAL, k, i)) * meridional
    else:
        push = load(constant_rows, (k, i)) * normal
    return push


@inlined
def push_blade(m, count, kind, work, lost):
    """Correct displacement and increment for the listed nodes' forces; adds the work, doubled, and the energy lost.

    Returns also whether any presses.
    """
    pressed = False
    for i in range(0, len(m.u), LANES):
        store(m.push, i, 0.0)
        if kind.coriolis:
            store(m.increment_push, i, 0.0)
    for j in range(count):
        k = m.problem.listed[j]
        normal = m.force[k]
        if not normal < 0.0:
            continue
        pressed = True
        m.totals.largest_force = max(m.totals.largest_force, -normal)
        force = normal, m.friction_force[0, k], m.friction_force[1, k]
        for i in range(0, len(m.u), LANES):
            push = force_on_modes(m.displacement_operator, m.push_operator, k, i, force, kind.vector_friction)
            store(m.push, i, load(m.push, i) + push)
            if kind.coriolis:
                push = force_on_modes(m.increment_operator, m.increment_push_operator, k, i, force, kind.vector_friction)
                store(m.increment_push, i, load(m.increment_push, i) + push)
    if not pressed:
        return False, work, lost
    if kind.coriolis:
        work, lost = kick_complex_modes(m, kind.energy, work, lost)
        return True, work, lost
    for i in range(0, len(m.u), LANES):
        free, push = load(m.increment, i) + load(m.last_increment, i), load(m.push, i)
        pushed = load(m.inverse, i) * push
        store(m.increment, i, load(m.increment, i) + pushed)
        store(m.u, i, load(m.u, i) + pushed)
        work += push * (free + pushed)
        if kind.energy:
            lost += load(m.loss, i) * pushed * (free + free + pushed)
    return True, work, lost


@inlined
def kick_complex_modes(m, energy, work, lost):
    """What a kick as the step began adds to its end; adds its work, doubled, and loss. See gyroscopic.ComplexRecursion."""
    for i in range(0, len(m.u), LANES):
        keep, pull, inverse_keep, inverse = load(m.keep, i), load(m.pull, i), load(m.inverse_keep, i), load(m.inverse, i)
        push, increment_push, d = load(m.push, i), load(m.increment_push, i), load(m.increment, i)
        # twice the displacement mid-kick, its increment times keep, and q
        before = load(m.u, i) - d
        kicked = inverse * inverse_keep * increment_push
        displacement = before + before - kicked
        increment = 2.0 * (d + pull * before) + inverse * push
        sense = 0.5 * (1.0 - keep - pull)
        of_push = push * (increment + sense * displacement)
        of_push -= increment_push * (sense * inverse_keep * increment + pull * displacement)
        work += of_push
        if energy:
            lost += 0.5 * (1.0 - keep) * of_push
        pushed = inverse * push + pull * kicked
        store(m.increment, i, d + pushed)
        store(m.u, i, before + d + pushed - kicked)
    return work, lost


@inlined
def meet(m, place, kind, work, lost):
    """Everything that happens in a step in which nodes are beyond the lining or casing; adds work, doubled, and loss."""
    clear_force(m)
    count, closed = 0, True
    if kind.lined:
        count, closed = press_lining(m, place, kind)
    if closed:
        count = press_casing(m, kind)
    else:
        leave_casing(m)
    if kind.vector_friction:
        set_friction_force(m)
    pressed, work, lost = push_blade(m, count, kind, work, lost)
    m.totals.steps_in_contact += pressed
    return work, lost


@inlined
def leave_casing(m):
    """No node touches the casing."""
    for g in range(len(m.on_casing)):
        m.on_casing[g] = 0


@inlined
def record(m, block, row, kind):
    """Samples and, unless `row` is -1, a snapshot at the end of a block; returns whether the outputs are within the limit."""
    snapshots, modes = numbers_at(m.snapshots), len(m.u)
    bounded = sample_as_published(m, block) if kind.published else sample(m, block, kind.coriolis)
    if row >= 0:
        numbers = 2 * modes if kind.coriolis else modes
        width = numbers + (0 if kind.published else len(m.static_force))
        for i in range(modes):
            snapshots[row * width + i] = m.u[i]
            if kind.coriolis:
                snapshots[row * width + modes + i] = m.increment[i]
        for k in range(width - numbers):
            snapshots[row * width + numbers + k] = m.static_force[k]
    return bounded


@inlined
def sample(m, block, coriolis):
    """The outputs, with those of the static modes; returns whether they are within the limit."""
    samples, outputs, nodes = numbers_at(m.samples), m.number_of_outputs, len(m.force)
    for g in range(0, nodes, LANES):
        store(m.static_force, g, load(m.force, g))
        store(m.static_force, nodes + g, load(m.friction_force, (0, g)))
        store(m.static_force, 2 * nodes + g, load(m.friction_force, (1, g)))
    beyond = 0
    for g in range(0, len(m.sample), LANES):
        total = along(m.outputs, 0, m.u, g, len(m.u))
        if coriolis:
            total += along(m.increment_outputs, 0, m.increment, g, len(m.u))
        total += along(m.force_outputs, 0, m.static_force, g, len(m.static_force))
        store(m.sample, g, total)
        # written so that NaN fails as well
        beyond |= ~bits_of(np.abs(total) < m.limit) & ((1 << LANES) - 1)
    for o in range(outputs):
        samples[block * outputs + o] = m.sample[o]
    return beyond == 0


@inlined
def sample_as_published(m, block):
    """The same one after another: what was computed with the published integrator is to stay, to the last bit."""
    samples, outputs = numbers_at(m.samples), m.number_of_outputs
    bounded = True
    for o in range(outputs):
        total = 0.0
        for i in range(len(m.u)):
            total += m.outputs[0, o, i] * m.u[i]
        samples[block * outputs + o] = total
        bounded &= abs(total) < m.limit
    return bounded
