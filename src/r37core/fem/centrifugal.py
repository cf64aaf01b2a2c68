"""Centrifugal terms: the static load of rotation and the geometric stiffness of the stress it causes.

The rotor axis is z. Everything here is per Omega^2: in the linear theory the centrifugal stress, and with it the
geometric stiffness, is proportional to the square of the speed.
"""

from __future__ import annotations

import numpy as np

from .assembly import Blocks, NodePattern, typed_blocks
from .material import Material
from .stress import stress_at


def centrifugal_load(blocks: Blocks, points: np.ndarray, density: float) -> np.ndarray:
    """Nodal forces of rotation per Omega^2 (N s2/rad2), shape (nodes, 3): integral of density N (x, y, 0)."""
    load = np.zeros_like(points)
    for name, element, coordinates in typed_blocks(blocks, points):
        rule_points, rule_weights = element.mass_rule
        values = element.shape_functions(rule_points)
        determinant = np.linalg.det(element.jacobian(coordinates, rule_points))
        arm = np.einsum("qa,eai->eqi", values, coordinates) * np.array([1.0, 1.0, 0.0])
        forces = np.einsum("qa,eqi,eq->eai", values, arm, density * determinant * rule_weights, optimize=True)
        for i in range(3):
            load[:, i] += np.bincount(blocks[name].ravel(), weights=forces[:, :, i].ravel(), minlength=len(points))
    return load


def assemble_geometric_stiffness(
    pattern: NodePattern, blocks: Blocks, points: np.ndarray, material: Material, displacement: np.ndarray
) -> np.ndarray:
    """Geometric stiffness of each node pair (N/m per unit of the load), shape (pairs,), times the 3 x 3 identity.

    `displacement`: static displacement, shape (nodes, 3), whose linear stress S enters as the integral of
    grad N_a . S grad N_b (Zienkiewicz and Taylor, The Finite Element Method, initial-stress matrix).
    """
    geometric = np.zeros(len(pattern.indices))
    for name, element, coordinates in typed_blocks(blocks, points):
        rule_points, rule_weights = element.stiffness_rule
        gradients, determinant = element.physical_gradients(coordinates, rule_points)
        pulled = gradients @ stress_at(gradients, displacement[blocks[name]], material)
        weighted = gradients * (determinant * rule_weights)[:, :, None, None]
        flat = (len(coordinates), len(element.nodes), -1)
        left, right = (part.transpose(0, 2, 1, 3).reshape(flat) for part in (weighted, pulled))
        geometric += pattern.scatter(name, left @ right.transpose(0, 2, 1))
    return geometric
