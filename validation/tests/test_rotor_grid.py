"""Table of equal blades on one grid of time, from made-up rms."""

import numpy as np
from evidence import rotor_grid
from evidence.pages import read_table


def test_blades_that_differ_have_a_least_and_a_largest(tmp_path):
    found = {
        "shipped step": {"one blade": [2.75e-3], "36 blades": [2.75e-3, 2.76e-3]},
        "half": {"one blade": [2e-3], "36 blades": [2e-3] * 2},
    }
    rotor_grid.write_rows(found, tmp_path / "table.csv")
    assert read_table(tmp_path / "table.csv") == [
        ["blades", "shipped step: rms (mm)", "half: rms (mm)"],
        ["one blade", "2.7500", "2.0000"],
        ["36 blades", "2.7500 to 2.7600", "2.0000"],
    ]


def test_rms_is_of_the_second_half():
    samples = np.zeros((8, 6))
    samples[:4, 2], samples[4:, 2] = 9.0, [1.0, -1.0, 1.0, -1.0]
    assert rotor_grid.rms(samples) == 1.0
