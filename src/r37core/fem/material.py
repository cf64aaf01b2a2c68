"""Material of the blade."""

from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key

_DENSITIES, _STRENGTHS = (1000.0, 20000.0), (1e7, 5e9)


@dataclass(frozen=True)
class Material:
    """Isotropic linear elastic material. Without a yield stress it never yields; without the other strengths it never tires."""

    youngs_modulus: Annotated[float, Key("Young's modulus", "_pa", ge=1e6, le=1e13)]
    density: Annotated[float, Key("Density", "_kg_m3", ge=1, le=1e5)]
    poissons_ratio: Annotated[float, Key("Poisson's ratio", gt=-1, lt=0.5)]
    yield_stress: Annotated[
        float, Key("Stress above which results mark a speed; the model stays linear", "_pa", ge=1, le=1e12)
    ] = float("inf")
    fatigue_strength: Annotated[
        float, Key("Stress amplitude that it endures at zero mean, for the result fatigue", "_pa", ge=1, le=1e12, optional=True)
    ] = float("inf")
    ultimate_strength: Annotated[
        float, Key("Tensile strength, for the result fatigue", "_pa", ge=1, le=1e12, optional=True)
    ] = float("inf")
    fatigue_cycles: Annotated[float, Key("Cycles that it endures the fatigue strength", ge=1e3, le=1e12, optional=True)] = 1e7
    fatigue_exponent: Annotated[
        float, Key("Exponent of its S-N line, for Miner's sum of run-ups", ge=1, le=100, optional=True)
    ] = float("inf")

    @property
    def elastic(self) -> Self:
        """The material without its strengths: none of them changes what is computed of a linear blade."""
        return type(self)(self.youngs_modulus, self.density, self.poissons_ratio)

    @property
    def lame_constants(self) -> tuple[float, float]:
        """Lame's first constant and the shear modulus (Pa)."""
        shear = self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))
        return 2.0 * shear * self.poissons_ratio / (1.0 - 2.0 * self.poissons_ratio), shear

    def stress(self, strain: ndarray) -> ndarray:
        """Stress (Pa) of a strain, both of shape (..., 3, 3): Hooke's law."""
        lame, shear = self.lame_constants
        return 2.0 * shear * strain + lame * np.trace(strain, axis1=-2, axis2=-1)[..., None, None] * np.eye(3)

    @property
    def unusual(self) -> dict[str, tuple[float, tuple[float, float]]]:
        """Key -> value and usual range, in the key's unit, of what lies outside that of alloys and composites."""
        numbers = {"density_kg_m3": (self.density, _DENSITIES)}
        for key in ("yield_stress", "fatigue_strength", "ultimate_strength"):
            numbers[f"{key}_pa"] = (getattr(self, key), _STRENGTHS)
        return {
            key: (value, usual)
            for key, (value, usual) in numbers.items()
            if np.isfinite(value) and not usual[0] <= value <= usual[1]
        }

    def check_strengths(self) -> None:
        """Raise ValueError for one strength of the Goodman line without the other, and for amplitudes that break the blade."""
        known = [f"{name}_pa" for name in ("fatigue_strength", "ultimate_strength") if np.isfinite(getattr(self, name))]
        if len(known) == 1:
            raise ValueError(f"{known[0]} alone; allowed: fatigue_strength_pa and ultimate_strength_pa, both or neither")
        if not known and np.isfinite(self.fatigue_exponent):
            raise ValueError("fatigue_exponent alone; allowed: with fatigue_strength_pa and ultimate_strength_pa")
        low, high = self.fatigue_strength, self.ultimate_strength
        if known and not low < high:
            raise ValueError(f"fatigue_strength_pa: found {low:g}; allowed: less than ultimate_strength_pa ({high:g})")
        if known and np.isfinite(self.yield_stress) and not low <= self.yield_stress <= high:
            between = f"{low:g} to {high:g}, from fatigue_strength_pa to ultimate_strength_pa"
            raise ValueError(f"yield_stress_pa: found {self.yield_stress:g}; allowed: {between}")

    def check_units(self) -> None:
        """Raise ValueError for a stiffness and density that no solid has in SI units: N, mm and t mixed with m and kg."""
        sound = np.sqrt(self.youngs_modulus / self.density)
        low, high = 300.0, 20000.0
        if not (low < sound < high and 1e8 < self.youngs_modulus < 2e12):
            raise ValueError(
                f"Young's modulus {self.youngs_modulus:g} Pa and density {self.density:g} kg/m3 give a speed of sound of "
                f"{sound:.3g} m/s; allowed: {low:g} to {high:g}. Units seem to be mixed: give Pa and kg/m3, also for a mesh in "
                "mm"
            )
