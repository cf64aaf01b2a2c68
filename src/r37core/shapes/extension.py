"""Shapes that move as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .captions import CAPTIONS
from .plan import targets
from .section import ShapeSection

EXTENSION = Extension(name="shapes", section=(ShapeSection, ShapeSection()), targets=targets, captions=CAPTIONS)
