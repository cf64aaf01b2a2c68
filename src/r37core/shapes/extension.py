"""Shapes that move as an extension."""

from r37core.plans.extension import Extension

from .plan import SECTION, targets

_CAPTIONS = {
    "mode_shapes": (
        "The first modes of blade {blade} at rest, each moved by its shape from the blade as it is (black outline). Colours "
        "above: displacement as a share of its largest; below: von Mises stress for 1 mm of it. The page of the blade's shapes "
        "moves them."
    ),
    "worst_shapes": (
        "Blade {blade} in scene {scene} at the worst instant of each interaction, displaced as the title says (black "
        "outline: as it is). Colours are the von Mises stress, each on a scale of its own."
    ),
}

EXTENSION = Extension(
    name="shapes",
    section=SECTION,
    targets=targets,
    captions=_CAPTIONS,
)
