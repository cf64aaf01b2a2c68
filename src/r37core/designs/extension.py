"""The comparison of designs as an extension. What varies in a family stands in blades.yaml, which the pipeline reads."""

from r37core.blade.definition import BladeDefinition
from r37core.config import Settings
from r37core.plans.extension import Extension

from .plan import families, targets


def families_have_shapes(settings: Settings) -> None:
    """No family is of an imported blade: what is compared of designs needs their shape."""
    for name, family in families(settings).items():
        members = [settings.blades[design] for design in family.designs if design in settings.blades]
        if any(not isinstance(blade.definition, BladeDefinition) for blade in members):
            raise settings.documents.blades.refusal(
                (name,), "a family of an imported blade", "families of blades with profiles"
            )


EXTENSION = Extension(
    name="designs",
    checks=(families_have_shapes,),
    targets=targets,
    captions={
        "designs": (
            "Family {family}: what each design is and how robust, over what varies. Frequencies, largest loss of clearance as "
            "the tip swings along free modes, where interactions lie, speeds above yield in most and in some revolutions, "
            "largest stress."
        ),
    },
    closing="designs.table.closing",
)
