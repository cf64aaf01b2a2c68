"""Adaptive speeds replayed in runs of every speed: what they find and miss, on made-up responses."""

import numpy as np
import pytest
from evidence.adaptive_speeds import by_blade, compare, errors_between, missed, plain_grid, replay, summary
from refinement_cases import CHOICE, PLAN, campbell, spiked

from r37core.results.interactions import InteractionChoice

PAIR = ("Ref", "abradable")


def test_the_tables_name_what_is_missed():
    """Of two interactions above yield the one in the window is found, the other one, 5 rad/s wide, only by every speed."""
    response, diagram = spiked((1232.0, 1237.0, 1e-3), (1832.0, 1836.0, 1e-3)), campbell([1200.0])
    found = compare(response, diagram, replay(response, diagram, PLAN, CHOICE), InteractionChoice())
    rows = [(each.interaction["peak_speed_rad_s"], each.nearest is not None, each.same) for each in found.interactions]
    assert rows == [(1237.0, True, True), (1836.0, False, False)]
    every = compare(response, diagram, [plain_grid(PLAN, 1.0)], InteractionChoice())
    assert (every.runs, [each.same for each in every.interactions]) == (1251, [True, True])
    outcomes = {PAIR: {"adaptive": found, "every 1 rad/s": every}}
    assert [row[1:5] for row in summary(outcomes)[1]] == [
        ["adaptive", f"{found.runs}", "1 of 2", "1"],
        ["every 1 rad/s", "1,251", "2 of 2", "2"],
    ]
    assert [row[-3:] for row in by_blade(outcomes)[1]] == [["2", "1", "1"], ["2", "2", "2"]]
    assert [row[3:] for row in missed(outcomes)[1]] == [["1836", "3.9", "", ""]]


def test_errors_between_the_speeds_that_are_run():
    """Of a response with one spike: a line over it misses the spike, and nothing else."""
    response = spiked()
    for name in ("rms_normal", "max_von_mises_last_revolution"):
        response[name][:] = 1.0
        response[name].loc[{"speed": 1000.0}] = 3.0
    share = 2.0 / (1251 + 2)
    assert errors_between(response, [750.0, 999.0, 1001.0, 2000.0]) == pytest.approx((share, share, 2.0 / 3.0))
    assert errors_between(response, [750.0, 999.0, 1000.0, 1001.0, 2000.0]) == (0.0, 0.0, 0.0)
    diverged = response.copy(deep=True)
    diverged["max_von_mises_last_revolution"].loc[{"speed": 1000.0}] = np.nan
    assert errors_between(diverged, [750.0, 2000.0])[1:] == (0.0, 0.0)
    assert np.isnan(errors_between(response.drop_vars("max_von_mises_last_revolution"), [750.0, 2000.0])[1:]).all()
