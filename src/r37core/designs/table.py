"""designs.csv: what each design of a family is, how robust it is in every scene, and the line that a run ends with."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.varied_number import BLADE, SCENE, VariedNumber
from r37core.results.closing import counted
from r37core.results.datasets import response_of
from r37core.results.glossary import RANKING, Word, word
from r37core.results.operating_range import INTEGRAL, LENGTH, OperatingRange
from r37core.results.operating_range import MEASURES as OPERATING_MEASURES
from r37core.results.ranking import RANKED_BY, ROBUSTNESS, robustness
from r37core.results.table_file import read_table
from r37core.rom.naming import FIRST_BENDING, FIRST_TORSION

from .compared import BOTH, Compared

_NAMES = ("blade", "scene", "family")
"""Columns of names."""

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

IN_OPERATION = {name: meaning for name in OPERATING_MEASURES if (meaning := word(name, RANKING))}
"""More of them where there is an operating range."""


def design_table(
    pairs: Sequence[tuple[str, str]],
    variables: Mapping[str, Mapping[str, Mapping[str, float]]],
    families: Mapping[str, Mapping[str, str]],
    masses: Mapping[str, float],
    datasets: Mapping[str, xr.Dataset],
    interactions: pd.DataFrame,
    operating: OperatingRange | None = None,
) -> pd.DataFrame:
    """One row for each of the `pairs` of blade and scene: blade, scene, family, variables of both, measures.

    `variables`: kind -> design -> column -> value; `families`: kind -> design -> family; `masses` (kg) by blade; `datasets`:
    campbell, rms and, if there, stress; `interactions`: summary.csv; `operating`: range for measures of its own. What a scene
    does not compute, and what does not happen (no interaction of 1B), is NaN.
    """
    rows = []
    for blade, scene in pairs:
        names = [families[kind][design] for kind, design in ((BLADE, blade), (SCENE, scene)) if design in families[kind]]
        varied = {"family": "__".join(names), **variables["blade"].get(blade, {}), **variables["scene"].get(scene, {})}
        structure = {"mass_kg": masses.get(blade, np.nan)} | _structure(datasets["campbell"].sel(blade=blade))
        response = response_of(datasets, blade, scene)
        measures = robustness(response, operating=operating)
        rows.append({"blade": blade, "scene": scene, **varied, **structure, **measures, **_shift(blade, scene, interactions)})
    designs = [values for kind in variables.values() for values in kind.values()]
    keys = list(dict.fromkeys(key for values in designs for key in values))
    return pd.DataFrame(rows, columns=[*_NAMES, *keys, *MEASURES, *(IN_OPERATION if operating else ())])


def compared_in(table: pd.DataFrame) -> dict[str, Compared]:
    """What is compared of each family in a table, by its name; of a blade's and a scene's family together their map."""
    families = {}
    for name, rows in table.groupby("family", sort=False):
        varied = rows.drop(columns=[*_NAMES, *MEASURES, *IN_OPERATION], errors="ignore").dropna(axis=1, how="all")
        kinds = [VariedNumber.named(str(key)).kind for key in varied]
        kind = SCENE if set(kinds) == {SCENE} else BOTH if sorted(kinds) == [BLADE, SCENE] else BLADE
        blades, scenes = (tuple(dict.fromkeys(rows[column])) for column in ("blade", "scene"))
        families[str(name)] = Compared(kind, tuple(map(str, varied)), blades, scenes)
    return families


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
    """How many designs there are, and the best: of each scene, or of all where scenes vary."""
    table = read_table(results / "designs.csv")
    flown = LENGTH in table and table[LENGTH].notna().any()
    order = [LENGTH, INTEGRAL, "largest_median_stress_pa"] if flown else list(RANKED_BY)
    scenes_vary = any(VariedNumber.named(str(name)).kind == SCENE for name in table)
    text = counted(len(table) if scenes_vary else table["blade"].nunique(), "design")
    ranked = table.dropna(subset=order[0])
    for scene, rows in [("", ranked)] if scenes_vary and len(ranked) else ranked.groupby("scene", sort=False):
        best = rows.sort_values(order, kind="stable").iloc[0]
        where, name = (f"{scene}: ", best["blade"]) if scene else ("", f"{best['blade']} in {best['scene']}")
        inside = " in operation" if flown else ""
        text += f"; {where}{name} is above yield at the fewest speeds{inside} ({best[order[0]]:.0f} rad/s)"
    return text
