"""Members of a sample: how a number spreads about its nominal value, and which values each member has.

Light but for `sobol_points`: the workflow imports it whether there are tolerances or not.
"""

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import scipy

from r37core.base.varied_number import VariedNumber
from r37core.config.spread import SpreadEntry


def sobol_points(numbers: int, members: int, seed: int) -> dict[str, tuple[float, ...]]:
    """Name of each member -> its point: where it lies among the values of each number, shares above 0 and below 1.

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
    samples = zip(names, [first, second, *mixed], strict=True)
    return {name: tuple(point.tolist()) for names, points in samples for name, point in zip(names, points, strict=True)}


def together(row: int, numbers: Iterable[int]) -> list[str]:
    """Members that an index is made of: of the sample, of the second one, and those with one number of it each."""
    return [f"{row}", f"{row}b", *(f"{row}f{number + 1}" for number in numbers)]


def drawn(
    spreads: Mapping[VariedNumber, SpreadEntry], nominal: Sequence[float | None], point: Sequence[float]
) -> dict[VariedNumber, float]:
    """Values of a member at its `point`, of the numbers that have a `nominal` value."""
    numbers = zip(spreads.items(), nominal, point, strict=True)
    return {number: spread.value(value, share) for (number, spread), value, share in numbers if value is not None}


def is_of_sample(member: str) -> bool:
    """True if a member is of the sample, and not beside it for sensitivity indices alone."""
    return member.isdigit()


def number_of(member: str) -> int | None:
    """Which number, counted from 0, a member has from the second sample alone; None for those of the two samples."""
    _, _, number = member.partition("f")
    return int(number) - 1 if number else None
