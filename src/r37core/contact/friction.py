"""Direction of Coulomb friction. A formula for arrays; the time integration compiles it as it stands."""

from __future__ import annotations

from typing import Any

import numpy as np


def friction_direction(tangential: Any, meridional: Any) -> tuple[Any, Any]:
    """Unit vectors of the friction forces on nodes, opposite to their sliding over the casing; zero where nothing slides.

    `tangential`, `meridional`: parts of the sliding velocity, or of the sliding in one step, in any one unit.
    """
    size = np.sqrt(tangential * tangential + meridional * meridional)
    opposite = np.where(size > 0.0, -1.0 / size, 0.0)
    return tangential * opposite, meridional * opposite
