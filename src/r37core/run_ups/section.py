"""run_ups of config.yaml: speeds that change while the blade rubs."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, model_validator

from r37core.config import si_fields
from r37core.config.section import AllOrNames, LeftOut, Name, Rpm, Section, Speed, check_names, refused

from .choice import LONGEST, SHORTEST, Crossing, RunUpChoice

_START, _STOP = ("from_rad_s", "from_rpm"), ("to_rad_s", "to_rpm")
_LENGTH = ("rate_rad_s2", "rate_rpm_s", "revolutions")
Share = Annotated[float, Field(ge=-0.5, le=1)]


class CrossingSection(Section):
    """Speeds about a crossing of each blade's own Campbell diagram."""

    mode: Literal["1B", "1T", "2B"] = Field(description="whose crossing")
    engine_order: int = Field(ge=1, le=100, description="with which engine order")
    first: Share = Field(description="where the run-up begins, as a share of the crossing's speed above it")
    last: Share = Field(description="where it ends; below first it is a run-down")


class RunUpEntry(Section):
    """One run-up, or run-down where it ends at the lower speed, of every chosen blade in every chosen scene."""

    blades: AllOrNames = Field(default="all", description="of those that are run")
    scenes: AllOrNames = Field(default="all", description="of those that are run")
    from_rad_s: Speed | LeftOut = Field(default=None, description="first speed, at which the casing becomes lobed")
    from_rpm: Rpm | LeftOut = Field(default=None, description="the same in revolutions per minute")
    to_rad_s: Speed | LeftOut = Field(default=None, description="last speed; a lower one makes a run-down")
    to_rpm: Rpm | LeftOut = Field(default=None, description="the same in revolutions per minute")
    crossing: CrossingSection | LeftOut = Field(default=None, description="in place of the speeds")
    rate_rad_s2: Annotated[float, Field(gt=0, le=1e9)] | LeftOut = Field(
        default=None, description="change of the speed per second, of a run-down too; or rate_rpm_s; or revolutions"
    )
    rate_rpm_s: Annotated[float, Field(gt=0, le=1e10)] | LeftOut = Field(
        default=None, description="the rate in revolutions per minute per second"
    )
    revolutions: Annotated[float, Field(ge=SHORTEST, le=LONGEST)] | LeftOut = Field(
        default=None, description="revolutions that the change takes, in place of a rate"
    )
    revolutions_before: Annotated[int, Field(ge=1, le=20000)] | LeftOut = Field(
        default=None, description="at the first speed, in which the casing becomes lobed; without it those of the scene"
    )
    revolutions_after: int = Field(default=0, ge=0, le=20000, description="at the last speed")
    lining: Literal["new", "worn"] = Field(default="new", description="worn: by the same run-up, done once before")

    @model_validator(mode="after")
    def _complete(self) -> RunUpEntry:
        for keys in ((*_START, "crossing"), (*_STOP, "crossing"), _LENGTH):
            present = [key for key in keys if getattr(self, key) is not None]
            if len(present) != 1:
                at = present[1] if present else keys[0]
                raise refused((at,), " and ".join(present) if present else "nothing", f"one of {', '.join(keys)}")
        choice = self.choice(1)
        if choice.start == choice.stop and self.revolutions is None:
            raise refused((self.key_of_length,), "a rate between equal speeds", "revolutions, for a run at constant speed")
        return self

    @property
    def key_of_length(self) -> str:
        """The key that says how long it takes."""
        return next(key for key in _LENGTH if getattr(self, key) is not None)

    def choice(self, revolutions_of_scene: int) -> RunUpChoice:
        """What is asked for in a scene whose runs have so many revolutions."""
        fields, crossing = si_fields(self), self.crossing
        return RunUpChoice(
            start=crossing.first if crossing else fields["from"],
            stop=crossing.last if crossing else fields["to"],
            crossing=Crossing(crossing.mode, crossing.engine_order) if crossing else None,
            rate=fields.get("rate"),
            revolutions=self.revolutions,
            before=self.revolutions_before or revolutions_of_scene,
            after=self.revolutions_after,
            worn=self.lining == "worn",
        )


def _names_differ(entries: dict[str, RunUpEntry]) -> dict[str, RunUpEntry]:
    check_names(entries)
    return entries


RUN_UP_SECTION: tuple[Any, Any] = (
    Annotated[dict[Name, RunUpEntry], AfterValidator(_names_differ)],
    Field(default={}, description="run-ups and run-downs by name"),
)
"""Type and default of the section."""
