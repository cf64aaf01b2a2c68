"""Craig-Bampton reduction over several speeds.

Sources: R. R. Craig and M. C. C. Bampton, AIAA Journal 6 (1968) 1313; A. Sternchuess and E. Balmes, "On the reduction
of quasi-cyclic disks with variable rotation speeds" (2006), for the combination of bases computed at several speeds.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np
import scipy.linalg as la
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.fem.solver import Solve, factorise, lowest_modes

from .reduction_choice import ReductionChoice


class StateAtSpeed(NamedTuple):
    """A blade at a `speed` (rad/s): its `stiffness` (N/m) between unclamped degrees of freedom, and factors of it."""

    speed: float
    stiffness: csr_array
    solve: Solve


def multi_speed_basis(
    states: Iterable[StateAtSpeed],
    mass: csr_array,
    boundary: csr_array,
    reduction: ReductionChoice,
    further: Callable[[StateAtSpeed], ndarray | None] | None = None,
) -> tuple[ndarray, ndarray]:
    """Constraint modes and fixed-interface modes in each of the states, as one basis: see combine_columns.

    `boundary`, shape (boundary coordinates, dofs): each row gives one of them from the displacements, by a 1 or by weights.
    The first state's constraint modes stay as they are, so that static responses to boundary loads are exact there. `further`:
    more columns of a state, shape (dofs, columns), or none.
    """
    columns: list[ndarray] = []
    for state in states:
        columns += constraint_and_fixed_modes(state.stiffness, mass, boundary, reduction.fixed_interface_modes, state.solve)
        if further is not None and (more := further(state)) is not None:
            columns.append(more)
    return combine_columns(columns[0], np.hstack(columns), mass, boundary, reduction.basis_tolerance)


def combine_columns(
    constraint_modes: ndarray, columns: ndarray, mass: csr_array, boundary: csr_array, tolerance: float
) -> tuple[ndarray, ndarray]:
    """Basis of `columns`, shape (dofs, columns), and their normalised singular values, shape (columns,).

    The basis, shape (dofs, boundary coordinates + internal): `constraint_modes` as they are, whose coordinates are those of the
    boundary, then internal vectors that vanish there and are mass-orthonormal. Columns with singular values below `tolerance`
    times the largest are dropped as numerically dependent. Each is scaled to unit length and the rows by the root of the nodal
    mass, so that neither the scale nor the order of the columns nor the mesh's density matters.
    """
    weight = np.sqrt(mass.diagonal())[:, None]
    weighted = weight * columns
    weighted /= np.linalg.norm(weighted, axis=0)
    left, singular_values, _ = la.svd(weighted, full_matrices=False)
    independent = left[:, singular_values > tolerance * singular_values[0]] / weight
    free = independent @ la.null_space(boundary @ independent)
    free[_alone(boundary)] = 0.0
    factor = la.cholesky(free.T @ (mass @ free), lower=True)
    internal = la.solve_triangular(factor, free.T, lower=True).T
    return np.hstack([constraint_modes, internal]), singular_values


def constraint_and_fixed_modes(
    stiffness: csr_array, mass: csr_array, boundary: csr_array, count: int, solve: Solve | None = None
) -> tuple[ndarray, ndarray]:
    """Constraint modes, shape (dofs, boundary coordinates), and `count` fixed-interface modes, shape (dofs, count).

    Both come from factors of the whole stiffness, `solve` if the caller has them: forces on the boundary u_b = B u that bring
    it back to zero hold it. With F = K^-1 B^T the displacements by unit forces there, Psi = F (B F)^-1 and
    u_held = u - Psi B u. Where u_b are weighted means the forces are spread by the same weights.
    """
    solve = solve or factorise(stiffness)
    flexibility = solve(boundary.T.toarray())
    constraint = la.solve((boundary @ flexibility).T, flexibility.T).T
    alone = _alone(boundary)
    constraint[alone] = boundary[:, alone].toarray().T

    def solve_held(load: ndarray) -> ndarray:
        displacement = solve(load)
        return displacement - constraint @ (boundary @ displacement)

    return constraint, lowest_modes(stiffness, mass, count, solve_held)[1]


def projected(matrix: csr_array, vectors: ndarray) -> ndarray:
    """A symmetric matrix in the coordinates of the basis `vectors`, symmetric to the bit."""
    return symmetric(vectors.T @ (matrix @ vectors))


def symmetric(matrix: ndarray) -> ndarray:
    """The symmetric part of a matrix."""
    return 0.5 * (matrix + matrix.T)


def _alone(boundary: csr_array) -> ndarray:
    """Degrees of freedom that are a boundary coordinate by themselves, which round-off has no part in."""
    return boundary.indices[boundary.indptr[:-1][np.diff(boundary.indptr) == 1]]
