"""Verdicts of runs beyond the model's limits."""

import numpy as np
import pytest
import xarray as xr
from test_limits import BEYOND, runs_with

from r37core.results.operating_range import OperatingRange
from r37studies.requirements.choice import Requirements
from r37studies.requirements.evidence import Evidence
from r37studies.requirements.judging import FAILS, MEETS, UNKNOWN, judge


@pytest.mark.parametrize("name", BEYOND)
@pytest.mark.parametrize(("share", "within", "beyond"), [(0.0, MEETS, UNKNOWN), (1.0, FAILS, FAILS)])
def test_a_verdict_beyond_a_limit_meets_nothing(name, share, within, beyond):
    """Nor is the note of one that fails empty; what lies outside of the operating range counts for nothing."""
    changed = {name: BEYOND[name][0]}
    for changes, last, verdict in (({}, 1002.0, within), (changed, 1002.0, beyond), (changed, 1001.0, within)):
        runs = {key: ("speed", values) for key, values in runs_with(**changes).items()}
        runs |= {"status": ("speed", [0, 0, 0]), "max_von_mises_inside": ("speed", [2.0 * share] * 3)}
        runs |= {"static_stress": 1.0, "yield_stress": 1.0, "lined": 1.0, "exit_revolution": ("speed", [np.nan] * 3)}
        evidence = Evidence(xr.Dataset(runs, {"speed": [1000.0, 1001.0, 1002.0]}), operating=OperatingRange(1000.0, last))
        (row,) = judge(Requirements(above_yield=0.0), evidence)
        assert row["verdict"] == verdict
        assert (f"beyond the model by {BEYOND[name][2]}" in row["note"]) == (bool(changes) and last == 1002.0)
