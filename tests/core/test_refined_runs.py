"""Adaptive speed sampling through Snakemake: all rounds in one command, each speed once, and what runs again."""

import json
import random
import re
import time

import numpy as np
import pytest
import xarray as xr
from shared_sweep import copy_structure
from stubbed_runs import BLADES, REFINED, SCENES, copy_stubbed, refine, runs, simulated
from workflow_runs import copy_finished, digests, kill_snakemake, lose_speed, overlay, planned_outputs, snakemake

from r37core.time_integration.status import RunStatus

pytestmark = pytest.mark.slow

COARSE, ADDED = ("750", "1150", "1550"), ("1149", "1150.5")
WINDOWS = "windows: [{ mode: 1B, highest_engine_order: 8, first: 0.02, last: 0.03, step_rad_s: 40 }], largest_share: 0.9"


@pytest.fixture(scope="module")
def first_run(root, tmp_path_factory):
    """A finished stubbed run, and what Snakemake said."""
    folder = tmp_path_factory.mktemp("refined")
    copy_stubbed(root, folder)
    refine(folder)
    return folder, snakemake(folder, "tables", "--cores", "2")


@pytest.fixture
def project(first_run, tmp_path):
    return copy_finished(first_run[0], tmp_path / "project")


def test_one_command_runs_all_rounds_and_each_speed_once(first_run):
    done = simulated(first_run[1])
    assert set(done) == runs(COARSE + ADDED)
    assert len(done) == len(set(done))
    assert (first_run[0] / "results/summary.csv").exists()
    assert planned_outputs(first_run[0], "tables") == {}


@pytest.mark.parametrize(
    ("name", "change", "expected"),
    [
        ("config", "blades: [Ref, CS100, L50]", runs(COARSE + ADDED, blades=["L50"])),
        ("scenes", "direct: { friction: { coefficient: 0.2 } }", runs(COARSE + ADDED, scenes=["direct"])),
    ],
)
def test_a_new_blade_or_friction_runs_all_its_rounds(project, name, change, expected):
    overlay(project, f"{name}.yaml", change)
    assert sorted(simulated(snakemake(project, "tables", "--cores", "2"))) == sorted(expected)


def test_another_criterion_asks_anew_and_simulates_nothing_that_is_there(project):
    overlay(project, "config.yaml", "refinement: { change: 0.5 }")
    text = snakemake(project, "tables", "--cores", "2")
    assert len(re.findall(r"checkpoint refine:", text)) == 3 * len(BLADES) * len(SCENES)
    assert simulated(text) == []
    assert planned_outputs(project, "tables") == {}


def test_a_lost_speed_of_a_later_round_runs_alone(project):
    lose_speed(project / "results/CS100/direct/speed_1149.npz")
    assert simulated(snakemake(project, "tables", "--cores", "2")) == ["CS100/direct/speed_1149.npz"]


def test_speeds_of_one_scene_may_refine_themselves_alone(root, tmp_path):
    copy_stubbed(root, tmp_path)
    overlay(tmp_path, "config.yaml", f"speeds_for: [{{ scenes: [direct], speeds: [{REFINED}] }}]")
    done = simulated(snakemake(tmp_path, "tables", "--cores", "2"))
    assert set(done) == runs(COARSE) | runs(ADDED, scenes=["direct"])
    assert not list(tmp_path.glob("results/*/abradable/round_*.json"))


@pytest.fixture(scope="module")
def real(small_sweep, tmp_path_factory):
    """A small real run: windows, halving."""
    folder = prepare_real(small_sweep, tmp_path_factory.mktemp("real") / "project")
    snakemake(folder, "tables", "--cores", "2")
    return folder


def prepare_real(small_sweep, folder):
    copy_structure(small_sweep, folder)
    refine(folder, "{ start: 1000, stop: 1240, step: 80, refine_to: 20 }")
    overlay(folder, "config.yaml", f"{{ blades: [CS100], refinement: {{ {WINDOWS}, direct: {{ {WINDOWS} }} }} }}")
    return folder


def test_real_rounds_stay_on_their_grid(real):
    for scene in SCENES:
        folder = real / "results/CS100" / scene
        files = sorted(folder.glob("round_*.json"), key=lambda file: int(file.stem.split("_")[1]))
        rounds = [json.loads(file.read_text())["new"] for file in files]
        asked = [speed for new in rounds for speed in new]
        assert len(rounds) > 2
        assert rounds[-1] == []
        assert len(set(asked)) == len(asked)
        assert all(speed % 20 == 0 for speed in asked)
        assert {f"speed_{speed:g}.npz" for speed in asked} == {file.name for file in folder.glob("speed_*.npz")}
    with xr.open_dataset(real / "results/rms.nc") as rms:
        run = rms["status"] != RunStatus.NOT_RUN
        assert not np.array_equal(run.sel(scene="abradable"), run.sel(scene="direct"))
        # what was not run has no numbers, what was run has them
        assert rms["rms_normal"].notnull().all("tip_point").equals(run)
    assert planned_outputs(real, "tables") == {}


def test_kills_at_random_moments_lose_nothing(real, small_sweep, tmp_path):
    """Killed in the middle of its rounds, again and again; in the end every file is that of an undisturbed run."""
    project = prepare_real(small_sweep, tmp_path / "project")
    overlay(project, "config.yaml", "scenes: [abradable]")
    command, moments = ("responses", "--cores", "2"), random.Random(7)
    for files in (2, 5):

        def there(files=files):
            if len(list(project.glob("results/*/*/speed_*.npz"))) < files:
                return False
            time.sleep(moments.random())
            return True

        kill_snakemake(project, *command, when=there)
    snakemake(project, *command)
    made = digests(project)
    assert "results/CS100/abradable/response.nc" in made
    assert made.items() <= digests(real).items()
