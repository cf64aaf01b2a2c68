"""A call has the rounds, members and run-ups of the workflow."""

import pandas as pd
import pytest
import xarray as xr
import yaml
from test_refined_runs import real  # noqa: F401
from workflow_runs import copy_finished, kill_snakemake, overlay, snakemake

import r37

CROSSING = {"mode": "1B", "engine_order": 6, "first": 0.02, "last": 0.01}
RUN_UPS = {"up": {"from_rpm": 9500, "to_rpm": 9600, "revolutions": 4, "scenes": ["abradable"]}}
RUN_UPS["down"] = {"crossing": CROSSING, "rate_rad_s2": 500, "scenes": ["abradable"]}
TOLERANCES = {"members": 2, "largest_share": 0.9, "of_scenes": {"friction.coefficient": {"uniform_percent": 20}}}
TOLERANCES["of_blades"] = {"material.youngs_modulus_pa": {"uniform_percent": 1}}


@pytest.fixture(scope="module")
def with_extensions(real, tmp_path_factory):
    """A run that was killed in the midst of its members and has gone on."""
    folder = copy_finished(real, tmp_path_factory.mktemp("extensions") / "project")
    extensions = {"run_ups": RUN_UPS, "tolerances": {**TOLERANCES, "scenes": ["abradable"]}}
    overlay(folder, "config.yaml", yaml.safe_dump(extensions, sort_keys=False))
    files = [f"results/{name}" for name in ("tolerances.nc", "tolerances.csv", "run_ups.nc")]
    members = folder / "results/tolerances/CS100/abradable"

    def parts():
        # a part counts once its digest is there: one whose job was killed before is rightly made again
        return {digest: digest.stat().st_mtime_ns for digest in members.glob("*/speed_*.npz.sha256")}

    kill_snakemake(folder, *files, "--cores", "2", when=lambda: len(parts()) > 2)
    assert not (members / "members.nc").exists()
    before = parts()
    snakemake(folder, *files, "--cores", "2")
    assert before.items() < parts().items()
    return folder


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
