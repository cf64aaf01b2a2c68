"""Sections of all kinds of blades: a material, and a region where stress is recovered."""

from typing import Literal, Self

from pydantic import model_validator

from r37core.base.declared import declared_keys
from r37core.fem.material import Material
from r37core.rom.reduction_choice import StressSubmesh

from .declaring import declared_by
from .section import Section, refused

Contact = Literal["points", "patches", "area_patches"]
CONTACT_IN_WORDS = (
    "Contact acts on mesh nodes (points, as published), on patches of the tip line, or on area_patches of the whole tip face"
)


@declared_by(Material, optional=True)
class MaterialSection(Section):
    """Isotropic material; the base gives what is left out."""


REQUIRED_OF_MATERIAL = tuple(declared.name for declared in declared_keys(Material) if not declared.key.optional)
"""Keys that a material has, its own or of its base."""


class _Box(Section):
    @model_validator(mode="after")
    def _has_a_height(self) -> Self:
        lowest, highest = self.minimum_z_m, self.maximum_z_m
        if None not in (lowest, highest) and not lowest < highest:
            raise refused(("minimum_z_m",), f"{lowest:g}", f"less than maximum_z_m ({highest:g})")
        return self


@declared_by(StressSubmesh, maximum_x_m=0.197, minimum_z_m=0.0165, maximum_z_m=0.0265)
class Submesh(_Box):
    """Region of the recovered stress: all nodes within these bounds."""


@declared_by(StressSubmesh, excluded_layers=1)
class ImportedSubmesh(_Box):
    """Region of the recovered stress: nodes away from contact nodes and root, and within these bounds."""
