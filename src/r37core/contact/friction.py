"""Direction of Coulomb friction."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True, forceinline=True)
def friction_direction(rotation_velocity, tangential_velocity, axial_velocity, vector):
    """Unit vector (tangential, axial) of the friction force on a node; opposite to its sliding velocity.

    `rotation_velocity`: signed tangential velocity of the rotation (m/s); the others: of the vibration.
    """
    if not vector:
        return (-1.0 if rotation_velocity > 0.0 else 1.0), 0.0
    tangential = rotation_velocity + tangential_velocity
    size = np.sqrt(tangential * tangential + axial_velocity * axial_velocity)
    if size == 0.0:
        return 0.0, 0.0
    return -tangential / size, -axial_velocity / size
