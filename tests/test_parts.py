"""A sweep in parts, on several machines at once: which blades each has, and what it may make."""

import os
import subprocess

import pytest
import yaml
from stubbed_runs import copy_stubbed
from workflow_runs import SNAKEMAKE, copy_odd_project, planned_outputs, run_in_odd_project, snakemake

from r37core.config import ConfigError
from r37core.config.document import command_line_document
from r37core.product.reading import read_settings
from r37core.product.remarks import check_part


def settings_of(root, part, **changes):
    return read_settings(root, command_line_document({"run": {"part": part}, **changes}))


@pytest.mark.parametrize("parts", [1, 2, 3, 7])
def test_every_blade_is_in_one_part(root, parts):
    several = [list(settings_of(root, f"{number}/{parts}").blades) for number in range(1, parts + 1)]
    assert [blade for blades in several for blade in blades] == list(read_settings(root).blades)
    assert max(map(len, several)) - min(map(len, several)) <= 1


@pytest.mark.parametrize("part", ["0/3", "4/3", "1/0", "-1/3", "a/b", "1/3 ", "1.0/2", "1/3/3"])
def test_what_is_no_part_is_refused(root, part):
    with pytest.raises(ConfigError, match=r"run\.part: found .*; allowed: a number of a part and how many .*, as in 2/7"):
        settings_of(root, part)


def test_a_part_makes_nothing_of_all_blades(root):
    """Nor are there more parts than blades; the profile of a node has all that the usual one has."""
    with pytest.raises(ConfigError, match=r"run\.part: found 1/3 of 2 blades; allowed: at most 2 parts"):
        settings_of(root, "1/3", blades=["Ref", "S50"])
    part = settings_of(root, "1/3")
    check_part(part, {"responses"})
    check_part(read_settings(root), set())
    for targets in (set(), {"all_blades"}, {"responses", "results/rms.nc"}):
        with pytest.raises(ConfigError, match=r"run\.part: found 1/3 with the target .*; allowed: the target responses, as in"):
            check_part(part, targets)
    usual, node = (yaml.safe_load((root / f"profiles/{name}/config.yaml").read_text()) for name in ("default", "node"))
    assert node == usual | {"cores": "all"}


@pytest.mark.slow
def test_parts_at_once_then_one_run_that_joins_them(root, tmp_path):
    copy_stubbed(root, tmp_path)
    commands = [[SNAKEMAKE, "responses", "--nolock", "--cores", "1", "--config", f"run={{part: {part}/2}}"] for part in (1, 2)]
    environment = os.environ | {"PYTHONPATH": str(tmp_path / "src")}
    running = [subprocess.Popen(command, cwd=tmp_path, env=environment) for command in commands]
    assert [process.wait() for process in running] == [0, 0]
    left = planned_outputs(tmp_path)
    assert not {"geometry", "simulate", "response", "campbell_of_blade"} & set(left)
    assert "sweep_dataset" in left
    said = snakemake(tmp_path, "--cores", "1", "--config", "run={part: 1/2}", check=False)
    assert "run.part: found 1/2 with the target all_blades; allowed: the target responses" in said
    assert not (tmp_path / "results/rms.nc").exists()


@pytest.mark.slow
def test_batches_of_the_named_rule(root, tmp_path):
    copy_stubbed(root, tmp_path)
    first, second = (planned_outputs(tmp_path, "responses", "--batch", f"responses={number}/3") for number in (1, 2))
    assert first["simulate"] and not first["simulate"] & second.get("simulate", set())


@pytest.mark.slow
def test_a_part_of_a_sweep_on_slurm(root, tmp_path):
    """What Slurm would run, without Slurm."""
    folder = copy_odd_project(root, tmp_path)
    slurm = {f"SLURM_{name}": "1" for name in ("CPUS_PER_TASK", "ARRAY_TASK_ID", "ARRAY_TASK_COUNT")}
    slurm["SLURM_SUBMIT_DIR"] = str(folder)
    assert "simulate" in run_in_odd_project(folder, "bash", "cluster/sweep.sbatch", "--dry-run", "--forceall", **slurm)
