r"""Elastic forces of a solid at large displacement, and all their derivatives: they are a cubic of the displacement.

Total Lagrangian, of a linear elastic solid (St. Venant and Kirchhoff): with H_ij = du_i/dX_j and F = I + H

    E = (H + H^T + H^T H)/2,    S = lambda tr(E) I + 2 mu E,    f_a = \int F S grad N_a dV.

Source: Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, chapters 3 and 9. With no displacement the
tangent is the stiffness of r37core.fem.assembly: the quadrature is the same.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy import ndarray

from .assembly import Blocks, NodePattern, nodal_sums, stiffness_points
from .material import Material
from .stress import displacement_gradient, green_strain, second_order_strain


@dataclass(frozen=True, eq=False)
class LargeDisplacement:
    """Forces of a solid of `material` with nodes at `points` (m), shape (nodes, 3), that are displaced far.

    Displacements (m) and forces (N) have the shape (nodes, 3).
    """

    blocks: Blocks
    points: ndarray
    material: Material

    @cached_property
    def _gradients(self) -> dict[str, tuple[ndarray, ndarray]]:
        """Gradients of the shape functions, shape (elements, points, n, 3), and volumes of the points, by element type."""
        parts = stiffness_points(self.blocks, self.points)
        return {name: (gradients, volumes) for name, gradients, volumes in parts}

    def forces(self, displacement: ndarray) -> ndarray:
        """Elastic forces of a displacement."""

        def first_piola(name: str) -> ndarray:
            slope = self._slope(name, displacement)
            return (np.eye(3) + slope) @ self.material.stress(green_strain(slope))

        return self._nodal(first_piola)

    def second_derivative(self, displacement: ndarray, first: ndarray, second: ndarray) -> ndarray:
        """Second derivative of the forces at a displacement, along two others."""

        def first_piola(name: str) -> ndarray:
            along = [self._slope(name, field) for field in (first, second)]
            deformation = np.eye(3) + self._slope(name, displacement)
            total = deformation @ self.material.stress(second_order_strain(*along))
            for slope, other in (along, along[::-1]):
                total = total + slope @ self.material.stress(second_order_strain(deformation, other))
            return total

        return self._nodal(first_piola)

    def series(self, displacement: ndarray, order: int, next_term: Callable[[int, ndarray], ndarray]) -> list[ndarray]:
        """Terms u_1 to u_order of displacements u_0 + a u_1 + a^2 u_2 + ..., from a `displacement` u_0 on.

        `next_term` gives u_n from n and the forces with a^n but for those of u_n itself, the tangent at u_0 times u_n.
        """
        slopes, stresses = {}, {}
        for name in self._gradients:
            slope = self._slope(name, displacement)
            slopes[name] = [np.eye(3) + slope]
            stresses[name] = [self.material.stress(green_strain(slope))]
        terms: list[ndarray] = []
        for n in range(1, order + 1):
            known = {}
            for name, along in slopes.items():
                pairs = range(1, n)
                strain = 0.5 * sum((along[i].swapaxes(-1, -2) @ along[n - i] for i in pairs), np.zeros_like(along[0]))
                known[name] = self.material.stress(strain)

            def first_piola(name: str, n: int = n, known: dict[str, ndarray] = known) -> ndarray:
                along, stress = slopes[name], stresses[name]
                return along[0] @ known[name] + sum((along[i] @ stress[n - i] for i in range(1, n)), np.zeros_like(along[0]))

            terms.append(next_term(n, self._nodal(first_piola)))
            for name, along in slopes.items():
                slope = self._slope(name, terms[-1])
                stresses[name].append(known[name] + self.material.stress(second_order_strain(along[0], slope)))
                along.append(slope)
        return terms

    def strain_energies(self, pairs: Sequence[tuple[ndarray, ndarray]]) -> ndarray:
        """Integrals (J) of E_p : C : E_q over the solid, shape (pairs, pairs), of the strains of second order of some pairs.

        E = (A^T B + B^T A)/2, with the slopes A and B of a pair of displacements (m). The third derivative of the forces along
        a, b and c, times d, is the sum of those of da and bc, db and ca, dc and ab.
        """
        energies = np.zeros((len(pairs),) * 2)
        for name, (_, volumes) in self._gradients.items():
            strains = [second_order_strain(*(self._slope(name, field) for field in pair)) for pair in pairs]
            stresses = [self.material.stress(strain) * volumes[:, :, None, None] for strain in strains]
            energies += np.array([[np.vdot(strain, stress) for stress in stresses] for strain in strains])
        return 0.5 * (energies + energies.T)

    def tangent(self, displacement: ndarray, pattern: NodePattern) -> ndarray:
        """Tangent stiffness (N/m) at a displacement as blocks of the pattern's node pairs, shape (pairs, 3, 3).

        With g_a = grad N_a, block (a, b) is the integral of lambda (F g_a)(F g_b)^T + mu (F g_b)(F g_a)^T
        + mu (g_a . g_b) F F^T + (g_a . S g_b) I.
        """
        lame, shear = self.material.lame_constants
        blocks = np.zeros((len(pattern.indices), 3, 3))
        for name, (gradients, volumes) in self._gradients.items():
            slope = self._slope(name, displacement)
            deformation = np.eye(3) + slope
            stress = self.material.stress(green_strain(slope))
            # (elements, n, points, 3), so that sums over points and one axis are products of matrices
            still, pushed = gradients, gradients @ deformation.swapaxes(-1, -2)
            size = gradients.shape[2]

            def products(left: ndarray, right: ndarray, volumes: ndarray = volumes, size: int = size) -> ndarray:
                weighted = (left * volumes[:, :, None, None]).reshape(len(left), len(volumes[0]), -1)
                flat = weighted.transpose(0, 2, 1) @ right.reshape(len(left), len(volumes[0]), -1)
                return flat.reshape(-1, size, left.shape[-1], size, right.shape[-1])

            outer = products(pushed, pushed)
            initial = np.einsum("eakbk->eab", products(still, still @ stress))
            left_cauchy_green = deformation @ deformation.swapaxes(-1, -2)
            for i in range(3):
                for j in range(3):
                    entry = lame * outer[:, :, i, :, j] + shear * outer[:, :, j, :, i]
                    scaled = still * left_cauchy_green[:, :, i, j, None, None]
                    entry = entry + shear * np.einsum("eakbk->eab", products(scaled, still))
                    blocks[:, i, j] += pattern.scatter(name, entry + initial if i == j else entry)
        return blocks

    def _slope(self, name: str, displacement: ndarray) -> ndarray:
        """Derivatives H_ij of a displacement at the points of a type's elements, shape (elements, points, 3, 3)."""
        return displacement_gradient(self._gradients[name][0], displacement[self.blocks[name]])

    def _nodal(self, first_piola: Callable[[str], ndarray]) -> ndarray:
        """Nodal forces of a stress, as first_piola(name of a type) gives it at the points of its elements."""
        forces = np.zeros_like(self.points)
        for name, (gradients, volumes) in self._gradients.items():
            stress = first_piola(name) * volumes[:, :, None, None]
            nodal = np.einsum("eqij,eqaj->eai", stress, gradients, optimize=True)
            forces += nodal_sums(self.blocks[name], nodal, len(forces))
        return forces
