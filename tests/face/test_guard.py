"""A run of the tests that is killed leaves no process behind."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from guard import left_by
from workflow_runs import LONGEST, wait_until

SNAKEFILE = """
rule all:
    shell: "touch begun; sleep 1000"
"""

SMALL = """
import os
import warm_snakemake

def test_long(request):
    warm_snakemake.run({folder!r}, ["--cores", "1", "--quiet"], {{**os.environ, "PYTHONPATH": ""}}, 1000)
"""


@pytest.mark.slow
@pytest.mark.parametrize(("how", "workers"), [(signal.SIGTERM, "1"), (signal.SIGKILL, "0")])
def test_a_killed_run_leaves_no_snakemake_and_no_job(tmp_path, how, workers):
    """And no folder of its own."""
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    (tmp_path / "test_small.py").write_text(SMALL.format(folder=str(tmp_path)))
    (tmp_path / "tmp").mkdir()
    options = ["-q", "-p", "conftest", "-n", workers, "--rootdir", str(tmp_path), "test_small.py"]
    command = [sys.executable, "-m", "pytest", *options]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[1]), "TMPDIR": str(tmp_path / "tmp")}
    run = subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=subprocess.DEVNULL)
    wait_until(lambda: (tmp_path / "begun").exists() or run.poll() is not None, LONGEST, "the job of a small run")
    (folder,) = (tmp_path / "tmp").glob("r37_tests_*")
    # a server, Snakemake and its job, at least
    assert len(left_by(folder)) >= 3
    run.send_signal(how)
    assert run.wait() == -how
    wait_until(lambda: not folder.exists(), LONGEST, "the end of all that a killed run has left")
    assert not left_by(folder)
