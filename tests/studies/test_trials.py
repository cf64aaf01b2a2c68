"""Trials: cases, single runs next to the sweep, and their presets: tradeoff, the extremes of stability, the estimate."""

import json
import re
import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT
from workflow_runs import overlay

from r37core.base.plain import from_plain, to_plain
from r37core.config import command_line_document
from r37core.plans.extent import extent_of
from r37core.product.extensions import read_settings
from r37core.results.table_file import write_table
from r37studies.other_models import MODEL_NAME, OWN_MESH, ModelChoice
from r37studies.trials import case_table, estimate, estimate_tables, runner, stability, steps, tradeoff
from r37studies.trials.case import Case
from r37studies.trials.plan import Trials

CHOICE = IntegrationChoice(3.2e-6, 4, 62, integrator="exact_modal")


def case_of(choice=CHOICE, scene=DIRECT, speeds=(1500.0,), results=("energy",), **fields):
    kept = {"spectrum_highest_order": 12, "wear_angles": 100}
    return Case("Ref", "pressure_edge", scene, choice, speeds, results, **{"material": None, "kept": kept, **fields})


def test_cases_are_planned_without_what_runs_them():
    """The rules import the plans each time that Snakemake starts."""
    code = "import sys, r37studies.trials.plan; print(*{'netCDF4', 'matplotlib', 'xarray', 'pyvista'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def test_a_case_is_plain_data():
    lined = case_of(scene=replace(ABRADABLE, friction=None), crossing="1B")
    model = ModelChoice(OWN_MESH, 8, 10)
    for case in (lined, replace(lined, model=model)):
        assert from_plain(Case, json.loads(json.dumps(to_plain(case)))) == case
    assert re.fullmatch(MODEL_NAME, model.name) and ModelChoice.named(model.name) == model


def diagram(*speeds):
    """Crossings of 1B with the engine orders from 2 on, up to 2000 rad/s."""
    crossing = xr.DataArray([speeds], {"mode": ["1B"], "engine_order": range(2, 2 + len(speeds))})
    return xr.Dataset({"crossing_speed": crossing}, {"speed": [0.0, 2000.0]})


def test_the_fastest_crossing_inside_the_diagram_counts():
    def crossing(campbell, highest_share):
        return steps.crossing_speed(campbell, case_of(speeds=(highest_share,), crossing="1B"))

    crossings = diagram(np.nan, 1990.0, 1600.0, 1200.0)
    assert crossing(crossings, 1.0) == 1990.0
    assert crossing(crossings, 1.1) == 1600.0
    # the only one, though the speeds above it lie outside
    assert crossing(diagram(np.nan, 1990.0), 1.1) == 1990.0
    with pytest.raises(ValueError, match=r"1B of Ref crosses no engine order below .*; choose a higher one"):
        crossing(diagram(np.nan), 1.0)


def test_half_a_step_is_half_of_the_one_taken_and_no_timed_run_compiles(contact, monkeypatch):
    """A step far beyond the sampling instants is shortened to them: half of it would be shortened to the same.

    Each speed may have modes, and with them a program, of its own.
    """
    case = case_of(replace(CHOICE, time_step=1e-5, samples_per_revolution=620), speeds=(1495.0, 1500.0))
    compiled = []

    def prepared(*given):
        compiled.append(given)

    def simulated(*given, **kept):
        assert compiled[-1] == given[:4]
        return run_speed(*given, **kept)

    run_speed = runner.run_speed
    monkeypatch.setattr(runner, "simulation_of", prepared)
    monkeypatch.setattr(runner, "run_speed", simulated)
    taken = [runner.run_case(replace(case, half_step=half), contact, None)["time_step"].values for half in (False, True)]
    np.testing.assert_allclose(taken[0], 2.0 * np.pi / np.array([1495.0, 1500.0]) / 620)
    np.testing.assert_allclose(taken[1], 0.5 * taken[0], rtol=1e-12)


@pytest.mark.slow
def test_a_share_of_the_limit_is_of_the_fastest_mode_at_the_middle_speed(contact):
    """The same step at all speeds, that of 1% above the middle one: 2 over the highest angular frequency."""
    choice = replace(CHOICE, integrator="central_difference", samples_per_revolution=1)
    case = case_of(choice, speeds=(1490.0, 1495.0, 1500.0), share_of_limit=0.9)
    limit = 2.0 / contact.modes_at(1.01 * 1495.0)[0].max()
    taken = runner.run_case(case, contact, None)["time_step"].values
    # a whole number of them in a revolution
    revolutions = 2.0 * np.pi / np.array(case.speeds)
    np.testing.assert_allclose(taken, revolutions / np.ceil(revolutions / (0.9 * limit)), rtol=1e-9)


def test_extremes_are_cases_or_reasons_and_each_has_one_with_half_its_step(settings):
    planned = stability.cases(settings)
    # direct contact has no lining
    assert "bars/10__abradable" in planned and "bars/10__direct" not in planned
    names = stability.values(settings, {})["compared"]
    assert len(planned) == 2 * len(names) > 200 and names["lobes/5__direct"] == [half := "lobes/5__direct__half_step"]
    assert planned[half] == replace(planned["lobes/5__direct"], half_step=True)
    refused = [case for case in planned.values() if isinstance(case, str)]
    assert 0 < len(refused) < len(planned)
    assert all("found" in text and "allowed" in text for text in refused)
    assert len(planned["speed_over_crossing/2__direct"].speeds) == 3


def test_a_case_is_run_from_what_it_needs_and_not_at_all_if_it_is_refused(settings):
    trials, of_stability = Trials(settings), SimpleNamespace(preset="stability")
    assert set(trials.inputs(SimpleNamespace(preset="stability", case="lobes/5__direct"))) == {"contact", "cost", "campbell"}
    inputs = trials.inputs(SimpleNamespace(preset="tradeoff", case="bars/300__abradable"))
    assert set(inputs) == {"contact", "rom", "cost", "campbell"} and inputs["rom"].startswith("<results>/cases/Ref/20000_8_")
    files, reasons = trials.files(of_stability), trials.reasons(of_stability)
    for name, is_run in (("lobes/5__direct", True), ("damping_ratio/1__direct", False)):
        assert (f"<results>/stability/{name}.nc" in files) == (not reasons[name]) == is_run


def test_what_is_chosen_is_run_of_the_first_blade_in_its_scenes_at_the_level_of_the_run(root):
    chosen = {"blades": ["L50", "Ref"], "scenes": ["direct"], "fidelity": "draft", "stability": {"extremes": ["lobes"]}}
    settings = read_settings(root, command_line_document(chosen))
    assert list(stability.values(settings, {})["compared"]) == [f"lobes/{number}__direct" for number in (1, 5, 20)]
    case = stability.cases(settings)["lobes/1__direct"]
    assert (case.blade, case.model.nodes) == ("L50", 5000)


def test_a_row_of_the_table(contact, monkeypatch):
    def row_of(case):
        """The row of a case, compared with half its step."""
        pair = {"lobes/5__direct": case, "lobes/5__direct__half_step": replace(case, half_step=True)}
        responses = {name: runner.run_case(each, contact, None) for name, each in pair.items()}
        (row,) = case_table.table(responses, {"lobes/5__direct": ["lobes/5__direct__half_step"]}).to_dict("records")
        assert (row["what"], row["value"], row["scene"]) == ("lobes", "5", "direct")
        return row

    accurate = row_of(case_of())
    assert accurate["outcome"] == "accurate" and accurate["cpu_s"] > 0.0 and 0.0 < accurate["error_rms_normal"] < 0.05
    diverged = row_of(case_of(scene=replace(DIRECT, divergence_limit=1e-6)))
    assert diverged["outcome"] == "diverged" and np.isnan(diverged["rms_m"])
    refused = row_of(case_of(replace(CHOICE, time_step=2e-6, integrator="central_difference")))
    assert refused["outcome"] == "refused" and "stability limit" in refused["detail"]
    far = replace(DIRECT, casing=replace(DIRECT.casing, amplitude=0.0))
    assert row_of(case_of(scene=far))["detail"] == "nothing touches"
    # a silent wrong number is no accurate run
    monkeypatch.setattr(case_table, "ENERGY_WITHIN", 1e-30)
    outcome = row_of(case_of())
    assert outcome["outcome"] == "unsound" and outcome["detail"].startswith("energy balance open by ")


def test_effects_are_against_the_first_case_that_was_run(monkeypatch, tmp_path):
    ran = {"refused": "", "unsound": "", "diverged": False}
    cases = {"bars/1__lined": ran | {"rms_m": 1.5, "rms_normal": 3.0}, "bars/2__lined": ran | {"rms_m": 1.2, "rms_normal": 4.0}}
    cases["bars/3__lined"] = case_table.refusal("too stiff; less").attrs
    monkeypatch.setattr(case_table, "numbers", dict)
    made = case_table.table(cases, {name: ["bars/3__lined", "bars/2__lined"] for name in cases})
    assert list(made["compared_with"]) == 3 * ["bars/2__lined"]
    assert list(made["outcome"]) == ["degraded", "accurate", "refused"] and made["detail"].iloc[2] == "too stiff"
    np.testing.assert_allclose(made["error_rms_normal"], [0.25, 0.0, np.nan])
    write_table(made, tmp_path / "tradeoff.csv")
    assert case_table.closing_of_tradeoff(tmp_path) == "3 variations: 1 degraded, 1 accurate, 1 refused"


def test_the_estimate_is_of_a_sample_of_each_blade_and_scene(root):
    changes = {"blades": ["Ref", "L50"], "scenes": ["abradable", "direct"], "speeds": [{"start": 750, "stop": 2000, "step": 1}]}
    settings = read_settings(root, command_line_document(changes))
    cases = estimate.cases(settings)
    assert list(cases) == ["Ref__abradable", "Ref__direct", "L50__abradable", "L50__direct"]
    assert estimate.values(settings, extent_of(settings, {}))["runs"]["sweep"]["Ref__abradable"] == (1251, 1251)
    speeds = cases["Ref__abradable"].speeds
    assert len(speeds) == 25 and np.mean(speeds) == pytest.approx(1375.0, abs=1.0)
    few = read_settings(root, command_line_document(changes | {"speeds": [900, 1234.5]}))
    assert estimate.cases(few)["Ref__abradable"].speeds == (900.0, 1234.5)


def test_projection_by_hand(tmp_path):
    names, rows = ["Ref__direct", "L50__direct"], pd.DataFrame({"cpu_s": [2.5, 5.0], "file_cpu_s": [0.5, 0.5]})
    responses = {name: xr.Dataset(attrs=row) for name, row in zip(names, rows.to_dict("records"), strict=True)}
    runs = {"sweep": dict(zip(names, ((4, 4.0), (6, 6.0)), strict=True)), "members": {names[1]: (7.6, 3.8)}}
    projected = estimate_tables.table(responses, runs, jobs=0.2, fixed=3.0)
    costs = projected.set_index("part")
    assert costs["core_min"].mul(60.0).to_dict() == pytest.approx(
        {"jobs": 2.0, "models, pictures": 3.0, "time integration": 40.0, "files": 5.0, "members": 20.9, "total": 70.9}
    )
    assert costs["simulations"].to_dict() == pytest.approx(
        {"jobs": 10, "models, pictures": 0, "time integration": 10, "files": 10, "members": 8, "total": 18}
    )
    projected.to_csv(tmp_path / "estimate.csv", index=False)
    assert estimate_tables.closing(tmp_path) == "about 18 simulations, 1.18 core minutes"


def test_there_is_a_case_for_every_value_and_it_varies_what_it_is_called(settings):
    cases, compared = tradeoff.cases(settings), tradeoff.values(settings, {})["compared"]
    assert set(compared) == set(cases) and {name.partition("/")[0] for name in cases} == set(tradeoff.PARAMETERS)
    assert compared["bars/300__abradable"][0] == "bars/100000__abradable" and "bars/300__direct" not in cases
    lined, direct = (cases[f"level/{settings.fidelity_name}__{scene}"] for scene in ("abradable", "direct"))
    assert lined.speeds == pytest.approx((1.0, 1.005, 1.01, 1.015, 1.02))
    assert cases["bars/300__abradable"].scene.lining.bars == 300
    published = cases["central_difference_step/2.5e-08__abradable"].choice
    assert published == replace(lined.choice, time_step=2.5e-8, integrator="central_difference", shorten=False)
    assert cases["friction_form/constant__abradable"].scene.friction.vector is False
    models = {"mesh_nodes/5000": 0, "boundary_nodes/4": 1, "fixed_interface_modes/3": 2}
    for name, place in models.items():
        parts = zip(cases[f"{name}__direct"].model.name.split("_"), direct.model.name.split("_"), strict=True)
        assert [number for number, (part, other) in enumerate(parts) if part != other] == [place]


def test_extremes_of_clearance_and_lobes_are_those_of_lobes_in_clearances(config_copy):
    """Otherwise, nothing would touch at the largest clearance."""
    cases = stability.cases(read_settings(config_copy))
    assert cases["clearance/0.01__direct"].scene.casing.lobe_height == pytest.approx(2e-2)
    assert cases["ovalisation_in_clearances/10__direct"].scene.casing.lobe_height == pytest.approx(3.56e-3)
    assert cases["damping_ratio/0.1__direct"].scene.casing.height == 7.12e-4
    overlay(config_copy, "config.yaml", "scenes: [growing_direct]")
    growing = stability.cases(read_settings(config_copy))["clearance/0.01__growing_direct"].scene.casing
    assert (growing.clearance, growing.lobe_height) == (0.01, pytest.approx(2e-2))
