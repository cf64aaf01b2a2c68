"""stability of config.yaml: which extremes are run, and in which scenes."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Name, Section, left_out


class StabilitySection(Section):
    """What happens at extremes (snakemake stability)."""

    blade: Name | LeftOut = left_out("if left out, the first one of the run")
    scenes: AllOrNames = Field(default="all", description="of those that are run")
    base: Name | LeftOut = left_out("fidelity level that the extremes change; if left out, that of the run")
    engine_order: Annotated[int, Field(ge=1, le=100)] | LeftOut = left_out(
        "the speeds lie about this crossing of 1B; if left out, about the fastest one"
    )
    extremes: AllOrNames = Field(default="all", description="what is changed, such as lobes, bars or mesh_nodes")


SECTION = ExtensionSection("stability", StabilitySection, StabilitySection())
