"""The plan of families of designs: what is compared, what is drawn, and where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

from r37core.base.plain import to_plain
from r37core.base.varied_number import BLADE, SCENE, VariedNumber
from r37core.blade.definition import BladeDefinition
from r37core.config import Settings
from r37core.config.families import Family
from r37core.plans import paths
from r37core.plans.sweep_plan import Sweep

from .compared import BOTH, Compared


@dataclass(frozen=True)
class Families:
    """Plan of the families that `settings` have. Methods with `wildcards` are parameters of rules."""

    settings: Settings

    @cached_property
    def families(self) -> dict[str, dict[str, Family]]:
        """Kind -> name -> family with those of its designs that are run, some of them."""
        blades, scenes = self.settings.designs, self.settings.scene_designs
        return {BLADE: blades.families_of(self.settings.blade_names), SCENE: scenes.families_of(self.settings.scene_names)}

    @property
    def variables(self) -> dict[str, dict[str, dict[str, float]]]:
        """Kind -> design that is run -> column of designs.csv -> value of what varies."""
        return {
            kind: {
                design: {VariedNumber(kind, key).name: value for key, value in family.values(design).items()}
                for family in families.values()
                for design in family.designs
            }
            for kind, families in self.families.items()
        }

    @property
    def names(self) -> dict[str, dict[str, str]]:
        """Kind -> design -> family."""
        return {BLADE: self.settings.designs.family_of, SCENE: self.settings.scene_designs.family_of}

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene of which one is a design."""
        designs = self.variables
        pairs = [(blade, scene) for blade in self.settings.blade_names for scene in self.settings.scene_names]
        return [(blade, scene) for blade, scene in pairs if blade in designs[BLADE] or scene in designs[SCENE]]

    @property
    def densities(self) -> dict[str, float]:
        """Density (kg/m3) of each blade among the pairs whose volume is known: of those with profiles."""
        blades = {blade: self.settings.blades[blade] for blade, _ in self.pairs}
        return {
            name: blade.material.density
            for name, blade in blades.items()
            if blade.material is not None and isinstance(blade.definition, BladeDefinition)
        }

    @cached_property
    def figures(self) -> dict[str, Compared]:
        """Designs that the figure of each family compares, by its name."""
        settings = self.settings
        figures = {}
        for kind, families in self.families.items():
            for name, family in families.items():
                designs = tuple(family.designs)
                blades, scenes = (designs, self._plain_scenes) if kind == BLADE else (tuple(settings.blade_names), designs)
                figures[name] = Compared(kind, tuple(VariedNumber(kind, key).name for key in family.keys), blades, scenes)
        return figures

    @property
    def _plain_scenes(self) -> tuple[str, ...]:
        """Scenes of no family, or all where there are only those of families."""
        family_of = self.settings.scene_designs.family_of
        plain = tuple(name for name in self.settings.scene_names if name not in family_of)
        return plain or tuple(self.settings.scene_names)

    @cached_property
    def maps(self) -> dict[str, Compared]:
        """Designs drawn as maps: families of two keys, and a family of blades with one of scenes that have one key each."""
        figures = self.figures
        maps = {name: compared for name, compared in figures.items() if len(compared.keys) == 2}
        for blades, scenes in product(self.families[BLADE], self.families[SCENE]):
            across, up = figures[blades], figures[scenes]
            if len(across.keys) == len(up.keys) == 1:
                maps[f"{blades}__{scenes}"] = Compared(BOTH, across.keys + up.keys, across.blades, up.scenes)
        return maps

    def compared(self, wildcards: Any) -> dict[str, Any]:
        """Designs that one figure compares, as plain values."""
        return to_plain(self.figures[wildcards.family])

    def mapped(self, wildcards: Any) -> dict[str, Any]:
        """Designs that one map compares, as plain values."""
        return to_plain(self.maps[wildcards.family])


def tables_of_maps(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The table of designs, in a run with a map of them."""
    return {"<results>/designs.csv": [{}] if Families(sweep.settings).maps else []}


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The table of all designs, a figure of each family, and maps over two keys."""
    families = Families(sweep.settings)
    figures, maps = paths.of("family", families.figures), paths.of("family", families.maps)
    table: paths.Wildcards = [{}] if figures else []
    return {
        "<results>/designs.csv": table,
        **paths.pictures("map_{family}", maps),
        **paths.pictures("designs_{family}", figures),
    }
