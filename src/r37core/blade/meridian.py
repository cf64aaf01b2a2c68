"""Surfaces of revolution that cut a blade at hub and tip: the radius over the axial place."""

from collections.abc import Sequence

import numpy as np
import scipy

from .profile import BladeShapeError


class Meridian:
    """Radius (m) over z (m) through points (z, r): monotone cubic between them, straight beyond.

    A single point is a cylinder. Raises BladeShapeError for a curve that runs back in z.
    """

    def __init__(self, points: Sequence[tuple[float, float]] | np.ndarray):
        self.points = np.array(points, dtype=float)
        z, r = self.points.T
        if len(z) > 1 and z[0] > z[-1]:
            z, r = z[::-1], r[::-1]
        if np.any(np.diff(z) <= 0.0):
            raise BladeShapeError(
                f"the meridian runs back in z near z = {z[int(np.argmin(np.diff(z)))]:.5g} m; allowed: one radius at every z"
            )
        if len(z) == 1:
            z, r = z + np.array([0.0, 1.0]), r[[0, 0]]
        self._ends = z[[0, -1]]
        self._curve = scipy.interpolate.PchipInterpolator(z, r)
        self._slope = self._curve.derivative()

    def radius(self, z: np.ndarray) -> np.ndarray:
        """Radius (m) at axial places (m)."""
        inside = np.clip(z, *self._ends)
        return self._curve(inside) + self._slope(inside) * (z - inside)

    def slope(self, z: np.ndarray) -> np.ndarray:
        """Rise of the radius on z at axial places (m)."""
        return self._slope(np.clip(z, *self._ends))
