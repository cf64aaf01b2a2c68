"""run_ups.csv and run_up_rates.csv: what a run-up does to a blade, and how fast it has to be."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.measures import first_yield, leading_edge, motion
from r37core.results.table_file import read_table
from r37core.time_integration.status import RunStatus
from r37studies.closing import largest_stress_text

from .dataset import runs_of

CASE = ["blade", "scene", "low_speed_rad_s", "high_speed_rad_s", "direction", "lining"]
CASE += ["revolutions_before", "revolutions_after"]
"""Columns of run-ups that differ by their rates alone."""


def run_up_table(dataset: xr.Dataset) -> pd.DataFrame:
    """Table with a row for each run-up, of its revolutions after those at the first speed; NaN where there is no such number.

    The `peak` is where the leading edge's normal and tangential rms are together largest; `last` is the last revolution.
    `casing_hits`: how often a node came upon the bare casing, in the revolutions before, too.
    """
    return pd.DataFrame([_row(run) for run in runs_of(dataset)])


def _row(run: xr.Dataset) -> dict[str, Any]:
    edge, speed = leading_edge(run), run["speed"].values
    start, stop = float(run["start_speed"]), float(run["stop_speed"])
    row: dict[str, Any] = {
        "blade": str(run["blade"].values),
        "scene": str(run["scene"].values),
        "run_up": str(run["run_up"].values),
        "low_speed_rad_s": min(start, stop),
        "high_speed_rad_s": max(start, stop),
        "direction": "down" if stop < start else "up",
        "rate_rad_s2": abs(float(run["rate"])),
        "lining": "worn" if run["worn"] else "new",
        "revolutions_before": int(run["revolutions_before"]),
        "revolutions_after": int(run["revolutions_after"]),
        "status": RunStatus(int(run["status"])).text,
    }
    if len(speed):
        peak = int(np.argmax(motion(run)))
        row |= {
            "peak_speed_rad_s": float(speed[peak]),
            "peak_rms_normal_m": float(edge["rms_normal"][peak]),
            "peak_rms_tangential_m": float(edge["rms_tangential"][peak]),
            "casing_hits": int(run["casing_hits"]),
        }
    if "max_von_mises" in run:
        stress, limit = run["max_von_mises"].values, float(run["yield_stress"])
        row |= {"largest_stress_pa": np.nan, "yield_stress_pa": limit}
        if np.isfinite(stress).any():
            worst, first = int(np.argmax(stress)), first_yield(stress, limit)
            row |= {
                "largest_stress_pa": float(stress[worst]),
                "largest_stress_speed_rad_s": float(speed[worst]),
                "first_yield_speed_rad_s": float(speed[int(first) - 1]) if np.isfinite(first) else np.nan,
                "revolutions_above_yield": int(np.count_nonzero(stress > limit)),
                "last_von_mises_pa": float(stress[-1]),
            }
    for name, column in (("miner_sum", "miner_sum"), ("largest_stress_range", "largest_stress_range_pa")):
        if name in run:
            row[column] = float(run[name])
    if "max_wear" in run and len(speed):
        row["max_wear_m"] = float(run["max_wear"][-1])
    return row


def rate_table(runs: pd.DataFrame) -> pd.DataFrame:
    """Table with a row for each blade, scene, range of speeds, direction and lining: which of the rates stay below yield.

    `lowest_safe_rate_rad_s2`: the slowest of the rates from which on all faster ones stay below, NaN where the fastest does
    not. `rate_at_yield_rad_s2`: between it and the next slower one, where a straight line of the logarithms passes yield; NaN
    where all stay below. A run that diverged is above. Runs at constant speed have no rate.
    """
    if "largest_stress_pa" not in runs:
        return pd.DataFrame(columns=[*CASE, *_RATES])
    # a scene without stress says nothing
    judged = runs["largest_stress_pa"].notna() | (runs["status"] == RunStatus.DIVERGED.text)
    runs = runs[judged & (runs["rate_rad_s2"] > 0.0)]
    return pd.DataFrame(
        [dict(zip(CASE, case, strict=True)) | safe_rates(group) for case, group in runs.groupby(CASE, sort=False)],
        columns=[*CASE, *_RATES],
    )


_RATES = [
    "rates",
    "slowest_rate_rad_s2",
    "fastest_rate_rad_s2",
    "lowest_safe_rate_rad_s2",
    "rate_at_yield_rad_s2",
    "largest_share_of_yield",
]


def safe_rates(group: pd.DataFrame) -> dict[str, float]:
    """The numbers of a row of `rate_table`, of run-ups that differ by their rates alone."""
    ratio = (group["largest_stress_pa"] / group["yield_stress_pa"]).where(group["status"] == RunStatus.COMPLETED.text, np.inf)
    # of several with one rate the worst counts
    ordered = group.assign(ratio=ratio).sort_values(["rate_rad_s2", "ratio"])
    rates, ratios = ordered["rate_rad_s2"].to_numpy(), ordered["ratio"].to_numpy()
    above = np.flatnonzero(~(ratios <= 1.0))
    first = int(above[-1]) + 1 if len(above) else 0
    yield_run = np.nan
    if 0 < first < len(rates):
        slow, fast = np.log(ratios[first - 1]), np.log(ratios[first])
        share = slow / (slow - fast) if np.isfinite(slow) else 1.0
        yield_run = float(rates[first - 1] * (rates[first] / rates[first - 1]) ** share)
    lowest = float(rates[first]) if first < len(rates) else np.nan
    values = (len(rates), float(rates[0]), float(rates[-1]), lowest, yield_run, float(np.max(ratios)))
    return dict(zip(_RATES, values, strict=True))


def closing(results: Path) -> str:
    """Closing line: how many run-ups there are, how many pass yield or diverge, and the largest stress of all."""
    table = read_table(results / "run_ups.csv")
    text = counted(len(table), "run-up")
    if "largest_stress_pa" in table:
        text += f", {int((table['largest_stress_pa'] > table['yield_stress_pa']).sum())} of them above yield"
    if diverged := int((table["status"] == RunStatus.DIVERGED.text).sum()):
        text += f", {diverged} diverged"
    return text + largest_stress_text(table, "largest_stress_speed_rad_s")
