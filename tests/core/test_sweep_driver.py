"""The driver of runs: the workflow's numbers, on any number of processes; nothing that is there is run again."""

import json
import os
import pickle
import signal
import subprocess
import sys
import time
from functools import partial
from importlib import import_module
from pkgutil import walk_packages

import numpy as np
import pytest
import xarray as xr

import r37core
from r37core.adaptive.criterion import RefinementChoice
from r37core.base.dataset_file import read_dataset
from r37core.base.io import CarriedError
from r37core.base.plain import from_plain, to_plain
from r37core.base.speeds import SpeedPlan, plan_speeds
from r37core.rom.rotation import BucklingError
from r37core.stress.statistic import Strengths
from r37core.sweep import counts, driver, parts
from r37core.sweep.blade_sweep import BladeSweep, SharedSpeeds
from r37core.sweep.driver import Driver
from r37core.sweep.forks import forked_results
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.step_limit import UnstableStepError

CHOICE = RefinementChoice(windows=(), prominence=0.1, largest_share=0.6)
TASK = json.dumps({"height": 1.0})


@pytest.fixture
def sweep(tmp_path):
    (tmp_path / "contact.npz").write_bytes(b"a model")
    given = {"contact_model": str(tmp_path / "contact.npz")}
    return BladeSweep(given, {}, ("contact_model",), TASK, (), np.inf, Strengths())


@pytest.fixture
def run_speeds(monkeypatch, tmp_path):
    """Speeds that are simulated, in order, by a peak of the given height at 1040 rad/s in place of the time integration."""
    run = tmp_path / "run.txt"

    def peak(speed, output, task, about, *models, motion=None):
        with open(run, "a") as stream:
            stream.write(f"{speed}\n")
        rms = json.loads(task).get("height", 1.0) / (1.0 + (float(speed) / 10.0 - 104.0) ** 2)
        both = dict.fromkeys(("rms_normal", "rms_tangential"), np.full(2, rms))
        history = {"revolution_maximum": np.zeros((1, 2)), "revolution_von_mises": np.zeros((1, 1))}
        write_speed({"status": np.array(0), **both, **history}, output, json.loads(about))

    monkeypatch.setattr(parts, "run_job", peak)
    monkeypatch.setattr(driver, "write_response", lambda files, speeds, file, **_: response(speeds).to_netcdf(file) or file)
    return lambda: run.read_text().split() if run.exists() else []


def buckle(speed):
    raise BucklingError(speed)


def response(speeds):
    return xr.Dataset(coords={"speed": list(speeds)})


def run(folder, sweeps, entry, run_all=driver.one_by_one, choice=CHOICE):
    speeds = SharedSpeeds(plan_speeds(entry, 1.0), choice)
    shaped = folder / "campbell.nc"
    if not shaped.exists():
        xr.Dataset({"crossing_speed": (("mode", "engine_order"), np.empty((0, 0)))}).to_netcdf(shaped)
    made = Driver(folder / "runs", folder / "structures", {}, run_all)
    return made.run(sweeps, speeds, shaped, dict.fromkeys(sweeps, "{}"))


def test_what_is_there_is_not_run_again_and_what_is_damaged_or_of_another_task_is(tmp_path, sweep, run_speeds):
    speeds = [{"start": 1000, "stop": 1080, "step": 20}]
    run(tmp_path, {"one": sweep}, speeds)
    assert run_speeds() == ["1000", "1020", "1040", "1060", "1080"]
    run(tmp_path, {"one": sweep}, [*speeds, 1090])
    assert run_speeds()[5:] == ["1090"]
    (part,) = (tmp_path / "runs/one").glob("speed_1020-*.npz")
    part.write_bytes(part.read_bytes()[:-1])
    run(tmp_path, {"one": sweep}, speeds)
    assert run_speeds()[6:] == ["1020"]
    other = BladeSweep(**{**vars(sweep), "task": json.dumps({"height": 2.0})})
    run(tmp_path, {"one": other}, [1000])
    assert run_speeds()[7:] == ["1000"]
    # another model under the same name is another one
    (tmp_path / "contact.npz").write_bytes(b"another model")
    run(tmp_path, {"one": sweep}, [1000])
    assert run_speeds()[8:] == ["1000"]


def test_sweeps_share_their_speeds_and_a_broken_run_asks_for_the_same_ones(tmp_path, sweep, run_speeds):
    entry = [{"start": 1000, "stop": 1080, "step": 40, "refine_to": 5}]
    low = BladeSweep(**{**vars(sweep), "task": json.dumps({"height": 1e-3})})
    responses = run(tmp_path, {"a": sweep, "b": low}, entry)
    speeds, other = (read_dataset(response)["speed"].values.tolist() for response in responses.values())
    assert speeds == other == sorted(set(speeds)) and len(speeds) > 3
    done = run_speeds()
    assert len(done) == 2 * len(speeds)
    # a round lost one of its runs: this alone is done again
    next((tmp_path / "runs/b").glob("speed_1040-*.npz")).unlink()
    run(tmp_path, {"a": sweep, "b": low}, entry)
    assert run_speeds()[len(done) :] == ["1040"]


def test_a_sweep_is_plain_data(sweep):
    kept = BladeSweep(**{**vars(sweep), "history_speeds": (1040.0,)})
    assert from_plain(BladeSweep, to_plain(kept)) == kept
    plan = SharedSpeeds(SpeedPlan((1.0,)), CHOICE)
    assert from_plain(SharedSpeeds, to_plain(plan)) == plan


def test_forks_give_results_in_order_and_count_simulations(tmp_path, sweep, run_speeds, monkeypatch):
    monkeypatch.setenv(counts.COUNTS, str(tmp_path / "counts.txt"))
    assert counts.counted_simulations().total() == 0
    run(tmp_path, {"one": sweep}, [1000, 1020, 1040], partial(forked_results, 2))
    assert sorted(run_speeds()) == ["1000", "1020", "1040"] and counts.counted_simulations() == {0: 3}
    with pytest.raises(BucklingError, match="no stable position at 1500 rad/s"):
        forked_results(2, [lambda: 1 // 1, partial(buckle, 1500.0)])
    with pytest.raises(MemoryError, match="a process of this job was killed"):
        forked_results(2, [lambda: 1 // 1, lambda: os.kill(os.getpid(), signal.SIGKILL)])
    assert forked_results(2, [os.getpid, os.getpid, lambda: 3])[2] == 3


def test_errors_are_carried_from_process_to_process():
    """All that are not made of their message alone; with what they know beside it."""
    modules = [module.name for module in walk_packages(r37core.__path__, "r37core.") if ".compiled." not in module.name]
    kinds = [kind for name in modules for kind in vars(import_module(name)).values() if isinstance(kind, type)]
    made = {kind for kind in kinds if issubclass(kind, Exception) and "__init__" in vars(kind)}
    assert len(made) > 5 and all(issubclass(kind, CarriedError) for kind in made)
    error = pickle.loads(pickle.dumps(UnstableStepError("too long", 2e-6)))
    assert (str(error), error.limit, error.shortened) == ("too long", 2e-6, 1e-6)


@pytest.mark.skipif(sys.platform != "linux", reason="Linux")
def test_forks_end_with_the_process_that_forked_them(tmp_path):
    program = f"""
import os, time
from r37core.sweep.forks import forked_results

def call():
    open(f"{tmp_path}/{{os.getpid()}}", "w").close()
    time.sleep(60)

forked_results(2, [call, call])
"""
    process = subprocess.Popen([sys.executable, "-c", program])
    end = time.monotonic() + 60
    while len(found := list(tmp_path.iterdir())) < 2 and time.monotonic() < end:
        time.sleep(0.05)
    process.kill()
    process.wait()
    while any(os.path.exists(f"/proc/{file.name}") for file in found) and time.monotonic() < end:
        time.sleep(0.05)
    assert len(found) == 2 and not any(os.path.exists(f"/proc/{file.name}") for file in found)
