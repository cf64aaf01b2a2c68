"""Linear elastic stress from nodal displacements."""

from __future__ import annotations

import numpy as np

from .material import Material


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
