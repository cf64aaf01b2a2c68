"""Numbers that move a measure most: a straight line through ranks (docs/tolerances.md#how-many-members)."""

import numpy as np
import xarray as xr
from scipy import stats

from r37core.base.variable import about

_FREE, _ROUND_OFF = 4, 1e-9
"""Members more than coefficients, below which nothing is said of how sure these are; of coefficients that fit exactly."""

CONFIDENCE = 0.95
"""How sure an interval is."""


def ranking(values: np.ndarray, measure: np.ndarray) -> xr.Dataset:
    """Ranking of numbers by their `values`, shape (members, numbers), NaN for none, and a `measure`, shape (members,).

    Dataset over (number) with the standardized rank coefficient of each number, from -1 to 1: by how many places of all
    members the measure rises as the number does; the ends of its interval, CONFIDENCE sure; and the first and last place of the
    number by size, where zero is not in the interval. NaN for a number that does not vary, and with too few members.
    Ranks of the measure are fitted by least squares to those of all numbers at once, so that what one brings does not blur
    another, as it does in a correlation. Two numbers are told apart where the interval of the difference of their sizes does
    not hold zero. Members without the measure are left out.
    Source: Iman and Conover, Technometrics 21 (1979) 499-509; intervals are those of least squares.
    """
    rows = np.isfinite(measure)
    values, measure = values[rows], measure[rows]
    members, numbers = values.shape
    # what a scene does not have is NaN, which is not above 0
    varied = np.array([members > 0 and np.ptp(column) > 0.0 for column in values.T])
    coefficient, low, high, first, last = np.full((5, numbers), np.nan)
    explained, free = np.nan, members - 1 - int(varied.sum())
    if free >= _FREE and varied.any() and np.ptp(measure) > 0.0:
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
        above = np.abs(fitted)[:, None] - np.abs(fitted) > np.maximum(sure * spread, _ROUND_OFF)
        first[varied], last[varied] = 1.0 + above.sum(axis=0), len(fitted) - above.sum(axis=1)
        explained = 1.0 - rest / members
    # a number that moves the measure at all
    known = low * high > 0.0
    interval, criterion = (
        f"of the rank coefficient, {CONFIDENCE:.0%} sure",
        "rank coefficients, of numbers that have one beyond zero",
    )
    columns = {
        "rank_coefficient": (coefficient, "standardized rank coefficient"),
        "rank_coefficient_low": (low, f"lower end {interval}"),
        "rank_coefficient_high": (high, f"upper end {interval}"),
        "rank_place_low": (np.where(known, first, np.nan), f"first place that the number may have by {criterion}"),
        "rank_place_high": (np.where(known, last, np.nan), f"last place that the number may have by {criterion}"),
        "rank_explained": (explained, "share of the ranks' variance that they explain"),
        "rank_members": (members, "members that the coefficients are made of"),
    }
    variables = {name: (("number",)[: np.ndim(part)], part, about("1", text)) for name, (part, text) in columns.items()}
    return xr.Dataset(variables)


def share_ends(counts: np.ndarray, members: int) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper end of a chance of which `counts` (any shape) of so many `members` are known, with CONFIDENCE.

    Exact (Clopper and Pearson, Biometrika 26 (1934) 404-413): of members that are drawn independently no more than 1 -
    CONFIDENCE of the intervals miss the chance, whatever it is.
    """
    known = [stats.binomtest(count, members).proportion_ci(CONFIDENCE) for count in range(members + 1)]
    low, high = np.array([(interval.low, interval.high) for interval in known]).T
    return low[counts], high[counts]
