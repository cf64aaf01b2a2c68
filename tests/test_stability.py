"""The extremes: how they are planned and judged, and small real runs of them."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from defaults import IntegrationChoice
from integration_cases import DIRECT
from overlays import overlay
from test_cases import case_of
from workflow_runs import snakemake

from r37core.base.dataset_file import read_dataset
from r37core.cases.case import HALF_STEP
from r37core.cases.plan import Cases
from r37core.cases.runner import run_case
from r37core.cases.table import case_table
from r37core.config import command_line_document
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.product.reading import read_settings
from r37core.stability import plan, steps
from r37core.stability.figures import COLOURS, draw_stability
from r37core.stability.steps import OUTCOMES, judge, words


def test_every_extreme_has_a_name_of_its_own_and_says_what_the_configuration_refuses(settings):
    planned = plan.cases(settings)
    # direct contact has no lining
    assert "bars_10__abradable" in planned and "bars_10__direct" not in planned
    assert len(planned) > 200
    expected = {"what": "speed_over_crossing", "value": "0.05", "scene": "direct"}
    assert words("speed_over_crossing_0.05__direct") == expected
    refused = [case.refused for case in planned.values() if case.scene is None]
    assert 0 < len(refused) < len(planned)
    assert all("found" in text and "allowed" in text for text in refused)


def test_an_extreme_is_run_from_what_it_needs(settings):
    cases = Cases(settings, "stability", plan.cases)
    assert set(cases.inputs(SimpleNamespace(case="lobes_5__direct"))) == {"contact", "cost", "campbell"}
    assert cases.inputs(SimpleNamespace(case="damping_ratio_1__direct")) == {}


def test_extremes_that_are_chosen(root):
    few = {"stability": {"extremes": ["lobes"], "scenes": ["direct"], "base": "draft"}}
    settings = read_settings(root, command_line_document(few))
    cases = plan.cases(settings)
    names = [name for name in cases if not name.endswith(HALF_STEP)]
    assert names == ["lobes_1__direct", "lobes_5__direct", "lobes_20__direct"]
    assert cases["lobes_1__direct"].model.nodes == 5000
    # another blade is run: there is nothing to make
    settings = read_settings(root, command_line_document({"blades": ["L50"], "stability": {"blade": "Ref"}}))
    assert filled(plan.EXTENSION.all_targets(Sweep(settings))) == [] and plan.cases(settings) == {}


@pytest.fixture
def judged(contact, tmp_path):
    """The row of a case, run with its own step and with half of it, with its outcome."""

    def judge_case(case):
        for name, each in (("case", case), ("half", replace(case, half_step=True))):
            run_case(each, contact, None, tmp_path / f"{name}.nc")
        responses = {name: read_dataset(tmp_path / f"{name}.nc") for name in ("case", "half")}
        rows = case_table(responses, steps.numbers).to_dict("index")
        outcome, detail = judge(rows["case"], rows["half"])
        return {**rows["case"], "outcome": outcome, "detail": detail}

    return judge_case


def test_judging_a_case(judged):
    choice = IntegrationChoice(2e-7, 4, 62)
    assert judged(case_of(choice))["outcome"] == "accurate"
    diverged = judged(case_of(choice, replace(DIRECT, divergence_limit=1e-6)))
    assert diverged["outcome"] == "diverged"
    assert np.isnan(diverged["rms_m"])
    refused = judged(case_of(replace(choice, time_step=2e-6)))
    assert refused["outcome"] == "refused"
    assert "stability limit" in refused["detail"]
    far = replace(DIRECT, casing=replace(DIRECT.casing, amplitude=0.0))
    assert judged(case_of(choice, far))["detail"] == "nothing touches"


def test_a_silent_wrong_number_is_no_accurate_run(judged, monkeypatch):
    monkeypatch.setattr(steps, "ENERGY_WITHIN", 1e-30)
    outcome = judged(case_of(IntegrationChoice(2e-7, 4, 62)))
    assert outcome["outcome"] == "unsound" and outcome["detail"].startswith("energy balance open by ")


def test_every_outcome_has_a_colour():
    assert tuple(COLOURS) == OUTCOMES
    rows = [(what, value, "direct", outcome) for what in ("lobes", "bars") for value, outcome in enumerate(OUTCOMES)]
    figure = draw_stability(pd.DataFrame(rows, columns=["what", "value", "scene", "outcome"]))
    assert [text.get_text() for text in figure.axes[0].get_yticklabels()] == ["lobes", "bars"]


@pytest.mark.slow
def test_extremes_of_a_small_sweep(compiled, project):
    overlay(project, "config.yaml", "stability: { extremes: [lobes, damping_ratio], scenes: [direct] }")
    said = snakemake(project, "stability", "--cores", "2")
    assert "stability: 7 extremes: " in said and "1 refused" in said
    table = pd.read_csv(project / "results/stability.csv")
    assert len(table) == 7 and not (table["outcome"] == "unsound").any()
    assert (project / "results/figures/stability.png").exists()
