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
from box_operator import box_operator
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT
from test_your_blade import drawn, with_example  # noqa: F401
from workflow_runs import copy_project, overlay, snakemake

import r37
from r37.command import main
from r37core.base.dataset_file import write_dataset
from r37core.base.io import Named
from r37core.base.plain import from_plain, to_plain
from r37core.config import ConfigError, command_line_document, read_document
from r37core.config.fidelity import recommended_level
from r37core.plans.extent import extent_of, extents
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings, simulations_of_members
from r37core.rom.contact_model import read_contact_model
from r37core.sweep.parts import Parts
from r37studies.other_models import MODEL_NAME, OWN_MESH, ModelChoice
from r37studies.trials import estimate, estimate_tables, runner, stability, stability_tables, steps, tradeoff
from r37studies.trials.case import HALF_STEP, Case
from r37studies.trials.figures import COLOURS, draw_growth, draw_parameter, draw_stability, draw_tradeoff
from r37studies.trials.plan import Trials
from r37studies.trials.tradeoff_tables import QUANTITIES, exponent_of, gather_cases, growth_table, level_table, parameter_table

CHOICE = IntegrationChoice(3.2e-6, 4, 62, integrator="exact_modal")


def case_of(choice=CHOICE, scene=DIRECT, speeds=(1500.0,), results=("energy",), **fields):
    kept = {"spectrum_highest_order": 12, "wear_angles": 100}
    return Case("Ref", "pressure_edge", scene, choice, speeds, results, **{"material": None, "kept": kept, **fields})


def run_case(folder, case, model, recovery=None):
    return runner.run_case(case, model, recovery, Parts(folder, "the test"))


def with_section(root, name, **keys):
    return read_settings(root, command_line_document({name: keys}))


def test_cases_are_planned_without_what_runs_them():
    """The rules import the plans each time that Snakemake starts."""
    code = "import sys, r37studies.trials.plan; print(*{'netCDF4', 'matplotlib', 'xarray', 'pyvista'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def test_a_case_is_plain_data():
    lined = case_of(scene=replace(ABRADABLE, friction=None), crossing=("1B", None), history_speeds=(1500.0,))
    for case in (lined, replace(lined, model=ModelChoice(5000, 8, 10, "submesh"))):
        assert from_plain(Case, json.loads(json.dumps(to_plain(case)))) == case
    with pytest.raises(ValueError, match="allowed: ascending, none twice"):
        replace(lined, speeds=(1.0, 0.9))


def test_a_model_has_the_name_of_its_choice():
    for choice in (ModelChoice(5000, 8, 0, "submesh"), ModelChoice(OWN_MESH, 2, 10, "whole")):
        assert re.fullmatch(MODEL_NAME, choice.name) and ModelChoice.named(choice.name) == choice


def diagram(*speeds):
    """Crossings of 1B with the engine orders from 2 on, up to 2000 rad/s."""
    crossing = xr.DataArray([speeds], {"mode": ["1B"], "engine_order": range(2, 2 + len(speeds))})
    return xr.Dataset({"crossing_speed": crossing}, {"speed": [0.0, 2000.0]})


def test_without_an_order_the_fastest_crossing_inside_the_diagram_counts():
    def crossing(campbell, order, highest_share):
        return steps.crossing_speed(campbell, case_of(speeds=(highest_share,), crossing=("1B", order)))

    crossings = diagram(np.nan, 1990.0, 1600.0, 1200.0)
    assert crossing(crossings, 5, 1.0) == 1200.0
    assert crossing(crossings, None, 1.0) == 1990.0
    assert crossing(crossings, None, 1.1) == 1600.0
    # the only ones, though the speeds above them lie outside
    assert crossing(crossings, 3, 1.1) == crossing(diagram(np.nan, 1990.0), None, 1.1) == 1990.0


@pytest.mark.parametrize(
    ("order", "named"), [(3, "engine order 3 below .*; choose another engine_order"), (None, "any engine")]
)
def test_a_crossing_that_is_not_there_is_named(tmp_path, order, named):
    """A blade may have none with an engine order."""
    write_dataset(diagram(np.nan, np.nan), tmp_path / "campbell.nc", {})
    case = to_plain(case_of(speeds=(1.0,), crossing=("1B", order)))
    with pytest.raises(ValueError, match=f"1B of Ref does not cross {named}"):
        steps.run(Named(campbell=str(tmp_path / "campbell.nc")), Named(response="case.nc"), Named(case=case))


def test_a_run_that_diverged_has_no_stress_at_instants(contact, model, steel, tmp_path):
    choice = replace(CHOICE, snapshots_per_revolution=62).recorded
    case = case_of(choice, replace(DIRECT, divergence_limit=1e-6), results=("stress", "instants"), material=steel)
    response = run_case(tmp_path, case, contact, {"box": box_operator(model, steel)})
    assert response["status"].values.all() and response["max_von_mises_of_instant"].isnull().all()


def test_half_a_step_is_half_of_the_one_taken_and_no_timed_run_compiles(contact, monkeypatch, tmp_path):
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
    taken = [run_case(tmp_path, replace(case, half_step=half), contact)["time_step"].values for half in (False, True)]
    np.testing.assert_allclose(taken[0], 2.0 * np.pi / np.array([1495.0, 1500.0]) / 620)
    np.testing.assert_allclose(taken[1], 0.5 * taken[0], rtol=1e-12)


def test_a_case_that_was_interrupted_goes_on(contact, monkeypatch, tmp_path):
    """Its costs are those of the runs when they were done."""
    case = case_of(speeds=(1495.0, 1500.0))
    expected, run_speed, done = run_case(tmp_path, case, contact), runner.run_speed, []
    next(tmp_path.glob("speed_1500-*.npz")).unlink()
    monkeypatch.setattr(
        runner, "run_speed", lambda model, speed, *of, **kept: done.append(speed) or run_speed(model, speed, *of, **kept)
    )
    again = run_case(tmp_path, case, contact)
    assert done == [1500.0]
    xr.testing.assert_identical(again["rms_normal"], expected["rms_normal"])
    assert again["cpu_s"][0] == expected["cpu_s"][0]


def test_every_extreme_has_a_name_of_its_own_and_says_what_the_configuration_refuses(settings):
    planned = stability.cases(settings)
    # direct contact has no lining
    assert "bars_10__abradable" in planned and "bars_10__direct" not in planned
    assert len(planned) > 200
    refused = [case for case in planned.values() if isinstance(case, str)]
    assert 0 < len(refused) < len(planned)
    assert all("found" in text and "allowed" in text for text in refused)


def test_a_case_is_run_from_what_it_needs_and_not_at_all_if_it_is_refused(settings):
    trials = Trials(settings)
    lobes = SimpleNamespace(preset="stability", case="lobes_5__direct")
    assert set(trials.inputs(lobes)) == {"contact", "cost", "campbell"}
    inputs = trials.inputs(SimpleNamespace(preset="tradeoff", case="bars/300__direct"))
    assert set(inputs) == {"contact", "rom", "cost", "campbell"} and inputs["rom"].startswith("<results>/cases/Ref/20000_8_")
    files, reasons = trials.files("stability", None), trials.reasons("stability", None)
    assert "<results>/stability/lobes_5__direct.nc" in files and reasons["lobes_5__direct"] == ""
    assert "<results>/stability/damping_ratio_1__direct.nc" not in files and reasons["damping_ratio_1__direct"]


def test_extremes_that_are_chosen(root):
    settings = with_section(root, "stability", extremes=["lobes"], scenes=["direct"], base="draft")
    cases = stability.cases(settings)
    names = [name for name in cases if not name.endswith(HALF_STEP)]
    assert names == ["lobes_1__direct", "lobes_5__direct", "lobes_20__direct"]
    assert cases["lobes_1__direct"].model.nodes == 5000


@pytest.mark.parametrize("preset", [stability, tradeoff], ids=["stability", "tradeoff"])
def test_a_blade_that_is_not_run_asks_for_nothing(root, preset):
    settings = read_settings(root, command_line_document({"blades": ["L50"], preset.EXTENSION.name: {"blade": "Ref"}}))
    assert filled(preset.EXTENSION.all_targets(Sweep(settings))) == [] and preset.cases(settings) == {}
    assert tradeoff.not_varied(settings) == ""


def test_judging_a_case(contact, monkeypatch, tmp_path):
    def judged(case):
        """The row in the table, of runs with the case's own step and with half of it."""
        responses = {"lobes_5__direct": case, f"lobes_5__direct{HALF_STEP}": replace(case, half_step=True)}
        responses = {name: run_case(tmp_path, each, contact) for name, each in responses.items()}
        (row,) = stability_tables.tables(responses)["table"].to_dict("records")
        assert (row["what"], row["value"], row["scene"]) == ("lobes", "5", "direct")
        return row

    assert judged(case_of())["outcome"] == "accurate"
    diverged = judged(case_of(scene=replace(DIRECT, divergence_limit=1e-6)))
    assert diverged["outcome"] == "diverged"
    assert np.isnan(diverged["rms_m"])
    refused = judged(case_of(replace(CHOICE, time_step=2e-6, integrator="central_difference")))
    assert refused["outcome"] == "refused"
    assert "stability limit" in refused["detail"]
    far = replace(DIRECT, casing=replace(DIRECT.casing, amplitude=0.0))
    assert judged(case_of(scene=far))["detail"] == "nothing touches"
    # a silent wrong number is no accurate run
    monkeypatch.setattr(stability_tables, "ENERGY_WITHIN", 1e-30)
    outcome = judged(case_of())
    assert outcome["outcome"] == "unsound" and outcome["detail"].startswith("energy balance open by ")


def test_a_case_that_the_plan_refuses_is_a_row_of_the_table_without_remedies(tmp_path):
    params = Named(module="r37studies.trials.stability_tables", values={}, reasons={"mesh_nodes_500__direct": "a mesh; more"})
    steps.report(Named(cases=[]), Named(table=str(tmp_path / "stability.csv")), params)
    (row,) = pd.read_csv(tmp_path / "stability.csv").to_dict("records")
    assert (row["what"], row["value"], row["outcome"], row["detail"]) == ("mesh_nodes", 500, "refused", "a mesh")


def test_every_outcome_has_a_colour():
    assert tuple(COLOURS) == stability_tables.OUTCOMES
    rows = [(what, value, "direct", outcome) for what in ("lobes", "bars") for value, outcome in enumerate(COLOURS)]
    figure = draw_stability(pd.DataFrame(rows, columns=["what", "value", "scene", "outcome"]))
    assert [text.get_text() for text in figure.axes[0].get_yticklabels()] == ["lobes", "bars"]


def test_the_estimate_is_of_a_sample_of_each_blade_and_scene(root):
    changes = {"blades": ["Ref", "L50"], "scenes": ["abradable", "direct"], "speeds": [{"start": 750, "stop": 2000, "step": 1}]}
    settings = read_settings(root, command_line_document(changes))
    cases = estimate.cases(settings)
    assert list(cases) == ["Ref__abradable", "Ref__direct", "L50__abradable", "L50__direct"]
    assert estimate.values(settings, {})["runs"]["Ref__abradable"] == 1251
    speeds = cases["Ref__abradable"].speeds
    assert len(speeds) == 25 and np.mean(speeds) == pytest.approx(1375.0, abs=1.0)
    few = read_settings(root, command_line_document(changes | {"speeds": [900, 1234.5]}))
    assert estimate.cases(few)["Ref__abradable"].speeds == (1234.5,)


def test_the_estimate_and_the_check_count_the_same_simulations(root, tmp_path, capsys):
    """Those of members, too."""
    ranges = "of_scenes: { friction.coefficient: { uniform_percent: 5 } }"
    (file := tmp_path / "members.yaml").write_text(f"tolerances: {{ members: 4, {ranges} }}\n")
    settings = read_settings(root, read_document(tmp_path, "members.yaml"))
    members = simulations_of_members(settings)
    counted, runs = extents(settings, members), estimate.values(settings, members)["runs"]
    assert runs == {"__".join(place): extent.at_most for place, extent in counted.items()}
    whole = extent_of(settings, members)
    assert whole.at_most == whole.most + whole.members > whole.most > whole.certain
    assert main(["check", str(root / "config/config.yaml"), str(file)]) == 0
    told, cost = capsys.readouterr().out, whole.cpu_time(settings.fidelity.measured.cpu_s_per_run)
    assert f"simulations: {whole.certain} to about {whole.most}, and at most {whole.members} of members\n" in told
    assert f"CPU time: about {cost} at most" in told


def test_projection_by_hand(tmp_path):
    columns = {"refused": "", "run_cpu_s": [2.5, 5.0], "run_reduction_cpu_s": [0.2, 0.25], "recovery_cpu_s": [0.2, 0.5]}
    cases = pd.DataFrame(columns, index=["Ref__direct", "L50__direct"])
    runs = {"Ref__direct": 4, "L50__direct": 6}
    projected = estimate_tables.projected_costs(cases, runs, start_up=0.1, workflow_per_job=0.05, cores=2)
    costs = projected.set_index("part")
    assert costs.loc["total", "core_hours"] == pytest.approx((40.0 + 3.0 + 10 * 0.15) / 3600.0)
    assert costs.loc["total", "wall_hours"] == pytest.approx(0.5 * costs.loc["total", "core_hours"])
    assert costs.loc["time integration", "core_s_per_simulation"] == 4.0
    projected.to_csv(tmp_path / "estimate.csv", index=False)
    assert estimate_tables.closing(tmp_path) == "10 simulations at most, 0.01 h on 2 cores"


PLACES = {"peak": [1, 2, 3], "jump": [4], "off_resonance": [0]}


def small_case(rms):
    """A response with one speed at each place but three at the peak, and errors that are easy to see.

    `rms` by place: peak, jump, off resonance, of which the last is the lowest speed.
    """
    values = np.roll(np.array(rms, dtype=float), 1)
    tips = {name: (("speed", "tip_point"), np.stack([values, 9.0 * values], axis=1)) for name in QUANTITIES if "_" in name}
    tips |= {name: ("speed", values) for name in ("max_von_mises_last_revolution", "max_wear", "contact_work", "damping_loss")}
    tips |= {name: ("speed", 0.0 * values) for name in ("status", "energy_residual")}
    tips |= {name: ("speed", np.full(5, cost)) for name, cost in (("cpu_s", 1.0), ("wall_s", 1.0), ("bytes_written", 1e4))}
    coords = {"speed": [90.0, 100.0, 101.0, 102.0, 105.0], "tip_point": ["leading_edge", "trailing_edge"]}
    return xr.Dataset(tips, coords, {"peak_memory_bytes": 1e8, "model_cpu_s": 7.0})


def test_errors_compare_means_over_neighbouring_speeds():
    responses = {"bars/1__lined": small_case([1.0, 2.0, 3.0, 1.0, 0.5]), "bars/2__lined": small_case([3.0, 2.0, 1.0, 1.0, 1.0])}
    together = gather_cases(responses, PLACES, {"bars": "2"})
    one = together.isel(case=0, scene=0)
    error = one["error"].sel(quantity="rms_normal")
    assert error.sel(at="peak").item() == pytest.approx(0.0)  # means agree though no speed but one does
    assert error.sel(at="off_resonance").item() == pytest.approx(0.5)
    scatter = one["scatter"].sel(quantity="rms_normal", at="peak").item()
    assert scatter == pytest.approx(np.sqrt((4 / 9 + 0 + 4) / 3))
    first, second = (100 * 1 + 101 * 4 + 102 * 9 + 105) / 15, (100 * 9 + 101 * 4 + 102 + 105) / 15
    assert one["peak_speed_error"].item() == pytest.approx(abs(first / second - 1))
    assert np.all(together["error"].isel(case=1).sel(at="peak") == 0.0)


def table_of(responses, references):
    return parameter_table(gather_cases(responses, PLACES, references), references)


def test_level_error_and_recommendation():
    responses = {"level/coarse__lined": small_case([1.2, 1.2, 1.2, 1.0, 1.0]), "level/fine__lined": small_case([1.0] * 5)}
    levels = level_table(table_of(responses, {"level": "fine"}), 0.3)
    assert levels.set_index("level").loc["coarse", "error"] == pytest.approx(0.2)
    assert list(levels["recommended"]) == ["yes", "no"]
    errors, costs = {"draft": 0.2, "standard": 0.04, "paper": 0.01}, {"draft": 1.0, "standard": 3.0, "paper": 9.0}
    assert [recommended_level(errors, costs, within) for within in (0.3, 0.05, 0.001)] == ["draft", "standard", None]
    bars = {f"bars/{number}__lined": small_case([1.0] * 5) for number in (1, 2)}
    assert level_table(table_of(bars, {"bars": "2"}), 0.1).empty


def test_refused_values_are_rows_of_the_table_and_drawn_as_nothing():
    refused = xr.Dataset(coords={"speed": np.empty(0)}, attrs={"refused": "too stiff"})
    responses = {"bars/1__lined": refused, "bars/2__lined": small_case([1.0] * 5)}
    table = table_of(responses, {"bars": "2"})
    assert list(table["refused"]) == ["too stiff", ""] and table["error_rms_normal"].isna().tolist() == [True, False]
    for figure in (draw_parameter(table, "bars"), draw_tradeoff(table), draw_growth(table, growth_table(table))):
        assert figure.axes


def test_exponent_of_a_power_law():
    values = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    assert exponent_of(values, 3.0 * values**1.5) == pytest.approx(1.5)
    # what is fixed does not hide the growth
    assert exponent_of(values, 100.0 + values**3) > 1.0


def test_there_is_a_case_for_every_value_and_it_varies_what_it_is_called(settings):
    varied, cases, files = tradeoff.varied(settings), tradeoff.cases(settings), Trials(settings).files("tradeoff", None)
    assert {"level", *tradeoff.PARAMETERS} == set(tradeoff.Parameters.model_fields) == set(varied)
    assert len(files) == len(settings.scenes) * sum(len(entry.values) for entry in varied.values())
    assert "<results>/tradeoff/exact_modal_step/8e-07__direct.nc" in files
    assert tradeoff.not_varied(settings) == "" and tradeoff.values(settings, {})["references"]["level"] == "reference"
    lined, direct = (cases[f"level/{settings.fidelity_name}__{scene}"] for scene in ("abradable", "direct"))
    assert cases["bars/300__abradable"].scene.lining.bars == 300 and cases["bars/300__direct"] == direct
    exact = replace(lined.choice, time_step=8e-7, integrator="exact_modal", shorten=False)
    assert cases["exact_modal_step/8e-07__abradable"] == replace(lined, choice=exact)
    published = cases["central_difference_step/2.5e-08__abradable"].choice
    assert (published.time_step, published.integrator) == (2.5e-8, "central_difference")
    assert cases["friction_form/constant__abradable"].scene.friction.vector is False
    cut = replace(direct, choice=replace(direct.choice, highest_frequency=2e4))
    assert cases["highest_frequency/20000__direct"] == cut


def test_a_parameter_of_the_model_changes_its_own_part_of_the_name(root):
    changes = {"mesh_nodes": (1234, 20000), "boundary_nodes": (5, 8), "stress_region": ("whole", "submesh")}
    parameters = {name: {"values": list(values), "reference": values[0]} for name, values in changes.items()}
    cases = tradeoff.cases(with_section(root, "tradeoff", parameters=parameters))
    for parameter, values in changes.items():
        names = [cases[f"{parameter}/{value}__direct"].model.name.split("_") for value in values]
        assert [part for part, other in zip(*names, strict=True) if part != other] == [str(values[0])]


def test_speeds_of_a_case_ascend_and_the_tables_know_their_places(settings):
    """Off resonance lies below the crossing: the last of the places comes first in a response."""
    shares, places = tradeoff.cases(settings)["bars/300__direct"].speeds, tradeoff.values(settings, {})["places"]
    assert list(shares) == sorted(set(shares))
    wanted = settings.section(tradeoff.SECTION).places.shares
    assert {name: [shares[row] for row in rows] for name, rows in places.items()} == wanted
    assert max(shares[row] for row in places["off_resonance"]) < 1.0 <= min(shares[row] for row in places["peak"])


@pytest.mark.parametrize("instants", [60, 1000])
def test_stress_instants_are_among_the_samples(root, instants):
    parameters = {"stress_instants": {"values": [62, instants], "reference": 62}}
    with pytest.raises(ConfigError, match=rf"stress_instants\.values\.1: found {instants}; allowed: divisors of 496, the"):
        with_section(root, "tradeoff", parameters=parameters)


def test_blades_of_ones_own_alone(config_copy):
    """Without a blade of its own the section takes the first; the reference blade need not be in the file."""
    file = config_copy / "config/blades.yaml"
    head, rest = file.read_text().split("\nRef:", 1)
    file.write_text(head + "\nMine:" + rest.split("\nL50:", 1)[0] + "\n")
    settings = read_settings(config_copy)
    assert list(settings.blades) == ["Mine"]
    assert {case.blade for case in tradeoff.cases(settings).values()} == {"Mine"}


def test_python_makes_what_a_section_asks_for(monkeypatch, root):
    """Without a target the tables; the section of an extension that is made on request adds its own."""
    asked = []
    monkeypatch.setattr("r37.runs.run_workflow", lambda settings, place, targets, cores: asked.append(list(targets)))
    for more in ({"estimate": {"every": 600}}, {"tolerances": {}}, {"tradeoff": {}, "targets": "stability"}):
        r37.run("Ref", "direct", [900], config=root / "config/config.yaml", **more)
    assert asked == [["tables", "estimate"], ["tables"], ["stability"]]


PRESETS = """
blades: [Fan, Ref]
tradeoff:
  blade: Fan
  scenes: [abradable]
  places: { peak: { first: 1.0, last: 1.02, speeds: 2 }, jump: { first: 1.03, last: 1.03, speeds: 1 } }
  parameters:
    level: { values: [tiny, draft], reference: draft }
    boundary_nodes: { values: [3, 90], reference: 3 }
    mesh_nodes: { values: [2500, 5000], reference: 5000 }
    revolutions: { values: [2, 3, 4], reference: 4 }
stability: { blade: Ref, scenes: [direct], extremes: [damping_ratio] }
"""


@pytest.mark.slow
def test_all_presets(root, drawn, tmp_path):
    """The mesh of another program stays as it is; contact nodes and runs vary. Extremes are of a blade that is meshed."""
    project = with_example(root, drawn, tmp_path, copy_project)
    overlay(project, "config.yaml", PRESETS)
    # levels with one model
    overlay(
        project, "fidelity.yaml", "draft: { reduction: { fixed_interface_modes: 8 }, time_integration: { revolutions: 9 } }"
    )
    said = snakemake(project, "tradeoff", "stability", "estimate", "--cores", "2")
    assert " the tolerance of 5%" in said and "look at results/figures/tradeoff.png" in said
    assert "; left out: mesh_nodes, because Fan is given by a mesh" in said
    results = r37.open_results(project / "results")
    levels, table = results.tables["tradeoff_levels"], results.tables["tradeoff"].set_index(["parameter", "value"])
    assert list(levels["level"]) == ["tiny", "draft"]
    assert set(table.index.levels[0]) == {"level", "boundary_nodes", "revolutions"}
    assert results["tradeoff"].sizes["case"] == 7
    refused = table["refused"].notna()
    assert (
        list(table.index[refused]) == [("boundary_nodes", "90")]
        and "found 90 contact patches" in table["refused"][refused].iloc[0]
    )
    assert (table["cpu_s"][~refused] > 0.0).all() and (table["model_cpu_s"][~refused] > 0.0).all()
    assert (table.loc[("boundary_nodes", "3"), "error_rms_normal"] == 0.0).all()
    (contact,) = (project / "results/cases/Fan").glob("0_3_*/contact.npz")
    assert len(read_contact_model(contact).radius) == 3
    growth = results.tables["tradeoff_growth"].set_index(["parameter", "cost"]).loc[("revolutions", "cpu_s")]
    assert (growth["first_value"], growth["last_value"]) == (2, 4)

    assert "stability: 4 extremes: " in said and "1 refused" in said
    extremes = results.tables["stability"]
    assert len(extremes) == 4 and not (extremes["outcome"] == "unsound").any()

    assert re.search(r"estimate: \d+ simulations at most, ", said)
    costs = results.tables["estimate"].set_index("part")
    assert 0.0 < costs.loc["time integration", "core_hours"] < 60.0 / 3600.0
    assert 0.01 < costs.loc["start-up", "core_s_per_simulation"] < 2.0
    for name in ("tradeoff", "tradeoff_growth", "tradeoff_boundary_nodes", "tradeoff_revolutions", "stability", "estimate"):
        assert (project / f"results/figures/{name}.png").exists() and (project / f"results/figures/{name}.pdf").exists()


def test_extremes_of_clearance_and_lobes_are_those_of_lobes_in_clearances(config_copy):
    """Otherwise, nothing would touch at the largest clearance."""
    cases = stability.cases(read_settings(config_copy))
    assert cases["clearance_0.01__direct"].scene.casing.lobe_height == pytest.approx(2e-2)
    assert cases["ovalisation_in_clearances_10__direct"].scene.casing.lobe_height == pytest.approx(3.56e-3)
    assert cases["damping_ratio_0.1__direct"].scene.casing.height == 7.12e-4
    overlay(config_copy, "config.yaml", "scenes: [growing_direct]")
    growing = stability.cases(read_settings(config_copy))["clearance_0.01__growing_direct"].scene.casing
    assert (growing.clearance, growing.lobe_height) == (0.01, pytest.approx(2e-2))
