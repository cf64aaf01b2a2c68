"""second_motions.csv and second_motions_dwells.csv."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.columns import Column, names
from r37core.results.other_motions import swept
from r37core.results.table_file import read_table
from r37core.time_integration.status import MotionKind

from .choice import MOTIONS, REST
from .lasting import HIGH, LOW, STARTS, VERDICT, Lasting, judged
from .states import MotionLevels

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
    Column("dwell_speed_rad_s", "speed of the dwell that decides `kind`"),
    Column("kind", "result of the dwells for the largest motion: `diverged`, `lasting`, `switching` or `transient`"),
    Column("share_of_time", "share of a long time that the largest motion takes, where motions change"),
    Column("held_revolutions", "revolutions for which the largest motion is held, `inf` if never left"),
)
"""Columns of second_motions.csv."""

RANGE_COLUMNS = names(RANGES)
"""Names of the columns of second_motions.csv."""

DWELL_COLUMNS = (
    "blade",
    "scene",
    "speed_rad_s",
    "level_high_m",
    "level_low_m",
    *VERDICT,
    *(
        f"{what}_{which}"
        for which in (HIGH, LOW)
        for what in ("motion", "motion_kind", "period_revolutions", "lyapunov_exponent")
    ),
)
"""Columns of second_motions_dwells.csv."""

_RECURRING = (MotionKind.PERIODIC, MotionKind.MULTIPLE)

_STRONGEST = (Lasting.DIVERGED, Lasting.LASTING, Lasting.SWITCHING, Lasting.TRANSIENT)


def dwell_table(dwells: xr.Dataset) -> pd.DataFrame:
    """A row for each blade, scene and speed that was dwelt on: what becomes of both motions; see DWELL_COLUMNS."""
    frame = dwells.drop_dims("revolution").to_dataframe()
    rows = []
    for (blade, scene, speed), places in frame.groupby(["blade", "scene", "speed"], sort=False).groups.items():
        group = dwells.isel(dwell=list(places))
        starts = group["start"].values.astype(str)
        high, low = float(group["level_high"][0]), float(group["level_low"][0])
        rms = group["revolution_rms"].values.astype(float)
        row: dict[str, Any] = {"blade": blade, "scene": scene, "speed_rad_s": speed, "level_high_m": high, "level_low_m": low}
        if high > low > 0.0:
            several = {start: list(rms[starts == start]) for start in STARTS}
            row |= judged(several, high, low, lined=bool(group["lined"][0]))
        for which in (HIGH, LOW) if HIGH in starts and LOW in starts else ():
            dwell = group.isel(dwell=int(np.flatnonzero(starts == which)[0]))
            kind = MotionKind(int(dwell["motion_kind"]))
            row |= {
                f"motion_{which}": str(dwell["motion"].values),
                f"motion_kind_{which}": kind.text,
                f"period_revolutions_{which}": float(dwell["recurrence_period"]) if kind in _RECURRING else np.nan,
                f"lyapunov_exponent_{which}": float(dwell["lyapunov_exponent"]),
            }
        rows.append(row)
    return pd.DataFrame(rows, columns=list(DWELL_COLUMNS))


def range_table(motions: xr.Dataset, dwells: pd.DataFrame) -> pd.DataFrame:
    """A row for each range of hysteresis, at the speed where the motions differ most; see RANGE_COLUMNS.

    `dwells`: the table of these. `kind` is what becomes of the largest motion: the strongest at the range's speeds that were
    dwelt on, at `dwell_speed_rad_s`.
    """
    rows = []
    for blade in motions["blade"].values.tolist():
        for scene in motions["scene"].values.tolist():
            pair = swept(motions.sel(blade=blade, scene=scene))
            levels = MotionLevels.read(pair)
            pair_dwells = dwells[(dwells["blade"] == blade) & (dwells["scene"] == scene)]
            key = {"blade": blade, "scene": scene}
            rows += [key | _range_row(pair, levels, part, pair_dwells) for part in levels.ranges()]
    return pd.DataFrame(rows, columns=list(RANGE_COLUMNS))


def _range_row(pair: xr.Dataset, levels: MotionLevels, part: slice, dwells: pd.DataFrame) -> dict[str, Any]:
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
    here = dwells[dwells["speed_rad_s"].between(speeds[0], speeds[-1]) & dwells["high"].notna()]
    for kind in _STRONGEST:
        those = here[here["high"] == str(kind)]
        if len(those):
            strongest = those.loc[(those["level_high_m"] / those["level_low_m"]).fillna(np.inf).idxmax()]
            row |= {
                "dwell_speed_rad_s": strongest["speed_rad_s"],
                "kind": str(kind),
                "share_of_time": strongest["share_of_time_high"],
                "held_revolutions": strongest["high_revolutions"],
            }
            break
    return row


def closing(results: Path) -> str:
    """How many ranges there are, in how many the largest motion lasts, and where it is most above that from rest."""
    table = read_table(results / "second_motions.csv")
    text = counted(len(table), "range") + " of hysteresis"
    if not len(table):
        return text
    second = table[table["largest_motion"] != REST]
    lasting = int((second["kind"] == str(Lasting.LASTING)).sum())
    if second["kind"].notna().any():
        text += f", {lasting} of them with a second motion that lasts"
    ratio = second[[f"rms_normal_{motion}_m" for motion in MOTIONS]].max(axis=1) / second[f"rms_normal_{REST}_m"]
    if not ratio.notna().any():
        return text
    worst = second.loc[ratio.idxmax()]
    motion, speed = worst["largest_motion"], worst["speed_rad_s"]
    rest, largest = (1e3 * worst[f"rms_normal_{name}_m"] for name in (REST, motion))
    text += f"; {worst['blade']} in {worst['scene']} at {speed:g} rad/s: from rest {rest:.2f}, {motion} {largest:.2f} mm"
    stress = worst.get(f"median_von_mises_{motion}_pa", np.nan)
    return f"{text} (normal rms), {1e-9 * stress:.2f} GPa" if np.isfinite(stress) else f"{text} (normal rms)"
