"""Numbers that move a measure most: a straight line through ranks (docs/tolerances.md#how-many-members)."""

from dataclasses import dataclass

import numpy as np

_FREE, _ROUND_OFF = 4, 1e-9
"""Members more than coefficients, below which nothing is said of how sure these are; of coefficients that fit exactly."""


@dataclass(frozen=True)
class Ranking:
    """Standardized rank coefficients of one measure, each array of shape (numbers,); NaN for a number that does not vary.

    `coefficient`: from -1 to 1; by how many places of all members the measure rises as the number does. `low` and `high`: its
    interval, CONFIDENCE sure. `above`, shape (numbers, numbers): whether one's size is told apart as larger than another's.
    `explained`: share of the ranks' variance that the coefficients explain together. `members`: how many counted; with too
    few there are no coefficients.
    """

    coefficient: np.ndarray
    low: np.ndarray
    high: np.ndarray
    above: np.ndarray
    explained: float
    members: int

    @property
    def known(self) -> np.ndarray:
        """True for a number that moves the measure at all: zero is not in its interval."""
        return self.low * self.high > 0.0

    @property
    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """First and last place of each number in the ranking by size; NaN for those that are not known."""
        low = 1.0 + self.above.sum(axis=0)
        high = float(np.isfinite(self.coefficient).sum()) - self.above.sum(axis=1)
        return np.where(self.known, low, np.nan), np.where(self.known, high, np.nan)


def ranking(values: np.ndarray, measure: np.ndarray) -> Ranking:
    """Ranking of numbers by their `values`, shape (members, numbers), NaN for none, and a `measure`, shape (members,).

    Ranks of the measure are fitted by least squares to those of all numbers at once, so that what one brings does not blur
    another, as it does in a correlation. Two numbers are told apart where the interval of the difference of their sizes does
    not hold zero. Members without the measure are left out.
    Source: Iman and Conover, Technometrics 21 (1979) 499-509; intervals are those of least squares.
    """
    from scipy import stats

    rows = np.isfinite(measure)
    values, measure = values[rows], measure[rows]
    members, numbers = values.shape
    # what a scene does not have is NaN, which is not above 0
    varied = np.array([members > 0 and np.ptp(column) > 0.0 for column in values.T])
    coefficient, low, high = np.full((3, numbers), np.nan)
    above, free = np.zeros((numbers, numbers), dtype=bool), members - 1 - int(varied.sum())
    if free < _FREE or not varied.any() or np.ptp(measure) == 0.0:
        return Ranking(coefficient, low, high, above, np.nan, members)
    x, y = (stats.zscore(stats.rankdata(of, axis=0)) for of in (values[:, varied], measure))
    inverse = np.linalg.pinv(x.T @ x)
    fitted = inverse @ x.T @ y
    rest = float(np.sum((y - x @ fitted) ** 2))
    covariance, sure = rest / free * inverse, stats.t.ppf(0.5 + 0.5 * CONFIDENCE, free)
    half = sure * np.sqrt(np.diag(covariance))
    coefficient[varied], low[varied], high[varied] = fitted, fitted - half, fitted + half
    # standard deviation of the difference of two sizes
    signed = covariance * np.outer(np.sign(fitted), np.sign(fitted))
    spread = np.sqrt(np.maximum(np.diag(signed)[:, None] + np.diag(signed) - 2.0 * signed, 0.0))
    above[np.ix_(varied, varied)] = np.abs(fitted)[:, None] - np.abs(fitted) > np.maximum(sure * spread, _ROUND_OFF)
    return Ranking(coefficient, low, high, above, 1.0 - rest / members, members)


NAMES_THE_FIRST, RANKS = 32, 128
"""Members of which rank coefficients always found the same first number, and those that told most numbers apart."""


def remarks_on_rankings(members: int, numbers: int) -> list[str]:
    """Remarks before a run whose members are too few to rank so many numbers."""
    if numbers < 2 or members >= RANKS:
        return []
    what = f"name the first of the numbers at best; {RANKS} tell most apart"
    if members < NAMES_THE_FIRST:
        what = f"do not rank the numbers; {NAMES_THE_FIRST} name the first, {RANKS} tell most apart"
    return [f"tolerances: {members} members {what} (docs/tolerances.md#how-many-members)"]


CONFIDENCE = 0.95
"""How sure an interval is."""


def share_ends(counts: np.ndarray, members: int) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper end of a chance of which `counts` (any shape) of so many `members` are known, with CONFIDENCE.

    Exact (Clopper and Pearson, Biometrika 26 (1934) 404-413): of members that are drawn independently no more than 1 -
    CONFIDENCE of the intervals miss the chance, whatever it is.
    """
    # not wherever members are drawn
    from scipy import stats

    known = [stats.binomtest(count, members).proportion_ci(CONFIDENCE) for count in range(members + 1)]
    low, high = np.array([(interval.low, interval.high) for interval in known]).T
    return low[counts], high[counts]
