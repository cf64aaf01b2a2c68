r"""A blade about its equilibrium under rotation, with large displacements: what its reduced model needs of it.

About the equilibrium u0(Omega) the elastic forces of displacements v are K v + D2f[v, v]/2 + D3f[v, v, v]/6, with the tangent
K and the derivatives of r37core.fem.large_displacement. The motion of the lowest modes p_a, v = \sum_a q_a p_a, pushes all
others by D2f[p_a, p_b] q_a q_b/2. What they do then, K \theta_ab = -D2f[p_a, p_b], is in the basis: the static derivatives of
the modes (Idelsohn and Cardona, Computers & Structures 20 (1985) 203-210). So the basis and the mass stay constant, and the
displacement to second order with its inertia is that of these columns.
"""

from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np
import scipy.linalg as la
from numpy import ndarray

from r37core.fem.equilibrium import Rotation
from r37core.fem.large_displacement import LargeDisplacement
from r37core.fem.material import Material
from r37core.fem.matrices import StructuralMatrices
from r37core.fem.solver import lowest_modes
from r37core.mesh.blade_mesh import TIP_LINES, BladeMesh

from .craig_bampton import StateAtSpeed, projected, symmetric
from .logarithmic_stiffness import LogarithmicStiffness
from .quadratic_terms import PATH_SHARES, QuadraticTerms, followed_modes, mode_pairs, pairings
from .reduction_choice import QUADRATIC, ReductionChoice

_PATH_ORDER, _CONVERGED = 12, 1e-4
"""Order of the series of the path, and its last term, as a share of the height, up to which it has converged."""

_RELATIVE_STIFFENING = np.array([0.0, 1.0, 4.0])
"""kappa Omega^2 at the highest speed of the three shapes of rotation; see r37core.rom.rotation."""


class RotatingBlade:
    """The blade of a `mesh` and its `matrices` at the three speeds of a `reduction`, the first of which is rest."""

    def __init__(self, mesh: BladeMesh, matrices: StructuralMatrices, material: Material, reduction: ReductionChoice):
        self._solid = LargeDisplacement(mesh.blocks, mesh.points, material)
        self._rotation = Rotation(self._solid, matrices, follows=reduction.spin_softening)
        self._matrices, self._reduction = matrices, reduction
        self._equilibria = [np.zeros_like(mesh.points)]
        self._height = float(np.ptp(np.hypot(*mesh.points[:, :2].T)))
        self._points = mesh.points
        self._tip = np.concatenate([mesh.node_set(name)[[0, -1]] for name in TIP_LINES.values()])

    def states(self) -> Iterator[StateAtSpeed]:
        """The blade at the speeds one after another. Raises NoEquilibriumError."""
        yield StateAtSpeed(0.0, self._matrices.stiffness(), self._matrices.solve_at_rest)
        speeds = self._reduction.speeds[1:]
        for speed, equilibrium in zip(speeds, self._rotation.equilibria(speeds), strict=True):
            self._equilibria.append(equilibrium.displacement)
            # the factors are of a tangent near this one, which a basis may be of
            yield StateAtSpeed(speed, self._rotation.tangent(equilibrium.displacement, speed), equilibrium.solve)

    def derivatives(self, state: StateAtSpeed) -> ndarray | None:
        """Static derivatives of the lowest modes of a state that has been reached, shape (dofs, pairs); None without QUADRATIC.

        Columns of a basis: their scale counts for nothing.
        """
        if self._reduction.kinematics != QUADRATIC:
            return None
        _, modes = lowest_modes(state.stiffness, self._matrices.mass(), self._reduction.quadratic_modes, state.solve)
        fields = [self._rotation.whole(mode) for mode in modes.T]
        pushes = [
            self._rotation.free(self._solid.second_derivative(self._equilibria[-1], *pair)) for pair in self._paired(fields)
        ]
        return state.solve(np.array(pushes).T)

    def shapes_of_rotation(self) -> tuple[ndarray, ndarray]:
        """Shapes (m s2/rad2), shape (dofs, 3), and kappa (s2/rad2), shape (3,), of the displacement: see r37core.rom.rotation.

        They give that of every speed of the basis, and from rest on the linear one.
        """
        stiffening = _RELATIVE_STIFFENING / max(self._reduction.speeds) ** 2
        squares = np.square(self._reduction.speeds)
        from_rest = self._matrices.displaced_by(self._matrices.centrifugal_load)
        per_square = [from_rest, *(field / square for field, square in zip(self._equilibria[1:], squares[1:], strict=True))]
        fields = np.array([self._rotation.free(field) for field in per_square])
        return la.solve(1.0 / (1.0 + np.outer(squares, stiffening)), fields).T, stiffening

    def stiffness_terms(self, vectors: ndarray) -> dict[str, Any]:
        """Fields of the reduced model about its stiffness in a basis, spin softening in it."""
        mass, speeds = projected(self._matrices.mass(), vectors), self._reduction.speeds
        # assembled again, one after another: all of them at once would be the most that a reduction holds
        displaced = zip(self._reduction.speeds[1:], self._equilibria[1:], strict=True)
        tangents = (self._rotation.tangent(displacement, speed) for speed, displacement in displaced)
        stiffness = np.array([projected(tangent, vectors) for tangent in chain([self._matrices.stiffness()], tangents)])
        squares, modes = la.eigh(stiffness[0], mass)
        modal_stiffness = np.array([symmetric(modes.T @ matrix @ modes) for matrix in stiffness[1:]])
        logarithmic = LogarithmicStiffness.through(squares, modal_stiffness, np.array(speeds[1:]))
        terms = {
            "stiffness": stiffness[0],
            "geometric_stiffness": (stiffness[1] - stiffness[0]) / speeds[1] ** 2,
            "logarithmic_stiffness": logarithmic.projected(modes.T @ mass),
            "quadratic_residual": 0.0,
        }
        if self._reduction.kinematics == QUADRATIC:
            places = np.array([logarithmic.abscissa(speed) for speed in speeds])
            terms["quadratic"] = self._quadratic_terms(vectors, mass, stiffness, places)
        return terms

    def _quadratic_terms(self, vectors: ndarray, mass: ndarray, stiffness: ndarray, places: ndarray) -> QuadraticTerms:
        """Terms of second order, of the lowest modes of the middle speed and those that follow them at the others.

        `mass` and, at each speed, `stiffness`: in the basis `vectors`; `places`: of the speeds.
        """
        count = self._reduction.quadratic_modes
        lowest = la.eigh(stiffness[1], mass, subset_by_index=(0, count - 1))[1]
        coordinates, derivatives, cubic, errors = lowest.T @ mass, [], [], np.empty(0)
        for matrix, displacement in zip(stiffness, self._equilibria, strict=True):
            squares, modes = la.eigh(matrix, mass)
            followed = modes @ followed_modes(coordinates @ modes).T
            fields = [self._rotation.whole(field) for field in (vectors @ followed).T]
            pairs = self._paired(fields)
            forces = (self._rotation.free(self._solid.second_derivative(displacement, *pair)) for pair in pairs)
            pushes = np.array([vectors.T @ force for force in forces])
            third = pairings(self._solid.strain_energies(pairs), count)
            modal = pushes @ modes
            static = -(modal / squares) @ modes.T
            if not errors.size:
                errors = self._path_errors(vectors @ followed, vectors @ static.T)
            derivatives.append(static @ mass)
            cubic.append(third - pairings((modal / squares) @ modal.T, count))
        return QuadraticTerms.through(places, coordinates, np.array(derivatives), np.array(cubic), self._height, errors)

    def _path_errors(self, lowest: ndarray, static: ndarray) -> ndarray:
        """Largest radial errors (m) of the tip's path of second order up to PATH_SHARES, by a load on the first mode at rest.

        Full finite elements: the series (Cochelin, as of Rotation) of the displacement in the size a of the load. The path: at
        their amplitudes q_a of the `lowest` modes, q_a p_a + q_a q_b theta_ab/2, with the `static` derivatives of all pairs
        beyond these modes. Where the series has not converged the error is the height.
        """
        mass, terms, orders = self._matrices.mass(), [], np.arange(1, _PATH_ORDER + 1)

        def next_term(n: int, forces: ndarray) -> ndarray:
            load = mass @ lowest[:, 0] if n == 1 else 0.0
            terms.append(self._matrices.solve_at_rest(load - self._rotation.free(forces)))
            return self._rotation.whole(terms[-1])

        self._solid.series(self._equilibria[0], _PATH_ORDER, next_term)
        first, second = mode_pairs(lowest.shape[1])
        squared = (static - lowest @ (lowest.T @ (mass @ static))) * np.where(first == second, 0.5, 1.0)
        tip_moves = np.array([self._rotation.whole(field)[self._tip] for field in (*terms, *lowest.T, *squared.T)])
        x, y = (self._points[self._tip, :2] / np.hypot(*self._points[self._tip, :2].T)[:, None]).T
        radial, across = (
            tip_moves[..., 0] * x + tip_moves[..., 1] * y,
            tip_moves[:_PATH_ORDER, :, 1] * x - tip_moves[:_PATH_ORDER, :, 0] * y,
        )
        powers = (np.linspace(-0.3, 0.3, 601)[:, None] * self._height / np.abs(across[0]).max()) ** orders
        q, path = powers @ np.array(terms) @ (mass @ lowest), powers @ radial[:_PATH_ORDER]
        error = np.abs(path - np.hstack([q, q[:, first] * q[:, second]]) @ radial[_PATH_ORDER:]).max(axis=1)
        error[np.abs(powers[:, -1]) * np.abs(across[-1]).max() > _CONVERGED * self._height] = self._height
        share = np.maximum(np.abs(path), np.abs(powers @ across)).max(axis=1) / self._height
        return np.array([error.max(where=share <= most, initial=0.0) for most in PATH_SHARES])

    @staticmethod
    def _paired(fields: list[ndarray]) -> list[tuple[ndarray, ndarray]]:
        return [(fields[a], fields[b]) for a, b in zip(*mode_pairs(len(fields)), strict=True)]
