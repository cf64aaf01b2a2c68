"""The section `studies` of config.yaml."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Generic, Literal, TypeVar

from pydantic import Field, model_validator

from .fidelity import TimeStep
from .section import AllOrNames, LeftOut, Name, Section, Unique, left_out, refused
from .spread import MemberCount, SpreadEntry

Value = TypeVar("Value")
Step = Annotated[float, Field(ge=0.05, le=100)]


class Parameter(Section, Generic[Value]):
    """Values of one parameter, and the one that the others are compared with."""

    values: Unique[Value] = Field(description="those that are tried")
    reference: Value = Field(description="the one that the others are compared with")

    @model_validator(mode="after")
    def _reference_is_a_value(self) -> Parameter[Value]:
        if self.reference not in self.values:
            raise refused(("reference",), repr(self.reference), f"one of the values, {', '.join(map(str, self.values))}")
        return self


class Parameters(Section):
    """The parameters whose price is measured; `level` always, because the recommended level is the study's result."""

    level: Parameter[Name] = Field(description="fidelity levels")
    central_difference_step: Parameter[TimeStep] | LeftOut = left_out("step of central differences (s)")
    exact_modal_step: Parameter[TimeStep] | LeftOut = left_out("exact modal step (s)")
    static_above: Parameter[Annotated[float, Field(ge=1e-3, le=1e9)]] | LeftOut = left_out(
        "modes with omega h above it follow statically, with exact_modal"
    )
    revolutions: Parameter[Annotated[int, Field(ge=2, le=20000)]] | LeftOut = left_out("length of a run")
    mesh_nodes: Parameter[Annotated[int, Field(ge=500, le=500_000)]] | LeftOut = left_out("nodes of the mesh")
    boundary_nodes: Parameter[Annotated[int, Field(ge=1, le=200)]] | LeftOut = left_out("contact nodes")
    fixed_interface_modes: Parameter[Annotated[int, Field(ge=0, le=500)]] | LeftOut = left_out(
        "fixed-interface modes of the reduced model at each of its speeds"
    )
    highest_frequency: Parameter[Annotated[float, Field(ge=1, le=1e12)]] | LeftOut = left_out(
        "highest frequency that is kept (Hz)"
    )
    bars: Parameter[Annotated[int, Field(ge=10, le=10_000_000)]] | LeftOut = left_out("bars of the lining")
    stress_instants: Parameter[Annotated[int, Field(ge=1, le=10000)]] | LeftOut = left_out("stress evaluations per revolution")
    stress_region: Parameter[Literal["submesh", "whole"]] | LeftOut = left_out("submesh, or the whole blade")
    friction_form: Parameter[Literal["constant", "vector"]] | LeftOut = left_out("form of friction")

    def varied(self) -> dict[str, Parameter]:
        """The parameters that are varied, by name."""
        return {name: parameter for name, parameter in self if parameter is not None}


class PlaceSection(Section):
    """Neighbouring speeds, as shares of the Campbell speed."""

    first: float = Field(ge=0.01, le=100, description="lowest")
    last: float = Field(ge=0.01, le=100, description="highest")
    speeds: int = Field(ge=1, le=1000, description="how many, evenly spaced")

    @model_validator(mode="after")
    def _forward(self) -> PlaceSection:
        if self.last < self.first or (self.last == self.first and self.speeds > 1):
            raise refused(("last",), f"{self.last:g}", f"more than first ({self.first:g})")
        return self


class Places(Section):
    """Where the study looks."""

    peak: PlaceSection = PlaceSection(first=1.0, last=1.02, speeds=5)
    jump: PlaceSection = PlaceSection(first=1.024, last=1.044, speeds=5)
    off_resonance: PlaceSection = PlaceSection(first=0.9, last=0.92, speeds=3)


class TradeoffSection(Section):
    """What accuracy costs (snakemake tradeoff)."""

    blade: Name | LeftOut = left_out("if left out, the first one of the run with profiles")
    scenes: AllOrNames = Field(default="all", description="of those that are run")
    base: Name = Field(default="standard", description="fidelity level that all parameters but one keep")
    engine_order: int = Field(default=4, ge=1, le=100, description="the speeds lie about this crossing of 1B")
    places: Places = Places()
    parameters: Parameters


class SpeedSteps(Section):
    """Grids of speeds (rad/s)."""

    fine: Step = Field(default=2.0, description="about interactions, as shipped")
    coarse: Step = Field(default=4.0, description="each choice varied once, convergence, and members")
    survey: Step = Field(default=5.0, description="the whole range in the lined scene; direct contact every other one")


class ModellingChoicesSection(Section):
    """What the benchmark leaves open, and the published numbers beside ours (snakemake modelling_choices)."""

    base: Name = Field(default="paper", description="fidelity level of the published step and mesh")
    quick: Name = Field(
        default="standard", description="level whose time integration the varied choices and the whole range take"
    )
    lined_scene: Name = Field(default="abradable", description="scene with a lining")
    direct_scene: Name = Field(default="direct", description="scene without one")
    speed_steps_rad_s: SpeedSteps = SpeedSteps()


class ValidationRangesSection(Section):
    """The published numbers beside the range of ours where what goes in spreads (snakemake validation_ranges).

    Scenes, mesh, time integration (`quick`) and step of the speeds (`coarse`) are those of modelling_choices.
    """

    members: MemberCount = Field(default=16, description="a power of two; more of them change none that are there")
    seed: int = Field(default=0, ge=0, le=2**31, description="another one gives another sample")
    of_scenes: Annotated[dict[str, SpreadEntry], Field(min_length=1)] = Field(
        description="by dotted keys of scenes.yaml; direct contact has those that it knows"
    )


class StabilitySection(Section):
    """What happens at extremes (snakemake stability)."""

    blade: Name | LeftOut = left_out("if left out, the first one of the run with profiles")
    base: Name = Field(default="standard", description="fidelity level that the cases change")
    lined_scene: Name = Field(default="abradable", description="scene with a lining")
    direct_scene: Name = Field(default="direct", description="scene without one")


class EstimateSection(Section):
    """What a whole sweep will cost (snakemake estimate)."""

    every: int = Field(
        default=50, ge=1, le=1_000_000, description="one of so many speeds is run, in both scenes, for every blade"
    )
    cores: int = Field(default=2, ge=1, le=1_000_000, description="cores the projected wall time is for")
    workflow_s_per_job: float = Field(
        default=0.045, ge=0, le=1000, description="CPU seconds of Snakemake itself for each job, measured in a sweep of 17,514"
    )


class StudiesSection(Section):
    """Studies of the model itself; none is part of all_blades."""

    @model_validator(mode="before")
    @classmethod
    def _without_former_names(cls, data: Any) -> Any:
        if isinstance(data, Mapping) and "readings" in data:
            raise refused(("readings",), "the former name of modelling_choices", "modelling_choices, with the same keys")
        return data

    tradeoff: TradeoffSection | LeftOut = None
    modelling_choices: ModellingChoicesSection = ModellingChoicesSection()
    validation_ranges: ValidationRangesSection | LeftOut = None
    stability: StabilitySection = StabilitySection()
    estimate: EstimateSection = EstimateSection()
