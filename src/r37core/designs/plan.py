"""The plan of families of designs: what is compared, and where it lies."""

from dataclasses import dataclass
from typing import Any

from r37core.config import Settings
from r37core.config.families import Family
from r37core.plans import paths
from r37core.plans.sweep_plan import Sweep


def families(settings: Settings) -> dict[str, Family]:
    """Families of which some designs are run."""
    run = set(settings.blade_names)
    return {name: family for name, family in settings.designs.families.items() if set(family.designs) & run}


@dataclass(frozen=True)
class Families:
    """Plan of the families that `settings` have. Methods with `wildcards` are parameters of rules."""

    settings: Settings

    @property
    def designs(self) -> dict[str, dict[str, float]]:
        """Designs that are run, with the values of what varies."""
        return {
            blade: dict(zip(family.keys, family.designs[blade], strict=True))
            for family in families(self.settings).values()
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
        return [blade for blade in families(self.settings)[wildcards.family].designs if blade in self.settings.blades]

    def varied(self, wildcards: Any) -> list[str]:
        """What varies in one family."""
        return list(families(self.settings)[wildcards.family].keys)


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The table of all designs, and a figure of each family."""
    wildcards = paths.of("family", families(sweep.settings))
    return {"<results>/designs.csv": wildcards and [{}], **paths.pictures("designs_{family}", wildcards)}
