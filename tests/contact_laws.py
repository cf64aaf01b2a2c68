"""The laws of contact as the time integration compiles them, called one at a time."""

from dataclasses import fields

import numpy as np
from numba import njit

from r37core.alignment import aligned_record, aligned_zeros, padded
from r37core.contact import complementarity, laws
from r37core.lanes import OPTIONS, inlined, load, store
from r37core.time_integration.layout import LINING, complementarity_record

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
def _complement(room):
    return complementarity.solve_complementarity(room[0].problem, room[0].columns)


def return_mapping(penetration, wear, bar):
    """Stress and new wear of a bar with the numbers of a lining."""
    law = np.zeros(1, LINING)
    for field in fields(bar):
        law[field.name] = getattr(bar, field.name) or 0.0
    return _press(penetration, wear, law)


def friction_direction(tangential, meridional):
    """Tangential and meridional part of the friction's direction, from those of the sliding."""
    room = aligned_zeros((1,), aligned_record([("values", np.float64, (2, padded(1)))]))
    room[0]["values"][:, 0] = tangential, meridional
    _direct(room)
    return tuple(room[0]["values"][:, 0])


def solve_complementarity(matrix, gap, guess=None):
    """Multipliers and the largest violation."""
    count, nodes = len(gap), padded(len(gap))
    room = aligned_zeros(
        (1,), aligned_record([("problem", complementarity_record(nodes), ()), ("columns", np.float64, (nodes, nodes))])
    )
    p = room[0]["problem"]
    room[0]["columns"][:count, :count] = np.transpose(matrix)
    p["diagonal"] = 1.0
    p["diagonal"][:count], p["gap"][:count] = np.diag(matrix), gap
    if guess is None or not np.any(guess):
        guess = np.asarray(gap) < 0.0
    p["touching"] = np.packbits(np.pad(guess, (0, nodes - count)), bitorder="little")
    violation = _complement(room)
    return p["multiplier"][:count].copy(), violation
