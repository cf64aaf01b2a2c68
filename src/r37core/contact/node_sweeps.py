"""The contact problem at one instant, compiled into the time integration: forces and gaps of all nodes, each by its own law.

A problem `c` is a contact_record of time_integration.compiled.layout; nodes are lanes, and a set of nodes is a bit for each,
eight to an integer. Forces p open the gaps g to g + G p, G being what the static modes do. A node at the bare casing keeps
g + G p >= 0, p >= 0 and one of them zero; one on a lining has the force of its bar, with the casing behind it. In a sweep all
nodes at once get the forces that their laws say: the projected Jacobi method (Cottle, Pang and Stone, The Linear
Complementarity Problem, section 5.2). Where G is nearly diagonal, as with few contact nodes, a sweep leaves about a tenth of
the error. Where static modes move many nodes together (static_modes.settles_at_once is false), nodes get them one after the
other, by the projected Gauss-Seidel method.
"""

import numpy as np

from r37core.machine_code.alignment import LANES
from r37core.machine_code.lanes import bits_of, flag_at, flags_of, inlined, lanes_used, largest_of_lanes, load, spread, store

from .laws import lines_of_bar, series_modulus, worn

_lines_of_bar, _series_modulus, _worn = inlined(lines_of_bar), inlined(series_modulus), inlined(worn)

SWEEPS = 500
TOLERANCE = 1e-12
"""Largest change of a penetration in the last sweep, relative to the largest gap."""


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
def forces_of_laws(c, g, penetration, thickness, lined):
    """Normal forces (N) on the eight nodes from g on, which would penetrate so much (m), had they none: of bar or casing.

    Negative where a node is clear.
    """
    if not lined:
        return penetration * load(c.stiffness, g)
    elastic = load(c.elastic, g) * (penetration - load(c.wear, g))
    plastic = load(c.offset, g) + load(c.plastic, g) * penetration
    bar_force = np.where(elastic < plastic, elastic, plastic)
    return np.maximum(bar_force, (penetration - thickness) * load(c.stiffness, g))


@inlined
def open_gaps(c, g, count):
    """The gaps of the eight nodes from g on with the forces on the listed nodes (m)."""
    opened = load(c.gap, g)
    for j in range(count):
        k = c.listed[j]
        opened += load(c.columns, (k, g)) * c.pressure[k]
    return opened


@inlined
def sweep_nodes(c, count, largest_gap, thickness, lined):
    """Set the forces on the listed nodes, from those they have; returns the last change if it is still too large.

    It is relative to `largest_gap` (m). `thickness` (m): of the lining.
    """
    allowed = TOLERANCE * largest_gap
    if c.settles_at_once == 0:
        return sweep_in_order(c, count, largest_gap, thickness, lined)
    for _ in range(SWEEPS):
        changed = 0
        for g in range(0, lanes_used(c.gap, c.lanes), LANES):
            opened, before, own = open_gaps(c, g, count), load(c.pressure, g), load(c.own, g)
            after = forces_of_laws(c, g, own * before - opened, thickness, lined)
            # written so that NaN stays
            after = np.where(flags_of(c.found[g // LANES]), np.where(after < 0.0, 0.0, after), 0.0)
            change = np.abs(after - before) * own
            store(c.opened, g, opened)
            store(c.pressure, g, after)
            store(c.change, g, change)
            changed |= bits_of(change > allowed)
        if changed == 0:
            return 0.0
    largest = 0.0
    for j in range(count):
        largest = max(largest, c.change[c.listed[j]])
    return largest / largest_gap


@inlined
def sweep_in_order(c, count, largest_gap, thickness, lined):
    """Do what sweep_nodes does, node by node, each with the forces that those before it have got."""
    allowed, lanes = TOLERANCE * largest_gap, lanes_used(c.gap, c.lanes)
    for g in range(0, lanes, LANES):
        store(c.opened, g, open_gaps(c, g, count))
    largest = 0.0
    for _ in range(SWEEPS):
        largest = 0.0
        for j in range(count):
            k = c.listed[j]
            g = k // LANES * LANES
            before, own = c.pressure[k], c.own[k]
            # of the eight nodes that it is one of
            wanted = forces_of_laws(c, g, load(c.own, g) * before - load(c.opened, g), thickness, lined)
            after = largest_of_lanes(np.where(flag_at(k - g), wanted, 0.0))
            step = after - before
            c.pressure[k] = after
            largest = max(largest, abs(step) * own)
            for g in range(0, lanes, LANES):
                store(c.opened, g, load(c.opened, g) + load(c.columns, (k, g)) * step)
        if largest <= allowed:
            return 0.0
    return largest / largest_gap


@inlined
def wear_bars(c, g, lining):
    """Wear of the bars of the eight nodes from g on under the forces found; which of the nodes reach the casing behind them."""
    penetration, thickness = -load(c.opened, g), lining.thickness
    reaches = bits_of(penetration > thickness * (1.0 - 1e-9)) & c.found[g // LANES]
    store(c.wear, g, _worn(np.where(penetration < thickness, penetration, thickness), load(c.wear, g), lining))
    return reaches
