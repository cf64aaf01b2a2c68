"""Tables of accuracy, from made-up runs."""

import csv
from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from evidence import accuracy
from evidence.configuration import settings_of
from evidence.contact_runs import (
    AS_SHIPPED,
    BARE,
    CENTRAL,
    CHANGES,
    EVERY_SPEED,
    FINEST,
    GRID,
    IN_PUBLISHED_RANGE,
    LINED,
    MATERIAL,
    PERTURBED,
    PUBLISHED_RANGE,
    SCENES,
    SMALL,
    SPREAD,
    STANDARD,
    Run,
    branch_speeds,
    models_of,
    ways_of,
)

from r37core.rom.reduction_choice import PATCHES, POINTS

ROOT = Path(__file__).parents[2]
BLADES = ("Ref", "L50", "L100", "S50", "S100", "CS50", "CS100")
UNSETTLED = dict(zip(PERTURBED, (800.0, 900.0, 1000.0), strict=True))
OFF = {5000: 0.08, SMALL: 0.04, STANDARD: 0.02, 40000: 0.01, FINEST: 0.0}
"""By how much rms on a mesh is larger; of S50 twice as much."""


SPEEDS = {EVERY_SPEED: GRID, IN_PUBLISHED_RANGE: PUBLISHED_RANGE}


def response(speed):
    """A branch that ends at 1302 rad/s."""
    return np.where(speed < 1302.0, 2e-3, 1e-3)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    rows = []
    for blade in BLADES:
        for nodes, off in OFF.items():
            for model in models_of(nodes):
                for scene in SCENES[model.contact]:
                    changes = CHANGES if nodes == STANDARD else [*ways_of(nodes, scene, model), IN_PUBLISHED_RANGE]
                    for what in changes:
                        speeds = SPEEDS.get(what, SPREAD)
                        rms = response(speeds) * (1.0 + off * (2.0 if blade == "S50" else 1.0))
                        rms = rms * np.where(speeds == UNSETTLED.get(what), 0.9, 1.0)
                        words = {"blade": blade, "nodes": nodes, "scene": scene, "what": what, **asdict(model)}
                        numbers = {"speed": speeds, "rms": rms, "normal": rms, "stress": 1e9, "cpu_s": 0.1}
                        rows.append(pd.DataFrame({**words, **numbers}))
    file = tmp_path_factory.mktemp("accuracy") / "runs.csv"
    pd.concat(rows).to_csv(file, index=False)
    return [str(file)]


@pytest.fixture
def made(files, tmp_path, monkeypatch):
    """What a step writes: name -> rows of its table, as dicts."""
    monkeypatch.chdir(ROOT)

    def run(step, *names):
        output = SimpleNamespace(**{name: str(tmp_path / f"{name}.csv") for name in names})
        step(SimpleNamespace(files=files), output, None)
        tables = {}
        for name in names:
            with open(tmp_path / f"{name}.csv", newline="", encoding="utf-8") as stream:
                tables[name] = list(csv.DictReader(stream))
        return tables

    return run


def test_a_perturbation_that_is_noticed_unsettles_a_speed(files, monkeypatch):
    """Each of the three changes the motion at a speed of its own; the speed next to the end of the branch does not count."""
    monkeypatch.chdir(ROOT)
    settled = accuracy.Runs(files).settled(BARE, POINTS).loc["Ref"]
    assert settled.index[~settled].tolist() == [800.0, 900.0, 1000.0, 1300.0]


def test_branches_are_looked_at_before_their_ends():
    assert {1295.0, 1300.0} <= set(branch_speeds(GRID, response(GRID)))


def test_levels_have_the_worst_blade(made):
    tables = made(accuracy.levels, "levels", "steep", "blades")
    errors = {row["level"]: row["lining, points"] for row in tables["levels"]}
    assert errors == {"`draft`": "16%", "`standard`": "4.0%", "`paper`": "", "`fine`": "2.0%"}
    assert tables["steep"][1]["bare casing, points"] == "S50 4.0%, 4.0%"
    steps = [row["step (us)"] for row in tables["levels"]]
    assert steps == ["6.4", "6.4, 4.8", "0.1", "3.2, 2.4"]
    assert [row["CPU (s)"] for row in tables["levels"]] == 4 * ["0.10"]


def test_convergence_names_the_worst_blade(made):
    tables = made(accuracy.convergence, "mesh", "motion", "stress")
    assert tables["mesh"][0]["bare casing, points"] == "9.1%; S50 16%"
    assert len(tables["mesh"]) <= 12
    assert len(tables["motion"]) <= 12
    modes = tables["motion"][0]
    assert (modes["bare casing, points"], modes["bare casing, patches"]) == ("", "0.0%; CS100 0.0%")


def test_what_chance_decides(made):
    tables = made(accuracy.chance, "table", "friction")
    # three of 51
    assert {row["lining, points"] for row in tables["table"]} == {"6%: 10%, 10%"}
    assert tables["friction"][0]["Ref: repeatable speeds"] == "100%"


def test_points_and_patches(made):
    tables = made(accuracy.patches, "blades", "published", "stiffness", "peaks")
    assert tables["blades"][0]["points: largest rms (mm)"] == "2.04 at 750"
    assert [row["jump after (rad/s)"] for row in tables["published"]] == ["1301"] * 5
    assert len(tables["peaks"]) == 2


def test_changes_change_what_they_name():
    settings = settings_of(ROOT)
    run = Run(settings.scenes[LINED].scene, settings.integration_choice("Ref", LINED, 1000.0))
    assert CHANGES[AS_SHIPPED](run) == run
    assert CHANGES[CENTRAL](run).choice.time_step == 1e-7
    assert CHANGES["friction + 0.1%"](run).scene.friction.coefficient == pytest.approx(1.001 * run.scene.friction.coefficient)
    assert CHANGES["twice as many bars"](run).scene.lining.bars == 2 * run.scene.lining.bars
    assert ways_of(40000, BARE, models_of(40000)[0]) == [AS_SHIPPED, "step 2.4e-06 s"]
    assert ways_of(40000, MATERIAL, models_of(40000)[1]) == [AS_SHIPPED, "step 3.2e-06 s"]
    assert {model.contact for model in models_of(SMALL)} == {POINTS, PATCHES}
