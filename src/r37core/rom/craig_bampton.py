"""Craig-Bampton reduction over several speeds.

Sources: R. R. Craig and M. C. C. Bampton, AIAA Journal 6 (1968) 1313; A. Sternchuess and E. Balmes, "On the reduction
of quasi-cyclic disks with variable rotation speeds" (2006), for the combination of bases computed at several speeds.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from r37core.fem.solver import Solve, factorise, lowest_modes

from .reduction_choice import ReductionChoice


@dataclass(frozen=True)
class MultiSpeedBasis:
    """A reduction basis whose first coordinates are the boundary displacements themselves.

    `vectors`, shape (dofs, boundary dofs + internal): constraint modes at rest, then internal vectors that vanish on the
    boundary and are mass-orthonormal. `singular_values`: of the columns computed over all speeds, one for each, normalised.
    """

    vectors: np.ndarray
    singular_values: np.ndarray


def multi_speed_basis(
    stiffness_at: Callable[[float], sp.csr_array],
    mass: sp.csr_array,
    boundary_dofs: np.ndarray,
    choice: ReductionChoice,
    solve_at_rest: Solve | None = None,
    load: np.ndarray | None = None,
) -> tuple[MultiSpeedBasis, np.ndarray]:
    """Constraint modes and fixed-interface modes at each of the choice's speeds, combined into one basis.

    `stiffness_at` gives the stiffness at a speed (rad/s); `solve_at_rest` solves with that at rest, where the caller has its
    factors. The first speed's constraint modes stay as they are, so that static responses to boundary loads at that speed
    are exact. Also, from the same factors, the displacements (m) under a `load` (N), shape (dofs, speeds); none without it.
    """
    columns: list[np.ndarray] = []
    displaced = np.empty((mass.shape[0], 0 if load is None else len(choice.speeds)))
    for number, speed in enumerate(choice.speeds):
        stiffness = stiffness_at(speed)
        solve = solve_at_rest if solve_at_rest and not speed else factorise(stiffness)
        columns += constraint_and_fixed_modes(stiffness, mass, boundary_dofs, choice.fixed_interface_modes, solve)
        if load is not None:
            displaced[:, number] = solve(load)
    return combine_columns(columns[0], np.hstack(columns), mass, boundary_dofs, choice.basis_tolerance), displaced


def combine_columns(
    constraint_modes: np.ndarray, columns: np.ndarray, mass: sp.csr_array, boundary_dofs: np.ndarray, tolerance: float
) -> MultiSpeedBasis:
    """Basis spanning `columns`, shape (dofs, columns): `constraint_modes` as they are, then internal vectors.

    Columns with singular values below `tolerance` times the largest are dropped as numerically dependent. Neither the order
    nor the scale of the columns matters.
    """
    internal, singular_values = _internal_vectors(columns, mass, boundary_dofs, tolerance)
    return MultiSpeedBasis(np.hstack([constraint_modes, internal]), singular_values)


def constraint_and_fixed_modes(
    stiffness: sp.csr_array, mass: sp.csr_array, boundary_dofs: np.ndarray, count: int, solve: Solve | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Constraint modes, shape (dofs, boundary dofs), and `count` fixed-interface modes, shape (dofs, count).

    Both come from factors of the whole stiffness, `solve` if the caller has them: forces on the boundary b that bring it back
    to zero hold it. With F the displacements by unit forces there, Psi = F F_b^-1 and u_held = u - Psi u_b.
    """
    solve = solve or factorise(stiffness)
    forces = np.zeros((mass.shape[0], len(boundary_dofs)))
    forces[boundary_dofs] = np.eye(len(boundary_dofs))
    flexibility = solve(forces)
    constraint = la.solve(flexibility[boundary_dofs].T, flexibility.T).T
    constraint[boundary_dofs] = np.eye(len(boundary_dofs))

    def solve_held(load: np.ndarray) -> np.ndarray:
        displacement = solve(load)
        return displacement - constraint @ displacement[boundary_dofs]

    return constraint, lowest_modes(stiffness, mass, count, solve_held)[1]


def _internal_vectors(
    columns: np.ndarray, mass: sp.csr_array, boundary_dofs: np.ndarray, tolerance: float
) -> tuple[np.ndarray, np.ndarray]:
    """Mass-orthonormal vectors that vanish on the boundary and, with the constraint modes, span the columns.

    Dependence is judged by a singular value decomposition of the columns, each scaled to unit length and the rows by
    the root of the nodal mass, so that neither the scale nor the order of the columns nor the mesh's density matters.
    """
    weight = np.sqrt(mass.diagonal())[:, None]
    weighted = weight * columns
    weighted /= np.linalg.norm(weighted, axis=0)
    left, singular_values, _ = la.svd(weighted, full_matrices=False)
    kept = left[:, singular_values > tolerance * singular_values[0]] / weight
    free = kept @ la.null_space(kept[boundary_dofs])
    free[boundary_dofs] = 0.0
    factor = la.cholesky(free.T @ (mass @ free), lower=True)
    return la.solve_triangular(factor, free.T, lower=True).T, singular_values
