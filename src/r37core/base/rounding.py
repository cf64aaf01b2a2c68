"""Numbers for people: as many digits as their scatter bears."""

import math
from decimal import ROUND_CEILING, ROUND_HALF_UP, Context, Decimal

_PARTS = 3.0
"""Parts of a spread: the last digit is at most one of them, so rounding changes a number by at most a sixth of its spread."""

_DIGITS = 6
"""Digits of a number without a spread."""

_LEAST = 1e-9
"""Share of a number, below which a spread is round-off and no spread."""


def rounded_up(value: float) -> str:
    """A positive `value` as text with three digits, never below it: what is allowed from there on."""
    return f"{float(Decimal(repr(float(value))).normalize(Context(prec=3, rounding=ROUND_CEILING))):g}"


def rounded_to(value: float, spread: float) -> str:
    """`value` as text, its last digit at most a third of its `spread` (width of its range, in its unit): 1727, 44 -> 1730.

    Digits beyond it are left out after the point and zeros before it. Of a spread that is zero or no number nothing follows:
    six digits. Empty for a value that is no number.
    """
    if math.isnan(value):
        return ""
    if math.isinf(value) or not _LEAST * abs(value) < abs(spread) < math.inf:
        return f"{value:.{_DIGITS}g}"
    # the last digit that is not longer; a spread of just 3 ends of a digit counts as such in spite of round-off
    decimals = -math.floor(math.log10(abs(spread) / _PARTS) + 1e-9)
    # halves upwards: whole numbers have many, and neighbours are to go the same way; no -0
    rounded = Decimal(repr(float(value))).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP)
    return f"{abs(rounded) if rounded.is_zero() else rounded:.{max(decimals, 0)}f}"
