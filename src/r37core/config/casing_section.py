"""casing of a scene: its shape, and its distance from the blade's tip."""

import math
from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Field, model_validator

from r37core.contact.casing import Casing
from r37core.contact.elastic_casing import FASTEST_TIP, ElasticCasing, nodal_diameters_for
from r37core.contact.ring import MOST_NODAL_DIAMETERS, Ring, RingMode

from .declaring import declared_by, si, si_fields, si_form
from .section import LeftOut, Section, Without, check_table, left_out, option, refused

_HEIGHTS = ("amplitude_clearances", "amplitude_m")
"""Keys of the height of the lobes, of which a scene has one."""


_Changes = list[Annotated[float, Field(ge=-0.01, le=0.01)]]
"""Changes (m) of a distance, one for each place of a table."""


class GrowthSection(Section):
    """Growth of the casing, linear between speeds."""

    one_of = (("speeds_rad_s", "speeds_rpm"),)

    speeds_rad_s: Annotated[list[Annotated[float, Field(ge=0, le=1e6)]], Field(min_length=2)] | LeftOut = left_out(
        "Ascending speeds, from 0 to at least structure.maximum_speed_rad_s"
    )
    speeds_rpm: Annotated[list[Annotated[float, Field(ge=0, le=9.5e6)]], Field(min_length=2)] | LeftOut = left_out(
        "The same speeds in revolutions per minute"
    )
    growth_m: _Changes = option("Growth away from the blade at each speed, normal to the casing; 0 at the first", min_length=2)

    def _check(self) -> None:
        check_table(self, "speeds_rpm" if self.speeds_rad_s is None else "speeds_rad_s", "growth_m", "cold_m")


class ChangeSection(Section):
    """Change of the clearance within a run, by heat and wear of the tip; linear between revolutions, constant beyond."""

    revolutions: list[Annotated[float, Field(ge=0, le=20000)]] = option(
        "Ascending revolutions from the start of each run, the first of them 0", min_length=2
    )
    change_m: _Changes = option(
        "Change at each, normal to the casing, positive where the gap opens; 0 at the first", min_length=2
    )

    def _check(self) -> None:
        check_table(self, "revolutions", "change_m", "clearance_m")


class ClearanceSection(Section):
    """Clearance that changes with the speed, in place of clearance_m."""

    cold_m: float = option("Clearance at rest, normal to the casing; amplitude_clearances counts it", ge=1e-6, le=0.1)
    centrifugal: bool = option("Whether the centrifugal load lengthens and untwists the blade", True)
    casing_growth: GrowthSection | LeftOut = None


@declared_by(Ring, highest_nodal_diameter=None)
class RingSection(Section):
    """A flexible casing: a thin ring of one material on an elastic foundation, its flanges."""

    def parts(self) -> dict[str, Any]:
        """The highest nodal diameter that the ring needs, where none is given."""
        if self.highest_nodal_diameter is not None:
            return {}
        ring = si_form(Ring, self)
        return {"highest_nodal_diameter": min(nodal_diameters_for(ring, FASTEST_TIP / ring.radius), MOST_NODAL_DIAMETERS)}

    def _check(self) -> None:
        if self.thickness_m > 0.2 * self.radius_m:
            raise refused(f"{self.thickness_m:g}", f"at most a fifth of radius_m, {0.2 * self.radius_m:g}", "thickness_m")


@declared_by(RingMode)
class RingModeSection(Section):
    """A mode of the casing, as a test or a finite-element model of it gives them; a pair where it has nodal diameters."""

    tangential_ratio: Annotated[float, Field(ge=-10, le=10)] | LeftOut = left_out(
        "Tangential over radial displacement; by default 1/nodal_diameter (bending alone), or 0"
    )

    def parts(self) -> dict[str, Any]:
        """Frequency in rad/s, and the tangential displacement of a ring that bends alone where none is given."""
        inextensional = 1.0 / self.nodal_diameter if self.nodal_diameter else 0.0
        tangential = inextensional if self.tangential_ratio is None else self.tangential_ratio
        return {"frequency": 2.0 * math.pi * self.frequency_hz, "tangential": tangential}


@declared_by(Casing, amplitude_clearances=None)
class CasingSection(Section):
    """Shape and elasticity of the casing."""

    one_of = (("clearance_m", "clearance"),)
    refuse_several = (_HEIGHTS, ("ring", "ring_modes"))

    clearance: ClearanceSection | LeftOut = None
    clearance_over_revolutions: ChangeSection | LeftOut = None
    ring: RingSection | LeftOut = left_out("Elastic casing as a ring; rigid without it")
    ring_modes: Annotated[list[RingModeSection], Field(min_length=1, max_length=200)] | LeftOut = left_out(
        "Elastic casing by modes, in place of ring"
    )

    @model_validator(mode="before")
    @classmethod
    def _height_written_out(cls, data: Any) -> Any:
        # the default is written out, so that it may spread like a height that is given
        if isinstance(data, Mapping) and all(data.get(key, Without.KEY) is Without.KEY for key in _HEIGHTS):
            return {**data, _HEIGHTS[0]: Casing.amplitude}
        return data

    @property
    def cold_clearance(self) -> float:
        """Clearance (m) at rest, which is that of every speed where it does not depend on speed."""
        return self.clearance_m if self.clearance is None else self.clearance.cold_m

    @property
    def elastic(self) -> bool:
        """True if the casing is flexible."""
        return self.ring is not None or self.ring_modes is not None

    def elastic_casing(self) -> ElasticCasing:
        """The flexible casing, with the waves that simulations leave out; without modes where the casing is rigid."""
        if self.ring is None:
            return ElasticCasing(tuple(map(si, self.ring_modes or ())))
        ring = si(self.ring)
        return ElasticCasing(ring.modes(), ring)

    def parts(self) -> dict[str, Any]:
        """The modes of the ring, and the clearance as it changes with revolutions and speed."""
        parts: dict[str, Any] = {"ring": self.elastic_casing().modes, "ring_radius": self.ring and self.ring.radius_m}
        if (change := self.clearance_over_revolutions) is not None:
            parts |= {"change_revolutions": tuple(change.revolutions), "change": tuple(change.change_m)}
        if (clearance := self.clearance) is not None:
            table = si_fields(clearance.casing_growth or ())
            parts |= {"growth_speeds": table.get("speeds", ()), "growth": table.get("growth", ())}
            parts |= {"clearance": clearance.cold_m, "centrifugal": clearance.centrifugal}
        return parts
