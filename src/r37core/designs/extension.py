"""The comparison of designs as an extension. What varies in a family stands in blades.yaml, which the pipeline reads."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .captions import CAPTIONS
from .checks import families_have_shapes
from .plan import targets

EXTENSION = Extension(
    name="designs",
    checks=(families_have_shapes,),
    targets=targets,
    captions=CAPTIONS,
    closing="designs.closing.closing",
)
