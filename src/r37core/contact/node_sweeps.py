"""The contact problem at one instant, compiled into the time integration: forces and gaps of all nodes, each by its own law.

A problem `c` is a contact_record of r37core.time_integration.layout. Forces p open the gaps g to g + G p, G being what the static
modes do, `columns[j, i]` the opening of gap i per force on node j. A node at the bare casing keeps g + G p >= 0, p >= 0 and one
of them zero; one on a lining has the force of its bar, with the casing behind it. Node after node gets the force that its own law
says while the others keep theirs: the projected Gauss-Seidel method (Cottle, Pang and Stone, The Linear Complementarity Problem,
section 5.2). G is nearly diagonal, so that a sweep leaves some hundredths of the error.

Nodes are lanes. Sets of nodes are bits, eight nodes to an integer.
"""

from __future__ import annotations

from r37core.alignment import LANES
from r37core.lanes import inlined, load, store

from .laws import return_mapping, series_modulus

_return_mapping, _series_modulus = inlined(return_mapping), inlined(series_modulus)

SWEEPS = 200
TOLERANCE = 1e-14
"""Largest change of a gap in the last sweep, relative to the largest gap."""


@inlined
def bar_force(penetration, flexibility, wear, lining):
    """Normal force (N) of a bar on a node, new wear (m) of the bar, and whether the node reaches the casing behind it.

    `penetration` (m): of the bar's first position, had the node no force of its own; each newton takes `flexibility` (m/N),
    more than 0, of it. The node ends where its flexibility in series with the bar puts it, or at the casing, which gives what
    the bar does not.
    """
    modulus = _series_modulus(lining.elastic_modulus, lining.elastic_modulus * lining.area / lining.thickness, flexibility)
    stress, worn = _return_mapping(penetration, wear, modulus, lining)
    force = stress * lining.area
    beyond = penetration - lining.thickness
    reaches = flexibility * force < beyond
    if reaches:
        force = beyond / flexibility
        _, worn = _return_mapping(lining.thickness, wear, lining.elastic_modulus, lining)
    return force, worn, reaches


@inlined
def set_force(c, k, lining, lined):
    """Give a node the force of its law while the others keep theirs; returns by how much that changes its gap (m)."""
    before, own = c.pressure[k], c.columns[k, k]
    penetration = own * before - c.opened[k]
    if lined:
        after, c.worn[k], reaches = bar_force(penetration, own, c.wear[k], lining)
        bit = 1 << (k % LANES)
        c.closed[k // LANES] = c.closed[k // LANES] | bit if reaches else c.closed[k // LANES] & ~bit
    else:
        after = max(penetration, 0.0) / own
    change = after - before
    c.pressure[k] = after
    for g in range(0, len(c.opened), LANES):
        store(c.opened, g, load(c.opened, g) + load(c.columns, (k, g)) * change)
    return abs(change) * own


@inlined
def sweep_nodes(c, count, largest_gap, lining, lined):
    """Set the forces of the listed nodes, from those they have; returns the last sweep's largest change if it is too large.

    Relative to `largest_gap` (m).
    """
    largest = 0.0
    for _ in range(SWEEPS):
        largest = 0.0
        for j in range(count):
            largest = max(largest, set_force(c, c.listed[j], lining, lined))
        # written so that NaN ends it
        if count == 1 or not largest > TOLERANCE * largest_gap:
            return 0.0
    return largest / largest_gap
