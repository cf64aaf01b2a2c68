"""Parts of a stress whose length is the von Mises stress. Light: the simulation jobs import it."""

import numpy as np
from numpy import ndarray


def deviatoric(stress: ndarray) -> ndarray:
    """Parts a to e, shape (5, ...), float32, whose length is the von Mises stress, of components xx yy zz xy yz zx.

    a = sqrt(3)/2 (xx - yy),  b = zz - (xx + yy)/2,  (c, d, e) = sqrt(3) (xy, yz, zx)
    """
    xx, yy, zz, xy, yz, zx = stress
    root = np.sqrt(3.0)
    return np.stack([0.5 * root * (xx - yy), zz - 0.5 * (xx + yy), root * xy, root * yz, root * zx]).astype(np.float32)
