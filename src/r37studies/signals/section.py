"""signals of config.yaml: time signals of chosen blades, scenes and speeds."""

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field

from r37core.config import si_fields
from r37core.config.blade_sections import Degrees, GaugeEntry
from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Name, Rpm, Section, Unique, refused
from r37core.config.speed_section import word_or_speeds

SignalSpeeds: Any = word_or_speeds("interactions")


def _each_probe_once(probes: list[float]) -> list[float]:
    for number, probe in enumerate(probes):
        if probe in probes[:number]:
            raise refused((number,), f"a probe at {probe:g} degrees twice", "each angle once")
    return probes


class SignalSection(Section):
    """Kept signals; without speeds those of imported blades alone."""

    refuse_several = (("speeds_rad_s", "speeds_rpm"),)

    imported: bool = Field(
        default=True, description="Signals of imported blades at the speeds of interactions, where no speeds are named"
    )
    blades: AllOrNames = Field(default="all", description="Blades with signals")
    speeds_rad_s: SignalSpeeds | LeftOut = Field(
        default=None, description="Speeds with signals; interactions: the peak speeds in summary.csv; each other speed is a run"
    )
    speeds_rpm: Unique[Rpm] | LeftOut = Field(default=None, description="The same speeds in revolutions per minute")
    revolutions: Annotated[int, Field(ge=1, le=20000)] | LeftOut = Field(
        default=None, description="Revolutions kept at the end; all without it"
    )
    gauges: dict[Name, GaugeEntry] = Field(default={}, description="Strain gauges by name")
    probes_deg: Annotated[list[Degrees], AfterValidator(_each_probe_once)] = Field(
        default=[], description="Casing angles of tip-timing probes, towards growing theta"
    )

    def _check(self) -> None:
        for key in ("gauges", "probes_deg"):
            if getattr(self, key) and self.speeds() is None:
                raise refused((key,), f"{key} without speeds", "speeds_rad_s beside them")

    @property
    def key_of_speeds(self) -> str:
        """The key that speeds are given with."""
        return "speeds_rad_s" if self.speeds_rpm is None else "speeds_rpm"

    def speeds(self) -> list[float] | Literal["interactions"] | None:
        """Speeds (rad/s), ascending, or the word for those of interactions; None where none are named."""
        speeds = si_fields(self).get("speeds")
        return sorted(speeds) if speeds else "interactions" if self.speeds_rad_s else None


SECTION = ExtensionSection("signals", SignalSection, SignalSection())
