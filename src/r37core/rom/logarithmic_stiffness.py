r"""Stiffness of a blade about its equilibrium under rotation, at any speed, from that at three. Light: simulations import it.

Large displacements couple bending to what stretches the blade, which is stiffer by a factor of 10^5. A polynomial between the
stiffnesses at some speeds misses that by little, and the bending frequencies by a tenth. Their logarithms differ by little:

    log K(\Omega) = log K(0) + t A + t^2 B,    t = log(1 + \kappa \Omega^2),

in coordinates in which the mass is the identity, is exact at three speeds, always positive, and exact for a mode whose squared
frequency grows with 1 + \kappa \Omega^2, as the first one's nearly does. Source: Arsigny, Fillard, Pennec and Ayache, SIAM J.
Matrix Anal. Appl. 29 (2007) 328-347.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy import ndarray


@dataclass(frozen=True)
class LogarithmicStiffness:
    """Change of the logarithm of the stiffness: `linear` A, `quadratic` B, shape (modes, modes), `rate` kappa (s2/rad2).

    `speeds` (rad/s), shape (2,): beside rest those at which it is exact.
    """

    linear: ndarray
    quadratic: ndarray
    rate: float
    speeds: ndarray

    @classmethod
    def through(cls, squares: ndarray, stiffness: ndarray, speeds: ndarray) -> LogarithmicStiffness:
        """Change of a blade with these `squares` of frequencies at rest (rad2/s2) and, in its modes at rest, this `stiffness`.

        `stiffness` (rad2/s2), shape (2, modes, modes), at two higher `speeds` (rad/s), shape (2,).
        """
        values, vectors = np.linalg.eigh(stiffness)
        logarithms = (vectors * np.log(values)[:, None]) @ vectors.swapaxes(1, 2) - np.diag(np.log(squares))
        rate = max(float(values[1, 0] / squares[0] - 1.0), _SMALLEST_GROWTH) / float(speeds[1]) ** 2
        changes = cls(logarithms[0], logarithms[1], rate, speeds)
        lower, upper = (changes.abscissa(speed) for speed in speeds)
        linear, quadratic = np.tensordot(np.linalg.inv([[lower, lower**2], [upper, upper**2]]), logarithms, axes=1)
        return cls(linear, quadratic, rate, speeds)

    def abscissa(self, speed: float) -> float:
        """t at a `speed` (rad/s)."""
        return float(np.log1p(self.rate * speed**2))

    def spectrum(self, squares: ndarray, speed: float) -> tuple[ndarray, ndarray]:
        """Squares of the frequencies (rad2/s2), ascending, and modes at a `speed` (rad/s), from the squares at rest."""
        place = self.abscissa(speed)
        logarithms, modes = np.linalg.eigh(np.diag(np.log(squares)) + place * self.linear + place**2 * self.quadratic)
        return np.exp(logarithms), modes

    def relative_change(self, modes: ndarray, speed: float) -> ndarray:
        """Relative change of the squared frequencies of some modes per squared speed (s2/rad2) at a `speed` (rad/s)."""
        change = self.linear + 2.0 * self.abscissa(speed) * self.quadratic
        return np.sum(modes * (change @ modes), axis=0) * self.rate / (1.0 + self.rate * speed**2)

    def projected(self, shapes: ndarray) -> LogarithmicStiffness:
        """The change in other coordinates, from matrices that these `shapes`, shape (coordinates, new coordinates), project."""
        linear, quadratic = (shapes.T @ matrix @ shapes for matrix in (self.linear, self.quadratic))
        return replace(self, linear=0.5 * (linear + linear.T), quadratic=0.5 * (quadratic + quadratic.T))


_SMALLEST_GROWTH = 0.01
"""Relative growth of the first squared frequency up to the highest speed, below which `rate` does not follow it."""
