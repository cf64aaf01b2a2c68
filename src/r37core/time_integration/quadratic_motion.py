r"""Displacements of second order in a run: the elastic forces of the lowest modes, and what follows them at once.

The elastic energy beyond that of linear modes is, with the amplitudes q = Q u of the lowest modes and s_ab = G_ab u,

    V = q_a q_b s_ab/2 + b_abcd q_a q_b q_c q_d/24,    f = -(s_ab q_b + b_abcd q_b q_c q_d/6) Q_a - q_a q_b G_ab/2,

see r37core.rom.quadratic_terms. The forces f act on the stepped modes u. Those that are not stepped follow q_a q_b G_ab/2 at
once, by minus that over their squared frequencies: the nodes move by the products q_a q_b, b becomes smaller, and a force on a
node pushes q_a by what the products move it. Their inertia is that of followers, which are stepped: see SteppedBlade.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from r37core.rom.quadratic_terms import QuadraticTerms, followed_modes, pairings, pairs_of

from .stepped_blade import SteppedBlade


@dataclass(frozen=True, eq=False)
class QuadraticMotion:
    """Displacements of second order of a stepped `blade` whose model has `terms` of them."""

    blade: SteppedBlade
    terms: QuadraticTerms

    @cached_property
    def pairs(self) -> np.ndarray:
        """Modes of each product, shape (products, 2)."""
        return np.array(pairs_of(len(self.terms.coordinates)))

    @property
    def weights(self) -> np.ndarray:
        """How often each product is in a sum over all modes, shape (products,)."""
        return np.where(self.pairs[:, 0] == self.pairs[:, 1], 1.0, 2.0)

    @cached_property
    def _modal(self) -> _ModalTerms:
        return _ModalTerms.build(self.terms, self.blade)

    @property
    def rows(self) -> np.ndarray:
        """Q and, below it, G_ab of the stepped modes, shape (lowest modes + products, modes)."""
        return self._modal.rows

    @cached_property
    def shapes(self) -> np.ndarray:
        """Displacement in the modes at rest per product, shape (modes at rest, products)."""
        frequencies, modes = self.blade.static_modes
        static = self.blade.derivatives[:, self.blade.derivatives.shape[1] - len(frequencies) :]
        return 0.5 * modes @ (static.T * self.weights)

    def follow(self, displacement: np.ndarray, velocity: np.ndarray) -> None:
        """Put the followers where they are pulled to, in place, in a displacement and a velocity of the stepped modes."""
        followers = self.blade.followers
        first = len(displacement) - followers.shape[1]
        q, rate = (self.rows[: len(self.terms.coordinates), :first] @ part[:first] for part in (displacement, velocity))
        a, b = self.pairs.T
        displacement[first:] = 0.5 * (self.weights * q[a] * q[b]) @ followers
        velocity[first:] = 0.5 * (self.weights * (q[a] * rate[b] + rate[a] * q[b])) @ followers

    @cached_property
    def cubic(self) -> np.ndarray:
        """b/6 per mode of a pair and product, shape (products, products): its sum with the products adds to s_ab."""
        first, second = self.pairs.T
        return self._modal.cubic[first[:, None], second[:, None], first, second] / 6.0 * self.weights

    def products(self, displacement: np.ndarray) -> np.ndarray:
        """Products q_a q_b, shape (..., products), of displacements u of the stepped modes, shape (..., modes)."""
        amplitudes = displacement @ self.rows[: len(self.terms.coordinates)].T
        return amplitudes[..., self.pairs[:, 0]] * amplitudes[..., self.pairs[:, 1]]

    def energy(self, displacement: np.ndarray) -> np.ndarray:
        """V (J), shape (...,), of displacements u of the stepped modes, shape (..., modes)."""
        products = self.products(displacement)
        stiffness = displacement @ self.rows[len(self.terms.coordinates) :].T
        return (products * (0.5 * stiffness + 0.25 * products @ self.cubic.T)) @ self.weights

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """The force f (N) on the stepped modes at a displacement u of them, shape (modes,): minus the gradient of V."""
        count, weights, products = len(self.terms.coordinates), self.weights, self.products(displacement)
        lowest, stiffened = self.rows[:count], self.rows[count:]
        amplitudes = lowest @ displacement
        first, second = self.pairs.T
        changes = amplitudes[first, None] * lowest[second] + amplitudes[second, None] * lowest[first]
        stiffness = stiffened @ displacement + self.cubic @ products
        return -0.5 * ((weights * stiffness) @ changes + (weights * products) @ stiffened)


@dataclass(frozen=True)
class _ModalTerms:
    """Terms in the stepped modes of a speed: `rows`, see above, and `cubic` b, less what follows at once."""

    rows: np.ndarray
    cubic: np.ndarray

    @classmethod
    def build(cls, terms: QuadraticTerms, blade: SteppedBlade) -> Self:
        """Terms of a blade, its followers among the stepped modes."""
        logarithmic, followers = blade.model.logarithmic_stiffness, blade.followers.shape[1]
        assert logarithmic is not None
        _, cubic = terms.interpolated(logarithmic.abscissa(blade.grid.speed))
        own = len(blade.frequencies) - followers
        derivatives = np.hstack([blade.derivatives[:, :own], blade.followers])
        amplitudes = np.pad(followed_modes(terms.coordinates @ blade.modes[:, :own]), ((0, 0), (0, followers)))
        pushes = -derivatives * blade.frequencies**2
        follow = pairings(-pushes @ derivatives.T, len(amplitudes))
        pushes = pushes - 2.0 / 3.0 * pushes @ amplitudes.T @ amplitudes
        return cls(np.concatenate([amplitudes, pushes]), cubic + follow)
