"""What the studies of the benchmark are asked for: pydantic models, as sections of config.yaml are."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from r37core.config.section import Name, Section
from r37core.config.spread import MemberCount, SpreadEntry

Step = Annotated[float, Field(ge=0.05, le=100)]


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
