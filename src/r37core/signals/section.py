"""signals of config.yaml: time signals of chosen speeds."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Discriminator, Field, Tag, model_validator

from r37core.config import si_fields
from r37core.config.declaring import declared_by
from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Name, Rpm, Section, Speed, Unique, refused
from r37core.config.speed_section import refuse_both_units

from .gauge import Gauge

SignalSpeeds = Annotated[
    Annotated[Literal["interactions"], Tag("word")] | Annotated[Unique[Speed], Tag("speeds")],
    Discriminator(lambda value: "speeds" if isinstance(value, list) else "word"),
]
Degrees = Annotated[float, Field(ge=0, lt=360)]


def _each_probe_once(probes: list[float]) -> list[float]:
    for number, probe in enumerate(probes):
        if probe in probes[:number]:
            raise refused((number,), f"a probe at {probe:g} degrees twice", "each angle once")
    return probes


@declared_by(Gauge)
class GaugeEntry(Section):
    """A strain gauge on the blade's surface."""


class SignalSection(Section):
    """Which signals of which runs are kept; none without speeds."""

    blades: AllOrNames = Field(default="all", description="of those that are run")
    speeds_rad_s: SignalSpeeds | LeftOut = Field(
        default=None,
        description="interactions: the peak speeds of each blade and scene that summary.csv has; or any speeds, each a run of "
        "its own",
    )
    speeds_rpm: Unique[Rpm] | LeftOut = Field(
        default=None, description="speeds in revolutions per minute, in place of speeds_rad_s"
    )
    revolutions: Annotated[int, Field(ge=1, le=20000)] | LeftOut = Field(
        default=None, description="how many at the end are kept; all without it"
    )
    gauges: dict[Name, GaugeEntry] = Field(default={}, description="strain gauges by name")
    probes_deg: Annotated[list[Degrees], AfterValidator(_each_probe_once)] = Field(
        default=[], description="angles round the casing at which tip timing takes arrivals, towards growing theta"
    )

    @model_validator(mode="after")
    def _has_speeds(self) -> SignalSection:
        if self.speeds_rad_s is not None and self.speeds_rpm is not None:
            refuse_both_units("speeds_rad_s", "speeds_rpm")
        for key in ("gauges", "probes_deg"):
            if getattr(self, key) and self.speeds() is None:
                raise refused((key,), f"{key} without speeds", "speeds_rad_s beside them")
        return self

    @property
    def key_of_speeds(self) -> str:
        """The key that speeds are given with."""
        return "speeds_rad_s" if self.speeds_rpm is None else "speeds_rpm"

    def speeds(self) -> list[float] | Literal["interactions"] | None:
        """Speeds (rad/s), ascending, or the word for those of interactions; None where no signals are asked for."""
        speeds = si_fields(self).get("speeds")
        return sorted(speeds) if speeds else "interactions" if self.speeds_rad_s else None


SECTION = ExtensionSection("signals", SignalSection, SignalSection())
