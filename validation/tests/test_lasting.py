"""Tables and picture of how long interactions last, from made-up runs."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from conftest import CHECKOUT
from evidence import lasting
from evidence.configuration import settings_of
from evidence.pages import read_table


def test_speeds_above_yield_and_states_by_length(tmp_path):
    rows = []
    for place, length in enumerate(lasting.RUNS):
        for speed in (1660.0, 1662.0, 1664.0):
            state = "lasting" if speed < 1664.0 else ("growing", "cut_free", "cut_free", "quiet")[place]
            done = length.revolutions if not length.until_settled else int(speed)
            above = speed >= 1662.0 and place < 3
            numbers = {"rms": 1e-3, "above": above, "worn_through": speed == 1660.0}
            rows.append({"speed": speed, "length": length.name, "revolutions": done, "motion_at_end": state, **numbers})
    file = tmp_path / "runs.csv"
    pd.DataFrame(rows).to_csv(file, index=False)
    output = SimpleNamespace(table=tmp_path / "table.csv", picture=tmp_path / "picture.png")
    lasting.lasting(SimpleNamespace(runs=file), output, None)
    head, first, second, _, last = read_table(output.table)
    assert head[2:] == ["lasting", "growing", "cut free", "worn through"]
    assert first == ["200", "1662 to 1664", "2", "1", "0", "1"]
    assert second == ["1,000", "1662 to 1664", "2", "0", "1", "1"]
    assert last == ["until settled: 1,660 to 1,664", "none", "2", "0", "0", "1"]
    assert output.picture.stat().st_size > 10_000


@pytest.mark.parametrize(("through", "words"), [(False, "7.0 (1002)"), (True, "7.0 (1002), not confirmed")])
def test_thickness_that_suffices_is_the_largest_used_one(tmp_path, through, words):
    rows = []
    for length in lasting.THICKNESS_RUNS:
        name = {"order": 4, "length": length.name}
        for speed, used in ((1000.0, 6e-3), (1002.0, 7e-3)):
            rows.append({**name, "speed": speed, "kind": "shipped", "used": 5e-3, "through": speed == 1002.0})
            rows.append({**name, "speed": speed, "kind": "thick", "used": used, "through": False})
        rows.append({**name, "speed": 1002.0, "kind": "less", "used": 7e-3, "through": True})
        rows.append({**name, "speed": 1002.0, "kind": "more", "used": 7e-3, "through": through})
    file = tmp_path / "runs.csv"
    pd.DataFrame(rows).to_csv(file, index=False)
    output = SimpleNamespace(table=tmp_path / "table.csv")
    lasting.sufficient_thickness(SimpleNamespace(runs=file), output, None)
    head, row = read_table(output.table)
    assert len(head) == 5 and row == ["1B/4", *2 * ("1/2", words)]


def test_a_thicker_lining_has_bars_of_the_same_stiffness():
    scene = settings_of(CHECKOUT).scenes["abradable"].scene
    thick = lasting.thicker(scene, 20.0 * scene.lining.thickness)
    assert thick.lining.elastic_modulus / thick.lining.thickness == pytest.approx(4e12)
    assert thick.lining.plastic_modulus / thick.lining.thickness == pytest.approx(1e12)


def made_up_run(settings, contact, scene, speed, length, stress=None):
    """A run that wears 6 mm, and is above yield below 1700 rad/s unless it ends as it has settled."""
    above = 9e9 if speed < 1700.0 and not length.until_settled else 0.0
    used = min(6e-3, scene.lining.thickness)
    return {
        "revolution_von_mises": np.full((1, length.revolutions), above),
        "statistic_end": length.revolutions,
        "motion_at_end": 2,
        "rms": np.array([[3e-3, 0.0, 4e-3]]),
        "used_thickness": used,
        "worn_through_share": float(used == scene.lining.thickness),
    }


@pytest.fixture
def made_up_runs(monkeypatch):
    monkeypatch.chdir(CHECKOUT)
    monkeypatch.setattr(lasting, "_run", made_up_run)
    monkeypatch.setattr(lasting.Models, "read", lambda *files: SimpleNamespace(contact=None, stress=None))
    monkeypatch.setattr(lasting, "read_contact_model", lambda file: None)
    return SimpleNamespace(contact=None, stress=None)


def test_runs_of_every_length(tmp_path, made_up_runs):
    lasting.runs(made_up_runs, [tmp_path / "runs.csv"], None)
    rows = pd.read_csv(tmp_path / "runs.csv")
    assert len(rows) == len(lasting.SPEEDS) * len(lasting.RUNS) and set(rows["motion_at_end"]) == {"lasting"}
    np.testing.assert_allclose(rows["rms"], 5e-3)
    assert rows[rows["above"]].groupby("length")["speed"].agg(["min", "max"]).values.tolist() == [[1660.0, 1698.0]] * 3
    assert rows["worn_through"].all()


def test_runs_of_three_thicknesses(tmp_path, made_up_runs):
    lasting.thickness_runs(made_up_runs, [tmp_path / "runs.csv"], None)
    rows = pd.read_csv(tmp_path / "runs.csv")
    assert sorted(set(rows["order"])) == [4, 5, 6, 7]
    through = rows.groupby("kind")["through"].agg(["min", "max"]).astype(int).to_dict("index")
    assert through["shipped"] == through["less"] == {"min": 1, "max": 1}
    assert through["thick"] == through["more"] == {"min": 0, "max": 0}
    np.testing.assert_allclose(rows[rows["kind"] == "less"]["thickness"], 0.99 * 6e-3)
