"""Cases: runs of one blade beside the sweep; the extremes, and the estimate, a sample of the sweep."""

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
from box_operator import box_operator
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT, random_model, with_static_modes
from workflow_runs import overlay, snakemake

from r37.command import main
from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named, read_json
from r37core.base.plain import from_plain, to_plain
from r37core.cases import runner
from r37core.cases.case import HALF_STEP, MODEL_NAME, OWN_MESH, Case, ModelChoice, model_of_name
from r37core.cases.plan import Cases
from r37core.cases.runner import crossing_speed, run_case, run_case_of_files
from r37core.cases.steps import model as model_step
from r37core.cases.table import case_table
from r37core.config import command_line_document, read_document
from r37core.estimate import plan as estimate
from r37core.estimate.steps import closing, projected_costs
from r37core.mesh.mesh_files import write_vtu
from r37core.plans.extent import extent_of, extents
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import beside
from r37core.product.reading import read_settings
from r37core.rom.contact_model import read_contact_model
from r37core.stability import plan as stability
from r37core.stability import steps
from r37core.stability.figures import COLOURS, draw_stability
from r37core.stability.steps import OUTCOMES, judge, words
from r37core.time_integration.compiled.engine import _program
from r37core.time_integration.problem import Problem
from r37core.time_integration.speed_run import run_speed


def case_of(choice, scene=DIRECT, speeds=(1500.0,), results=("energy",), **fields):
    kept = {"spectrum_highest_order": 12, "wear_angles": 100}
    return Case("Ref", "pressure_edge", scene, choice, speeds, results, None, kept, **fields)


def test_cases_are_planned_without_what_runs_them():
    """The rules import the plans each time that Snakemake starts."""
    modules = [f"r37core.{name}.plan" for name in ("cases", "tradeoff", "stability", "estimate")]
    code = f"import sys, {', '.join(modules)}; print(*{{'netCDF4', 'matplotlib', 'xarray', 'pyvista'}} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def test_a_case_is_plain_data():
    lined = replace(ABRADABLE, friction=None)
    case = case_of(IntegrationChoice(2e-7, 4, 62), lined, crossing=("1B", None), history_speeds=(1500.0,))
    for each in (
        case,
        replace(case, model=ModelChoice(5000, 8, 10, "submesh", "camber", "corners"), scene=None, refused="why"),
    ):
        assert from_plain(Case, json.loads(json.dumps(to_plain(each)))) == each
    with pytest.raises(ValueError, match="allowed: ascending, none twice"):
        replace(case, speeds=(1.0, 0.9))


def test_a_model_has_the_name_of_its_choice():
    for values in ((5000, 8, 0, "submesh", "pressure_edge", "corners"), (OWN_MESH, 2, 10, "whole", "camber", "inside")):
        choice = ModelChoice(*values)
        assert re.fullmatch(MODEL_NAME, choice.name) and model_of_name(choice.name) == choice


def test_a_case_of_a_model_that_the_mesh_cannot_have_is_refused(mesh, steel, choice, tmp_path):
    names = {"rom": "rom.nc", "contact": "contact.npz", "cost": "cost.json"}
    files = {name: str(tmp_path / file) for name, file in names.items()}
    write_vtu(mesh, tmp_path / "mesh.vtu", np.ones(sum(map(len, mesh.blocks.values()))))

    def make(nodes):
        wanted = ModelChoice(OWN_MESH, nodes, 3, "submesh", "pressure_edge", "corners")
        params = {"choice": to_plain(wanted), "reduction": to_plain(choice), "material": to_plain(steel), "provenance": {}}
        model_step(Named(mesh=str(tmp_path / "mesh.vtu")), Named(**files), Named(**params))

    make(3)
    assert len(read_contact_model(files["contact"]).radius) == 3 and read_json(files["cost"])["cpu_s"] > 0.0
    make(150)
    assert read_json(files["cost"]).keys() == {"refused"}
    run_case_of_files(case_of(IntegrationChoice(2e-7, 4, 62)), files, tmp_path / "case.nc")
    response = read_dataset(tmp_path / "case.nc")
    assert "150" in response.attrs["refused"] and response.sizes["speed"] == 0


def test_a_refused_case_needs_no_file(tmp_path):
    case = case_of(IntegrationChoice(2e-7, 4, 62), None, refused="Fan is given by a mesh; more")
    run_case_of_files(case, {}, tmp_path / "case.nc")
    assert read_dataset(tmp_path / "case.nc").attrs["refused"] == "Fan is given by a mesh"


def diagram(*speeds):
    """Crossings of 1B with the engine orders from 2 on, up to 2000 rad/s."""
    crossing = xr.DataArray([speeds], {"mode": ["1B"], "engine_order": range(2, 2 + len(speeds))})
    return xr.Dataset({"crossing_speed": crossing}, {"speed": [0.0, 2000.0]})


def test_without_an_order_the_fastest_crossing_inside_the_diagram_counts():
    crossings = diagram(np.nan, 1990.0, 1600.0, 1200.0)
    assert crossing_speed(crossings, "1B", 5, 1.0) == 1200.0
    assert crossing_speed(crossings, "1B", None, 1.0) == 1990.0
    assert crossing_speed(crossings, "1B", None, 1.1) == 1600.0
    # the only ones, though the speeds above them lie outside
    assert crossing_speed(diagram(np.nan, 1990.0), "1B", None, 1.1) == 1990.0


def test_a_crossing_that_is_not_there_is_named(tmp_path):
    """A blade may have none with an engine order."""
    write_dataset(diagram(np.nan, np.nan), tmp_path / "campbell.nc", {})
    case = case_of(IntegrationChoice(2e-7, 4, 62), speeds=(1.0,), crossing=("1B", 3))
    files = {"campbell": str(tmp_path / "campbell.nc")}
    with pytest.raises(ValueError, match=r"1B of Ref does not cross engine order 3 below .*; choose another engine_order"):
        run_case_of_files(case, files, tmp_path / "case.nc")
    with pytest.raises(ValueError, match="does not cross any engine order"):
        run_case_of_files(replace(case, crossing=("1B", None)), files, tmp_path / "case.nc")


def test_a_run_that_diverged_has_no_stress_at_instants(contact, model, steel, tmp_path):
    choice = IntegrationChoice(2e-7, 4, 62, snapshots_per_revolution=62)
    diverging = replace(DIRECT, divergence_limit=1e-6)
    case = replace(case_of(choice, diverging), results=("stress", "instants"), material=steel)
    run_case(case, contact, {"box": box_operator(model, steel)}, tmp_path / "case.nc")
    response = read_dataset(tmp_path / "case.nc")
    assert response["status"].values.all() and response["max_von_mises_of_instant"].isnull().all()


def test_half_a_step_is_half_of_the_one_taken(contact, tmp_path):
    """A step far beyond the sampling instants is shortened to them: half of it would be shortened to the same."""
    case = case_of(IntegrationChoice(1e-5, 4, 620, integrator="exact_modal"), speeds=(1495.0, 1500.0))
    for name, half in (("case", False), ("half", True)):
        run_case(replace(case, half_step=half), contact, None, tmp_path / f"{name}.nc")
    steps = [read_dataset(tmp_path / f"{name}.nc")["time_step"].values for name in ("case", "half")]
    np.testing.assert_allclose(steps[0], 2.0 * np.pi / np.array([1495.0, 1500.0]) / 620)
    np.testing.assert_allclose(steps[1], 0.5 * steps[0], rtol=1e-12)


def test_modes_that_are_left_out(contact):
    problem = Problem(contact, 1500.0, DIRECT, IntegrationChoice(2e-7, 1, 62, highest_frequency=2e4))
    assert problem.blade.frequencies[-1] <= 2 * np.pi * 2e4
    assert 5 < len(problem.blade.frequencies) < len(contact.squared_frequencies)


@pytest.mark.slow
def test_no_priced_run_compiles(tmp_path, monkeypatch):
    """Two speeds whose modes, cut at a frequency, need programs of two layouts."""
    model = with_static_modes(replace(random_model(8), stiffness_per_square=1e8 * np.eye(24)), 1e-9)
    choice = IntegrationChoice(1e-6, 2, 62, integrator="exact_modal", highest_frequency=3e5, static_above=3.0)
    counts, compiled = [], []

    def timed(model, speed, scene, choice, *given, **kept):
        before = _program.cache_info().misses
        run = run_speed(model, speed, scene, choice, *given, **kept)
        counts.append(len(Problem(model, speed, scene, choice).blade.frequencies))
        compiled.append(_program.cache_info().misses - before)
        return run

    monkeypatch.setattr(runner, "run_speed", timed)
    runner.run_case(case_of(choice, speeds=(10.0, 180.0)), model, None, tmp_path / "case.nc")
    assert compiled == [0, 0]
    assert counts[1] <= counts[0] - 8


def test_every_extreme_has_a_name_of_its_own_and_says_what_the_configuration_refuses(settings):
    planned = stability.cases(settings)
    # direct contact has no lining
    assert "bars_10__abradable" in planned and "bars_10__direct" not in planned
    assert len(planned) > 200
    expected = {"what": "speed_over_crossing", "value": "0.05", "scene": "direct"}
    assert words("speed_over_crossing_0.05__direct") == expected
    refused = [case.refused for case in planned.values() if case.scene is None]
    assert 0 < len(refused) < len(planned)
    assert all("found" in text and "allowed" in text for text in refused)


def test_an_extreme_is_run_from_what_it_needs(settings):
    cases = Cases(settings, "stability", stability.cases)
    assert set(cases.inputs(SimpleNamespace(case="lobes_5__direct"))) == {"contact", "cost", "campbell"}
    assert cases.inputs(SimpleNamespace(case="damping_ratio_1__direct")) == {}


def test_extremes_that_are_chosen(root):
    few = {"stability": {"extremes": ["lobes"], "scenes": ["direct"], "base": "draft"}}
    settings = read_settings(root, command_line_document(few))
    cases = stability.cases(settings)
    names = [name for name in cases if not name.endswith(HALF_STEP)]
    assert names == ["lobes_1__direct", "lobes_5__direct", "lobes_20__direct"]
    assert cases["lobes_1__direct"].model.nodes == 5000
    # another blade is run: there is nothing to make
    settings = read_settings(root, command_line_document({"blades": ["L50"], "stability": {"blade": "Ref"}}))
    assert filled(stability.EXTENSION.all_targets(Sweep(settings))) == [] and stability.cases(settings) == {}


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


def test_sample_stands_for_the_whole_range():
    speeds = [float(speed) for speed in range(750, 2001)]
    chosen = estimate.sample(speeds, 50)
    assert len(chosen) == 25
    assert sum(chosen) / len(chosen) == pytest.approx(sum(speeds) / len(speeds), abs=1.0)
    assert estimate.sample([3.0, 4.0], 50) == [4.0]


def test_the_sample_is_of_each_blade_and_scene(root):
    changes = {"blades": ["Ref", "L50"], "scenes": ["abradable", "direct"], "speeds": [900, 1234.5]}
    settings = read_settings(root, command_line_document(changes))
    cases = estimate.cases(settings)
    assert list(cases) == ["Ref__abradable", "Ref__direct", "L50__abradable", "L50__direct"]
    assert estimate.values(settings, {})["runs"]["Ref__abradable"] == 2
    assert cases["Ref__abradable"].speeds == (1234.5,)


def test_the_estimate_and_the_check_count_the_same_simulations(root, tmp_path, capsys):
    """Those of members, too."""
    ranges = "of_scenes: { friction.coefficient: { uniform_percent: 5 } }"
    (file := tmp_path / "members.yaml").write_text(f"tolerances: {{ members: 4, {ranges} }}\n")
    settings = read_settings(root, read_document(tmp_path, "members.yaml"))
    counted = extents(settings, beside(settings))
    runs = estimate.values(settings, beside(settings))["runs"]
    assert runs == {"__".join(place): extent.at_most for place, extent in counted.items()}
    whole = extent_of(settings, beside(settings))
    assert whole.at_most == whole.most + whole.members > whole.most > whole.certain
    assert main(["check", str(root / "config/config.yaml"), str(file)]) == 0
    told, cost = capsys.readouterr().out, whole.cpu_time(settings.fidelity.measured.cpu_s_per_run)
    assert f"simulations: {whole.certain} to about {whole.most}, and at most {whole.members} of members\n" in told
    assert f"CPU time: about {cost} at most" in told


def test_projection_by_hand(tmp_path):
    columns = {"refused": "", "run_cpu_s": [2.5, 5.0], "run_reduction_cpu_s": [0.2, 0.25], "recovery_cpu_s": [0.2, 0.5]}
    cases = pd.DataFrame(columns, index=["Ref__direct", "L50__direct"])
    runs = {"Ref__direct": 4, "L50__direct": 6}
    costs = projected_costs(cases, runs, start_up=0.1, workflow_per_job=0.05, cores=2).set_index("part")
    assert costs.loc["total", "core_hours"] == pytest.approx((40.0 + 3.0 + 10 * 0.15) / 3600.0)
    assert costs.loc["total", "wall_hours"] == pytest.approx(0.5 * costs.loc["total", "core_hours"])
    assert costs.loc["time integration", "core_s_per_simulation"] == 4.0
    costs.reset_index().to_csv(tmp_path / "estimate.csv", index=False)
    assert closing(tmp_path) == "10 simulations at most, 0.01 h on 2 cores"
