"""Closing lines of the studies."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from r37studies.designs import table as designs
from r37studies.rotors import dataset as rotors
from r37studies.run_ups import tables as run_ups
from r37studies.search import dataset as search
from r37studies.tolerances import table as tolerances

WHERE = {"blade": ["Ref", "NA"], "scene": ["lined", "lined"]}
STRESS = {"largest_stress_pa": [2.314e9, np.nan]}


def table(folder, name, **columns):
    pd.DataFrame(columns).to_csv(folder / name, index=False)


def test_run_ups(tmp_path):
    numbers = {"yield_stress_pa": [1.38e9] * 2, "largest_stress_speed_rad_s": [1718.2, np.nan]}
    table(tmp_path, "run_ups.csv", **WHERE, **STRESS, **numbers, status=["completed", "diverged"])
    largest = "the largest stress 2.31 GPa, Ref in lined at 1718.2 rad/s"
    assert run_ups.closing(tmp_path) == f"2 run-ups, 1 of them above yield, 1 diverged; {largest}"
    table(tmp_path, "run_ups.csv", **WHERE, status=["completed"] * 2)
    assert run_ups.closing(tmp_path) == "2 run-ups"


def test_rotors(tmp_path):
    numbers = {"worst_speed_rad_s": [1640.0, 1650.0], "speeds": [2, 3]}
    for diverged, said in (([0, 0], ""), ([0, 3], ", 3 of 5 runs diverged")):
        table(tmp_path, "rotors.csv", **WHERE, **STRESS, **numbers, diverged_speeds=diverged)
        assert rotors.closing(tmp_path) == f"2 rotors{said}; the largest stress 2.31 GPa, Ref in lined at 1640 rad/s"


TIED = "2 designs; lined: 2 of 2 cannot be told apart by their dangerous and unknown speeds"
GOODMAN = {"largest_goodman_share": [0.4, 0.55, np.nan]}


@pytest.mark.parametrize(
    ("within", "diverged", "more", "said"),
    [
        (20.0, 0, GOODMAN, "2 designs; lined: B is dangerous at the fewest speeds (13 rad/s)"),
        # brackets overlap
        (
            20.0,
            0,
            GOODMAN | {"length_unknown_rad_s": [0.0, 9.0, 0.0]},
            f"{TIED}; of these A has the least share of the Goodman line (0.4)",
        ),
        (25.0, 0, GOODMAN, f"{TIED}; of these A has the least share of the Goodman line (0.4)"),
        # one that diverged has no largest share
        (25.0, 1, GOODMAN, f"{TIED}; of these B has the least share of the Goodman line (0.55)"),
        (25.0, 0, {"largest_goodman_share": np.nan}, TIED),
    ],
)
def test_designs(tmp_path, within, diverged, more, said):
    """Those that cannot be told apart are counted, and the number that the choice among them is made by is told."""
    lengths = {"length_dangerous_rad_s": [40.0, 13.2, np.nan], "length_unknown_rad_s": 0.0, "diverged_runs": [diverged, 0, 0]}
    lengths["length_dangerous_within_rad_s"] = [within, 10.0, np.nan]
    table(tmp_path, "designs.csv", blade=["A", "B", "A"], scene=["lined", "lined", "quiet"], **lengths | more)
    assert designs.closing(tmp_path) == said


def test_tolerances(tmp_path):
    ends = {"largest_stress_pa_low": [2.02e9, np.nan], "largest_stress_pa_high": [1.41e10, np.nan]}
    xr.Dataset({"status": (("member", "speed"), [[0, 1, 2], [0, 0, 2]])}).to_netcdf(tmp_path / "tolerances.nc")
    table(tmp_path, "tolerances.csv", **WHERE, members=[32, 32], robust=[True, False], **ends)
    count, largest = "1 of them in at least half of those; 1 of 4 runs diverged", "the largest stress 2 to 14 GPa, Ref in lined"
    assert tolerances.closing(tmp_path) == f"2 interactions in up to 32 members, {count}; {largest}"
    table(tmp_path, "tolerances.csv", **{name: [] for name in (*WHERE, "members", "robust", *ends)})
    assert tolerances.closing(tmp_path).startswith("0 interactions in up to 0 members")


def test_search(tmp_path):
    axes = ("design", "objective")
    values = {"objective_value": (axes, [[70.6, 2.0], [13.24, 2.1], [90.0, 1.0]])}
    values |= {"objective_scatter": (axes, [[0.6, 0.0], [0.5, 0.0], [1.0, 0.0]]), "feasible": ("design", [1, 1, 0])}
    units = {"objective_unit": ("objective", ["rad s-1", "kg"])}
    names = {"design": ["start", "d0001", "d0002"], "objective": ["lined", "mass"]}
    found = xr.Dataset(values | {"order": ("design", [0, 1, 0])}, names | units)
    found.to_netcdf(tmp_path / "search.nc")
    said = search.closing(tmp_path).replace(str(tmp_path), "results")
    best = "the best, d0001: lined 13.2 rad/s (the start 70.6), mass 2.1 kg (the start 2)"
    assert said == f"2 designs, 1 of them keep all constraints; {best}; its values are in results/search.csv"
    found.assign(feasible=("design", [1, 1, 1]), objective_scatter=20.0 * found["objective_scatter"] + 99.0).to_netcdf(
        tmp_path / "search.nc"
    )
    assert "; 1 other cannot be told apart from it; its values" in search.closing(tmp_path)
    found.assign(order=("design", [0, 0, 0])).to_netcdf(tmp_path / "search.nc")
    assert search.closing(tmp_path) == "2 designs, 1 of them keep all constraints"
