"""Stretches of a run at changing speed, as the compiled engine takes them: displacement and velocity go over to the next pace.

An increment u_n - u_{n-1} is one of its pace, for it is that of a free mode of this frequency, in a step of this length.
"""

from __future__ import annotations

from r37core.alignment import LANES
from r37core.lanes import inlined, integers_at, load, numbers_at, numbers_of, store


@inlined
def begin_stretch(m, stretch, numbers):
    """Go on at the pace of a stretch, which has so many `numbers`; returns its blocks of steps."""
    place = integers_at(m.places)[stretch]
    if place != m.pace:
        take_pace(m, place, numbers)
    put_motion(m, 2 * stretch)
    return integers_at(m.lasting)[stretch]


@inlined
def take_pace(m, place, numbers):
    """Take another pace, and write the motion's velocity as an increment of it."""
    for i in range(0, len(m.u), LANES):
        of_displacement = load(m.increment_by_displacement, i) * load(m.u, i)
        store(m.increment, i, (load(m.increment, i) - of_displacement) * load(m.velocity_by_increment, i))
    own, paces = numbers_of(m), numbers_at(m.paces)
    for i in range(0, numbers, LANES):
        store(own, i, load(paces, place * numbers + i))
    for k in range(m.nodes):
        m.problem.diagonal[k] = m.columns[k, k]
    for i in range(0, len(m.u), LANES):
        of_displacement = load(m.increment_by_displacement, i) * load(m.u, i)
        store(m.increment, i, of_displacement + load(m.increment_by_velocity, i) * load(m.increment, i))
    m.pace = place


@inlined
def end_stretch(m, stretch):
    """Keep how the motion ends a stretch, and the largest wear by then."""
    put_motion(m, 2 * stretch + 1)
    if m.wear != 0:
        largest, wear = 0.0, numbers_at(m.wear)
        for bar in range(m.rings * int(m.lining.bars)):
            largest = max(largest, wear[bar])
        numbers_at(m.worn)[stretch] = largest


@inlined
def put_motion(m, end):
    """Displacement and increment at an end of a stretch."""
    ends = numbers_at(m.ends)
    for i in range(len(m.u)):
        ends[2 * end * len(m.u) + i] = m.u[i]
        ends[(2 * end + 1) * len(m.u) + i] = m.increment[i]
