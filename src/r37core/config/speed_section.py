"""Speeds of config.yaml: numbers and ranges, in rad/s or in revolutions per minute, of which one plan in rad/s is made."""

from typing import Annotated, Any, Generic, Literal, TypeVar

from pydantic import Field

from .section import LeftOut, Names, Rpm, Section, Speed, Unique, either, left_out, option, refused

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
