"""What is asked for beside the sweep, in config.yaml: files for other programs, moving shapes, time signals."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Discriminator, Field, Tag, model_validator

from r37core.signals.gauge import Gauge

from .declaring import declared_by
from .section import AllOrNames, LeftOut, Name, Rpm, Section, Speed, Unique, refused
from .si_fields import si_fields
from .speed_section import refuse_both_units

ModeSpeed = Annotated[float, Field(ge=0, le=1e6)]
ChosenSpeeds = Annotated[
    Annotated[Literal["worst", "all"], Tag("word")] | Annotated[Unique[Speed], Tag("speeds")],
    Discriminator(lambda value: "speeds" if isinstance(value, list) else "word"),
]


class ExportSection(Section):
    """What `snakemake exports` writes."""

    mesh_formats: Unique[Literal["msh", "vtu", "med", "bdf", "inp"]] = Field(
        default=["msh", "vtu", "med", "bdf", "inp"], description="inp: a complete CalculiX/Abaqus deck"
    )
    result_formats: Unique[Literal["vtu", "med"]] = Field(default=["vtu"], description="of modes and stress")
    modes: int = Field(default=10, ge=1, le=30, description="how many modes at each speed")
    mode_speeds_rad_s: Annotated[Unique[ModeSpeed], Field()] | LeftOut = Field(
        default=None, description="without it at rest and at structure.maximum_speed_rad_s"
    )
    stress_speeds_rad_s: ChosenSpeeds = Field(
        default="worst",
        description="speeds whose worst instant is written: worst, the one with the largest stress of a blade and scene; all; "
        "or some of those that are run",
    )
    stress_speeds_rpm: Unique[Rpm] | LeftOut = Field(
        default=None, description="some of those that are run, in revolutions per minute, in place of stress_speeds_rad_s"
    )
    full_matrices: bool = Field(
        default=False, description="matrices of all nodes (hundreds of MB) in place of the reduced ones"
    )

    @model_validator(mode="after")
    def _one_unit(self) -> ExportSection:
        # beside the default, which is also what config.yaml says
        if self.stress_speeds_rpm is not None and self.stress_speeds_rad_s != "worst":
            refuse_both_units("stress_speeds_rad_s", "stress_speeds_rpm")
        return self

    def stress_speeds(self) -> tuple[float, ...] | None:
        """Speeds (rad/s) that are named; None for `worst` and `all`."""
        return si_fields(self).get("stress_speeds")

    def only_worst(self) -> bool:
        """Whether the speed with the largest stress is written alone."""
        return self.stress_speeds() is None and self.stress_speeds_rad_s == "worst"


class ShapeSection(Section):
    """Modes and worst instants as files that move."""

    modes: int = Field(default=6, ge=1, le=30, description="how many modes of each blade, at rest")


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
        found = si_fields(self).get("speeds")
        return sorted(found) if found else "interactions" if self.speeds_rad_s else None
