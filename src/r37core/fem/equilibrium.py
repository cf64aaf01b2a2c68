"""Where a blade rests under its rotation: the equilibrium of large displacements."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.base.io import CarriedError

from .assembly import NodePattern, block_matrix
from .large_displacement import LargeDisplacement
from .matrices import StructuralMatrices
from .solver import Solve, factorise

_CONVERGED = 1e-9
"""Size of the last correction of an equilibrium, as a share of its displacement."""

_ORDER, _LEFT_OUT = 16, 3e-2
"""Order of the series between equilibria, and its last term where it ends, as a share of its first."""

_MOST_CORRECTIONS, _SHORTEST = 20, 1e-6
"""Corrections by one tangent, and shortest step of the load, as a share of that which is looked for."""


class NoEquilibriumError(CarriedError):
    """Error of a blade that has no stable position under its rotation, as far as small steps of the load find one."""

    def __init__(self, speed: float, reached: float):
        super().__init__(
            f"the blade has no stable position at {speed:g} rad/s with large displacements: the last one was found at "
            f"{reached:.5g} rad/s; choose a lower structure.maximum_speed_rad_s, a stiffer or lighter blade, or "
            "kinematics: linear"
        )


@dataclass(frozen=True)
class Equilibrium:
    """Displacement (m), shape (nodes, 3), and factors of a tangent near it, which it was found with."""

    displacement: ndarray
    solve: Solve


class Rotation:
    """Large displacements of a clamped blade under its rotation. `matrices`: its linear ones, with factors at rest.

    `whole`, `free`: fields of all nodes and of the unclamped degrees of freedom, as the matrices turn one into the other.
    `follows`: whether the centrifugal force grows with the distance from the axis (spin softening).
    """

    def __init__(self, solid: LargeDisplacement, matrices: StructuralMatrices, *, follows: bool):
        self._solid, self._matrices = solid, matrices
        self.whole, self.free = matrices.whole, matrices.free
        self._pattern = NodePattern.build(solid.blocks, len(solid.points))
        self._freedoms = (3 * matrices.free_nodes[:, None] + np.arange(3)).ravel()
        # spin softening is minus the mass of the motion normal to the axis
        self._softening = matrices.spin_softening() if follows else None

    def tangent(self, displacement: ndarray, speed: float) -> csr_array:
        """Tangent stiffness (N/m) of elastic and centrifugal forces between the unclamped degrees of freedom.

        At a `displacement` (m), shape (nodes, 3), and a `speed` (rad/s).
        """
        blocks = self._solid.tangent(displacement, self._pattern)
        whole = block_matrix(self._pattern.indptr, self._pattern.indices, blocks)
        tangent = csr_array(whole[self._freedoms][:, self._freedoms])
        return tangent if self._softening is None else csr_array(tangent + speed**2 * self._softening)

    def residual(self, displacement: ndarray, speed: float) -> ndarray:
        """Centrifugal less elastic forces (N), shape (dofs,)."""
        load = speed**2 * self._matrices.free_load
        if self._softening is not None:
            load = load - speed**2 * (self._softening @ self.free(displacement))
        return load - self.free(self._solid.forces(displacement))

    def equilibria(self, speeds: Iterable[float]) -> Iterator[Equilibrium]:
        """The equilibria at ascending speeds (rad/s) above rest. Raises NoEquilibriumError.

        From one to the next by the series of the displacement in the squared speed, whose terms all have the tangent there: the
        asymptotic numerical method (Cochelin, Computers & Structures 53 (1994) 1181-1192). Where it ends Newton's method with
        the tangent there corrects what it leaves out.
        """
        here = Equilibrium(np.zeros_like(self._solid.points), self._matrices.solve_at_rest)
        square = 0.0
        for speed in speeds:
            shortest = _SHORTEST * (speed**2 - square)
            while square < speed**2:
                terms = self._series(here, square)
                sizes = [float(np.linalg.norm(term)) for term in terms]
                longest = float((_LEFT_OUT * sizes[0] / sizes[-1]) ** (1.0 / (_ORDER - 1))) if sizes[-1] else np.inf
                step, there = min(longest, speed**2 - square), None
                while there is None:
                    if step < shortest:
                        raise NoEquilibriumError(speed, float(np.sqrt(square)))
                    reached = speed**2 if step == speed**2 - square else square + step
                    displacement = here.displacement + sum(term * step ** (n + 1) for n, term in enumerate(terms))
                    there = self._corrected(displacement, reached)
                    step *= 0.5
                here, square = there, reached
            yield here

    def _series(self, here: Equilibrium, square: float) -> list[ndarray]:
        """Terms of the displacement (m) in what is added to a squared speed, from the equilibrium there on."""
        load = self._matrices.free_load

        def next_term(n: int, forces: ndarray) -> ndarray:
            force = (load if n == 1 else 0.0) - self.free(forces)
            if self._softening is not None:
                force = force - self._softening @ self.free(here.displacement if n == 1 else terms[-1])
            terms.append(self.whole(here.solve(force)))
            return terms[-1]

        terms: list[ndarray] = []
        return self._solid.series(here.displacement, _ORDER, next_term)

    def _corrected(self, displacement: ndarray, square: float) -> Equilibrium | None:
        """The equilibrium at a squared speed near a displacement; None where one tangent finds none, or it is not stable."""
        speed = float(np.sqrt(square))
        solve, last = factorise(self.tangent(displacement, speed)), np.inf
        load = self._matrices.free_load
        # of a stable position the tangent is positive
        if not solve(load) @ load > 0.0:
            return None
        for _ in range(_MOST_CORRECTIONS):
            correction = solve(self.residual(displacement, speed))
            size = float(np.linalg.norm(correction))
            if not size < last:
                return None
            displacement, last = displacement + self.whole(correction), size
            if size <= _CONVERGED * np.linalg.norm(displacement):
                return Equilibrium(displacement, solve)
        return None
