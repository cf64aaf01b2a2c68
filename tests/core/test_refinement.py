"""Adaptive speed sampling: what a range asks for, where a round looks next, what comes of it; and speeds in rpm."""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refinement_cases import CHOICE, GRID, PLAN, STRESS, WINDOWS, asked, campbell, spiked

from r37core.adaptive.criterion import RefinementChoice, dense_ranges, next_speeds, window_speeds
from r37core.adaptive.rounds import Round, first_round, measure_members, read_round, round_after, write_round
from r37core.adaptive.steps import refine as refine_step
from r37core.base.io import Named
from r37core.base.plain import from_plain, to_plain
from r37core.base.speeds import RefinedRange, SpeedPlan, exact_text, plan_speeds
from r37core.config import command_line_document
from r37core.config.settings import merged_settings
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import load_settings, read_settings
from r37core.results.events import Danger
from r37core.time_integration.speed_file import write_speed


def test_a_range_has_its_coarse_speeds_and_its_end():
    plan = plan_speeds([{"start": 900, "stop": 1000.5, "step": 30, "refine_to": 1.5}], 8.0)
    assert plan.certain == (900.0, 930.0, 960.0, 990.0, 1000.5)
    assert plan.refined == (RefinedRange(900.0, 1.5, 20, 67),)
    assert len(plan.every_speed()) == 68
    assert from_plain(SpeedPlan, to_plain(plan)) == plan
    assert plan_speeds([{"start": 900, "stop": 1000, "refine_to": 1}], 8.0).refined[0].coarse == 8
    assert PLAN.speed_count(0.2) == 250
    # 0.1 is no binary number: the speeds of a grid still are what a user would write
    grid = plan_speeds([{"start": 750, "stop": 752, "step": 0.4, "refine_to": 0.1}], 8.0).refined[0]
    assert [exact_text(speed) for speed in grid.every_speed()[:5]] == ["750", "750.1", "750.2", "750.3", "750.4"]
    assert plan_speeds([{"start": 1.0, "stop": 1.3, "step": 0.1}], 1.0).certain == (1.0, 1.1, 1.2, 1.3)
    # a number inside a range is no repetition
    plan = plan_speeds([{"start": 900, "stop": 1000, "step": 20, "refine_to": 1}, 920, 933, 933.5], 8.0)
    assert plan.certain == (900.0, 920.0, 933.0, 933.5, 940.0, 960.0, 980.0, 1000.0)
    assert plan.speed_count(0.2) == 20 + 2


def test_windows_lie_above_crossings():
    assert dense_ranges(campbell([1200.0]), WINDOWS) == [(1200.0, 1260.0, 5.0)]
    # orders above the highest of a window have none
    assert dense_ranges(campbell([1200.0, 960.0]), (replace(WINDOWS[0], highest_engine_order=3),)) == []


def asked_of(values):
    """Middles of intervals that are asked for next, of a curve over the coarse speeds from 750 to 2000 in steps of 20."""
    rows = {speed: [0, value, 1e-6, 0.0] for speed, value in zip(PLAN.certain, values, strict=True)}
    return next_speeds(GRID, rows, replace(CHOICE, largest_share=1.0))


def test_a_change_counts_where_the_larger_value_does():
    """From 0.06 to 0.13 of the top: more than a quarter of the larger, which is above a tenth of the top."""
    values = np.minimum(0.13 * 1.1 ** np.maximum(np.arange(len(PLAN.certain)) - 3.0, 0.0), 1.0)
    values[:3] = 0.06
    assert min(asked_of(values)) == 800.0
    values[:3] = 0.1
    assert min(asked_of(values)) > 1000.0


def test_a_steep_change_counts_though_it_is_low():
    """The foot of an interaction between two speeds: a fall by more than four fifths, from 2% of the top."""
    values = np.full(len(PLAN.certain), 1e-3)
    values[40:] = np.linspace(0.5, 1.0, len(values) - 40)
    values[10:12] = 0.0105, 0.002
    foot = PLAN.certain[10] + 10.0
    assert foot in asked_of(values)
    assert PLAN.certain[10] - 10.0 in asked_of(values)
    for other in (0.0095, 0.002), (0.0105, 0.0022):
        values[10:12] = other
        assert foot not in asked_of(values)


def test_both_flanks_of_a_peak_of_one_speed_are_looked_at():
    values = np.full(len(PLAN.certain), 0.85)
    values[10] = 1.0
    peak = PLAN.certain[10]
    assert asked_of(values) == [peak - 10.0, peak + 10.0]


def test_a_value_at_the_share_of_a_peak_belongs_to_it():
    heights = np.full(len(PLAN.certain), 0.1)
    heights[9:12], heights[40] = (0.2, 0.5, 0.25), 1.0
    rows = {speed: [0, height, 0.0, 0.0] for speed, height in zip(PLAN.certain, heights, strict=True)}
    alone = replace(CHOICE, change=2.0, steep_change=2.0, largest_share=1.0)
    for share, places in ((0.5, (9, 10, 11, 39, 40)), (0.49, (9, 10, 39, 40))):
        asked = next_speeds(GRID, rows, replace(alone, peak=share))
        assert asked == [PLAN.certain[place] + 10.0 for place in places]


def test_a_branch_its_peak_and_its_drop_are_found_to_one_grid_step():
    rounds, speeds = asked(spiked((1600.0, 1727.0, 1e-3)))
    assert {1726.0, 1727.0, 1728.0} <= set(speeds)
    assert len(speeds) < 0.15 * len(PLAN.every_speed())
    assert len(rounds) <= 6


def test_a_narrow_interaction_in_a_window_and_borders_of_danger_are_found():
    response = spiked((1232.0, 1237.0, 1e-3))
    assert {1237.0, 1238.0} <= set(asked(response, [1200.0])[1])
    assert 1237.0 not in asked(response)[1]
    for kind in ("diverged", "left"):
        assert {1499.0, 1500.0, 1570.0, 1571.0} <= set(asked(spiked(**{kind: range(1500, 1571)}))[1])


def test_where_stress_crosses_yield_is_found():
    """Stress rises with the speed, by too little from speed to speed to be a change."""
    response = spiked()
    response["rms_normal"][:] = response["rms_tangential"][:] = 1e-3
    response[STRESS][:] = np.linspace(0.7e9, 1.1e9, 1251)
    crossing = 750.0 + 1250.0 * 0.3 / 0.4
    speeds = np.array(asked(response, choice=replace(CHOICE, prominence=0.5))[1])
    assert speeds[speeds > crossing][0] - speeds[speeds < crossing][-1] <= 1.0


def test_a_flat_response_asks_for_no_more():
    flat = spiked()
    flat["rms_normal"][:] = flat["rms_tangential"][:] = 1e-5
    flat[STRESS][:] = 1e7
    silent = spiked()
    for name in ("rms_normal", "rms_tangential", STRESS):
        silent[name][:] = 0.0
    assert asked(flat)[0] == asked(silent)[0] == asked(spiked())[0] == [list(PLAN.certain)]


def test_the_share_is_kept_and_the_largest_goes_first():
    noise = spiked((1600.0, 1727.0, 1e-3))
    noise["rms_normal"][:] *= 1.0 + 0.9 * np.random.default_rng(1).random((1251, 1))
    _, speeds = asked(noise, choice=replace(CHOICE, largest_share=0.1))
    assert len(speeds) <= 125
    added = set(speeds) - set(PLAN.certain)
    assert added
    assert all(1600.0 <= speed <= 1740.0 for speed in added)


@pytest.mark.parametrize(("left", "next_round"), [(50, 25), (20, 16), (10, 10), (0, 0), (-5, 0)])
def test_a_round_takes_half_of_what_is_left_or_the_last_sixteen(left, next_round):
    """Each round makes Snakemake plan again, so none is asked for a speed or two."""
    rows = {speed: [0, 1.0 + number % 2, 1.0, 0.1] for number, speed in enumerate(PLAN.certain)}
    share = (len(PLAN.certain) + left + 0.5) / 1251
    assert len(next_speeds(GRID, rows, replace(CHOICE, largest_share=share))) == next_round


def test_diverged_and_missing_numbers_are_no_peaks_nor_are_speeds_off_the_grid():
    rows = {speed: [Danger.DANGEROUS, np.nan, np.nan, np.nan] for speed in PLAN.certain}
    assert next_speeds(GRID, rows, CHOICE) == []
    plan = plan_speeds([{"start": 750, "stop": 2000, "step": 20, "refine_to": 1}, 999.5, 2500], 8.0)
    rows = {speed: [0, 1e-5, 1e-5, 0.1] for speed in plan.certain} | {999.5: [0, 1.0, 1.0, 9.0], 2500.0: [0, 1.0, 1.0, 9.0]}
    assert next_speeds(plan.refined[0], rows, CHOICE) == []


@given(st.lists(st.floats(0.0, 1.0), min_size=101, max_size=101), st.floats(0.1, 1.0), st.integers(1, 20))
def test_any_response_ends_in_speeds_of_the_grid_each_once(values, share, coarse):
    plan = SpeedPlan((), (RefinedRange(100.0, 0.1, coarse, 100),))
    plan = replace(plan, certain=tuple(plan.refined[0].speed(place) for place in plan.refined[0].coarse_indices()))
    rows = {speed: [0, value, value**2, 2.0 * value] for speed, value in zip(plan.every_speed(), values, strict=True)}
    one = first_round(plan, campbell([]), choice := replace(CHOICE, largest_share=share))
    run = list(one.new)
    for _ in range(100):
        one = round_after(one, {speed: rows[speed] for speed in one.new}, plan, choice)
        if not one.new:
            break
        run += one.new
    assert not one.new
    assert len(set(run)) == len(run)
    assert set(run) <= set(plan.every_speed())
    assert len(run) <= max(len(plan.certain), int(share * 101))


def test_a_round_s_file_says_what_it_was(tmp_path):
    one = Round((900.1, 1000.0), {850.0: [0, 1e-5, 0.1 + 0.2, np.nan], 860.0: [1, np.nan, np.nan, np.nan]})
    write_round(one, tmp_path / "round_3.json")
    again = read_round(tmp_path / "round_3.json")
    assert again.new == one.new
    np.testing.assert_equal(dict(again.measured), dict(one.measured))
    assert "NaN" not in (tmp_path / "round_3.json").read_text()


def run(history=(), hot_from=None, **more):
    """Arrays of a run of 100 revolutions: its stress in each, Pa, and its heat, which melts the tip from one on."""
    heat = np.zeros(100) if hot_from is None else np.where(np.arange(1, 101) < hot_from, 0.0, 200.0)
    return {
        "status": np.array(0),
        "speed": np.array(900.0),
        "diverged_revolution": np.array(np.nan),
        "rms_normal": np.array([0.0, 3.0]),
        "rms_tangential": np.array([2.0, 5.0]),
        "revolution_maximum": np.zeros((100, 2)),
        "statistic_end": np.array(100),
        "friction_heat": heat[-1],
        "heat_so_far": heat,
        "melting_power": np.array(100.0),
        **({"revolution_von_mises": np.array([history])} if len(history) else {}),
        **more,
    }


EARLY = np.where(np.arange(1, 101) == 3, 9.0, 0.5)
"""A stress (Pa) that is high in the third revolution alone."""
DIVERGED = {"status": np.array(1), "diverged_revolution": np.array(50.0)}


@pytest.mark.parametrize(
    ("numbers", "danger", "stress"),
    [
        # the last revolution does not decide
        (run(EARLY), Danger.DANGEROUS, 9.0 / 8.0),
        (run(0.5 * EARLY), Danger.BELOW, 4.5 / 8.0),
        (run(EARLY, hot_from=2), Danger.UNKNOWN, 0.5 / 8.0),
        (run(0.5 * EARLY, hot_from=10), Danger.UNKNOWN, 4.5 / 8.0),
        (run(EARLY, hot_from=10), Danger.DANGEROUS, 9.0 / 8.0),
        (run(0.5 * EARLY, **DIVERGED), Danger.DANGEROUS, 4.5 / 8.0),
        # a blade given by matrices has no stress
        (run(), Danger.BELOW, np.nan),
        (run(hot_from=2), Danger.UNKNOWN, np.nan),
        (run(**DIVERGED), Danger.DANGEROUS, np.nan),
    ],
)
def test_danger_and_curves_of_runs(tmp_path, numbers, danger, stress):
    write_speed(numbers, tmp_path / "one.npz", {})
    gave = measure_members([8.0, 16.0], [900.0], [tmp_path / "one.npz"] * 2)
    np.testing.assert_equal(gave[900.0][:4], [danger, 0.0, 2.0, stress])
    np.testing.assert_equal(gave[900.0][7], stress / 2.0)


def test_a_round_of_a_blade_without_stress(tmp_path):
    write_round(Round((900.0,)), tmp_path / "round_0.json")
    write_speed(run(), tmp_path / "speed_900.npz", {})
    params = {"plan": to_plain(SpeedPlan((900.0,))), "choice": to_plain(CHOICE)}
    files = Named(before=tmp_path / "round_0.json", speeds=str(tmp_path / "speed_900.npz"))
    refine_step(files, Named(round=tmp_path / "round_1.json"), Named(**params, yield_stress=math.inf))
    danger, normal, _, stress = read_round(tmp_path / "round_1.json").measured[900.0]
    assert (danger, normal) == (Danger.BELOW, 0.0)
    assert np.isnan(stress)


def test_a_window_is_halved_to_the_end():
    """Where a window only touches it is not halved."""
    grid = RefinedRange(1000.0, 1.0, 8, 16)
    window = (1000.0, 1008.0, 1.0)
    assert window_speeds(grid, [window]) == [float(speed) for speed in range(1001, 1008)]
    # an interval that is as long as asked for stays
    assert window_speeds(grid, [(1000.0, 1008.0, 2.0)]) == [1002.0, 1004.0, 1006.0]
    # as far as the second interval's first speed and no farther; and from the first one's last
    assert window_speeds(grid, [(990.0, 1000.0, 1.0)]) == []
    assert window_speeds(grid, [(1016.0, 1030.0, 1.0)]) == []


RAD_S = math.pi / 30.0
PLACE = SimpleNamespace(blade="Ref", scene="direct")


def on_command_line(root, **changes):
    return read_settings(root, command_line_document({"blades": ["Ref"], "scenes": ["direct"], **changes}))


def test_numbers_and_ranges_are_converted_once():
    plan = plan_speeds([{"start": 8000, "stop": 8200, "step": 100}, 10000.5], 8.0, "rpm")
    assert plan.certain == (8000 * RAD_S, 8100 * RAD_S, 8200 * RAD_S, 10000.5 * RAD_S)
    # without a step the level's, which is in rad/s
    assert plan_speeds([{"start": 10000, "stop": 10200}], 8.0, "rpm").certain[1] == pytest.approx(10000 * RAD_S + 8.0)


def test_ranges_in_rpm_refine_themselves_on_their_own_grid():
    plan = plan_speeds([{"start": 8000, "stop": 9000, "step": 200, "refine_to": 10}, 8200, 8203], 8.0, "rpm")
    (grid,) = plan.refined
    assert (grid.coarse, grid.last, grid.interval) == (20, 100, 10 * RAD_S)
    # 8200 is on the grid and 8203 is not
    assert plan.certain == tuple(rpm * RAD_S for rpm in (8000, 8200, 8203, 8400, 8600, 8800, 9000))
    assert from_plain(SpeedPlan, json.loads(json.dumps(to_plain(plan)))) == plan
    # a peak at one end is followed there, on speeds of the grid
    choice = RefinementChoice(
        windows=(), change=0.25, peak=0.1, largest_share=1.0, prominence=0.1, steep_change=1, steep_prominence=1
    )
    known = {speed: (0, height, height, 0.0) for speed, height in zip(plan.certain, (9, 1, 1, 1, 1, 1, 1), strict=True)}
    assert next_speeds(grid, known, choice) == [8100 * RAD_S]


def test_the_command_line_replaces_the_other_unit(root):
    """config.yaml has `speeds`; Snakemake hands numbers inside lists on as texts."""
    settings = on_command_line(root, speeds_rpm=["8000", {"start": "9000", "stop": "9100", "step": "50"}])
    certain = settings.speed_plans["Ref", "direct"].certain
    assert certain == tuple(rpm * RAD_S for rpm in (8000, 9000, 9050, 9100))
    # what a run keeps of its configuration can be read again
    kept = json.loads(json.dumps(merged_settings(settings)["config"]))
    assert "speeds" not in kept
    assert load_settings(kept, root).speed_plans == settings.speed_plans
    back = read_settings(root, command_line_document({"speeds_rpm": [8000]}), command_line_document({"speeds": [900]}))
    assert back.speed_plans["Ref", "direct"].certain == (900.0,)


def test_file_names_stay_exact_and_in_rad_s_and_rules_have_either_unit(root):
    settings = on_command_line(root, speeds_rpm=[8000, 16000.1])
    sweep = Sweep(settings)
    files = sweep.speed_files(PLACE)
    assert files[0] == f"<results>/Ref/direct/speed_{exact_text(8000 * RAD_S)}.npz"
    assert sweep.speeds(PLACE, SimpleNamespace(speeds=files)) == [8000 * RAD_S, 16000.1 * RAD_S]
    settings = on_command_line(root, speeds=[900], speeds_for=[{"scenes": ["direct"], "speeds_rpm": [8000]}])
    assert settings.speed_plans["Ref", "direct"].certain == (8000 * RAD_S,)


def test_histories_at_speeds_in_rpm(root, config_copy):
    scenes = config_copy / "config/scenes.yaml"
    text = scenes.read_text()
    scenes.write_text(text.replace("direct:\n", "direct:\n  stress_history_speeds_rpm: [9000]\n", 1))
    settings = on_command_line(config_copy, speeds_rpm=[8000, 9000])
    assert settings.scenes["direct"].stress_history_speeds == (9000 * RAD_S,)
