"""Sections of all kinds of blades: a material, and regions of the stress."""

from collections.abc import Iterable, Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from r37core.base.declared import declared_keys
from r37core.fem.material import Material
from r37core.rom.region_choice import RegionChoice
from r37core.stress.gauge import Gauge

from .declaring import declared_by, section_of, si
from .section import Section, refused

Contact = Literal["points", "patches"]
CONTACT_IN_WORDS = "Contact acts on mesh nodes (points, as published), or on patches of the tip line"

Kinematics = Literal["linear", "rotating", "quadratic"]
KINEMATICS_IN_WORDS = "Displacements: linear, as published; rotating, about the rotating equilibrium; or quadratic, large ones"


Degrees = Annotated[float, Field(ge=0, lt=360)]
"""An angle round the casing."""


GaugeEntry: Any = section_of(Gauge, "A strain gauge on the blade's surface.")
MaterialSection: Any = section_of(Material, "Isotropic material; the base gives what is left out.", optional=True)

MATERIAL = "material."
MATERIAL_KEYS = tuple(MATERIAL + key for key in MaterialSection.model_fields)
"""Numbers of a blade's material."""

REQUIRED_OF_MATERIAL = tuple(declared.name for declared in declared_keys(Material) if not declared.key.optional)
"""Keys that a material has, its own or of its base."""


@declared_by(RegionChoice)
class RegionSection(Section):
    """Region of the stress: unclamped nodes within these bounds."""

    def _check(self) -> None:
        for lower, upper in (("minimum_z_m", "maximum_z_m"), ("minimum_span", "maximum_span")):
            lowest, highest = getattr(self, lower), getattr(self, upper)
            if None not in (lowest, highest) and not lowest < highest:
                raise refused(f"{lowest:g}", f"less than {upper} ({highest:g})", lower)


def refuse_taken_names(regions: Iterable[str]) -> None:
    """Refuse names of regions that other columns of ranking.csv end with."""
    for name in {"operating", "rest", "scatter", "worst"}.intersection(regions):
        raise refused(f"'{name}'", "another name: columns of ranking.csv end like this", "stress_regions", name)


def chosen_regions(sections: Mapping[str, RegionSection | None]) -> dict[str, RegionChoice]:
    """Regions by name, without those that null leaves out."""
    return {name: si(section) for name, section in sections.items() if section is not None}
