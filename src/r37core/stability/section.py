"""stability of config.yaml: which extremes are run, and in which scenes."""

from __future__ import annotations

from pydantic import Field

from r37core.cases.section import CasesSection
from r37core.config.section import AllOrNames, ExtensionSection


class StabilitySection(CasesSection):
    """Runs at extremes of the parameters (snakemake stability)."""

    extremes: AllOrNames = Field(default="all", description="Extremes, such as lobes, bars or mesh_nodes")


SECTION = ExtensionSection("stability", StabilitySection, StabilitySection())
