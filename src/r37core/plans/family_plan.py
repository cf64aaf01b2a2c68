"""The plan of families of designs: what is compared, and where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from r37core.config import Settings


@dataclass(frozen=True)
class Families:
    """Plan of the families that `settings` have. Methods with `wildcards` are parameters of rules."""

    settings: Settings

    @property
    def designs(self) -> dict[str, dict[str, float]]:
        """Designs that are run, with the values of what varies."""
        return {
            blade: dict(zip(family.keys, family.designs[blade], strict=True))
            for family in self.settings.families.values()
            for blade in family.designs
            if blade in self.settings.blades
        }

    @property
    def densities(self) -> dict[str, float]:
        """Density (kg/m3) of each of them."""
        materials = {blade: self.settings.blades[blade].material for blade in self.designs}
        return {blade: material.density for blade, material in materials.items() if material is not None}

    def blades(self, wildcards: Any) -> list[str]:
        """Designs of one family that are run."""
        return [blade for blade in self.settings.families[wildcards.family].designs if blade in self.settings.blades]

    def varied(self, wildcards: Any) -> list[str]:
        """What varies in one family."""
        return list(self.settings.families[wildcards.family].keys)
