"""What a share of few members says of all that could be drawn."""

from __future__ import annotations

import numpy as np

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
