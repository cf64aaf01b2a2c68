"""Shapes that move as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .plan import SECTION, targets

_CAPTIONS = {
    "mode_shapes": (
        "The first modes of blade {blade} at rest, each moved by its shape from the blade as it is (black outline). The "
        "colour is the displacement as a share of its largest. The page of the blade's shapes moves them."
    ),
    "worst_shapes": (
        "Blade {blade} in scene {scene} at the worst instant of each interaction, displaced as the title says (black "
        "outline: as it is). Colours are the von Mises stress, each on a scale of its own."
    ),
}
"""Kind of figure -> what is seen in it."""

EXTENSION = Extension(name="shapes", section=SECTION, targets=targets, captions=_CAPTIONS)
