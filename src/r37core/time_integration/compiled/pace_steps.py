"""Stretches of a run at changing speed, as the compiled engine takes them: displacement and velocity go over to the next pace.

An increment u_n - u_{n-1} is one of its pace, for it is that of a free mode of this frequency, in a step of this length.
"""

from __future__ import annotations

from r37core.alignment import LANES
from r37core.lanes import inlined, integers_at, load, numbers_at, numbers_of, store

from .layout import PACE_ROWS
from .steps import mode_lanes


@inlined
def begin_stretch(m, stretch, others):
    """Go on at the pace of a stretch, whose numbers that are not of modes are so many; returns its blocks of steps."""
    place = integers_at(m.call.places)[stretch]
    if place != m.call.pace:
        take_pace(m, place, others)
    put_motion(m, 2 * stretch)
    return integers_at(m.call.lasting)[stretch]


@inlined
def take_pace(m, place, others):
    """Take another pace, and write the motion's velocity as an increment of it."""
    for i in range(0, mode_lanes(m), LANES):
        of_displacement = load(m.pace.increment_by_displacement, i) * load(m.u, i)
        store(m.increment, i, (load(m.increment, i) - of_displacement) * load(m.pace.velocity_by_increment, i))
    own, paces, modes, most = numbers_of(m), numbers_at(m.call.paces), mode_lanes(m), len(m.u)
    first = place * (PACE_ROWS * modes + others)
    for row in range(PACE_ROWS):
        for i in range(0, modes, LANES):
            store(own, row * most + i, load(paces, first + row * modes + i))
    for i in range(0, others, LANES):
        store(own, PACE_ROWS * most + i, load(paces, first + PACE_ROWS * modes + i))
    for k in range(m.nodes):
        m.problem.diagonal[k] = m.pace.columns[k, k]
    for i in range(0, mode_lanes(m), LANES):
        of_displacement = load(m.pace.increment_by_displacement, i) * load(m.u, i)
        store(m.increment, i, of_displacement + load(m.pace.increment_by_velocity, i) * load(m.increment, i))
    m.call.pace = place


@inlined
def end_stretch(m, stretch):
    """Keep how the motion ends a stretch, and the largest wear by then."""
    put_motion(m, 2 * stretch + 1)
    if m.call.wear != 0:
        largest, wear = 0.0, numbers_at(m.call.wear)
        for bar in range(m.rings * int(m.lining.bars)):
            largest = max(largest, wear[bar])
        numbers_at(m.call.worn)[stretch] = largest


@inlined
def put_motion(m, end):
    """Displacement and increment at an end of a stretch."""
    ends, modes = numbers_at(m.call.ends), mode_lanes(m)
    for i in range(modes):
        ends[2 * end * modes + i] = m.u[i]
        ends[(2 * end + 1) * modes + i] = m.increment[i]
