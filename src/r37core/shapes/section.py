"""shapes of config.yaml: modes and worst instants that move."""

from __future__ import annotations

from pydantic import Field

from r37core.config.section import ExtensionSection, Section


class ShapeSection(Section):
    """Animated files of modes and worst instants."""

    modes: int = Field(default=6, ge=1, le=30, description="Number of modes of each blade, at rest")


SECTION = ExtensionSection("shapes", ShapeSection, ShapeSection())
