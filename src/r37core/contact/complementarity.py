"""The small complementarity problem of direct contact, compiled into the time integration.

Nodes are lanes. A problem `p` is a complementarity_record of time_integration.compiled.layout: `gap` (m) of the nodes before
the casing pushes, and room to work in. `columns[j, i]`: opening of gap i per unit multiplier of node j. Sets of nodes are bits,
eight nodes to an integer.
"""

import numpy as np

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import bits_of, first_bit, flag_at, flags_of, inlined, lanes_used, load, spread, store

BLOCK_ROUNDS, SINGLE_ROUNDS = 8, 500
TOLERANCE = 1e-12
"""Violation allowed, relative to the largest gap."""


@inlined
def list_nodes(nodes, listed):
    """Write the numbers of the nodes of a set into `listed`; returns how many there are."""
    count = 0
    for g in range(len(nodes)):
        bits = nodes[g]
        while bits:
            listed[count] = g * LANES + first_bit(bits)
            count += 1
            bits &= bits - 1
    return count


@inlined
def _solve(p, columns, count):
    """Zero gap at the listed nodes, by Gauss-Jordan elimination on whole columns; False if a pivot all but cancels.

    Principal minors of a P-matrix are positive, so that is rare.
    """
    nodes = lanes_used(p.gap, p.lanes)
    for g in range(0, nodes, LANES):
        for j in range(count):
            store(p.left, (j, g), load(columns, (p.listed[j], g)))
        store(p.left, (count, g), -load(p.gap, g))
    sound = True
    for k in range(count):
        node = p.listed[k]
        pivot = p.left[k, node]
        inverse = 1.0 / pivot
        p.answer[k] = inverse
        sound &= pivot > 1e-4 * columns[node, node]
        for g in range(0, nodes, LANES):
            factor = np.where(flag_at(node - g), 0.0, load(p.left, (k, g)) * inverse)
            for j in range(k + 1, count + 1):
                store(p.left, (j, g), load(p.left, (j, g)) - factor * p.left[j, node])
    for k in range(count):
        p.answer[k] *= p.left[count, p.listed[k]]
    return sound


@inlined
def _solve_exchanging(p, columns, count):
    """Solve by Gaussian elimination with partial pivoting."""
    for i in range(count):
        for j in range(count):
            p.matrix[i, j] = columns[p.listed[j], p.listed[i]]
        p.matrix[i, count] = -p.gap[p.listed[i]]
    for k in range(count):
        pivot = k
        for i in range(k + 1, count):
            if abs(p.matrix[i, k]) > abs(p.matrix[pivot, k]):
                pivot = i
        for j in range(k, count + 1):
            p.matrix[k, j], p.matrix[pivot, j] = p.matrix[pivot, j], p.matrix[k, j]
        if p.matrix[k, k] == 0.0:
            continue
        for i in range(k + 1, count):
            factor = p.matrix[i, k] / p.matrix[k, k]
            for j in range(k + 1, count + 1):
                p.matrix[i, j] -= factor * p.matrix[k, j]
    for k in range(count - 1, -1, -1):
        right = p.matrix[k, count]
        for j in range(k + 1, count):
            right -= p.matrix[k, j] * p.answer[j]
        p.answer[k] = right / p.matrix[k, k] if p.matrix[k, k] != 0.0 else 0.0


@inlined
def solve_complementarity(p, columns):
    """Find multipliers >= 0 with gap + matrix multipliers >= 0 and the two never both positive, into `p.multiplier`.

    `p.touching`: the nodes expected to touch. Block principal pivoting, then Murty's least-index
    rule, which ends for every P-matrix (Cottle, Pang and Stone, The Linear Complementarity Problem, section 4.2). Returns the
    largest violation of either sign condition, relative to the largest gap.
    """
    nodes = lanes_used(p.gap, p.lanes)
    scale = violation = 0.0
    for g in range(0, nodes, LANES):
        store(p.short, g, np.abs(load(p.gap, g)))
    for k in range(nodes):
        scale = max(scale, p.short[k])
    for attempt in range(BLOCK_ROUNDS + SINGLE_ROUNDS):
        count = list_nodes(p.touching, p.listed)
        if not _solve(p, columns, count):
            _solve_exchanging(p, columns, count)
        wrong = 0
        for g in range(0, nodes, LANES):
            opened, multiplier = load(p.gap, g), spread(0.0)
            for j in range(count):
                k = p.listed[j]
                opened += load(columns, (k, g)) * p.answer[j]
                multiplier = np.where(flag_at(k - g), p.answer[j], multiplier)
            store(p.multiplier, g, multiplier)
            touching = flags_of(p.touching[g // LANES])
            short = np.where(touching, multiplier * load(p.diagonal, g), opened)
            store(p.short, g, short)
            p.wrong[g // LANES] = bits_of(short < -TOLERANCE * scale)
            wrong |= p.wrong[g // LANES]
        violation = 0.0
        if wrong == 0:
            break
        for k in range(nodes):
            violation = max(violation, -p.short[k])
        for g in range(len(p.wrong)):
            bits = p.wrong[g]
            p.touching[g] ^= bits if attempt < BLOCK_ROUNDS else bits & -bits
            if attempt >= BLOCK_ROUNDS and bits:
                break
    for g in range(0, nodes, LANES):
        store(p.multiplier, g, np.maximum(load(p.multiplier, g), 0.0))
    return violation / scale if scale > 0.0 else 0.0
