"""Modes of an elastic casing, as a step takes them, compiled: the rotor's frame goes on, and the casing turns in it.

Free motion, forces and recursion of a pair (q_c, q_s) are those of the frame that does not turn: see r37core.contact.ring. What
is kept of it is written in the rotor's frame of the instant, where the nodes' rows are constant.
"""

from __future__ import annotations

from r37core.alignment import LANES
from r37core.lanes import inlined, load, store

from ..jump_numbers import STRIDES
from .steps import mode_lanes

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
    """What a step has left of its pairs."""
    turn(m, SINGLE, m.u)
    turn(m, SINGLE, m.increment)
    turn(m, SINGLE, m.last_increment)


@inlined
def turn_jump(m, stride):
    """What a jump has left of them."""
    turn(m, stride, m.u)
    turn(m, stride, m.increment)
