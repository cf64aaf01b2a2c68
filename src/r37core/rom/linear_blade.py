"""A blade of small displacements: what its reduced model needs of it at the speeds of its basis."""

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.fem.matrices import StructuralMatrices
from r37core.fem.solver import factorise

from .craig_bampton import StateAtSpeed, projected
from .reduction_choice import ReductionChoice
from .rotation import shapes_of_rotation


class LinearBlade:
    """The undeformed blade of `matrices` at the speeds of a `reduction`."""

    def __init__(self, matrices: StructuralMatrices, reduction: ReductionChoice):
        self._matrices, self._reduction = matrices, reduction
        self._displaced: list[ndarray] = []

    @cached_property
    def _terms(self) -> tuple[csr_array, csr_array]:
        """Stiffness, and its change per squared speed."""
        geometric = self._matrices.geometric_stiffness()
        softened = geometric + self._matrices.spin_softening() if self._reduction.spin_softening else geometric
        return self._matrices.stiffness(), csr_array(softened)

    def states(self) -> Iterator[StateAtSpeed]:
        """The blade at the speeds one after another."""
        stiffness, per_square = self._terms
        for speed in self._reduction.speeds:
            total = csr_array(stiffness + speed**2 * per_square)
            solve = factorise(total) if speed else self._matrices.solve_at_rest
            self._displaced.append(solve(self._matrices.free_load))
            yield StateAtSpeed(speed, total, solve)

    def derivatives(self, state: StateAtSpeed) -> None:
        """No columns of a basis: modes of small displacements do not change."""

    def shapes_of_rotation(self) -> tuple[ndarray, ndarray]:
        """Shapes and stiffening of rotation: see r37core.rom.rotation."""
        return shapes_of_rotation(*self._terms, np.stack(self._displaced, axis=1), self._matrices.free_load)

    def stiffness_terms(self, vectors: ndarray) -> dict[str, Any]:
        """Fields of the reduced model about its stiffness in a basis."""
        matrices, (stiffness, per_square), highest = self._matrices, self._terms, max(self._reduction.speeds)
        static, middle, top = (
            projected(csr_array(stiffness + (share * highest) ** 2 * per_square) if share else stiffness, vectors)
            for share in (0.0, 0.5, 1.0)
        )
        # with s = (Omega / highest)^2: K(1/4), K(1) give K2 = (16 K(1/4) - 4 K(1) - 12 K(0)) / -3; the theory makes it zero
        quadratic = (16.0 * middle - 4.0 * top - 12.0 * static) / -3.0
        return {
            "stiffness": static,
            "geometric_stiffness": projected(matrices.geometric_stiffness(), vectors),
            "spin_softening": projected(matrices.spin_softening(), vectors) if self._reduction.spin_softening else None,
            "quadratic_residual": float(np.max(np.abs(quadratic)) / np.max(np.abs(static))) if highest > 0.0 else 0.0,
        }
