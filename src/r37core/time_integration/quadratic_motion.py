r"""Displacements of second order in a run: the elastic forces of the lowest modes, and what follows them at once.

The elastic energy beyond that of linear modes is, with the amplitudes q = Q u of the lowest modes and s_ab = G_ab u,

    V = q_a q_b s_ab/2 + b_abcd q_a q_b q_c q_d/24,    f = -(s_ab q_b + b_abcd q_b q_c q_d/6) Q_a - q_a q_b G_ab/2,

see r37core.rom.quadratic_terms. The forces f act on the stepped modes u. Those that are not stepped follow q_a q_b G_ab/2 at
once, by minus that over their squared frequencies: the nodes move by the products q_a q_b, b becomes smaller, and a force on a
node pushes q_a by what the products move it. Their inertia is that of followers, which are stepped: see SteppedBlade.

All of the energy but Q(q), what is left of b where the others follow, is a sum of squares. Q may be negative, of modes that
soften: without a bound a run could grow for ever. So Q counts as it is down to -B, and below that as -2B - B^2/Q, which has
the same value and slope at -B and is never below -2B. B is the energy of the lowest mode where second order ends to hold.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy import ndarray

from r37core.rom.quadratic_terms import SHARE_OF_HEIGHT, QuadraticTerms, followed_modes, mode_pairs, pairings, products_of

from .stepped_blade import SteppedBlade


@dataclass(frozen=True, eq=False)
class QuadraticMotion:
    """Displacements of second order of a stepped `blade` whose model has `terms` of them."""

    blade: SteppedBlade
    terms: QuadraticTerms

    @cached_property
    def pairs(self) -> tuple[ndarray, ndarray]:
        """First and second mode of each product, shape (products,)."""
        return mode_pairs(len(self.terms.coordinates))

    @cached_property
    def weights(self) -> ndarray:
        """How often each product is in a sum over all modes, shape (products,)."""
        first, second = self.pairs
        return np.where(first == second, 1.0, 2.0)

    @cached_property
    def _derivatives(self) -> ndarray:
        """Static derivatives of the lowest modes in the stepped modes, the followers among them, shape (products, modes)."""
        own = len(self.blade.frequencies) - self.blade.followers.shape[1]
        return np.hstack([self.blade.derivatives[:, :own], self.blade.followers])

    @cached_property
    def rows(self) -> ndarray:
        """Q and, below it, G_ab of the stepped modes, shape (lowest modes + products, modes)."""
        followers = self.blade.followers.shape[1]
        own = len(self.blade.frequencies) - followers
        amplitudes = np.pad(followed_modes(self.terms.coordinates @ self.blade.modes[:, :own]), ((0, 0), (0, followers)))
        pushes = -self._derivatives * self.blade.frequencies**2
        # of their part in the lowest modes themselves a third is left: a_abc (1/2 - 1/3) of V in r37core.rom.quadratic_terms
        return np.concatenate([amplitudes, pushes - 2.0 / 3.0 * pushes @ amplitudes.T @ amplitudes])

    @cached_property
    def shapes(self) -> ndarray:
        """Displacement in the modes at rest per product, shape (modes at rest, products)."""
        frequencies, modes = self.blade.static_modes
        static = self.blade.derivatives[:, self.blade.derivatives.shape[1] - len(frequencies) :]
        return 0.5 * modes @ (static.T * self.weights)

    def follow(self, displacement: ndarray, velocity: ndarray) -> None:
        """Put the followers where they are pulled to, in place, in a displacement and a velocity of the stepped modes."""
        followers = self.blade.followers
        first = len(displacement) - followers.shape[1]
        q, rate = (self.rows[: len(self.terms.coordinates), :first] @ part[:first] for part in (displacement, velocity))
        a, b = self.pairs
        displacement[first:] = 0.5 * (self.weights * products_of(q)) @ followers
        velocity[first:] = 0.5 * (self.weights * (q[a] * rate[b] + rate[a] * q[b])) @ followers

    @cached_property
    def cubic(self) -> ndarray:
        """b/6 per mode of a pair and product, shape (products, products): its sum with the products adds to s_ab."""
        # of the stepped modes, which do not follow at once
        stepped = self._derivatives * self.blade.frequencies**2 @ self._derivatives.T
        return self._per_product(self._left + pairings(stepped, len(self.terms.coordinates)))

    @cached_property
    def left(self) -> ndarray:
        """The part of `cubic` that is left where all other modes follow at once, of Q."""
        return self._per_product(self._left)

    @cached_property
    def _left(self) -> ndarray:
        logarithmic = self.blade.model.logarithmic_stiffness
        assert logarithmic is not None
        return self.terms.interpolated(logarithmic.abscissa(self.blade.grid.speed))[1]

    def _per_product(self, cubic: ndarray) -> ndarray:
        first, second = self.pairs
        return cubic[first[:, None], second[:, None], first, second] / 6.0 * self.weights

    @cached_property
    def bound(self) -> float:
        """B (J): energy of the lowest mode with a tip that moves by SHARE_OF_HEIGHT of the blade's height."""
        shapes = self.blade.model.tip_displacement_operator @ self.blade.modes[:, 0]
        amplitude = SHARE_OF_HEIGHT * self.terms.height / np.linalg.norm(shapes, axis=0).max()
        return float(0.5 * (self.blade.frequencies[0] * amplitude) ** 2)

    @cached_property
    def surely_within(self) -> float:
        """Sum of the squared products up to which Q is above -B whatever they are."""
        lowest = np.linalg.eigvalsh(self.weights[:, None] * self.left)[0]
        return -4.0 * self.bound / lowest if lowest < 0.0 else np.inf

    def reduction(self, energy: ndarray) -> ndarray:
        """Derivative by Q of the energy that counts in place of Q, less one, at values of Q (J)."""
        return np.where(energy < -self.bound, (self.bound / np.minimum(energy, -self.bound)) ** 2 - 1.0, 0.0)

    def products(self, displacement: ndarray) -> ndarray:
        """Products q_a q_b, shape (..., products), of displacements u of the stepped modes, shape (..., modes)."""
        return products_of(displacement @ self.rows[: len(self.terms.coordinates)].T)

    def energy(self, displacement: ndarray) -> ndarray:
        """V (J), shape (...,), of displacements u of the stepped modes, shape (..., modes)."""
        products = self.products(displacement)
        stiffness = displacement @ self.rows[len(self.terms.coordinates) :].T
        whole = (products * (0.5 * stiffness + 0.25 * products @ self.cubic.T)) @ self.weights
        left = self.energy_left(products)
        below = np.minimum(left, -self.bound)
        return whole + np.where(left < -self.bound, -2.0 * self.bound - self.bound**2 / below - left, 0.0)

    def energy_left(self, products: ndarray) -> ndarray:
        """Q (J), shape (...,), of products, shape (..., products)."""
        return 0.25 * (products * (products @ self.left.T)) @ self.weights

    def force(self, displacement: ndarray) -> ndarray:
        """The force f (N) on the stepped modes at a displacement u of them, shape (modes,): minus the gradient of V."""
        count, weights, products = len(self.terms.coordinates), self.weights, self.products(displacement)
        lowest, stiffened = self.rows[:count], self.rows[count:]
        amplitudes = lowest @ displacement
        first, second = self.pairs
        changes = amplitudes[first, None] * lowest[second] + amplitudes[second, None] * lowest[first]
        stiffness = stiffened @ displacement + self.cubic @ products
        stiffness += self.reduction(self.energy_left(products)) * (self.left @ products)
        return -0.5 * ((weights * stiffness) @ changes + (weights * products) @ stiffened)
