"""The CPU time of test files stands in every log, and with CI=true one that takes too much fails the run."""

import subprocess
import sys
from pathlib import Path

import pytest
from cpu_of_files import too_long

BUSY = """
import time, pytest

@pytest.fixture(scope="session")
def shared():
    spend(0.3)

def spend(seconds):
    until = time.process_time() + seconds
    while time.process_time() < until:
        pass

def test_one(shared):
    spend(0.2)

def test_other():
    spend(0.2)
"""


def test_only_what_takes_more_is_named():
    spent = {"test_b.py": 61.0, "test_a.py": 3.0, "fixture sweep": 61.0, "programs": 99.0}
    (line,) = too_long(spent, 60.0)
    assert line.startswith("test_b.py: found 61.00 s of CPU; allowed: 60 s")


@pytest.mark.parametrize(("workers", "most", "status"), [([], 0.6, 0), (["-p", "xdist", "--numprocesses", "1"], 0.35, 1)])
def test_a_file_is_measured_without_what_it_shares(tmp_path, workers, most, status):
    (tmp_path / "test_busy.py").write_text(BUSY)
    (tmp_path / "pytest.ini").write_text(f"[pytest]\ncpu_of_a_file_s = {most}\n")
    command = [sys.executable, "-m", "pytest", "-p", "cpu_of_files", *workers]
    # other plugins take longer than all of this
    environment = {"PYTHONPATH": str(Path(__file__).parent), "PATH": "", "CI": "true", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == status, done.stdout + done.stderr
    assert "fixture shared" in done.stdout
    assert ("test_busy.py: found 0.4" in done.stdout) == bool(status)
