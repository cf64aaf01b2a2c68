"""Distributions of numbers that are never known exactly, as a configuration gives them."""

from functools import cached_property
from statistics import NormalDist
from typing import Annotated

from pydantic import AfterValidator, Field

from r37core.base.varied_number import BLADE, SCENE, VariedNumber

from .section import LeftOut, Section, Unique, left_out, option, plain, refused

Width = Annotated[float, Field(ge=1e-12, le=1e15)]
Percent = Annotated[float, Field(ge=1e-6, le=1000)]
Number = Annotated[float, Field(ge=-1e15, le=1e15)]


_LEAST_SHARE = 2.0**-64
"""Smallest share of a normal distribution that a value is drawn for: 9 standard deviations below the mean."""


def _ascending(bounds: list[float]) -> list[float]:
    if not bounds[0] < bounds[1]:
        raise refused(f"{bounds}", "a lower and a higher number")
    return bounds


Bounds = Annotated[list[Number], Field(min_length=2, max_length=2), AfterValidator(_ascending)]
"""Lowest and highest value of a number."""

PositiveBounds = Annotated[list[Width], Field(min_length=2, max_length=2), AfterValidator(_ascending)]


def _power_of_two(members: int) -> int:
    if members & (members - 1):
        nearest = 2 ** members.bit_length()
        raise refused(f"{members}", f"a power of two, such as {nearest // 2} or {nearest}")
    return members


MemberCount = Annotated[int, Field(ge=2, le=4096), AfterValidator(_power_of_two)]
"""How many members a sample has."""


class SpreadEntry(Section):
    """How one number spreads: one of these, in the unit of the number's key where it is not in percent of its value."""

    uniform_percent: Percent | LeftOut = left_out("Half width of a uniform distribution, of the value")
    uniform: Width | LeftOut = left_out("Half width of a uniform distribution")
    normal_percent: Percent | LeftOut = left_out("Standard deviation of a normal distribution, of the value")
    normal: Width | LeftOut = left_out("Standard deviation of a normal distribution")
    between: Bounds | LeftOut = left_out("Bounds of a uniform distribution")
    log_between: PositiveBounds | LeftOut = left_out("Bounds of a distribution whose logarithm is uniform")
    values: Unique[Number] | LeftOut = left_out("Equally likely values")

    def _check(self) -> None:
        kinds = list(plain(self))
        if len(kinds) != 1:
            raise refused(" and ".join(kinds) or "nothing", f"one of {', '.join(type(self).model_fields)}")

    @cached_property
    def distribution(self) -> tuple[str, list[float]]:
        """Key of the distribution, such as `uniform_percent`, and its numbers."""
        ((key, numbers),) = plain(self).items()
        return key, numbers if isinstance(numbers, list) else [numbers]

    @property
    def percent(self) -> bool:
        """True if the width is in percent of the nominal value."""
        return self.distribution[0].endswith("_percent")

    def value(self, nominal: float, share: float) -> float:
        """The value below which a `share`, from 0 to 1, of all values lies, rounded to 12 digits."""
        key, numbers = self.distribution
        first = numbers[0]
        width = first * abs(nominal) / 100.0 if self.percent else first
        if key.startswith("uniform"):
            value = nominal + (2.0 * share - 1.0) * width
        elif key.startswith("normal"):
            value = nominal + NormalDist().inv_cdf(max(share, _LEAST_SHARE)) * width
        elif key == "between":
            value = first + share * (numbers[1] - first)
        elif key == "log_between":
            value = first * (numbers[1] / first) ** share
        else:
            value = numbers[min(int(share * len(numbers)), len(numbers) - 1)]
        # with more digits, the arithmetic of two machines would differ
        return float(f"{value:.12g}")

    def ends(self, nominal: float) -> tuple[float, ...]:
        """The values that no other goes beyond; none of a normal distribution, which has no bounds."""
        if self.values is not None:
            return tuple(self.values)
        return () if self.distribution[0].startswith("normal") else (self.value(nominal, 0.0), self.value(nominal, 1.0))


class Spreads(Section):
    """Numbers that spread, of scenes and of blades."""

    of_scenes: dict[str, SpreadEntry] = option(
        "Distributions of scene keys by dotted name, such as lining.elastic_modulus_pa", {}
    )
    of_blades: dict[str, SpreadEntry] = option(
        "Distributions of blade numbers: material.<key>; sweep_percent and lean_percent of the table; sweep_cm and "
        "lean_deg, added in proportion to the span; stagger_deg, camber_deg, chord_percent and thickness_percent, also with "
        ".hub or .tip",
        {},
    )

    @property
    def spreads(self) -> dict[VariedNumber, SpreadEntry]:
        """Distribution of each number, in the order of the sample."""
        kinds = {BLADE: self.of_blades, SCENE: self.of_scenes}
        return {VariedNumber(kind, key): entry for kind, entries in kinds.items() for key, entry in entries.items()}
