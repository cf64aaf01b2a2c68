"""What runs again after a change: exactly what the change needs. Jobs only touch their outputs here."""

import os

import pytest
import yaml
from stubbed_runs import BLADES, SCENES, copy_stubbed, edit, refine, runs, simulated
from workflow_runs import copy_finished, overlay, own_package, plan, planned_outputs, snakemake

from r37core.base.yaml_file import load_yaml

pytestmark = pytest.mark.slow

SPEEDS = ("750", "1150", "1550")

# what follows any change of a simulation
DATASETS = {"configuration", "sweep_dataset", "summary", "explorer", "response_figure"}
DATASETS |= {"comparison_figure", "ranking", "ranking_figure"}
DATASETS |= {"interactions_figure"}
# of the blade and scene alone
MAPS = {"spectrum_figure", "wear_figure"}
STRUCTURE = {"geometry", "mesh", "reduced_model", "campbell_of_blade", "campbell_figure"}
OF_ALL_BLADES = {"campbell_of_all", "blade_shapes_figure"}


@pytest.fixture(scope="module")
def finished(root, tmp_path_factory):
    folder = tmp_path_factory.mktemp("stubbed")
    copy_stubbed(root, folder)
    snakemake(folder, "all_blades", "--cores", "2")
    return folder


@pytest.fixture
def project(finished, tmp_path):
    return copy_finished(finished, tmp_path / "project")


def per_run(file, blades=BLADES, scenes=SCENES):
    return {f"{blade}/{scene}/{file}" for blade in blades for scene in scenes}


def test_maps_are_of_the_runs_that_have_their_kind(finished):
    maps = {f"spectrum_{blade}__{scene}" for blade in BLADES for scene in SCENES}
    maps |= {f"wear_{blade}__abradable" for blade in BLADES}
    others = {f"{kind}_{blade}" for kind in ("campbell", "response") for blade in BLADES}
    others |= {"blades", "ranking", "interactions", *(f"comparison_{scene}" for scene in SCENES)}
    drawn = {file.name for file in (finished / "results/figures").iterdir()}
    assert drawn == {f"{name}.{suffix}" for name in maps | others for suffix in ("png", "pdf")}
    assert planned_outputs(finished) == {}


@pytest.mark.parametrize(
    ("speeds", "added"),
    [
        ("[{ start: 350, stop: 2400 }, 1000.5, 100, 3000]", {"350", "1950", "2350", "1000.5", "100", "3000"}),
        ("[750, 750.0000000001, 1150, 1550]", {"750.0000000001"}),
    ],
)
def test_an_added_speed_runs_alone(project, speeds, added):
    overlay(project, "config.yaml", f"speeds: {speeds}")
    jobs = planned_outputs(project)
    assert jobs.pop("simulate") == runs(added)
    assert jobs.pop("response") == per_run("response.nc")
    assert set(jobs) == DATASETS | MAPS


def test_tables_and_figure_wait_for_the_further_runs_of_a_verdict(project):
    overlay(project, "config.yaml", "operating: { idle_rad_s: 800, redline_rad_s: 1500 }")
    assert "verdict" not in planned_outputs(project)
    overlay(project, "config.yaml", "requirements: { above_yield_at_most_rad_s: 0 }")
    taken_by = {file for job in plan(project) if "results/further_runs.nc" in job.inputs for file in job.outputs}
    files = {"ranking.csv", "summary.csv", "figures/response_Ref.png"}
    assert {f"results/{file}" for file in files} <= taken_by


@pytest.mark.parametrize(("change", "again"), [("speeds: [750, 1150]", {"response", *MAPS}), ("blades: [Ref]", OF_ALL_BLADES)])
def test_a_removed_speed_or_blade_runs_no_simulation(project, change, again):
    overlay(project, "config.yaml", change)
    assert set(planned_outputs(project)) == DATASETS | again


def test_a_list_that_becomes_adaptive_runs_what_its_rounds_ask_for(project):
    # as in a real sweep, older than the responses; else Snakemake has a reason of its own to make these again
    for file in project.glob("results/*/campbell.nc"):
        os.utime(file, (next(file.parent.glob("rom_*.nc")).stat().st_mtime,) * 2)
    refine(project)
    done = simulated(snakemake(project, "all_blades", "--cores", "2"))
    assert sorted(done) == sorted(runs(["1149", "1150.5"]))
    assert planned_outputs(project) == {}


def test_an_added_blade_runs_its_own_jobs(project):
    overlay(project, "config.yaml", "blades: [Ref, CS100, Eighth]")
    overlay(project, "blades.yaml", "Eighth: { base: Ref, chordwise_sweep_deg: 7.5 }")
    jobs = planned_outputs(project)
    assert jobs.pop("simulate") == runs(SPEEDS, blades=["Eighth"])
    for rule in STRUCTURE | MAPS | {"response", "prepare_time_integration", "contact_model", "stress_operator"}:
        assert all("Eighth" in file for file in jobs.pop(rule)), rule
    assert set(jobs) == DATASETS | OF_ALL_BLADES


@pytest.mark.parametrize("scene", ["direct", "bare"])
def test_friction_or_a_new_name_runs_its_scene(project, scene):
    edit(project, "scenes.yaml", "direct:", f"{scene}:")
    overlay(project, "config.yaml", f"scenes: [abradable, {scene}]")
    if scene == "direct":
        overlay(project, "scenes.yaml", "direct: { friction: { coefficient: 0.2 } }")
    jobs = planned_outputs(project)
    assert jobs.pop("simulate") == runs(SPEEDS, scenes=[scene])
    assert jobs.pop("response") == per_run("response.nc", scenes=[scene])
    assert jobs.pop("prepare_time_integration") == per_run("time_integration.stamp", scenes=[scene])
    assert jobs.pop("spectrum_figure") == {f"figures/spectrum_{blade}__{scene}.png" for blade in BLADES}
    assert set(jobs) == DATASETS


def test_a_changed_base_runs_what_depends_on_it_and_nothing_else(project):
    """`direct` and `Thin` have the damping of their base; `direct` has no lining, and `Thin` a thickness of its own."""
    overlay(project, "config.yaml", "scenes: [abradable, direct, Thin]")
    overlay(project, "scenes.yaml", "Thin: { base: abradable, lining: { thickness_m: 0.003 } }")
    assert sorted(simulated(snakemake(project, "all_blades", "--cores", "2"))) == sorted(runs(SPEEDS, scenes=["Thin"]))
    file = project / "config/scenes.yaml"
    finished = file.read_text()
    for change, scenes in (
        ("abradable: { damping_ratio: 0.001 }", ("abradable", "direct", "Thin")),
        ("abradable: { lining: { bars: 5000 } }", ("abradable", "Thin")),
        ("abradable: { lining: { thickness_m: 0.004 } }", ("abradable",)),
        ("Thin: { lining: { thickness_m: 0.002 } }", ("Thin",)),
    ):
        overlay(project, "scenes.yaml", change)
        jobs = planned_outputs(project)
        assert jobs.pop("simulate") == runs(SPEEDS, scenes=scenes), change
        assert jobs.pop("response") == per_run("response.nc", scenes=scenes)
        assert jobs.pop("prepare_time_integration") == per_run("time_integration.stamp", scenes=scenes)
        drawn = {file for rule in MAPS for file in jobs.pop(rule, ())}
        assert {file.rpartition("__")[2] for file in drawn} == {f"{scene}.png" for scene in scenes}
        assert set(jobs) == DATASETS
        file.write_text(finished)


SHAPES = {"whole_blade_model", "mode_shapes", "worst_shapes", "modes_figure", "worst_shapes_figure"}
SIGNALS = {"signals_of_run"}


def test_shapes_run_no_simulation(project):
    """Asked for, they are made of what is there, and the page links them; one model of the whole blade serves all."""
    overlay(project, "scenes.yaml", "abradable: { results: [spectrum, signal, stress, wear, energy, shapes] }")
    jobs = planned_outputs(project)
    assert set(jobs) == SHAPES | {"configuration", "explorer"}
    assert jobs["worst_shapes"] == {f"shapes/{blade}/stress_abradable" for blade in BLADES}
    snakemake(project, "all_blades", "--cores", "2")
    assert planned_outputs(project) == {}
    file = project / "config/config.yaml"
    finished = file.read_text()
    overlay(project, "config.yaml", "operating: { idle_rad_s: 750, redline_rad_s: 1550 }")
    # it is marked in figures over speed alone
    assert "response_figure" in (again := set(planned_outputs(project))) and again.isdisjoint(SHAPES)
    file.write_text(finished)
    overlay(project, "config.yaml", "shapes: { modes: 3 }")
    assert set(planned_outputs(project)) == SHAPES | {"configuration"}


def test_signals_run_no_simulation_of_the_sweep(project):
    """At named speeds they are runs of their own; a gauge more runs those again and makes the model of the whole blade."""
    overlay(project, "config.yaml", "signals: { speeds_rad_s: [1151.5] }")
    jobs = planned_outputs(project)
    assert set(jobs) == SIGNALS | {"configuration"}
    assert jobs["signals_of_run"] == per_run("signals.nc")
    snakemake(project, "all_blades", "--cores", "2")
    assert planned_outputs(project) == {}
    overlay(project, "config.yaml", "signals: { gauges: { root: { chord: 0.5, span: 0.1, side: suction } } }")
    assert set(planned_outputs(project)) == SIGNALS | {"configuration", "whole_blade_model"}
    overlay(project, "config.yaml", "signals: { blades: [Ref], speeds_rad_s: interactions }")
    assert planned_outputs(project)["signals_of_run"] == per_run("signals.nc", blades=["Ref"])


def test_another_level_runs_what_differs_and_back_keeps_all(project):
    """A level with the same mesh and reduction, then one with another mesh, then the first again."""
    level = load_yaml(project / "config/fidelity.yaml")["tiny"]
    level["time_integration"]["largest_time_step_s"] = {"lined": 3.2e-6, "direct": 3.2e-6}
    overlay(project, "fidelity.yaml", yaml.safe_dump({"same_mesh": level}))
    jobs = planned_outputs(project, "all_blades", "--config", "fidelity=same_mesh")
    assert jobs.pop("simulate") == runs(SPEEDS)
    # the Campbell diagrams of all blades are gathered again: their file names the level
    assert not (STRUCTURE | {"contact_model"}) & set(jobs)
    jobs = planned_outputs(project, "all_blades", "--config", "fidelity=draft")
    assert jobs["mesh"] == {f"{blade}/mesh.msh" for blade in BLADES}
    assert "geometry" not in jobs
    assert planned_outputs(project) == {}


def test_editing_one_blade_runs_that_blade(project):
    file = project / "config/stacking/rotor37.csv"
    file.write_text(file.read_text().replace("CS100,100,-1.16,4.89", "CS100,100,-1.20,4.89"))
    jobs = planned_outputs(project)
    assert jobs["geometry"] == {"CS100/geometry.nc"}
    assert jobs["reduced_model"] == {"CS100/rom_pressure_edge.nc"}
    assert jobs["simulate"] == runs(SPEEDS, blades=["CS100"])


OF_MODELS = STRUCTURE | {"contact_model"}
BEFORE_RUNS = OF_MODELS | {"stress_operator", "prepare_time_integration"}
STRENGTHS = "fatigue_strength_pa: 6e+8, ultimate_strength_pa: 1.5e+9"


@pytest.mark.parametrize(
    ("name", "change", "again", "kept"),
    [
        ("blades", "Ref: { material: { density_kg_m3: 8001.0 } }", runs(SPEEDS), {"geometry", "mesh"}),
        ("blades", "Ref: { material: { yield_stress_pa: 1.39e+9 } }", set(), OF_MODELS),
        ("blades", f"Ref: {{ material: {{ {STRENGTHS} }} }}", set(), BEFORE_RUNS),
        ("config", "structure: { spin_softening: true }", runs(SPEEDS), {"geometry", "mesh"}),
        ("scenes", "direct: { results: [signal, stress, energy] }", runs(SPEEDS, scenes=["direct"]), OF_MODELS),
        ("scenes", "direct: { stress_history_speeds_rad_s: [1150] }", set(), BEFORE_RUNS),
    ],
)
def test_a_material_rotation_or_wanted_result_runs_what_depends_on_it(project, name, change, again, kept):
    overlay(project, f"{name}.yaml", change)
    jobs = planned_outputs(project)
    assert jobs.get("simulate", set()) == again and "response" in jobs and not kept & set(jobs)
    # the base of the other blade, too
    assert "reduced_model" in kept or jobs["reduced_model"] == {f"{blade}/rom_pressure_edge.nc" for blade in BLADES}


def planned_after_a_touch(project, files, *arguments):
    """What runs again when these files have a new time and the same content; their times are put back."""
    times = {file: file.stat().st_mtime_ns for file in files}
    for file in files:
        os.utime(file)
    jobs = planned_outputs(project, "all_blades", *arguments)
    for file, time in times.items():
        os.utime(file, ns=(time, time))
    return jobs


@pytest.mark.parametrize("profile", ["profiles/default", "profiles/node"])
def test_a_new_time_of_any_file_of_ours_runs_nothing(project, profile):
    """As after a checkout."""
    own_package(project)
    chosen = "--workflow-profile", profile
    files = [
        file
        for folder in ("workflow", "src", "envs", "profiles", "Snakefile")
        for file in [project / folder, *(project / folder).rglob("*")]
        if file.is_file() and not {"__pycache__", "config"} & set(file.parts)
    ]
    assert {"step.py", "sweep.smk", "laws.py"} <= {file.name for file in files}
    if planned_after_a_touch(project, files, *chosen):
        # one by one, to name those at fault
        assert [file.relative_to(project) for file in files if planned_after_a_touch(project, [file], *chosen)] == []


@pytest.mark.parametrize(
    ("file", "old", "new", "first", "simulated"),
    [
        # how the lining is worn
        ("src/r37core/contact/laws.py", "wear + thickness * excess", "wear + excess", "prepare_time_integration", runs(SPEEDS)),
        ("src/r37core/stress/statistic.py", "HIGH = 0.9", "HIGH = 0.8", "response", set()),
        ("src/r37core/stress/statistic.py", "last > 1.0", "last > 0.9", "response", set()),
        ("workflow/scripts/step.py", "return None", "return 0", "geometry", runs(SPEEDS)),
    ],
)
def test_a_changed_line_runs_what_depends_on_it(project, file, old, new, first, simulated):
    own_package(project)
    text = (project / file).read_text()
    assert text.count(old) == 1
    (project / file).write_text(text.replace(old, new))
    jobs = planned_outputs(project)
    assert jobs["response"] == per_run("response.nc")
    assert jobs.get("simulate", set()) == simulated
    assert first in jobs and (first == "geometry" or not {"geometry", "mesh", "reduced_model"} & set(jobs))
