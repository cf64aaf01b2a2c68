r"""Displacements of second order in a run: the elastic forces of the lowest modes, and what follows them at once.

The elastic energy beyond that of linear modes is, with the amplitudes q = Q u of the lowest modes and s_ab = G_ab u,

    V = q_a q_b s_ab/2 + b_abcd q_a q_b q_c q_d/24,    f = -(s_ab q_b + b_abcd q_b q_c q_d/6) Q_a - q_a q_b G_ab/2,

see r37core.rom.quadratic_terms. The forces f act on the stepped modes u. Those that are not stepped follow q_a q_b G_ab/2 at
once, by minus that over their squared frequencies: the nodes move by the products q_a q_b, b becomes smaller, and a force on a
node pushes q_a by what the products move it.
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
        return _ModalTerms.of(self.terms, self.blade)

    @cached_property
    def rows(self) -> np.ndarray:
        """Q and, below it, G_ab of the stepped modes, shape (lowest modes + products, modes)."""
        stepped = len(self.blade.frequencies)
        return np.concatenate([self._modal.amplitudes, self._modal.pushes])[:, :stepped]

    @cached_property
    def shapes(self) -> np.ndarray:
        """Displacement in the modes at rest per product, shape (modes at rest, products)."""
        _, modes = self.blade.static_modes
        derivatives = self._modal.derivatives[:, len(self.blade.frequencies) :]
        return 0.5 * modes @ (derivatives.T * self.weights)

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


@dataclass(frozen=True)
class _ModalTerms:
    """Terms in all modes of a speed: `amplitudes` Q, `pushes` G_ab, `derivatives` theta_ab, shape (..., modes), and `cubic` b."""

    amplitudes: np.ndarray
    pushes: np.ndarray
    derivatives: np.ndarray
    cubic: np.ndarray

    @classmethod
    def of(cls, terms: QuadraticTerms, blade: SteppedBlade) -> Self:
        """Those of a blade, of which only the stepped modes have inertia."""
        frequencies, modes = blade.model.modes_at(blade.grid.speed)
        logarithmic, stepped = blade.model.logarithmic_stiffness, len(blade.frequencies)
        assert logarithmic is not None
        derivatives, cubic = terms.at(logarithmic.abscissa(blade.grid.speed))
        derivatives = derivatives @ modes
        amplitudes = followed_modes((terms.coordinates @ modes)[:, :stepped])
        amplitudes = np.pad(amplitudes, ((0, 0), (0, len(frequencies) - stepped)))
        pushes = -derivatives * frequencies**2
        # those that are stepped do not follow at once
        follow = pairings(-pushes[:, :stepped] @ derivatives[:, :stepped].T, len(amplitudes))
        pushes = pushes - 2.0 / 3.0 * pushes @ amplitudes.T @ amplitudes
        return cls(amplitudes, pushes, derivatives, cubic + follow)
