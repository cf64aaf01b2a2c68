"""The tables behind the answers: the worst motion counts, and every change is compared on the same speeds."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from conftest import CHECKOUT
from evidence import answers
from evidence.tables import read_table

from r37core.results import columns

BLADES = ("Ref", "S100")


@pytest.fixture
def rankings(tmp_path):
    """A ranking of two blades, and that of linear theory."""
    files = {}
    for name, lengths in {"ranking": (90.0, 800.0), "linear": (120.0, 900.0)}.items():
        others = dict.fromkeys(columns.names((*columns.RANKING, *columns.ROBUSTNESS)), 0)
        rows = [
            others
            | {"blade": blade, "scene": scene, answers.LENGTH: length}
            | {answers.WORST: length + (30.0 if scene == answers.BARE else 0.0)}
            for scene in answers.SCENES
            for blade, length in zip(BLADES, lengths, strict=True)
        ]
        files[name] = tmp_path / f"{name}.csv"
        pd.DataFrame(rows).to_csv(files[name], index=False)
    return SimpleNamespace(**files)


def test_lengths_are_those_of_the_ranking(rankings, tmp_path):
    output = SimpleNamespace(table=tmp_path / "a.csv", picture=tmp_path / "a.png")
    answers.draw(rankings, output, None)
    head, *rows = read_table(output.table)
    assert head[1:4] == ["bare casing: from rest", "bare casing: worst motion", "bare casing: linear"]
    assert rows == [["Ref", "90", "120", "120", "90", "90", "120"], ["S100", "800", "830", "900", "800", "800", "900"]]
    assert output.picture.stat().st_size > 10_000


def test_which_blade_and_interactions_have_one_length():
    files = (CHECKOUT / f"validation/tables/{name}.csv" for name in ("answer", "interactions_bare", "interactions_lining"))
    (names, *answer), *others = map(read_table, files)
    for scene, (head, *rows) in zip(answers.SCENES.values(), others, strict=True):
        worst = {row[0]: row[names.index(f"{scene}: worst motion")] for row in answer}
        assert worst == {row[0]: row[head.index("all ranges (rad/s)")] for row in rows}


def test_a_length_is_that_of_the_speeds_asked_for():
    speeds = np.arange(1000.0, 1101.0, 5.0)
    shares = np.zeros((3, len(speeds)))
    # above yield at five neighbours when carried up, at one speed alone from rest
    shares[0, 4:9], shares[2, 15] = 1.0, 1.0
    content = {"share_of_revolutions_above_yield": shares, "differ": np.ones_like(shares), "status": np.zeros_like(shares)}
    motions = xr.Dataset(
        {name: (("motion", "speed"), values) for name, values in content.items()} | {"lined": 1.0},
        {"motion": ["up", "down", "rest"], "speed": speeds},
    )
    motions["differ"] = motions["differ"].isel(motion=0, drop=True)
    motions = motions.expand_dims(blade=["Ref"], scene=["lining"])
    lengths = [answers._worst_lengths(motions.sel(speed=part), "lining")["Ref"] for part in (speeds, speeds[::2])]
    assert lengths[0] == pytest.approx(25.0, abs=6.0) and lengths[1] == pytest.approx(25.0, abs=11.0)
