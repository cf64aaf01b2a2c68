"""Constant-speed segments of a run, as the compiled engine does them: displacement and velocity go over to the next speed.

An increment u_n - u_{n-1} belongs to its speed: it is that of a free mode of this frequency, in a step of this length.
"""

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import inlined, integers_at, load, numbers_at, numbers_of, store

from .steps import mode_lanes


@inlined
def begin_segment(m, segment):
    """Go on at the speed of a segment; returns its blocks of steps."""
    index = integers_at(m.call.speed_indices)[segment]
    if index != m.call.speed_index:
        take_speed(m, index)
    put_motion(m, 2 * segment)
    return integers_at(m.call.lasting)[segment]


@inlined
def take_speed(m, index):
    """Take the constants of another speed, and write the motion's velocity as an increment at it."""
    for i in range(0, mode_lanes(m), LANES):
        displacement_share = load(m.speed.increment_by_displacement, i) * load(m.u, i)
        store(m.increment, i, (load(m.increment, i) - displacement_share) * load(m.speed.velocity_by_increment, i))
    own, table, size = numbers_of(m), numbers_at(m.call.constants), m.call.constants_size
    for i in range(0, size, LANES):
        store(own, i, load(table, index * size + i))
    for i in range(0, mode_lanes(m), LANES):
        displacement_share = load(m.speed.increment_by_displacement, i) * load(m.u, i)
        store(m.increment, i, displacement_share + load(m.speed.increment_by_velocity, i) * load(m.increment, i))
    m.call.speed_index = index


@inlined
def end_segment(m, segment):
    """Keep how the motion ends a segment, and the largest wear by then."""
    put_motion(m, 2 * segment + 1)
    numbers_at(m.call.worn)[segment] = m.largest_wear


@inlined
def put_motion(m, end):
    """Displacement and increment at an end of a segment."""
    ends, modes = numbers_at(m.call.ends), mode_lanes(m)
    for i in range(modes):
        ends[2 * end * modes + i] = m.u[i]
        ends[(2 * end + 1) * modes + i] = m.increment[i]
