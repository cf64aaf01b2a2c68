"""Requirements: each judged on numbers that are known, its margin, place and certainty, and the tables of a run."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from box_mesh import box_mesh
from integration_cases import DIRECT

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import write_json
from r37core.base.plain import to_plain
from r37core.config import ConfigError, command_line_document
from r37core.fem.assembly import mesh_volume
from r37core.figures.response_curves import draw_response
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.results.datasets import FURTHER_RUNS, overlaid, response_of, with_further_runs
from r37core.results.interaction_choice import InteractionChoice
from r37core.results.interactions import summarise
from r37core.results.operating_range import OperatingDwell, OperatingRange
from r37core.results.regions import judged as judged_region
from r37core.results.steps import ranking
from r37core.results.table_file import read_table, write_table
from r37core.results.variables import VARIABLES
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus
from r37studies.other_models import ModelChoice
from r37studies.requirements import steps
from r37studies.requirements.choice import CampbellMargin, Requirements
from r37studies.requirements.evidence import Evidence, extended, worst_of
from r37studies.requirements.judging import (
    AT_LEAST,
    COARSER_MESH,
    DOWN,
    FAILS,
    HALF_STEP,
    HIGHEST_DAMPING,
    LESS_FRICTION,
    MEETS,
    NOT_APPLICABLE,
    NOT_MEASURED,
    REST,
    UNKNOWN,
    UP,
    _measured_error,
    closeness,
    fails_clearly,
    judge,
    nearness,
)
from r37studies.requirements.looks import joined_looks
from r37studies.requirements.plan import Judged, remarks
from r37studies.requirements.table import certainty, closing, operating_table, overall, reason, verdict_table

SPEEDS = np.arange(1000.0, 1301.0, 5.0)
FLOWN = OperatingRange(1050.0, 1250.0)


def above(first, last):
    """Shares of a motion that repeats itself, above yield at speeds from the first to the last."""
    return ((first <= SPEEDS) & (last >= SPEEDS)).astype(float)


def at(speed, value, elsewhere):
    return np.where(speed == SPEEDS, value, elsewhere)


def everywhere(value):
    return np.full(len(SPEEDS), value)


def response(shares=None, **more):
    """Of runs that are nowhere above yield, unless said; arrays are over the speeds."""
    content = {"share_of_revolutions_above_yield": everywhere(0.0) if shares is None else shares, "status": everywhere(0)}
    content |= {"lined": 1.0, "static_stress": 1.0} | more
    of_speed = {name: ("speed", values) if isinstance(values, np.ndarray) else values for name, values in content.items()}
    return xr.Dataset(of_speed, {"speed": SPEEDS})


def stressed(median, shares=None):
    """A response with its median stress, as shares of yield."""
    return response(shares, max_von_mises_median=2.0 * median, yield_stress=2.0)


def fatigued(share):
    return response(goodman_share=share, fatigue_strength=6e8)


def growing_at(runs, *speeds):
    """The response with motions that still grow at these speeds, as the runs end."""
    return runs.assign(motion_at_end=("speed", np.where(np.isin(SPEEDS, speeds), MotionAtEnd.GROWING, MotionAtEnd.QUIET)))


def untouched(runs):
    return runs.assign(share_of_time_in_contact=0.0 * runs["status"])


def diverged_at(runs, *speeds):
    return runs.assign(status=("speed", np.where(np.isin(SPEEDS, speeds), RunStatus.DIVERGED, RunStatus.COMPLETED)))


def campbell(crossing=1200.0):
    """Frequencies that are the same at every speed: 1B crosses order 4, and 1T minus 1B order 6 at 1300 rad/s."""
    hertz = np.cumsum([4.0 * crossing, 6.0 * 1300.0])[:, None] / (2.0 * np.pi) + np.zeros(9)
    frequency = xr.DataArray(hertz, {"mode": ["1B", "1T"], "speed": np.linspace(0.0, 2000.0, 9)})
    crossings = xr.DataArray([[crossing, np.nan]], {"mode": ["1B"], "engine_order": [4, 5]}, ("mode", "engine_order"))
    return xr.Dataset({"crossing_speed": crossings.reindex(mode=["1B", "1T"]), "frequency": frequency})


def one(requirements, runs=None, **evidence):
    known = {"campbell": campbell(), "operating": FLOWN, "clearance": 3e-4} | evidence
    (judgement,) = judge(requirements, Evidence(response() if runs is None else runs, **known))
    return judgement


def verdict(requirements, runs=None, **evidence):
    return one(requirements, runs, **evidence)["verdict"]


def note_of_unknown(requirements, runs=None, **evidence):
    """Why it cannot be told."""
    judgement = one(requirements, runs, **evidence)
    assert judgement["verdict"] == UNKNOWN
    return judgement["note"]


NEEDS = Requirements(above_yield=0.0)


def test_runs_and_motions_over_parts_of_the_speeds_are_joined():
    """Datasets of a run have their speeds in revolutions per minute, too; those of sweeps do not."""
    runs = response(above(1000.0, 1300.0)).assign_coords(speed_rpm=("speed", 9.55 * SPEEDS))
    joined = extended(runs, response().isel(speed=slice(2, -2)))
    assert joined["speed"].values.tolist() == SPEEDS.tolist() and list(joined.coords) == ["speed"]
    above_all = overlaid(response(), response(above(1000.0, 1300.0)).sel(speed=[1100.0]))
    assert above_all["share_of_revolutions_above_yield"].sum() == 1.0 and above_all.sizes["speed"] == len(SPEEDS)


def test_speeds_above_yield_inside_the_range_alone():
    """Above yield from 1017.5 to 1082.5 and 1197.5 to 1232.5, half of the way between speeds: 32.5 and 35 inside."""
    runs = response(above(1020.0, 1080.0) + above(1200.0, 1230.0))
    judgement = one(Requirements(above_yield=60.0), runs)
    assert judgement["value"] == pytest.approx(67.5)
    assert (judgement["margin"], judgement["verdict"]) == (pytest.approx(-7.5), FAILS)
    assert (judgement["from_rad_s"], judgement["to_rad_s"]) == (1197.5, 1232.5)
    # three borders inside, each anywhere between two speeds
    assert judgement["scatter"] == pytest.approx(2.5)
    for limit, expected in ((72.4, UNKNOWN), (72.6, MEETS), (62.6, UNKNOWN), (62.4, FAILS)):
        assert verdict(Requirements(above_yield=limit), runs) == expected, limit
    # what lies outside does not count
    outside = one(NEEDS, response(above(1270.0, 1290.0)))
    assert outside["verdict"] == MEETS and np.isnan(outside["from_rad_s"]) and outside["note"] == ""
    # a few revolutions are no length, and are told all the same
    some = one(NEEDS, response(at(1100.0, 0.42, 0.0)))
    assert (some["verdict"], some["value"], some["note"]) == (MEETS, 0.0, "above yield in up to 0.42 of the revolutions")
    across = one(NEEDS, response(above(1020.0, 1080.0)))
    assert (across["from_rad_s"], across["to_rad_s"]) == (1050.0, 1082.5)


def test_a_run_that_diverged_is_above_yield_and_what_is_not_run_or_computed_cannot_be_told():
    runs = diverged_at(response(at(1100.0, np.nan, 0.0), diverged_revolution=at(1100.0, 3.7, np.nan)), 1100.0)
    judgement = one(NEEDS, runs)
    assert judgement["verdict"] == FAILS
    assert "1 of 41 runs diverged, soonest at 1100 rad/s after 3.7 revolutions" in judgement["note"]
    assert note_of_unknown(NEEDS, response().isel(speed=slice(16, None))) == "speeds are not run from 1050 to 1250 rad/s"
    without = response().drop_vars("share_of_revolutions_above_yield")
    assert "stress is not computed" in note_of_unknown(NEEDS, without)
    assert "wear is not computed" in note_of_unknown(Requirements(used_lining=1.0), thickness=1e-3)
    assert verdict(Requirements(mass=0.1)) == UNKNOWN


def test_the_lining_that_is_used():
    whole, most = Requirements(used_lining=1.0), Requirements(used_lining=0.7)
    used = np.maximum(6e-4 - 1e-5 * np.abs(SPEEDS - 1200.0), at(1000.0, 9e-4, 2e-4))
    runs = response(used_thickness=used, worn_through_share=everywhere(0.0))
    judgement = one(most, runs, thickness=1e-3)
    # 0.9 mm at 1000 rad/s is outside
    assert (judgement["value"], judgement["verdict"], judgement["from_rad_s"]) == (pytest.approx(60.0), MEETS, 1200.0)
    # what still grows is a lower bound
    growing = growing_at(runs, 1200.0)
    assert note_of_unknown(most, growing, thickness=1e-3).endswith("a lower bound")
    # far from the limit, too
    assert verdict(most, growing.assign(used_thickness=("speed", 0.1 * used)), thickness=1e-3) == UNKNOWN
    worn = runs.assign(worn_through_share=("speed", at(1150.0, 0.1, 0.0)))
    judgement = one(whole, worn, thickness=1e-3)
    assert (judgement["verdict"], judgement["note"], judgement["from_rad_s"]) == (FAILS, "worn through to the casing", 1150.0)
    assert np.isnan(judgement["value"])
    judgement = one(whole, worn)
    assert (judgement["verdict"], judgement["note"]) == (NOT_APPLICABLE, "no lining")
    judgement = one(whole, diverged_at(runs, 1120.0), thickness=1e-3)
    assert (judgement["verdict"], judgement["note"]) == (FAILS, "1 of 41 runs diverged")
    assert judgement["from_rad_s"] == 1120.0
    judgement = one(whole, diverged_at(runs, *SPEEDS), thickness=1e-3)
    assert (judgement["note"], np.isfinite(judgement["margin"])) == ("every run diverged", False)
    # no lining used: no speed where it is worst
    judgement = one(most, runs.assign(used_thickness=0.0 * runs["used_thickness"]), thickness=1e-3)
    assert (judgement["value"], judgement["verdict"]) == (0.0, MEETS) and np.isnan(judgement["from_rad_s"])


def test_the_goodman_share():
    runs = fatigued(at(1120.0, 0.7, at(1020.0, 3.0, 0.2)))
    judgement = one(Requirements(goodman_share=0.5), runs)
    # 3 at 1020 rad/s is outside
    assert (judgement["value"], judgement["from_rad_s"], judgement["verdict"]) == (pytest.approx(0.7), 1120.0, FAILS)
    # from 0.7 to 0.2 within 5 rad/s on both sides: what lies between is not known
    assert reason(pd.Series(judgement)) == f"goodman_share by 0.2, at 1120 rad/s ({AT_LEAST}; over 4 of 200 rad/s)"
    runs = diverged_at(runs, 1150.0)
    judgement = one(Requirements(goodman_share=5.0), runs)
    assert (judgement["verdict"], judgement["note"]) == (FAILS, "1 of 41 runs diverged")
    runs["fatigue_strength"] = np.inf
    assert "no strengths" in one(Requirements(goodman_share=0.5), runs)["note"]
    assert "fatigue is not computed" in one(Requirements(goodman_share=0.5))["note"]


def test_what_lies_between_runs_counts_up_to_the_ends_of_the_range():
    """A share that falls from 2 at 1045 to 0.2 at 1050 rad/s is 1.1 at 1047.5, where the range begins; no run lies inside."""
    judgement = one(Requirements(goodman_share=1.0), fatigued(at(1045.0, 2.0, 0.2)), operating=OperatingRange(1047.5, 1049.0))
    assert (judgement["value"], judgement["from_rad_s"]) == (pytest.approx(1.1), 1047.5)
    # up to the next run nothing is known beside one that diverged, however near that is
    diverged, near = diverged_at(fatigued(everywhere(0.2)), 1045.0), OperatingRange(1049.9, 1060.0)
    assert verdict(Requirements(goodman_share=0.5), diverged, operating=near) == FAILS


def test_speeds_too_far_apart_for_an_interaction_cannot_tell_that_a_limit_is_kept():
    coarse = response().isel(speed=slice(None, None, 2))
    assert note_of_unknown(NEEDS, coarse).startswith("speeds lie up to 10 rad/s apart")
    # where nothing touches at any speed, nothing is hidden
    assert verdict(NEEDS, untouched(coarse)) == MEETS
    assert verdict(NEEDS, coarse.assign(share_of_time_in_contact=0.3 + 0.0 * coarse["status"])) == UNKNOWN
    # where it is not kept they tell
    assert verdict(NEEDS, response(above(1100.0, 1120.0)).isel(speed=slice(None, None, 2))) == FAILS


def test_a_verdict_holds_where_all_that_was_tried_agrees():
    quiet, loud = response(), response(above(1100.0, 1120.0))
    assert verdict(NEEDS, looks={REST: quiet, UP: quiet}) == MEETS
    judgement = one(NEEDS, looks={REST: quiet, UP: loud})
    assert (judgement["verdict"], judgement["value"], judgement["value_highest"]) == (UNKNOWN, 0.0, pytest.approx(25.0))
    assert judgement["margin_worst_motion"] == pytest.approx(-25.0)
    assert judgement["note"].startswith("fails carried up by 25 rad/s")
    # further runs from rest stand in place of the sweep's
    assert verdict(NEEDS, loud, looks={REST: quiet}) == MEETS
    assert verdict(NEEDS, looks={REST: loud, UP: loud}) == FAILS
    # one run with another friction, over those from rest
    judgement = one(NEEDS, looks={REST: quiet, LESS_FRICTION: loud.sel(speed=[1110.0])})
    assert judgement["note"].startswith("fails with 1% less friction by 5 rad/s")
    # a quieter motion takes nothing from one that fails; the same motion with another friction does
    assert verdict(NEEDS, looks={REST: loud, UP: quiet}) == FAILS
    looks = {REST: response(above(1110.0, 1110.0)), LESS_FRICTION: quiet.sel(speed=[1110.0])}
    assert note_of_unknown(NEEDS, looks=looks).startswith("meets with 1% less friction")
    # and so does another damping, also of what fails clearly, of which no other run is from rest
    note = note_of_unknown(NEEDS, loud, looks={HIGHEST_DAMPING: quiet.sel(speed=slice(1100.0, 1120.0))})
    assert note.startswith("meets with highest damping")
    assert verdict(NEEDS, loud, looks={HIGHEST_DAMPING: quiet.sel(speed=slice(1100.0, 1110.0))}) == FAILS
    assert note_of_unknown(NEEDS, looks={REST: quiet, HIGHEST_DAMPING: loud}).startswith(
        "fails with highest damping by 25 rad/s"
    )
    assert one(NEEDS, not_looked="no further runs of a rotor")["note"].startswith("no further runs of a rotor")


def test_the_error_of_mesh_and_step_is_part_of_a_verdict():
    """Median stress of 0.98 of yield at one speed: with 5% more it is above, and the length that of one speed."""
    median = at(1150.0, 0.98, 0.5)
    runs = stressed(median)
    assert verdict(NEEDS, runs, error=0.01) == MEETS
    assert note_of_unknown(NEEDS, runs, error=0.05).startswith("fails with 5% more by 5 rad/s")
    above_yield = stressed(median + 0.1, above(1150.0, 1150.0))
    assert verdict(NEEDS, above_yield, error=0.05) == FAILS
    assert note_of_unknown(NEEDS, above_yield, error=0.1).startswith("meets with 10% less")
    evidence = Evidence(above_yield, campbell=campbell(), operating=FLOWN)
    assert not fails_clearly(NEEDS, evidence)
    assert fails_clearly(NEEDS, evidence.scaled(1.1)) == ["above_yield"]
    # all that was tried has it
    used = response(used_thickness=everywhere(4e-4))
    looks = {REST: used, LESS_FRICTION: response(used_thickness=everywhere(8.9e-4)).sel(speed=[1150.0])}
    note = note_of_unknown(Requirements(used_lining=0.9), looks=looks, thickness=1e-3, error=0.05)
    assert note.startswith("fails with 1% less friction and 5% more by 3.45 %")


def test_the_error_of_mesh_and_step_is_measured_on_the_blade():
    """By a mesh of half the nodes and half the step, in place of the level's; a level without one tells what fails clearly."""
    beside, near = np.maximum(0.8 - 0.01 * np.abs(SPEEDS - 1150.0), 0.2), [1145.0, 1150.0, 1155.0]
    runs = fatigued(at(1150.0, 0.8, beside))
    for coarse, fine, expected in ((0.84, 0.8, MEETS), (0.8, 0.76, MEETS), (0.99, 0.8, MEETS), (0.99, 0.7, UNKNOWN)):
        others = {COARSER_MESH: coarse, HALF_STEP: fine}
        looks = {REST: runs} | {name: fatigued(at(1150.0, value, beside)).sel(speed=near) for name, value in others.items()}
        found = one(Requirements(goodman_share=1.0), looks=looks, error=np.nan)
        assert found["verdict"] == expected and found["value_highest"] >= coarse
    # of speeds that ended both ways; where none did the level's counts
    coarse = fatigued(at(1150.0, 0.84, beside)).sel(speed=near)
    for diverged, error in (([1145.0], 0.05), (near, np.nan)):
        gone = coarse.assign(status=("speed", np.where(np.isin(near, diverged), RunStatus.DIVERGED, 0)))
        looks = {REST: runs, COARSER_MESH: gone, HALF_STEP: runs.sel(speed=near)}
        evidence = Evidence(runs, operating=FLOWN, looks=looks, error=np.nan)
        np.testing.assert_allclose(_measured_error(Requirements(goodman_share=1.0), evidence), error)
    # without stress there is nothing to differ
    still = fatigued(everywhere(0.0))
    evidence = Evidence(still, operating=FLOWN, looks={HALF_STEP: still, COARSER_MESH: still}, error=np.nan)
    assert _measured_error(Requirements(goodman_share=1.0), evidence) == 0.0
    assert NOT_MEASURED in note_of_unknown(Requirements(goodman_share=1.0), runs, error=np.nan)
    assert verdict(Requirements(goodman_share=0.6), runs, error=np.nan) == FAILS
    assert note_of_unknown(Requirements(goodman_share=0.75), runs, error=np.nan).startswith("meets with 15% less")


def test_what_a_peak_between_speeds_or_a_drift_may_exceed_is_a_lower_bound():
    limit = Requirements(goodman_share=1.0)
    sharp, broad = fatigued(at(1150.0, 0.5, 0.2)), fatigued(0.5 - 1e-5 * (SPEEDS - 1150.0) ** 2)
    assert AT_LEAST in one(limit, sharp)["note"] and one(limit, broad)["note"] == ""
    assert AT_LEAST in one(limit, broad.assign(stress_drift=("speed", at(1150.0, 0.2, 0.0))))["note"]
    assert "to at least" in certainty(pd.Series(one(limit, sharp, error=0.03)))
    # as it drifts on it fails
    assert one(limit, broad.assign(stress_drift=("speed", at(1150.0, 0.05, 0.0))))["value_highest"] == pytest.approx(0.525)
    drifting = broad.assign(stress_drift=("speed", at(1150.0, 1.2, 0.0)))
    assert note_of_unknown(limit, drifting).startswith("fails as it drifts on by 0.1")


def test_what_fails_elsewhere_keeps_what_is_far_below_its_limit():
    limit, why = (
        Requirements(goodman_share=1.0),
        {"not_looked": "few further runs, as above_yield fails", "fails_elsewhere": True},
    )
    assert verdict(limit, fatigued(everywhere(0.3)), **why) == MEETS
    assert note_of_unknown(limit, fatigued(everywhere(0.4)), **why).startswith("few further runs, as above_yield fails")


def test_a_motion_that_grows_near_the_limit_cannot_tell():
    runs = stressed(at(1150.0, 0.9, 0.45))
    note = note_of_unknown(NEEDS, growing_at(runs, 1100.0, 1150.0))
    assert note.startswith("the motion still grows as the run ends, at 1150 rad/")
    assert verdict(NEEDS, growing_at(runs, 1100.0)) == MEETS
    # outside of the range
    assert verdict(NEEDS, growing_at(stressed(at(1020.0, 0.9, 0.5)), 1020.0)) == MEETS


def test_growth_that_can_overturn_an_answer_does():
    runs, limit = stressed(at(1150.0, 1.5, at(1100.0, 0.6, 0.4)), above(1150.0, 1150.0)), Requirements(above_yield=20.0)
    for speed, expected in ((1100.0, UNKNOWN), (1150.0, MEETS), (1200.0, MEETS)):
        assert verdict(limit, growing_at(runs, speed)) == expected
    note = note_of_unknown(limit, looks={REST: runs, UP: growing_at(runs, 1100.0)})
    assert note.startswith("the motion still grows as the run ends, at 1100 rad/s, carried up")
    # wear that grows anywhere
    grows = growing_at(response(used_thickness=at(1150.0, 6e-4, 2e-4)), 1200.0)
    assert verdict(Requirements(used_lining=0.9), grows, thickness=1e-3) == UNKNOWN


def test_chance_in_a_bare_casing_moves_a_length():
    """Half of the revolutions, more or less, are above yield from 1100 to 1200 rad/s: no length near the limit is sure."""
    shares = np.where((SPEEDS >= 1100.0) & (SPEEDS <= 1200.0), np.random.default_rng(0).uniform(0.4, 0.6, len(SPEEDS)), 0.01)
    bare = response(shares, lined=0.0)
    found = one(Requirements(above_yield=1000.0), bare)
    value, scatter = found["value"], found["scatter"]
    assert scatter > 1.0 and found["verdict"] == MEETS
    for limit, expected in ((-2.1, FAILS), (-1.9, UNKNOWN), (1.9, UNKNOWN), (2.1, MEETS)):
        assert verdict(Requirements(above_yield=value + limit * scatter), bare) == expected, limit
    assert one(Requirements(above_yield=1000.0), response(shares))["scatter"] < 1.5 * scatter


def test_how_near_runs_come_to_a_limit():
    runs = stressed(at(1100.0, 0.9, 0.5)).assign(fatigue_strength=6e8)
    runs = runs.assign(goodman_share=0.4 + 0.0 * runs["status"], used_thickness=1e-3 + 0.0 * runs["status"])
    evidence = Evidence(runs, operating=FLOWN, thickness=5e-3)
    assert nearness(NEEDS, evidence).max() == 0.9
    assert nearness(Requirements(goodman_share=0.5), evidence).max() == pytest.approx(0.8)
    assert nearness(Requirements(used_lining=0.25), evidence).max() == pytest.approx(0.8)
    both = nearness(Requirements(above_yield=0.0, goodman_share=0.5), evidence)
    assert (both.min(), both.max()) == (pytest.approx(0.8), 0.9)
    runs["status"][0] = RunStatus.DIVERGED
    assert nearness(NEEDS, evidence)[0] == np.inf


def test_the_worst_of_several_motions_counts_and_by_how_little_does_not_matter():
    looks = {look: fatigued(everywhere(share)) for look, share in ((REST, 0.2), (UP, 0.6), (DOWN, 0.7))}
    judgement = one(Requirements(goodman_share=0.5), looks[REST], looks=looks)
    assert judgement["verdict"] == UNKNOWN and judgement["margin_worst_motion"] == pytest.approx(-0.2)
    assert judgement["note"].startswith("fails carried up by 0.1; fails carried down by 0.2")


def test_stress_of_vibration_alone_and_contact_on_points_show_no_limit_to_be_kept():
    assert note_of_unknown(NEEDS, response(static_stress=0.0)).startswith("stress of vibration alone")
    assert verdict(NEEDS, response(above(1100.0, 1120.0), static_stress=0.0)) == FAILS
    assert note_of_unknown(NEEDS, point_contact=True).startswith("contact acts on points")
    judgement = one(NEEDS, untouched(response()), point_contact=True, not_looked="no further runs of a rotor")
    assert (judgement["verdict"], judgement["note"]) == (MEETS, "the tip touches nothing, which needs no further runs")


def test_a_tip_may_touch_where_no_run_says_that_it_does_not():
    quiet = untouched(response())
    few = quiet.isel(speed=[0, -1])
    assert Evidence(few, operating=FLOWN, clearance=3e-4).touches is False
    # a run beside the range counts where the range begins or ends between two
    beside = few.assign(share_of_time_in_contact=("speed", np.array([0.3, 0.0])))
    for runs in (beside, quiet.isel(speed=slice(20, None)), diverged_at(quiet, 1100.0)):
        assert Evidence(runs, operating=FLOWN, clearance=3e-4).touches
    # a clearance that changes with the speed may close between two
    assert Evidence(quiet, operating=FLOWN).touches


def test_a_run_outside_of_the_range_fails_nothing_clearly():
    runs = stressed(np.where(SPEEDS <= 1045.0, 3.0, 0.5), above(1000.0, 1045.0))
    assert fails_clearly(NEEDS, Evidence(runs, operating=OperatingRange(1046.0, 1060.0))) == []
    assert fails_clearly(NEEDS, Evidence(runs, operating=OperatingRange(1045.0, 1060.0))) == ["above_yield"]


def test_stress_before_a_motion_settles_counts():
    runs = response(max_von_mises_of_run=at(1150.0, 1.2, 0.5), yield_stress=1.0)
    judgement = one(NEEDS, looks={REST: runs})
    assert (judgement["verdict"], judgement["value"], judgement["further_runs"]) == (UNKNOWN, 0.0, len(SPEEDS))
    assert judgement["note"].startswith("fails before it settles by 5 rad/s")


def test_a_number_that_is_lacking_is_no_answer():
    lacking = at(1150.0, np.nan, 0.0)
    runs = response(lacking, used_thickness=lacking, goodman_share=lacking, fatigue_strength=6e8)
    assert note_of_unknown(NEEDS, runs) == "no share_of_revolutions_above_yield at 1150 rad/s"
    assert one(Requirements(used_lining=0.5), runs, thickness=1e-3)["note"] == "no used_thickness at 1150 rad/s"
    assert one(Requirements(goodman_share=0.5), runs)["note"] == "no goodman_share at 1150 rad/s"


def test_motions_that_do_not_reach_over_the_range_count():
    """Beside scenes with a lining a bare casing's have its numbers, too."""
    part = response(above(1100.0, 1120.0)).sel(speed=slice(1090.0, 1130.0))
    motions = (
        part.assign(used_thickness=np.nan * part["status"])
        .expand_dims(motion=["rest", "up"])
        .assign(differ=1.0 + 0.0 * part["status"])
    )
    assert note_of_unknown(NEEDS, motions=motions).startswith("fails in the worst motion by 25 rad/s")


def test_the_worst_of_motions_diverged_where_one_did():
    status = [[RunStatus.DIVERGED, RunStatus.NOT_RUN], [RunStatus.NOT_RUN, RunStatus.COMPLETED]]
    motions = xr.Dataset({"status": (("motion", "speed"), np.array(status, int))}, {"speed": [1.0, 2.0]})
    assert worst_of(motions)["status"].values.tolist() == [RunStatus.DIVERGED, RunStatus.COMPLETED]


def test_the_runs_closest_to_a_limit():
    median = np.linspace(0.1, 3.0, len(SPEEDS))
    close = closeness(NEEDS, Evidence(stressed(median), operating=FLOWN))
    np.testing.assert_allclose(close, np.minimum(median, 1.0 / median))


def test_clearance_mass_and_damage():
    """A scene next to one that grows has its own clearance."""
    judgement = one(Requirements(clearance=3e-4), clearance=2e-4)
    assert (judgement["margin"], judgement["verdict"]) == (pytest.approx(-0.1), FAILS)
    room = np.tile(5e-4 - 1e-6 * (SPEEDS - 1000.0), (2, 1)).T
    judgement = one(Requirements(clearance=2.4e-4), response(clearance=(("speed", "contact_node"), room)))
    assert (judgement["value"], judgement["from_rad_s"], judgement["verdict"]) == (pytest.approx(0.25), 1250.0, MEETS)
    assert verdict(Requirements(mass=0.1), mass=0.101) == FAILS
    damage = [verdict(Requirements(miner_sum=1e-4), miner_sum=value) for value in (5e-5, 2e-4, np.inf, np.nan)]
    assert damage == [MEETS, FAILS, FAILS, UNKNOWN]
    runs = response(clearance=(("speed", "contact_node"), np.nan * room))
    assert verdict(Requirements(clearance=3e-4), runs, clearance=4e-4) == MEETS


def test_margins_of_crossings():
    needs = Requirements(campbell_margins=(CampbellMargin("1B", (4,), 0.05),))
    assert one(needs)["value"] == 0.0
    assert one(needs, campbell=campbell(1300.0))["value"] == pytest.approx(100.0 * 50.0 / 1300.0)
    assert verdict(needs, campbell=campbell(1320.0)) == MEETS
    # with dwells the rest of the range is passed, and does not count
    dwell = OperatingRange(1050.0, 1250.0, dwell=(OperatingDwell(1100.0, 1110.0, 0.5),))
    assert one(needs, operating=dwell)["value"] == pytest.approx(100.0 * 90.0 / 1200.0)
    # a mode that never crosses the order
    assert one(Requirements(campbell_margins=(CampbellMargin("1B", (2,), 0.05),)))["value"] == 100.0
    combination = one(Requirements(campbell_margins=(CampbellMargin("1T-1B", (6,), 0.05),)))
    assert combination["requirement"] == "campbell_margin 1T-1B/6"
    assert (combination["value"], combination["from_rad_s"]) == pytest.approx((100.0 * 50.0 / 1300.0, 1300.0))


def over_members(name, shares, **more):
    """Members that have these numbers at every speed, shape (members, speeds)."""
    content = {name: (("member", "speed"), shares), "status": (("member", "speed"), np.zeros(shares.shape, int))}
    return xr.Dataset(content | more, {"speed": SPEEDS, "member": np.arange(len(shares))})


def test_certainty_by_members_and_motions():
    shares = np.stack([above(2000.0, 2000.0), above(1100.0, 1120.0), above(2000.0, 2000.0), above(1290.0, 1300.0)])
    members = over_members("share_of_revolutions_above_yield", shares, lined=1.0)
    motions = members.rename(member="motion").assign(differ=("speed", everywhere(1.0)))
    judgement = one(NEEDS, members=members, motions=motions)
    assert judgement["verdict"] == UNKNOWN
    assert (judgement["members"], judgement["share_of_members"]) == (4, 0.75)
    assert judgement["margin_worst_motion"] == pytest.approx(-25.0)
    assert judgement["note"].startswith("fails in the worst motion by 25 rad/s")
    # members keep fatigue
    members = over_members(
        "goodman_share", np.stack([everywhere(0.5), everywhere(0.9)]), fatigue_strength=("member", [3e8, 3e8])
    )
    judgement = one(Requirements(goodman_share=0.8), members.isel(member=0), members=members)
    assert (judgement["members"], judgement["share_of_members"]) == (2, 0.5)


@pytest.fixture
def judged():
    of = {"above": above(1100.0, 1120.0), "below": None}
    stress = xr.concat([response(shares) for shares in of.values()], "scene").assign_coords(scene=list(of))
    stress = stress.assign(max_von_mises_ever=2.0 * stress["share_of_revolutions_above_yield"], yield_stress=1.0)
    datasets = {"rms": stress[["status", "lined"]].expand_dims(blade=["Ref"]), "stress": stress.expand_dims(blade=["Ref"])}
    datasets["campbell"] = campbell().expand_dims(blade=["Ref"])
    pairs = [("Ref", "above"), ("Ref", "below")]
    needs = Requirements(above_yield=0.0, mass=0.1)
    nothing_tried = {"looks": {}, "not_looked": {}, "errors": dict.fromkeys(pairs, 0.0), "point_contact": ()}
    return verdict_table(pairs, needs, FLOWN, datasets, {"mass": {"Ref": 0.05}}, **nothing_tried), datasets, pairs


def test_the_verdict_of_a_run(judged, tmp_path):
    verdict, _, _ = judged
    assert verdict["requirement"].tolist() == ["above_yield", "mass"] * 2
    assert overall(verdict)["verdict"].tolist() == ["fails", "meets"]
    write_table(verdict, tmp_path / "verdict.csv")
    write_json({"config": {"requirements": {"mass_at_most_kg": 0.1, "campbell_margins": []}}}, tmp_path / "configuration.json")
    lines = closing(tmp_path).splitlines()
    assert lines[1].strip() == (
        "Ref in above fails: above_yield by 25 rad/s, 1097.5 to 1122.5 rad/s "
        f"({AT_LEAST}; over 25 of 200 rad/s, 20.9 to at least 29.1 rad/s in all that was tried, scatter 2 rad/s)"
    )
    assert lines[2].strip() == "Ref in below meets"


def test_each_pair_has_its_own_certainty_in_the_last_lines(tmp_path):
    pairs = [(blade, scene) for blade in ("A", "B") for scene in ("s", "t")]
    row = {"requirement": "mass", "verdict": MEETS, "value_lowest": 1.0, "value_highest": 1.0, "margin": 1.0, "unit": "kg"}
    rows = [{"blade": blade, "scene": scene, "scatter": number, **row} for number, (blade, scene) in enumerate(pairs, start=1)]
    write_table(pd.DataFrame(rows).assign(note="", members=np.nan, share_of_members=np.nan), tmp_path / "verdict.csv")
    expected = [
        f"  {blade} in {scene} meets: mass (scatter {number} kg)" for number, (blade, scene) in enumerate(pairs, start=1)
    ]
    assert closing(tmp_path).splitlines()[1:] == expected


def test_of_many_pairs_those_that_cannot_be_told_are_counted(tmp_path):
    verdicts = [MEETS] * 7 + [UNKNOWN] * 2
    row = {"scene": "s", "requirement": "mass", "note": "unknown"}
    write_table(
        pd.DataFrame([{"blade": f"B{i}", "verdict": each, **row} for i, each in enumerate(verdicts)]), tmp_path / "verdict.csv"
    )
    assert closing(tmp_path).startswith("7 of 9 pairs of blade and scene meet all requirements: B0 in s, ")
    assert closing(tmp_path).endswith("; of 2 one cannot tell")


@pytest.mark.parametrize(
    ("end", "where"), [(1050.0, ", the widest range 1000 to 1050 rad/s"), (1099.0, ", 1000 to 1099 rad/s")]
)
def test_a_range_that_is_clearly_shorter_than_the_length_is_the_widest_of_several(end, where):
    row = {"requirement": "above_yield", "verdict": FAILS, "value": 100.0, "margin": -100.0, "unit": "rad/s", "note": ""}
    row |= dict.fromkeys(("value_lowest", "value_highest"), 100.0) | {"scatter": 0.0, "share_of_members": np.nan}
    assert reason(pd.Series(row | {"from_rad_s": 1000.0, "to_rad_s": end})) == f"above_yield by 100 rad/s{where}"


@pytest.mark.parametrize(("first", "last", "gap"), [(1050.0, 1100.0, 195.0), (1050.0, 1055.0, 5.0), (1049.95, 1055.0, 50.0)])
def test_only_gaps_that_reach_into_the_operating_range_count(first, last, gap):
    runs = response().sel(speed=[1000.0, 1050.0, 1055.0, 1250.0, 1300.0])
    assert Evidence(runs, campbell=campbell(), operating=OperatingRange(first, last)).gap == gap


def test_a_verdict_of_a_run_before_is_not_told(judged, tmp_path):
    write_table(judged[0], tmp_path / "verdict.csv")
    write_table(pd.DataFrame({"blade": ["Ref"]}), tmp_path / "operating.csv")
    write_json({"config": {"requirements": {"campbell_margins": []}}}, tmp_path / "configuration.json")
    assert closing(tmp_path) == "1 line on what lies in operation"


def test_the_volume_of_a_mesh():
    """A box whose inner nodes are moved: elements of any shape fill it."""
    for element in ("wedge15", "tetra10", "hexahedron20"):
        mesh = box_mesh(0.4, 0.2, 0.3, (2, 2, 2), warp=0.1, element=element)
        assert mesh_volume(mesh.blocks, mesh.points) == pytest.approx(0.4 * 0.2 * 0.3, rel=1e-12)


def test_what_lies_in_the_operating_range(judged):
    _, datasets, pairs = judged
    interactions = pd.DataFrame(
        [("Ref", "above", "1B", 4, 1110.0), ("Ref", "above", np.nan, np.nan, 1290.0)],
        columns=["blade", "scene", "mode", "engine_order", "peak_speed_rad_s"],
    )
    table = operating_table(pairs, FLOWN, datasets, interactions)
    assert table["kind"].tolist() == ["crossing", "interaction", "above_yield", "ever_above_yield"]
    assert table["what"].tolist() == ["1B/4", "1B/4", "", ""]
    assert table.iloc[2][["from_rad_s", "to_rad_s", "length_rad_s", "time_share"]].tolist() == [1097.5, 1122.5, 25.0, 0.125]
    ranged = interactions.assign(scene=["above", "other"], some_revolutions_from_rad_s=1100.0, some_revolutions_to_rad_s=1300.0)
    table = operating_table(pairs, OperatingRange(1122.45, 1250.0), datasets, ranged)
    assert table["kind"].tolist() == ["crossing", "interaction", "above_yield", "ever_above_yield"]
    assert table.iloc[1:3]["from_rad_s"].tolist() == [1122.45] * 2 and table.iloc[1:3]["to_rad_s"].tolist() == [1250.0, 1122.5]


def joined(runs, scenes):
    """Runs of Ref in some scenes, alike, over the axes of a joined dataset."""
    return xr.concat([runs] * len(scenes), "scene").assign_coords(scene=scenes).expand_dims(blade=["Ref"])


def moved(shares, **more):
    """A response of runs that move and have a stress by their shares of revolutions above yield."""
    stresses = {f"max_von_mises{name}": 2.0 * shares for name in ("_ever", "_median", "_high")}
    runs = stressed(0.0, shares).assign({name: ("speed", values) for name, values in stresses.items()}).assign(more)
    rms = 1e-3 + 1e-2 * runs["share_of_revolutions_above_yield"].expand_dims(tip_point=["leading_edge"], axis=1)
    runs["status"] = runs["status"].astype("i1").assign_attrs(VARIABLES["status"].attributes)
    return runs.assign(rms_normal=rms, rms_tangential=rms)


@pytest.mark.parametrize("lined", [0.0, 1.0])
def test_tables_and_figure_have_the_further_runs_that_the_verdict_has(lined, tmp_path):
    """On a bare casing, too, where shares are smoothed, with those of speeds outside of operation."""
    sweep = moved(np.where(SPEEDS <= 1050.0, 0.9, 0.0), lined=lined).sel(speed=SPEEDS[::5])
    further = moved(above(1100.0, 1110.0) + 0.45 * above(1050.0, 1060.0), lined=lined).sel(speed=slice(1050.0, 1250.0))
    scenes = ["looked", "failed", "other"]
    write_dataset(joined_looks({REST: further, UP: sweep}), tmp_path / "looked.nc")
    write_dataset(joined_looks({}), tmp_path / "failed.nc")
    shares = ["share_of_revolutions_above_yield", *(name for name in sweep if str(name).startswith("max_"))]
    stress = sweep[["status", "lined", "yield_stress", *shares]]
    stress = stress.assign({name: stress[name].expand_dims(region=["airfoil", "root"], axis=1) for name in shares})
    rms = sweep[["status", "lined", "rms_normal", "rms_tangential"]]
    plain = {"rms": joined(rms, scenes), "stress": joined(stress, scenes)}
    with_campbell = plain | {"campbell": campbell().expand_dims(blade=["Ref"])}
    for name, dataset in with_campbell.items():
        write_dataset(dataset, tmp_path / f"{name}.nc")
    files = {name: tmp_path / f"{name}.nc" for name in [*with_campbell, FURTHER_RUNS]}
    pairs, looked = [["Ref", name] for name in scenes], [["Ref", name] for name in scenes[:2]]
    params = {"pairs": pairs, "looked": looked, "errors": [0.0] * 3, "point_contact": [], "operating": to_plain(FLOWN)}
    params |= {key: {} for key in ("not_looked", "densities", "clearance", "thickness")}
    params["requirements"] = to_plain(Requirements(above_yield=0.0))
    inputs = {name: files[name] for name in with_campbell} | {
        "volumes": [],
        "looks": [tmp_path / f"{_}.nc" for _ in scenes[:2]],
    }
    output = SimpleNamespace(verdict=tmp_path / "verdict.csv", runs=files[FURTHER_RUNS])
    steps.judge(inputs, output, SimpleNamespace(**params))
    datasets = plain | {FURTHER_RUNS: read_dataset(files[FURTHER_RUNS])}
    judgement = read_table(tmp_path / "verdict.csv").iloc[0]
    assert judgement["value"] == one(Requirements(above_yield=0.0), sweep, looks={REST: further})["value"] > 0.0

    for name in ("failed", "other"):
        xr.testing.assert_identical(response_of(datasets, "Ref", name), response_of(plain, "Ref", name))
    at_root = [response_of(some, "Ref", "looked", "root") for some in (datasets, plain)]
    xr.testing.assert_identical(*at_root)

    response = response_of(datasets, "Ref", "looked")
    assert response["speed"].values.tolist() == [*SPEEDS[:10:5], *SPEEDS[10:51], *SPEEDS[55::5]]
    xr.testing.assert_equal(response["rms_normal"].sel(speed=further["speed"]), further["rms_normal"])
    del files["campbell"]
    params = {"runs": pairs, "errors": [0.0] * 3, "contacts": {}, "operating": to_plain(FLOWN)}
    ranking(files, SimpleNamespace(table=tmp_path / "ranking.csv"), SimpleNamespace(**params))
    lengths = read_table(tmp_path / "ranking.csv").set_index("scene")["length_most_revolutions_operating_rad_s"]
    assert lengths["looked"] == judgement["value"] and lengths["other"] != lengths["looked"]
    with_campbell |= datasets
    write_table(summarise(with_campbell, InteractionChoice()), tmp_path / "summary.csv")
    interactions = read_table(tmp_path / "summary.csv")
    (row,) = interactions[(interactions["scene"] == "looked") & (interactions["peak_speed_rad_s"] > 1050.0)].to_dict("records")
    assert row["most_revolutions_from_rad_s"] == judgement["from_rad_s"] < 1110.0
    table = operating_table([("Ref", "looked")], FLOWN, with_campbell, interactions)
    (above_yield,) = table[table["kind"] == "above_yield"]["length_rad_s"]
    assert above_yield == judgement["value"]
    one_blade = {name: judged_region(dataset.sel(blade="Ref")) for name, dataset in datasets.items()}
    figure = draw_response("Ref", None, **one_blade)
    for axes in (figure.axes[0], figure.axes[2]):
        drawn = [len(line.get_xdata()) for line in axes.lines[:: 1 if axes is figure.axes[0] else 2][:3]]
        assert drawn == [response.sizes["speed"], *2 * [sweep.sizes["speed"]]]
    # the datasets of other pictures, each blade and scene as its response
    whole = with_further_runs("stress", judged_region(plain["stress"]), datasets[FURTHER_RUNS]).sel(blade="Ref", scene="looked")
    ran = whole.isel(speed=np.flatnonzero(whole["status"].values != RunStatus.NOT_RUN))
    for name in ("max_von_mises_ever", "share_of_revolutions_above_yield"):
        np.testing.assert_array_equal(ran[name], response[name])


@pytest.fixture
def with_requirements(config_copy):
    def read(**changes):
        return read_settings(config_copy, command_line_document({"blades": ["Ref"], **changes}))

    return read


RANGE = {"idle_rad_s": 1100.0, "redline_rad_s": 1300.0}


def margin(mode, orders, percent=5, operating=RANGE):
    """Sections with a margin of a mode's crossings with these engine orders."""
    of_mode = {"mode": mode, "engine_orders": orders, "at_least_percent": percent}
    return {"operating": operating, "requirements": {"campbell_margins": [of_mode]}}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"requirements": {"mass_at_most_kg": 1.0}}, "requirements without operating"),
        (margin("3B", [4]), "'3B'; allowed: 1B, 1T, 2B, 4"),
        (margin("1T-1T", [4]), r"'1T-1T'; allowed: .*, or two of them as 7-5 or 5\+7"),
        (margin("1B+1T+2B", [4]), "found '1B"),
        (margin("1B", [99]), "99; allowed: at most campbell.highest_engine_order"),
        ({"operating": RANGE, "requirements": {"mass_at_most_kg": -1.0}}, "-1"),
        (margin("1B", []), "found none"),
        (margin("1B", [4, 4]), "4 of 1B twice"),
        (margin("1T", [8], 3, RANGE | {"redline_rad_s": 1990.0}), "crossings up to 2051.55 rad/s count"),
    ],
)
def test_requirement_refusals(with_requirements, changes, message):
    with pytest.raises(ConfigError, match=message):
        with_requirements(**changes)


def test_a_range_that_is_not_run_is_remarked_on(with_requirements):
    settings = with_requirements(operating=RANGE, speeds=[1150.0], scenes=["direct"])
    (line,) = remarks(settings)
    assert "Ref in direct do not reach over 1100 to 1300 rad/s" in line
    assert not remarks(with_requirements(operating=RANGE))
    # 80 from rest, 40 up and down each, 24 in ten other ways
    needs = {"above_yield_at_most_rad_s": 0}
    (line,) = remarks(with_requirements(operating=RANGE, requirements=needs, scenes=["direct"]))
    assert "up to about 400 further runs of each blade and scene (1)" in line
    assert not remarks(with_requirements(operating=RANGE, requirements={"mass_at_most_kg": 1.0}))


def test_what_no_run_can_tell_is_said_beforehand(with_requirements):
    needs = {"goodman_share_at_most": 1.0, "used_lining_at_most_percent": 50.0}
    first, second, _ = remarks(with_requirements(operating=RANGE, requirements=needs, scenes=["abradable", "direct"]))
    assert first == "requirements: goodman_share cannot be told without fatigue among the results of abradable, direct"
    assert second.startswith("requirements: goodman_share cannot be told of Ref") and "fatigue_strength_pa" in second
    (line,) = remarks(with_requirements(operating=RANGE, requirements={"miner_sum_at_most": 1.0}, scenes=["direct"]))
    assert line.startswith("requirements: miner_sum cannot be told of Ref") and line.endswith("material.fatigue_exponent")


def test_what_moves_no_run_runs_no_further_runs_again(with_requirements):
    """Neither a limit on the mass nor a dwell; a limit on runs does."""

    def params(needs, **operating):
        settings = with_requirements(operating=RANGE | operating, requirements=needs)
        stage = Judged(Sweep(settings)).looks(SimpleNamespace(sweep={}))
        return stage.params["requirements"], stage.params["operating"]

    dwell = {"from_rad_s": 1150.0, "to_rad_s": 1160.0, "share_percent": 50.0}
    wanted = params({"above_yield_at_most_rad_s": 0.0})
    assert params({"above_yield_at_most_rad_s": 0.0, "mass_at_most_kg": 1.0}, dwell=[dwell]) == wanted
    assert params({"above_yield_at_most_rad_s": 5.0}) != wanted


def test_the_clearance_is_the_smallest_of_a_run_that_changes_it():
    changing = replace(DIRECT.casing, clearance=4e-4, change_revolutions=(0.0, 5.0, 9.0), change=(0.0, -1e-4, 5e-5))
    settings = SimpleNamespace(scenes={"closing": SimpleNamespace(scene=replace(DIRECT, casing=changing))})
    assert Judged(Sweep(settings)).clearance == {"closing": pytest.approx(3e-4)}


def test_further_runs_that_take_too_long_are_left_out(with_requirements):
    """A thousand revolutions with the published step: 80 of them do not, 400 do."""
    asked = {"fidelity": "paper", "scenes": ["direct"], "requirements": {"above_yield_at_most_rad_s": 0.0}}
    for idle, reasons in ((1100.0, []), (300.0, ["no further runs, which take too long with steps of 1e-07 s"])):
        settings = with_requirements(operating=RANGE | {"idle_rad_s": idle}, **asked)
        assert list(Judged(Sweep(settings)).not_looked.values()) == reasons


def test_the_coarser_mesh_has_half_the_nodes(with_requirements):
    """Nor is it that of another tip line, or of a mesh that another program made."""
    settings = with_requirements()
    judged, place = Judged(Sweep(settings)), SimpleNamespace(blade="Ref", scene="direct")
    nodes = settings.fidelity.mesh.nodes // 2
    name = ModelChoice(nodes, 8, settings.fidelity.reduction.fixed_interface_modes, "submesh").name
    folder = f"<results>/cases/Ref/{name}"
    assert judged.coarser_model(place) == {"coarser_contact": f"{folder}/contact.npz", "coarser_rom": f"{folder}/rom.nc"}
    other = with_requirements(scenes=["direct"])
    other.scenes["direct"] = replace(other.scenes["direct"], tip_line="camber")
    assert Judged(Sweep(other)).coarser_model(place) == {}
