"""Each number that the evidence alone reads off a response, against a closed form."""

import numpy as np
import pytest
import xarray as xr
from evidence import benchmark_measures as measures
from test_measures import response


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


def test_lobes_and_first_contact():
    harmonics = np.zeros((2, 16))
    harmonics[:, 2], harmonics[:, 13] = 9.0, 9.0
    harmonics[0, 4], harmonics[1, 12] = 1.0, 2.0
    lobes = {"wear_harmonic": (("speed", "lobes"), harmonics)}
    worn = xr.Dataset(lobes, {"lobes": np.arange(16)})
    assert [measures.strongest_lobes(worn.isel(speed=index)) for index in range(2)] == [4.0, 12.0]
    touched = np.array([[[-1.0, 0.0], [0.0, 1e-9], [1.0, 1.0]], np.full((3, 2), -1.0)])
    data = xr.Dataset({"revolution_maximum": (("speed", "revolution", "tip_point"), touched)})
    np.testing.assert_array_equal(measures.first_contact(data), [2.0, np.nan])


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


def test_a_history_is_that_of_a_speed():
    history = np.array([9.0, 3.0, np.nan, np.nan])
    kept = xr.Dataset({"max_von_mises_history": (("history_speed", "revolution"), [history])}, {"history_speed": [1200.0]})
    np.testing.assert_array_equal(measures.history_of(kept, 1200.0), history)
