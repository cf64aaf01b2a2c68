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


def test_the_strongest_order_is_no_offset_and_no_casing():
    orders = [0.0, 0.48, 0.5, 2.0, 4.02, 8.0]
    amplitude = xr.DataArray([9.0, 8.0, 1.0, 5.0, 3.0, np.nan], {"engine_order": orders})
    assert measures.strongest_order(amplitude) == 2.0
    assert measures.strongest_order(amplitude, above=2.5) == 4.02
    assert measures.strongest_order(amplitude[:3]) == 0.5


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
