"""What `snakemake exports` writes for other programs, in config.yaml."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from .section import LeftOut, Section, Speed, Unique

ModeSpeed = Annotated[float, Field(ge=0, le=1e6)]
ChosenSpeeds = Annotated[
    Annotated[Literal["worst", "all"], Tag("word")] | Annotated[Unique[Speed], Tag("speeds")],
    Discriminator(lambda value: "speeds" if isinstance(value, list) else "word"),
]


class Exports(Section):
    """What `snakemake exports` writes."""

    mesh_formats: Unique[Literal["msh", "vtu", "med", "bdf", "inp"]] = Field(
        default=["msh", "vtu", "med", "bdf", "inp"], description="inp: a complete CalculiX/Abaqus deck"
    )
    result_formats: Unique[Literal["vtu", "med"]] = Field(default=["vtu"], description="of modes and stress")
    modes: int = Field(default=10, ge=1, le=30, description="how many modes at each speed")
    mode_speeds_rad_s: Annotated[Unique[ModeSpeed], Field()] | LeftOut = Field(
        default=None, description="without it at rest and at structure.maximum_speed_rad_s"
    )
    stress_speeds_rad_s: ChosenSpeeds = Field(
        default="worst",
        description="speeds whose worst instant is written: worst, the one with the largest stress of a blade and scene; all; "
        "or some of those that are run",
    )
    full_matrices: bool = Field(
        default=False, description="matrices of all nodes (hundreds of MB) in place of the reduced ones"
    )
