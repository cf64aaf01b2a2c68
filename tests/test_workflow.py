"""The workflow through Snakemake: what is planned, what is re-run, and a small real run."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))


def copy_project(root, to):
    for folder in ("config", "workflow", "profiles", "envs", "src"):
        shutil.copytree(root / folder, to / folder, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    shutil.copy(root / "Snakefile", to / "Snakefile")
    config = (to / "config/config.yaml").read_text()
    config = config.replace("blades: all ", "blades: [Ref, CS100] ").replace("fidelity: paper ", "fidelity: tiny ")
    (to / "config/config.yaml").write_text(config)
    with open(to / "config/fidelity.yaml", "a") as stream:
        stream.write(
            "\ntiny:\n  mesh: { nodes: 1500, layers: 1, tip_elements: 14 }\n  reduction: { fixed_interface_modes: 10 }\n"
        )


@pytest.fixture
def project(root, tmp_path):
    copy_project(root, tmp_path)
    return tmp_path


def snakemake(folder, *arguments, check=True):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("SNAKEMAKE")}
    environment["PYTHONPATH"] = str(folder / "src")
    done = subprocess.run(
        [SNAKEMAKE, *arguments], cwd=folder, env=environment, capture_output=True, text=True, timeout=600, check=False
    )
    assert not check or done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def planned(folder, *arguments):
    """Jobs of a dry run: rule -> blades (None for a rule without the wildcard)."""
    jobs = {}
    text = snakemake(folder, *(arguments or ("campbell",)), "--cores", "2", "--dry-run")
    for block in re.split(r"\n\[", text.split("Job stats:")[1] if text.startswith("Job stats") else text):
        rule = re.search(r"^(?:local)?rule (\w+):", block, re.MULTILINE)
        if rule:
            blade = re.search(r"wildcards: blade=(\w+)", block)
            jobs.setdefault(rule[1], set()).add(blade[1] if blade else None)
    return jobs


@pytest.fixture(scope="module")
def finished(root, tmp_path_factory):
    folder = tmp_path_factory.mktemp("two_cores")
    copy_project(root, folder)
    snakemake(folder, "campbell", "--cores", "2")
    return folder


@pytest.fixture
def finished_copy(finished, tmp_path):
    shutil.copytree(finished, tmp_path / "project", copy_function=shutil.copy2)
    return tmp_path / "project"


PER_BLADE = {"geometry", "mesh", "abaqus_deck", "matrices", "reduced_model", "campbell_of_blade", "campbell_figure"}
GATHERED = {"campbell_of_all", "campbell_overview", "blade_shapes_figure"}


def test_results_of_a_real_run(finished):
    with xr.open_dataset(finished / "results/campbell.nc") as dataset:
        assert list(dataset["blade"].values) == ["Ref", "CS100"]
        assert dataset["frequency"].sel(blade="Ref", mode="1B", speed=0.0).item() == pytest.approx(839.3, rel=0.01)
        assert dataset["crossing_speed"].sel(blade="Ref", mode="1B", engine_order=4).item() == pytest.approx(1672, rel=0.01)
    with xr.open_dataset(finished / "results/CS100/rom.nc") as dataset:
        assert dataset.attrs["blade"] == "CS100"
        assert dataset.attrs["fidelity"] == "tiny"
        assert dataset.attrs["basis_columns"] == 102
    for name in ("campbell.png", "campbell_Ref.png", "campbell_CS100.png", "blades.png"):
        assert (finished / "results/figures" / name).stat().st_size > 10_000
    for name in ("mesh.msh", "mesh.vtu", "mesh.inp", "geometry.nc", "matrices.npz"):
        assert (finished / "results/Ref" / name).exists()
    assert not list(finished.glob("results/**/.*partial*"))


def test_nothing_to_do_after_a_run(finished_copy):
    assert planned(finished_copy) == {}


def test_an_added_blade_runs_its_own_jobs_only(finished_copy):
    config = finished_copy / "config/config.yaml"
    config.write_text(config.read_text().replace("[Ref, CS100]", "[Ref, CS100, Eighth]"))
    with open(finished_copy / "config/blades.yaml", "a") as stream:
        stream.write("\nEighth: { base: Ref, chordwise_sweep_deg: 7.5 }\n")
    jobs = planned(finished_copy)
    assert {rule: blades for rule, blades in jobs.items() if rule in PER_BLADE} == {rule: {"Eighth"} for rule in PER_BLADE}
    assert set(jobs) - PER_BLADE <= GATHERED | {"campbell"}


def test_editing_one_blade_runs_that_blade_only(finished_copy):
    table = finished_copy / "config/stacking/rotor37.csv"
    table.write_text(table.read_text().replace("CS100,100,-1.16,4.89", "CS100,100,-1.20,4.89"))
    jobs = planned(finished_copy)
    assert jobs["geometry"] == {"CS100"}
    assert jobs["reduced_model"] == {"CS100"}


def test_editing_a_rotation_option_keeps_the_meshes(finished_copy):
    config = finished_copy / "config/config.yaml"
    config.write_text(config.read_text().replace("spin_softening: false", "spin_softening: true"))
    jobs = planned(finished_copy)
    assert jobs["reduced_model"] == {"Ref", "CS100"}
    assert not {"geometry", "mesh", "matrices", "abaqus_deck"} & set(jobs)


def test_bad_configuration_stops_before_the_dag(project):
    text = snakemake(project, "campbell", "--cores", "2", "--config", "fidelity=finest", check=False)
    assert "config/config.yaml: fidelity: found 'finest'; allowed: draft, standard, paper, tiny" in text
    assert not (project / "results").exists()


def test_impossible_blade_ends_in_one_message(project):
    table = project / "config/profiles/rotor37.csv"
    table.write_text(table.read_text().replace("50,21.761,21.622,56.190", "50,21.761,21.622,89.000"))
    text = snakemake(project, "results/Ref/geometry.nc", "--cores", "1", check=False)
    assert re.search(r"rule geometry: blade Ref: span 50%: no \w+-side arc", text)
    assert not (project / "results/Ref/geometry.nc").exists()


def test_half_written_input_is_named(finished_copy):
    file = finished_copy / "results/Ref/matrices.npz"
    file.write_bytes(file.read_bytes()[:5000])
    text = snakemake(finished_copy, "results/Ref/rom.nc", "--cores", "1", "--forcerun", "reduced_model", check=False)
    assert "results/Ref/matrices.npz: cannot be read" in text
    assert "delete it and run again" in text


def test_one_core_gives_the_same_bits(finished, project):
    snakemake(project, "campbell", "--cores", "1")

    def digests(folder):
        files = [f for f in sorted(folder.glob("results/**/*")) if f.is_file() and f.suffix != ".npz"]
        return {str(f.relative_to(folder)): hashlib.sha256(f.read_bytes()).hexdigest() for f in files}

    assert digests(project) == digests(finished)


def readme_blocks(root, language):
    return re.findall(rf"```{language}\n(.*?)```", (root / "README.md").read_text(), re.DOTALL)


def test_readme_python_runs(root, finished):
    blocks = readme_blocks(root, "python")
    assert len(blocks) >= 2
    for block in blocks:
        code = "import matplotlib\nmatplotlib.use('Agg')\n" + block
        subprocess.run([sys.executable, "-c", code], cwd=finished, check=True, capture_output=True, timeout=300)


def test_readme_blades_are_accepted(root, project):
    with open(project / "config/blades.yaml", "a") as stream:
        stream.write("\n" + "\n".join(readme_blocks(root, "yaml")))
    config = project / "config/config.yaml"
    config.write_text(config.read_text().replace("[Ref, CS100]", "[Mine, Stiffer, Drawn]"))
    assert planned(project)["geometry"] == {"Mine", "Stiffer", "Drawn"}


def test_readme_commands_exist(root):
    targets = re.findall(r"^make (\w+)", "\n".join(readme_blocks(root, "sh")), re.MULTILINE)
    makefile = (root / "Makefile").read_text()
    assert targets
    for target in targets:
        assert re.search(rf"^{target}:", makefile, re.MULTILINE)
