"""Stiffness and mass matrices of a mesh, assembled node by node without a Python loop over elements.

All matrices share one sparsity pattern of node pairs. The stiffness has a 3 x 3 block on each pair; the consistent
mass and the geometric stiffness are a scalar times the identity there, and are kept as that scalar. A mesh is given as
`blocks`: name of an element type -> node numbers, shape (elements, nodes of the type).
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np
import scipy.sparse as sp
from numpy import ndarray
from scipy.sparse import csr_array

from .elements import ELEMENTS, Element
from .material import Material

Blocks = Mapping[str, ndarray]


@dataclass(frozen=True)
class NodePattern:
    """Sparsity pattern of node pairs in compressed rows.

    `slots`: for each element type, shape (elements, n, n), where the pair (a, b) of an element's nodes is stored.
    """

    indptr: ndarray
    indices: ndarray
    slots: Mapping[str, ndarray]

    @classmethod
    def build(cls, blocks: Blocks, nodes: int) -> Self:
        """The pattern of a mesh with `nodes` nodes."""
        pairs = {name: block[:, :, None].astype(np.int64) * nodes + block[:, None, :] for name, block in blocks.items()}
        unique, slot = np.unique(np.concatenate([part.ravel() for part in pairs.values()]), return_inverse=True)
        rows = np.bincount(unique // nodes, minlength=nodes)
        indptr = np.concatenate([[0], np.cumsum(rows)]).astype(np.int32)
        ends = np.cumsum([part.size for part in pairs.values()])
        parts = zip(pairs.items(), np.split(slot.ravel(), ends[:-1]), strict=True)
        return cls(
            indptr,
            (unique % nodes).astype(np.int32),
            {name: part.reshape(pairs_of_type.shape) for (name, pairs_of_type), part in parts},
        )

    def scatter(self, name: str, values: ndarray) -> ndarray:
        """Sum values of the elements of one type, shape (elements, n, n), into the pattern's entries, shape (pairs,)."""
        return np.bincount(self.slots[name].ravel(), weights=values.ravel(), minlength=len(self.indices))


def typed_blocks(blocks: Blocks, points: ndarray) -> Iterator[tuple[str, Element, ndarray]]:
    """Name, element and node coordinates, shape (elements, n, 3), of each block of a mesh with nodes at `points`."""
    for name, nodes in blocks.items():
        yield name, ELEMENTS[name], points[nodes]


def stiffness_points(blocks: Blocks, points: ndarray) -> Iterator[tuple[str, ndarray, ndarray]]:
    """Points that integrate the stiffness of each block, by its name.

    Gradients of the shape functions there, shape (elements, points, n, 3), and volumes (m3), shape (elements, points).
    """
    for name, element, coordinates in typed_blocks(blocks, points):
        rule_points, rule_weights = element.stiffness_rule
        gradients, determinant = element.physical_gradients(coordinates, rule_points)
        yield name, gradients, determinant * rule_weights


def mass_points(blocks: Blocks, points: ndarray) -> Iterator[tuple[str, ndarray, ndarray, ndarray]]:
    """Points that integrate the mass of each block, by its name.

    Shape functions there, shape (points, n), determinants of the elements' Jacobians, shape (elements, points), and weights.
    """
    for name, element, coordinates in typed_blocks(blocks, points):
        rule_points, rule_weights = element.mass_rule
        determinant = np.linalg.det(element.jacobian(coordinates, rule_points))
        yield name, element.shape_functions(rule_points), determinant, rule_weights


def nodal_sums(nodes: ndarray, values: ndarray, count: int) -> ndarray:
    """Sums, shape (count, 3), of the `values`, shape (elements, n, 3), that elements have at their `nodes`, (elements, n)."""
    axes = np.moveaxis(values, 2, 0)
    return np.stack([np.bincount(nodes.ravel(), weights=part.ravel(), minlength=count) for part in axes], axis=1)


def assemble_stiffness(pattern: NodePattern, blocks: Blocks, points: ndarray, material: Material) -> ndarray:
    """Linear elastic stiffness as 3 x 3 blocks (N/m), shape (pairs, 3, 3).

    With H_ij = integral of dN_a/dx_i dN_b/dx_j, block (a, b) is lambda H_ij + mu H_ji + mu trace(H) delta_ij
    (Hooke's law for an isotropic solid, in Lame's constants).
    """
    lame, shear = material.lame_constants
    stiffness = np.zeros((len(pattern.indices), 3, 3))
    for name, gradients, volumes in stiffness_points(blocks, points):
        size = gradients.shape[2]
        flat = gradients.reshape(*volumes.shape, 3 * size)
        weighted = flat * volumes[:, :, None]
        products = (flat.transpose(0, 2, 1) @ weighted).reshape(-1, size, 3, size, 3)
        trace = np.einsum("eakbk->eab", products)
        for i in range(3):
            for j in range(3):
                entry = lame * products[:, :, i, :, j] + shear * products[:, :, j, :, i]
                stiffness[:, i, j] += pattern.scatter(name, entry + shear * trace if i == j else entry)
    return stiffness


def assemble_mass(pattern: NodePattern, blocks: Blocks, points: ndarray, density: float) -> ndarray:
    """Consistent mass of each node pair (kg), shape (pairs,); the matrix is this times the 3 x 3 identity."""
    mass = np.zeros(len(pattern.indices))
    for name, values, determinant, weights in mass_points(blocks, points):
        products = np.einsum("qa,qb->qab", values, values).reshape(len(weights), -1)
        mass += pattern.scatter(name, density * (determinant * weights) @ products)
    return mass


def mesh_volume(blocks: Blocks, points: ndarray) -> float:
    """Volume (m3) of a mesh with nodes at `points`, by the quadrature of the mass."""
    return sum(float(np.sum(determinant * weights)) for *_, determinant, weights in mass_points(blocks, points))


def block_matrix(pattern_indptr: ndarray, pattern_indices: ndarray, blocks: ndarray) -> csr_array:
    """Sparse matrix over all degrees of freedom (3 per node, x y z) from 3 x 3 blocks, shape (pairs, 3, 3)."""
    size = 3 * (len(pattern_indptr) - 1)
    return csr_array(sp.bsr_array((blocks, pattern_indices, pattern_indptr), shape=(size, size)))
