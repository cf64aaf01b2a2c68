"""The laws of contact as the time integration compiles them, called one at a time."""

from dataclasses import fields

import numpy as np
from numba import njit

from r37core.contact import laws, node_forces
from r37core.machine_code.alignment import LANES, aligned_record, aligned_zeros, padded
from r37core.machine_code.lanes import OPTIONS, inlined, load, store
from r37core.time_integration.compiled.layout import LINING, contact_record

_return_mapping, _friction_direction = inlined(laws.return_mapping), inlined(laws.friction_direction)


@njit(**OPTIONS)
def _press(penetration, wear, law):
    return _return_mapping(penetration, wear, law[0].elastic_modulus, law[0])


@njit(**OPTIONS)
def _direct(room):
    m = room[0]
    tangential, meridional = _friction_direction(load(m.values, (0, 0)), load(m.values, (1, 0)))
    store(m.values, (0, 0), tangential)
    store(m.values, (1, 0), meridional)


@njit(**OPTIONS)
def _settle(room, count, largest_gap, lined, by_sweeps):
    m = room[0]
    node_forces.set_laws(m.contact, count, m.lining, lined)
    if by_sweeps:
        return node_forces.sweep_nodes(m.contact, count, largest_gap, m.lining.thickness, lined)
    return node_forces.settle_forces(m.contact, count, largest_gap, m.lining.thickness, lined)


@njit(**OPTIONS)
def _wear(room, groups):
    m = room[0]
    for group in range(len(groups)):
        groups[group] = node_forces.wear_bars(m.contact, group * LANES, m.lining)


def _numbers_of(bar):
    """The numbers of a lining, as the compiled time integration has them."""
    law = np.zeros(1, LINING)
    for field in fields(bar):
        law[field.name] = getattr(bar, field.name) or 0.0
    return law


def return_mapping(penetration, wear, bar):
    """Stress and new wear of a bar with the numbers of a lining."""
    return _press(penetration, wear, _numbers_of(bar))


def friction_direction(tangential, meridional):
    """Tangential and meridional part of the friction's direction, from those of the sliding."""
    room = aligned_zeros((1,), aligned_record([("values", np.float64, (2, padded(1)))]))
    room[0]["values"][:, 0] = tangential, meridional
    _direct(room)
    return tuple(room[0]["values"][:, 0])


def press_nodes(matrix, gap, bar=None, area=0.0, wear=0.0, start=0.0, by_sweeps=False):
    """The contact problem at one instant, of nodes at the bare casing, or on bars of an `area` (m2) worn by `wear` (m).

    `matrix` (m/N): opening of the first index's gap per force on the second; `start` (N): forces to begin with; `by_sweeps`:
    node by node, and not all at once. Returns forces (N), how far they are from settled, and, of bars, their wear (m) and which
    nodes reach the casing behind.
    """
    count, nodes = len(gap), padded(len(gap))
    room = aligned_zeros((1,), aligned_record([("contact", contact_record(nodes), ()), ("lining", LINING, ())]))
    c = room[0]["contact"]
    c["gap"][:count], c["opened"][:count], c["pressure"][:count], c["wear"][:count] = gap, gap, start, wear
    c["columns"][:count, :count] = np.transpose(matrix)
    c["listed"][:count], c["lanes"] = np.arange(count), nodes
    listed = np.arange(nodes) < count
    c["found"] = np.packbits(listed, bitorder="little")
    if bar is not None:
        room["lining"], c["area"][:count] = _numbers_of(bar), area
    change = _settle(room, count, np.abs(gap).max(), bar is not None, by_sweeps)
    pressure = c["pressure"].copy()
    assert not pressure[count:].any()
    if bar is None:
        return pressure[:count], change
    touching = np.zeros(nodes // LANES, dtype=np.int64)
    _wear(room, touching)
    reaching = np.unpackbits(touching.astype(np.uint8), bitorder="little").astype(bool)
    return pressure[:count], change, c["wear"][:count].copy(), reaching[:count]
