"""The compiled laws of contact, called one at a time."""

import ctypes
from pathlib import Path

import numpy as np

from r37core.native import load_library


def _library(nodes):
    library = load_library(Path(__file__).parent / "contact_laws.c", {"NODES": nodes, "REAL": "double"})
    number = ctypes.c_double
    library.press_bar.restype = library.complement.restype = number
    library.press_bar.argtypes = [number, ctypes.POINTER(number), ctypes.c_void_p]
    library.direct_friction.argtypes = [number, number, number, ctypes.c_void_p]
    library.complement.argtypes = [ctypes.c_void_p] * 4
    return library


def return_mapping(penetration, wear, *bar):
    """Stress and new wear of a bar: thickness, elastic and plastic modulus, yield stress."""
    worn = ctypes.c_double(wear)
    numbers = np.array(bar, dtype=float)
    stress = _library(1).press_bar(penetration, ctypes.byref(worn), numbers.ctypes.data)
    return stress, worn.value


def friction_direction(rotation, tangential, axial):
    answer = np.empty(2)
    _library(1).direct_friction(rotation, tangential, axial, answer.ctypes.data)
    return tuple(answer)


def solve_complementarity(matrix, gap, guess=None):
    """Multipliers and the largest violation."""
    matrix, gap = np.ascontiguousarray(matrix), np.ascontiguousarray(gap)
    guess = np.zeros(len(gap)) if guess is None else np.ascontiguousarray(guess, dtype=float)
    multipliers = np.ones(len(gap))
    addresses = [array.ctypes.data for array in (matrix, gap, guess, multipliers)]
    return multipliers, _library(len(gap)).complement(*addresses)
