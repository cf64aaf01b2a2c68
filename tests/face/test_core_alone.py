"""The core without the other packages, their rules and tests: it plans, computes and passes its tests as with them."""

import os
import shutil
import subprocess
import sys

import pytest
from conftest import CHECKOUT, DELIVERED
from workflow_runs import copy_project, digests, plan, snakemake

LEFT_OUT = shutil.ignore_patterns("studies", "imports", "face", "r37", "r37studies", "r37imports", "__pycache__", "*.egg-info")


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """A copy of the checkout that has the core alone."""
    folder = tmp_path_factory.mktemp("alone")
    for name in (*DELIVERED, "src", "tests"):
        if (CHECKOUT / name).is_dir():
            shutil.copytree(CHECKOUT / name, folder / name, symlinks=True, ignore=LEFT_OUT)
        else:
            shutil.copy(CHECKOUT / name, folder / name)
    # what was compiled for one copy is good for all
    (folder / "src/r37core/__pycache__").symlink_to(CHECKOUT / "src/r37core/__pycache__")
    shutil.copytree(CHECKOUT / "tests/config", folder / "config")
    shutil.copytree(CHECKOUT / "config/schemas", folder / "config/schemas")
    return folder


def jobs_of(folder):
    return sorted((job.rule, job.outputs, job.inputs) for job in plan(folder))


@pytest.mark.slow
def test_all_blades_has_the_same_jobs(root, alone):
    ours = jobs_of(alone)
    assert len(ours) > 100
    assert ours == jobs_of(root)


def test_a_sweep_has_the_same_bits(small_sweep, alone, tmp_path):
    """Three speeds of two blades, all that all_blades makes of them but pictures and the explorer, which names the code."""
    copy_project(alone, tmp_path)
    snakemake(tmp_path, "tables", "--cores", "2")
    ours, every = (
        {file: digest for file, digest in digests(of).items() if not file.endswith("configuration.json")}
        for of in (tmp_path, small_sweep)
    )
    assert len([file for file in ours if "speed_" in file]) == 12
    assert ours.items() <= every.items()


@pytest.mark.slow
def test_its_tests_need_nothing_else(alone):
    """All are collected, and those of the configuration pass."""
    environment = {**os.environ, "PYTHONPATH": str(alone / "src")}
    for arguments in (["--collect-only", "tests"], ["-m", "not slow", "tests/core/test_config.py"]):
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments]
        done = subprocess.run(command, cwd=alone, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
