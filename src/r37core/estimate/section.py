"""estimate of config.yaml: how large a sample is timed."""

from __future__ import annotations

from pydantic import Field

from r37core.config.section import ExtensionSection, Section


class EstimateSection(Section):
    """Cost of a whole sweep (snakemake estimate)."""

    every: int = Field(
        default=50, ge=1, le=1_000_000, description="One of this many speeds is run, in all scenes, for every blade"
    )
    cores: int = Field(default=2, ge=1, le=1_000_000, description="Cores of the projected wall time")
    workflow_s_per_job: float = Field(
        default=0.045, ge=0, le=1000, description="CPU seconds of Snakemake itself per job, measured in a sweep of 17,514"
    )


SECTION = ExtensionSection("estimate", EstimateSection, EstimateSection())
