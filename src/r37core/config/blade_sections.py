"""What all kinds of blades have: a material, and a region where stress is recovered."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Literal

from pydantic import Field, model_validator

from r37core.rom.reduction_choice import EVERYWHERE, StressSubmesh

from .section import LeftOut, Section, refused
from .si_fields import si_fields

Contact = Literal["points", "patches", "area_patches"]
CONTACT_IN_WORDS = (
    "what contact acts on: points (mesh nodes, as published; direct contact then has no limit in the mesh), patches of the tip "
    "line, or area_patches of the tip's whole face"
)

Coordinate = Annotated[float, Field(ge=-100, le=100)]
Layers = Annotated[int, Field(ge=0, le=20)]
_LAYERS = "layers of elements left out round contact nodes and root, where stress grows with every finer mesh"


class MaterialSection(Section):
    """Isotropic material; what is left out comes from the base."""

    youngs_modulus_pa: Annotated[float, Field(ge=1e6, le=1e13)] | LeftOut = Field(default=None, description="Young's modulus")
    density_kg_m3: Annotated[float, Field(ge=1, le=1e5)] | LeftOut = Field(default=None, description="density")
    poissons_ratio: Annotated[float, Field(gt=-1, lt=0.5)] | LeftOut = Field(default=None, description="Poisson's ratio")
    yield_stress_pa: Annotated[float, Field(ge=1, le=1e12)] | LeftOut = Field(
        default=None, description="results say where the stress is above it; nothing yields"
    )


class Submesh(Section):
    """Where stress is recovered; nodes with x (radial) below and z (downstream) between these bounds."""

    maximum_x_m: float = Field(default=0.197, gt=0, le=100, description="upper bound of x")
    minimum_z_m: Coordinate = Field(default=0.0165, description="lower bound of z")
    maximum_z_m: Coordinate = Field(default=0.0265, description="upper bound of z")
    excluded_layers: Layers = Field(default=0, description=_LAYERS)

    @model_validator(mode="after")
    def _has_a_height(self) -> Submesh:
        check_height(self.minimum_z_m, self.maximum_z_m)
        return self


class ImportedSubmesh(Section):
    """Where stress is recovered on a blade of another program: everywhere but near contact nodes and root, or in a box too."""

    maximum_x_m: Annotated[float, Field(gt=0, le=100)] | LeftOut = Field(default=None, description="upper bound of x")
    minimum_z_m: Coordinate | LeftOut = Field(default=None, description="lower bound of z")
    maximum_z_m: Coordinate | LeftOut = Field(default=None, description="upper bound of z")
    excluded_layers: Layers = Field(default=1, description=_LAYERS)

    @model_validator(mode="after")
    def _has_a_height(self) -> ImportedSubmesh:
        if self.minimum_z_m is not None and self.maximum_z_m is not None:
            check_height(self.minimum_z_m, self.maximum_z_m)
        return self


def stress_region(section: Submesh | ImportedSubmesh) -> StressSubmesh:
    """As the reduced model takes it: a bound that is not given is none."""
    return replace(EVERYWHERE, **si_fields(section))


def check_height(minimum: float, maximum: float) -> None:
    """Raise the error of bounds with nothing between them."""
    if not minimum < maximum:
        raise refused(("minimum_z_m",), f"{minimum:g}", f"less than maximum_z_m ({maximum:g})")
