"""casing of a scene: its shape, and its distance from the blade's tip."""

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Annotated, Any

from pydantic import Field, model_validator

from r37core.contact.casing import Casing
from r37core.contact.elastic_casing import ElasticCasing
from r37core.contact.ring import Ring, RingMode

from .declaring import DECLARED, declared_by, si_fields, si_form
from .section import LeftOut, Section, Without, left_out, refused

_HEIGHTS = ("amplitude_clearances", "amplitude_m")
"""Keys of the height of the lobes, of which a scene has one."""


class GrowthSection(Section):
    """Growth of the casing, linear between speeds."""

    speeds_rad_s: list[Annotated[float, Field(ge=0, le=1e6)]] | LeftOut = Field(
        default=None, min_length=2, description="Ascending speeds, from 0 to at least structure.maximum_speed_rad_s"
    )
    speeds_rpm: list[Annotated[float, Field(ge=0, le=9.5e6)]] | LeftOut = Field(
        default=None, min_length=2, description="The same speeds in revolutions per minute"
    )
    growth_m: list[Annotated[float, Field(ge=-0.01, le=0.01)]] = Field(
        min_length=2, description="Growth away from the blade at each speed, normal to the casing; 0 at the first"
    )

    def _check(self) -> None:
        keys = [key for key in ("speeds_rad_s", "speeds_rpm") if getattr(self, key) is not None]
        if len(keys) != 1:
            raise refused((), " and ".join(keys) or "no speeds", "speeds_rad_s or speeds_rpm")
        _check_table(keys[0], getattr(self, keys[0]), "speed", "growth_m", self.growth_m, "cold_m")


class ChangeSection(Section):
    """Change of the clearance within a run, by heat and wear of the tip; linear between revolutions, constant beyond."""

    revolutions: list[Annotated[float, Field(ge=0, le=20000)]] = Field(
        min_length=2, description="Ascending revolutions from the start of each run, the first of them 0"
    )
    change_m: list[Annotated[float, Field(ge=-0.01, le=0.01)]] = Field(
        min_length=2, description="Change at each, normal to the casing, positive where the gap opens; 0 at the first"
    )

    def _check(self) -> None:
        _check_table("revolutions", self.revolutions, "revolution", "change_m", self.change_m, "clearance_m")


def _check_table(key: str, places: list[float], place: str, name: str, values: list[float], clearance: str) -> None:
    if places[0] != 0.0 or any(after <= before for before, after in pairwise(places)):
        raise refused((key,), f"{places}", f"ascending {place}s, the first of them 0")
    if len(places) != len(values):
        raise refused((name,), f"{len(values)} numbers for {len(places)} {place}s", f"one for each {place}")
    if values[0] != 0.0:
        raise refused((name, 0), f"{values[0]:g} at {place} 0", f"0; the clearance there is {clearance}")


class ClearanceSection(Section):
    """Clearance that changes with the speed, in place of clearance_m."""

    cold_m: float = Field(
        ge=1e-6, le=0.1, description="Clearance at rest, normal to the casing; amplitude_clearances counts it"
    )
    centrifugal: bool = Field(default=True, description="Whether the centrifugal load lengthens and untwists the blade")
    casing_growth: GrowthSection | LeftOut = None


@declared_by(Ring)
class RingSection(Section):
    """A flexible casing: a thin ring of one material on an elastic foundation, its flanges."""

    def _check(self) -> None:
        if self.thickness_m > 0.2 * self.radius_m:
            raise refused(("thickness_m",), f"{self.thickness_m:g}", f"at most a fifth of radius_m, {0.2 * self.radius_m:g}")


@declared_by(RingMode)
class RingModeSection(Section):
    """A mode of the casing, as a test or a finite-element model of it gives them; a pair where it has nodal diameters."""

    nodal_diameter: Any = DECLARED
    frequency_hz: Any = DECLARED
    modal_mass_kg: Any = DECLARED
    damping_ratio: Any = DECLARED
    tangential_ratio: Annotated[float, Field(ge=-10, le=10)] | LeftOut = left_out(
        "Tangential over radial displacement; by default 1/nodal_diameter (bending alone), or 0"
    )

    def mode(self) -> RingMode:
        """The mode as the simulations take it."""
        inextensional = 1.0 / self.nodal_diameter if self.nodal_diameter else 0.0
        tangential = inextensional if self.tangential_ratio is None else self.tangential_ratio
        return si_form(RingMode, self, frequency=2.0 * math.pi * self.frequency_hz, tangential=tangential)


@declared_by(Casing, amplitude_clearances=None)
class CasingSection(Section):
    """Shape and elasticity of the casing."""

    clearance_m: Any = DECLARED
    clearance: ClearanceSection | LeftOut = None
    clearance_over_revolutions: ChangeSection | LeftOut = None
    cone_angle_deg: Any = DECLARED
    lobes: Any = DECLARED
    width: Any = DECLARED
    amplitude_clearances: Any = DECLARED
    amplitude_m: Any = DECLARED
    rise_fraction: Any = DECLARED
    rise_revolutions: Any = DECLARED
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

    def _check(self) -> None:
        if (self.clearance_m is None) == (self.clearance is None):
            value = "neither of clearance_m and clearance" if self.clearance is None else "clearance_m and clearance"
            raise refused((), value, "one of clearance_m and clearance")
        if self.amplitude_clearances is not None and self.amplitude_m is not None:
            raise refused((), " and ".join(_HEIGHTS), "one of them; null (None in Python) leaves out that of the base")
        if self.ring is not None and self.ring_modes is not None:
            raise refused((), "ring and ring_modes", "one of them")

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
            return ElasticCasing(tuple(mode.mode() for mode in self.ring_modes or ()))
        ring = si_form(Ring, self.ring)
        return ElasticCasing(ring.modes(), ring)

    def casing(self) -> Casing:
        """The casing as the simulations take it."""
        more: dict[str, Any] = {"ring": self.elastic_casing().modes, "ring_radius": self.ring.radius_m if self.ring else None}
        if (change := self.clearance_over_revolutions) is not None:
            more |= {"change_revolutions": tuple(change.revolutions), "change": tuple(change.change_m)}
        if self.clearance is None:
            return si_form(Casing, self, **more)
        table = si_fields(self.clearance.casing_growth or ())
        growth = {"growth_speeds": table.get("speeds", ()), "growth": table.get("growth", ())}
        cold = {"clearance": self.clearance.cold_m, "centrifugal": self.clearance.centrifugal}
        return si_form(Casing, self, **more, **cold, **growth)
