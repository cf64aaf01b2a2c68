r"""Terms of a blade's elastic energy beyond the quadratic ones, of its lowest modes. Light: the simulation jobs import it.

About the equilibrium under rotation, of a motion v = \sum_a q_a p_a + w of the lowest modes p_a and the others w,

    V = q_a q_b (g_ab x)/2 - a_abc q_a q_b q_c/3 + b_abcd q_a q_b q_c q_d/24,    g_ab = -K \theta_ab,  a_abc = g_ab p_c,

with the coordinates x of the whole motion and the static derivatives \theta_ab = -K^{-1} D2f[p_a, p_b]. Terms of the others
alone are left out. Large displacements couple bending to stretching, 10^5 times as stiff: g and b are large numbers that nearly
cancel, so between speeds not they are interpolated, but \theta_ab and what is left of b where all other modes follow at once,
b_abcd - (\theta_ab K \theta_cd + \theta_ac K \theta_bd + \theta_ad K \theta_bc).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy import ndarray

SHARE_OF_HEIGHT = 0.2
"""Displacement, as a share of the blade's height, beyond which displacements of second order hold for no blade."""

PATH_SHARES = np.linspace(0.0, SHARE_OF_HEIGHT, 21)
"""Displacements, as shares of the blade's height, at which the error of the tip's path is known."""

PATH_ERROR = 0.05
"""Error of the tip's path, as a share of the clearance, beyond which displacements of second order do not hold."""

MOST_QUADRATIC_MODES = 6
"""Largest number of modes with displacements of second order."""


@dataclass(frozen=True)
class QuadraticTerms:
    """The terms at any speed, as polynomials of the abscissa t of r37core.rom.logarithmic_stiffness.

    `coordinates`, shape (modes, coordinates): mass products of the basis with the p_a of one speed, which those of the others
    follow (see followed_modes); `path_errors` (m), shape (shares,): of the tip's path in the lowest mode against full finite
    elements, at PATH_SHARES; `derivatives`, shape (3, pairs, coordinates): coefficients of the mass products with theta_ab
    of the pairs a <= b; `cubic`, shape (3, modes, modes, modes, modes): of what is left of b; `height` (m) of the blade.
    """

    coordinates: ndarray
    derivatives: ndarray
    cubic: ndarray
    height: float
    path_errors: ndarray

    @classmethod
    def through(cls, places: ndarray, coordinates: ndarray, derivatives: ndarray, cubic: ndarray, *more: Any) -> QuadraticTerms:
        """Terms with these `derivatives` and `cubic` at three places of the abscissa, the first axis of each."""
        coefficients = np.linalg.inv(np.vander(places, increasing=True))
        derivatives, cubic = (np.tensordot(coefficients, values, axes=1) for values in (derivatives, cubic))
        return cls(coordinates, derivatives, cubic, *more)

    def share_within(self, error: float) -> float:
        """Share of the height up to which the tip's path is within an `error` (m) of full finite elements."""
        return float(np.interp(error, self.path_errors, PATH_SHARES))

    def interpolated(self, place: float) -> tuple[ndarray, ndarray]:
        """`derivatives` and `cubic` at a place of the abscissa."""
        powers = place ** np.arange(3)
        return np.tensordot(powers, self.derivatives, axes=1), np.tensordot(powers, self.cubic, axes=1)

    def stiffened(self, factor: float) -> QuadraticTerms:
        """Terms of a blade whose elastic modulus is larger by a factor."""
        return replace(self, cubic=self.cubic * factor)

    def projected(self, modes: ndarray) -> QuadraticTerms:
        """The terms in coordinates y with x = modes y; `modes`, shape (coordinates, new coordinates)."""
        return replace(self, coordinates=self.coordinates @ modes, derivatives=self.derivatives @ modes)


def mode_pairs(modes: int) -> tuple[ndarray, ndarray]:
    """First and second modes a <= b of the products of so many modes, each of shape (products,), in the products' order."""
    return np.triu_indices(modes)


def products_of(amplitudes: ndarray) -> ndarray:
    """Products q_a q_b, shape (..., products), of amplitudes of modes, shape (..., modes)."""
    first, second = mode_pairs(amplitudes.shape[-1])
    return amplitudes[..., first] * amplitudes[..., second]


def followed_modes(overlap: ndarray) -> ndarray:
    """The p_a among the modes of a speed: amplitudes of these, shape (p, modes), from mass products `overlap` of that shape.

    They span as many modes, those nearest to the p_a of the other speed, and are as near to these as they can be: so they
    change smoothly where modes of the span come near to each other.
    """
    nearest = np.sort(np.argsort(-np.sum(overlap**2, axis=0), kind="stable")[: len(overlap)])
    left, _, right = np.linalg.svd(overlap[:, nearest])
    followed = np.zeros_like(overlap)
    followed[:, nearest] = left @ right
    return followed


def pairings(products: ndarray, modes: int) -> ndarray:
    """X_ab,cd + X_ac,bd + X_ad,bc of symmetric `products` X of pairs, shape (pairs, pairs); shape (modes,) * 4."""
    first, second = mode_pairs(modes)
    number = np.empty((modes, modes), dtype=int)
    number[first, second] = number[second, first] = np.arange(len(first))
    whole = products[number[:, :, None, None], number]
    return whole + whole.transpose(0, 2, 1, 3) + whole.transpose(0, 2, 3, 1)
