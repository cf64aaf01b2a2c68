"""Columns of second motions in summary.csv and ranking.csv: the worst of all motions at each speed."""

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.results.columns import MOST_REVOLUTIONS, names
from r37core.results.exceedance import Exceedance, is_lined
from r37core.results.other_motions import swept
from r37core.time_integration.status import RunStatus

from .choice import REST
from .columns import SECOND_MOTION, WORST_MOTION

WITHIN = 0.06
"""Distance of a speed from the peak of an interaction, as a share of it, within which another motion belongs to that."""


def ranking_with_motions(ranking: pd.DataFrame, file: Path | str) -> pd.DataFrame:
    """The ranking with WORST_MOTION: lengths above yield by the motion from rest and by the worst one, on the same speeds.

    `file`: dataset of the motions. The worst one has the length of the runs from rest where that is longer: they may be at more
    speeds.
    """
    motions = read_dataset(file)
    rows = [_worst(swept(motions.sel(blade=row.blade, scene=row.scene))) for row in ranking.itertuples()]
    *lengths, rank = names(WORST_MOTION)
    table = pd.concat([ranking, pd.DataFrame(rows, index=ranking.index, columns=lengths)], axis=1)
    worst, rest = table["length_most_revolutions_worst_rad_s"], table.get("length_most_revolutions_rad_s", np.nan)
    table["length_most_revolutions_worst_rad_s"] = worst.where(worst.isna(), np.fmax(worst, rest))
    alike = [name for name in ("scene", "contact") if name in table]
    table[rank] = table.groupby(alike)["length_most_revolutions_worst_rad_s"].rank(method="min").astype("Int64")
    return table


def _worst(pair: xr.Dataset) -> dict[str, float]:
    if not pair.sizes["speed"]:
        return {}
    row = {"largest_rms_worst_m": float(pair["motion_mean"].max())}
    row["carried_revolutions"] = float(pair["revolutions"].where(pair["motion"] != REST).max())
    if "share_of_revolutions_above_yield" in pair:
        row["length_most_revolutions_rest_rad_s"] = worst_exceedance(pair.sel(motion=[REST])).length(MOST_REVOLUTIONS)
        row["length_most_revolutions_worst_rad_s"] = worst_exceedance(pair).length(MOST_REVOLUTIONS)
    return row


def worst_exceedance(pair: xr.Dataset) -> Exceedance:
    """Revolutions above yield of the worst motion at each speed, of `swept` motions with stress; all of one that diverged."""
    diverged = pair["status"] == RunStatus.DIVERGED
    shares = pair["share_of_revolutions_above_yield"].where(~diverged, 1.0).max("motion")
    return Exceedance(pair["speed"].values, shares.values, not is_lined(pair))


def summary_with_motions(summary: pd.DataFrame, file: Path | str) -> pd.DataFrame:
    """The summary with SECOND_MOTION: the motion of each interaction that is most above that from rest, where they differ.

    `file`: dataset of the motions. Speeds belong to the interaction whose peak is nearest, up to WITHIN of it.
    """
    motions, table, (name, *numbers) = read_dataset(file), summary.copy(), names(SECOND_MOTION)
    table[name] = pd.Series("", table.index, dtype=object)
    table[numbers] = np.nan
    for (blade, scene), rows in table.groupby(["blade", "scene"], sort=False):
        pair, peaks = swept(motions.sel(blade=blade, scene=scene)), rows["peak_speed_rad_s"]
        mean = pair["motion_mean"].transpose("motion", "speed").values
        rest = mean[pair["motion"].values == REST]
        # by ratio, as ranges have it; one that diverged is above all others, and nothing is above it
        above = np.nan_to_num(mean, nan=np.inf) / np.maximum(np.nan_to_num(rest, nan=np.inf), np.finfo(float).tiny)
        above = np.where(np.isnan(rest), 0.0, above)
        for place in np.argsort(above.max(axis=0, initial=0.0), kind="stable"):
            speed, motion = float(pair["speed"][place]), int(np.argmax(above[:, place]))
            nearest = (peaks - speed).abs().fillna(np.inf).idxmin()
            if pair["differ"][place] and above[motion, place] > 1.0 and abs(peaks[nearest] - speed) <= WITHIN * peaks[nearest]:
                rms = pair["rms_normal"].isel(speed=place)
                values = (str(pair["motion"].values[motion]), speed, float(rms[motion]), float(rms.sel(motion=REST)))
                # the last one is the largest
                table.loc[nearest, [name, *numbers]] = values
    return table
