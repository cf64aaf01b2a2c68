"""Table of equal blades on one grid of time, from made-up rms."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
from conftest import CHECKOUT
from defaults import IntegrationChoice
from evidence import rotor_grid
from evidence.pages import read_table
from integration_cases import random_model, with_static_modes

from r37core.rom.contact_model import write_contact_model
from r37core.time_integration.integrators import EXACT_MODAL


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


def test_equal_blades_are_one_blade_however_they_go(tmp_path, monkeypatch):
    """Three blades of a model with a few random modes, in a lining that one of them hardly wears."""
    model = with_static_modes(random_model(8), 1e-9)
    softer = np.where(model.squared_frequencies < 1e14, 1e-2 * model.squared_frequencies, model.squared_frequencies)
    write_contact_model(replace(model, squared_frequencies=softer), tmp_path / "contact.npz")
    monkeypatch.chdir(CHECKOUT)
    monkeypatch.setattr(rotor_grid, "BLADES", 3)
    monkeypatch.setattr(rotor_grid, "ANGLES", tuple(2.0 * np.pi * np.arange(3) / 3))
    choice = IntegrationChoice(1e-5, 4, 64, integrator=EXACT_MODAL)
    monkeypatch.setattr("r37core.config.Settings.integration_choice", lambda *arguments: choice)
    output = SimpleNamespace(table=tmp_path / "table.csv")
    rotor_grid.grid(SimpleNamespace(contact=tmp_path / "contact.npz"), output, None)
    head, *rows = read_table(output.table)
    assert head[1:] == ["shipped step: rms (mm)", "half the step: rms (mm)"]
    values = [[float(value) for cell in row[1:] for value in cell.split(" to ")] for row in rows]
    assert len(values) == 4 and min(map(min, values)) > 0.0
    assert max(map(max, values)) < 1.05 * min(map(min, values))
