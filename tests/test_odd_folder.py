"""A project in a folder whose name a shell would take apart, with the virtual environment in it, as `make setup` has it."""

import os
import re
import subprocess
import sys
import venv

import pytest
from workflow_runs import LONGEST, copy_project

NAME = 'it\'s "my" $(touch EXECUTED) `touch EXECUTED`; touch EXECUTED & rotor'


@pytest.fixture(scope="module")
def folder(root, tmp_path_factory):
    """The small sweep of one blade in one scene, and an environment that borrows the packages of this one."""
    project = tmp_path_factory.mktemp("odd") / NAME
    project.mkdir()
    copy_project(root, project)
    for name in ("Makefile", "pyproject.toml", "cluster/sweep.sbatch"):
        (project / name).parent.mkdir(exist_ok=True)
        (project / name).write_text((root / name).read_text())
    file = project / "config/config.yaml"
    file.write_text(file.read_text().replace("[Ref, CS100]", "[Ref]").replace("scenes: all ", "scenes: [direct] "))
    venv.create(project / ".venv", symlinks=True)
    packages = next((project / ".venv").glob("lib/python*/site-packages"))
    (packages / "borrowed.pth").write_text("\n".join(path for path in sys.path if path.endswith("site-packages")))
    (project / ".venv/.ready").touch()
    return project


def run(folder, *command, **environment):
    kept = {key: value for key, value in os.environ.items() if not key.startswith("SNAKEMAKE")}
    environment = kept | {"PYTHONPATH": str(folder / "src")} | environment
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=LONGEST, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert not list(folder.parent.rglob("EXECUTED"))
    return done.stdout + done.stderr


def test_rules_quote_what_a_shell_sees(root):
    commands = [
        command
        for file in [root / "Snakefile", *(root / "workflow").rglob("*.smk")]
        for command in re.findall(r"^ +shell:\n((?: +(?:[rf]*\".*|#.*)\n)+)", file.read_text(), re.MULTILINE)
    ]
    assert commands
    for command in commands:
        assert all(field.endswith(":q}") for field in re.findall(r"\{.*?\}", command)), command


@pytest.mark.slow
def test_a_sweep_runs_to_its_end(folder):
    run(folder, "make", "all_blades")
    for name in ("results/summary.csv", "results/Ref/direct/response.nc", "results/explorer.html"):
        assert (folder / name).exists()


@pytest.mark.slow
def test_a_part_of_a_sweep_on_slurm(folder):
    """What Slurm would run, without Slurm."""
    slurm = {
        "SLURM_SUBMIT_DIR": str(folder),
        "SLURM_CPUS_PER_TASK": "1",
        "SLURM_ARRAY_TASK_ID": "1",
        "SLURM_ARRAY_TASK_COUNT": "1",
    }
    assert "simulate" in run(folder, "bash", "cluster/sweep.sbatch", "--dry-run", "--forceall", **slurm)
