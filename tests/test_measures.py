"""Each number that is read off a response, against a closed form."""

import numpy as np
import pytest
import xarray as xr

from r37core.results import measures
from r37core.time_integration.status import RunStatus

SPEEDS = 1000.0 + 2.0 * np.arange(8)


def response(normal, tangential=None, stress=None, speeds=SPEEDS, **more):
    """One blade and scene; both tip points, of which the trailing edge moves a hundred times as much."""
    normal = np.asarray(normal, dtype=float)
    tips = {"rms_normal": normal, "rms_tangential": 0.0 * normal if tangential is None else np.asarray(tangential)}
    data = {name: (("speed", "tip_point"), np.stack([values, 100.0 * values[::-1]], axis=1)) for name, values in tips.items()}
    if stress is not None:
        data |= {"max_von_mises": ("speed", np.asarray(stress, dtype=float)), "yield_stress": ((), 2.0)}
    status = np.zeros(len(normal), dtype="i1")
    coords = {"speed": speeds[: len(normal)], "tip_point": ["leading_edge", "trailing_edge"]}
    return xr.Dataset(data | {"status": ("speed", status)} | more, coords)


def test_motion_is_that_of_the_leading_edge_in_both_directions():
    data = response([3.0, np.nan, 0.0], [4.0, np.nan, 2.0])
    np.testing.assert_array_equal(measures.motion(data), [5.0, 0.0, 2.0])
    np.testing.assert_array_equal(measures.motion(data.sel(tip_point="leading_edge")), [5.0, 0.0, 2.0])
    assert float(measures.peak_of(data)["speed"]) == 1000.0


def test_a_peak_answers_and_is_not_where_the_speeds_begin():
    assert measures.peak_speed(response([1e-5, 9e-3, 1e-5])) == 1002.0
    assert np.isnan(measures.peak_speed(response([1e-5, 1e-3, 1e-5])))
    assert np.isnan(measures.peak_speed(response([9e-3, 1e-3, 1e-5])))


def test_a_drop_is_to_the_lowest_motion_within_reach():
    speeds = 1000.0 + 12.0 * np.arange(5)
    assert measures.drop_after(response([1.0, 4.0, 1.0, 3.0, 0.1], speeds=speeds)) == pytest.approx(0.75)
    assert np.isnan(measures.drop_after(response([1.0, 4.0])))
    # from a lower peak before the largest motion
    assert measures.drop_after(response([1.0, 4.0, 2.0, 5.0, 3.0], speeds=speeds), 1) == pytest.approx(0.5)


def test_the_steepest_fall_is_a_share_of_the_speed_before_it():
    assert measures.steepest_fall(response([8.0, 4.0, 5.0, 1.0, 0.9])) == (1004.0, pytest.approx(0.8))
    assert measures.steepest_fall(response([0.0, 0.0, 2.0, 1.0])) == (1004.0, pytest.approx(0.5))


def test_stretches_above_a_floor_are_counted():
    assert measures.interactions_above(response([2.0, 0.0, 3.0, np.nan, 0.5, 2.0]), 1.0) == 3


def test_the_median_counts_lengths_of_the_range():
    speeds = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 24.0, 44.0])
    data = response([9.0, 9.0, 9.0, 9.0, 1.0, 2.0, 3.0], speeds=speeds)
    assert measures.median_over_speed(data, "rms_normal") == 2.0
    data["rms_normal"][5] = np.nan
    assert measures.median_over_speed(data, "rms_normal") == 3.0


def test_the_strongest_order_is_no_offset_and_no_casing():
    orders = [0.0, 0.48, 0.5, 2.0, 4.02, 8.0]
    amplitude = xr.DataArray([9.0, 8.0, 1.0, 5.0, 3.0, np.nan], {"engine_order": orders})
    assert measures.strongest_order(amplitude) == 2.0
    assert measures.strongest_order(amplitude, above=2.5) == 4.02
    assert measures.strongest_order(amplitude[:3]) == 0.5


def test_lobes_and_first_contact():
    harmonics = np.zeros((2, 16))
    harmonics[:, 2], harmonics[:, 13] = 9.0, 9.0
    harmonics[0, 4], harmonics[1, 12] = 1.0, 2.0
    lobes = {"wear_harmonic": (("speed", "lobes"), harmonics)}
    np.testing.assert_array_equal(measures.strongest_lobes(xr.Dataset(lobes, {"lobes": np.arange(16)})), [4.0, 12.0])
    touched = np.array([[[-1.0, 0.0], [0.0, 1e-9], [1.0, 1.0]], np.full((3, 2), -1.0)])
    data = xr.Dataset({"revolution_maximum": (("speed", "revolution", "tip_point"), touched)})
    np.testing.assert_array_equal(measures.first_contact(data), [2.0, np.nan])


@pytest.mark.parametrize(
    ("ratio", "first", "last", "length", "cut"),
    [
        ([0.5, 1.5, 1.5, 0.5], 105.0, 125.0, 20.0, False),
        ([2.0, 2.0, 2.0, 2.0], 100.0, 130.0, 30.0, True),
        ([1.0, 2.0, 1.0, 0.5], 100.0, 120.0, 20.0, False),
        ([0.5, 1.0, 0.9, 0.1], np.nan, np.nan, 0.0, False),
        # a speed below yield in between: the range goes on, its share is less
        ([0.5, 1.5, 0.5, 1.5, 0.5], 105.0, 135.0, 20.0, False),
        ([0.0, 3.0, 0.0], 100.0 + 10.0 * 2.0 / 3.0 - 10.0 / 3.0, 110.0 + 20.0 / 3.0, 40.0 / 3.0, False),
        # a run that diverged is above, and nothing is known of the way there
        ([0.5, np.inf, np.inf, 0.5], 110.0, 120.0, 10.0, False),
        ([0.5, np.inf, 0.5], 110.0, 110.0, 0.0, False),
        ([], np.nan, np.nan, np.nan, False),
    ],
)
def test_the_range_above_yield_is_that_of_straight_lines(ratio, first, last, length, cut):
    found = measures.range_above_yield(100.0 + 10.0 * np.arange(len(ratio)), np.array(ratio))
    assert (found.first, found.last, found.length) == pytest.approx((first, last, length), nan_ok=True)
    assert found.truncated == cut
    width = 0.0 if np.isnan(first) else last - first
    assert found.width == pytest.approx(width)
    assert found.share == pytest.approx(length / width if width else np.nan, nan_ok=True)


def test_a_response_is_above_yield_where_it_diverged_and_nowhere_unrun():
    data = response(np.zeros(6), stress=[1.0, 3.0, np.nan, np.nan, 3.0, 1.0])
    data["status"][2:4] = [int(RunStatus.DIVERGED), int(RunStatus.NOT_RUN)]
    np.testing.assert_array_equal(measures.ratio_to_yield(data), [0.5, 1.5, np.inf, 1.5, 0.5])
    found = measures.speeds_above_yield(data)
    assert (found.first, found.last) == (1001.0, 1009.0)
    assert measures.width_above_yield(data) == 8.0
    assert np.isnan(measures.width_above_yield(data.isel(speed=slice(1, None))))
    assert measures.width_above_yield(data.isel(speed=slice(5, None))) == 0.0


def test_the_largest_stress_is_of_all_speeds():
    assert measures.largest_stress(response(np.zeros(3), stress=[1.0, np.nan, 3.0])) == (3.0, 1004.0)
    assert np.isnan(measures.largest_stress(response(np.zeros(2), stress=[np.nan, np.nan]))).all()


def test_stress_of_a_run():
    """The first revolution has the largest, and the end of the run is missing."""
    history = np.array([9.0, 3.0, np.nan, np.nan])
    assert measures.first_yield(history, 8.9) == 1.0
    assert measures.first_yield(history[1:], 2.0) == 1.0
    assert np.isnan(measures.first_yield(history, 9.0))
    kept = xr.Dataset({"max_von_mises_history": (("history_speed", "revolution"), [history])}, {"history_speed": [1200.0]})
    np.testing.assert_array_equal(measures.history_of(kept, 1200.0), history)


def test_one_history_overtakes_another_for_good():
    theirs = np.ones(12)
    ours = np.array([0.0, 2.0, 2.0, 0.0, 2.0, 2.0, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0])
    assert measures.overtakes(ours, theirs) == 5.0
    assert np.isnan(measures.overtakes(ours[:8], theirs[:8]))


def test_the_slope_of_a_clearance_is_that_at_rest():
    x = np.linspace(-1e-3, 1e-3, 41)
    campbell = xr.Dataset(
        {"dynamic_clearance": (("mode", "tangential_displacement"), [-0.2 * x + 50.0 * x**2])},
        {"mode": ["1B"], "tangential_displacement": x},
    )
    assert measures.slope_of_clearance(campbell, "1B") == pytest.approx(0.2)


def test_speeds_without_a_number_have_no_length_in_the_median():
    """Many of them, whose lengths would count together."""
    speeds = np.arange(60.0)
    values = np.full(60, np.nan)
    values[:4] = [1.0, 2.0, 3.0, 4.0]
    assert measures.median_over_speed(response(values, speeds=speeds), "rms_normal") == 2.0
