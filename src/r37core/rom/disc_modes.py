"""Modes of a disc by nodal diameter, in a basis of each. Light: a Campbell diagram reads them from the reduced model."""

from dataclasses import dataclass

import numpy as np
from numpy import ndarray


@dataclass(frozen=True)
class DiscModes:
    """Each nodal diameter n of a disc in its modes at rest, from 0 to that of the most, with mass 1.

    `squared_frequencies` (rad2/s2), shape (n, modes); `stiffness_per_square` (1/rad2), shape (2, n, modes, modes): real and
    imaginary part of the change of the stiffness per Omega^2; `likeness`, the same shape: mass product of the modes with those
    of the highest nodal diameter, over one sector, of normalised shapes; `shape_products`, shape (2, shapes, modes): mass
    product of the ideal shapes with the highest nodal diameter's modes; `highest_modes`, shape (coordinates, modes): the real
    part of these in the coordinates of the reduced model; `sectors`: of the disc.
    """

    squared_frequencies: ndarray
    stiffness_per_square: ndarray
    likeness: ndarray
    shape_products: ndarray
    highest_modes: ndarray
    sectors: float

    def modes(self, nodal_diameter: int, speed: float) -> tuple[ndarray, ndarray]:
        """Angular frequencies (rad/s), ascending, negative below zero stiffness, and modes in those at rest, as columns."""
        real, imaginary = self.stiffness_per_square[:, nodal_diameter]
        stiffness = np.diag(self.squared_frequencies[nodal_diameter]) + speed**2 * (real + 1j * imaginary)
        squares, modes = np.linalg.eigh(stiffness)
        return np.sign(squares) * np.sqrt(np.abs(squares)), modes

    def assurance(self, nodal_diameter: int, modes: ndarray, reference: ndarray) -> ndarray:
        """MAC of modes of a nodal diameter with modes of the highest one, shape (modes, reference), both as columns."""
        real, imaginary = self.likeness[:, nodal_diameter]
        return np.abs(modes.conj().T @ (real + 1j * imaginary) @ reference) ** 2
