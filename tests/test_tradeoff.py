"""The studies: their numbers by hand, and small real runs of their rules."""

import json
import re
import subprocess
import sys
from dataclasses import replace
from importlib import import_module
from inspect import signature

import numpy as np
import pytest
import xarray as xr
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT, random_model, with_static_modes
from overlays import overlay
from plans_of_snakemake import planned
from workflow_runs import snakemake

from r37.command import main
from r37core.config import ConfigError, command_line_document, read_document
from r37core.config.fidelity import recommended_level
from r37core.config.study_sections import Parameters
from r37core.dataset_file import read_dataset, write_dataset
from r37core.plain import from_plain, to_plain
from r37core.plans.extent import extent_of, extents
from r37core.product.reading import read_settings
from r37core.product.sampling import beside
from r37core.results.measures import first_contact
from r37core.stress.recovery import stress_operator
from r37core.studies import runner
from r37core.studies.case import MODEL_NAME, Case, ModelChoice, changed, model_of_name
from r37core.studies.estimate.cases import sample, values
from r37core.studies.estimate.report import describe, project_costs
from r37core.studies.plan import STUDIES
from r37core.studies.runner import run_case
from r37core.studies.stability.cases import extremes
from r37core.studies.stability.report import judge
from r37core.studies.tradeoff import cases as tradeoff
from r37core.studies.tradeoff.cases import CHANGES
from r37core.studies.tradeoff.report import QUANTITIES, exponent_of, gather_cases, level_error, parameter_tables
from r37core.time_integration.compiled.engine import _program
from r37core.time_integration.problem import Problem
from r37core.time_integration.speed_run import run_speed


def test_a_study_is_a_folder_and_one_runner_serves_all(root):
    """Cases are light, reports are called alike, simulations are run in one module, and the product knows none of it."""
    core = root / "src/r37core/studies"
    assert {file.parent.name for file in core.glob("*/cases.py")} == set(STUDIES)
    for study in STUDIES:
        plan, told = (import_module(f"r37core.studies.{study}.{part}") for part in ("cases", "report"))
        assert callable(plan.cases) and callable(plan.values)
        assert all(callable(getattr(plan, name, callable)) for name in ("inputs", "outputs"))
        assert list(signature(told.report).parameters) == ["responses", "files", "values"]
    runs = [file.name for file in core.rglob("*.py") if re.search(r"\b(run_speed|write_response)\(", file.read_text())]
    assert runs == ["runner.py"]
    workflow = [file for file in (root / "workflow").rglob("*.*") if "r37core.studies" in file.read_text()]
    assert sorted(file.name for file in workflow) == ["studies.smk"]


def test_cases_are_planned_without_what_runs_them():
    """The rules import the cases of all studies each time that Snakemake starts."""
    modules = [f"r37core.studies.{study}.cases" for study in STUDIES]
    code = f"import sys, {', '.join(modules)}; print(*{{'netCDF4', 'matplotlib', 'xarray', 'pyvista'}} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def test_sample_stands_for_the_whole_range():
    speeds = [float(speed) for speed in range(750, 2001)]
    chosen = sample(speeds, 50)
    assert len(chosen) == 25
    assert sum(chosen) / len(chosen) == pytest.approx(sum(speeds) / len(speeds), abs=1.0)
    assert sample([3.0, 4.0], 50) == [4.0]


def test_the_estimate_and_the_check_count_the_same_simulations(root, tmp_path, capsys):
    """Those of members, too."""
    (file := tmp_path / "members.yaml").write_text(
        "tolerances: { members: 4, of_scenes: { friction.coefficient: { uniform_percent: 5 } } }\n"
    )
    settings = read_settings(root, read_document(tmp_path, "members.yaml"))
    counted = extents(settings, beside(settings))
    assert values(settings)["runs"] == {"__".join(place): extent.at_most for place, extent in counted.items()}
    whole = extent_of(settings, beside(settings))
    assert whole.at_most == whole.most + whole.members > whole.most > whole.certain
    assert main(["check", str(root / "config/config.yaml"), str(file)]) == 0
    told, cost = capsys.readouterr().out, whole.at_most * settings.fidelity.measured.cpu_s_per_run
    assert f"simulations: {whole.certain} to about {whole.most}, and at most {whole.members} of members\n" in told
    assert f"CPU time: about {cost / 60.0:.3g} minutes at most" in told


def test_projection_by_hand():
    samples = [{"time integration": 10.0, "reduction": 1.0, "runs": 4}, {"time integration": 30.0, "reduction": 2.0, "runs": 6}]
    estimate = project_costs(samples, start_up=0.1, workflow_per_job=0.05, cores=2)
    assert estimate["total"] == pytest.approx(40.0 + 3.0 + 10 * 0.15)
    assert estimate["wall"] == pytest.approx(estimate["total"] / 2)
    assert "10 simulations" in describe(estimate, "paper")
    assert "| time integration | 0.01 | 4.000 |" in describe(estimate, "paper")


@pytest.mark.slow
def test_estimate_of_a_small_sweep(compiled, project):
    snakemake(project, "estimate", "--cores", "2")
    estimate = json.loads((project / "results/studies/estimate.json").read_text())
    assert estimate["runs"] == 12
    assert 0.0 < estimate["time integration"] < 60.0
    assert 0.01 < estimate["start-up"] / 12 < 2.0
    assert (project / "results/studies/estimate.md").read_text().startswith("Level `tiny`: 12 simulations")


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
    responses = {"level/coarse__lined": small_case([1.2, 1.2, 1.2, 1.0, 1.0]), "level/fine__lined": small_case([1.0] * 5)}
    together = gather_cases(responses, PLACES, {"level": "fine"})
    assert level_error(together, "coarse") == pytest.approx(0.2)
    errors, costs = {"draft": 0.2, "standard": 0.04, "paper": 0.01}, {"draft": 1.0, "standard": 3.0, "paper": 9.0}
    assert recommended_level(errors, costs, 0.3) == "draft"
    assert recommended_level(errors, costs, 0.05) == "standard"
    assert recommended_level(errors, costs, 0.001) is None


def test_refused_values_are_rows_of_the_table():
    refused = xr.Dataset(coords={"speed": np.empty(0)}, attrs={"refused": "too stiff"})
    together = gather_cases({"bars/1__lined": refused, "bars/2__lined": small_case([1.0] * 5)}, PLACES, {"bars": "2"})
    assert "| 1 | lined | refused: too stiff |" in parameter_tables(together, {"bars": "2"})


def test_parameters_vary_what_they_say():
    assert set(CHANGES) == set(Parameters.model_fields)
    choice = IntegrationChoice(1e-7, 10, 62)
    lined, direct = case_of(choice, ABRADABLE), case_of(choice)
    assert CHANGES["bars"](lined, "300").scene.lining.bars == 300
    assert CHANGES["central_difference_step"](lined, "2e-08").choice.time_step == 2e-8
    exact = CHANGES["exact_modal_step"](lined, "8e-07").choice
    assert exact == replace(choice, time_step=8e-7, integrator="exact_modal")
    assert CHANGES["friction_form"](lined, "constant").scene.friction.vector is False
    assert CHANGES["highest_frequency"](direct, "2e4") == replace(direct, choice=replace(choice, highest_frequency=2e4))
    assert CHANGES["bars"](direct, "300") == CHANGES["level"](direct, "draft") == direct


def test_speeds_of_a_case_ascend_and_the_report_knows_their_places(settings):
    """Off resonance lies below the crossing: what the study says last of its places comes first in a response."""
    planned, places = tradeoff.cases(settings), tradeoff.values(settings)["places"]
    shares = planned["bars/300__direct"].speeds
    assert list(shares) == sorted(set(shares))
    assert {name: [shares[row] for row in rows] for name, rows in places.items()} == tradeoff.shares_of(
        settings.studies.tradeoff
    )
    assert max(shares[row] for row in places["off_resonance"]) < 1.0 <= min(shares[row] for row in places["peak"])
    with pytest.raises(ValueError, match="allowed: ascending, none twice"):
        replace(planned["bars/300__direct"], speeds=(1.0, 0.9))


def test_exponent_of_a_power_law():
    values = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    assert exponent_of(values, 3.0 * values**1.5) == pytest.approx(1.5)
    # what is fixed does not hide the growth
    assert exponent_of(values, 100.0 + values**3) > 1.0


def case_of(choice, scene=DIRECT, speeds=(1500.0,), results=("energy",), **fields):
    kept = {"spectrum_highest_order": 12, "wear_angles": 100}
    return Case("Ref", "pressure_edge", scene, choice, speeds, results, None, kept, **fields)


@pytest.fixture
def judged(contact, tmp_path):
    """Outcome of a case, run with its own step and with half of it."""

    def judge_case(case):
        for name, one in (("case", case), ("half", replace(case, half_step=True))):
            run_case(one, contact, None, tmp_path / f"{name}.nc")
        return judge(*(read_dataset(tmp_path / f"{name}.nc") for name in ("case", "half")))

    return judge_case


def test_judging_a_case(judged):
    choice = IntegrationChoice(2e-7, 4, 62)
    assert judged(case_of(choice))["outcome"] == "accurate"
    diverged = judged(case_of(choice, replace(DIRECT, divergence_limit=1e-6)))
    assert diverged["outcome"] == "diverged"
    assert np.isnan(diverged["rms"])
    refused = judged(case_of(replace(choice, time_step=2e-6)))
    assert refused["outcome"] == "refused"
    assert "stability limit" in refused["detail"]
    far = replace(DIRECT, casing=replace(DIRECT.casing, amplitude=0.0))
    assert judged(case_of(choice, far))["detail"] == "nothing touches"
    assert judged(case_of(choice, None, refused="lobes: found -1"))["detail"] == "lobes: found -1"


def test_a_run_that_diverged_has_no_stress_at_instants(contact, model, steel, tmp_path):
    choice = IntegrationChoice(2e-7, 4, 62, snapshots_per_revolution=62)
    diverging = replace(DIRECT, divergence_limit=1e-6)
    case = replace(case_of(choice, diverging), results=("stress", "instants"), material=steel)
    run_case(case, contact, stress_operator(model, steel), tmp_path / "case.nc")
    found = read_dataset(tmp_path / "case.nc")
    assert found["status"].values.all() and found["max_von_mises_of_instant"].isnull().all()


def test_half_a_step_is_half_of_the_one_taken(judged, tmp_path):
    """A step far beyond the sampling instants is shortened to them: half of it would be shortened to the same."""
    outcome = judged(case_of(IntegrationChoice(1e-5, 4, 620, integrator="exact_modal"), speeds=(1495.0, 1500.0)))
    steps = [read_dataset(tmp_path / f"{name}.nc")["time_step"].values for name in ("case", "half")]
    np.testing.assert_allclose(steps[0], 2.0 * np.pi / np.array([1495.0, 1500.0]) / 620)
    np.testing.assert_allclose(steps[1], 0.5 * steps[0], rtol=1e-12)
    assert outcome["step"] == pytest.approx(steps[0].mean())
    assert outcome["detail"] != "mean rms changes by 0% with half the step"


def test_a_silent_wrong_number_is_not_accepted(judged, monkeypatch):
    from r37core.studies.stability import report

    monkeypatch.setattr(report, "ENERGY_WITHIN", 1e-30)
    with pytest.raises(AssertionError, match="energy balance open"):
        judged(case_of(IntegrationChoice(2e-7, 4, 62)))


def test_a_case_is_plain_data():
    lined = replace(ABRADABLE, friction=None)
    case = case_of(IntegrationChoice(2e-7, 4, 62), lined, crossing=("1B", 4), history_speeds=None)
    for one in (case, replace(case, model=ModelChoice(5000, 8, 10, False, "camber", corners=True), scene=None, refused="why")):
        assert from_plain(Case, json.loads(json.dumps(to_plain(one)))) == one


def test_a_model_has_the_name_of_its_choice():
    for choice in (
        ModelChoice(5000, 8, 0, False, "pressure_edge", corners=True),
        ModelChoice(1500, 2, 10, True, "camber", corners=False),
    ):
        assert re.fullmatch(MODEL_NAME, choice.name)
        assert model_of_name(choice.name) == choice


def test_changes_leave_the_entry_alone():
    entry = {"casing": {"lobes": 2}, "damping_ratio": 0.1}
    assert changed(entry, {"casing.lobes": 5, "damping_ratio": 0.0}) == {"casing": {"lobes": 5}, "damping_ratio": 0.0}
    assert changed(entry, {"damping_ratio": lambda value: 2 * value}) == {"casing": {"lobes": 2}, "damping_ratio": 0.2}
    assert entry == {"casing": {"lobes": 2}, "damping_ratio": 0.1}


def test_every_extreme_has_a_name_of_its_own():
    names = [extreme.name for extreme in extremes("abradable", "direct")]
    assert len(names) == len(set(names)) > 90


def test_modes_that_are_left_out(contact):
    problem = Problem(contact, 1500.0, DIRECT, IntegrationChoice(2e-7, 1, 62, highest_frequency=2e4))
    assert problem.blade.frequencies[-1] <= 2 * np.pi * 2e4
    assert 5 < len(problem.blade.frequencies) < len(contact.squared_frequencies)


@pytest.mark.parametrize("instants", [60, 1000])
def test_stress_instants_are_among_the_samples(root, instants):
    level = {"values": ["standard"], "reference": "standard"}
    several = {"values": [62, instants], "reference": 62}
    changes = command_line_document({"studies": {"tradeoff": {"parameters": {"level": level, "stress_instants": several}}}})
    message = rf"studies\.tradeoff\.parameters\.stress_instants\.values\.1: found {instants}; allowed: divisors of 496, the"
    with pytest.raises(ConfigError, match=message):
        read_settings(root, changes)


def test_the_former_name_of_a_study_is_refused_with_the_new_one(root):
    message = r"studies\.readings: found the former name of modelling_choices; allowed: modelling_choices, with the same keys"
    with pytest.raises(ConfigError, match=message):
        read_settings(root, command_line_document({"studies": {"readings": {"quick": "draft"}}}))


def test_blades_of_ones_own_alone(config_copy):
    """A study that no blade is named for takes the first; the reference blade need not be in the file."""
    file = config_copy / "config/blades.yaml"
    head, rest = file.read_text().split("\nRef:", 1)
    file.write_text(head + "\nMine:" + rest.split("\nL50:", 1)[0] + "\n")
    settings = read_settings(config_copy)
    assert list(settings.blades) == ["Mine"]
    assert {case.blade for case in tradeoff.cases(settings).values()} == {"Mine"}


def test_a_crossing_that_is_not_there_is_named(settings, tmp_path):
    """A blade of one's own may have none with the engine order about which a study looks."""
    case = next(iter(tradeoff.cases(settings).values()))
    crossing = xr.DataArray([[np.nan]], {"mode": ["1B"], "engine_order": [4]}, name="crossing_speed")
    write_dataset(crossing.to_dataset(), tmp_path / "campbell.nc", {})
    with pytest.raises(ValueError, match="1B of Ref does not cross engine order 4; choose another engine_order"):
        runner.run_case_of_files(case, {"campbell": str(tmp_path / "campbell.nc")}, tmp_path / "case.nc")


@pytest.mark.slow
def test_tradeoff_of_a_small_sweep(compiled, project):
    parameters = (
        "{ level: { values: [tiny, draft], reference: draft }, bars: { values: [3000, 10000], reference: 10000 }, "
        "revolutions: { values: [2, 3, 4], reference: 4 } }"
    )
    # these alone
    overlay(project, "config.yaml", "studies:")
    overlay(project, "config.yaml", f"studies: {{ tradeoff: {{ base: tiny, parameters: {parameters} }} }}")
    snakemake(project, "tradeoff", "--cores", "2")
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
    overlay(project, "config.yaml", "{ blades: [CS100], scenes: [direct] }")
    assert "simulate" in planned(project)
    text = snakemake(project, "modelling_choices", "--cores", "2", "--dry-run", check=False)
    assert re.search(
        r"config\.yaml: the study needs the (blade|scene) '(Ref|abradable)'; allowed in this run: (CS100|direct)", text
    )


@pytest.mark.slow
def test_an_extreme_and_modelling_choices_run(compiled, project):
    steps = "{ fine: 100, coarse: 100, survey: 100 }"
    choices = f"{{ base: tiny, quick: tiny, speed_steps_rad_s: {steps} }}"
    studies = f"{{ stability: {{ base: tiny }}, modelling_choices: {choices} }}"
    # the study is of all blades, though only some of its cases are run
    overlay(project, "config.yaml", f"{{ blades: all, studies: {studies} }}")
    extreme = [f"results/studies/stability/lobes_5_direct{half}.nc" for half in ("", "__half_step")]
    varied, shipped, histories, survey = (
        f"results/studies/modelling_choices/{name}.nc"
        for name in ("inside/CS100_4", "shipped/Ref_4", "shipped/Ref_histories", "survey/CS100_lined")
    )
    snakemake(project, *extreme, varied, shipped, histories, survey, "--cores", "2")
    assert judge(*(read_dataset(project / file) for file in extreme))["outcome"] in ("accurate", "degraded")
    with xr.open_dataset(project / varied) as dataset:
        assert (dataset["rms_normal"] > 0.0).all()
        assert dataset.attrs["case"] == "corners not among the nodes"
    with xr.open_dataset(project / shipped) as dataset:
        assert (first_contact(dataset) >= 1.0).all()
        assert dataset.sizes["history_speed"] == 1
    with xr.open_dataset(project / histories) as dataset:
        assert list(dataset["history_speed"].values) == [1344.0, 1717.0, 1800.0]
        assert dataset["max_von_mises_history"].sizes["revolution"] == 8
    with xr.open_dataset(project / survey) as dataset:
        assert (dataset["amplitude_tangential"] >= 0.0).all()
    # the run's own level is the study's, so that its models serve for both; the other mesh has its own
    models = [file.parent.name for file in (project / "results/studies/models/CS100").glob("*/rom.nc")]
    assert models == ["10000_8_8_submesh_pressure_edge_inside"]


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
    kept = {"spectrum_highest_order": 10, "wear_angles": 8}
    case = Case("Ref", "pressure_edge", DIRECT, choice, (10.0, 180.0), ("energy",), material=None, kept=kept)
    runner.run_case(case, model, None, tmp_path / "case.nc")
    assert compiled == [0, 0]
    assert counts[1] <= counts[0] - 8
