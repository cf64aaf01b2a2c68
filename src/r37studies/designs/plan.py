"""The plan of families of designs: what is compared, what is drawn, and where it lies."""

from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

from r37core.base.plain import to_plain
from r37core.base.varied_number import BLADE, SCENE, VariedNumber
from r37core.blade.definition import Shape
from r37core.config import Settings
from r37core.config.families import Family
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure, Panel
from r37core.plans.sweep_plan import Sweep

from .compared import BOTH, Compared

TABLE = "<results>/designs.csv"


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
                design: {VariedNumber(kind, key).name: value for key, value in values.items()}
                for family in families.values()
                for design, values in family.items()
            }
            for kind, families in self.families.items()
        }

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
            if blade.material is not None and isinstance(blade.definition, Shape)
        }

    @cached_property
    def figures(self) -> dict[str, Compared]:
        """Designs that the figure of each family compares, by its name."""
        settings, figures, family_of = self.settings, {}, self.settings.scene_designs.family_of
        # scenes of no family, or all where there are only those of families
        plain = tuple(name for name in settings.scene_names if name not in family_of) or tuple(settings.scene_names)
        for kind, families in self.families.items():
            for name, family in families.items():
                designs, keys = tuple(family), next(iter(family.values()))
                blades, scenes = (designs, plain) if kind == BLADE else (tuple(settings.blade_names), designs)
                figures[name] = Compared(kind, tuple(VariedNumber(kind, key).name for key in keys), blades, scenes)
        return figures

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
        """Designs that one figure or map compares, as plain values."""
        return to_plain((self.figures | self.maps)[wildcards.family])


def families_can_be_compared(settings: Settings) -> None:
    """No family is of an imported blade, as shapes are compared, and none of scenes is called like one of blades."""
    for name, family in Families(settings).families[BLADE].items():
        members = [settings.blades[design] for design in family if design in settings.blades]
        if any(not blade.has_profiles for blade in members):
            allowed = "families of blades with profiles"
            raise settings.designs.document.refusal("a family of an imported blade", allowed, name)
    taken = {name.lower() for name in settings.designs.families}
    for name in settings.scene_designs.families:
        # figures have their names
        if name.lower() in taken:
            raise settings.scene_designs.document.refusal(f"'{name}', which is a family of blades, too", "another name", name)


def _of(sweep: Sweep) -> Families:
    return sweep.settings.made(Families)


EXTENSION = Extension(
    name="designs",
    checks=(families_can_be_compared,),
    targets=lambda sweep: {TABLE: [{}] if _of(sweep).figures else []},
    figures=(
        # a run that has a map names it first
        Figure(
            rule="design_map",
            name="map_{family}",
            runs=lambda sweep: paths.of("family", _of(sweep).maps),
            draw="r37studies.designs.maps.draw_design_map",
            files={"table": TABLE},
            label="map of {family}",
            caption="Family {family} over two numbers that vary. Colour: length of the dangerous speeds, in the operating "
            "range where there is one; without any, share of the Goodman line. Hatched: the model is left first at some "
            "speeds; the numbers are both ends of the bracket. Lines: where a requirement begins to fail.",
            category="Families",
            arguments=lambda sweep: {"compared": _of(sweep).compared},
            offered=("verdict",),
        ),
        Figure(
            rule="design_figure",
            name="designs_{family}",
            runs=lambda sweep: paths.of("family", _of(sweep).figures),
            draw="r37studies.designs.figures.draw_designs",
            files={"table": TABLE},
            label="{family}",
            caption="Family {family}: what each design is and how robust, over what varies. Of blades frequencies and largest "
            "loss of clearance as the tip swings along free modes; where interactions lie, dangerous, unknown and "
            "sustained speeds, stress, share of the Goodman line.",
            category="Families",
            arguments=lambda sweep: {"compared": _of(sweep).compared},
        ),
    ),
    closing="r37studies.designs.table.closing",
    panel=Panel(
        TABLE, "r37studies.designs.maps.contents", "r37studies/designs/panel.js", shown=lambda sweep: bool(_of(sweep).maps)
    ),
)
