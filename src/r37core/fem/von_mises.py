"""Von Mises stress. Light: the simulation jobs import it."""

from __future__ import annotations

import numpy as np

COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
"""Order of the components of a stress: xx yy zz xy yz zx."""


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Von Mises stress (Pa), shape (...), of components in the order of COMPONENTS, shape (6, ...)."""
    xx, yy, zz, xy, yz, zx = stress
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))
