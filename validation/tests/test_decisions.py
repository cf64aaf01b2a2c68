"""Evidence of the pages on ranking, tolerances, search, families and rotors, on made-up data."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from evidence import better_blade, designs, lining, rotor, tolerances, which_blade
from evidence.pages import read_table

RANDOM = np.random.default_rng(0)


def test_scatter_is_that_of_the_noise_and_not_of_the_curve():
    speeds = np.linspace(0.0, 1.0, 4001)
    values = (2.0 + np.sin(6.0 * speeds)) * (1.0 + 0.03 * RANDOM.standard_normal(len(speeds)))
    assert which_blade.scatter(values) == pytest.approx(3.0, rel=0.1)


def response(above, step=1.0, lined=1.0):
    """A response on speeds from 800 rad/s on, whose shares are 1 in the range `above` and 0 elsewhere."""
    speeds = np.arange(800.0, 900.5, step)
    shares = ((speeds >= above[0]) & (speeds <= above[1])).astype(float)
    content = {"share_of_revolutions_above_yield": ("speed", shares), "status": ("speed", np.zeros(len(speeds), "i1"))}
    content |= {"rms_normal": (("speed", "tip_point"), np.ones((len(speeds), 2))), "lined": lined}
    return xr.Dataset(content, {"speed": speeds})


def test_adaptive_speeds_stand_next_to_all(tmp_path):
    """Both scenes in one row; the grid of 20 rad/s misses the lined range."""
    files = {}
    for kind, step in (("every", 1.0), ("adaptive", 20.0)):
        for scene, lined in (("abradable", 1.0), ("direct", 0.0)):
            file = tmp_path / kind / "Ref" / scene / "response.nc"
            file.parent.mkdir(parents=True)
            response((841, 851), step, lined).to_netcdf(file)
            files.setdefault(kind, []).append(str(file))
    which_blade.adaptive(SimpleNamespace(**files), SimpleNamespace(table=tmp_path / "table.csv"), None)
    head, row = read_table(tmp_path / "table.csv")
    assert head[1:3] == ["lining: every 1 rad/s", "lining: adaptive"]
    assert row[:3] == ["Ref", "11 ± 1 (12)", "0 (0)"]


def test_blades_are_ranked_by_contact_length(tmp_path):
    files = []
    for blade, lengths in {"Ref": (30.0, 5.0), "S100": (10.0, 20.0)}.items():
        files.append(tmp_path / f"{blade}.csv")
        pd.DataFrame([{"blade": blade, "0.05": lengths[0], "1": lengths[1]}]).to_csv(files[-1], index=False)
    output = SimpleNamespace(table=tmp_path / "table.csv", picture=tmp_path / "picture.png")
    lining.contact_lengths(SimpleNamespace(files=files), output, None)
    head, *rows = read_table(output.table)
    assert head == ["blade", "0.05 mm", "1 mm"]
    assert rows == [["Ref", "30 (2)", "5 (1)"], ["S100", "10 (1)", "20 (2)"]]
    assert output.picture.stat().st_size > 10_000


def sample(members=64):
    values = RANDOM.random((members, 2))
    return tolerances.Sample(values, values[:, 0] + 0.1 * values[:, 1])


def test_parts_of_a_sample():
    whole = sample()
    parts = whole.parts(16)
    assert len(parts) == 4 and np.array_equal(parts[1].measure, whole.measure[16:32])
    assert tolerances.range_error([whole], whole) == 0.0
    assert 0.0 < tolerances.range_error(parts, whole) < 0.5


def test_rankings_of_parts():
    parts = {"peak_speed": sample().parts(16)}
    assert tolerances._of_rankings(parts, {"peak_speed": np.array([1.0, 0.1])})[0] == "100%"
    assert tolerances._of_rankings({"peak_speed": sample(8).parts(4)}, {"peak_speed": np.ones(2)}) == ["-", "-"]


def test_a_coefficient_has_its_place_or_a_dash():
    found = sample().ranking
    assert tolerances._coefficient(found, 0).startswith("place 1: ")
    number = np.arange(64.0)
    assert tolerances._coefficient(tolerances.Sample(number[:, None], (-1.0) ** number).ranking, 0) == "-"


@pytest.fixture
def searched(tmp_path):
    """A search of three designs, of which the second is best and the last breaks the constraint of the mass."""
    names, constraints = ["start", "d0000", "d0001", "d0002"], ["bare", "mass", "first_bending"]
    content = {
        "order": ("design", [0, 2, 1, 0]),
        "feasible": ("design", [1, 1, 1, 0]),
        "value": (("design", "variable"), [[100.0], [101.0], [104.567], [110.0]]),
        "objective_value": (("design", "objective"), [[11.0], [9.0], [5.0], [2.0]]),
        "constraint_value": (("design", "constraint"), [[6.0, 2.0, 800.0], [5, 2, 800], [4, 2.05, 820], [1, 3, 850]]),
        "constraint_lowest": ("constraint", [-np.inf, -np.inf, 700.0]),
        "constraint_highest": ("constraint", [6.0, 2.1, 900.0]),
    }
    labels = {"design": names, "variable": ["thickness_percent.hub"], "objective": ["lined"], "constraint": constraints}
    file = tmp_path / "one/search.nc"
    for name, width in zip(names, (10, 8, 4, 1), strict=True):
        for scene, lined in (("material_abradable", 1.0), ("direct", 0.0)):
            folder = file.parent / "search" / name / "Free" / scene
            folder.mkdir(parents=True)
            content_of = response((841, 841 + width), lined=lined)
            for statistic in ("ever", "median", "high"):
                content_of[f"max_von_mises_{statistic}"] = content_of["share_of_revolutions_above_yield"]
            content_of["rms_tangential"] = content_of["rms_normal"]
            content_of = content_of.assign_coords(tip_point=["leading_edge", "trailing_edge"])
            content_of.assign(yield_stress=0.5).to_netcdf(folder / "response.nc")
    xr.Dataset(content, labels).to_netcdf(file)
    return SimpleNamespace(searches=[str(file)]), SimpleNamespace(searches={str(file): "surrogate, seed 1"})


def test_a_search_is_its_best_design_next_to_the_start(searched, tmp_path):
    inputs, params = searched
    better_blade.searches(inputs, SimpleNamespace(table=tmp_path / "table.csv"), params)
    head, start, best = read_table(tmp_path / "table.csv")
    assert head[4:] == ["mass (%)", "1B (%)"]
    assert start[:3] == ["none: Free", "", "11"] and start[4:] == ["100.0", "100.0"]
    assert best[:3] == ["surrogate, seed 1", "2 of 3", "5"] and best[4:] == ["102.5", "102.5"]
    # in a bare casing with its scatter
    assert best[3].startswith("5 ± ")
    search = xr.open_dataset(inputs.searches[0])
    assert better_blade.best_of(search) == "d0001"
    assert better_blade.best_of(search.assign(order=0 * search["order"])) is None


def test_designs_that_break_another_constraint_are_marked(searched, tmp_path):
    inputs, params = searched
    output = SimpleNamespace(table=tmp_path / "table.csv", picture=tmp_path / "picture.png")
    better_blade.designs(inputs, output, params)
    head, *rows = read_table(output.table)
    assert head[:4] == ["search", "design", "lined", "bare"] and head[-1] == "keeps all but bare"
    assert [row[-1] for row in rows] == ["True", "True", "True", "False"]
    assert output.picture.stat().st_size > 10_000


def test_the_worst_motion_counts_and_a_divergence_is_above_yield():
    """The second motion is above yield at one speed more, and diverges at the last."""
    shares = [[0.0, 1.0, 1.0, 0.0], [0.0, 1.0, 1.0, np.nan]]
    over = ("motion", "speed")
    pair = xr.Dataset(
        {"share_of_revolutions_above_yield": (over, shares), "status": (over, [[0, 0, 0, 0], [0, 0, 0, 1]]),
         "differ": ("speed", [0.0, 0.0, 0.0, 1.0])},
        {"motion": ["rest", "up"], "speed": [10.0, 20.0, 30.0, 40.0]},
    )  # fmt: skip
    assert better_blade._motions(pair) == ["20", "25"]


def test_correlation_over_designs(tmp_path):
    rows = [
        {"blade": f"Sweep_{n}", "scene": scene, **dict.fromkeys(designs.LEFT, n), "length_most_revolutions_rad_s": sign * n}
        for n in range(4)
        for scene, sign in (("material_abradable", 1), ("direct", -1))
    ]
    pd.DataFrame(rows).to_csv(tmp_path / "designs.csv", index=False)
    files = SimpleNamespace(designs=tmp_path / "designs.csv"), SimpleNamespace(table=tmp_path / "table.csv")
    designs.correlations(*files, None)
    assert read_table(tmp_path / "table.csv")[1] == ["loss of clearance, 1T", "1.00", "-1.00"]


def test_length_about_a_crossing_leaves_out_the_rest():
    speeds = np.arange(900.0, 1300.0, 10.0)
    stress = np.where((np.abs(speeds - 1000.0) < 15.0) | (speeds > 1200.0), 2.0, 0.0)
    ratio = xr.DataArray(stress, {"speed": speeds}, ("speed",))
    assert rotor.length_about(ratio, 1000.0) == pytest.approx(30.0)


def test_blades_at_once_are_counted_where_some_are_above_yield():
    shares = xr.Dataset({"blades_ever_above_yield": ("speed", [0.0, 1 / 36, 3 / 36])}, {"blade_number": range(36)})
    assert rotor._at_once(shares) == "2 (3)"
    assert rotor._at_once(shares * 0.0) == "none"


def test_steep_speeds_are_at_the_top_of_the_widest_range():
    found = response((841, 851))
    found["rms_normal"] = found["rms_normal"] + (found["speed"] == 848.0)
    found["rms_tangential"] = found["rms_normal"]
    assert which_blade.steep_speeds(found.assign_coords(tip_point=["leading_edge", "trailing_edge"]))[6:] == [848.0, 850.0]
    assert len(which_blade.steep_speeds(response((0, 1)))) == 6


def test_a_kind_of_rotor_without_speeds_in_a_window_has_dashes():
    speeds = np.arange(1600.0, 1700.0, 10.0)
    stress = np.where(np.abs(speeds - 1650.0) < 15.0, 2.0, 0.0)
    content = {"blade_max_von_mises_ever": (("speed", "blade_number"), stress[:, None] * [0.1, 1.0]), "yield_stress": 1.0}
    content |= {"blades_ever_above_yield": ("speed", 0.5 * (stress > 1.0)), "status": ("speed", np.zeros(10, "i1"))}
    found = xr.Dataset(content, {"speed": speeds, "blade_number": [1, 2]})
    assert rotor._in_window(found, "equal") == ["30", "1 (1)"]
    assert rotor._in_window(found.sel(speed=slice(1000.0, 1100.0)), "equal") == ["-", "-"]
