"""The operating range: what lies inside, weighted by dwells, and where it is shaded."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from pydantic import ValidationError

from r37core.base.units import RPM
from r37core.config.config_file import OperatingSection
from r37core.figures import style
from r37core.results.columns import OPERATING, ROBUSTNESS, names
from r37core.results.operating_range import OperatingDwell, OperatingRange
from r37core.results.ranking import operating_measures, ranking_table


def response(speeds, shares, lined=1.0):
    content = {"share_of_revolutions_above_yield": ("speed", shares), "status": ("speed", np.zeros(len(speeds), int))}
    return xr.Dataset(content | {"lined": lined}, {"speed": speeds})


def test_the_integral_inside_is_that_of_straight_lines():
    """A triangle from 1000 over 1100 to 1200 rad/s, of which the range has the part from 1050 to 1150: 75 of 100 rad/s."""
    speeds, shares = np.array([900.0, 1000.0, 1100.0, 1200.0, 1300.0]), np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    assert OperatingRange(1050.0, 1150.0).integral(speeds, shares) == pytest.approx(75.0)
    # a margin is judged, but no time is spent there
    assert OperatingRange(1050.0, 1150.0, 0.05).integral(speeds, shares) == pytest.approx(75.0)
    assert OperatingRange(1000.0, 1500.0, 0.1).time_share(1500.0, 1650.0) == 0.0


def test_a_margin_that_is_rounded_is_covered():
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
    assert dwell.time_share(1100.0, 1120.0) == pytest.approx(0.68)
    assert dwell.time_share(1050.0, 1150.0) == pytest.approx(1.0)
    assert OperatingRange(1050.0, 1150.0).time_share(1050.0, 1060.0) == pytest.approx(0.1)


def test_measures_inside():
    speeds = np.arange(1000.0, 1301.0, 10.0)
    shares = ((speeds >= 1100.0) & (speeds <= 1200.0)).astype(float)
    inside = operating_measures(response(speeds, shares), OperatingRange(1000.0, 1150.0))
    # from 1095, half of the way between two speeds
    assert inside["length_certain_operating_rad_s"] == pytest.approx(55.0)
    assert inside["exceedance_integral_operating_rad_s"] == pytest.approx(55.0)
    assert np.isnan(inside["exceedance_integral_operating_scatter_rad_s"])
    bare = operating_measures(response(speeds, 0.5 * shares + 0.1, 0.0), OperatingRange(1000.0, 1150.0))
    assert bare["exceedance_integral_operating_scatter_rad_s"] > 0.0


def test_what_is_not_run_over_the_whole_range_is_not_known():
    speeds = np.arange(1000.0, 1301.0, 10.0)
    measures = operating_measures(response(speeds, np.ones(len(speeds))), OperatingRange(990.0, 1150.0))
    assert set(measures) == set(names(OPERATING))
    assert np.isnan(list(measures.values())).all()


def test_the_ranking_inside_stands_next_to_that_over_all_speeds():
    def of(length, inside):
        own = dict.fromkeys(names(ROBUSTNESS), 0.0) | {"length_certain_rad_s": length, "diverged_runs": 0.0}
        return own | {"length_certain_operating_rad_s": inside, "exceedance_integral_operating_rad_s": inside}

    table = ranking_table({("A", "x"): of(1.0, 9.0), ("B", "x"): of(5.0, 2.0), ("C", "x"): of(3.0, np.nan)})
    assert table["blade"].tolist() == ["A", "C", "B"]
    ranks = table.set_index("blade")["rank_operating"]
    assert ranks[["A", "B"]].tolist() == [2, 1]
    assert ranks.isna()["C"]


def test_both_units_give_the_same_range():
    rad = OperatingSection.model_validate({"idle_rad_s": 1000.0, "redline_rad_s": 1500.0, "margin_percent": 2.0}).operating()
    rpm = OperatingSection.model_validate({"idle_rpm": 1000.0 * RPM, "redline_rpm": 1500.0 * RPM, "margin_percent": 2.0})
    assert (rad.first, rad.last) == (980.0, 1530.0)
    assert rpm.operating().idle == pytest.approx(1000.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"idle_rpm": 9000.0}, "idle_rad_s and idle_rpm"),
        ({"redline_rad_s": 900.0}, "a speed above idle"),
        ({"dwell": [{"from_rad_s": 900.0, "to_rad_s": 1100.0, "share_percent": 5.0}]}, "idle and redline, 1000 and 1500 rad/s"),
        ({"dwell": [{"from_rad_s": 1200.0, "to_rad_s": 1100.0, "share_percent": 5.0}]}, "above the lowest one"),
        ({"dwell": [{"from_rad_s": 1100.0, "to_rad_s": 1200.0, "share_percent": 60.0}] * 2}, "at most 100 percent"),
        ({"dwell": [{"to_rad_s": 1200.0, "share_percent": 60.0}]}, "from_rad_s or from_rpm"),
    ],
)
def test_operating_refusals(changes, message):
    with pytest.raises(ValidationError, match=message):
        OperatingSection.model_validate({"idle_rad_s": 1000.0, "redline_rad_s": 1500.0} | changes)


def test_axes_of_speed_alone_are_shaded_and_keep_their_limits():
    figure, (above, below, other) = plt.subplots(3, 1)
    above.sharex(below)
    below.plot([1100.0, 1200.0], [0.0, 1.0])
    below.set_xlabel(style.SPEED_LABEL)
    before = {axes: (axes.get_xlim(), len(axes.patches)) for axes in (above, below, other)}
    style.mark_operating(figure, OperatingRange(1000.0, 1150.0))
    assert [axes.get_xlim() for axes in before] == [limits for limits, _ in before.values()]
    assert [len(axes.patches) for axes in before] == [1, 1, 0]
    plt.close(figure)
