"""Material of the blade."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    """Isotropic linear elastic material: Young's modulus (Pa), density (kg/m3), Poisson's ratio, yield stress (Pa).

    Without a yield stress it never yields.
    """

    youngs_modulus: float
    density: float
    poissons_ratio: float
    yield_stress: float = float("inf")

    @property
    def lame_constants(self) -> tuple[float, float]:
        """Lame's first constant and the shear modulus (Pa)."""
        shear = self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))
        return 2.0 * shear * self.poissons_ratio / (1.0 - 2.0 * self.poissons_ratio), shear
