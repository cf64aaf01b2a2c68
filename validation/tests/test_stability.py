"""Tables of the extremes and of what a run costs, from made-up ones."""

import pandas as pd
from evidence.speed import _grown
from evidence.stability import counts, inaccurate

CASES = pd.DataFrame(
    [
        ("bars", "10", "lined", "degraded", "mean rms changes by 6.1% with half the step"),
        ("bars", "100", "lined", "accurate", "mean rms changes by 0.1% with half the step"),
        ("friction", "0.5", "bare", "diverged", "half the step does not; recorded as diverged"),
        ("friction", "1", "bare", "refused", "found 1"),
        ("speed", "100", "bare", "degraded", "mean rms changes by 91% with half the step"),
    ],
    columns=["what", "value", "scene", "outcome", "detail"],
)


def test_outcomes_are_counted_by_scene():
    assert counts(CASES)[1] == [["bare", "3", "0", "1", "1", "1", "0"], ["lined", "2", "1", "1", "0", "0", "0"]]


def test_the_largest_changes_come_first():
    assert [row[0] for row in inaccurate(CASES)[1]] == ["friction", "speed", "bars"]
    assert inaccurate(CASES)[1][1] == ["speed", "100", "bare", "degraded", "rms changes by 91%"]


def test_a_cost_grows_by_a_power():
    costs = pd.Series({1e-6: 1.0, 1e-7: 10.0, 2e-7: 5.0})
    assert _grown(costs) == ["1e-06 to 1e-07", "1 s", "10 s", "-1.00"]
