"""Jumps over free flight as a run does them, compiled: while no node can reach lining or casing, many steps at once.

Each mode is u_n = Re(C lambda^n) with |lambda| <= 1, so m steps are a 2 x 2 map of (u, d), made once
(time_integration.jump_plan), and |C| bounds the mode until the next contact. A jump is taken only if a bound on every node's
position over all the steps it skips stays clear of the casing's nearest position over them: modes slow in the jump follow
their tangent within |C| |1 - 1/lambda|^2 m (m + 1)/2, the others stay within |C|. The casing's modes, which turn, move a node
by up to |C| times the size of their shape there.

With the exact gap a node's position is at most n + cos(alpha) y^2/(2 R), and the lobes at its displaced angle at most
their greatest slope times |y|/R nearer than at its undeformed one; n, y (sideways) and R (distance from the axis) are bounded.
"""

import numpy as np

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import bits_of, inlined, load, numbers_at, store

from ..jump_numbers import BEYOND, COARSE, D_FROM_D, D_FROM_U, LOSS_DD, LOSS_UD, LOSS_UU, STRIDES, U_FROM_D, U_FROM_U
from .layout import EXACT_GAP, MERIDIONAL, NORMAL, TANGENTIAL
from .steps import along, mode_lanes, node_lanes

ROUNDING_MARGIN = 1e-9
"""Relative margin of the distances compared, far above the rounding of their sums."""


@inlined
def bound_amplitudes(m):
    """|C| of each mode from displacement and increment and, for the exact gap, how far nodes can get sideways and inwards."""
    for i in range(0, mode_lanes(m), LANES):
        u, d = load(m.u, i), load(m.increment, i)
        imaginary = load(m.speed.amplitude_by_u, i) * u + load(m.speed.amplitude_by_d, i) * d
        store(m.flight.amplitude, i, np.sqrt(u * u + imaginary * imaginary))
    if EXACT_GAP:
        for g in range(0, node_lanes(m), LANES):
            normal = along(m.size_operator, NORMAL, m.flight.amplitude, g, mode_lanes(m))
            meridional = along(m.size_operator, MERIDIONAL, m.flight.amplitude, g, mode_lanes(m))
            inwards = normal * m.casing.cosine + meridional * abs(m.casing.sine)
            store(m.flight.across, g, along(m.size_operator, TANGENTIAL, m.flight.amplitude, g, mode_lanes(m)))
            store(m.flight.towards, g, load(m.radius, g) - inwards)
    for stride in range(STRIDES):
        m.flight.reach_known[stride] = 0


@inlined
def _is_clear(m, place, stride, remaining):
    """Check that no node can touch anything in a jump; `remaining`: what the casing's lobes lack before it."""
    if m.flight.reach_known[stride] == 0:
        for i in range(0, mode_lanes(m), LANES):
            store(m.flight.beyond, i, load(m.flight.amplitude, i) * load(m.speed.jumps, (stride, BEYOND, i)))
        for g in range(0, node_lanes(m), LANES):
            store(m.flight.reach, (stride, g), along(m.size_operator, NORMAL, m.flight.beyond, g, mode_lanes(m)))
        m.flight.reach_known[stride] = 1
    casing, nodes, length = numbers_at(m.call.nearest_casing), node_lanes(m), m.flight.lengths[stride]
    lobes = m.casing.amplitude * (1.0 - remaining * m.flight.decay[stride])
    for g in range(0, nodes, LANES):
        velocity = along(m.displacement_operator, NORMAL, m.increment, g, m.speed.slow_modes[stride])
        position = along(m.displacement_operator, NORMAL, m.u, g, m.speed.slow_modes[stride])
        position += np.maximum(velocity, velocity * length) + load(m.flight.reach, (stride, g))
        nearest = load(casing, place + g)
        for j in range(1, (length + COARSE - 1) // COARSE):
            nearest = np.maximum(nearest, load(casing, place + j * nodes + g))
        if EXACT_GAP:
            across, towards = load(m.flight.across, g), load(m.flight.towards, g)
            position += across * across * (0.5 * m.casing.cosine) / towards
            # the greatest slope of exp(-x^2) is sqrt(2/e)
            slope = np.sqrt(2.0 / np.e) / (m.casing.width * m.casing.period)
            nearest = nearest + across / towards * slope
            nearest = np.where(nearest < 1.0, nearest, 1.0)
            if bits_of(towards > 0.0) != (1 << LANES) - 1:
                return False
        clearance = load(m.speed.clearance, g) + m.opening
        gap = clearance - lobes * nearest - position
        # written so that NaN is not clear
        clear = bits_of(gap > ROUNDING_MARGIN * (np.abs(clearance) + lobes + np.abs(position)))
        if clear != (1 << LANES) - 1:
            return False
    return True


@inlined
def choose_jump(m, place, first_stride, left, remaining):
    """Stride of the longest jump that the rest of the block and the bounds allow, -1 if there is none."""
    stride = 0 if left < COARSE else first_stride
    while m.flight.lengths[stride] > left:
        stride -= 1
    while not _is_clear(m, place, stride, remaining):
        if stride <= 1:
            return -1
        stride -= 1
    return stride


@inlined
def jump_ahead(m, stride, lost):
    """Do the steps of a jump; adds the energy they lose to damping, in lanes."""
    jumps = m.speed.jumps
    for i in range(0, mode_lanes(m), LANES):
        u, d = load(m.u, i), load(m.increment, i)
        store(m.u, i, u + load(jumps, (stride, U_FROM_U, i)) * u + load(jumps, (stride, U_FROM_D, i)) * d)
        store(m.increment, i, d + load(jumps, (stride, D_FROM_U, i)) * u + load(jumps, (stride, D_FROM_D, i)) * d)
        lost += load(jumps, (stride, LOSS_DD, i)) * (d * d)
        lost += (load(jumps, (stride, LOSS_UU, i)) * u + load(jumps, (stride, LOSS_UD, i)) * d) * u
    return lost


SINGLE = STRIDES
"""Row of a single step."""


@inlined
def turn(m, row, amplitudes):
    """Write the pairs among `amplitudes` in the frame after a jump or a step: a `row` of the turns."""
    pairs = m.pairs
    first = mode_lanes(m) - 2 * pairs
    for j in range(0, pairs, LANES):
        cosine, sine = load(m.turn_cosine, (row, j)), load(m.turn_sine, (row, j))
        c, s = load(amplitudes, first + j), load(amplitudes, first + pairs + j)
        store(amplitudes, first + j, cosine * c - sine * s)
        store(amplitudes, first + pairs + j, sine * c + cosine * s)


@inlined
def turn_step(m):
    """Turn the pairs after a step."""
    turn(m, SINGLE, m.u)
    turn(m, SINGLE, m.increment)
    turn(m, SINGLE, m.last_increment)


@inlined
def turn_jump(m, stride):
    """Turn the pairs after a jump."""
    turn(m, stride, m.u)
    turn(m, stride, m.increment)
