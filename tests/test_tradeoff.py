"""The trade-off: its numbers by hand, and small real runs, on a blade of another program too."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from defaults import IntegrationChoice
from integration_cases import ABRADABLE
from test_cases import case_of
from test_your_blade import drawn, with_example  # noqa: F401
from workflow_runs import copy_project, overlay, snakemake

import r37
from r37core.cases.plan import Cases
from r37core.config import ConfigError, command_line_document
from r37core.config.fidelity import recommended_level
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.product.reading import read_settings
from r37core.tradeoff import plan
from r37core.tradeoff.errors import QUANTITIES, gather_cases
from r37core.tradeoff.figures import draw_growth, draw_parameter, draw_tradeoff
from r37core.tradeoff.plan import CHANGES
from r37core.tradeoff.section import Parameters
from r37core.tradeoff.tables import exponent_of, growth_table, level_table, parameter_table

PLACES = {"peak": [1, 2, 3], "jump": [4], "off_resonance": [0]}


def small_case(rms):
    """A response with one speed at each place but three at the peak, and errors that are easy to see.

    `rms` by place: peak, jump, off resonance, of which the last is the lowest speed.
    """
    values = np.roll(np.array(rms, dtype=float), 1)
    tips = {name: (("speed", "tip_point"), np.stack([values, 9.0 * values], axis=1)) for name in QUANTITIES if "_" in name}
    tips |= {name: ("speed", values) for name in ("max_von_mises", "max_wear", "contact_work", "damping_loss")}
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
    assert recommended_level(errors, costs, 0.3) == "draft"
    assert recommended_level(errors, costs, 0.05) == "standard"
    assert recommended_level(errors, costs, 0.001) is None
    bars = {f"bars/{number}__lined": small_case([1.0] * 5) for number in (1, 2)}
    assert level_table(table_of(bars, {"bars": "2"}), 0.1).empty


def test_refused_values_are_rows_of_the_table_and_drawn_as_nothing():
    refused = xr.Dataset(coords={"speed": np.empty(0)}, attrs={"refused": "too stiff"})
    responses = {"bars/1__lined": refused, "bars/2__lined": small_case([1.0] * 5)}
    table = table_of(responses, {"bars": "2"})
    assert list(table["refused"]) == ["too stiff", ""] and table["error_rms_normal"].isna().tolist() == [True, False]
    for figure in (draw_parameter(table, "bars"), draw_tradeoff(table), draw_growth(table, growth_table(table))):
        assert figure.axes


def test_parameters_vary_what_they_are_called():
    assert set(CHANGES) == set(Parameters.model_fields)
    choice = IntegrationChoice(1e-7, 10, 62)
    lined, direct = case_of(choice, ABRADABLE), case_of(choice)

    def changed(case, parameter, value):
        return case.changed(CHANGES[parameter](value))

    assert changed(lined, "bars", 300).scene.lining.bars == 300
    assert changed(lined, "central_difference_step", 2e-8).choice.time_step == 2e-8
    exact = changed(lined, "exact_modal_step", 8e-7).choice
    assert exact == replace(choice, time_step=8e-7, integrator="exact_modal")
    assert changed(lined, "friction_form", "constant").scene.friction.vector is False
    assert changed(direct, "highest_frequency", 2e4) == replace(direct, choice=replace(choice, highest_frequency=2e4))
    assert changed(direct, "bars", 300) == changed(direct, "level", "draft") == direct


def test_there_is_a_case_for_every_value(settings):
    varied, cases = plan.varied(settings), Cases(settings, "tradeoff", plan.cases)
    assert len(cases.files(None)) == len(settings.scenes) * sum(len(entry.values) for entry in varied.values())
    assert varied.keys() == CHANGES.keys() and plan.left_out(settings) == ""
    assert plan.values(settings)["references"]["level"] == "reference"
    assert "<results>/tradeoff/exact_modal_step/8e-07__direct.nc" in cases.files(None)
    inputs = cases.inputs(SimpleNamespace(case="bars/300__direct"))
    assert set(inputs) == {"contact", "rom", "cost", "campbell"} and inputs["rom"].startswith("<results>/cases/Ref/20000_8_")


def test_a_parameter_of_the_model_changes_its_own_part_of_the_name(root):
    changes = {"mesh_nodes": (1234, 20000), "boundary_nodes": (5, 8), "stress_region": ("whole", "submesh")}
    parameters = {name: {"values": list(values), "reference": values[0]} for name, values in changes.items()}
    cases = plan.cases(read_settings(root, command_line_document({"tradeoff": {"parameters": parameters}})))
    for parameter, values in changes.items():
        names = [cases[f"{parameter}/{value}__direct"].model.name.split("_") for value in values]
        assert [part for part, other in zip(*names, strict=True) if part != other] == [str(values[0])]


def test_speeds_of_a_case_ascend_and_the_tables_know_their_places(settings):
    """Off resonance lies below the crossing: the last of the places comes first in a response."""
    planned, places = plan.cases(settings), plan.values(settings)["places"]
    shares = planned["bars/300__direct"].speeds
    assert list(shares) == sorted(set(shares))
    section = settings.section(plan.SECTION)
    assert {name: [shares[row] for row in rows] for name, rows in places.items()} == plan.shares_of(section)
    assert max(shares[row] for row in places["off_resonance"]) < 1.0 <= min(shares[row] for row in places["peak"])


def test_exponent_of_a_power_law():
    values = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    assert exponent_of(values, 3.0 * values**1.5) == pytest.approx(1.5)
    # what is fixed does not hide the growth
    assert exponent_of(values, 100.0 + values**3) > 1.0


@pytest.mark.parametrize("instants", [60, 1000])
def test_stress_instants_are_among_the_samples(root, instants):
    parameters = {"stress_instants": {"values": [62, instants], "reference": 62}}
    with pytest.raises(ConfigError, match=rf"stress_instants\.values\.1: found {instants}; allowed: divisors of 496, the"):
        read_settings(root, command_line_document({"tradeoff": {"parameters": parameters}}))


def test_blades_of_ones_own_alone(config_copy):
    """Without a blade of its own the section takes the first; the reference blade need not be in the file."""
    file = config_copy / "config/blades.yaml"
    head, rest = file.read_text().split("\nRef:", 1)
    file.write_text(head + "\nMine:" + rest.split("\nL50:", 1)[0] + "\n")
    settings = read_settings(config_copy)
    assert list(settings.blades) == ["Mine"]
    assert {case.blade for case in plan.cases(settings).values()} == {"Mine"}


def test_a_blade_that_is_not_run_asks_for_nothing(root):
    settings = read_settings(root, command_line_document({"blades": ["L50"], "tradeoff": {"blade": "Ref"}}))
    assert filled(plan.EXTENSION.all_targets(Sweep(settings))) == [] and plan.left_out(settings) == ""


@pytest.mark.slow
def test_tradeoff_of_a_small_sweep(compiled, project):
    asked = (
        "tradeoff: { parameters: { level: { values: [tiny, draft], reference: draft }, "
        "bars: { values: [3000, 10000], reference: 10000 }, revolutions: { values: [2, 3, 4], reference: 4 } } }"
    )
    overlay(project, "config.yaml", asked)
    small = "{ mesh: { nodes: 2000, tip_elements: 14 }, time_integration: { revolutions: 8 } }"
    overlay(project, "fidelity.yaml", f"draft: {small}")
    said = snakemake(project, "tradeoff", "--cores", "2")
    assert " the tolerance of 5%" in said and "look at results/figures/tradeoff.png" in said
    results = r37.open_results(project / "results")
    levels, table = results.tables["tradeoff_levels"], results.tables["tradeoff"]
    assert list(levels["level"]) == ["tiny", "draft"]
    assert set(table["parameter"]) == {"level", "bars", "revolutions"} and (table["cpu_s"] > 0.0).all()
    assert results["tradeoff"].sizes["case"] == 7
    growth = results.tables["tradeoff_growth"].set_index(["parameter", "cost"]).loc[("revolutions", "cpu_s")]
    assert (growth["first_value"], growth["last_value"]) == (2, 4)
    assert (project / "results/figures/tradeoff_revolutions.pdf").exists()


def test_python_makes_what_a_section_asks_for(monkeypatch, root):
    """Without a target the tables; the section of an extension that is made on request adds its own."""
    asked = []
    monkeypatch.setattr("r37.runs.run_workflow", lambda settings, place, targets, cores: asked.append(list(targets)))
    for more in ({"tradeoff": {"scenes": ["direct"]}}, {"tolerances": {}}, {"tradeoff": {}, "targets": "stability"}):
        r37.run("Ref", "direct", [900], config=root / "config/config.yaml", **more)
    assert asked == [["tables", "tradeoff"], ["tables"], ["stability"]]


@pytest.mark.slow
def test_a_mesh_of_another_program(root, drawn, tmp_path):  # noqa: F811
    """The mesh stays as it is; contact nodes and runs vary."""
    project = with_example(root, drawn, tmp_path, copy_project)
    asked = (
        "tradeoff: { scenes: [direct], parameters: { boundary_nodes: { values: [2, 3, 90], reference: 3 }, "
        "mesh_nodes: { values: [2500, 5000], reference: 5000 }, revolutions: { values: [2, 4], reference: 4 } } }\n"
        "stability: { scenes: [direct], extremes: [boundary_nodes, mesh_nodes] }"
    )
    overlay(project, "config.yaml", asked)
    said = snakemake(project, "tradeoff", "stability", "estimate", "--cores", "2")
    assert "left out: mesh_nodes, because Fan is given by a mesh" in said
    tables = r37.open_results(project / "results").tables
    boundary = tables["tradeoff"].query("parameter == 'boundary_nodes'")
    assert boundary["refused"].notna().tolist() == [False, False, True]
    assert boundary["error_rms_normal"].iloc[1] == 0.0 and boundary["cpu_s"].iloc[0] > 0.0
    refused = tables["stability"].query("outcome == 'refused'")
    assert set(refused["what"]) == {"boundary_nodes", "mesh_nodes"}
    assert re.search(r"estimate: \d+ simulations at most, ", said)
    costs = tables["estimate"].set_index("part")
    assert 0.0 < costs.loc["time integration", "core_hours"] < 60.0 / 3600.0
    assert 0.01 < costs.loc["start-up", "core_s_per_simulation"] < 2.0
    for name in ("tradeoff", "tradeoff_boundary_nodes", "tradeoff_revolutions", "stability", "estimate"):
        assert (project / f"results/figures/{name}.png").exists()
