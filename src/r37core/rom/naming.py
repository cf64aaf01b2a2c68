"""Ideal bending and torsion shapes, by which the first modes get their names."""

import numpy as np
from numpy import ndarray

from r37core.mesh.blade_mesh import BladeMesh

# roots of cos(x) cosh(x) = -1: clamped-free beam (Blevins, Formulas for Natural Frequency and Mode Shape)
_BEAM_ROOTS = (1.875104068711961, 4.694091132974175)

NAMED_MODES = ("1B", "1T", "2B")
"""Modes with names of their own: first bending, first torsion, second bending."""

FIRST_BENDING, FIRST_TORSION, _ = NAMED_MODES


def mode_names(count: int) -> tuple[str, ...]:
    """Names of the first `count` modes, 3 or more: those without a name of their own are numbered."""
    return (*NAMED_MODES, *map(str, range(len(NAMED_MODES) + 1, count + 1)))


def mode_label(name: str) -> str:
    """Label of a mode in a legend: those without a name of their own are numbered."""
    return name if name in NAMED_MODES else f"mode {name}"


def ideal_shapes(mesh: BladeMesh) -> dict[str, ndarray]:
    """Displacement fields, shape (nodes, 3), named 1B, 1T and 2B.

    Bending moves along the blade's local normal as a clamped-free beam; torsion turns each section about mid-chord by
    a quarter sine along the span.
    """
    chord, span, _ = mesh.parameters.T
    twist = (chord - 0.5) * np.sin(0.5 * np.pi * span)
    amplitudes = (_beam_shape(span, _BEAM_ROOTS[0]), twist, _beam_shape(span, _BEAM_ROOTS[1]))
    return {name: amplitude[:, None] * mesh.normals for name, amplitude in zip(NAMED_MODES, amplitudes, strict=True)}


def _beam_shape(span: ndarray, root: float) -> ndarray:
    ratio = (np.cosh(root) + np.cos(root)) / (np.sinh(root) + np.sin(root))
    x = root * span
    return np.cosh(x) - np.cos(x) - ratio * (np.sinh(x) - np.sin(x))
