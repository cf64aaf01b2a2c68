"""Members of a sample: how a number spreads about its nominal value, and which values each member has.

Light but for `places`: the workflow imports it whether there are tolerances or not.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy

MEMBER_NAME = r"\d+(?:b|f\d+)?"
"""Pattern of a member's name."""

_DIGITS = 12
"""Of a value: more would tell one machine's arithmetic from another's."""


@dataclass(frozen=True)
class Tolerance:
    """How a number spreads.

    `uniform`: one half width about the nominal value; `normal`: one standard deviation; `between`: a lower and an upper
    bound, all between equally likely; `values`: a list, each equally likely. With `percent` the first two are in percent of
    the nominal value.
    """

    kind: Literal["uniform", "normal", "between", "values"]
    numbers: tuple[float, ...]
    percent: bool = False

    def value(self, nominal: float, share: float) -> float:
        """The value below which a `share`, from 0 to 1, of all values lies, rounded to 12 digits."""
        first = self.numbers[0]
        width = first * abs(nominal) / 100.0 if self.percent else first
        if self.kind == "uniform":
            found = nominal + (2.0 * share - 1.0) * width
        elif self.kind == "normal":
            found = nominal + float(scipy.special.ndtri(share)) * width
        elif self.kind == "between":
            found = first + share * (self.numbers[1] - first)
        else:
            found = self.numbers[min(int(share * len(self.numbers)), len(self.numbers) - 1)]
        return float(f"{found:.{_DIGITS}g}")

    def ends(self, nominal: float) -> tuple[float, ...]:
        """The values that no other goes beyond; none of a normal distribution, which has no bounds."""
        if self.kind == "values":
            return self.numbers
        return () if self.kind == "normal" else (self.value(nominal, 0.0), self.value(nominal, 1.0))

    @property
    def words(self) -> str:
        """For a page: how far it goes, in the unit of the number or in percent of it."""
        unit = "%" if self.percent else ""
        if self.kind == "between":
            return " to ".join(f"{number:g}" for number in self.numbers)
        if self.kind == "values":
            return " or ".join(f"{number:g}" for number in self.numbers)
        return ("± " if self.kind == "uniform" else "standard deviation ") + f"{self.numbers[0]:g}{unit}"


def places(numbers: int, members: int, seed: int) -> dict[str, tuple[float, ...]]:
    """Name of each member -> its place among the values of each number, shares above 0 and below 1.

    `members`, a power of two, are the first points of a scrambled Sobol sequence, named 0, 1, ...: more of them change none.
    Those that sensitivity indices need beside them follow: 0b, an independent second sample, and 0f1, the first sample with
    the first number of the second one. Source: Saltelli et al. (2010), Comput. Phys. Commun. 181, 259-270.
    """
    both = scipy.stats.qmc.Sobol(2 * numbers, rng=seed).random_base2(round(math.log2(members)))
    # a normal distribution has no value at 0
    both = both.clip(2.0**-40, 1.0 - 2.0**-40)
    first, second = both[:, :numbers], both[:, numbers:]
    mixed = [np.where(np.arange(numbers) == number, second, first) for number in range(numbers)]
    names = zip(*(together(row, range(numbers)) for row in range(members)), strict=True)
    pairs = [
        pair for names, sample in zip(names, [first, second, *mixed], strict=True) for pair in zip(names, sample, strict=True)
    ]
    return {name: tuple(place.tolist()) for name, place in pairs}


def together(row: int, numbers: Iterable[int]) -> list[str]:
    """Members that an index is made of: of the sample, of the second one, and those with one number of it each."""
    return [f"{row}", f"{row}b", *(f"{row}f{number + 1}" for number in numbers)]


def drawn(tolerances: Iterable[Tolerance], nominal: Sequence[float | None], place: Sequence[float]) -> tuple[float | None, ...]:
    """Values of a member at its `place`; None for a number without a nominal value."""
    return tuple(
        None if value is None else tolerance.value(value, share)
        for tolerance, value, share in zip(tolerances, nominal, place, strict=True)
    )


def is_of_sample(member: str) -> bool:
    """Whether a member is of the sample, and not beside it for sensitivity indices alone."""
    return member.isdigit()


def number_of(member: str) -> int | None:
    """Which number, counted from 0, a member has from the second sample alone; None for those of the two samples."""
    _, _, number = member.partition("f")
    return int(number) - 1 if number else None
