"""Tolerances: the sample, what its members are, their ranges, and the ranking of numbers."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from defaults import InteractionChoice
from matplotlib.colors import to_rgb
from refusal_tables import pattern_of, refusal_rows
from test_interactions import campbell, response, stresses

from r37core.adaptive.criterion import RefinementChoice, next_speeds
from r37core.base.dataset_file import write_groups
from r37core.base.io import InputFileError
from r37core.base.speeds import RefinedRange
from r37core.config import ConfigError, Document
from r37core.config.spread import SpreadEntry
from r37core.figures import style
from r37core.product.extensions import read_settings
from r37core.product.remarks import remarks as remarks_of
from r37core.results.columns import INTERACTIONS, names
from r37core.results.danger import danger_of
from r37core.results.interactions import find_interactions
from r37core.time_integration.status import RunStatus
from r37studies.member_values import sobol_points
from r37studies.tolerances.dataset import tolerances_dataset
from r37studies.tolerances.figures import draw_tolerances
from r37studies.tolerances.members import Tolerances
from r37studies.tolerances.number_ranks import ranking, share_ends
from r37studies.tolerances.ranges import COLUMNS, ranged_summary
from r37studies.tolerances.table import ranges


def test_more_members_change_none_that_are_there():
    few, many = sobol_points(3, 16, 7), sobol_points(3, 32, 7)
    assert all(many[name] == place for name, place in few.items())
    assert list(many) == [str(row) for row in range(32)] and len(set(many.values())) == 32
    assert sobol_points(3, 16, 8)["0"] != few["0"]


@pytest.mark.parametrize(
    ("tolerance", "shares", "expected"),
    [
        (SpreadEntry(uniform_percent=5.0), (0.0, 0.5, 1.0), (1.9, 2.0, 2.1)),
        (SpreadEntry(uniform=0.5), (0.0, 0.25, 1.0), (1.5, 1.75, 2.5)),
        (SpreadEntry(normal_percent=10.0), (0.5, 0.975, 0.025), (2.0, 2.391992797, 1.608007203)),
        (SpreadEntry(between=[0.8, 1.25]), (0.0, 1.0), (0.8, 1.25)),
        (SpreadEntry(log_between=[0.5, 8.0]), (0.0, 0.5), (0.5, 2.0)),
        (SpreadEntry(values=[3.0, 1.0]), (0.0, 0.49, 0.5, 1.0), (3.0, 3.0, 1.0, 1.0)),
    ],
)
def test_values_of_a_distribution(tolerance, shares, expected):
    assert [tolerance.value(2.0, share) for share in shares] == pytest.approx(expected, rel=1e-9)


def places(found):
    return np.array([found["rank_place_low"], found["rank_place_high"]])


def jumping(members):
    """Values of a sample and a measure that falls with the first, in jumps, and rises with the second, not with the third."""
    values = np.array(list(sobol_points(3, members, 0).values()))
    return values, np.exp(np.floor(-8.0 * values[:, 0]) + 2.0 * values[:, 1])


def test_the_ranking_is_of_ranks_and_has_signs():
    values, measure = jumping(128)
    found = ranking(values, measure)
    assert found["rank_coefficient"][0] < -0.9 and 0.1 < found["rank_coefficient"][1] < 0.3
    np.testing.assert_array_equal(places(found), [[1.0, 2.0, np.nan]] * 2)
    assert found["rank_members"] == 128 and 0.9 < found["rank_explained"] < 1.0
    # any monotonous change of the measure is the same to it
    xr.testing.assert_identical(ranking(values, np.log(measure)), found)


def test_what_few_members_do_not_tell_apart_shares_its_places():
    """Whatever the direction of a number."""
    for members, last in ((16, [[1.0, 1.0], [2.0, 2.0]]), (1024, [[1.0, 2.0], [1.0, 2.0]])):
        values = np.array(list(sobol_points(3, members, 0).values()))
        found = places(ranking(values, values @ [1.0, 0.95, 1e-3]))
        np.testing.assert_array_equal(found[:, :2], last)
        assert members == 1024 or np.isnan(found[0, 2])
    random = np.random.default_rng(0)
    for _ in range(50):
        values = random.random((24, 3)) @ [[1.0, 0.8, 0.0], [0.0, 1.0, 0.0], [0.0, 0.5, 1.0]]
        measure = values @ [1.0, 0.5, 0.5] + random.random(24)
        np.testing.assert_array_equal(places(ranking(values * [1.0, -1.0, 1.0], measure)), places(ranking(values, measure)))


def test_intervals_of_a_ranking_miss_as_seldom_as_said():
    random, size, missed, wrong = np.random.default_rng(0), [2.0, 1.0, 0.0, 1.0], [], []
    whole = random.random((100_000, 4))
    truth = ranking(whole[:, :3], whole @ size)["rank_coefficient"]
    for _ in range(400):
        values = random.random((24, 4))
        found = ranking(values[:, :3], values @ size)
        missed.append((found["rank_coefficient_low"] > truth) | (found["rank_coefficient_high"] < truth))
        first, last = places(found)
        wrong.append((first > [1, 2, 3]).any() or (last < [1, 2, 3]).any())
    assert 0.02 < np.mean(missed) < 0.08
    assert np.mean(wrong) < 0.03


def test_a_ranking_leaves_out_what_does_not_vary_and_members_without_the_measure():
    """And too few members rank nothing."""
    values, measure = jumping(64)
    found = ranking(values, measure)
    beside = ranking(np.column_stack([values, np.full(64, np.nan), np.full(64, 0.15)]), measure)
    xr.testing.assert_identical(beside.isel(number=slice(3)), found)
    nothing = [beside.isel(number=slice(3, None)), ranking(values, np.zeros(64))]
    for one in (*nothing, *(ranking(values[:few], measure[:few]) for few in (2, 4))):
        assert np.isnan(one["rank_coefficient"]).all() and np.isnan(places(one)).all()
    measure[:5] = np.nan
    assert ranking(values, measure)["rank_members"] == 59
    xr.testing.assert_identical(ranking(values, measure), ranking(values[5:], measure[5:]))


def settings_of(root, content, **more):
    over = {"blades": ["Ref", "S100"], "scenes": ["abradable", "direct"], "tolerances": content, **more}
    return read_settings(root, Document("over.yaml", over))


def test_members_have_the_values_of_the_sample(root):
    numbers = {"friction.coefficient": {"uniform_percent": 5.0}, "lining.elastic_modulus_pa": {"values": [1.0e10, 3.0e10]}}
    settings = settings_of(root, {"members": 8, "blades": ["Ref"], "of_scenes": numbers})
    assert settings.made(Tolerances).pairs == [("Ref", "abradable"), ("Ref", "direct")]
    lined, direct = (settings.made(Tolerances).all["Ref", scene] for scene in ("abradable", "direct"))
    assert list(lined) == [str(row) for row in range(8)]
    for name, member in lined.items():
        assert member.values == (member.scene.friction.coefficient, member.scene.lining.elastic_modulus)
        assert 0.1425 < member.values[0] < 0.1575
        assert direct[name].values == (member.values[0], None)
        others = [replace(scene, friction=None, lining=None) for scene in (member.scene, settings.scenes["abradable"].scene)]
        assert others[0] == others[1]
    assert {member.scene.lining.elastic_modulus for member in lined.values()} == {1.0e10, 3.0e10}


def test_members_have_the_joint_values_of_a_file(root, tmp_path):
    """As a calibration draws them: the values of a row belong together, whatever else has the same."""
    file = tmp_path / "members.csv"
    rows = [(0.1, 1e-3), (0.1, 2e-3), (0.2, 2e-3), (0.3, 1e-3), (0.3, 3e-3)]
    lines = "".join(f"{friction},{damping}\n" for friction, damping in rows)
    file.write_text(f"scene.friction.coefficient,scene.damping_ratio\n{lines}")
    settings = settings_of(root, {"drawn_file": str(file), "members": 4, "blades": ["Ref"]})
    members = settings.made(Tolerances).all["Ref", "direct"].values()
    assert [member.values for member in members] == [rows[place] for place in (0, 1, 2, 3)]
    assert [member.scene.friction.coefficient for member in members] == [0.1, 0.1, 0.2, 0.3]
    with pytest.raises(ConfigError, match=r"drawn_file: found 5 rows in .*; allowed: 8 or more"):
        settings_of(root, {"drawn_file": str(file), "members": 8})
    with pytest.raises(ConfigError, match="distributions beside it; allowed: one of them"):
        settings_of(root, {"drawn_file": str(file), "members": 4, "of_scenes": {"damping_ratio": {"normal": 1e-4}}})
    file.write_text("scene.friction.coefficient\nhigh\n")
    with pytest.raises(ConfigError, match=r"is not a number; allowed: a CSV with a number in each field"):
        settings_of(root, {"drawn_file": str(file), "members": 2})


def test_a_blade_spreads_in_material_thickness_and_place(root):
    numbers = {"material.youngs_modulus_pa": {"normal_percent": 1.0}, "thickness_percent": {"between": [90.0, 110.0]}}
    numbers |= {"sweep_percent": {"uniform": 10.0}, "lean_deg": {"uniform": 1.0}}
    settings = settings_of(root, {"members": 4, "of_blades": numbers})
    for name in ("Ref", "S100"):
        nominal = settings.blades[name]
        for member in settings.made(Tolerances).all[name, "direct"].values():
            young, thickness, sweep, lean = member.values
            assert member.blade.material == replace(nominal.material, youngs_modulus=young)
            hub, tip = member.blade.definition.profiles[0], member.blade.definition.profiles[-1]
            assert hub.maximum_thickness == pytest.approx(0.01 * thickness * nominal.definition.profiles[0].maximum_thickness)
            assert tip.inlet_thickness == pytest.approx(0.01 * thickness * nominal.definition.profiles[-1].inlet_thickness)
            # Ref has no table of which a share could be kept
            assert (sweep is None) == (name == "Ref")
            before = np.array(nominal.definition.stacking or [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
            after = np.array(member.blade.definition.stacking)
            np.testing.assert_allclose(after[:, 1], (sweep or 100.0) / 100.0 * before[:, 1])
            np.testing.assert_allclose(after[:, 2], before[:, 2] + np.radians(lean) * before[:, 0], atol=1e-15)


def test_the_tolerances_of_the_page_and_of_the_file_are_accepted(root):
    page = (root / "docs/tolerances.md").read_text()
    asked = yaml.safe_load(re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1])
    settings = settings_of(root, asked["tolerances"], scenes=asked["scenes"])
    assert len(settings.made(Tolerances).all["S100", "material_abradable"]) == 32
    with open(root / "config/tolerances.yaml") as stream:
        assert len(settings_of(root, {}, **yaml.safe_load(stream)).made(Tolerances).all["Ref", "material_abradable"]) == 32


@pytest.mark.parametrize(
    ("members", "spread", "said"),
    [
        (
            16,
            {"uniform_percent": 5.0},
            "tolerances: 16 members do not rank the numbers; 32 name the first, 128 tell most apart",
        ),
        (64, {"uniform_percent": 5.0}, "tolerances: 64 members name the first of the numbers at best; 128 tell most apart"),
        (
            128,
            {"values": [0.15]},
            "tolerances.of_scenes: friction.coefficient is 0.15 in all members, so it is not ranked; a wider",
        ),
    ],
)
def test_a_run_says_which_numbers_its_members_do_not_rank(root, members, spread, said):
    numbers = {"friction.coefficient": spread, "damping_ratio": {"uniform_percent": 5.0}}
    given = {"members": members, "blades": ["Ref"], "of_scenes": numbers}
    (remark,) = [one for one in remarks_of(settings_of(root, given)) if "rank" in one or "name the first" in one]
    assert remark.startswith(said)
    alone = {**given, "of_scenes": {"damping_ratio": numbers["damping_ratio"]}}
    assert not any("rank" in one for one in remarks_of(settings_of(root, alone)))


@pytest.mark.parametrize(("kind", "content", "message"), refusal_rows(Path(__file__).with_name("refusals.txt"), "tolerances"))
def test_what_cannot_be_is_refused_before_the_sweep(root, kind, content, message):
    with pytest.raises(ConfigError, match=pattern_of(message)):
        settings_of(root, yaml.safe_load(content))


def test_a_blade_or_scene_without_any_of_the_numbers_has_no_members(root):
    lining = {"lining.thickness_m": {"uniform_percent": 5.0}}
    assert settings_of(root, {"of_scenes": lining}).made(Tolerances).pairs == [("Ref", "abradable"), ("S100", "abradable")]
    sweep = {"sweep_percent": {"uniform": 5.0}}
    assert settings_of(root, {"of_blades": sweep}).made(Tolerances).pairs == [("S100", "abradable"), ("S100", "direct")]
    assert settings_of(root, {}).made(Tolerances).pairs == []


def test_a_table_of_sweep_and_lean_stays_within_its_bounds(root):
    numbers = {"lean_percent": {"values": [1000.0]}, "lean_deg": {"values": [80.0]}}
    with pytest.raises(ConfigError, match=r"of_blades: member \d+ of CS100.*table: lean_deg: found .*less than 90"):
        settings_of(root, {"of_blades": numbers}, blades=["CS100"])


def test_what_is_wrong_with_a_blade_is_told_of_the_blade(root, tmp_path):
    blades = yaml.safe_load((root / "config/blades.yaml").read_text())
    del blades["Ref"]["material"]["yield_stress_pa"]
    (tmp_path / "blades.yaml").write_text(yaml.safe_dump(blades))
    numbers = {"material.yield_stress_pa": {"normal_percent": 1.0}}
    with pytest.raises(ConfigError, match=r"blades\.yaml.*missing key yield_stress_pa") as refusal:
        settings_of(root, {"of_blades": numbers}, blades_file=str(tmp_path / "blades.yaml"))
    assert "tolerances" not in str(refusal.value)


CHOICE = RefinementChoice(
    windows=(), change=0.25, peak=0.0, largest_share=1.0, prominence=0.1, steep_change=1, steep_prominence=1
)
GRID = RefinedRange(100.0, 1.0, 8, 32)


def curves(*heights):
    """Speeds every 8 rad/s, a status and three curves for each member."""
    members = np.array(heights)
    return {
        100.0 + 8.0 * place: [value for height in column for value in (0, height, 0.0, 0.0)]
        for place, column in enumerate(members.T)
    }


def test_members_share_their_speeds_where_some_see_something():
    quiet, early, late = [1e-3] * 5, [1e-3, 1.0, 0.9, 0.9, 0.9], [1e-3, 1e-3, 1e-3, 1.0, 0.95]
    one = next_speeds(GRID, curves(early), CHOICE)
    assert 104.0 in one and 120.0 not in one
    assert next_speeds(GRID, curves(early, early), CHOICE) == one
    assert next_speeds(GRID, curves(quiet, quiet), CHOICE) == []
    both = next_speeds(GRID, curves(quiet, early, late), CHOICE)
    assert {104.0, 120.0} <= set(both)
    # with room for one more speed it is where most members are
    narrow = replace(CHOICE, largest_share=6.5 / 33.0)
    assert next_speeds(GRID, curves(early, late, late), narrow) == [120.0]


NUMBERS = ["friction.coefficient", "damping_ratio"]


def branch(peak):
    bare = response(normal=[(peak, 0.01, 4)]).drop_vars(["amplitude", "amplitude_tangential"])
    return bare.sel(speed=slice(1600.0, 1850.0))


def member(peak, diverged=()):
    """A response with a branch of 1B/4 that ends at `peak`, and its values of NUMBERS."""
    one = branch(peak)
    one["status"] = xr.where(one["speed"].isin(diverged), RunStatus.DIVERGED, one["status"]).astype("i1")
    for curve in ("rms_normal", "rms_tangential", "max_von_mises_ever"):
        one[curve] = one[curve].where(one["status"] != RunStatus.DIVERGED)
    return one, (0.1 + 0.001 * peak, None)


def sample(folder, members, pair=("Ref", "abradable")):
    """Sample of members, each a response and its values, and its file."""
    file = folder / f"{'_'.join(pair)}.nc"
    write_groups(((f"{row}/response", one) for row, (one, _) in enumerate(members)), file, {})
    return (*pair, {str(row): values for row, (_, values) in enumerate(members)}), file


def dataset_of(folder, members):
    return tolerances_dataset([sample(folder, members)], NUMBERS).sel(blade="Ref", scene="abradable")


def test_the_dataset_of_members(tmp_path):
    peaks = [1700.0 + 5.0 * row for row in range(20)]
    found = dataset_of(tmp_path, list(map(member, peaks)))
    np.testing.assert_allclose(found["speed_rpm"], found["speed"] * 30.0 / np.pi)
    np.testing.assert_array_equal(found["peak_speed"], peaks)
    np.testing.assert_allclose(found["value"].sel(number=NUMBERS[0]), 0.1 + 0.001 * np.array(peaks))
    assert found["value"].sel(number=NUMBERS[1]).isnull().all()
    assert found["probability_above_yield"].sel(speed=[1600.0, 1750.0, 1795.0]).values.tolist() == [0.0, 0.5, 0.05]
    ends = [found[f"probability_above_yield_{end}"].sel(speed=1750.0) for end in ("low", "high")]
    np.testing.assert_allclose(ends, share_ends(np.array(10), 20))
    spread = found["rms_normal"].sel(speed=1700.0).values
    np.testing.assert_allclose(found["rms_normal_quantile"].sel(speed=1700.0), np.sort(spread)[[0, 9, 18]])
    expected = danger_of(branch(peaks[7]))
    assert found["length_dangerous"][7] == expected["length_dangerous_rad_s"]
    assert found["largest_stress"][7] == expected["largest_stress_pa"]


def test_the_chance_of_passing_yield_has_an_interval(root):
    """Of Clopper and Pearson, also in words on its page."""
    assert np.round(share_ends(np.array([8, 0]), 16), 3).T.tolist() == [[0.247, 0.753], [0.0, 0.206]]
    none_of_32, none_of_16 = (f"{100 * share_ends(np.array(0), members)[1]:.0f}%" for members in (32, 16))
    page = (root / "docs/tolerances.md").read_text()
    assert f"none of 32 members passes yield, the chance may still be {none_of_32}; with 16 members {none_of_16}" in page


def test_a_member_that_diverges_is_one_recorded_member(tmp_path):
    found = dataset_of(tmp_path, [member(1700.0, diverged=[1710.0] if row == 3 else ()) for row in range(4)])
    at = found.sel(speed=1710.0)
    assert at["status"].values.tolist() == [0, 0, 0, RunStatus.DIVERGED]
    assert at["probability_above_yield"] == 0.25
    assert np.isinf(at["rms_normal_quantile"].sel(quantile=0.95)) and np.isfinite(at["rms_normal_quantile"].sel(quantile=0.5))
    # all leave the model at one speed, of which this one has passed yield first
    left = found["exit_revolution"].where(found["speed"] != 1710.0, 9.0)
    left[3] = np.nan
    figure = draw_tolerances(found.assign(exit_revolution=left), branch(1700.0), "Ref, abradable")
    drawn = [np.vstack([path.vertices for path in each.get_paths()]) for each in figure.subfigs[0].axes[3].collections]
    assert [places[places[:, 0] == 1710.0, 1].max() for places in drawn] == [25.0, 100.0]


def test_the_peak_s_spread_comes_from_the_number_that_moves_it(tmp_path):
    points = sobol_points(2, 8, 0).values()
    members = dataset_of(tmp_path, [(branch(5.0 * round((1700.0 + 60.0 * place[1]) / 5.0)), place) for place in points])
    found = members.sel(measure="peak_speed")
    assert found["member"].values.tolist() == list(range(8))
    assert found["rank_place_low"][1] == found["rank_place_high"][1] == 1.0 and np.isnan(found["rank_place_low"][0])
    assert found["rank_coefficient_low"][1] > 0.0 and found["rank_members"] == 8
    figure = draw_tolerances(members, branch(1700.0), "Ref")
    _, part = figure.subfigs
    named = [handle.get_facecolor()[:3] for handle in part.axes[0].get_legend().legend_handles]
    assert named == [to_rgb(colour) for colour in style.COLOURS[:3]]


def test_two_scenes_with_other_speeds_and_numbers_stand_in_one_dataset(tmp_path):
    bare = response(normal=[(1000.0, 0.01, 6)], step=10.0).drop_vars([*stresses(0.0), "yield_stress"])
    bare = bare.assign(exit_revolution=("speed", np.full(bare.sizes["speed"], np.nan)))
    other = sample(tmp_path, [(bare.isel(speed=slice(3, 9)), (0.2, 0.3))] * 2, ("S100", "direct"))
    found = tolerances_dataset([sample(tmp_path, [member(1700.0)] * 2), other], NUMBERS)
    assert found["blade"].values.tolist() == ["Ref", "S100"]
    assert found["rms_normal"].sel(blade="S100", scene="direct").notnull().sum() == 12
    assert found["rms_normal"].sel(blade="S100", scene="abradable").isnull().all()
    assert (found["status"].sel(blade="S100", scene="abradable") == RunStatus.NOT_RUN).all()
    assert found["status"].dtype == np.int8
    assert found["largest_stress"].sel(blade="S100").isnull().all()
    draw_tolerances(found.sel(blade="S100", scene="direct"), bare, "S100")


def interactions_of(*branches):
    return find_interactions(response(normal=branches), campbell(), InteractionChoice())


def test_ranges_of_interactions():
    nominal = interactions_of((1700.0, 0.01, 4), (1240.0, 0.005, 5))
    members = {
        str(row): interactions_of((1690.0 + 5.0 * row, 0.01, 4), *([(990.0, 0.004, 6)] if row < 4 else [])) for row in range(10)
    }
    six, five, four = ranges(nominal, members, InteractionChoice())
    assert [one["engine_order"] for one in (six, five, four)] == [6, 5, 4]
    assert (five["share_of_members"], five["robust"], five["peak_speed_rad_s"]) == (0.0, False, 1240.0)
    assert np.isnan(five["peak_speed_rad_s_median"])
    assert (six["share_of_members"], six["robust"]) == (0.4, False) and np.isnan(six["peak_speed_rad_s"])
    assert (four["share_of_members"], four["robust"], four["members"]) == (1.0, True, 10)
    assert [four[f"peak_speed_rad_s_{end}"] for end in ("low", "median", "high")] == [1690.0, 1710.0, 1735.0]
    assert four["length_dangerous_rad_s_median"] == pytest.approx(four["length_dangerous_rad_s"])
    # what lies beyond the members' speeds is not theirs to show
    (only,) = ranges(nominal, {"0": interactions_of((1710.0, 0.01, 4))}, InteractionChoice(), (1600.0, 1800.0))
    assert (only["engine_order"], only["share_of_members"]) == (4, 1.0)


def test_the_summary_has_the_ranges_beside_the_nominal_run(tmp_path):
    """Whatever a blade is called; without a nominal interaction there is nothing beside which they could stand."""
    nominal = interactions_of((1700.0, 0.01, 4), (1240.0, 0.005, 5))
    rows = ranges(nominal, {"0": interactions_of((1710.0, 0.01, 4), (990.0, 0.004, 6))}, InteractionChoice())
    table = pd.DataFrame([{"blade": "NA", "scene": "lined", **row} for row in rows], columns=COLUMNS)
    table.to_csv(tmp_path / "tolerances.csv", index=False)
    summary = pd.DataFrame([{"blade": name, "scene": "lined", **one} for name in ("NA", "L50") for one in nominal])
    joined = ranged_summary(summary.astype({"engine_order": "Int64"}), tmp_path / "tolerances.csv")
    assert len(joined) == len(summary)
    assert joined["share_of_members"].fillna(-1.0).tolist() == [0.0, 1.0, -1.0, -1.0]
    assert joined["peak_speed_rad_s_median"].dropna().tolist() == [1710.0]
    joined = ranged_summary(pd.DataFrame([], columns=names(INTERACTIONS)), tmp_path / "tolerances.csv")
    assert len(joined) == 0 and "peak_speed_rad_s_low" in joined


@pytest.mark.parametrize("text", ["", "blade,scene,mode,engine_order\nRef,lined,1B,x\n"])
def test_a_damaged_table_is_named(tmp_path, text):
    (tmp_path / "tolerances.csv").write_text(text)
    with pytest.raises(InputFileError, match=r"tolerances\.csv: cannot be read"):
        ranged_summary(pd.DataFrame([], columns=names(INTERACTIONS)), tmp_path / "tolerances.csv")


def shares_of_members(*given):
    return [row["share_of_members"] for row in ranges(*given) if np.isfinite(row["peak_speed_rad_s"])]


def test_each_nominal_interaction_has_its_share_and_members_go_to_the_nearest():
    """What no crossing explains is one up to the span itself; where one member could be of two, it is of the nearer one."""
    nominal, wide = interactions_of((1100.0, 0.01, 3), (1500.0, 0.01, 3)), InteractionChoice(below=0.0, above=0.5)
    peaks = {"0": [1105.0], "1": [1495.0], "2": [], "3": [1110.0]}
    members = {name: interactions_of(*((peak, 0.01, 3) for peak in found)) for name, found in peaks.items()}
    assert shares_of_members(nominal, members, InteractionChoice()) == [0.5, 0.25]
    assert shares_of_members(nominal, {"0": interactions_of((1450.0, 0.01, 3))}, wide) == [0.0, 1.0]
    low, high = interactions_of((1000.0, 0.01, 3)), interactions_of((1500.0, 0.01, 3))
    assert shares_of_members(low, {"0": high}, wide) == [1.0]
    assert shares_of_members(low, {"0": high}, InteractionChoice(below=0.0, above=0.49)) == [0.0]
