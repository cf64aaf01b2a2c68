"""How a number spreads that is never known exactly, and how it is written in a configuration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import scipy
from pydantic import AfterValidator, Field, model_validator

from .section import LeftOut, Section, Unique, left_out, plain, refused


@dataclass(frozen=True)
class Spread:
    """How a number spreads.

    `uniform`: one half width about the nominal value; `normal`: one standard deviation; `between`: a lower and an upper
    bound, all between equally likely; `log_between`: the same of the logarithm; `values`: a list, each equally likely. With
    `percent` the first two are in percent of the nominal value.
    """

    kind: Literal["uniform", "normal", "between", "log_between", "values"]
    numbers: tuple[float, ...]
    percent: bool = False

    def value(self, nominal: float, share: float) -> float:
        """The value below which a `share`, from 0 to 1, of all values lies, rounded to 12 digits."""
        first = self.numbers[0]
        width = first * abs(nominal) / 100.0 if self.percent else first
        if self.kind == "uniform":
            value = nominal + (2.0 * share - 1.0) * width
        elif self.kind == "normal":
            value = nominal + float(scipy.special.ndtri(share)) * width
        elif self.kind == "between":
            value = first + share * (self.numbers[1] - first)
        elif self.kind == "log_between":
            value = first * (self.numbers[1] / first) ** share
        else:
            value = self.numbers[min(int(share * len(self.numbers)), len(self.numbers) - 1)]
        # with more digits, the arithmetic of two machines would differ
        return float(f"{value:.12g}")

    def ends(self, nominal: float) -> tuple[float, ...]:
        """The values that no other goes beyond; none of a normal distribution, which has no bounds."""
        if self.kind == "values":
            return self.numbers
        return () if self.kind == "normal" else (self.value(nominal, 0.0), self.value(nominal, 1.0))

    @property
    def words(self) -> str:
        """Width of the spread as a page shows it, in the unit of the number or in percent of it."""
        unit = "%" if self.percent else ""
        if self.kind in ("between", "log_between", "values"):
            return (" or " if self.kind == "values" else " to ").join(f"{number:g}" for number in self.numbers)
        return ("± " if self.kind == "uniform" else "standard deviation ") + f"{self.numbers[0]:g}{unit}"


Width = Annotated[float, Field(ge=1e-12, le=1e15)]
Percent = Annotated[float, Field(ge=1e-6, le=1000)]
Number = Annotated[float, Field(ge=-1e15, le=1e15)]


def _power_of_two(members: int) -> int:
    if members & (members - 1):
        nearest = 2 ** members.bit_length()
        raise refused((), f"{members}", f"a power of two, such as {nearest // 2} or {nearest}")
    return members


MemberCount = Annotated[int, Field(ge=2, le=4096), AfterValidator(_power_of_two)]
"""How many members a sample has."""


class SpreadEntry(Section):
    """How one number spreads: one of these, in the unit of the number's key where it is not in percent of its value."""

    uniform_percent: Percent | LeftOut = left_out("Half width of a uniform distribution, of the value")
    uniform: Width | LeftOut = left_out("Half width of a uniform distribution")
    normal_percent: Percent | LeftOut = left_out("Standard deviation of a normal distribution, of the value")
    normal: Width | LeftOut = left_out("Standard deviation of a normal distribution")
    between: Annotated[list[Number], Field(min_length=2, max_length=2)] | LeftOut = left_out("Bounds of a uniform distribution")
    log_between: Annotated[list[Width], Field(min_length=2, max_length=2)] | LeftOut = left_out(
        "Bounds of a distribution whose logarithm is uniform"
    )
    values: Unique[Number] | LeftOut = left_out("Equally likely values")

    @model_validator(mode="after")
    def _one_kind(self) -> SpreadEntry:
        kinds = list(plain(self))
        if len(kinds) != 1:
            raise refused((), " and ".join(kinds) or "nothing", f"one of {', '.join(type(self).model_fields)}")
        for key in ("between", "log_between"):
            bounds = getattr(self, key)
            if bounds is not None and not bounds[0] < bounds[1]:
                raise refused((key,), f"{bounds}", "a lower and a higher number")
        return self

    def spread(self) -> Spread:
        """The spread as samples take it."""
        ((key, number),) = plain(self).items()
        numbers = tuple(number) if isinstance(number, list) else (number,)
        return Spread(key.removesuffix("_percent"), numbers, key.endswith("_percent"))  # type: ignore[arg-type]


class Spreads(Section):
    """Numbers that spread, of scenes and of blades."""

    of_scenes: dict[str, SpreadEntry] = Field(
        default={}, description="Distributions of scene keys by dotted name, such as lining.elastic_modulus_pa"
    )
    of_blades: dict[str, SpreadEntry] = Field(
        default={},
        description="Distributions of blade numbers: material.<key>; sweep_percent and lean_percent of the table; sweep_cm and "
        "lean_deg, added in proportion to the span; stagger_deg, camber_deg, chord_percent and thickness_percent, also with "
        ".hub or .tip",
    )

    @property
    def spreads(self) -> dict[tuple[str, str], Spread]:
        """Section and key of each number -> how it spreads, in the order of the sample."""
        sections = {"of_blades": self.of_blades, "of_scenes": self.of_scenes}
        return {(section, key): entry.spread() for section, entries in sections.items() for key, entry in entries.items()}
