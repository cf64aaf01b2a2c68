"""The finite-element matrices of one blade, as later stages use them.

The rotor axis is z. Centrifugal terms are per Omega^2: in the linear theory the centrifugal stress, and with it the geometric
stiffness, is proportional to the square of the speed.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.mesh.blade_mesh import BladeMesh

from .assembly import (
    Blocks,
    NodePattern,
    assemble_mass,
    assemble_stiffness,
    block_matrix,
    mass_points,
    nodal_sums,
    stiffness_points,
)
from .material import Material
from .sector import Sector
from .solver import Solve, factorise
from .stress import stress_at

_SPIN_PLANE = np.diag([1.0, 1.0, 0.0])


@dataclass(frozen=True)
class StructuralMatrices:
    """Matrices over node pairs; the methods return sparse matrices over the unclamped degrees of freedom (x y z per node).

    `indptr`, `indices`: pattern of node pairs; `stiffness_blocks` (N/m), shape (pairs, 3, 3); `mass_pairs` (kg) and
    `geometric_pairs` (N/m per rad2/s2), shape (pairs,), both times the identity; `centrifugal_load`: nodal forces of rotation
    per Omega^2 (N s2/rad2), shape (nodes, 3); `free_nodes`: unclamped node numbers.
    """

    indptr: ndarray
    indices: ndarray
    stiffness_blocks: ndarray
    mass_pairs: ndarray
    geometric_pairs: ndarray
    centrifugal_load: ndarray
    free_nodes: ndarray

    @property
    def total_mass(self) -> float:
        """Mass of the blade (kg)."""
        return float(np.sum(self.mass_pairs))

    def stiffness(self) -> csr_array:
        """Elastic stiffness (N/m)."""
        pairs = self._free_pairs
        return block_matrix(pairs.indptr, pairs.indices, self.stiffness_blocks[pairs.data])

    def whole(self, free: ndarray) -> ndarray:
        """Field of all nodes, shape (nodes, 3, ...), from the unclamped degrees of freedom, shape (dofs, ...); 0 elsewhere."""
        field = np.zeros((len(self.indptr) - 1, 3, *free.shape[1:]))
        field[self.free_nodes] = free.reshape(-1, *field.shape[1:])
        return field

    def free(self, field: ndarray) -> ndarray:
        """The unclamped degrees of freedom, shape (dofs,), of a field of all nodes, shape (nodes, 3)."""
        return field[self.free_nodes].ravel()

    @property
    def free_load(self) -> ndarray:
        """Centrifugal load per Omega^2 (N s2/rad2) on the unclamped degrees of freedom, shape (dofs,)."""
        return self.free(self.centrifugal_load)

    def displaced_by(self, load: ndarray) -> ndarray:
        """Displacement (m), shape (nodes, 3), of the blade at rest under nodal forces (N), shape (nodes, 3)."""
        return self.whole(self.solve_at_rest(self.free(load)))

    @cached_property
    def solve_at_rest(self) -> Solve:
        """Displacements (m) of the unclamped degrees of freedom under forces (N) on them; factorised at the first call."""
        return factorise(self.stiffness())

    def mass(self) -> csr_array:
        """Consistent mass (kg)."""
        return self._free(self.mass_pairs, np.eye(3))

    def geometric_stiffness(self) -> csr_array:
        """Geometric stiffness per Omega^2 (N/m per rad2/s2)."""
        return self._free(self.geometric_pairs, np.eye(3))

    def spin_softening(self) -> csr_array:
        """Spin softening per Omega^2 (kg): minus the mass of the motion normal to the axis; added to the stiffness."""
        return self._free(-self.mass_pairs, _SPIN_PLANE)

    @cached_property
    def _free_pairs(self) -> csr_array:
        """Mask of the pairs that join unclamped nodes, in the rows and columns of these."""
        pairs = csr_array((np.arange(len(self.indices)), self.indices, self.indptr))
        return pairs[self.free_nodes][:, self.free_nodes]

    def _free(self, values: ndarray, axes: ndarray) -> csr_array:
        """The matrix whose blocks are `values` of the pairs, shape (pairs,), times `axes`, shape (3, 3)."""
        pairs = self._free_pairs
        return csr_array(sp.kron(csr_array((values[pairs.data], pairs.indices, pairs.indptr)), sp.coo_array(axes)))


def assemble(mesh: BladeMesh, material: Material) -> StructuralMatrices:
    """Assemble the matrices of a mesh clamped at its root, with the geometric stiffness of the centrifugal stress.

    The static displacement under rotation comes from the elastic stiffness at rest (linear theory); of a sector of a disc it
    is that of the disc.
    """
    blocks, points = mesh.blocks, mesh.points
    pattern = NodePattern.build(blocks, len(points))
    matrices = StructuralMatrices(
        indptr=pattern.indptr,
        indices=pattern.indices,
        stiffness_blocks=assemble_stiffness(pattern, blocks, points, material),
        mass_pairs=assemble_mass(pattern, blocks, points, material.density),
        geometric_pairs=np.zeros(len(pattern.indices)),
        centrifugal_load=centrifugal_load(blocks, points, material.density),
        free_nodes=mesh.free_nodes,
    )
    if mesh.cyclic is None:
        displacement = matrices.displaced_by(matrices.centrifugal_load)
    else:
        displacement = matrices.whole(Sector.of(mesh).displaced(matrices.stiffness(), matrices.free_load))
    # in place: the factors of the stiffness, a third of the work of a reduction, are kept for it
    matrices.geometric_pairs[:] = assemble_geometric_stiffness(pattern, blocks, points, material, displacement)
    return matrices


def centrifugal_load(blocks: Blocks, points: ndarray, density: float) -> ndarray:
    """Nodal forces of rotation per Omega^2 (N s2/rad2), shape (nodes, 3): integral of density N (x, y, 0)."""
    load = np.zeros_like(points)
    for name, values, determinant, weights in mass_points(blocks, points):
        arm = np.einsum("qa,eai->eqi", values, points[blocks[name]]) * np.array([1.0, 1.0, 0.0])
        forces = np.einsum("qa,eqi,eq->eai", values, arm, density * determinant * weights, optimize=True)
        load += nodal_sums(blocks[name], forces, len(points))
    return load


def assemble_geometric_stiffness(
    pattern: NodePattern, blocks: Blocks, points: ndarray, material: Material, displacement: ndarray
) -> ndarray:
    """Geometric stiffness of each node pair (N/m per unit of the load), shape (pairs,), times the 3 x 3 identity.

    `displacement`: static displacement, shape (nodes, 3), whose linear stress S enters as the integral of
    grad N_a . S grad N_b (Zienkiewicz and Taylor, The Finite Element Method, initial-stress matrix).
    """
    geometric = np.zeros(len(pattern.indices))
    for name, gradients, volumes in stiffness_points(blocks, points):
        pulled = gradients @ stress_at(gradients, displacement[blocks[name]], material)
        weighted = gradients * volumes[:, :, None, None]
        flat = (len(gradients), gradients.shape[2], -1)
        left, right = (part.transpose(0, 2, 1, 3).reshape(flat) for part in (weighted, pulled))
        geometric += pattern.scatter(name, left @ right.transpose(0, 2, 1))
    return geometric
