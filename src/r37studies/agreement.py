"""Agreement of measured and simulated values in measured.csv: judged, told and drawn by the same functions."""

from collections import Counter
from typing import Any

import numpy as np
import pandas as pd

from r37core.results.closing import counted

WITHIN = 2.0
"""Difference, in units of both uncertainties, within which a point agrees."""

LEAST_AGREEING = 0.75
"""Share of the points within WITHIN below which simulation and measurement disagree; 0.95 of them are by chance."""

SCATTERED = 0.3
"""Uncertainty over the value from which on a simulated point agrees with nearly anything."""

_MOST_NAMED = 3


def groups(table: pd.DataFrame) -> list[tuple[tuple[str, ...], pd.DataFrame]]:
    """Rows of each measurement: its blade, scene, quantity and file, in the order of the table."""
    keys = ["measurement", "blade", "scene", "quantity", "file"]
    return [(tuple(map(str, key[1:])), rows) for key, rows in table.groupby(keys, sort=False)]


def agreeing(rows: pd.DataFrame) -> pd.Series:
    """Points of which simulation and measurement agree: true or false."""
    return rows["difference_over_uncertainty"].abs() <= WITHIN


def disagrees(rows: pd.DataFrame) -> bool:
    """True where fewer points agree than chance explains."""
    return bool(agreeing(rows).mean() < LEAST_AGREEING)


def words(rows: pd.DataFrame) -> str:
    """How many points of a measurement agree, and where the others lie."""
    inside = agreeing(rows)
    text = f"{inside.sum()} of {counted(len(rows), 'point')} within {WITHIN:g} sigma"
    scattered = int((inside & (rows["simulated_uncertainty"] > SCATTERED * rows["simulated"])).sum())
    text += f", at {scattered} of them as the simulation scatters by chance" if scattered else ""
    far = rows[~inside]
    farthest = far.loc[far["difference_over_uncertainty"].abs().sort_values(ascending=False).index[:_MOST_NAMED]]
    ratios = [_ratio(row) for _, row in farthest.sort_values("speed_rad_s").iterrows()]
    remarks = rows["remark"].dropna().astype(str).tolist()[:1]
    return "; ".join(filter(None, [text, *ratios, *remarks]))


def _ratio(row: Any) -> str:
    where = f"{row['angle_deg']:.4g} degrees" if np.isfinite(row["angle_deg"]) else f"{row['speed_rad_s']:.5g} rad/s"
    if pd.notna(row["engine_order"]):
        where += f", engine order {row['engine_order']:.0f}"
    if not np.isfinite(row["simulated"]):
        return f"{where}: diverged" if row["unit"] != "rad s-1" else "never above it"
    if row["measured"] == 0.0:
        return f"{where}: simulated {row['simulated']:.3g} {row['unit']}, measured 0"
    return f"{where}: simulated {row['simulated'] / row['measured']:.3g} times measured"


def disagreements(table: pd.DataFrame) -> dict[tuple[str, str], str]:
    """Blade and scene -> a note on its measurements that disagree, of those that have some."""
    counts = Counter((blade, scene) for (blade, scene, *_), rows in groups(table) if disagrees(rows))
    return {pair: f"simulation disagrees with {counted(count, 'measurement')} (measured.csv)" for pair, count in counts.items()}
