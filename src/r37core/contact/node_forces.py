"""The contact problem at one instant, compiled into the time integration: forces and gaps of all nodes, each by its own law.

A problem `c` is a contact_record of time_integration.compiled.layout; nodes are lanes, and a set of nodes is a bit for each,
eight to an integer. Forces p open the gaps g to g + G p, G being what the static modes do. A node at the bare casing keeps
g + G p >= 0, p >= 0 and one of them zero; one on a lining has the force of its bar, with the casing behind it.

All laws are lines in pieces, p = max(0, f + s (x - x')). On the pieces that hold at the forces of the last step the problem is
linear, and is solved at once; where a node leaves its piece, it is solved again on the new one. That is Newton's method (Qi and
Sun, Mathematical Programming 58 (1993)); of the bare casing it is block pivoting (Cottle, Pang and Stone, The Linear
Complementarity Problem, section 4.2). One solution is nearly always enough. Where pieces still change after some, nodes get the
forces of their laws one after the other until they settle: the projected Gauss-Seidel method (section 5.2 there).
"""

import numpy as np

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import bits_of, flag_at, flags_of, inlined, lanes_used, load, spread, store

from .laws import lines_of_bar, series_modulus, worn

_lines_of_bar, _series_modulus, _worn = inlined(lines_of_bar), inlined(series_modulus), inlined(worn)

SOLUTIONS, SWEEPS = 16, 500
TOLERANCE = 1e-12
"""Largest change of a penetration by the last sweep over the laws, relative to the largest gap."""


@inlined
def set_laws(c, count, lining, lined):
    """The laws of the listed nodes, from what their own forces do, `columns`, and the wear of their bars."""
    for g in range(0, lanes_used(c.gap, c.lanes), LANES):
        own = spread(1.0)
        for j in range(count):
            k = c.listed[j]
            own = np.where(flag_at(k - g), load(c.columns, (k, g)), own)
        store(c.own, g, own)
        store(c.stiffness, g, 1.0 / own)
        if lined:
            area = load(c.area, g)
            bar = lining.elastic_modulus * area * (1.0 / lining.thickness)
            elastic, offset, plastic = _lines_of_bar(_series_modulus(lining.elastic_modulus, bar, own), area, lining)
            store(c.elastic, g, elastic)
            store(c.offset, g, offset)
            store(c.plastic, g, plastic)


@inlined
def take_laws(c, g, penetration, thickness, lined):
    """Forces (N) on the eight nodes from g on, which would penetrate so much (m), had they none: of bar or casing.

    Stores how they grow with the penetration, `slope` (N/m). Nothing presses a node that is clear or not listed.
    """
    slope = load(c.stiffness, g)
    force = penetration * slope
    if lined:
        elastic = load(c.elastic, g) * (penetration - load(c.wear, g))
        plastic = load(c.offset, g) + load(c.plastic, g) * penetration
        casing = (penetration - thickness) * slope
        force = np.where(elastic < plastic, elastic, plastic)
        bar_slope = np.where(elastic < plastic, load(c.elastic, g), load(c.plastic, g))
        slope = np.where(casing > force, slope, bar_slope)
        force = np.where(casing > force, casing, force)
    listed = flags_of(c.found[g // LANES])
    store(c.slope, g, np.where(listed, np.where(force < 0.0, 0.0, slope), 0.0))
    # written so that NaN stays
    return np.where(listed, np.where(force < 0.0, 0.0, force), 0.0)


@inlined
def open_gaps(c, g, count):
    """The gaps of the eight nodes from g on with the forces on the listed nodes (m)."""
    opened = load(c.gap, g)
    for j in range(count):
        k = c.listed[j]
        opened += load(c.columns, (k, g)) * c.pressure[k]
    return opened


@inlined
def settle_forces(c, count, largest_gap, thickness, lined):
    """Set the forces on the listed nodes, from those they have, and the gaps; returns the last change if it is too large.

    It is relative to `largest_gap` (m). `thickness` (m): of the lining.
    """
    for _ in range(SOLUTIONS):
        changed = 0
        for g in range(0, lanes_used(c.gap, c.lanes), LANES):
            opened, before, own = open_gaps(c, g, count), load(c.pressure, g), load(c.own, g)
            penetration = own * before - opened
            force = take_laws(c, g, penetration, thickness, lined)
            # written so that NaN counts as changed
            changed |= ~bits_of(np.abs(force - before) * own < TOLERANCE * largest_gap) & c.found[g // LANES]
            store(c.opened, g, opened)
            store(c.intercept, g, force - load(c.slope, g) * (penetration + load(c.gap, g)))
            store(c.pressure, g, force)
        if changed == 0:
            return 0.0
        solve_pieces(c, count)
    return sweep_nodes(c, count, largest_gap, thickness, lined)


@inlined
def solve_pieces(c, count):
    """Solve p = a + s (d p - G p) for the forces: law by law a line of slope s, d the diagonal of G, a its force for p = 0.

    By Gauss-Jordan elimination on whole columns of I + s (G - d), whose diagonal is one. No pivot vanishes: the matrix is a
    P-matrix, as G is. Where G is singular the solution is not finite, and the sweeps follow. Nodes that nothing presses have no
    slope, and so no column.
    """
    lanes, pressed = lanes_used(c.gap, c.lanes), 0
    for j in range(count):
        if c.slope[c.listed[j]] > 0.0:
            c.pressed[pressed] = c.listed[j]
            pressed += 1
    for g in range(0, lanes, LANES):
        slope = load(c.slope, g)
        for j in range(pressed):
            k = c.pressed[j]
            store(c.left, (j, g), np.where(flag_at(k - g), 1.0, slope * load(c.columns, (k, g))))
        store(c.left, (pressed, g), load(c.intercept, g))
        store(c.pressure, g, 0.0)
    for j in range(pressed):
        k = c.pressed[j]
        c.inverse[j] = 1.0 / c.left[j, k]
        for g in range(0, lanes, LANES):
            factor = np.where(flag_at(k - g), 0.0, load(c.left, (j, g)) * c.inverse[j])
            for i in range(j + 1, pressed + 1):
                store(c.left, (i, g), load(c.left, (i, g)) - factor * c.left[i, k])
    for j in range(pressed):
        c.pressure[c.pressed[j]] = c.left[pressed, c.pressed[j]] * c.inverse[j]


@inlined
def sweep_nodes(c, count, largest_gap, thickness, lined):
    """Do what settle_forces does, node by node, each with the forces that those before it have got."""
    lanes, largest = lanes_used(c.gap, c.lanes), 0.0
    for g in range(0, lanes, LANES):
        pressure = load(c.pressure, g)
        # of singular laws the solution is not finite
        store(c.pressure, g, np.where(np.abs(pressure) < np.inf, pressure, 0.0))
    for g in range(0, lanes, LANES):
        store(c.opened, g, open_gaps(c, g, count))
    for _ in range(SWEEPS):
        largest = 0.0
        for j in range(count):
            k = c.listed[j]
            g = k // LANES * LANES
            # of the eight nodes that it is one of
            store(c.intercept, g, take_laws(c, g, load(c.own, g) * c.pressure[k] - load(c.opened, g), thickness, lined))
            step = c.intercept[k] - c.pressure[k]
            c.pressure[k] = c.intercept[k]
            largest = max(largest, abs(step) * c.own[k])
            for g in range(0, lanes, LANES):
                store(c.opened, g, load(c.opened, g) + load(c.columns, (k, g)) * step)
        if largest <= TOLERANCE * largest_gap:
            return 0.0
    return largest / largest_gap


@inlined
def wear_bars(c, g, lining):
    """Wear of the bars of the eight nodes from g on under the forces found; which of the nodes reach the casing behind them."""
    penetration, thickness = -load(c.opened, g), lining.thickness
    reaches = bits_of(penetration > thickness * (1.0 - 1e-9)) & c.found[g // LANES]
    store(c.wear, g, _worn(np.where(penetration < thickness, penetration, thickness), load(c.wear, g), lining))
    return reaches
