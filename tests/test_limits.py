"""Limits of the model: each alone puts a run beyond them, says so in words, and takes a verdict's *meets*."""

import numpy as np
import pytest
import xarray as xr

from r37core.requirements.choice import Requirements
from r37core.requirements.evidence import Evidence
from r37core.requirements.judging import FAILS, MEETS, UNKNOWN, judge
from r37core.results.limits import OF_LIMITS, beyond_limits, reasons_beyond_limits
from r37core.results.operating_range import OperatingRange

WITHIN = {
    "peak_share_of_height": 0.1,
    "share_of_height_limit": 0.12,
    "largest_normal_force": 700.0,
    "energy_residual_share": 0.02,
    "bounded_share_of_time": 0.0,
    "friction_power": 900.0,
    "melting_power": 9000.0,
}

BEYOND = {
    "peak_share_of_height": (0.13, "moves by up to 0.13 of"),
    "largest_normal_force": (701.0, "reach 701 N"),
    "energy_residual_share": (0.021, "0.021 of the energy"),
    "bounded_share_of_time": (1e-6, "friction.coefficient"),
    "friction_power": (9100.0, "9.1e+03 W"),
}


def runs_with(**changes):
    """Three runs, the last of them with the changes."""
    return {name: np.array([value, value, changes.get(name, value)]) for name, value in WITHIN.items()}


def test_each_limit_is_told_alone():
    assert set(OF_LIMITS) == set(WITHIN)
    assert not beyond_limits(runs_with()).any()
    assert reasons_beyond_limits(runs_with()) == []
    for name, (value, text) in BEYOND.items():
        runs = runs_with(**{name: value})
        assert beyond_limits(runs).tolist() == [False, False, True]
        (reason,) = reasons_beyond_limits(runs)
        assert text in reason


def test_linear_runs_have_no_limits_of_second_order():
    """Of a linear blade neither the motion nor its limit is known; heat is."""
    runs = runs_with(largest_normal_force=5e4, friction_power=1e5)
    linear = {name: values for name, values in runs.items() if "height" not in name}
    assert len(reasons_beyond_limits(linear)) == 1
    assert not beyond_limits({})
    assert reasons_beyond_limits({}) == []


@pytest.mark.parametrize("name", BEYOND)
@pytest.mark.parametrize(("share", "within", "beyond"), [(0.0, MEETS, UNKNOWN), (1.0, FAILS, FAILS)])
def test_a_verdict_beyond_a_limit_meets_nothing(name, share, within, beyond):
    """Nor is the note of one that fails empty; what lies outside of the operating range counts for nothing."""
    changed = {name: BEYOND[name][0]}
    for changes, last, verdict in (({}, 1002.0, within), (changed, 1002.0, beyond), (changed, 1001.0, within)):
        runs = {key: ("speed", values) for key, values in runs_with(**changes).items()}
        runs |= {"status": ("speed", [0, 0, 0]), "share_of_revolutions_above_yield": ("speed", [share] * 3)}
        runs |= {"static_stress": 1.0, "yield_stress": 1.0, "lined": 1.0}
        evidence = Evidence(xr.Dataset(runs, {"speed": [1000.0, 1001.0, 1002.0]}), operating=OperatingRange(1000.0, last))
        (row,) = judge(Requirements(above_yield=0.0), evidence)
        assert row["verdict"] == verdict
        assert (BEYOND[name][1] in row["note"]) == (bool(changes) and last == 1002.0)
