"""Shapes that move as a wing."""

from __future__ import annotations

from r37core.plans.wing import Wing

from .captions import CAPTIONS
from .plan import targets
from .section import ShapeSection

WING = Wing(name="shapes", section=(ShapeSection, ShapeSection()), targets=targets, captions=CAPTIONS)
