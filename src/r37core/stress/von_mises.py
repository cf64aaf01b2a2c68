"""Von Mises stress. Light: the simulation jobs import it."""

from __future__ import annotations

import numpy as np


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Von Mises stress (Pa), shape (...), of components xx yy zz xy yz zx, shape (6, ...)."""
    xx, yy, zz, xy, yz, zx = stress
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))
