"""Keys that the sections of extensions with cases have in common."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from r37core.config.section import AllOrNames, LeftOut, Name, Section, left_out


class CasesSection(Section):
    """Which blade, scenes, level and speeds the cases are of."""

    blade: Name | LeftOut = left_out("Blade; by default the first one of the run")
    scenes: AllOrNames = Field(default="all", description="Scenes of the run")
    base: Name | LeftOut = left_out("Fidelity level of all that is not varied; by default that of the run")
    engine_order: Annotated[int, Field(ge=1, le=100)] | LeftOut = left_out(
        "Crossing of 1B that the speeds lie about; by default the fastest one"
    )
