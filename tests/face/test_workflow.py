"""The workflow through Snakemake: what is planned, what is re-run, and a small real run."""

import contextlib
import errno
import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections import Counter
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
import yaml
from browser import opened
from snakemake.exceptions import WorkflowError
from workflow_runs import LONGEST, copy_odd_project, digests, lose_speed, overlay, plan, planned, run_in_odd_project, snakemake

from r37core.base.dataset_file import read_dataset
from r37core.base.io import OutputFileError, atomic_write
from r37core.base.yaml_file import load_yaml
from r37core.console.report import main as report
from r37core.console.snakemake_run import check_machine
from r37core.time_integration.speed_file import read_speed

pytestmark = pytest.mark.slow


def test_results_of_a_real_run(small_sweep):
    results = small_sweep / "results"
    names = ("campbell", "rms", "wear", "stress", "CS100/rom_pressure_edge")
    campbell, rms, wear, stress, model = (read_dataset(results / f"{name}.nc") for name in names)
    assert list(campbell["blade"].values) == ["Ref", "CS100"]
    assert campbell["frequency"].sel(blade="Ref", mode="1B", speed=0.0).item() == pytest.approx(839.3, rel=0.01)
    assert campbell["crossing_speed"].sel(blade="Ref", mode="1B", engine_order=4).item() == pytest.approx(1672, rel=0.01)
    assert [model.attrs[name] for name in ("blade", "fidelity", "basis_columns")] == ["CS100", "tiny", 96]
    assert len(rms.attrs["input_hash"]) == 16
    assert rms["rms_normal"].shape == (2, 2, 3, 2)
    assert (rms["status"] == 0).all()
    assert (rms["rms_normal"] > 0.0).all()
    balance = abs(rms["energy_residual"]) / (abs(rms["contact_work"]) + rms["damping_loss"])
    assert float(balance.max()) < 1e-9
    assert list(wear["scene"].values) == ["abradable"]
    assert (wear["max_wear"] > 0.0).all() and (stress["max_von_mises_last_revolution"] > 0.0).all()
    columns = "blade,scene,mode,engine_order,direction,campbell_speed_rad_s"
    assert (results / "summary.csv").read_text().startswith(columns)
    drawn = ["campbell_Ref", "campbell_CS100", "blades", "response_Ref", "spectrum_Ref__direct"]
    for name in [*drawn, "wear_CS100__abradable"]:
        assert (results / f"figures/{name}.png").stat().st_size > 10_000
    for name in ("mesh.msh", "mesh.vtu", "geometry.nc"):
        assert (results / "Ref" / name).exists()
    assert not list(results.rglob(".*partial*"))


def test_blades_are_finished_one_after_another(project):
    jobs = {(job.wildcards["blade"], job.priority) for job in plan(project) if job.rule == "simulate"}
    assert jobs == {("Ref", 1.0), ("CS100", 0.5)}


def test_shapes_and_signals_of_a_finished_run(root, sweep_copy):
    """As the pages ask for them, of one blade: made of what is there, and the signal is that of the sweep's run."""
    asked = next(block for block in blocks(root, "yaml") if block.startswith("signals:"))
    overlay(sweep_copy, "config.yaml", asked.replace("speeds_rad_s: interactions", "speeds_rad_s: [1150]"))
    # one speed more, so that there is an interaction: 1B with order 6
    overlay(sweep_copy, "config.yaml", "{ blades: [Ref], speeds: [{ start: 750, stop: 1600 }, 1000] }")
    overlay(sweep_copy, "scenes.yaml", "abradable: { results: [shapes, spectrum, signal, stress, wear, energy] }")
    snakemake(sweep_copy, "results/summary.csv", "--cores", "2")
    made = ["figures/shapes_Ref.png", "figures/shapes_Ref__abradable.png"]
    made += [f"Ref/{scene}/signals.nc" for scene in ("abradable", "direct")]
    given = [f"results/{name}" for name in made]
    assert "rule simulate:" not in made_of_all(sweep_copy, given)
    results = sweep_copy / "results"
    assert all((results / name).stat().st_size > 10_000 for name in made)
    found = pd.read_csv(results / "summary.csv").query("blade == 'Ref' and scene == 'abradable'")
    assert len(found)
    names = {f"stress_{speed:g}.vtu" for speed in found["peak_speed_rad_s"]}
    assert {file.name for file in (results / "shapes/Ref/stress_abradable").glob("*.vtu")} == names
    rms = read_dataset(results / "rms.nc")
    for scene in ("abradable", "direct"):
        run = read_dataset(results / f"Ref/{scene}/signals.nc").isel(speed=0)
        same = {"blade": "Ref", "scene": scene, "speed": run["speed"].item()}
        last_half = run["normal"].sel(turn=slice(4.001, 8))
        np.testing.assert_allclose(np.sqrt((last_half**2).mean("turn")), rms["rms_normal"].sel(same), rtol=1e-5)
        assert np.isfinite(run["arrival_time"].isel(revolution=slice(1, -1))).all()
        assert np.isfinite(run["strain"]).all() and 1e-6 < np.abs(run["strain"]).max() < 0.1
    run_python(next(block for block in blocks(root, "python") if "signals.nc" in block).replace("1716.0", "1150.0"), sweep_copy)
    assert planned(sweep_copy, *given) == {}


def made_of_all(project, files, *arguments):
    """What is printed when these files are made, which are among those of the whole workflow; drawing all takes long."""
    assert set(files) <= {file for job in plan(project, "all_blades", *arguments) for file in job.outputs}
    return snakemake(project, *files, *arguments, "--cores", "2")


def test_run_ups_of_a_finished_run(sweep_copy):
    """Run-ups start from what is there; one at constant speed is the sweep's run, and its stress is that of the response."""
    (sweep_copy / "config/run_ups.yaml").write_text(
        "run_ups:\n"
        "  level: { from_rad_s: 1150, to_rad_s: 1150, revolutions: 2, revolutions_before: 8 }\n"
        "  up: { blades: [Ref], from_rpm: 10000, to_rpm: 10500, rate_rpm_s: 20000 }\n"
        "  again: { scenes: [abradable], from_rad_s: 1200, to_rad_s: 1100, revolutions: 6.5, lining: worn }\n"
    )
    given = ("run_ups", "--configfile", "config/config.yaml", "config/run_ups.yaml")
    text = snakemake(sweep_copy, *given, "--cores", "2")
    assert "rule simulate" not in text
    results = sweep_copy / "results"
    runs, rates = (pd.read_csv(results / f"{name}.csv") for name in ("run_ups", "run_up_rates"))
    assert len(runs) == 2 * 2 + 2 + 2
    # those at constant speed have no rate
    assert len(rates) == 4
    assert set(runs["direction"]) == {"up", "down"}
    assert (runs["largest_stress_pa"] > 0.0).all()
    found, rms = (read_dataset(results / f"{name}.nc") for name in ("run_ups", "rms"))
    residual = abs(found["energy_residual"]) / (abs(found["contact_work"]) + found["damping_loss"])
    assert float(residual.max()) < 1e-9
    for row in range(found.sizes["run"]):
        run = found.isel(run=row)
        speed, whole = run["speed"].dropna("revolution"), int(run["speed"].notnull().sum())
        assert np.isfinite(run["max_von_mises"][:whole]).all()
        assert speed[0] == pytest.approx(float(run["start_speed"]), rel=1e-9)
        if run["run_up"].item() == "level":
            same = {"blade": run["blade"].item(), "scene": run["scene"].item(), "speed": 1150.0}
            normal = run["rms_normal"].isel(revolution=slice(4, 8))
            np.testing.assert_allclose(np.sqrt((normal**2).mean("revolution")), rms["rms_normal"].sel(same), rtol=1e-5)
            largest = run["maximum_normal"].isel(revolution=slice(0, 8))
            np.testing.assert_allclose(largest, rms["revolution_maximum"].sel(same), rtol=1e-5)
    for name in ("run_ups_Ref__abradable", "run_ups_CS100__direct", "run_up_rates_direct"):
        assert (results / f"figures/{name}.png").stat().st_size > 10_000
    assert planned(sweep_copy, *given) == {}


def test_second_motions_of_a_finished_run(sweep_copy):
    """Sweeps start from the models that are there; the motion from rest is the run of the sweep; answers have the worst one."""
    (sweep_copy / "config/second_motions.yaml").write_text(
        "second_motions:\n  { from_rad_s: 1140, to_rad_s: 1160, step_rad_s: 10, revolutions: 10 }\n"
    )
    given = ("--configfile", "config/config.yaml", "config/second_motions.yaml")
    figures = [f"results/figures/second_motions_{name}.png" for name in ("Ref__abradable", "CS100__direct")]
    tables = [f"results/{name}.csv" for name in ("second_motions", "ranking")]
    files = [*figures, *tables, "results/second_motions.nc"]
    assert "rule simulate" not in made_of_all(sweep_copy, files, *given)
    results = sweep_copy / "results"
    motions, rms = (read_dataset(results / f"{name}.nc") for name in ("second_motions", "rms"))
    assert motions.sizes == {"blade": 2, "scene": 2, "motion": 3, "speed": 3}
    same = {"speed": 1150.0}
    from_rest = motions["rms_normal"].sel(motion="rest", **same)
    np.testing.assert_array_equal(from_rest, rms["rms_normal"].sel(tip_point="leading_edge", **same))
    ranking = pd.read_csv(results / "ranking.csv")
    assert (ranking["length_most_revolutions_worst_rad_s"] >= ranking["length_most_revolutions_rest_rad_s"]).all()
    assert all((sweep_copy / figure).stat().st_size > 10_000 for figure in figures)
    assert not list(results.rglob("*.parts"))
    assert planned(sweep_copy, *files, *given) == {}


def test_tolerances_of_a_finished_run(root, sweep_copy):
    """Members run beside the nominal runs; one with nominal values is the nominal run."""
    (file := sweep_copy / "config/tolerances.yaml").write_text(
        "tolerances:\n  members: 2\n  blades: [Ref]\n"
        "  of_scenes: { friction.coefficient: { values: [0.15] }, lining.thickness_m: { uniform_percent: 5 } }\n"
        "  of_blades: { material.yield_stress_pa: { uniform_percent: 10 } }\n"
    )
    given = ("all_blades", "--configfile", "config/config.yaml", "config/tolerances.yaml")
    text, results = snakemake(sweep_copy, *given, "--cores", "2"), sweep_copy / "results"
    # from the models that are there
    assert not re.search(r"rule (simulate|response|reduced_model):", text)
    assert not [file for file in results.glob("tolerances/.structures/*") if file.is_file()]
    found, rms = (read_dataset(results / f"{name}.nc").sel(blade="Ref", scene="direct") for name in ("tolerances", "rms"))
    assert found["member"].values.tolist() == [0, 1]
    edge = rms["rms_normal"].sel(tip_point="leading_edge")
    np.testing.assert_array_equal(found["rms_normal"], [edge, edge])
    limits = found["yield_stress"].values
    np.testing.assert_array_equal(limits, found["value"].sel(number="material.yield_stress_pa"))
    assert limits[0] != limits[1]
    assert (read_dataset(results / "tolerances.nc")["status"] == 0).all()
    summary, table = pd.read_csv(results / "summary.csv"), pd.read_csv(results / "tolerances.csv")
    assert set(table["blade"]) <= {"Ref"} and "share_of_members" in summary
    assert (results / "figures/tolerances_Ref__direct.png").stat().st_size > 10_000
    program = re.search(r"```python\n(.*?)```", (root / "docs/tolerances.md").read_text(), re.DOTALL)[1]
    run_python(program.replace("material_abradable", "abradable"), sweep_copy)
    assert planned(sweep_copy, *given) == {}
    file.write_text(file.read_text().replace("members: 2", "members: 4"))
    more = planned(sweep_copy, *given)
    assert more["tolerance_members"] == {"Ref"} and "simulate" not in more


def test_physical_scenes_are_planned_in_a_folder_of_their_own(root, tmp_path):
    files = ["--configfile", str(root / "config/config.yaml"), str(root / "config/physical.yaml")]
    jobs = plan(root, "all_blades", *files, "--directory", str(tmp_path))
    assert "results/CS100/physical_direct/response.nc" in {file for job in jobs for file in job.outputs}
    scenes = {job.wildcards["scene"] for job in jobs if "scene" in job.wildcards}
    assert scenes == {"physical_abradable", "physical_direct"}


def test_only_what_a_scene_requires(project, structure_copy):
    """Rules and arrays: no recovery basis without stress, no bars without a lining, no simulation for a Campbell diagram."""
    overlay(project, "scenes.yaml", "{ abradable: { results: [] }, direct: { results: [stress] } }")
    overlay(project, "config.yaml", "{ blades: [Ref], speeds: [900] }")
    jobs = plan(project)
    inputs = {job.wildcards["scene"]: job.inputs for job in jobs if job.rule == "simulate"}
    with_stress = {scene: any("stress_" in file for file in inputs[scene]) for scene in sorted(inputs)}
    assert with_stress == {"abradable": False, "direct": True}
    counts = Counter(job.rule for job in jobs)
    assert counts["simulate"] == counts["prepare_time_integration"] == 2
    assert not {"spectrum_figure", "wear_figure"} & set(counts)
    assert {job.outputs[0] for job in jobs if job.rule == "sweep_dataset"} == {"results/rms.nc", "results/stress.nc"}
    campbell = planned(project, "campbell")
    assert not {"simulate", "prepare_time_integration", "contact_model", "response"} & set(campbell)
    shutil.copytree(project / "config", structure_copy / "config", dirs_exist_ok=True)
    snakemake(structure_copy, "results/Ref/abradable/response.nc", "results/Ref/direct/response.nc", "--cores", "2")
    run = read_speed(structure_copy / "results/Ref/abradable/speed_900.npz")
    assert not {"wear", "snapshots", "amplitude", "contact_work"} & set(run)
    none, stress = (set(read_dataset(structure_copy / f"results/Ref/{scene}/response.nc").variables) for scene in with_stress)
    assert not {"max_von_mises_last_revolution", "wear", "amplitude", "yield_stress", "angle", "lobes", "engine_order"} & none
    assert "max_von_mises_last_revolution" in stress and not {"wear", "amplitude", "contact_work"} & stress


def test_step_beyond_the_limit_stops_with_the_limit(sweep_copy):
    levels = load_yaml(sweep_copy / "config/fidelity.yaml")
    levels["tiny"]["time_integration"] = levels["paper"]["time_integration"] | {"time_step_s": 9.0e-7}
    (sweep_copy / "config/fidelity.yaml").write_text(yaml.safe_dump(levels))
    text = snakemake(sweep_copy, "results/Ref/direct/response.nc", "--cores", "1", check=False)
    assert "rule simulate:" not in text
    assert re.search(r"rule prepare_time_integration: time_step_s: 9e-07 s .* limit of this reduced model, [\d.e-]+ s", text)


def test_a_simulation_that_is_lost_runs_again_alone_and_half_written_input_is_named(sweep_copy):
    lose_speed(sweep_copy / "results/Ref/direct/speed_1150.npz")
    (sweep_copy / "results/summary.csv").unlink()
    assert [job.outputs for job in plan(sweep_copy) if job.rule == "simulate"] == [["results/Ref/direct/speed_1150.npz"]]
    file = sweep_copy / "results/Ref/rom_pressure_edge.nc"
    file.write_bytes(file.read_bytes()[:5000])
    text = snakemake(sweep_copy, "results/Ref/campbell.nc", "--cores", "1", "--forcerun", "campbell_of_blade", check=False)
    assert "results/Ref/rom_pressure_edge.nc: cannot be read" in text
    assert "delete it and run again" in text


def test_one_core_gives_the_same_bits_in_any_folder(root, small_sweep, tmp_path, monkeypatch):
    """One whose name a shell would take apart, and by `make`; all but the figures of simulations, which take long."""
    monkeypatch.setenv("R37_CACHE", str(tmp_path / "cache"))
    project = copy_odd_project(root, tmp_path)
    run_in_odd_project(project, "make", "campbell", "CORES=1")
    snakemake(project, "tables", "--cores", "1")
    assert not list(project.parent.rglob("EXECUTED"))
    made = digests(project)
    assert {"results/figures/campbell_Ref.pdf", "results/rms.nc", "results/ranking.csv"} <= made.keys()
    assert made.items() <= digests(small_sweep).items()


def test_report_of_a_run_by_its_own_configuration(sweep_copy, monkeypatch, capsys):
    """Whatever config.yaml says since, or a command line said then; a folder without a run is refused with what there is."""
    results = sweep_copy / "results/runs/first"
    (sweep_copy / "results").rename(sweep_copy / "first")
    results.parent.mkdir(parents=True)
    (sweep_copy / "first").rename(results)
    configuration = json.loads((results / "configuration.json").read_text())
    configuration["config"]["run"]["name"] = "first"
    (results / "configuration.json").write_text(json.dumps(configuration))
    overlay(sweep_copy, "config.yaml", "{ blades: [S100], speeds: [1000] }")

    monkeypatch.chdir(sweep_copy)
    for folder in ("results", "results/runs/frist"):
        assert report([folder]) == 1
        refused = capsys.readouterr().err
        assert f"report: found {folder}, where no configuration.json of a run lies" in refused
        assert refused.endswith("; runs with a name: results/runs/first\n")
    command = [sys.executable, "-m", "r37core.console.report", "results/runs/first"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
    assert done.returncode == 0, done.stderr
    with zipfile.ZipFile(results / "report.zip") as archive:
        names = {Path(name).name for name in archive.namelist()}
    assert names >= {"report.html", "summary.csv", "response_CS100.png"} and "response_S100.png" not in names
    shutil.copytree(results, sweep_copy / "results/runs/copy")
    assert report(["results/runs/copy"]) == 1
    assert "found results/runs/copy, a copy of the results in results/runs/first" in capsys.readouterr().err


def test_files_with_other_times_run_nothing_again(sweep_copy):
    """As `cp -r` gives them, in the order of its writing. Files above a megabyte count by their content, too."""
    models = list(sweep_copy.glob("results/*/rom_*.nc"))
    assert models and all(file.stat().st_size > 10**6 for file in models)
    for file in models:
        os.utime(file)
    assert planned(sweep_copy) == {}
    with models[0].open("ab") as model:
        model.write(b"more")
    assert "contact_model" in planned(sweep_copy)


def test_a_folder_that_cannot_be_written_is_refused_before_the_first_job(sweep_copy, monkeypatch, capsys):
    """As on a read-only mount, which not even root may write."""
    monkeypatch.chdir(sweep_copy)
    monkeypatch.setattr(os, "access", lambda *_: False)
    told = "results: cannot be written; change the folder's rights, or work in a copy of the whole project (cp -a)"
    assert report(["results"]) == 1
    assert capsys.readouterr().err == f"{told}\n"
    with pytest.raises(WorkflowError, match=re.escape(told)):
        check_machine(Path("results"), WorkflowError, reads_only=False)
    check_machine(Path("results"), WorkflowError, reads_only=True)
    with pytest.raises(OutputFileError, match=r"a.nc: cannot be written: nobody may write there; change"), atomic_write("a.nc"):
        raise PermissionError(errno.EROFS, "Read-only file system")


def test_report_opens_offline(sweep_copy, tmp_path):
    """One archive: captions, categories by blade and scene, run times, the configuration."""
    snakemake(sweep_copy, "all_blades", "--report", str(tmp_path / "r37.zip"))
    shutil.unpack_archive(tmp_path / "r37.zip", tmp_path)
    files = {file.name for file in (tmp_path / "r37/data").rglob("*") if file.is_file()}
    assert files >= {"explorer.html", "summary.csv", "configuration.json", "wear_Ref__abradable.png", "campbell_Ref.png"}
    page_file = tmp_path / "r37/report.html"
    # of the libraries that Snakemake's page is made with
    known = ("cdn.tailwindcss.com should not be used in production", "The input spec uses Vega-Lite v3")
    with opened(page_file, {"width": 1400, "height": 900}, lambda text: not text.startswith(known)) as page:
        page.get_by_text("CS100", exact=True).first.click()
        page.get_by_text("abradable", exact=True).first.click()
        page.locator("a[iconname=information-circle]").first.click()
        page.get_by_text("Spectral map of blade CS100 in scene abradable: amplitude of").first.wait_for()
        page.goto(page_file.as_uri())
        page.get_by_text("Configuration", exact=True).first.click()
        page.locator("a[iconname=information-circle]").first.click()
        page.get_by_text("maximum_speed_rad_s").first.wait_for()
        assert page.problems == []


def blocks(root, language):
    """Code in what a user reads first."""
    pages = [(root / page).read_text() for page in ("README.md", "docs/results.md", "docs/blades.md")]
    return [block for page in pages for block in re.findall(rf"```{language}\n(.*?)```", page, re.DOTALL)]


def test_python_of_the_pages_runs(root, sweep_copy):
    found = [block for block in blocks(root, "python") if "signals.nc" not in block and "r37." not in block]
    assert len(found) >= 2
    for block in found:
        run_python(block, sweep_copy)


def run_python(block, folder):
    """In this process, which has imported what takes longer than the block, as a program of its own."""
    with contextlib.chdir(folder), plt.rc_context():
        exec(block, {"__name__": "__main__"})


def test_names_that_begin_alike_keep_their_files_apart(project):
    overlay(project, "blades.yaml", "{ A: { base: Ref }, A_b: { base: Ref } }")
    scenes = load_yaml(project / "config/scenes.yaml")
    (project / "config/scenes.yaml").write_text(yaml.safe_dump({"b_c": scenes["abradable"], "c": scenes["abradable"]}))
    jobs = plan(project, "all_blades", "--config", "blades=[A,A_b]", "scenes=[b_c,c]", "speeds=[900,1e3]")
    maps = [job for job in jobs if job.rule == "spectrum_figure"]
    assert {job.outputs[0]: job.wildcards for job in maps} == {
        f"results/figures/spectrum_{blade}__{scene}.png": {"blade": blade, "scene": scene}
        for blade in ("A", "A_b")
        for scene in ("b_c", "c")
    }
    files = {output.rsplit("/", 1)[1] for job in jobs if job.rule == "simulate" for output in job.outputs}
    assert files == {"speed_900.npz", "speed_1000.npz"}
