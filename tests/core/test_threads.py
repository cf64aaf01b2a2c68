"""Calls of r37 from several threads give the bits of one, and leave the process as it was."""

import copy
import os
import pickle
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

import pytest
import xarray as xr
from workflow_runs import LONGEST

from r37core.base.dataset_file import NETCDF_LOCK, lazy_dataset, write_dataset
from r37core.base.process_wide import ProcessWide
from r37core.machine_code.kept import kept_file

IMPORTS = """
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import xarray as xr

import r37

config, folder = sys.argv[1], Path(sys.argv[2])
"""
SIMULATIONS = """
speeds = [1000.0 + 20.0 * number for number in range(4)]


def four(number):
    responses = [r37.simulate("Ref", "abradable", speed, config=config) for speed in speeds]
    with r37.NETCDF_LOCK:
        xr.concat(responses, "speed").to_netcdf(folder / f"{number}.nc")
    print("thread", number)
    return responses


# the first ones make the structure
with ThreadPoolExecutor(8) as threads:
    of_threads = list(threads.map(four, range(8)))
alone = four(8)
for responses in of_threads:
    for response, same in zip(responses, alone, strict=True):
        xr.testing.assert_identical(response, same)
"""

CALLS = """
adaptive = {"start": 1100, "stop": 1200, "step": 50, "refine_to": 25}
calls = {
    "campbell": lambda: r37.campbell("Ref", config=config),
    "sweep": lambda: r37.sweep("Ref", "abradable", adaptive, config=config, cores=2),
}
for name, call in calls.items():
    with ThreadPoolExecutor(2) as threads:
        both = [threads.submit(call) for _ in range(2)]
    alone = call()
    for given in both:
        xr.testing.assert_identical(given.result(), alone)
"""


def run(code, config, folder, **environment):
    """Run code in a process of its own, which a crash ends; give what it prints."""
    command = [sys.executable, "-c", IMPORTS + code, config, folder]
    environment = os.environ | environment
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=LONGEST)
    assert ended.returncode == 0, ended.stderr[-2000:]
    return ended.stdout


@pytest.mark.slow
def test_eight_threads_of_four_runs_give_the_bits_of_one(config, tmp_path):
    printed = run(SIMULATIONS, config, tmp_path, R37_CACHE=str(tmp_path / "cache"))
    # nothing that a caller prints is lost
    assert sorted(printed.split("\n")) == ["", *(f"thread {number}" for number in range(9))]


@pytest.mark.slow
def test_every_call_may_run_in_two_threads(config, tmp_path):
    run(CALLS, config, tmp_path)


def test_a_setting_of_the_process_lasts_as_long_as_any_thread_wants_it():
    happened, inner, outer = [], threading.Event(), threading.Event()

    @contextmanager
    def setting():
        happened.append("made")
        yield
        happened.append("taken back")

    shared = ProcessWide(setting)

    def first():
        with shared():
            inner.set()
            outer.wait()

    thread = threading.Thread(target=first)
    thread.start()
    inner.wait()
    with shared():
        outer.set()
        thread.join()
        assert happened == ["made"]
    assert happened == ["made", "taken back"]
    with pytest.raises(ValueError), shared():
        raise ValueError
    assert happened == ["made", "taken back"] * 2


def test_one_of_several_threads_makes_what_is_kept(tmp_path):
    made, together = [], threading.Barrier(4)

    def make(file):
        made.append(file)
        # what it is made of is kept, too: that lock's end is not this one's
        kept_file("part.txt", [], lambda part: part.write_text("part"), tmp_path)
        time.sleep(0.2)
        file.write_text("content")

    def kept(_):
        together.wait()
        return kept_file("whole.txt", [], make, tmp_path)

    with ThreadPoolExecutor(4) as threads:
        (file,) = set(threads.map(kept, range(4)))
    assert len(made) == 1 and file.read_text() == "content"
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]


def test_values_are_read_later_under_the_lock(tmp_path):
    write_dataset(xr.Dataset({"value": ("x", [1.0, 2.0])}), tmp_path / "a.nc")
    dataset, read = lazy_dataset(tmp_path / "a.nc"), []
    thread = threading.Thread(target=lambda: read.append(dataset["value"].values))
    with NETCDF_LOCK:
        thread.start()
        thread.join(0.2)
        assert not read
    thread.join()
    assert list(read[0]) == [1.0, 2.0]
    assert pickle.loads(pickle.dumps(NETCDF_LOCK)) is NETCDF_LOCK is copy.deepcopy(NETCDF_LOCK)
