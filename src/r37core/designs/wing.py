"""The comparison of designs as a wing. What varies in a family stands in blades.yaml, which the spine reads."""

from __future__ import annotations

from r37core.plans.wing import Wing

from .captions import CAPTIONS
from .checks import families_have_shapes
from .plan import targets

WING = Wing(
    name="designs",
    checks=(families_have_shapes,),
    targets=targets,
    captions=CAPTIONS,
    closing="designs.closing.closing",
)
