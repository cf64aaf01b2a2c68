"""Columns of second motions in ranking.csv: the worst of all motions at each speed."""

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
from .columns import WORST_MOTION


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
