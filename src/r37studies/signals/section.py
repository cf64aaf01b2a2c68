"""signals of config.yaml: time signals of chosen blades, scenes and speeds."""

from typing import Annotated, Any, Literal

from pydantic import Field

from r37core.config import si_fields
from r37core.config.blade_sections import Degrees, GaugeEntry
from r37core.config.config_file import word_or_speeds
from r37core.config.section import (
    AllOrNames,
    EachOnce,
    ExtensionSection,
    LeftOut,
    Name,
    Rpm,
    Section,
    Unique,
    left_out,
    option,
    refused,
)

SignalSpeeds: Any = word_or_speeds("interactions")


class SignalSection(Section):
    """Kept signals; without speeds those of imported blades alone."""

    refuse_several = (("speeds_rad_s", "speeds_rpm"),)

    imported: bool = option("Signals of imported blades at the speeds of interactions, where no speeds are named", True)
    blades: AllOrNames = option("Blades with signals", "all")
    speeds_rad_s: SignalSpeeds | LeftOut = left_out(
        "Speeds with signals; interactions: the peak speeds in summary.csv; each other speed is a run"
    )
    speeds_rpm: Unique[Rpm] | LeftOut = left_out("The same speeds in revolutions per minute")
    revolutions: Annotated[int, Field(ge=1, le=20000)] | LeftOut = left_out("Revolutions kept at the end; all without it")
    gauges: dict[Name, GaugeEntry] = option("Strain gauges by name", {})
    probes_deg: EachOnce[Degrees] = option("Casing angles of tip-timing probes, towards growing theta", [])

    def _check(self) -> None:
        for key in ("gauges", "probes_deg"):
            if getattr(self, key) and self.speeds() is None:
                raise refused(f"{key} without speeds", "speeds_rad_s beside them", key)

    @property
    def key_of_speeds(self) -> str:
        """The key that speeds are given with."""
        return "speeds_rad_s" if self.speeds_rpm is None else "speeds_rpm"

    def speeds(self) -> list[float] | Literal["interactions"] | None:
        """Speeds (rad/s), ascending, or the word for those of interactions; None where none are named."""
        speeds = si_fields(self).get("speeds")
        return sorted(speeds) if speeds else "interactions" if self.speeds_rad_s else None


SECTION = ExtensionSection("signals", SignalSection, SignalSection())
