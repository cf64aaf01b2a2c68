"""designs.csv: what each design of a family is, and how robust it is against contact, in every scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
import xarray as xr

from r37core.rom.naming import FIRST_BENDING, FIRST_TORSION

from .measures import largest_stress, speeds_above_yield

MEASURES = {
    "mass_kg": "mass (kg)",
    "frequency_1b_hz": "1B at rest (Hz)",
    "frequency_1t_hz": "1T at rest (Hz)",
    "clearance_loss_1b_m": "largest loss of clearance, 1B (m)",
    "clearance_loss_1t_m": "largest loss of clearance, 1T (m)",
    "length_above_yield_rad_s": "speeds above yield (rad/s)",
    "largest_stress_pa": "largest stress (Pa)",
    "first_yield_rad_s": "first speed above yield (rad/s)",
    "shift_1b_rad_s": "shift of the strongest 1B (rad/s)",
}
"""Column of designs.csv -> label of an axis; the first five do not depend on the scene."""


def design_table(
    designs: Mapping[str, Mapping[str, float]],
    masses: Mapping[str, float],
    campbell: xr.Dataset,
    stress: xr.Dataset | None,
    interactions: pd.DataFrame,
    scenes: Sequence[str],
) -> pd.DataFrame:
    """One row for each design and scene: blade, scene, design variables, MEASURES.

    `designs`: blade -> key -> value; `masses` (kg) by blade; `interactions`: summary.csv. What a scene does not compute, and
    what does not happen (no speed above yield, no interaction of 1B), is NaN.
    """
    rows = []
    for blade, variables in designs.items():
        of_blade: dict[str, float] = {"mass_kg": masses[blade]} | _structure(campbell.sel(blade=blade))
        for scene in scenes:
            of_scene = _robustness(blade, scene, stress, interactions)
            rows.append({"blade": blade, "scene": scene, **variables, **of_blade, **of_scene})
    keys = list(dict.fromkeys(key for variables in designs.values() for key in variables))
    return pd.DataFrame(rows, columns=["blade", "scene", *keys, *MEASURES])


def _structure(campbell: xr.Dataset) -> dict[str, float]:
    found = {}
    for mode in (FIRST_BENDING, FIRST_TORSION):
        found[f"frequency_{mode.lower()}_hz"] = float(campbell["frequency"].sel(mode=mode).isel(speed=0))
        found[f"clearance_loss_{mode.lower()}_m"] = -float(campbell["dynamic_clearance"].sel(mode=mode).min())
    return found


def _robustness(blade: str, scene: str, stress: xr.Dataset | None, interactions: pd.DataFrame) -> dict[str, float]:
    found = dict.fromkeys(("length_above_yield_rad_s", "largest_stress_pa", "first_yield_rad_s", "shift_1b_rad_s"), np.nan)
    if stress is not None and scene in stress["scene"].values:
        chosen = stress.sel(blade=blade, scene=scene)
        above = speeds_above_yield(chosen)
        found |= {"length_above_yield_rad_s": above.length, "first_yield_rad_s": above.first}
        found["largest_stress_pa"], _ = largest_stress(chosen)
    bending = interactions[
        (interactions["blade"] == blade) & (interactions["scene"] == scene) & (interactions["mode"] == FIRST_BENDING)
    ]
    if len(bending):
        found["shift_1b_rad_s"] = float(bending.loc[bending["peak_rms_tangential_m"].idxmax(), "shift_rad_s"])
    return found
