"""The comparison of designs as an extension. What varies stands in blades.yaml and scenes.yaml, which the pipeline reads."""

from r37core.base.varied_number import BLADE
from r37core.blade.definition import BladeDefinition
from r37core.config import Settings
from r37core.plans.extension import Extension, Panel

from .plan import Families, tables_of_maps, targets


def families_have_shapes(settings: Settings) -> None:
    """No family is of an imported blade: what is compared of designs needs their shape."""
    for name, family in Families(settings).families[BLADE].items():
        members = [settings.blades[design] for design in family.designs if design in settings.blades]
        if any(not isinstance(blade.definition, BladeDefinition) for blade in members):
            raise settings.documents.blades.refusal(
                (name,), "a family of an imported blade", "families of blades with profiles"
            )


def families_differ_in_name(settings: Settings) -> None:
    """No family of scenes is called like one of blades: figures have their names."""
    taken = {name.lower() for name in settings.designs.families}
    for name in settings.scene_designs.families:
        if name.lower() in taken:
            raise settings.documents.scenes.refusal((name,), f"'{name}', which is a family of blades, too", "another name")


EXTENSION = Extension(
    name="designs",
    checks=(families_have_shapes, families_differ_in_name),
    targets=targets,
    captions={
        "designs": (
            "Family {family}: what each design is and how robust, over what varies. Of blades frequencies and largest loss of "
            "clearance as the tip swings along free modes; where interactions lie, speeds above yield in most and in some "
            "revolutions, largest stress."
        ),
        "map": (
            "Family {family} over two numbers that vary. Colour: length of the speeds above yield in most revolutions, in the "
            "operating range where there is one. Lines: where a requirement is just met."
        ),
    },
    closing="designs.table.closing",
    panel=Panel(tables_of_maps, "designs.panel.contents", "designs/panel.js"),
)
