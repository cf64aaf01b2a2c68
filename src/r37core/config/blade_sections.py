"""What all kinds of blades have: a material, and a region where stress is recovered."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import model_validator

from r37core.fem.material import Material
from r37core.rom.reduction_choice import StressSubmesh

from .declaring import declared_by
from .section import Section, refused

Contact = Literal["points", "patches", "area_patches"]
CONTACT_IN_WORDS = (
    "what contact acts on: points (mesh nodes, as published; direct contact then has no limit in the mesh), patches of the tip "
    "line, or area_patches of the tip's whole face"
)


@declared_by(Material, optional=True)
class MaterialSection(Section):
    """Isotropic material; what is left out comes from the base."""


class _Box(Section):
    @model_validator(mode="after")
    def _has_a_height(self) -> Self:
        lowest, highest = self.minimum_z_m, self.maximum_z_m
        if None not in (lowest, highest) and not lowest < highest:
            raise refused(("minimum_z_m",), f"{lowest:g}", f"less than maximum_z_m ({highest:g})")
        return self


@declared_by(StressSubmesh, maximum_x_m=0.197, minimum_z_m=0.0165, maximum_z_m=0.0265)
class Submesh(_Box):
    """Where stress is recovered; nodes with x (radial) below and z (downstream) between these bounds."""


@declared_by(StressSubmesh, excluded_layers=1)
class ImportedSubmesh(_Box):
    """Where stress is recovered on a blade of another program: everywhere but near contact nodes and root, or in a box too."""
