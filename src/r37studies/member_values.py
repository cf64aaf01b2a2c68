"""Members of a sample: how a number spreads about its nominal value, and which values each member has.

Light but for `sobol_points`: the workflow imports it whether there are tolerances or not.
"""

import math
from collections.abc import Mapping, Sequence

import scipy

from r37core.base.varied_number import VariedNumber
from r37core.config.spread import SpreadEntry


def sobol_points(numbers: int, members: int, seed: int) -> dict[str, tuple[float, ...]]:
    """Name of each member -> its point: where it lies among the values of each number, shares above 0 and below 1.

    `members`, a power of two, are the first points of a scrambled Sobol sequence, named 0, 1, ...: more of them change none.
    """
    # of twice as many dimensions: samples stay those of versions that drew a second sample, too
    points = scipy.stats.qmc.Sobol(2 * numbers, rng=seed).random_base2(round(math.log2(members)))[:, :numbers]
    # a normal distribution has no value at 0
    points = points.clip(2.0**-40, 1.0 - 2.0**-40)
    return {f"{name}": tuple(point) for name, point in enumerate(points.tolist())}


def drawn(
    spreads: Mapping[VariedNumber, SpreadEntry], nominal: Sequence[float | None], point: Sequence[float]
) -> dict[VariedNumber, float]:
    """Values of a member at its `point`, of the numbers that have a `nominal` value."""
    numbers = zip(spreads.items(), nominal, point, strict=True)
    return {number: spread.value(value, share) for (number, spread), value, share in numbers if value is not None}
