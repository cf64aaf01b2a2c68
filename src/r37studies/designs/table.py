"""designs.csv: what each design of a family is, how robust it is in every scene, and the line that a run ends with."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.varied_number import BLADE, SCENE, VariedNumber
from r37core.results.closing import counted
from r37core.results.columns import OPERATING, ROBUSTNESS, Column, names
from r37core.results.operating_range import OperatingRange
from r37core.results.ranking import RANKED_BY, measures_of
from r37core.results.table_file import read_table
from r37core.rom.naming import FIRST_BENDING, FIRST_TORSION

from .compared import BOTH, Compared

_NAMES = ("blade", "scene", "family")
"""Columns of names."""

STRUCTURE = (
    Column("mass_kg", "mass of the blade"),
    Column("frequency_1b_hz", "frequency of the first bending mode"),
    Column("frequency_1t_hz", "frequency of the first torsion mode"),
    Column("clearance_loss_1b_m", "largest loss of clearance as the tip swings along the free mode 1B"),
    Column("clearance_loss_1t_m", "largest loss of clearance as the tip swings along the free mode 1T"),
)
"""Columns of designs.csv that do not depend on the scene."""

MEASURES = (*STRUCTURE, Column("shift_1b_rad_s", "peak less crossing of the strongest interaction of 1B"), *ROBUSTNESS)
"""Columns of designs.csv next to those of names and of what varies; more of them, OPERATING, with an operating range."""


def design_table(
    pairs: Mapping[tuple[str, str], float],
    variables: Mapping[str, Mapping[str, Mapping[str, float]]],
    families: Mapping[str, Mapping[str, str]],
    masses: Mapping[str, float],
    datasets: Mapping[str, xr.Dataset],
    interactions: pd.DataFrame,
    operating: OperatingRange | None = None,
) -> pd.DataFrame:
    """One row for each of the `pairs` of blade and scene: blade, scene, family, variables of both, measures.

    `pairs`: with the relative error of the stress, by mesh and step; `variables`: kind -> design -> column -> value;
    `families`: kind -> design -> family; `masses` (kg) by blade; `datasets`: campbell, rms and, if there, stress;
    `interactions`: summary.csv; `operating`: range for measures of its own. What a scene does not compute, and what does not
    happen (no interaction of 1B), is NaN.
    """
    rows = []
    for (blade, scene), error in pairs.items():
        own = [families[kind][design] for kind, design in ((BLADE, blade), (SCENE, scene)) if design in families[kind]]
        varied = {"family": "__".join(own), **variables["blade"].get(blade, {}), **variables["scene"].get(scene, {})}
        structure, campbell = {"mass_kg": masses.get(blade, np.nan)}, datasets["campbell"].sel(blade=blade)
        for mode in (FIRST_BENDING, FIRST_TORSION):
            structure[f"frequency_{mode.lower()}_hz"] = float(campbell["frequency"].sel(mode=mode).isel(speed=0))
            structure[f"clearance_loss_{mode.lower()}_m"] = -float(campbell["dynamic_clearance"].sel(mode=mode).min())
        of_pair = (interactions["blade"] == blade) & (interactions["scene"] == scene)
        bending = interactions[of_pair & (interactions["mode"] == FIRST_BENDING)]
        # of the strongest interaction; NaN without one
        shift = bending["shift_rad_s"].get(bending["peak_rms_tangential_m"].idxmax()) if len(bending) else np.nan
        measures = measures_of(datasets, blade, scene, operating, error)
        rows.append({"blade": blade, "scene": scene, **varied, **structure, **measures, "shift_1b_rad_s": shift})
    designs = [values for kind in variables.values() for values in kind.values()]
    keys = list(dict.fromkeys(key for values in designs for key in values))
    return pd.DataFrame(rows, columns=[*_NAMES, *keys, *names(MEASURES), *(names(OPERATING) if operating else ())])


def compared_in(table: pd.DataFrame) -> dict[str, Compared]:
    """Designs compared of each family in a table, by its name; of a blade's and a scene's family together their map."""
    families = {}
    for name, rows in table.groupby("family", sort=False):
        varied = rows.drop(columns=[*_NAMES, *names(MEASURES), *names(OPERATING)], errors="ignore").dropna(axis=1, how="all")
        kinds = [VariedNumber.named(str(key)).kind for key in varied]
        kind = SCENE if set(kinds) == {SCENE} else BOTH if sorted(kinds) == [BLADE, SCENE] else BLADE
        blades, scenes = (tuple(dict.fromkeys(rows[column])) for column in ("blade", "scene"))
        families[str(name)] = Compared(kind, tuple(map(str, varied)), blades, scenes)
    return families


def length_column(table: pd.DataFrame) -> str:
    """Column of the length of the dangerous speeds: in operation, where it is known there."""
    inside = "length_dangerous_operating_rad_s"
    return inside if inside in table and table[inside].notna().any() else RANKED_BY[0]


def unknown_length(table: pd.DataFrame) -> pd.Series:
    """Length (rad/s) of the unknown speeds of designs, in operation where length_column is; 0 where it is not computed."""
    return table[length_column(table).replace("dangerous", "unknown")].fillna(0.0)


def closing(results: Path) -> str:
    """How many designs there are, and the best: of each scene, or of all where scenes vary; those that tie are named.

    Of designs that cannot be told apart by their length the one with the smallest share of the Goodman line stands beside.
    """
    table = read_table(results / "designs.csv")
    length = length_column(table)
    flown = length != RANKED_BY[0]
    scenes_vary = any(VariedNumber.named(str(name)).kind == SCENE for name in table)
    text = counted(len(table) if scenes_vary else table["blade"].nunique(), "design")
    ranked = table.dropna(subset=length)
    for scene, rows in [("", ranked)] if scenes_vary and len(ranked) else ranked.groupby("scene", sort=False):
        text += f"; {scene}: {_best(rows, length, flown)}" if scene else f"; {_best(rows, length, flown)}"
    return text


def _best(rows: pd.DataFrame, length: str, flown: bool) -> str:
    """Text on the design whose bracket ends first, or on those that tie with it; `flown`: whether that is in operation."""
    names = rows["blade"].str.cat(rows["scene"], " in ") if rows["scene"].nunique() > 1 else rows["blade"]
    low, unknown = rows[length], unknown_length(rows)
    least = (low + unknown).idxmin()
    # what is not known ties with all
    within = rows["length_dangerous_within_rad_s"].fillna(np.inf)
    tied = rows[low - (low + unknown)[least] <= np.hypot(within, within[least])]
    inside = " in operation" if flown else ""
    if len(tied) == 1:
        bracket = f"{low[least]:.0f}" + (f" to {low[least] + unknown[least]:.0f}" if unknown[least] > 0.0 else "")
        return f"{names[least]} is dangerous at the fewest speeds{inside} ({bracket} rad/s)"
    text = f"{len(tied)} of {len(rows)} cannot be told apart by their dangerous and unknown speeds{inside}"
    # what diverged has no largest value
    shares = tied["largest_goodman_share"][tied["diverged_runs"] == 0].dropna()
    if shares.empty:
        return text
    return f"{text}; of these {names[shares.idxmin()]} has the least share of the Goodman line ({shares.min():.3g})"
