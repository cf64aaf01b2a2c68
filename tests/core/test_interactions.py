"""Interactions: which peaks are one, what a row says of it, and the table of all."""

import io

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from defaults import InteractionChoice

from r37core.base.units import RAD_S
from r37core.results.closing import interaction_title
from r37core.results.columns import INTERACTIONS, names
from r37core.results.interactions import find_interactions, summarise, titles
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

CHOICE = InteractionChoice()
YIELD = 1e9
STRESS_OF_MOTION = 1e12
ORDERS = np.arange(0.0, 10.01, 0.02)
CROSSINGS = {("1B", 4): 1672.0, ("1B", 5): 1213.0, ("1B", 6): 965.0, ("1B", 7): 806.0, ("1T", 9): 1680.0}


def title(row):
    return interaction_title(row["mode"], row["engine_order"])


def campbell():
    table = xr.DataArray(np.full((3, 10), np.nan), {"mode": ["1B", "1T", "2B"], "engine_order": np.arange(1, 11)})
    for (mode, order), speed in CROSSINGS.items():
        table.loc[mode, order] = speed
    return xr.Dataset({"crossing_speed": table})


def stresses(values):
    """Variables of a stress (Pa) that is the same in all revolutions, at each speed."""
    same = {f"max_von_mises_{name}": ("speed", values) for name in ("median", "high", "ever", "inside")}
    same |= {"exit_revolution": ("speed", np.full(np.shape(values), np.nan))}
    return same | {"share_of_revolutions_above_yield": ("speed", np.greater(values, YIELD).astype(float))}


def response(normal=(), tangential=(), step=5.0, unit=1.0):
    """Branches (peak speed, height, engine order) that rise over 50 rad/s and drop, in each direction, above 10 um of noise."""
    speeds = np.arange(750.0, 2001.0, step) * unit
    curves, spectra = [], []
    for branches in (normal, tangential):
        level, order = np.full(len(speeds), 1e-5), np.full(len(speeds), 2.0)
        for speed, height, number in branches:
            rising = (speeds <= speed) & (speeds > speed - 50.0)
            level[rising] = np.maximum(level[rising], height * (1.0 - (speed - speeds[rising]) / 50.0))
            order[rising] = number
        curves.append(level)
        spectra.append(np.where(np.abs(ORDERS - order[:, None]) < 0.01, level[:, None], 1e-9))
    tips = ("speed", "tip_point")
    return xr.Dataset(
        {
            "status": ("speed", np.zeros(len(speeds), dtype="i1")),
            "exit_cause": ("speed", np.zeros(len(speeds), dtype="i1")),
            "rms_normal": (tips, np.stack([curves[0], 0.0 * speeds], axis=1)),
            "rms_tangential": (tips, np.stack([curves[1], 0.0 * speeds], axis=1)),
            "amplitude": (("speed", "engine_order"), spectra[0]),
            "amplitude_tangential": (("speed", "engine_order"), spectra[1]),
            **stresses(STRESS_OF_MOTION * np.hypot(*curves)),
            "yield_stress": ((), YIELD),
        },
        {"speed": speeds, "tip_point": ["leading_edge", "trailing_edge"], "engine_order": ORDERS},
    )


def found(data):
    return find_interactions(data, campbell(), CHOICE)


def joined(data):
    """As in the datasets of a sweep: another speed, at which this blade was not run, and one more scene without stress."""
    speeds = np.append(data["speed"], 2500.0)
    both = data.drop_vars("yield_stress").reindex(speed=speeds, fill_value={"status": RunStatus.NOT_RUN})
    both = both.expand_dims(blade=["Ref"], scene=["lined"])
    both["yield_stress"] = (("blade", "scene"), [[YIELD]])
    parts = {"rms": ["rms_normal", "rms_tangential"], "spectrum": ["amplitude", "amplitude_tangential"]}
    parts |= {"stress": [*stresses(0.0), "yield_stress"]}
    datasets = {kind: both[[*names, "status"]] for kind, names in parts.items()}
    bare = datasets["rms"].assign_coords(scene=["bare"])
    return datasets | {"rms": xr.concat([datasets["rms"], bare], "scene"), "campbell": campbell().expand_dims(blade=["Ref"])}


def test_a_row_of_each_branch():
    branches = [(840.0, 6e-4, 7), (1265.0, 8e-4, 5), (1715.0, 2e-3, 4)]
    rows = found(response(tangential=branches))
    assert [title(row) for row in rows] == ["1B/7", "1B/5", "1B/4"]
    assert [row["peak_speed_rad_s"] for row in rows] == [840.0, 1265.0, 1715.0]
    np.testing.assert_allclose([row["shift_rad_s"] for row in rows], [34.0, 52.0, 43.0])
    assert {row["direction"] for row in rows} == {"tangential"}
    last = rows[-1]
    assert last["drop"] == pytest.approx(1.0, abs=0.02)
    assert (last["peak_rms_normal_m"], last["peak_rms_tangential_m"]) == pytest.approx((1e-5, 2e-3))
    # stress is at yield 25 rad/s before the peak, and half of the way to the next speed again
    assert last["length_dangerous_rad_s"] == pytest.approx(27.5, abs=0.1)
    assert last["share_of_revolutions_above_yield"] == 1.0
    assert last["largest_stress_pa"] == pytest.approx(2e9, rel=1e-3)
    assert (
        rows[0]["length_dangerous_rad_s"] == rows[0]["share_of_revolutions_above_yield"] == 0.0
        and last["status"] == "completed"
    )
    assert np.isnan(last["max_wear_m"])


def test_single_speeds_below_yield_do_not_end_the_range():
    """Near the end of a branch the motion is chaotic: the length is that of all speeds above."""
    data = response(tangential=[(1715.0, 4e-3, 4)], step=1.0)
    whole = found(data)[0]
    for name in ("max_von_mises_inside", "rms_tangential"):
        data[name].loc[{"speed": [1713.0, 1714.0]}] *= 0.1
    data["share_of_revolutions_above_yield"].loc[{"speed": [1713.0, 1714.0]}] = 0.0
    (broken,) = found(data)
    # the stress falls to a tenth and rises again in straight lines
    assert broken["length_dangerous_rad_s"] == pytest.approx(whole["length_dangerous_rad_s"] - 1.35, abs=0.01)


def test_a_row_has_the_worst_within_its_interaction():
    """Stress, what is worn through, and a run that diverged, which is above yield."""
    data = response(tangential=[(1715.0, 2e-3, 4), (900.0, 1e-3, 2)])
    data["max_von_mises_inside"].loc[{"speed": [1705.0, 880.0]}] = [5e9, 9e9]
    data["status"].loc[{"speed": 1720.0}] = RunStatus.DIVERGED
    for name in (*stresses(0.0), "rms_tangential", "rms_normal"):
        data[name].loc[{"speed": 1720.0}] = np.nan
    share = np.where(data["speed"] > 1690.0, 0.2, 0.0) * (data["speed"] < 1710.0)
    rows = found(data.assign(worn_through_share=share, largest_penetration=1e-3 * share))
    assert [row["status"] for row in rows] == ["completed", "diverged"]
    stress = rows[-1]
    assert (stress["largest_stress_inside_pa"], stress["largest_stress_speed_rad_s"]) == (5e9, 1705.0)
    assert stress["length_dangerous_rad_s"] == pytest.approx(1720.0 - 1690.0, abs=0.01)
    assert (rows[-1]["peak_speed_rad_s"], [row["worn_through_share"] for row in rows]) == (1715.0, [0.0, 0.2])
    assert np.isnan(found(data)[0]["worn_through_share"])
    assert [row["largest_penetration_m"] for row in rows] == [0.0, 2e-4]
    assert np.isnan(found(data)[0]["largest_penetration_m"])


def test_a_drop_need_not_follow_at_once_and_is_that_of_the_row_s_own_peak():
    data = response(tangential=[(1001.0, 2e-3, 6)], step=1.0)
    data["rms_tangential"].loc[{"speed": slice(1002.0, 1005.0)}] = 0.97 * 2e-3
    assert found(data)[0]["drop"] == pytest.approx(1.0 - np.hypot(1e-5, 1e-5) / 2e-3, rel=1e-4)
    # but not anywhere: 24 rad/s above the peak
    data["rms_tangential"].loc[{"speed": slice(1002.0, 1026.0)}] = 0.97 * 2e-3
    assert found(data)[0]["drop"] == pytest.approx(0.03, rel=1e-3)
    # as S50 in direct contact: the tip moves more a little above a normal peak, tangentially and too little for a peak
    data = response(normal=[(1000.0, 1e-4, 2)], tangential=[(1715.0, 1e-2, 4)])
    data["rms_tangential"].loc[{"speed": 1005.0}] = 5e-4
    row = found(data)[0]
    assert row["peak_speed_rad_s"] == 1000.0
    assert row["drop"] == pytest.approx(1.0 - np.sqrt(2.0) * 1e-5 / np.hypot(1e-4, 1e-5))


@pytest.mark.parametrize(
    ("normal", "tangential", "rows"),
    [
        # without a crossing, far apart; as far apart as one crossing's peaks may be; of two orders; beside a crossing of others
        ([], [(900.0, 1e-3, 2), (1500.0, 1.2e-3, 2)], [("engine order 2", 900.0), ("engine order 2", 1500.0)]),
        ([], [(1400.0, 9e-4, 2), (1500.0, 1.2e-3, 2)], [("engine order 2", 1500.0)]),
        ([], [(1400.0, 1e-3, 3), (1500.0, 1.2e-3, 2)], [("engine order 3", 1400.0), ("engine order 2", 1500.0)]),
        ([], [(1715.0, 1e-3, 2)], [("engine order 2", 1715.0)]),
        # before the end of the speeds, to which it falls by the prominence
        ([], [(1995.0, 3e-3, 4)], [("engine order 4", 1995.0)]),
        # of one crossing
        ([(1722.0, 1e-3, 3)], [(1700.0, 2e-3, 4), (1755.0, 3e-3, 4)], [("1B/4", 1755.0)]),
        # neighbours in both directions: of one crossing, and of two
        ([(1700.0, 5e-3, 4)], [(1705.0, 9e-3, 4)], [("1B/4", 1700.0, "normal")]),
        ([(1700.0, 5e-3, 4)], [(1705.0, 9e-3, 9)], [("1B/4", 1700.0, "normal"), ("1T/9", 1705.0)]),
        # as S100's 1B/4: the normal motion, of another order, has its peak there too, a step away, or elsewhere
        ([(1640.0, 5e-5, 3)], [(1640.0, 9e-3, 4)], [("1B/4", 1640.0, "both")]),
        ([(1645.0, 5e-5, 3)], [(1640.0, 9e-3, 4)], [("1B/4", 1640.0)]),
        ([(1700.0, 5e-5, 2)], [(1640.0, 9e-3, 4)], [("1B/4", 1640.0), ("engine order 2", 1700.0, "normal")]),
    ],
)
def test_peaks_that_are_one_interaction_and_those_that_are_not(normal, tangential, rows):
    """Title and peak speed of each row, and its direction where that is not tangential."""
    both = found(response(normal, tangential))
    assert titles(both) == {speed: title for title, speed, *_ in rows}
    assert [row["direction"] for row in both] == [(*row, "tangential")[2] for row in rows]
    assert all(np.isnan(row["campbell_speed_rad_s"]) for row in both if not row["mode"])


def test_the_end_of_the_speeds_is_no_peak():
    """It ends the reach of the interaction before it all the same; what is above yield there has a row of its own."""
    data = response(tangential=[(1940.0, 1e-3, 2), (2000.0, 3e-3, 4)])
    row, end = found(data)
    assert end["peak_speed_rad_s"] == 2000.0 and "without a peak" in end["note"]
    assert (row["peak_speed_rad_s"], row["largest_stress_speed_rad_s"]) == (1940.0, 1940.0)
    falling = response(tangential=[(1265.0, 1e-3, 5)])
    falling["rms_tangential"][0] = 5e-3
    assert [one["peak_speed_rad_s"] for one in found(falling)] == [1265.0]


def test_what_answers_beyond_a_quiet_range_is_not_part_of_it():
    """A peak too small to be listed, far above one that is, neither widens nor worsens it."""
    data = response([(1265.0, 5e-5, 5)], [(900.0, 30e-3, 3), (1265.0, 5e-3, 5), (1400.0, 2e-3, 2)])
    row = found(data)[1]
    assert title(row) == "1B/5"
    assert row["length_dangerous_rad_s"] < 50.0
    data["max_von_mises_inside"].loc[{"speed": 1400.0}] = 90e9
    # as texts: what is NaN in both is the same
    assert repr(found(data)[1]) == repr(row)


def test_the_crossing_is_the_nearest_and_the_order_the_strongest_whole_one():
    """Between 1B/4 at 1672 and 1T/9 at 1680 that of the strongest order; without a spectrum none is known."""
    for order, expected in ((4, "1B/4"), (9, "1T/9")):
        peak = response(tangential=[(1677.0, 1e-3, order)])
        assert title(found(peak)[0]) == expected
        (row,) = found(peak.drop_vars(["amplitude", "amplitude_tangential"]))
        assert title(row) == "a peak of its own"
    data = response(tangential=[(1715.0, 2e-3, 3.98)])
    data["amplitude_tangential"].loc[{"engine_order": 0.0}] = 1.0
    assert title(found(data)[0]) == "1B/4"


def test_the_table_of_all():
    table = summarise(joined(response(tangential=[(1265.0, 8e-4, 5), (1715.0, 2e-3, 4)])), CHOICE)
    assert list(table.columns) == names(INTERACTIONS)
    assert list(table["scene"]) == ["lined", "lined", "bare", "bare"]
    lined, bare = table.iloc[1], table.iloc[3]
    assert (lined["largest_stress_pa"], lined["engine_order"]) == (pytest.approx(2e9, rel=1e-3), 4)
    assert np.isnan([bare["largest_stress_pa"], bare["length_dangerous_rad_s"]]).all()
    # an order is a whole number in the file, and a scene without a spectrum has no order where nothing is near
    text = table.to_csv(index=False)
    assert "Ref,lined,1B,4,tangential,1672.0,1715.0," in text
    # speeds of the file are those of the datasets, also in rpm, where a speed has sixteen digits
    data = response(tangential=[(1265.0, 8e-4, 5)], step=5.0, unit=RAD_S["rpm"] * 9.5)
    table = summarise(joined(data), CHOICE)
    back = pd.read_csv(io.StringIO(table.to_csv(index=False)))
    for row in back.itertuples():
        assert f"{row.peak_speed_rad_s:.6g}" != repr(row.peak_speed_rad_s)
        assert float(data["rms_tangential"].sel(speed=row.peak_speed_rad_s, tip_point="leading_edge")) > 7e-4


def test_no_response_no_interaction():
    data = response()
    assert found(data) == []
    data["rms_normal"][:] = data["rms_tangential"][:] = np.nan
    assert found(data) == []
    assert summarise(joined(data), CHOICE).empty
    data["status"][:] = RunStatus.NOT_RUN
    assert found(data) == []


def test_a_row_says_whether_it_lasts_and_which_thickness_suffices():
    """Of two peaks the first has cut itself free at its two highest speeds, and its lining is worn through."""
    data = response(tangential=[(1000.0, 2e-3, 6.0), (1715.0, 3e-3, 4.0)])
    speed = data["speed"].values
    states = np.where(speed > 1300.0, MotionAtEnd.LASTING, MotionAtEnd.QUIET)
    states[(speed > 980.0) & (speed <= 1000.0)] = MotionAtEnd.GROWING
    states[speed == 1000.0] = MotionAtEnd.CUT_FREE
    used = np.where(speed == 1000.0, 5e-3, np.where(speed > 1300.0, 1e-3, 0.0))
    runs = {"motion_at_end": states, "used_thickness": used, "worn_through_share": np.where(used == 5e-3, 0.2, 0.0)}
    first, second = found(data.assign({name: ("speed", values) for name, values in runs.items()}))
    assert (first["motion_at_end"], first["sufficient_thickness_m"]) == ("cut_free", 5e-3)
    assert first["note"] == "worn through: the sufficient thickness is a lower bound" and not second["note"]
    assert 0.0 < first["lasting_share"] < 0.5
    assert (second["motion_at_end"], second["sufficient_thickness_m"], second["lasting_share"]) == ("lasting", 1e-3, 1.0)
    # of a response without them
    (row, _) = found(data)
    assert row["motion_at_end"] == "" and np.isnan([row["lasting_share"], row["sufficient_thickness_m"]]).all()
