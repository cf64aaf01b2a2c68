"""A call has the rounds, members and run-ups of the workflow."""

import pandas as pd
import xarray as xr
from test_refined_runs import RUN_UPS, TOLERANCES, with_extensions  # noqa: F401

import r37


def test_python_has_the_same_rounds_members_and_run_ups(with_extensions, warm_calls):
    """To the last bit, on one core as on two, and without a break."""
    results = r37.open_results(with_extensions / "results")
    common = {"config": with_extensions / "config/config.yaml", "cores": 1}
    speeds = {"start": 1000, "stop": 1240, "step": 80, "refine_to": 20}
    again = r37.run("CS100", "abradable", speeds, tolerances=TOLERANCES, run_ups=RUN_UPS, **common)
    xr.testing.assert_identical(again.response("CS100", "abradable"), results.response("CS100", "abradable"))
    xr.testing.assert_identical(again["tolerances"], results["tolerances"])
    pd.testing.assert_frame_equal(again.tables["tolerances"], results.tables["tolerances"])
    xr.testing.assert_identical(again["run_ups"], results["run_ups"])
