"""Speeds given in revolutions per minute: the same plan in rad/s, exact file names, one unit at a time."""

import json
import math
from types import SimpleNamespace

import pytest

from r37core.adaptive.criterion import RefinementChoice, next_speeds
from r37core.base.plain import from_plain, to_plain
from r37core.base.speeds import SpeedPlan, exact_text, plan_speeds
from r37core.config import ConfigError, command_line_document
from r37core.exports.plan import Exports
from r37core.plans.sweep_plan import Sweep
from r37core.product.reading import load_settings, read_settings

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
    kept = json.loads(json.dumps(settings.merged()["config"]))
    assert "speeds" not in kept
    assert load_settings(kept, root).speed_plans == settings.speed_plans
    back = read_settings(root, command_line_document({"speeds_rpm": [8000]}), command_line_document({"speeds": [900]}))
    assert back.speed_plans["Ref", "direct"].certain == (900.0,)


def test_file_names_stay_exact_and_in_rad_s(root):
    settings = on_command_line(root, speeds_rpm=[8000, 16000.1])
    sweep = Sweep(settings)
    files = sweep.speed_files(PLACE)
    assert files[0] == f"<results>/Ref/direct/speed_{exact_text(8000 * RAD_S)}.npz"
    assert sweep.speeds(PLACE, SimpleNamespace(speeds=files)) == [8000 * RAD_S, 16000.1 * RAD_S]


def test_rules_have_either_unit(root):
    settings = on_command_line(root, speeds=[900], speeds_for=[{"scenes": ["direct"], "speeds_rpm": [8000]}])
    assert settings.speed_plans["Ref", "direct"].certain == (8000 * RAD_S,)


def refined(start, step=20):
    return {"start": start, "stop": start + 500, "step": step, "refine_to": 10}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"speeds": [900], "speeds_rpm": [8000]}, r"--config: speeds_rpm: found both speeds and speeds_rpm; allowed: one"),
        ({"speeds_for": [{"speeds": [900], "speeds_rpm": [8000]}]}, r"speeds_for\.0\.speeds_rpm: found both speeds and sp"),
        ({"speeds_for": [{"blades": ["Ref"]}]}, r"speeds_for\.0: found neither speeds nor speeds_rpm; allowed: one of them"),
        ({"speeds_rpm": [{"start": 9000, "stop": 8000}]}, r"speeds_rpm\.0: found a range from 9000 to 8000"),
        ({"speeds_rpm": [8000, 8000]}, r"speeds_rpm: found 8000 rpm twice"),
        ({"speeds_rpm": [{"start": 1, "stop": 9e6, "step": 0.01}]}, r"speeds_rpm: .* from 1 to 9e\+06 rpm in steps of 0.01"),
        ({"speeds_rpm": [refined(8000, step=25)]}, "speeds_rpm: .*refine_to 10 with steps of 25 rpm"),
        ({"speeds_rpm": [refined(8000), refined(8400)]}, "speeds_rpm: .*overlap, from 8400 to 8500 rpm"),
        ({"speeds_rpm": [0.001]}, r"speeds_rpm\.0: found 0\.001; allowed:.* at least 0\.01"),
        ({"speeds_rpm": [8000], "exports": {"stress_speeds_rpm": [9000]}}, r"exports\.stress_speeds_rpm\.0: found 9000; all"),
        (
            {"speeds_rpm": [8000], "exports": {"stress_speeds_rad_s": "all", "stress_speeds_rpm": [8000]}},
            r"found both stress_speeds_rad_s and stress_speeds_rpm",
        ),
        (
            {"signals": {"speeds_rpm": [12000], "speeds_rad_s": "interactions"}},
            r"signals\.speeds_rpm: found both speeds_rad_s and speeds_rpm; allowed: one of them",
        ),
    ],
)
def test_refusals(root, changes, message):
    with pytest.raises(ConfigError, match=message):
        on_command_line(root, **changes)


def test_exports_name_speeds_in_rpm(root):
    settings = on_command_line(root, speeds_rpm=[8000, 9000], exports={"stress_speeds_rpm": [9000]})
    exported = Exports(Sweep(settings))
    assert not exported.only_worst(PLACE)
    assert exported.speed_files(PLACE) == [f"<results>/Ref/direct/speed_{exact_text(9000 * RAD_S)}.npz"]


def test_histories_at_speeds_in_rpm(root, config_copy):
    scenes = config_copy / "config/scenes.yaml"
    text = scenes.read_text()
    scenes.write_text(text.replace("direct:\n", "direct:\n  stress_history_speeds_rpm: [9000]\n", 1))
    settings = on_command_line(config_copy, speeds_rpm=[8000, 9000])
    assert settings.scenes["direct"].stress_history_speeds == (9000 * RAD_S,)
    with pytest.raises(ConfigError, match=r"direct\.stress_history_speeds_rpm: found 9000; allowed: speeds that are simulated"):
        on_command_line(config_copy, speeds_rpm=[8000])
    scenes.write_text(scenes.read_text().replace("_rpm: [9000]", "_rpm: [9000]\n  stress_history_speeds_rad_s: [900]"))
    with pytest.raises(ConfigError, match="found both stress_history_speeds_rad_s and stress_history_speeds_rpm"):
        on_command_line(config_copy, speeds_rpm=[9000])


def test_signals_at_speeds_in_rpm(root):
    given = {"signals": {"speeds_rpm": [12000, 9000.5]}}
    speeds = read_settings(root, command_line_document(given)).config.signals.speeds()
    assert speeds == [9000.5 * RAD_S, 12000 * RAD_S]
