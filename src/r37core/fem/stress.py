"""Elastic stress from nodal displacements, by strains of first and of second order."""

from collections.abc import Callable

import numpy as np

from .assembly import Blocks, typed_blocks
from .material import Material

COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
"""Order of the components of a stress: xx yy zz xy yz zx."""


def stress_at(gradients: np.ndarray, displacement: np.ndarray, material: Material) -> np.ndarray:
    """Stress tensors (Pa), shape (elements, points, 3, 3).

    `gradients`: shape-function gradients, shape (elements, points, n, 3); `displacement` of each element's nodes (m),
    shape (elements, n, 3).
    """
    slope = _slope(gradients, displacement)
    return _stress(0.5 * (slope + slope.transpose(0, 1, 3, 2)), material)


def _slope(gradients: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    return displacement.transpose(0, 2, 1)[:, None] @ gradients


def _stress(strain: np.ndarray, material: Material) -> np.ndarray:
    """Hooke's law."""
    lame, shear = material.lame_constants
    trace = np.trace(strain, axis1=2, axis2=3)
    return 2.0 * shear * strain + lame * trace[:, :, None, None] * np.eye(3)


def nodal_stress(blocks: Blocks, points: np.ndarray, displacement: np.ndarray, material: Material) -> np.ndarray:
    """Stress at the nodes (Pa), shape (6, nodes, fields), components as in COMPONENTS; 0 at nodes of no element.

    `displacement` (m), shape (nodes, 3, fields), of nodes at `points` (m). Each element's linear stress is evaluated at its own
    nodes, where bending stress is largest, and averaged over the elements that share the node.
    """

    def stress(name: str, gradients: np.ndarray, field: int) -> np.ndarray:
        return stress_at(gradients, displacement[blocks[name], :, field], material)

    return _averaged(blocks, points, displacement.shape[2], stress)


def nodal_second_order_stress(
    blocks: Blocks, points: np.ndarray, first: np.ndarray, second: np.ndarray, material: Material
) -> np.ndarray:
    """Stress by the strain (A^T B + B^T A)/2, as nodal_stress has it; A and B: gradients of the displacements, field by field.

    Green's strain of u is that of first order and half of this with A = B (r37core.fem.large_displacement).
    """

    def stress(name: str, gradients: np.ndarray, field: int) -> np.ndarray:
        left, right = (_slope(gradients, each[blocks[name], :, field]) for each in (first, second))
        product = left.transpose(0, 1, 3, 2) @ right
        return _stress(0.5 * (product + product.transpose(0, 1, 3, 2)), material)

    return _averaged(blocks, points, first.shape[2], stress)


def _averaged(
    blocks: Blocks, points: np.ndarray, fields: int, stress_of: Callable[[str, np.ndarray, int], np.ndarray]
) -> np.ndarray:
    """Mean at each node of what its elements have there: tensors by the name of a type, its gradients and a field."""
    stress = np.zeros((len(COMPONENTS), len(points), fields))
    count = np.zeros(len(points))
    for name, element, coordinates in typed_blocks(blocks, points):
        members = blocks[name].ravel()
        count += np.bincount(members, minlength=len(points))
        gradients, _ = element.physical_gradients(coordinates, element.nodes)
        for j in range(fields):
            field_stress = stress_of(name, gradients, j)
            for component, (a, b) in enumerate(COMPONENTS):
                weights = field_stress[:, :, a, b].ravel()
                stress[component, :, j] += np.bincount(members, weights=weights, minlength=len(points))
    return stress / np.maximum(count, 1.0)[:, None]
