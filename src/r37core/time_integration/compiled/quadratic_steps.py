"""Displacements of second order in a step, compiled: see time_integration.quadratic_motion.

The products q_a q_b have lanes behind those of the blade's modes, so that nodes, outputs and the edge move by them as by modes.
A force on them is one on the lowest modes. The elastic forces of second order act like contact forces at t_n.
"""

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import inlined, load, spread, store

from .steps import along, mode_lanes


@inlined
def begin_quadratic(m):
    """Find products and forces at t_n from displacement and increment: where the record does not have them."""
    second = m.second
    for g in range(0, second.lanes, LANES):
        store(second.functional, g, along(second.rows, 0, m.u, g, mode_lanes(m)))
        moved = along(second.rows, 0, m.increment, g, mode_lanes(m))
        store(second.last, g, load(second.functional, g) - moved)
    for p in range(second.products):
        m.u[second.lane + p] = second.last[second.first[p]] * second.last[second.second[p]]
    set_products(m)


@inlined
def set_products(m):
    """Set the products at t_n, how they have changed in the step, and the pull of each functional, from the functionals."""
    second = m.second
    modes, products = second.functionals - second.products, second.products
    squares = 0.0
    for p in range(products):
        i = second.lane + p
        product = second.functional[second.first[p]] * second.functional[second.second[p]]
        m.increment[i] = product - m.u[i]
        m.u[i] = product
        second.pull[modes + p] = 0.5 * second.weight[p] * product
        squares += product * product
    reduction = 0.0
    if squares > second.surely_within:
        reduction = reduced(m)
    for g in range(0, products, LANES):
        even = odd = spread(0.0)
        for r in range(0, products - 1, 2):
            even += load(second.cubic, (r, g)) * m.u[second.lane + r]
            odd += load(second.cubic, (r + 1, g)) * m.u[second.lane + r + 1]
        if products % 2 != 0:
            even += load(second.cubic, (products - 1, g)) * m.u[second.lane + products - 1]
        store(second.stiffened, g, even + odd)
    for p in range(products):
        second.stiffened[p] += second.functional[modes + p]
        if reduction != 0.0:
            second.stiffened[p] += reduction * second.pull_left[p]
    for a in range(modes):
        pull = 0.0
        for b in range(modes):
            pull += second.stiffened[second.product_of[a, b]] * second.functional[b]
        second.pull[a] = pull


@inlined
def reduced(m):
    """Derivative by Q of the energy that counts in place of Q, less one; stores the stiffness that Q gives each product."""
    second = m.second
    energy = 0.0
    for p in range(second.products):
        second.pull_left[p] = 0.0
        for r in range(second.products):
            second.pull_left[p] += second.left[p, r] * m.u[second.lane + r]
        energy += 0.25 * second.weight[p] * m.u[second.lane + p] * second.pull_left[p]
    if energy < -second.bound:
        m.totals.steps_bounded += 1.0
        return second.bound / energy * (second.bound / energy) - 1.0
    return 0.0


@inlined
def push_quadratic(m):
    """Add the elastic forces of second order at t_n to the pushes, and what pushes the products as it pushes the modes."""
    second = m.second
    if m.follows != 0:
        push_products(m)
    for i in range(0, mode_lanes(m), LANES):
        even, odd = load(m.push, i), spread(0.0)
        for r in range(0, second.functionals - 1, 2):
            even -= load(second.rows, (0, r, i)) * second.pull[r]
            odd -= load(second.rows, (0, r + 1, i)) * second.pull[r + 1]
        if second.functionals % 2 != 0:
            even -= load(second.rows, (0, second.functionals - 1, i)) * second.pull[second.functionals - 1]
        store(m.push, i, even + odd)


@inlined
def push_products(m):
    """Let what pushes the products push the lowest modes: q_a q_b moves by q_b per q_a."""
    second = m.second
    modes = second.functionals - second.products
    for a in range(modes):
        push = 0.0
        for b in range(modes):
            share = m.push[second.lane + second.product_of[a, b]] * second.functional[b]
            push += share + share if a == b else share
        second.push[a] = push
    for i in range(0, mode_lanes(m), LANES):
        push = load(m.push, i) * load(second.stepped, i)
        for a in range(modes):
            push += load(second.rows, (0, a, i)) * second.push[a]
        store(m.push, i, push)


@inlined
def follow_quadratic(m, work):
    """Take the functionals at the end of a step; adds to the work, doubled, what is not that of contact."""
    second = m.second
    for g in range(0, second.lanes, LANES):
        before = load(second.last, g)
        here = along(second.rows, 0, m.u, g, mode_lanes(m))
        store(second.last, g, load(second.functional, g))
        store(second.functional, g, here)
        work += load(second.pull, g) * (here - before)
    set_products(m)
    return work
