"""Numbers are printed with as many digits as their scatter bears."""

import math

import numpy as np
import pytest

from r37core.base.rounding import rounded_to, rounded_up


@pytest.mark.parametrize(
    ("value", "spread", "text"),
    [
        (1727.0, 44.0, "1730"),
        (1727.0, 30.0, "1730"),
        (1727.0, 29.0, "1727"),
        (1727.4, 4.0, "1727"),
        (1727.44, 0.3, "1727.4"),
        (8.6412, 12.1, "9"),
        (8.6412, 0.8, "8.6"),
        (8.6412, 0.2, "8.64"),
        (0.00123, 0.0004, "0.0012"),
        (8.6412e9, 1.2e9, "8600000000"),
        (3.0, 100.0, "0"),
        (-0.04, 1.0, "0.0"),
        (-1727.0, -44.0, "-1730"),
        (1715.0, 44.0, "1720"),
        (1725.0, 44.0, "1730"),
        (-1725.0, 44.0, "-1730"),
        (8.25, 0.4, "8.3"),
        (2e-12, 1e-12, "0.0000000000020"),
        (1640.0, 1e-300, "1640"),
        (1640.0, 1e-7, "1640"),
        (0.0, 1e-7, "0.00000000"),
        (np.float64(1640.0), 0.0, "1640"),
        (1640.123456, math.nan, "1640.12"),
        (math.inf, 3.0, "inf"),
        (math.nan, 3.0, ""),
    ],
)
def test_digits_that_the_spread_bears(value, spread, text):
    assert rounded_to(value, spread) == text


def test_rounding_moves_a_number_by_at_most_a_sixth_of_its_spread_and_keeps_no_digit_more():
    random = np.random.default_rng(0)
    for value, spread in zip(random.uniform(-1e4, 1e4, 500), 10.0 ** random.uniform(-3.0, 3.5, 500), strict=True):
        text = rounded_to(value, spread)
        assert abs(float(text) - value) <= spread / 6.0 * (1.0 + 1e-9)
        # a multiple of the longest digit that is allowed
        in_digits = float(text) / 10.0 ** math.floor(math.log10(spread / 3.0))
        assert math.isclose(in_digits, round(in_digits), abs_tol=1e-6)


@pytest.mark.parametrize(("value", "text"), [(0.23401, "0.235"), (0.234, "0.234"), (1234.0, "1240"), (5.0, "5"), (9.991, "10")])
def test_a_lower_bound_is_never_rounded_below_itself(value, text):
    assert rounded_up(value) == text and float(text) >= value
