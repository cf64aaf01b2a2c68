"""The Coriolis force: what it changes for the seven blades, and what it costs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from r37core.rom.contact_model import ContactModel
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.time_integration.gyroscopic import LARGEST_TURN
from r37core.time_integration.simulate import Simulation

from .configuration import settings_of
from .pages import write_table

SCENES = ("abradable", "direct")
FREQUENCIES = 10


def models(files: list[str], tip_line: str) -> dict[str, list[tuple[ReducedModel, ContactModel]]]:
    """Blade -> its models without the Coriolis matrix and with it."""
    read = {Path(file).parent.name: read_reduced_model(file) for file in files}
    return {
        blade: [(rom, contact_model(rom, tip_line)) for rom in (replace(model, coriolis=None), model)]
        for blade, model in read.items()
    }


def frequencies(input: Any, output: Any, params: Any) -> None:
    """Shift of the first ten frequencies at the highest speed, and what uncoupled modes leave out of it. Input: files."""
    settings = settings_of(Path.cwd())
    rows, speed = [], settings.structure.maximum_speed_rad_s
    for blade, ((without, _), (model, contact)) in models(input.files, settings.structure.boundary.tip_line).items():
        exact = model.modes(speed, FREQUENCIES)[0]
        shift = exact / without.modes(speed, FREQUENCIES)[0] - 1.0
        cells = [blade, f"{100.0 * shift[0]:+.3f}%", f"{100.0 * shift[np.abs(shift).argmax()]:+.3f}%"]
        for scene in SCENES:
            choice = settings.integration_choice(blade, scene, speed)
            problem = Simulation(contact, speed, settings.scenes[scene].scene, choice).problem
            turns = problem.blade.frequencies * problem.grid.time_step
            left_out = np.abs(problem.blade.complex_modes.frequencies[:FREQUENCIES] / exact - 1.0).max()
            cells += [f"{np.count_nonzero(turns <= LARGEST_TURN)} of {len(contact.squared_frequencies)}", f"{left_out:.0e}"]
        rows.append(cells)
    head = [
        "blade",
        "1B",
        "largest of ten",
        "coupled modes, lining",
        "error up to",
        "coupled modes, bare casing",
        "error up to",
    ]
    write_table(head, rows, output.table)
