"""Displacements of second order in a step, compiled: see time_integration.quadratic_motion.

The products q_a q_b have lanes behind those of the blade's modes, so that nodes, outputs and the edge move by them as by modes.
A force on them is one on the lowest modes. The elastic forces of second order act like contact forces at t_n.
"""

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import inlined, load, store

from .steps import along, mode_lanes


@inlined
def begin_quadratic(m):
    """Find products and forces at t_n from displacement and increment: where the record does not have them."""
    for g in range(0, m.functional_lanes, LANES):
        store(m.functional, g, along(m.functional_rows, 0, m.u, g, mode_lanes(m)))
        moved = along(m.functional_rows, 0, m.increment, g, mode_lanes(m))
        store(m.last_functional, g, load(m.functional, g) - moved)
    for p in range(m.products):
        a, b = m.pair_first[p], m.pair_second[p]
        m.u[m.first_product + p] = m.last_functional[a] * m.last_functional[b]
    set_products(m)


@inlined
def set_products(m):
    """Set the products at t_n, how they have changed in the step, and the pull of each functional, from the functionals."""
    modes = m.functionals - m.products
    for a in range(modes):
        m.functional_pull[a] = 0.0
    for p in range(m.products):
        a, b = m.pair_first[p], m.pair_second[p]
        product, i = m.functional[a] * m.functional[b], m.first_product + p
        m.increment[i] = product - m.u[i]
        m.u[i] = product
    for p in range(m.products):
        a, b, stiffness = m.pair_first[p], m.pair_second[p], m.functional[modes + p]
        for r in range(m.products):
            stiffness += m.cubic[p, r] * m.u[m.first_product + r]
        m.functional_pull[a] += stiffness * m.functional[b]
        if a != b:
            m.functional_pull[b] += stiffness * m.functional[a]
        m.functional_pull[modes + p] = 0.5 * m.product_weight[p] * m.u[m.first_product + p]


@inlined
def push_quadratic(m):
    """Add the elastic forces of second order at t_n to the pushes, and what pushes the products as it pushes the modes."""
    for g in range(0, m.functional_lanes, LANES):
        store(m.functional_push, g, -load(m.functional_pull, g))
    for p in range(m.products):
        a, b, i = m.pair_first[p], m.pair_second[p], m.first_product + p
        push = m.push[i]
        m.functional_push[a] += push * m.functional[b]
        m.functional_push[b] += push * m.functional[a]
        m.push[i] = 0.0
    for i in range(0, mode_lanes(m), LANES):
        push = load(m.push, i)
        for r in range(m.functionals):
            push += load(m.functional_rows, (0, r, i)) * m.functional_push[r]
        store(m.push, i, push)


@inlined
def follow_quadratic(m, work):
    """Take the functionals at the end of a step; adds to the work, doubled, what is not that of contact."""
    for g in range(0, m.functional_lanes, LANES):
        before = load(m.last_functional, g)
        here = along(m.functional_rows, 0, m.u, g, mode_lanes(m))
        store(m.last_functional, g, load(m.functional, g))
        store(m.functional, g, here)
        work += load(m.functional_pull, g) * (here - before)
    set_products(m)
    return work
