"""casing of a scene: its shape, and its distance from the blade's tip."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, model_validator

from r37core.contact.casing import Casing

from .section import LeftOut, Section, refused
from .si_fields import in_si, si_fields


class GrowthSection(Section):
    """Growth of the casing over speed, from a model or a measurement of it; linear between the speeds."""

    speeds_rad_s: list[Annotated[float, Field(ge=0, le=1e6)]] | LeftOut = Field(
        default=None, min_length=2, description="ascending, from 0 on, and as far as structure.maximum_speed_rad_s"
    )
    speeds_rpm: list[Annotated[float, Field(ge=0, le=9.5e6)]] | LeftOut = Field(
        default=None, min_length=2, description="the same in revolutions per minute"
    )
    growth_m: list[Annotated[float, Field(ge=-0.01, le=0.01)]] = Field(
        min_length=2, description="away from the blade, along the casing's normal; at each of the speeds, 0 at the first"
    )

    @model_validator(mode="after")
    def _table(self) -> GrowthSection:
        given = [key for key in ("speeds_rad_s", "speeds_rpm") if getattr(self, key) is not None]
        if len(given) != 1:
            raise refused((), " and ".join(given) or "no speeds", "speeds_rad_s or speeds_rpm")
        speeds = getattr(self, given[0])
        if speeds[0] != 0.0 or any(after <= before for before, after in pairwise(speeds)):
            raise refused((given[0],), f"{speeds}", "ascending speeds, the first of them 0")
        if len(speeds) != len(self.growth_m):
            raise refused(("growth_m",), f"{len(self.growth_m)} numbers for {len(speeds)} speeds", "one for each speed")
        if self.growth_m[0] != 0.0:
            raise refused(("growth_m", 0), f"{self.growth_m[0]:g} at speed 0", "0; the clearance there is cold_m")
        return self


class ClearanceSection(Section):
    """A clearance that changes with the speed, in place of clearance_m."""

    cold_m: float = Field(ge=1e-6, le=0.1, description="at rest, normal to the casing; lobes are given in shares of it")
    centrifugal: bool = Field(default=True, description="whether the blade grows and untwists under its centrifugal load")
    casing_growth: GrowthSection | LeftOut = None


class CasingSection(Section):
    """Shape of the casing."""

    clearance_m: Annotated[float, Field(ge=1e-6, le=0.1)] | LeftOut = Field(
        default=None, description="normal to the casing, at every speed; or clearance, which changes with the speed"
    )
    clearance: ClearanceSection | LeftOut = None
    cone_angle_deg: Literal["tip"] | Annotated[float, Field(ge=-80, le=80)] = Field(
        default="tip",
        description="half angle of the casing's cone, negative where it narrows downstream, 0 for a cylinder; "
        "tip: that of each blade's tip",
    )
    lobes: int = Field(default=2, ge=0, le=100, description="0 is a circular casing")
    width: float = Field(default=0.15, ge=1e-3, le=100, description="width of a lobe in shares of its period")
    amplitude_clearances: float = Field(default=2.0, ge=0, le=1000, description="height of the lobes")
    rise_fraction: float = Field(default=0.2, ge=0, le=1, description="share of the run at which 99% is reached")

    @model_validator(mode="after")
    def _one_clearance(self) -> CasingSection:
        if (self.clearance_m is None) == (self.clearance is None):
            found = "neither of clearance_m and clearance" if self.clearance is None else "clearance_m and clearance"
            raise refused((), found, "one of clearance_m and clearance")
        return self

    def casing(self) -> Casing:
        """The casing as the simulations take it."""
        if self.clearance is None:
            return in_si(Casing, self)
        table = si_fields(self.clearance.casing_growth or ())
        return in_si(
            Casing,
            self,
            clearance=self.clearance.cold_m,
            centrifugal=self.clearance.centrifugal,
            growth_speeds=table.get("speeds", ()),
            growth=table.get("growth", ()),
        )
