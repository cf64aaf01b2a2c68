"""config.yaml: what to run, and at which speeds: numbers and ranges, in rad/s or in revolutions per minute."""

from collections.abc import Iterable
from typing import Annotated, Any, Generic, Literal, Self, TypeVar

from pydantic import Field, create_model

from r37core.adaptive.refinement_choice import RefinementChoice, Window
from r37core.contact.scene import Scene
from r37core.results.interaction_choice import InteractionChoice
from r37core.results.operating_range import OperatingDwell, OperatingRange
from r37core.rom.reduction_choice import BoundaryChoice, ReductionChoice

from .blade_sections import Contact, Kinematics, RegionSection, refuse_taken_names
from .declaring import declared_by, section_of, si
from .section import (
    AllOrNames,
    ByName,
    ExtensionSection,
    FileName,
    LeftOut,
    Name,
    Names,
    Rpm,
    Section,
    Speed,
    Unique,
    either,
    left_out,
    option,
    refused,
)

UNITS = {"speeds": "rad/s", "speeds_rpm": "rpm"}
"""Keys that give speeds, of which a section has one, and their units."""

T = TypeVar("T", bound=float)


class _Range(Section, Generic[T]):
    start: T = option("First speed")
    stop: T = option("Last speed, if the step reaches it")
    step: T | LeftOut = left_out("Step between the speeds; by default the fidelity level's")
    refine_to: T | LeftOut = left_out("Smallest interval of adaptive sampling, a whole part of the step")

    def _check(self) -> None:
        if self.stop < self.start:
            raise refused(f"a range from {self.start:g} to {self.stop:g}", "stop not below start")


class SpeedRange(_Range[Speed]):
    """Speeds from `start` to `stop`, both included."""


class RpmRange(_Range[Rpm]):
    """Speeds in rpm from `start` to `stop`, both included."""


SpeedList: Any = Annotated[list[either(Speed, SpeedRange)], Field(min_length=1)]  # type: ignore[misc]
RpmList: Any = Annotated[list[either(Rpm, RpmRange)], Field(min_length=1)]  # type: ignore[misc]


class SpeedRule(Section):
    """Speeds of some blades or scenes (both, where both are given)."""

    one_of = (("speeds", "speeds_rpm"),)

    blades: Names | LeftOut = left_out("Blades with these speeds; all without it")
    scenes: Names | LeftOut = left_out("Scenes with these speeds; all without it")
    speeds: SpeedList | LeftOut = left_out("Speeds of these blades and scenes")
    speeds_rpm: RpmList | LeftOut = left_out("The same speeds in revolutions per minute")


def word_or_speeds(*words: str) -> Any:
    """Type of a key with speeds (rad/s), or one of some words in their place."""
    return either(Literal[words], rows=Unique[Speed])


def key_of_speeds(section: Any) -> str:
    """Which key a section gives its speeds with."""
    return "speeds" if section.speeds_rpm is None else "speeds_rpm"


@declared_by(BoundaryChoice)
class Boundary(Section):
    """The contact nodes, kept as physical coordinates of the reduced model."""

    contact: Contact | LeftOut = left_out("Contact of all blades, in place of `contact` in blades.yaml")


_SHIPPED_REGIONS = {
    "airfoil": {"minimum_span": 0.05, "maximum_span": 0.9, "highest_frequency_hz": 7500.0},
    "airfoil_unfiltered": {"minimum_span": 0.05, "maximum_span": 0.9},
}


@declared_by(ReductionChoice, only=("quadratic_modes", "spin_softening", "recover_whole_blade"))
class StructureSection(Section):
    """Geometry and reduced model."""

    edges: Literal["round", "blunt"] = option("Shape of the leading and trailing edges", "round")
    boundary: Boundary = Boundary()
    maximum_speed_rad_s: Speed = option("Highest speed of the basis and the Campbell diagram", 2000.0)
    kinematics: Kinematics | LeftOut = left_out("Kinematics of all blades, in place of `kinematics` in blades.yaml")
    stress_regions: ByName[RegionSection | None] = option(
        "Regions of the stress; the first decides, null leaves one out of every blade", _SHIPPED_REGIONS, validate_default=True
    )

    def _check(self) -> None:
        if not any(self.stress_regions.values()):
            raise refused("no region", "one or more", "stress_regions")
        refuse_taken_names(self.stress_regions)


class CampbellSection(Section):
    """The Campbell diagram."""

    speed_step_rad_s: float = option("Step between the speeds of the diagram", 50.0, ge=0.1, le=1e6)
    modes: int = option("Number of modes drawn and kept", 10, ge=3, le=30)
    highest_engine_order: int = option("Highest engine order of the crossings", 20, ge=1, le=100)
    largest_tangential_displacement_m: float = option(
        "Displacement of the leading edge in the dynamic clearance", 0.01, ge=1e-9, le=1
    )


Interactions: Any = section_of(InteractionChoice, "Peaks that count as interactions in summary.csv.")


@declared_by(Window)
class WindowSection(Section):
    """Speeds above the crossings of a mode, sampled first."""

    def _check(self) -> None:
        if not self.first < self.last:
            raise refused(f"{self.last:g}", f"more than first ({self.first:g})", "last")


class DirectRefinementSection(Section):
    """Settings for scenes with bare casing, whose response scatters from speed to speed."""

    windows: list[WindowSection] = option("Windows in scenes with bare casing", [])
    largest_share: float = option("Largest share of the finest grid in scenes with bare casing", 0.125, ge=1e-3, le=1)


@declared_by(RefinementChoice)
class RefinementSection(Section):
    """Adaptive sampling of ranges with `refine_to`."""

    windows: list[WindowSection] = option(
        "Speed windows in which interactions are expected",
        [
            {"mode": "1B", "highest_engine_order": 8, "first": 0.01, "last": 0.06, "step_rad_s": 5.0},
            {"mode": "1T", "highest_engine_order": 20, "first": 0.0, "last": 0.02, "step_rad_s": 5.0},
        ],
        validate_default=True,
    )
    direct: DirectRefinementSection = DirectRefinementSection()

    def scene_refinement(self, scene: Scene) -> Self:
        """Refinement in a scene: without lining with windows and share of its own."""
        return self if scene.lined else self.model_copy(update=dict(self.direct))


@declared_by(OperatingDwell)
class OperatingDwellSection(Section):
    """A share of the operating time that is spent between two speeds."""

    one_of = (("from_rad_s", "from_rpm"), ("to_rad_s", "to_rpm"))

    def _check(self) -> None:
        dwell = si(self)
        if dwell.stop <= dwell.start:
            raise refused(f"a dwell from {dwell.start:g} to {dwell.stop:g} rad/s", "a last speed above the first one")


@declared_by(OperatingRange)
class OperatingSection(Section):
    """The speeds from idle to redline."""

    one_of = (("idle_rad_s", "idle_rpm"), ("redline_rad_s", "redline_rpm"))

    dwell: list[OperatingDwellSection] = option(
        "Speeds at which more time is spent; the rest of it is spread evenly over the range", []
    )

    def _check(self) -> None:
        operating: OperatingRange = si(self)
        both = f"{operating.idle:.6g} to {operating.redline:.6g} rad/s"
        if operating.redline <= operating.idle:
            raise refused(f"an operating range from {both}", "a redline above idle")
        for number, dwell in enumerate(operating.dwell):
            if dwell.start < operating.idle or dwell.stop > operating.redline:
                speeds = f"{dwell.start:.6g} to {dwell.stop:.6g} rad/s"
                raise refused(speeds, f"speeds between idle and redline, {both}", "dwell", number)
        total = sum(dwell.share for dwell in operating.dwell)
        if total > 1.0 + 1e-9:
            raise refused(f"{100.0 * total:g} percent of the time", "at most 100 percent together", "dwell")


class Run(Section):
    """Folder of the results."""

    name: Name | LeftOut = left_out("Name of the run, whose results go to results/runs/<name>")


class Config(Section):
    """config.yaml, what to run."""

    blades_file: FileName = option("File with the blades", "config/blades.yaml")
    fidelity_file: FileName = option("File with the accuracy levels", "config/fidelity.yaml")
    scenes_file: FileName = option("File with the scenes", "config/scenes.yaml")
    blades: AllOrNames = option("Blades to run")
    scenes: AllOrNames = option("Scenes to run")
    fidelity: Name = option("Accuracy level")
    speeds: SpeedList = option("Speeds to simulate, as numbers and ranges", [SpeedRange(start=750.0, stop=2000.0)])
    speeds_rpm: RpmList | LeftOut = left_out("The same speeds in revolutions per minute; results stay in rad/s")
    speeds_for: list[SpeedRule] = option("Other speeds for some blades or scenes; the first entry that fits counts", [])
    structure: StructureSection = StructureSection()
    operating: OperatingSection | LeftOut = left_out("Speeds in operation, which results are judged by as well")
    interactions: Interactions = Interactions()
    refinement: RefinementSection = RefinementSection()
    run: Run = Run()
    campbell: CampbellSection = CampbellSection()

    def _check(self) -> None:
        if self.speeds_rpm is not None and "speeds" in self.model_fields_set:
            raise refused("speeds and speeds_rpm", "one of them", "speeds_rpm")


def config_model(sections: Iterable[ExtensionSection[Any]]) -> type[Config]:
    """config.yaml with the sections of extensions."""
    fields = {section.name: (section.kind, section.default) for section in sections}
    return create_model("Config", __base__=Config, __doc__=Config.__doc__, **fields)  # type: ignore[call-overload]
