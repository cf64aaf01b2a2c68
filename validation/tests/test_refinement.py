"""The study of adaptive speed sampling: what the rounds miss of every speed, on made-up responses."""

from dataclasses import replace

import numpy as np
import pytest
from refinement_cases import CHOICE, PLAN, campbell, replay, spiked

from r37core.config import ConfigError, command_line_document
from r37core.product.reading import read_settings
from r37core.results.interactions import InteractionChoice
from r37core.tolerances.members import members_of
from validation.studies.refinement import cases as refinement
from validation.studies.refinement.report import above_yield, compare, errors_between, plain_grid, refinement_table

REFINED = {
    "blades": ["Ref", "L50"],
    "scenes": ["abradable", "direct"],
    "speeds": [{"start": 900, "stop": 1000, "step": 50, "refine_to": 5}],
}


@pytest.fixture
def refining(root):
    return read_settings(root, command_line_document(REFINED))


def test_study_names_what_is_missed():
    """Of two interactions above yield the one in the window is found, the other one, 5 rad/s wide, only by every speed."""
    response, diagram = spiked((1232.0, 1237.0, 1e-3), (1832.0, 1836.0, 1e-3)), campbell([1200.0])
    found = compare(response, diagram, replay(response, diagram, PLAN, CHOICE), InteractionChoice())
    rows = [(one.interaction.peak.peak_speed_rad_s, one.nearest is not None, one.same) for one in found.interactions]
    assert rows == [(1237.0, True, True), (1836.0, False, False)]
    every = compare(response, diagram, [plain_grid(PLAN, 1.0)], InteractionChoice())
    assert (every.runs, [one.same for one in every.interactions]) == (1251, [True, True])
    table = refinement_table({"refined": {("Ref", "abradable"): found}, "every 1 rad/s": {("Ref", "abradable"): every}},
                             {("Ref", "abradable"): 1251})  # fmt: skip
    assert f"1 found, 1 the same, {found.runs} runs in {found.rounds} rounds | 2 found, 2 the same, 1251 runs |" in table
    assert "| 1836, 3.1 | 2.04 | none |" in table.split("Missed")[1]
    assert "1237" not in table.split("Missed")[1]
    assert "robust" not in table.split("|", 1)[1]


def test_study_says_what_is_robust():
    """One interaction is shown by all three members, one by a single member: it is not robust, and nothing robust is missed."""
    both, one = ((1232.0, 1237.0, 1e-3), (1832.0, 1836.0, 1e-3)), ((1234.0, 1240.0, 1e-3),)
    response, diagram = spiked(*both), campbell([1200.0])
    several = {name: spiked(*spikes) for name, spikes in {"0": one, "1": both, "2": one}.items()}
    members = {name: above_yield(member, diagram, InteractionChoice()) for name, member in several.items()}
    found = compare(response, diagram, replay(response, diagram, PLAN, CHOICE), InteractionChoice(), members)
    assert [(one.nearest is not None, one.robust, one.share_of_members) for one in found.interactions] == [
        (True, True, 1.0),
        (False, False, pytest.approx(1 / 3)),
    ]
    place = ("Ref", "abradable")
    table = refinement_table({"refined": {place: found}}, {place: 1251})
    assert "| 2, 1 robust, in 1251 runs | 1 found, 1 of the robust, 1 the same" in table
    assert "| none | 33% |" in table


def test_errors_between_the_speeds_that_are_run():
    """Of a response with one spike: a line over it misses the spike, and nothing else."""
    response = spiked()
    for name in ("rms_normal", "max_von_mises"):
        response[name][:] = 1.0
        response[name].loc[{"speed": 1000.0}] = 3.0
    share = 2.0 / (1251 + 2)
    assert errors_between(response, [750.0, 999.0, 1001.0, 2000.0]) == pytest.approx((share, share, 2.0 / 3.0))
    assert errors_between(response, [750.0, 999.0, 1000.0, 1001.0, 2000.0]) == (0.0, 0.0, 0.0)
    diverged = response.copy(deep=True)
    diverged["max_von_mises"].loc[{"speed": 1000.0}] = np.nan
    assert errors_between(diverged, [750.0, 2000.0])[1:] == (0.0, 0.0)
    assert np.isnan(errors_between(response.drop_vars("max_von_mises"), [750.0, 2000.0])[1:]).all()


def test_plain_grids_beside_are_part_of_the_whole_one(refining):
    assert refinement.plain_steps(refining) == [5.0, 20.0]
    whole = refinement.cases(refining)["Ref__abradable"]
    assert list(whole.speeds) == [900.0 + 5.0 * place for place in range(21)]


def test_members_are_run_at_every_speed_too(root):
    """Beside the nominal runs of the study, as cases of their own, in scenes that have the numbers."""
    tolerances = {"members": 2, "of_scenes": {"lining.bar_width_m": {"between": [8e-4, 1.25e-3]}}}
    settings = read_settings(root, command_line_document({**REFINED, "blades": ["Ref"], "tolerances": tolerances}))
    cases, members = refinement.cases(settings), refinement.values(settings)["members"]
    assert list(cases) == ["Ref__abradable", "Ref__direct", "Ref__abradable/0", "Ref__abradable/1"]
    assert members == {"Ref__abradable": {"0": "Ref__abradable/0", "1": "Ref__abradable/1"}}
    nominal, member = cases["Ref__abradable"], cases["Ref__abradable/1"]
    assert member.scene == members_of(settings).all["Ref", "abradable"]["1"].scene != nominal.scene
    assert replace(member, scene=nominal.scene, what=nominal.what) == nominal
    of_blades = {"of_blades": {"thickness_percent": {"normal": 1}}}
    settings = read_settings(root, command_line_document({**REFINED, "blades": ["Ref"], "tolerances": of_blades}))
    with pytest.raises(ConfigError, match="found thickness_percent; allowed: of_scenes alone"):
        refinement.cases(settings)
