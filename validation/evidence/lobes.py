"""Length above yield about 1B/4 over the clearance: lobes that keep their height against lobes that grow with the clearance."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from r37core.base.dataset_file import read_dataset
from r37core.results.columns import MOST_REVOLUTIONS

from .configuration import settings_of
from .pages import write_table
from .which_blade import Models, exceedance_of_runs

MODE, ORDER = "1B", 4
SCENES = {"material_abradable": "lining", "direct": "bare casing"}
"""Scenes, and what they are in words."""

CLEARANCES = (0.2, 0.3, 0.356, 0.4, 0.5, 0.6)
"""(mm) The third is the benchmark's."""

HELD, SCALED = "0.712 mm", "2 clearances"

BELOW, ABOVE, STEP = 0.04, 0.15, 8.0
"""Speeds about the Campbell speed, as shares of it, and their step (rad/s)."""


def lengths_of_blade(input: Any, output: Any, params: Any) -> None:
    """Lengths of a blade on both kinds of lobes in both scenes. Input: contact, stress, campbell. Params: blade, contact."""
    settings, models = settings_of(Path.cwd(), scenes=list(SCENES)), Models.read(input.contact, input.stress)
    crossing = float(read_dataset(input.campbell)["crossing_speed"].sel(mode=MODE, engine_order=ORDER))
    speeds, rows = np.arange(round((1.0 - BELOW) * crossing), (1.0 + ABOVE) * crossing, STEP), []
    for name in SCENES:
        scene = settings.scenes[name].scene
        for clearance in CLEARANCES:
            for lobes, height in {HELD: 0.712, SCALED: 2.0 * clearance}.items():
                casing = replace(scene.casing, clearance=1e-3 * clearance, height=1e-3 * height)
                exceedance = exceedance_of_runs(settings, models, params.blade, replace(scene, casing=casing), speeds)
                beyond = any(part.truncated for part in exceedance.ranges(MOST_REVOLUTIONS))
                rows.append([params.contact, name, params.blade, lobes, clearance, exceedance.length(MOST_REVOLUTIONS), beyond])
    columns = ["contact", "scene", "blade", "lobes", "clearance_mm", "length_rad_s", "beyond"]
    pd.DataFrame(rows, columns=columns).to_csv(output[0], index=False)


def lengths(input: Any, output: Any, params: Any) -> None:
    """Table of all blades, with a > before a length that reaches beyond the speeds. Input: files of lengths_of_blade."""
    found = pd.concat([pd.read_csv(file) for file in input.files])
    rows = []
    for (scene, blade, contact, lobes), part in found.groupby(["scene", "blade", "contact", "lobes"], sort=False):
        cells = [f"{'> ' * row.beyond}{row.length_rad_s:.0f}" for row in part.itertuples()]
        rows.append([SCENES[scene], blade, contact, lobes, *cells])
    write_table(["scene", "blade", "contact", "lobes", *(f"{clearance:g} mm" for clearance in CLEARANCES)], rows, output.table)
