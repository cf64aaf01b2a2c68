"""Numbers for people: as many digits as their scatter bears."""

from __future__ import annotations

import math

_PARTS = 3.0
"""Of a spread, that the last digit must not be longer than: rounding then moves a number by at most a sixth of its spread."""

_DIGITS = 6
"""Of a number without a spread."""


def rounded_to(value: float, spread: float) -> str:
    """`value` as text, its last digit at most a third of its `spread` (width of its range, in its unit): 1727, 44 -> 1730.

    Digits beyond it are left out after the point and zeros before it. Of a spread that is zero or no number nothing follows:
    six digits. Empty for a value that is no number.
    """
    if math.isnan(value):
        return ""
    if math.isinf(value) or not 0.0 < abs(spread) < math.inf:
        return f"{value:.{_DIGITS}g}"
    # the last digit that is not longer; a spread of just 3 ends of a digit counts as such in spite of round-off
    decimals = -math.floor(math.log10(abs(spread) / _PARTS) + 1e-9)
    # no -0
    return f"{round(float(value), decimals) + 0.0:.{max(decimals, 0)}f}"
