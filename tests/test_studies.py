"""The studies: their numbers by hand, and small real runs of their rules."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT
from workflow_runs import snakemake

from r37core.config.fidelity import recommended_level
from r37core.config.studies import Parameters
from r37core.studies.case import QUANTITIES, Case
from r37core.studies.changes import changed
from r37core.studies.estimate import describe, project_costs
from r37core.studies.growth import exponent_of
from r37core.studies.parameters import PARAMETERS, vary
from r37core.studies.sampling import sample
from r37core.studies.stability import judge
from r37core.studies.stability_cases import extremes
from r37core.studies.tradeoff import case_dataset, gather_cases, level_error
from r37core.studies.tradeoff_table import parameter_tables
from r37core.time_integration.simulate import Simulation


def test_sample_stands_for_the_whole_range():
    speeds = [float(speed) for speed in range(750, 2001)]
    chosen = sample(speeds, 50)
    assert len(chosen) == 25
    assert sum(chosen) / len(chosen) == pytest.approx(sum(speeds) / len(speeds), abs=1.0)
    assert sample([3.0, 4.0], 50) == [4.0]


def test_projection_by_hand():
    samples = [{"time integration": 10.0, "reduction": 1.0, "runs": 4}, {"time integration": 30.0, "reduction": 2.0, "runs": 6}]
    estimate = project_costs(samples, start_up=0.1, workflow_per_job=0.05, cores=2)
    assert estimate["total"] == pytest.approx(40.0 + 3.0 + 10 * 0.15)
    assert estimate["wall"] == pytest.approx(estimate["total"] / 2)
    assert "10 simulations" in describe(estimate, "paper")
    assert "| time integration | 0.01 | 4.000 |" in describe(estimate, "paper")


@pytest.mark.slow
def test_estimate_of_a_small_sweep(project):
    snakemake(project, "estimate", "--cores", "2")
    estimate = json.loads((project / "results/studies/estimate.json").read_text())
    assert estimate["runs"] == 12
    assert 0.0 < estimate["time integration"] < 60.0
    assert 0.01 < estimate["start-up"] / 12 < 2.0
    assert (project / "results/studies/estimate.md").read_text().startswith("Level `tiny`: 12 simulations")


def small_case(parameter, value, rms, scenes=("lined",)):
    """A case with one speed at each place but three at the peak, and errors that are easy to see."""
    places = {"peak": np.array([100.0, 101.0, 102.0]), "jump": np.array([105.0]), "off_resonance": np.array([90.0])}
    values = {name: np.array(rms, dtype=float) for name in QUANTITIES}
    values |= {name: np.zeros(5) for name in ("status", "energy_residual")}
    costs = {"cpu_s": 1.0, "wall_s": 1.0, "peak_memory_bytes": 1e8, "bytes_written": 1e4}
    runs = {scene: Case(np.concatenate(list(places.values())), values, costs) for scene in scenes}
    return case_dataset(parameter, value, places, runs, {"cpu_s": 7.0})


def test_errors_compare_means_over_neighbouring_speeds():
    cases = [small_case("bars", "1", [1.0, 2.0, 3.0, 1.0, 0.5]), small_case("bars", "2", [3.0, 2.0, 1.0, 1.0, 1.0])]
    together = gather_cases(cases, {"bars": "2"})
    error = together["error"].isel(case=0, scene=0).sel(quantity="rms_normal")
    assert error.sel(at="peak").item() == pytest.approx(0.0)  # means agree though no speed but one does
    assert error.sel(at="off_resonance").item() == pytest.approx(0.5)
    assert together["scatter"].isel(case=0, scene=0).sel(quantity="rms_normal", at="peak").item() == pytest.approx(
        np.sqrt((4 / 9 + 0 + 4) / 3)
    )
    first = (100 * 1 + 101 * 4 + 102 * 9 + 105) / 15
    second = (100 * 9 + 101 * 4 + 102 + 105) / 15
    assert together["peak_speed_error"].isel(case=0, scene=0).item() == pytest.approx(abs(first / second - 1))
    assert np.all(together["error"].isel(case=1).sel(at="peak") == 0.0)


def test_level_error_and_recommendation():
    cases = [small_case("level", "coarse", [1.2, 1.2, 1.2, 1.0, 1.0]), small_case("level", "fine", [1.0, 1.0, 1.0, 1.0, 1.0])]
    together = gather_cases(cases, {"level": "fine"})
    assert level_error(together, "coarse") == pytest.approx(0.2)
    errors, costs = {"draft": 0.2, "standard": 0.04, "paper": 0.01}, {"draft": 1.0, "standard": 3.0, "paper": 9.0}
    assert recommended_level(errors, costs, 0.3) == "draft"
    assert recommended_level(errors, costs, 0.05) == "standard"
    assert recommended_level(errors, costs, 0.001) is None


def test_refused_values_are_rows_of_the_table():
    refused = small_case("bars", "1", [np.nan] * 5)
    refused["refused"][0] = "too stiff"
    together = gather_cases([refused, small_case("bars", "2", [1.0] * 5)], {"bars": "2"})
    assert "| 1 | lined | refused: too stiff |" in parameter_tables(together, {"bars": "2"})


def test_parameters_turn_what_they_say():
    assert set(PARAMETERS) == set(Parameters.model_fields)
    scene, choice = vary("bars", "300", ABRADABLE, IntegrationChoice(1e-7, 10, 62))
    assert scene.lining.bars == 300
    assert vary("central_difference_step", "2e-08", ABRADABLE, choice)[1].time_step == 2e-8
    exact = vary("exact_modal_step", "8e-07", ABRADABLE, choice)[1]
    assert exact == replace(choice, time_step=8e-7, integrator="exact_modal")
    assert vary("friction_form", "constant", ABRADABLE, choice)[0].friction.vector is False
    assert vary("highest_frequency", "2e4", DIRECT, choice) == (DIRECT, replace(choice, highest_frequency=2e4))
    assert vary("bars", "300", DIRECT, choice) == (DIRECT, choice)
    with pytest.raises(ValueError, match="unknown parameter colour"):
        vary("colour", "red", DIRECT, choice)


def test_exponent_of_a_power_law():
    values = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    assert exponent_of(values, 3.0 * values**1.5) == pytest.approx(1.5)
    # what is fixed does not hide the growth
    assert exponent_of(values, 100.0 + values**3) > 1.0


def test_judging_a_case(contact):
    choice = IntegrationChoice(2e-7, 4, 62)
    assert judge(contact, DIRECT, choice, 1500.0)["outcome"] == "accurate"
    assert judge(contact, replace(DIRECT, divergence_limit=1e-6), choice, 1500.0)["outcome"] == "diverged"
    refused = judge(contact, DIRECT, replace(choice, time_step=2e-6), 1500.0)
    assert refused["outcome"] == "refused"
    assert "stability limit" in refused["detail"]
    far = replace(DIRECT, casing=replace(DIRECT.casing, amplitude=0.0))
    assert judge(contact, far, choice, 1500.0)["detail"] == "nothing touches"


def test_a_silent_wrong_number_is_not_accepted(contact, monkeypatch):
    from r37core.studies import stability

    monkeypatch.setattr(stability, "ENERGY_WITHIN", 1e-30)
    with pytest.raises(AssertionError, match="energy balance open"):
        judge(contact, DIRECT, IntegrationChoice(2e-7, 4, 62), 1500.0)


def test_changes_leave_the_entry_alone():
    entry = {"casing": {"lobes": 2}, "damping_ratio": 0.1}
    assert changed(entry, {"casing.lobes": 5, "damping_ratio": 0.0}) == {"casing": {"lobes": 5}, "damping_ratio": 0.0}
    assert entry == {"casing": {"lobes": 2}, "damping_ratio": 0.1}


def test_every_extreme_has_a_name_of_its_own():
    names = [extreme.name for extreme in extremes("abradable", "direct")]
    assert len(names) == len(set(names)) > 90


def test_modes_that_are_left_out(contact):
    simulation = Simulation(contact, 1500.0, DIRECT, IntegrationChoice(2e-7, 1, 62, highest_frequency=2e4))
    assert simulation.problem.frequencies[-1] <= 2 * np.pi * 2e4
    assert 5 < len(simulation.problem.frequencies) < len(contact.squared_frequencies)


@pytest.mark.slow
def test_tradeoff_of_a_small_sweep(project):
    config = project / "config/config.yaml"
    text = config.read_text()
    start, end = text.index("    parameters:"), len(text)
    parameters = "    parameters:\n      level: { values: [tiny, draft], reference: draft }\n"
    parameters += "      bars: { values: [3000, 10000], reference: 10000 }\n"
    parameters += "      revolutions: { values: [2, 3, 4], reference: 4 }\n"
    config.write_text(text[:start].replace("base: standard", "base: tiny") + parameters + text[end:])
    snakemake(project, "growth", "--cores", "2")
    table = (project / "results/studies/tradeoff.md").read_text()
    levels = (project / "results/studies/levels.md").read_text()
    assert "| `tiny` |" in levels
    assert "Recommended for a tolerance of 5%: `" in levels
    assert "### bars (reference: 10000)" in table
    with xr.open_dataset(project / "results/studies/tradeoff.nc") as dataset:
        assert dataset.sizes["case"] == 7
        assert np.isfinite(dataset["cpu_s"]).all()
    assert "| revolutions | one run | 2 to 4 |" in (project / "results/studies/growth.md").read_text()


@pytest.mark.slow
def test_studies_do_not_stand_in_the_way_of_another_blade(project):
    config = project / "config/config.yaml"
    config.write_text(config.read_text().replace("[Ref, CS100]", "[CS100]").replace("[abradable, direct]", "[direct]"))
    assert "simulate" in snakemake(project, "all_blades", "--cores", "2", "--dry-run")
    text = snakemake(project, "readings", "--cores", "2", "--dry-run", check=False)
    assert re.search(r"config\.yaml: studies: found the (blade|scene) '(Ref|abradable)'; allowed: (CS100|direct)", text)


@pytest.mark.slow
def test_an_extreme_and_a_reading_run(project):
    config = project / "config/config.yaml"
    steps = "{ fine: 100, coarse: 100, survey: 100 }"
    studies = f"  stability: {{ base: tiny }}\n  readings: {{ base: tiny, quick: tiny, speed_steps_rad_s: {steps} }}\n"
    config.write_text(config.read_text() + studies)
    extreme = "results/studies/stability/lobes_5_direct.json"
    turned, shipped, survey = (
        f"results/studies/readings/{name}.nc" for name in ("inside/CS100_4", "shipped/Ref_4", "survey/CS100_lined")
    )
    snakemake(project, extreme, turned, shipped, survey, "--cores", "2")
    assert json.loads((project / extreme).read_text())["outcome"] in ("accurate", "degraded")
    with xr.open_dataset(project / turned) as dataset:
        assert (dataset["rms_normal"] > 0.0).all()
        assert dataset.attrs["reading"] == "corners not among the nodes"
    with xr.open_dataset(project / shipped) as dataset:
        assert {1344.0, 1717.0, 1800.0} < set(dataset["history_speed"].values) | {0.0}
        assert dataset["history"].sizes["revolution"] == 8
        assert (dataset["first_contact"] >= 1.0).all()
    with xr.open_dataset(project / survey) as dataset:
        assert (dataset["amplitude_tangential"] >= 0.0).all()
    # the run's own level is the readings' one, so that its models serve for both; the other mesh has its own
    models = [file.parent.name for file in (project / "results/studies/models/CS100").glob("*/rom.nc")]
    assert models == ["10000_8_10_submesh_pressure_edge_inside"]
