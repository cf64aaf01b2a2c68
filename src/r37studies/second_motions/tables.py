"""second_motions.csv."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.columns import Column, names
from r37core.results.other_motions import swept
from r37core.results.table_file import read_table

from .choice import MOTIONS, REST
from .levels import MotionLevels

_MOTIONS = {
    "rms_normal_{}_m": ("rms_normal", "rms normal to the casing"),
    "peak_normal_{}_m": ("peak_normal", "largest displacement towards the casing"),
    "median_von_mises_{}_pa": ("max_von_mises_median", "median stress of the later revolutions"),
    "share_above_yield_{}": ("share_of_revolutions_above_yield", "share of the later revolutions above yield"),
}
"""Column of each motion -> its variable of second_motions.nc, and its meaning."""

RANGES = (
    Column("blade", "name of the blade"),
    Column("scene", "name of the scene"),
    Column("from_rad_s", "lowest speed of the range"),
    Column("to_rad_s", "highest speed of the range"),
    Column("speeds", "number of computed speeds in the range"),
    Column("speed_rad_s", "speed at which the motions differ most, by the ratio of their rms"),
    Column("largest_motion", "largest motion at `speed_rad_s`: `up`, `down` or `rest`"),
    *(
        Column(column.format(motion), f"{meaning} at `speed_rad_s`, motion `{motion}`")
        for column, (_, meaning) in _MOTIONS.items()
        for motion in MOTIONS
    ),
)
"""Columns of second_motions.csv."""

RANGE_COLUMNS = names(RANGES)
"""Names of the columns of second_motions.csv."""


def range_table(motions: xr.Dataset) -> pd.DataFrame:
    """A row for each range of hysteresis, at the speed where the motions differ most; see RANGE_COLUMNS."""
    rows = []
    for blade in motions["blade"].values.tolist():
        for scene in motions["scene"].values.tolist():
            pair = swept(motions.sel(blade=blade, scene=scene))
            levels = MotionLevels.read(pair)
            rows += [{"blade": blade, "scene": scene} | _range_row(pair, levels, part) for part in levels.ranges()]
    return pd.DataFrame(rows, columns=list(RANGE_COLUMNS))


def _range_row(pair: xr.Dataset, levels: MotionLevels, part: slice) -> dict[str, Any]:
    place, speeds = levels.worst(part), levels.speeds[part]
    worst = pair.isel(speed=place)
    row: dict[str, Any] = {
        "from_rad_s": float(speeds[0]),
        "to_rad_s": float(speeds[-1]),
        "speeds": len(speeds),
        "speed_rad_s": float(levels.speeds[place]),
        "largest_motion": MOTIONS[int(levels.high[place])],
    }
    for column, (name, _) in _MOTIONS.items():
        if name in worst:
            row |= {column.format(motion): float(worst[name].sel(motion=motion)) for motion in MOTIONS}
    return row


def closing(results: Path) -> str:
    """How many ranges there are, and where the largest motion is most above that from rest."""
    table = read_table(results / "second_motions.csv")
    text = counted(len(table), "range") + " of hysteresis"
    second = table[table["largest_motion"] != REST]
    ratio = second[[f"rms_normal_{motion}_m" for motion in MOTIONS]].max(axis=1) / second[f"rms_normal_{REST}_m"]
    if not ratio.notna().any():
        return text
    worst = second.loc[ratio.idxmax()]
    motion, speed = worst["largest_motion"], worst["speed_rad_s"]
    rest, largest = (1e3 * worst[f"rms_normal_{name}_m"] for name in (REST, motion))
    text += f"; {worst['blade']} in {worst['scene']} at {speed:g} rad/s: from rest {rest:.2f}, {motion} {largest:.2f} mm"
    stress = worst.get(f"median_von_mises_{motion}_pa", np.nan)
    return f"{text} (normal rms), {1e-9 * stress:.2f} GPa" if np.isfinite(stress) else f"{text} (normal rms)"
