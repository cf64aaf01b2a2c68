"""Elastic stress from nodal displacements, by strains of first and of second order."""

from collections.abc import Callable

import numpy as np

from .assembly import Blocks, typed_blocks
from .material import Material
from .strain import displacement_gradient, linear_strain, second_order_strain

COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
"""Order of the components of a stress: xx yy zz xy yz zx."""


def stress_at(gradients: np.ndarray, displacement: np.ndarray, material: Material) -> np.ndarray:
    """Stress tensors (Pa), shape (elements, points, 3, 3).

    `gradients`: shape-function gradients, shape (elements, points, n, 3); `displacement` of each element's nodes (m),
    shape (elements, n, 3).
    """
    return material.stress(linear_strain(displacement_gradient(gradients, displacement)))


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
    """Stress by the strain of second order of two displacements, field by field, as nodal_stress has it: see strain.py."""

    def stress(name: str, gradients: np.ndarray, field: int) -> np.ndarray:
        pair = (displacement_gradient(gradients, each[blocks[name], :, field]) for each in (first, second))
        return material.stress(second_order_strain(*pair))

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
