"""Numbers read off a response, inside the operating range, too, and printed with the digits that their scatter bears."""

import math

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from test_exceedance import response as response_above_yield

from r37core.base.rounding import rounded_to, rounded_up
from r37core.base.units import RPM
from r37core.config.config_file import OperatingSection
from r37core.config.declaring import si
from r37core.figures import style
from r37core.results import measures
from r37core.results.columns import OPERATING, ROBUSTNESS, names
from r37core.results.danger import largest_of, ratio_inside, ratio_to_yield
from r37core.results.operating_range import OperatingDwell, OperatingRange
from r37core.results.ranking import operating_measures, ranking_table
from r37core.time_integration.status import RunStatus

SPEEDS = 1000.0 + 2.0 * np.arange(8)


def response(normal, tangential=None, stress=None, speeds=SPEEDS, **more):
    """One blade and scene; both tip points, of which the trailing edge moves a hundred times as much."""
    normal = np.asarray(normal, dtype=float)
    tips = {"rms_normal": normal, "rms_tangential": 0.0 * normal if tangential is None else np.asarray(tangential)}
    data = {name: (("speed", "tip_point"), np.stack([values, 100.0 * values[::-1]], axis=1)) for name, values in tips.items()}
    if stress is not None:
        stresses = {f"max_von_mises_{name}": ("speed", np.asarray(stress, dtype=float)) for name in ("ever", "inside")}
        data |= stresses | {"exit_revolution": ("speed", np.full(len(normal), np.nan)), "yield_stress": ((), 2.0)}
    status = np.zeros(len(normal), dtype="i1")
    coords = {"speed": speeds[: len(normal)], "tip_point": ["leading_edge", "trailing_edge"]}
    return xr.Dataset(data | {"status": ("speed", status)} | more, coords)


def test_motion_of_the_leading_edge_its_peak_and_its_drop():
    """Of both directions; a peak answers and is not where the speeds begin; a drop is to the lowest motion within reach."""
    data = response([3.0, np.nan, 0.0], [4.0, np.nan, 2.0])
    np.testing.assert_array_equal(measures.motion(data), [5.0, 0.0, 2.0])
    np.testing.assert_array_equal(measures.motion(data.sel(tip_point="leading_edge")), [5.0, 0.0, 2.0])
    assert float(measures.peak_of(data)["speed"]) == 1000.0
    assert measures.peak_speed(response([1e-5, 9e-3, 1e-5])) == 1002.0
    assert np.isnan(measures.peak_speed(response([1e-5, 1e-3, 1e-5])))
    assert np.isnan(measures.peak_speed(response([9e-3, 1e-3, 1e-5])))
    speeds = 1000.0 + 12.0 * np.arange(5)
    assert measures.drop_after(response([1.0, 4.0, 1.0, 3.0, 0.1], speeds=speeds)) == pytest.approx(0.75)
    assert np.isnan(measures.drop_after(response([1.0, 4.0])))
    # from a lower peak before the largest motion
    assert measures.drop_after(response([1.0, 4.0, 2.0, 5.0, 3.0], speeds=speeds), 1) == pytest.approx(0.5)


def test_the_strongest_order_is_no_offset_and_no_casing():
    orders = [0.0, 0.48, 0.5, 2.0, 4.02, 8.0]
    amplitude = xr.DataArray([9.0, 8.0, 1.0, 5.0, 3.0, np.nan], {"engine_order": orders})
    assert measures.strongest_order(amplitude) == 2.0
    assert measures.strongest_order(amplitude[:3]) == 0.5


def test_a_response_is_above_yield_where_it_diverged_and_nowhere_unrun():
    data = response(np.zeros(6), stress=[1.0, 3.0, np.nan, np.nan, 3.0, 1.0])
    data["status"][2:4] = [int(RunStatus.DIVERGED), int(RunStatus.NOT_RUN)]
    for ratio in (ratio_inside(data), ratio_to_yield(data, "max_von_mises_ever")):
        np.testing.assert_array_equal(ratio, [0.5, 1.5, np.inf, 1.5, 0.5])
    # one that had left the model before it diverged says no more of what is inside; the benchmark's stress counts in any case
    data["exit_revolution"][2], data["max_von_mises_inside"][2] = 5.0, 1.2
    np.testing.assert_array_equal(ratio_inside(data), [0.5, 1.5, 0.6, 1.5, 0.5])
    np.testing.assert_array_equal(ratio_to_yield(data, "max_von_mises_ever"), [0.5, 1.5, np.inf, 1.5, 0.5])


def test_the_largest_stress_and_the_first_yield_of_a_run():
    """Of all speeds; the first revolution has the largest, and the end of the run is missing."""
    names = ("largest_stress_pa", "largest_stress_speed_rad_s", "largest_stress_over_yield")
    for stress, expected in (([1.0, np.nan, 3.0], (3.0, 1004.0, 1.5)), ([np.nan, np.nan], (np.nan,) * 3)):
        found = largest_of(response(np.zeros(len(stress)), stress=stress))
        assert [found[name] for name in names] == pytest.approx(expected, nan_ok=True)
    history = np.array([9.0, 3.0, np.nan, np.nan])
    assert measures.first_yield(history, 8.9) == 1.0
    assert measures.first_yield(history[1:], 2.0) == 1.0
    assert np.isnan(measures.first_yield(history, 9.0))


def test_the_integral_inside_is_that_of_straight_lines():
    """A triangle from 1000 over 1100 to 1200 rad/s, of which the range has 1050 to 1150: 75 of 100 rad/s."""
    speeds, shares = np.array([900.0, 1000.0, 1100.0, 1200.0, 1300.0]), np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    assert OperatingRange(1050.0, 1150.0).integral(speeds, shares) == pytest.approx(75.0)
    # a margin is judged, but no time is spent there
    assert OperatingRange(1050.0, 1150.0, 0.05).integral(speeds, shares) == pytest.approx(75.0)
    # a margin that is rounded is covered
    for redline in np.arange(500.0, 2001.0, 10.0):
        for percent in (1, 2, 3, 5, 10):
            whole = OperatingRange(400.0, redline, percent / 100.0)
            assert whole.is_covered(np.array([1.0, round(redline * (100 + percent)) / 100.0]))
    assert not OperatingRange(400.0, 500.0).is_covered(np.array([1.0, 499.9]))


def test_dwells_weigh_and_the_rest_is_even():
    """Above yield at 1100 to 1120 alone: 60% of the time are spent there, and a fifth of the rest, of 100 rad/s."""
    speeds = np.array([1000.0, 1100.0 - 1e-9, 1100.0, 1120.0, 1120.0 + 1e-9, 1300.0])
    shares = np.array([0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
    dwell = OperatingRange(1050.0, 1150.0, dwell=(OperatingDwell(1100.0, 1120.0, 0.6),))
    assert dwell.integral(speeds, shares) == pytest.approx(100.0 * (0.6 + 0.4 * 0.2), rel=1e-6)
    assert dwell.integral(speeds, np.ones(len(speeds))) == pytest.approx(100.0)


def test_measures_inside():
    speeds = np.arange(1000.0, 1301.0, 10.0)
    shares = ((speeds >= 1100.0) & (speeds <= 1200.0)).astype(float)
    inside = operating_measures(response_above_yield(speeds, shares, lined=1), OperatingRange(1000.0, 1150.0))
    # from 1095, half of the way between two speeds
    assert inside["length_most_revolutions_operating_rad_s"] == pytest.approx(55.0)
    assert inside["exceedance_integral_operating_rad_s"] == pytest.approx(55.0)
    assert np.isnan(inside["exceedance_integral_operating_scatter_rad_s"])
    bare = operating_measures(response_above_yield(speeds, 0.5 * shares + 0.1), OperatingRange(1000.0, 1150.0))
    assert bare["exceedance_integral_operating_scatter_rad_s"] > 0.0


def test_what_is_not_run_over_the_whole_range_is_not_known():
    speeds = np.arange(1000.0, 1301.0, 10.0)
    measures = operating_measures(response_above_yield(speeds, np.ones(len(speeds)), lined=1), OperatingRange(990.0, 1150.0))
    assert set(measures) == set(names(OPERATING))
    assert np.isnan(list(measures.values())).all()


def test_the_ranking_inside_stands_next_to_that_over_all_speeds():
    def of(length, inside):
        own = dict.fromkeys(names(ROBUSTNESS), 0.0) | {"length_most_revolutions_rad_s": length, "diverged_runs": 0.0}
        return own | {"length_most_revolutions_operating_rad_s": inside, "exceedance_integral_operating_rad_s": inside}

    table = ranking_table({("A", "x"): of(1.0, 9.0), ("B", "x"): of(5.0, 2.0), ("C", "x"): of(3.0, np.nan)})
    assert table["blade"].tolist() == ["A", "C", "B"]
    ranks = table.set_index("blade")["rank_operating"]
    assert ranks[["A", "B"]].tolist() == [2, 1]
    assert ranks.isna()["C"]


def test_both_units_give_the_same_range():
    rad = si(OperatingSection.model_validate({"idle_rad_s": 1000.0, "redline_rad_s": 1500.0, "margin_percent": 2.0}))
    rpm = OperatingSection.model_validate({"idle_rpm": 1000.0 * RPM, "redline_rpm": 1500.0 * RPM, "margin_percent": 2.0})
    assert (rad.first, rad.last) == (980.0, 1530.0)
    assert si(rpm).idle == pytest.approx(1000.0)


def test_axes_of_speed_alone_are_shaded_and_keep_their_limits():
    figure, (above, below, other) = plt.subplots(3, 1)
    above.sharex(below)
    below.plot([1100.0, 1200.0], [0.0, 1.0])
    below.set_xlabel(style.SPEED_LABEL)
    before = {axes: (axes.get_xlim(), len(axes.patches)) for axes in (above, below, other)}
    style.mark_operating(figure, OperatingRange(1000.0, 1150.0))
    assert [axes.get_xlim() for axes in before] == [limits for limits, _ in before.values()]
    assert [len(axes.patches) for axes in before] == [1, 1, 0]


@pytest.mark.parametrize(
    ("value", "spread", "text"),
    [
        (1727.0, 30.0, "1730"),
        (8.6412, 12.1, "9"),
        (-0.04, 1.0, "0.0"),
        (-1725.0, 44.0, "-1730"),
        (8.25, 0.4, "8.3"),
        (np.float64(1640.0), 0.0, "1640"),
        (1640.123456, math.nan, "1640.12"),
        (math.inf, 3.0, "inf"),
        (math.nan, 3.0, ""),
    ],
)
def test_digits_that_the_spread_bears(value, spread, text):
    assert rounded_to(value, spread) == text


def test_rounding_moves_a_number_by_at_most_a_sixth_of_its_spread_and_keeps_no_digit_more():
    random = np.random.default_rng(0)
    for value, spread in zip(random.uniform(-1e4, 1e4, 500), 10.0 ** random.uniform(-3.0, 3.5, 500), strict=True):
        text = rounded_to(value, spread)
        assert abs(float(text) - value) <= spread / 6.0 * (1.0 + 1e-9)
        # a multiple of the longest digit that is allowed
        in_digits = float(text) / 10.0 ** math.floor(math.log10(spread / 3.0))
        assert math.isclose(in_digits, round(in_digits), abs_tol=1e-6)


@pytest.mark.parametrize(("value", "text"), [(0.23401, "0.235"), (0.234, "0.234"), (1234.0, "1240"), (5.0, "5"), (9.991, "10")])
def test_a_lower_bound_is_never_rounded_below_itself(value, text):
    assert rounded_up(value) == text and float(text) >= value
