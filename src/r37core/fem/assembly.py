"""Stiffness and mass matrices of a mesh of wedges, assembled node by node without a Python loop over elements.

All matrices share one sparsity pattern of node pairs. The stiffness has a 3 x 3 block on each pair; the consistent
mass and the geometric stiffness are a scalar times the identity there, and are kept as that scalar.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .material import Material
from .wedge15 import MASS_RULE, STIFFNESS_RULE, physical_gradients, shape_functions


@dataclass(frozen=True)
class NodePattern:
    """Sparsity pattern of node pairs in compressed rows.

    `slot`, shape (elements, 15, 15), says where the pair (a, b) of an element's nodes is stored.
    """

    indptr: np.ndarray
    indices: np.ndarray
    slot: np.ndarray

    @classmethod
    def of(cls, elements: np.ndarray, nodes: int) -> NodePattern:
        """The pattern of a mesh with `nodes` nodes; `elements` has shape (elements, 15)."""
        pairs = elements[:, :, None].astype(np.int64) * nodes + elements[:, None, :]
        unique, slot = np.unique(pairs, return_inverse=True)
        rows = np.bincount(unique // nodes, minlength=nodes)
        indptr = np.concatenate([[0], np.cumsum(rows)]).astype(np.int32)
        return cls(indptr, (unique % nodes).astype(np.int32), slot.reshape(pairs.shape))

    def scatter(self, values: np.ndarray) -> np.ndarray:
        """Sum element values, shape (elements, 15, 15), into the pattern's entries, shape (pairs,)."""
        return np.bincount(self.slot.ravel(), weights=values.ravel(), minlength=len(self.indices))


def assemble_stiffness(pattern: NodePattern, elements: np.ndarray, points: np.ndarray, material: Material) -> np.ndarray:
    """Linear elastic stiffness as 3 x 3 blocks (N/m), shape (pairs, 3, 3).

    With H_ij = integral of dN_a/dx_i dN_b/dx_j, block (a, b) is lambda H_ij + mu H_ji + mu trace(H) delta_ij
    (Hooke's law for an isotropic solid, in Lame's constants).
    """
    lame, shear = material.lame_constants
    rule_points, rule_weights = STIFFNESS_RULE
    blocks = np.empty((len(pattern.indices), 3, 3))
    gradients, determinant = physical_gradients(points[elements], rule_points)
    flat = gradients.reshape(len(elements), len(rule_weights), 45)
    weighted = flat * (determinant * rule_weights)[:, :, None]
    products = (flat.transpose(0, 2, 1) @ weighted).reshape(-1, 15, 3, 15, 3)
    trace = np.einsum("eakbk->eab", products)
    for i in range(3):
        for j in range(3):
            entry = lame * products[:, :, i, :, j] + shear * products[:, :, j, :, i]
            blocks[:, i, j] = pattern.scatter(entry + shear * trace if i == j else entry)
    return blocks


def assemble_mass(pattern: NodePattern, elements: np.ndarray, points: np.ndarray, density: float) -> np.ndarray:
    """Consistent mass of each node pair (kg), shape (pairs,); the matrix is this times the 3 x 3 identity."""
    rule_points, rule_weights = MASS_RULE
    values = shape_functions(rule_points)
    _, determinant = physical_gradients(points[elements], rule_points)
    products = np.einsum("qa,qb->qab", values, values).reshape(len(rule_weights), -1)
    element_mass = density * (determinant * rule_weights) @ products
    return pattern.scatter(element_mass.reshape(-1, 15, 15))


def block_matrix(pattern_indptr: np.ndarray, pattern_indices: np.ndarray, blocks: np.ndarray) -> sp.csr_array:
    """Sparse matrix over all degrees of freedom (3 per node, x y z) from 3 x 3 blocks, shape (pairs, 3, 3)."""
    size = 3 * (len(pattern_indptr) - 1)
    return sp.csr_array(sp.bsr_array((blocks, pattern_indices, pattern_indptr), shape=(size, size)))
