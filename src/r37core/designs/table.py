"""designs.csv: what each design of a family is, how robust it is in every scene, and the line that a run ends with."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.datasets import response_of
from r37core.results.glossary import RANKING, Word, word
from r37core.results.ranking import RANKED_BY, ROBUSTNESS, robustness
from r37core.results.table_file import read_table
from r37core.rom.naming import FIRST_BENDING, FIRST_TORSION

STRUCTURE = {
    "mass_kg": Word("mass", "of the blade", "kg"),
    "frequency_1b_hz": Word("1B at rest", "frequency of the first bending mode", "Hz"),
    "frequency_1t_hz": Word("1T at rest", "frequency of the first torsion mode", "Hz"),
    "clearance_loss_1b_m": Word("loss of clearance, 1B", "largest as the tip swings along the free mode", "mm", 1e3),
    "clearance_loss_1t_m": Word("loss of clearance, 1T", "largest as the tip swings along the free mode", "mm", 1e3),
}
MEASURES = {
    **STRUCTURE,
    "shift_1b_rad_s": Word("shift of 1B", "peak less crossing of the strongest interaction of 1B", "rad/s"),
    **{name: meaning for name in ROBUSTNESS if (meaning := word(name, RANKING))},
}
"""Columns of designs.csv in words; those of STRUCTURE do not depend on the scene."""


def design_table(
    designs: Mapping[str, Mapping[str, float]],
    masses: Mapping[str, float],
    datasets: Mapping[str, xr.Dataset],
    interactions: pd.DataFrame,
    scenes: Sequence[str],
) -> pd.DataFrame:
    """One row for each design and scene: blade, scene, design variables, MEASURES.

    `designs`: blade -> key -> value; `masses` (kg) by blade; `datasets`: campbell, rms and, if there, stress; `interactions`:
    summary.csv. What a scene does not compute, and what does not happen (no interaction of 1B), is NaN.
    """
    rows = []
    for blade, variables in designs.items():
        blade_values: dict[str, float] = {"mass_kg": masses[blade]} | _structure(datasets["campbell"].sel(blade=blade))
        for scene in scenes:
            scene_values = robustness(response_of(datasets, blade, scene)) | _shift(blade, scene, interactions)
            rows.append({"blade": blade, "scene": scene, **variables, **blade_values, **scene_values})
    keys = list(dict.fromkeys(key for variables in designs.values() for key in variables))
    return pd.DataFrame(rows, columns=["blade", "scene", *keys, *MEASURES])


def _structure(campbell: xr.Dataset) -> dict[str, float]:
    values = {}
    for mode in (FIRST_BENDING, FIRST_TORSION):
        values[f"frequency_{mode.lower()}_hz"] = float(campbell["frequency"].sel(mode=mode).isel(speed=0))
        values[f"clearance_loss_{mode.lower()}_m"] = -float(campbell["dynamic_clearance"].sel(mode=mode).min())
    return values


def _shift(blade: str, scene: str, interactions: pd.DataFrame) -> dict[str, float]:
    """How far the strongest interaction of 1B lies from its crossing (rad/s); NaN without one."""
    scene_values = interactions[(interactions["blade"] == blade) & (interactions["scene"] == scene)]
    bending = scene_values[scene_values["mode"] == FIRST_BENDING]
    strongest = bending["peak_rms_tangential_m"].idxmax() if len(bending) else None
    return {"shift_1b_rad_s": np.nan if strongest is None else float(bending.loc[strongest, "shift_rad_s"])}


def closing(results: Path) -> str:
    """How many designs there are, and the one that is above yield at the fewest speeds of each scene."""
    table = read_table(results / "designs.csv")
    text = counted(table["blade"].nunique(), "design")
    for scene, rows in table.dropna(subset=RANKED_BY[0]).groupby("scene", sort=False):
        best = rows.sort_values(list(RANKED_BY)).iloc[0]
        text += f"; {scene}: {best['blade']} is above yield at the fewest speeds ({best[RANKED_BY[0]]:.0f} rad/s)"
    return text
