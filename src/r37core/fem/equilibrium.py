"""Where a blade rests under its rotation: the equilibrium of large displacements."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .assembly import NodePattern, block_matrix
from .large_displacement import LargeDisplacement
from .matrices import StructuralMatrices
from .solver import Solve, factorise

_CONVERGED = 1e-9
"""Size of the last correction of an equilibrium, as a share of its displacement."""

_MOST_FACTORS, _MOST_CUTS = 6, 5

_FAST = 0.25
"""Size of a correction over that of the one before, below which factors are kept."""


class NoEquilibriumError(ValueError):
    """Error of a blade that has no stable position under its rotation, as far as small steps of the load find one."""

    def __init__(self, speed: float, reached: float):
        super().__init__(
            f"the blade has no stable position at {speed:g} rad/s with large displacements: the last one was found at "
            f"{reached:.5g} rad/s; choose a lower structure.maximum_speed_rad_s, a stiffer or lighter material, less sweep and "
            "lean, or structure.kinematics: linear"
        )


@dataclass(frozen=True)
class Equilibrium:
    """Displacement (m), shape (nodes, 3), and factors of a tangent near it, which it was found with."""

    displacement: np.ndarray
    solve: Solve


class Rotation:
    """Large displacements of a clamped blade under its rotation. `matrices`: its linear ones, with factors at rest.

    `follows`: whether the centrifugal force grows with the distance from the axis (spin softening).
    """

    def __init__(self, solid: LargeDisplacement, matrices: StructuralMatrices, *, follows: bool):
        self.solid, self._matrices, self._follows = solid, matrices, follows
        self._pattern = NodePattern.build(solid.blocks, len(solid.points))
        self._freedoms = (3 * matrices.free_nodes[:, None] + np.arange(3)).ravel()
        # spin softening is minus the mass of the motion normal to the axis
        self._softening = matrices.spin_softening() if follows else None

    def whole(self, free: np.ndarray) -> np.ndarray:
        """Displacement of all nodes, shape (nodes, 3), from that of the unclamped degrees of freedom, shape (dofs,)."""
        displacement = np.zeros_like(self.solid.points)
        displacement[self._matrices.free_nodes] = free.reshape(-1, 3)
        return displacement

    def free(self, field: np.ndarray) -> np.ndarray:
        """The unclamped degrees of freedom, shape (dofs,), of a field of all nodes, shape (nodes, 3)."""
        return field[self._matrices.free_nodes].ravel()

    def elastic_tangent(self, displacement: np.ndarray) -> sp.csr_array:
        """Tangent (N/m) of the elastic forces at a displacement (m), shape (nodes, 3), between unclamped degrees of freedom."""
        blocks = self.solid.tangent(displacement, self._pattern)
        whole = block_matrix(self._pattern.indptr, self._pattern.indices, blocks)
        return sp.csr_array(whole[self._freedoms][:, self._freedoms])

    def tangent(self, displacement: np.ndarray, speed: float) -> sp.csr_array:
        """Tangent stiffness (N/m) of elastic and centrifugal forces at a displacement, at a speed (rad/s)."""
        tangent = self.elastic_tangent(displacement)
        return tangent if self._softening is None else sp.csr_array(tangent + speed**2 * self._softening)

    def residual(self, displacement: np.ndarray, speed: float) -> np.ndarray:
        """Centrifugal less elastic forces (N), shape (dofs,)."""
        load = speed**2 * self.free(self._matrices.centrifugal_load)
        if self._softening is not None:
            load = load - speed**2 * (self._softening @ self.free(displacement))
        return load - self.free(self.solid.forces(displacement))

    def equilibrium(self, speed: float, guess: np.ndarray) -> Equilibrium:
        """The equilibrium at a speed (rad/s), from a `guess` of its displacement (m), shape (nodes, 3).

        Newton's method in steps of the load, which are halved where it does not converge; the guess grows with the load.
        Raises NoEquilibriumError.
        """
        reached, step, displacement = 0.0, 1.0, guess
        while True:
            share = min(reached + step, 1.0)
            start = displacement * (share / reached if reached else share)
            there = self._newton(start, speed * np.sqrt(share))
            if there is not None:
                displacement, reached = there.displacement, share
                if reached == 1.0:
                    return there
                continue
            step *= 0.5
            if step < 2.0**-_MOST_CUTS:
                raise NoEquilibriumError(speed, speed * np.sqrt(reached))

    def _newton(self, displacement: np.ndarray, speed: float) -> Equilibrium | None:
        """The equilibrium near a displacement; None where it is not found, or is not stable.

        Factors are kept while the corrections become smaller fast: making them costs as much as fifty corrections.
        """
        residual, last_size = self.residual(displacement, speed), np.inf
        for _ in range(_MOST_FACTORS):
            solve, is_new = factorise(self.tangent(displacement, speed)), True
            while True:
                correction = solve(residual)
                size = float(np.linalg.norm(correction))
                is_last = size <= _CONVERGED * np.linalg.norm(displacement)
                if not (is_new or is_last or size < _FAST * last_size):
                    break
                if is_new:
                    # of a stable position the tangent is positive
                    is_stable = correction @ residual > 0.0
                displacement = displacement + self.whole(correction)
                if is_last:
                    return Equilibrium(displacement, solve) if is_stable else None
                is_new, last_size = False, size
                residual = self.residual(displacement, speed)
        return None
