"""Material of a blade, in blades.yaml."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from .section import LeftOut, Section


class MaterialSection(Section):
    """Isotropic material; what is left out comes from the base."""

    youngs_modulus_pa: Annotated[float, Field(ge=1e6, le=1e13)] | LeftOut = None
    density_kg_m3: Annotated[float, Field(ge=1, le=1e5)] | LeftOut = None
    poissons_ratio: Annotated[float, Field(gt=-1, lt=0.5)] | LeftOut = None
    yield_stress_pa: Annotated[float, Field(ge=1, le=1e12)] | LeftOut = None
