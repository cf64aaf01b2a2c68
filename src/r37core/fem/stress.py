"""Linear elastic stress from nodal displacements."""

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
    lame, shear = material.lame_constants
    displacement_gradient = displacement.transpose(0, 2, 1)[:, None] @ gradients
    strain = 0.5 * (displacement_gradient + displacement_gradient.transpose(0, 1, 3, 2))
    trace = np.trace(strain, axis1=2, axis2=3)
    return 2.0 * shear * strain + lame * trace[:, :, None, None] * np.eye(3)


def nodal_stress(blocks: Blocks, points: np.ndarray, displacement: np.ndarray, material: Material) -> np.ndarray:
    """Stress at the nodes (Pa), shape (6, nodes, fields), components as in COMPONENTS; 0 at nodes of no element.

    `displacement` (m), shape (nodes, 3, fields), of nodes at `points` (m). Each element's linear stress is evaluated at its own
    nodes, where bending stress is largest, and averaged over the elements that share the node.
    """
    stress = np.zeros((len(COMPONENTS), len(points), displacement.shape[2]))
    count = np.zeros(len(points))
    for name, element, coordinates in typed_blocks(blocks, points):
        members = blocks[name].ravel()
        count += np.bincount(members, minlength=len(points))
        gradients, _ = element.physical_gradients(coordinates, element.nodes)
        for j in range(displacement.shape[2]):
            field_stress = stress_at(gradients, displacement[blocks[name], :, j], material)
            for component, (a, b) in enumerate(COMPONENTS):
                weights = field_stress[:, :, a, b].ravel()
                stress[component, :, j] += np.bincount(members, weights=weights, minlength=len(points))
    return stress / np.maximum(count, 1.0)[:, None]
