"""A lined step of second order, compiled: the lining presses with its force at t_n, fast modes follow all forces statically.

u_{n+1} = a u_n + b u_{n-1} + c F_n, F_n from the gaps at u_n: the leapfrog of Stoermer and Verlet for modes between forces
(Hairer, Lubich and Wanner, Geometric Numerical Integration, sections I.1.4 and XIII.2). The casing behind the lining is a
constraint on u_{n+1}. The modes that are not stepped add their residual flexibility to the contact nodes: a node's own is a
spring in series with its bar, what the others' forces add lags by a step.
"""

from __future__ import annotations

from r37core.alignment import LANES
from r37core.lanes import bits_of, inlined, load, spread, store

from .layout import MERIDIONAL, NORMAL, TANGENTIAL
from .steps import (
    clear_force,
    leave_casing,
    list_pressed,
    measure_exact_gaps,
    measure_gaps,
    press_bars,
    press_casing,
    push_blade,
    set_friction_force,
)


@inlined
def resume_lining(m):
    """What follows from the lining's force at t_n, from which a revolution begins; returns whether there is one."""
    settle(m, False)
    keep_static_force(m, False)
    return list_pressed(m) > 0


@inlined
def push_lining(m, kind, work, lost):
    """Push the blade with the lining's force at t_n; returns also whether there was one."""
    count = list_pressed(m)
    if count == 0:
        return False, work, lost
    return push_blade(m, count, kind, work, lost)


@inlined
def meet_lining(m, here, lobes, kind, pushed, work, lost):
    """From the gaps at u_{n+1}: the push of the casing, should a node reach it, and the lining's force there.

    `pushed`: whether the lining pressed in this step. Returns work, doubled, and loss.
    """
    casing_presses = False
    if reaches_casing(m):
        casing_presses, work, lost = push_casing(m, kind, pushed, work, lost)
        # what the casing presses stays where it is
        settle(m, True)
        if kind.exact_gap:
            measure_exact_gaps(m, here, lobes, True, kind.coriolis)
        else:
            measure_gaps(m, here, lobes, True, kind.coriolis)
        keep_static_force(m, False)
    else:
        leave_casing(m)
    m.totals.steps_in_contact += pushed or casing_presses
    clear_force(m)
    press_bars(m, here, kind)
    set_friction_force(m)
    settle(m, False)
    keep_static_force(m, casing_presses)
    return work, lost


@inlined
def release_lining(m, pushed):
    """No node passes the lining any more."""
    leave_casing(m)
    m.totals.steps_in_contact += pushed
    clear_force(m)
    set_friction_force(m)
    settle(m, False)
    keep_static_force(m, False)


@inlined
def reaches_casing(m):
    """Whether a node passes the casing behind the lining; if so, the gaps are those to it."""
    any_closed = 0
    for g in range(0, len(m.force), LANES):
        any_closed |= bits_of(load(m.problem.gap, g) + m.lining.thickness < 0.0)
    if any_closed == 0:
        return False
    for g in range(0, len(m.force), LANES):
        store(m.problem.gap, g, load(m.problem.gap, g) + m.lining.thickness)
    clear_force(m)
    return True


@inlined
def push_casing(m, kind, pushed, work, lost):
    """Multipliers of the casing, pushed after the lining's force: the work of that one on the way they add is added too."""
    for i in range(0, len(m.u), LANES):
        store(m.pushed, i, load(m.push, i) if pushed else spread(0.0))
    count = press_casing(m, kind)
    set_friction_force(m)
    presses, work, lost = push_blade(m, count, kind, work, lost)
    # a kick of complex modes sees those before it
    if presses and not kind.coriolis:
        for i in range(0, len(m.u), LANES):
            work += load(m.pushed, i) * load(m.inverse, i) * load(m.push, i)
    return presses, work, lost


@inlined
def settle(m, own):
    """What the static modes open the gaps by: added for the casing's forces, `own` among them, else set by the lining's."""
    for g in range(0, len(m.force), LANES):
        opening = load(m.settled, g) if own else spread(0.0)
        for k in range(m.nodes):
            if m.force[k] < 0.0:
                opening -= load(m.others_flexibility, (NORMAL, k, g)) * m.force[k]
                opening -= load(m.others_flexibility, (TANGENTIAL, k, g)) * m.friction_force[0, k]
                opening -= load(m.others_flexibility, (MERIDIONAL, k, g)) * m.friction_force[1, k]
        if own:
            opening -= load(m.own_flexibility, (NORMAL, g)) * load(m.force, g)
            opening -= load(m.own_flexibility, (TANGENTIAL, g)) * load(m.friction_force, (0, g))
            opening -= load(m.own_flexibility, (MERIDIONAL, g)) * load(m.friction_force, (1, g))
        store(m.settled, g, opening)


@inlined
def keep_static_force(m, more):
    """Forces that the static modes follow: those on the nodes now, or `more` of them."""
    for g in range(0, len(m.force), LANES):
        for direction in range(3):
            force = load(m.force, g) if direction == NORMAL else load(m.friction_force, (direction - 1, g))
            at = direction * len(m.force) + g
            if more:
                force += load(m.static_force, at)
            store(m.static_force, at, force)
