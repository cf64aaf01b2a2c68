"""exports of config.yaml: files for other programs."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from r37core.config import si_fields
from r37core.config.section import ExtensionSection, LeftOut, Rpm, Section, Unique
from r37core.config.speed_section import refuse_both_units, word_or_speeds

ModeSpeed = Annotated[float, Field(ge=0, le=1e6)]
ChosenSpeeds: Any = word_or_speeds("worst", "all")


class ExportSection(Section):
    """Files of `snakemake exports`."""

    mesh_formats: Unique[Literal["msh", "vtu", "med", "bdf", "inp"]] = Field(
        default=["msh", "vtu", "med", "bdf", "inp"], description="Mesh formats; inp is a complete CalculiX/Abaqus deck"
    )
    result_formats: Unique[Literal["vtu", "med"]] = Field(default=["vtu"], description="Formats of modes and stress")
    modes: int = Field(default=10, ge=1, le=30, description="Number of modes at each speed")
    mode_speeds_rad_s: Annotated[Unique[ModeSpeed], Field()] | LeftOut = Field(
        default=None, description="Speeds of the modes; by default rest and structure.maximum_speed_rad_s"
    )
    stress_speeds_rad_s: ChosenSpeeds = Field(
        default="worst",
        description="Speeds whose worst instant is written; worst: that of the largest stress of each blade and scene",
    )
    stress_speeds_rpm: Unique[Rpm] | LeftOut = Field(default=None, description="The same speeds in revolutions per minute")
    full_matrices: bool = Field(
        default=False, description="Whether matrices of all nodes (hundreds of MB) replace the reduced ones"
    )

    @model_validator(mode="after")
    def _one_unit(self) -> ExportSection:
        # the shipped config.yaml gives the default of stress_speeds_rad_s
        if self.stress_speeds_rpm is not None and self.stress_speeds_rad_s != "worst":
            refuse_both_units("stress_speeds_rad_s", "stress_speeds_rpm")
        return self

    def stress_speeds(self) -> tuple[float, ...] | None:
        """Speeds (rad/s) that are named; None for `worst` and `all`."""
        return si_fields(self).get("stress_speeds")


SECTION = ExtensionSection("exports", ExportSection, ExportSection())
