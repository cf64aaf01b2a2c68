"""Sobol indices: which number a measure's spread comes from, alone and together with others.

They are SciPy's, which the project has anyway, with the estimators of Saltelli et al. (2010); SALib has the same ones, and more
ways to sample, for one more dependency.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from r37core.plans.member_values import is_of_sample, together

from .number_ranks import CONFIDENCE, SOBOL_RANKS, places_of

_FEWEST, _RESAMPLES, _BOOTSTRAP_SEED = 4, 500, 0
"""Members, below which no index is given; bootstrap samples, which are the same every time."""


ORDERS = {
    "first": "share of the variance that the number brings alone",
    "total": "share of the variance that the number brings, alone and together with others",
}
"""Kinds of indices and what they are."""


@dataclass(frozen=True)
class Sensitivity:
    """Indices of one measure, shape (ORDERS, numbers); NaN for a number that was not varied, and where nothing spreads.

    `low` and `high`: between which CONFIDENCE of the bootstrap samples lie. `above`, shape (numbers, numbers): whether one's
    total index is told apart as larger than another's, as it is in so many of them. `members`: how many counted.
    """

    index: np.ndarray
    low: np.ndarray
    high: np.ndarray
    above: np.ndarray
    members: int

    @property
    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """First and last place of each number in the ranking by total index; NaN without an index, and of few members."""
        low, high = places_of(self.above, np.isfinite(self.index[list(ORDERS).index("total")]))
        return (low, high) if self.members >= SOBOL_RANKS else (np.full_like(low, np.nan), np.full_like(high, np.nan))


def sobol_indices(measure: Mapping[str, float], numbers: Sequence[int], count: int) -> Sensitivity:
    """First-order and total index of each of `count` numbers, of which those at `numbers` were varied.

    `measure`: value of each member, by name (`sobol_points`). Members for which any of the values that belong together is
    no number are left out. Source: Saltelli et al. (2010), equations b and f of table 2.
    """
    from scipy import stats

    rows = [together(int(name), numbers) for name in measure if is_of_sample(name)]
    table = np.array([[measure.get(name, np.nan) for name in row] for row in rows]).reshape(-1, 2 + len(numbers)).T
    table = table[:, np.isfinite(table).all(axis=0)]
    # the estimators take powers of two; the first are a sample of their own
    members = 2 ** int(np.log2(table.shape[1])) if table.size else 0
    table = table[:, :members]
    nothing = np.full((2, count), np.nan)
    if members < _FEWEST or np.ptp(table[:2]) == 0.0:
        return Sensitivity(nothing, nothing, nothing, np.zeros((count, count), dtype=bool), 0)

    def indices(chosen: np.ndarray) -> np.ndarray:
        f_a, f_b, *mixed = table[:, chosen]
        outcomes = {"f_A": f_a[None], "f_B": f_b[None], "f_AB": np.array(mixed)[:, None]}
        result = stats.sobol_indices(func=outcomes, n=members)
        return np.array([result.first_order, result.total_order])

    # not the result's own bootstrap, which draws other numbers every time
    drawn = stats.bootstrap(
        (np.arange(members),),
        indices,
        vectorized=False,
        n_resamples=_RESAMPLES,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=_BOOTSTRAP_SEED,
    )
    ends, totals = drawn.confidence_interval, drawn.bootstrap_distribution[list(ORDERS).index("total")]
    above = np.zeros((count, count), dtype=bool)
    # a share beyond this lies outside the interval of the difference
    above[np.ix_(numbers, numbers)] = (totals[:, None] > totals).mean(axis=-1) >= 0.5 + 0.5 * CONFIDENCE

    def placed(values: np.ndarray) -> np.ndarray:
        whole = nothing.copy()
        whole[:, list(numbers)] = values
        return whole

    return Sensitivity(placed(indices(np.arange(members))), placed(ends.low), placed(ends.high), above, members)
