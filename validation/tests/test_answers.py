"""The tables behind the answers."""

from types import SimpleNamespace

import pandas as pd
import pytest
from evidence import answers
from evidence.tables import read_table

from r37core.results import columns

BLADES = ("Ref", "S100")


def test_lengths_are_those_of_the_ranking(tmp_path):
    others = dict.fromkeys(columns.names((*columns.RANKING, *columns.ROBUSTNESS)), 0)
    rows = [
        others | {"blade": blade, "scene": scene} | dict(zip(answers.DRAWN_LENGTHS, (10.0 + place, 200.0, 30.0), strict=True))
        for place, scene in enumerate(answers.SCENES)
        for blade in BLADES
    ]
    pd.DataFrame(rows).to_csv(tmp_path / "ranking.csv", index=False)
    output = SimpleNamespace(table=tmp_path / "a.csv", picture=tmp_path / "a.png")
    answers.draw(SimpleNamespace(ranking=tmp_path / "ranking.csv"), output, None)
    head, *rows = read_table(output.table)
    assert head[1:4] == ["bare casing: dangerous", "bare casing: unknown", "bare casing: sustained"]
    assert rows == [[blade, "10", "200", "30", "11", "200", "30"] for blade in BLADES]
    assert output.picture.stat().st_size > 10_000


@pytest.mark.parametrize(
    ("scene", "change"),
    [
        ("twice_direct", ("twice as long", answers.BARE)),
        ("elastic_abradable", ("flexible casing", answers.LINING)),
        ("material_abradable", ("level draft", answers.LINING)),
        ("direct", ("level draft", answers.BARE)),
    ],
)
def test_a_scene_says_what_it_varies(scene, change):
    assert answers._change_of(f"results/runs/cases/Ref/{scene}/response.nc") == change
