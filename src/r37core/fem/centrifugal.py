"""Centrifugal terms: the static load of rotation and the geometric stiffness of the stress it causes.

The rotor axis is z. Everything here is per Omega^2: in the linear theory the centrifugal stress, and with it the
geometric stiffness, is proportional to the square of the speed.
"""

from __future__ import annotations

import numpy as np

from .assembly import NodePattern
from .material import Material
from .stress import stress_at
from .wedge15 import MASS_RULE, STIFFNESS_RULE, physical_gradients, shape_functions


def centrifugal_load(elements: np.ndarray, points: np.ndarray, density: float) -> np.ndarray:
    """Nodal forces of rotation per Omega^2 (N s2/rad2), shape (nodes, 3): integral of density N (x, y, 0)."""
    rule_points, rule_weights = MASS_RULE
    values = shape_functions(rule_points)
    coordinates = points[elements]
    _, determinant = physical_gradients(coordinates, rule_points)
    arm = np.einsum("qa,eai->eqi", values, coordinates) * np.array([1.0, 1.0, 0.0])
    element_load = np.einsum("qa,eqi,eq->eai", values, arm, density * determinant * rule_weights, optimize=True)
    load = np.zeros_like(points)
    for i in range(3):
        load[:, i] = np.bincount(elements.ravel(), weights=element_load[:, :, i].ravel(), minlength=len(points))
    return load


def assemble_geometric_stiffness(
    pattern: NodePattern, elements: np.ndarray, points: np.ndarray, material: Material, displacement: np.ndarray
) -> np.ndarray:
    """Geometric stiffness of each node pair (N/m per unit of the load), shape (pairs,), times the 3 x 3 identity.

    `displacement`: static displacement, shape (nodes, 3), whose linear stress S enters as the integral of
    grad N_a . S grad N_b (Zienkiewicz and Taylor, The Finite Element Method, initial-stress matrix).
    """
    rule_points, rule_weights = STIFFNESS_RULE
    gradients, determinant = physical_gradients(points[elements], rule_points)
    stress = stress_at(gradients, displacement[elements], material)
    pulled = gradients @ stress
    weighted = gradients * (determinant * rule_weights)[:, :, None, None]
    flat = (len(elements), len(rule_weights), 15, 3)
    left = weighted.reshape(flat).transpose(0, 2, 1, 3).reshape(len(elements), 15, -1)
    right = pulled.transpose(0, 2, 1, 3).reshape(len(elements), 15, -1)
    return pattern.scatter(left @ right.transpose(0, 2, 1))
