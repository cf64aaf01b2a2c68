"""Tables of accuracy and of the lining, from made-up runs."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from conftest import CHECKOUT
from evidence import accuracy, lining
from evidence.accuracy import BARE_SPEEDS, CASES, LEVELS, PERTURBED, REFERENCE, STRONG_PERTURBED
from evidence.tables import read_table

OFF = {**dict(zip(LEVELS, (0.04, 0.02, 0.01), strict=True)), PERTURBED: 0.025, STRONG_PERTURBED: 0.3}
"""Share by which the rms of a case is larger than the reference's; of the second blade twice as much."""


@pytest.fixture
def files(tmp_path):
    files = []
    for times, blade in enumerate(("Ref", "S100"), 1):
        rows = [
            {"blade": blade, "case": case, "scene": scene, "speed": speed, "motion": 1e-3 * (1.0 + times * OFF.get(case, 0.0))}
            for case in CASES
            for scene, speeds in (("lining", (1650.0, 1700.0)), ("bare", BARE_SPEEDS))
            for speed in speeds
        ]
        table = pd.DataFrame(rows).assign(stress=1e9, penetration=5e-5, step=6.4)
        # a branch that ends elsewhere
        table.loc[(table.case == "draft") & (table.speed == 1700.0), "motion"] = 4e-3
        files.append(tmp_path / f"{blade}.csv")
        table.to_csv(files[-1], index=False)
    return files


def test_errors_are_of_the_worst_blade(files, tmp_path):
    output = SimpleNamespace(**{name: tmp_path / f"{name}_.csv" for name in ("levels", "blades", "friction", "penetration")})
    accuracy.tables(SimpleNamespace(patches=files), output, None)
    head, *rows = read_table(output.levels)
    levels = {row[0]: dict(zip(head, row, strict=True)) for row in rows}
    assert levels["`standard`"]["lining: rms"] == "4.0% (S100)"
    assert levels["`draft`"]["bare casing: rms"] == "8.0% (S100)"
    assert levels["`draft`"]["largest error of rms, lining / bare"] == "300% / 8.0%"
    # of what it perturbs: 5% more than the reference against 4% more
    assert levels[f"{PERTURBED} (`standard`)"]["lining: rms"] == "1.0% (S100)"
    assert read_table(output.blades)[1][4:] == ["4.0%; 4.0%", "2.0%; 2.0%", "1.0%; 1.0%"]
    assert read_table(output.friction)[1][-1] == "30%; 30%"
    assert read_table(output.penetration)[1] == ["Ref", "50", "50", "50"]


def test_the_reference_is_the_finest_level_with_half_its_step():
    assert (CASES[REFERENCE].level, CASES[REFERENCE].step, CASES["fine"].step) == ("fine", 0.5, 1.0)


def test_changes_of_motion_and_wear_on_the_lining():
    base = [{"motion": 1e-3, "wear": np.full(4, 1e-3)} for _ in range(3)]
    varied = [{"motion": motion, "wear": np.full(4, 1.1e-3)} for motion in (1.01e-3, 0.98e-3, 2e-3)]
    assert lining.changes(varied, base) == "2.0%; 100%; 10%"


def test_bars_are_the_only_change_of_a_lining():
    from evidence.configuration import settings_of

    scene = settings_of(CHECKOUT).scenes["abradable"].scene
    assert lining.with_bars(scene, 2500).lining.bars == 2500
    assert lining.with_bars(scene, scene.lining.bars) == scene
