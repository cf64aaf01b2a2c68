"""Static displacement of a blade under the centrifugal load, at any speed, from that at a few.

(K0 + Omega^2 K1) u = Omega^2 f. In the span of the displacements at some speeds, with the shapes v_i for which
K1 v_i = kappa_i K0 v_i and v_i^T K0 v_i = 1 there, u = sum over i of Omega^2/(1 + kappa_i Omega^2) v_i (v_i^T f). It is exact
at those speeds, and between them the nearest one in energy (Galerkin). Light: the simulation jobs import it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy import ndarray

from r37core.base.io import CarriedError

if TYPE_CHECKING:
    import scipy.sparse as sp


class BucklingError(CarriedError):
    """Error of a blade that its load buckles at a speed: it has no stable position there."""

    def __init__(self, speed: float):
        super().__init__(
            f"the blade has no stable position at {speed:g} rad/s: its stiffness is not positive there; choose lower speeds "
            "(speeds, those of run-ups, and structure.maximum_speed_rad_s), or a stiffer or lighter material, or less sweep "
            "and lean; of an imported blade check length_unit and the units of its material first"
        )


def rotation_amplitudes(stiffening: ndarray, speeds: float | ndarray) -> ndarray:
    """Omega^2/(1 + kappa Omega^2) (rad2/s2), shape (..., shapes), of kappa = `stiffening` (s2/rad2), shape (shapes,).

    `speeds` (rad/s), shape (...,). Raises BucklingError where the rotation leaves no stiffness.
    """
    squares = np.asarray(speeds)[..., None] ** 2
    relative = 1.0 + stiffening * squares
    if not np.all(relative > 0.0):
        raise BucklingError(float(np.sqrt(squares[np.any(relative <= 0.0, axis=-1)].min())))
    return squares / relative


def shapes_of_rotation(
    stiffness: sp.csr_array, per_square: sp.csr_array, displaced: ndarray, load: ndarray
) -> tuple[ndarray, ndarray]:
    """Shapes v_i (v_i^T f) (m s2/rad2), shape (dofs, shapes), and their kappa_i (s2/rad2), shape (shapes,).

    `stiffness` K0 and `per_square` K1, over the degrees of freedom; `displaced`, shape (dofs, speeds): the displacements at
    some speeds; `load` f (N s2/rad2), shape (dofs,).
    """
    columns, _ = np.linalg.qr(displaced)
    # the stiffness is positive, so its Cholesky factor L makes this a plain eigenproblem: L^-1 K1 L^-T w = kappa w
    factor = np.linalg.cholesky(columns.T @ (stiffness @ columns))
    half = np.linalg.solve(factor, columns.T @ (per_square @ columns))
    turned = np.linalg.solve(factor, half.T)
    stiffening, vectors = np.linalg.eigh(0.5 * (turned + turned.T))
    shapes = columns @ np.linalg.solve(factor.T, vectors)
    return shapes * (load @ shapes), stiffening
