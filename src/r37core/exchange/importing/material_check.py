"""Whether a material is given in SI units."""

from __future__ import annotations

import numpy as np

from r37core.exchange.refusal import ImportRefused
from r37core.fem.material import Material

_SOUND_BETWEEN = (300.0, 20000.0)
_STIFFNESS_BETWEEN = (1e8, 2e12)


def check_material(material: Material) -> None:
    """Refuse a stiffness and a density that no solid has in SI units: a sign of N, mm and t mixed with m and kg."""
    sound = np.sqrt(material.youngs_modulus / material.density)
    (low, high), (soft, hard) = _SOUND_BETWEEN, _STIFFNESS_BETWEEN
    if not (low < sound < high and soft < material.youngs_modulus < hard):
        raise ImportRefused(
            f"Young's modulus {material.youngs_modulus:g} Pa and density {material.density:g} kg/m3 give a speed of sound of "
            f"{sound:.3g} m/s; allowed: {low:g} to {high:g}. Units seem to be mixed: give Pa and kg/m3, also for a mesh in mm",
            "material",
        )
