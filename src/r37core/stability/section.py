"""stability of config.yaml: which extremes are run, and in which scenes."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Name, Section, left_out


class StabilitySection(Section):
    """Runs at extremes of the parameters (snakemake stability)."""

    blade: Name | LeftOut = left_out("Blade; by default the first one of the run")
    scenes: AllOrNames = Field(default="all", description="Scenes of the run")
    base: Name | LeftOut = left_out("Fidelity level that the extremes change; by default that of the run")
    engine_order: Annotated[int, Field(ge=1, le=100)] | LeftOut = left_out(
        "Crossing of 1B that the speeds lie about; by default the fastest one"
    )
    extremes: AllOrNames = Field(default="all", description="Extremes, such as lobes, bars or mesh_nodes")


SECTION = ExtensionSection("stability", StabilitySection, StabilitySection())
