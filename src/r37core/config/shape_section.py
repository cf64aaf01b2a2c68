"""Shapes to look at of scenes with `shapes` among their results, in config.yaml."""

from __future__ import annotations

from pydantic import Field

from .section import Section


class ShapeSection(Section):
    """Modes and worst instants as files that move."""

    modes: int = Field(default=6, ge=1, le=30, description="how many modes of each blade, at rest")
