"""Tables and picture of the edge's penetration, from made-up runs."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from conftest import CHECKOUT
from evidence import penetration
from evidence.contact_runs import AS_SHIPPED, BARE, STANDARD, BladeRuns
from evidence.pages import read_table


def row(kind, blade, speed, what=AS_SHIPPED, nodes=STANDARD, **numbers):
    model = penetration.KINDS[kind]
    words = {"contact": model.contact, "count": model.count, "spacing": model.spacing}
    return {"blade": blade, "nodes": nodes, "scene": BARE, "what": what, "speed": speed, **words, **numbers}


def written(rows, file):
    # a model has a row, too, without a scene
    pd.DataFrame([*rows, {"contact": "points", "count": 8}]).to_csv(file, index=False)
    return file


def test_penetration_at_the_worst_speed_of_eight_even_patches(tmp_path, monkeypatch):
    monkeypatch.chdir(CHECKOUT)
    files = []
    for blade in penetration.DRAWN:
        rows = []
        for place, kind in enumerate(penetration.KINDS):
            for speed, depth in ((1000.0, 3e-4), (1020.0, 1e-4)):
                # the last kind has its largest elsewhere
                own = depth / (place + 1) if place < 4 else 1e-4 - depth / 10.0
                rows.append(row(kind, blade, speed, penetration=own, normal=1e-4 * (place + 1)))
        files.append(written(rows, tmp_path / f"{blade}.csv"))
    output = SimpleNamespace(**{name: tmp_path / f"{name}.csv" for name in ("table", "rms")}, picture=tmp_path / "picture.png")
    penetration.penetration(SimpleNamespace(files=files), output, None)
    head, *rows = read_table(output.table)
    assert head == ["blade", "worst speed of 8 even (rad/s)", *penetration.KINDS]
    assert rows[1] == ["S100", "1000", "300; 300", "150; 150", "100; 100", "75; 75", "70; 90"]
    assert read_table(output.rms)[1] == ["Ref", "1000", "0.100", "0.200", "0.300", "0.400", "0.500"]
    assert output.picture.stat().st_size > 10_000


def mesh_rows(blade, kind, perturbed):
    """Runs of three speeds: the mesh changes the normal rms by 1, 2 and 9%, half the step by `perturbed`, friction by 1%."""
    for speed, error, change in zip((1000.0, 1040.0, 1080.0), (0.01, 0.02, 0.09), perturbed, strict=True):
        for nodes, factor in ((STANDARD, 1.0 + error), (penetration.FINE, 1.0)):
            for what in (AS_SHIPPED, *penetration.PERTURBED):
                normal = factor * (1.0 + (change if what == "half the step" else 0.01 * (what != AS_SHIPPED)))
                yield row(kind, blade, speed, what, nodes, normal=normal, tangential=2.0)


def test_limit_in_the_mesh_is_of_settled_speeds(tmp_path):
    files = []
    for blade, perturbed in {"S100": (0.0, 0.01, 0.5), "S50": (0.5, 0.5, 0.5)}.items():
        rows = [one for kind in penetration.MESH_KINDS for one in mesh_rows(blade, kind, perturbed)]
        files.append(written(rows, tmp_path / f"{blade}.csv"))
    output = SimpleNamespace(table=tmp_path / "table.csv")
    penetration.mesh_limit(SimpleNamespace(files=files), output, None)
    rows = read_table(output.table)[1:]
    assert ["S100", "12 cosine", "2 of 3", "1.5%; 2.0%", "0.0%; 0.0%", "2.0%, 0.0%", "1.0%, 0.0%"] in rows
    # none is settled: all speeds
    assert ["S50", "8 even", "0 of 3", "2.0%; 9.0%", "0.0%; 0.0%", "2.0%, 0.0%", "1.0%, 0.0%"] in rows


@pytest.fixture
def made_up_runs(monkeypatch):
    """Runs without a mesh, each a millisecond faster than the one before."""
    times = iter(np.arange(1000.0, 0.0, -1.0))

    class MadeUp(BladeRuns):
        def __init__(self, settings, blade, nodes):
            self._blade, self._nodes, self.rows = blade, nodes, []

        def model(self, model):
            return None, None

        def run(self, model, contact, scene, speeds, what, stress=None, change=None):
            for speed in speeds:
                self.rows.append(self._row(model, scene=scene, what=what, speed=speed, cpu_s=1e-3 * next(times)))

    monkeypatch.chdir(CHECKOUT)
    monkeypatch.setattr(penetration, "BladeRuns", MadeUp)


def test_every_kind_runs_at_every_speed(tmp_path, made_up_runs):
    penetration.runs_of_blade(None, [tmp_path / "runs.csv"], SimpleNamespace(blade="Ref"))
    rows = penetration.read_runs([tmp_path / "runs.csv"])
    assert dict(rows["kind"].value_counts()) == dict.fromkeys(penetration.KINDS, len(penetration.SPEEDS))


def test_two_meshes_have_the_same_runs(tmp_path, made_up_runs):
    penetration.mesh_runs_of_blade(None, [tmp_path / "runs.csv"], SimpleNamespace(blade="S50"))
    rows = penetration.read_runs([tmp_path / "runs.csv"])
    assert set(rows.groupby(["nodes", "kind", "what"]).size()) == {len(penetration.MESH_SPEEDS)}
    assert len(rows) == 2 * 2 * 3 * len(penetration.MESH_SPEEDS)


def test_cost_is_the_least_of_the_turns(tmp_path, made_up_runs):
    output = SimpleNamespace(table=tmp_path / "table.csv")
    penetration.cost(None, output, None)
    head, first, _ = read_table(output.table)
    last = 1000 - 4 * penetration.TURNS + 4
    assert head[1] == "8 even: CPU (ms)" and len(head) == 5
    assert first == ["Ref, 1330 rad/s", *(f"{last - n} ({(last - n) / last:.2f})" for n in range(4))]


@pytest.mark.parametrize("kind", penetration.KINDS)
def test_kinds_are_spaced_as_they_are_named(kind):
    model = penetration.KINDS[kind]
    assert kind.startswith(f"{model.count} ") and (model.spacing in kind or model.contact in kind)
