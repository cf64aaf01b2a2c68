"""Where a blade exceeds yield: smoothed shares, ranges, their scatter, rows of direct contact, and the ranking."""

from functools import partial

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from test_interactions import CHOICE, campbell

from r37core.results.columns import MOST_REVOLUTIONS, OVER_SCENES, ROBUSTNESS, names
from r37core.results.danger import danger_of, moved_by_error, ranges_of
from r37core.results.exceedance import DEVIATIONS, Exceedance, SpeedRange, exceedance_of, joined, length_of, ranges_above
from r37core.results.interactions import find_interactions, rows_above_yield
from r37core.results.ranking import chance_to_be_better, ranking_table, ranks_of, robustness
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

rows_of = partial(rows_above_yield, name=lambda _: {})
span = partial(SpeedRange, truncated=False)


SPEEDS = np.arange(900.0, 1001.0, 10.0)

SOME = 0.05


def drawn(chance, speeds, revolutions=100, seed=0):
    """Shares of so many revolutions above yield, where each is so with a known chance."""
    return np.random.default_rng(seed).binomial(revolutions, chance) / revolutions + 0.0 * speeds


def rising(speeds):
    """The chance of yield rises from 0 at 1000 to 1 at 1100 rad/s and falls back at 1300."""
    return np.clip((speeds - 1000.0) / 100.0, 0.0, 1.0) * (speeds < 1300.0)


def test_ranges_are_of_straight_lines():
    speeds = np.array([0.0, 10.0, 20.0, 30.0, 40.0])
    assert ranges_above(speeds, np.array([0.0, 1.0, 0.0, 0.0, 1.0]), 0.5) == [
        span(5.0, 15.0), SpeedRange(35.0, 40.0, truncated=True),
    ]  # fmt: skip
    assert ranges_above(speeds, np.array([1.0, 0.0, 0.0, 0.0, 0.0]), 0.5) == [SpeedRange(0.0, 5.0, truncated=True)]
    assert ranges_above(speeds, np.full(5, 0.5), 0.5) == []
    assert ranges_above(speeds, np.array([1.0, 4.0, np.inf, 2.0, 1.0]), 3.0) == [span(pytest.approx(20.0 / 3.0), 25.0)]
    both = [span(5.0, 9.0), SpeedRange(0.0, 6.0, truncated=True), span(9.5, 10.0)]
    assert joined(both) == [SpeedRange(0.0, 9.0, truncated=True), span(9.5, 10.0)]
    touching = [span(low, high) for low, high in ((0.0, 1.0), (2.0, 5.0), (3.0, 4.0), (5.0, 6.0))]
    assert joined(touching) == [span(0.0, 1.0), span(2.0, 6.0)]


def test_dangerous_and_unknown_speeds_and_what_an_error_moves():
    """A stress of 1.5 of yield at one speed; a speed that leaves the model first is unknown half of the way to the next."""
    runs = {"status": [0, 0, 0], "share_of_revolutions_above_yield": [0.0, 0.2, 0.0]}
    response = xr.Dataset({name: ("speed", values) for name, values in runs.items()}, {"speed": [1000.0, 1100.0, 1200.0]})

    def of_stress(*stress, left=(np.nan, np.nan, np.nan)):
        values = {"max_von_mises_inside": ("speed", list(stress)), "exit_revolution": ("speed", list(left))}
        return response.assign(values | {"yield_stress": 2.0, "lined": 1.0})

    inside = of_stress(1.0, 3.0, 1.0)
    assert list(ranges_of(inside).values()) == [[span(1025.0 + 25.0, 1150.0)], [], []]
    known = danger_of(of_stress(1.0, 1.8, 1.0, left=(np.nan, 7.0, np.nan)))
    assert (known["length_dangerous_rad_s"], known["length_unknown_rad_s"]) == (0.0, 100.0)
    assert danger_of(of_stress(1.0, 3.0, 1.0, left=(np.nan, 7.0, np.nan)))["length_unknown_rad_s"] == 0.0
    assert moved_by_error(inside, 0.2) == pytest.approx(40.0)
    assert moved_by_error(of_stress(4.0, 1.8, 1.8), 0.25) == pytest.approx(200.0 - 100.0 / 1.1)
    assert moved_by_error(of_stress(4.0, 2.2, 2.2), 0.25) == pytest.approx(200.0 - 75.0 / 0.9)
    assert np.isnan(moved_by_error(inside, np.nan))
    # without stress nothing is known
    assert np.isnan(list(danger_of(inside[["status", "lined"]]).values())).all()


@pytest.mark.parametrize("step", [1.0, 5.0, 10.0])
def test_borders_are_found_again_within_their_scatter(step):
    """A known chance over speed: borders of a half and of a twentieth, and the length, of samples of 100 revolutions."""
    speeds = np.arange(900.0, 1400.1, step)
    for seed in range(4):
        found = Exceedance(speeds, drawn(rising(speeds), speeds, seed=seed), chance=True)
        (certain,), (possible,) = found.ranges(MOST_REVOLUTIONS), found.ranges(SOME)
        scatter = found.scatter_of_border(MOST_REVOLUTIONS, certain, begins=True)
        assert abs(certain.begin - 1050.0) < max(4.0 * scatter, 2.0)
        assert 0.0 < scatter < 3.0 + 1.5 * step
        assert certain.end == pytest.approx(1300.0, abs=2.0 + 0.75 * step)
        assert 990.0 < possible.begin < 1005.0 + 4.0
        assert found.length(MOST_REVOLUTIONS) == pytest.approx(certain.length)
        assert 0.0 < found.scatter_of_length(MOST_REVOLUTIONS) < 3.0 + 2.0 * step


def test_weights_of_neighbours():
    """Straight lines to a reach of 30, 30, 60 and 60 rad/s, times the length nearest to each speed: 10, 15, 25 and 20."""
    speeds = np.array([0.0, 20.0, 30.0, 70.0])
    expected = [
        [10.0, 15.0 / 3.0, 0.0, 0.0],
        [10.0 / 3.0, 15.0, 50.0 / 3.0, 0.0],
        [5.0, 12.5, 25.0, 20.0 / 3.0],
        [0.0, 2.5, 25.0 / 3.0, 20.0],
    ]
    weights = Exceedance(speeds, np.full(4, 0.3), chance=True).weights
    np.testing.assert_allclose(weights, [np.array(row) / sum(row) for row in expected])
    np.testing.assert_allclose(Exceedance(speeds[:1], np.array([0.3]), chance=True).smoothed, [0.3])
    np.testing.assert_allclose(Exceedance(np.array([0.0, 5.0]), np.array([0.2, 0.5]), chance=True).smoothed, [0.3, 0.4])


def test_a_share_of_none_or_all_revolutions_is_smoothed_with_what_chance_may_give_alone():
    speeds = np.array([1000.0, 1005.0])
    for shares, smoothed in (
        ((0.0, 0.2), (0.2 / 3.0, 0.4 / 3.0)), ((0.0, 0.21), (0.0, 0.21)),
        ((1.0, 0.79), (1.0, 0.79)), ((0.01, 0.97), (0.33, 0.65)),
    ):  # fmt: skip
        np.testing.assert_allclose(Exceedance(speeds, np.array(shares), chance=True).smoothed, smoothed)
    # a motion that repeats itself, above yield from 1002.5 to 1057.5 and from 1072.5 to 1102.5 rad/s, is not so beyond that
    speeds = np.arange(900.0, 1301.0, 5.0)
    above = ((speeds > 1002.5) & (speeds < 1057.5)) | ((speeds > 1072.5) & (speeds < 1102.5))
    found = Exceedance(speeds, above.astype(float), chance=True)
    assert found.length(MOST_REVOLUTIONS) == pytest.approx(85.0)
    # a line between the speeds of a border is above a twentieth for 0.45 of 5 rad/s more
    assert found.length(SOME) == pytest.approx(85.0 + 4.0 * 0.45 * 5.0)
    # without chance, and with four borders of which each lies anywhere between two speeds
    for share in (MOST_REVOLUTIONS, SOME):
        assert np.std([length_of(ranges) for ranges in found.ranges_drawn(share)]) == 0.0
        assert found.scatter_of_length(share) == pytest.approx(np.sqrt(4.0 * 5.0**2 / 12.0))


@pytest.mark.parametrize("step", [2.0, 5.0, 15.0])
def test_shifted_speeds_find_a_length_within_two_standard_deviations(step):
    """One wide range, and forty peaks of 6 rad/s, on grids that lie anywhere; the scatter is no more than thrice what it is."""
    random = np.random.default_rng(1)
    peaks = random.uniform(0.0, 600.0, 40)
    for shares in (
        lambda speeds: (speeds > 103.0) & (speeds < 260.5),
        lambda speeds: np.abs(speeds[:, None] - peaks).min(axis=1) < 3.0,
    ):
        grids = [np.arange(0.0, 600.0, step) + shift for shift in random.uniform(0.0, step, 200)]
        found = [Exceedance(speeds, shares(speeds).astype(float), chance=False) for speeds in grids]
        lengths = np.array([each.length(MOST_REVOLUTIONS) for each in found])
        scatters = np.array([each.scatter_of_length(MOST_REVOLUTIONS) for each in found])
        again = random.permutation(200)
        inside = np.abs(lengths - lengths[again]) <= DEVIATIONS * np.hypot(scatters, scatters[again])
        assert inside.mean() > 0.95 and scatters.mean() < 3.0 * lengths.std()


def test_a_lined_blade_s_shares_are_taken_as_they_are():
    speeds = np.array([900.0, 901.0, 902.0, 903.0])
    found = Exceedance(speeds, np.array([0.0, 1.0, 1.0, 0.0]), chance=False)
    assert found.ranges(MOST_REVOLUTIONS) == [span(900.5, 902.5)]
    # two speeds alone may be a narrow peak's
    assert found.scatter_of_length(MOST_REVOLUTIONS) == pytest.approx(1.0)
    assert np.isnan(found.scatter_of_border(MOST_REVOLUTIONS, found.ranges(MOST_REVOLUTIONS)[0], begins=True))


def test_a_border_that_chance_makes_or_the_speeds_cut_has_no_scatter():
    """Beside a range that is always there, one that chance has made: its border is not that of the other one."""
    speeds = np.arange(900.0, 1400.1, 20.0)
    shares = np.where(speeds > 1200.0, 0.9, 0.01)
    shares[5] = 0.3
    found = Exceedance(speeds, shares, chance=True)
    small, large = found.ranges(SOME)
    assert not found.scatter_of_border(SOME, small, begins=True) > 60.0
    assert 0.0 < found.scatter_of_border(SOME, large, begins=True) < 30.0
    assert np.isnan(found.scatter_of_border(SOME, large, begins=False))
    from_the_first = Exceedance(speeds, shares[::-1], chance=True)
    assert np.isnan(from_the_first.scatter_of_border(SOME, from_the_first.ranges(SOME)[0], begins=True))


def response(speeds, shares, motion=None, *, lined=0, ever=None, status=None, tangential=None):
    shares, motion = np.asarray(shares), np.ones(len(speeds)) if motion is None else motion
    of_speed = {
        "status": np.zeros(len(speeds), int) if status is None else status,
        "rms_normal": np.asarray(motion, float),
        "rms_tangential": np.asarray(motion if tangential is None else tangential, float),
        "share_of_revolutions_above_yield": shares,
        "max_von_mises_median": 1e9 * (0.5 + shares),
        "max_von_mises_high": 1.1e9 * (0.5 + shares),
        "max_von_mises_ever": np.where(shares > 0.0, 1.2e9 * (0.85 + shares), 5e8) if ever is None else np.asarray(ever),
    }
    of_speed |= {"max_von_mises_inside": of_speed["max_von_mises_ever"], "exit_revolution": np.full(len(speeds), np.nan)}
    content = {name: ("speed", values) for name, values in of_speed.items()}
    return xr.Dataset(content | {"yield_stress": 1e9, "lined": float(lined)}, {"speed": speeds})


def test_a_row_of_direct_contact_is_a_range_and_has_no_mode():
    speeds = np.arange(900.0, 1401.0, 5.0)
    motion = 1e-3 * (1.0 + rising(speeds))
    found = find_interactions(response(speeds, drawn(rising(speeds), speeds), motion), None, CHOICE)
    (row,) = [one for one in found if one["length_most_revolutions_rad_s"] > 0.0]
    assert row["mode"] == "" and "not named" in row["note"]
    # the motion is halved, and no less, where the range ends
    nothing = ("campbell_speed_rad_s", "fall_speed_rad_s")
    assert np.isnan([row[name] for name in nothing]).all()
    assert row["most_revolutions_from_rad_s"] == pytest.approx(1050.0, abs=8.0)
    assert row["most_revolutions_to_rad_s"] == pytest.approx(1300.0, abs=5.0)
    assert row["dangerous_from_rad_s"] < row["most_revolutions_from_rad_s"]
    assert row["most_revolutions_to_rad_s"] < row["dangerous_to_rad_s"]
    assert row["largest_median_stress_pa"] == pytest.approx(1.5e9)
    assert row["peak_motion_m"] == pytest.approx(np.sqrt(2.0) * 2e-3)


def test_no_speed_above_yield_is_outside_of_a_row():
    """One speed alone of which few revolutions are above yield."""
    speeds = np.arange(900.0, 1401.0, 1.0)
    shares = drawn(rising(speeds), speeds)
    ever = 1e9 * (0.5 + shares)
    ever[40] = 1.1e9
    rows = rows_of(response(speeds, shares, ever=ever), [])
    for speed in speeds[ever > 1e9]:
        assert any(every["from_rad_s"] <= speed <= every["to_rad_s"] for every in rows), speed
    assert [every["length_most_revolutions_rad_s"] > 0.0 for every in rows] == [False] * (len(rows) - 1) + [True]


def test_the_motion_falls_where_it_stays_down():
    """Down at the next speed; and back up at most 24 rad/s, of which the range of chance is, above the first that is down."""
    speeds = np.arange(1000.0, 1101.0, 2.0)
    down, shares = np.where(speeds <= 1050.0, 1.0 + 1e-3 * speeds, 0.3), np.where(speeds < 1060.0, 1.0, 0.0)
    for loud, fall in ((), (1051.0, 1.0)), ((1054.0,), (1053.0, 3.0)), ((1076.0,), (1064.0, 14.0)), ((1078.0,), (1051.0, 1.0)):
        (row,) = rows_of(response(speeds, shares, np.where(np.isin(speeds, loud), 1.5, down)), [])
        assert (row["fall_speed_rad_s"], row["fall_speed_scatter_rad_s"]) == fall


def test_the_scatter_of_a_peak_is_its_distance_from_the_line_between_its_neighbours():
    """Here at uneven speeds; two have none between them."""
    speeds = np.array([1000.0, 1012.0, 1030.0])
    (few,) = rows_of(response(speeds, np.ones(3), np.array([1.0, 2.0, 4.0]) / np.sqrt(2.0)), [])
    share = (speeds[1] - speeds[0]) / (speeds[2] - speeds[0])
    assert few["peak_motion_scatter_m"] == pytest.approx(1.4826 / np.sqrt(1.5) * abs(1.0 - 3.0 * share))
    (two,) = rows_of(response(speeds[:2], np.ones(2)), [])
    assert np.isnan(two["peak_motion_scatter_m"])


def test_the_row_of_a_range_is_of_its_own_speeds_and_has_the_direction_of_its_peak():
    """Two ranges, the lower motion in the first; and a peak below yield, whose row is its speed."""
    speeds = np.arange(1000.0, 1101.0, 2.0)
    normal = 1e-3 * (1.0 + np.exp(-(((speeds - 1020.0) / 4.0) ** 2)) + 2.0 * np.exp(-(((speeds - 1080.0) / 4.0) ** 2)))
    shares = np.where(np.abs(speeds - 1020.0) <= 6.0, 1.0, np.where(np.abs(speeds - 1080.0) <= 6.0, 1.0, 0.0))
    aside = np.roll(normal, 1)
    for tangential, direction in ((normal, "both"), (0.1 * aside, "normal")):
        rows = rows_of(response(speeds, shares, normal, tangential=tangential), [])
        assert [row["peak_speed_rad_s"] for row in rows] == [1020.0, 1080.0]
        assert [row["direction"] for row in rows] == [direction, direction]
    (row, _) = rows_of(response(speeds, shares, 0.1 * aside, tangential=normal), [])
    assert row["direction"] == "tangential"
    # neither direction has its own peak where both together have theirs
    to_and_fro = [1e-3 * np.exp(-(((speeds - peak) / 4.0) ** 2)) for peak in (1018.0, 1022.0)]
    (row,) = rows_of(response(speeds, np.abs(speeds - 1020.0) <= 6.0, to_and_fro[0], tangential=to_and_fro[1]), [])
    assert (row["peak_speed_rad_s"], row["direction"]) == (1020.0, "both")
    below = find_interactions(response(speeds, np.zeros(len(speeds)), normal), None, CHOICE)
    assert [row["peak_speed_rad_s"] for row in below] == [1020.0, 1080.0]
    assert below[1]["fall_speed_rad_s"] == 1085.0
    assert all(np.isnan(row["from_rad_s"]) for row in below)


def test_a_lined_row_has_all_lengths():
    """All revolutions are above yield at three speeds, some of them at five, which are dangerous."""
    speeds = np.arange(1000.0, 1011.0)
    ever, every = np.abs(speeds - 1005.0) <= 2.0, np.abs(speeds - 1005.0) <= 1.0
    motion = 1e-3 * np.exp(-(((speeds - 1005.0) / 2.0) ** 2))
    shares = np.where(every, 1.0, np.where(ever, 0.2, 0.0))
    lined = response(speeds, shares, motion, lined=1, ever=np.where(ever, 2e9, 0.0))
    (row,) = find_interactions(lined, campbell(), CHOICE)
    assert (row["mode"], row["engine_order"], row["note"]) == ("", None, "")
    assert (row["length_dangerous_rad_s"], row["length_unknown_rad_s"]) == pytest.approx((4.0 + 2.0 * 0.5, 0.0))
    assert (row["largest_stress_over_yield"], row["share_of_revolutions_above_yield"]) == (2.0, 1.0)
    assert row["length_most_revolutions_rad_s"] == pytest.approx(2.0 + 2.0 * 0.5 / 0.8)


def test_a_lined_blade_that_is_above_yield_without_a_peak_has_a_row():
    """Everywhere above yield while the motion only rises; a peak elsewhere has the row that it had."""
    speeds = np.arange(1000.0, 1011.0)
    rising_motion = response(speeds, np.ones(11), 1e-3 * speeds, lined=1)
    (row,) = find_interactions(rising_motion, campbell(), CHOICE)
    keys = ("from_rad_s", "to_rad_s", "length_most_revolutions_rad_s")
    assert [row[key] for key in keys] == [1000.0, 1010.0, 10.0]
    assert "without a peak" in row["note"]


def test_robustness_counts_diverged_runs_as_above_yield():
    """Also where all diverge, and there is no motion."""
    status = np.where(SPEEDS == 950.0, RunStatus.DIVERGED, RunStatus.COMPLETED)
    shares = np.where(status == RunStatus.DIVERGED, np.nan, 0.0)
    one = response(SPEEDS, shares, lined=1, status=status)
    assert exceedance_of(one).shares.max() == 1.0
    found = robustness(one)
    assert set(found) == set(names(ROBUSTNESS))
    expected = {"length_most_revolutions_rad_s": 10.0, "largest_gap_rad_s": 10.0, "ranges_dangerous": 1}
    expected |= {"length_dangerous_rad_s": 10.0, "widest_range_rad_s": 10.0, "widest_range_from_rad_s": 945.0}
    assert expected.items() <= found.items()
    assert robustness(response(SPEEDS, np.zeros(11), lined=1))["widest_range_rad_s"] == 0.0
    nothing = np.full(len(SPEEDS), np.nan)
    every = response(SPEEDS, nothing, nothing, status=np.full(len(SPEEDS), RunStatus.DIVERGED))
    (row,) = find_interactions(every, None, CHOICE)
    assert row["status"] == "diverged" and row["engine_order"] is None
    assert np.isnan([row["peak_motion_m"], row["peak_motion_scatter_m"]]).all()
    found = robustness(every)
    assert (found["length_most_revolutions_rad_s"], found["diverged_runs"]) == (100.0, 11)
    assert np.isnan(found["largest_rms_m"])


def of(dangerous, unknown=0.0, stress=1e9):
    values = {"length_dangerous_rad_s": dangerous, "length_unknown_rad_s": unknown, "length_most_revolutions_rad_s": 0.0}
    values |= {"largest_stress_inside_pa": stress, "length_dangerous_within_rad_s": 0.0}
    return dict.fromkeys(names(ROBUSTNESS), np.nan) | values


def test_the_ranking_goes_scene_by_scene_with_ties_where_brackets_overlap():
    lined = {("A", "x"): of(5.0), ("B", "x"): of(1.0, 3.0), ("C", "x"): of(0.5, 0.2)}
    table = ranking_table(lined | {("A", "y"): of(0.0), ("B", "y"): of(np.nan)})
    assert list(table.columns[:7]) == ["blade", "scene", "rank", "rank_lowest", "rank_highest", "contact", ROBUSTNESS[0].name]
    assert list(zip(table["scene"], table["blade"], table["rank"], strict=True)) == [
        ("x", "C", 1), ("x", "B", 2), ("x", "A", 3), ("y", "A", 1), ("y", "B", pd.NA),
    ]  # fmt: skip


def test_blades_that_cannot_be_told_apart_share_a_rank():
    """Lengths within 14.1 of each other, each known within 10; brackets that overlap.

    Where the error of a level is not known, nor what a length is known within, nothing is told apart.
    """
    step = {"length_dangerous_within_rad_s": 10.0}
    lengths = {"S100": 10.0, "S50": 14.0, "CS100": 11.0, "Ref": 16.0, "L50": 24.5, "L100": 55.0}
    table = ranking_table({(blade, "x"): of(length) | step for blade, length in lengths.items()}).set_index("blade")
    ranks = table[["rank", "rank_lowest", "rank_highest"]]
    assert ranks.loc[["S100", "CS100", "S50", "Ref"]].values.tolist() == [[1, 1, 4], [1, 1, 5], [1, 1, 5], [1, 1, 5]]
    assert ranks.loc[["L50", "L100"]].values.tolist() == [[5, 2, 5], [6, 6, 6]]
    bare = response(SPEEDS, (SPEEDS > 945.0).astype(float), lined=1)
    unknown = robustness(bare, error=np.nan)
    assert ranking_table({("A", "x"): unknown, ("B", "x"): of(900.0)})["rank"].tolist() == [1, 1]
    none = ranking_table(
        {(name, "x"): of(low, more) | step for name, low, more in (("A", 45.0, 0.0), ("B", 0.0, 40.0), ("C", 0.0, 5.0))}
    )
    assert none[["blade", "rank", "rank_highest"]].values.tolist() == [["C", 1, 2], ["B", 1, 3], ["A", 3, 3]]
    assert ranks_of(pd.DataFrame([of(0.0, stress=9e8), of(0.0, stress=1e8)]))["rank"].tolist() == [1, 1]


def test_a_length_is_known_within_the_distance_of_speeds_and_the_error_of_the_level():
    stress = 1e9 + 1e7 * (50.0 - np.abs(SPEEDS - 950.0)) - 3e8
    one = response(SPEEDS, (stress > 1e9).astype(float), lined=1)
    one["max_von_mises_inside"][:] = stress
    known = [robustness(one, error=error)["length_dangerous_within_rad_s"] for error in (0.0, 0.05)]
    # yield is reached 20 rad/s off the peak, a stress larger by 5% there 24.76 rad/s off it
    expected = 2.0 * (30.0 - (1e9 / 1e7 * (1.0 - 1.0 / 1.05)) - 30.0)
    assert known == pytest.approx([10.0, np.hypot(10.0, max(abs(expected), 2.0 * 5.0))])


def test_blades_of_unlike_contact_have_ranks_of_their_own():
    lined = {("A", "x"): of(5.0), ("Mine", "x"): of(1.0), ("B", "x"): of(3.0)}
    members = {pair: {"0": of(1.0)} for pair in lined}
    table = ranking_table(lined, members, {"A": "8 points", "B": "8 points", "Mine": "12 patches"})
    assert table[["blade", "rank", "contact"]].values.tolist() == [
        ["B", 1, "8 points"], ["A", 2, "8 points"], ["Mine", 1, "12 patches"],
    ]  # fmt: skip
    assert not {"chance_better_than_Mine", "rank_over_scenes"} & set(table)


def test_one_order_over_all_scenes_is_by_the_longest_length():
    """Lengths that cannot be told apart share a rank; who has no length in one of the scenes has none."""
    scattering = {"length_dangerous_within_rad_s": 8.0}
    found = {("A", "x"): of(60.0), ("B", "x"): of(2.0), ("C", "x"): of(1.0), ("D", "x"): of(3.0)}
    found |= {("A", "y"): of(10.0), ("B", "y"): of(70.0) | scattering}
    found |= {("C", "y"): of(80.0) | scattering, ("D", "y"): of(np.nan)}
    table = ranking_table(found).set_index(["blade", "scene"])
    for scene in ("x", "y"):
        rows = table.loc[[(blade, scene) for blade in "ABC"]]
        assert rows["rank_over_scenes"].tolist() == [1, 2, 2]
        assert rows["worst_rank"].tolist() == [4, 2, 2]
        assert rows["length_over_scenes_rad_s"].tolist() == [70.0, 72.0, 81.0]
    assert table.loc["D", names(OVER_SCENES)].isna().all(axis=None)


def test_the_chance_to_be_better_is_of_common_members():
    members = {
        ("A", "x"): {"0": of(1.0), "1": of(2.0), "2": of(3.0), "3": of(9.0)},
        ("B", "x"): {"0": of(2.0), "1": of(1.0), "2": of(3.0), "9": of(0.0)},
    }
    a, b = members["A", "x"], members["B", "x"]
    assert chance_to_be_better(a, b) == chance_to_be_better(b, a) == 0.5
    assert np.isnan(chance_to_be_better(a, {"9": of(0.0)}))
    table = ranking_table({pair: of(2.0) for pair in members}, members).set_index("blade")
    assert table.loc["A", "chance_better_than_B"] == 0.5
    assert np.isnan(table.loc["A", "chance_better_than_A"])
    ends = ["length_dangerous_rad_s_low", "length_dangerous_rad_s_high", "members"]
    assert table.loc["A", ends].tolist() == [1.0, 9.0, 4]


def test_lengths_of_dangerous_speeds_and_lasting():
    """Above yield from 940 to 980 rad/s, at 970 and 980 without lasting; in some revolution at one speed more on both sides."""
    above = (SPEEDS >= 940.0) & (SPEEDS <= 980.0)
    lined = response(SPEEDS, above.astype(float), lined=1)
    lined["max_von_mises_inside"][:] = np.where((SPEEDS >= 930.0) & (SPEEDS <= 990.0), 2.0, 0.0) * float(lined["yield_stress"])
    lengths = robustness(lined)
    assert (lengths["length_most_revolutions_rad_s"], lengths["length_dangerous_rad_s"]) == (50.0, 70.0)
    assert np.isnan(lengths["length_lasting_rad_s"])
    states = np.where(above, MotionAtEnd.LASTING, MotionAtEnd.QUIET)

    def lasting():
        return robustness(lined.assign(motion_at_end=("speed", states)))["length_lasting_rad_s"]

    assert lasting() == 50.0
    states[SPEEDS == 940.0] = MotionAtEnd.GROWING
    states[SPEEDS >= 970.0] = MotionAtEnd.CUT_FREE
    assert lasting() == 30.0
    # a run that diverged is worse than one that lasts
    states[SPEEDS >= 970.0] = MotionAtEnd.UNKNOWN
    assert lasting() == 50.0


def test_the_integral_counts_every_share_and_has_no_threshold():
    """Three speeds, 10 rad/s apart, bare or lined; chance moves the integral in a bare casing alone."""
    shares = np.zeros(11)
    shares[4:7] = 0.3, 0.45, 0.35
    lined = robustness(response(SPEEDS, shares, lined=1))
    assert lined["exceedance_integral_rad_s"] == pytest.approx(11.0)
    assert np.isnan(lined["exceedance_integral_scatter_rad_s"])
    bare = robustness(response(SPEEDS, shares, lined=0))
    assert bare["exceedance_integral_rad_s"] == pytest.approx(11.0)
    assert bare["exceedance_integral_scatter_rad_s"] > 0.0
