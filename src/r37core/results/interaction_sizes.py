"""How dangerous the interactions of summary.csv are, as sizes of the marks that show them."""

import numpy as np
import pandas as pd
import xarray as xr

from r37core.time_integration.status import RunStatus

_OF = (
    "length_most_revolutions_rad_s", "width_above_yield_rad_s", "most_revolutions_from_rad_s", "most_revolutions_to_rad_s",
    "peak_motion_m",
)  # fmt: skip


def sized(interactions: pd.DataFrame, rms: xr.Dataset) -> pd.DataFrame:
    """The table with columns `frequency`, `size`, `unit` and `onward`.

    `frequency` (Hz): of the engine order at the peak speed, NaN without one. `size`: length above yield in most revolutions,
    or the width where there is none (rad/s); in a scene without stress the motion (mm); `unit`: which of these. `onward`:
    whether the speeds above yield reach to an end of those that were run, by `rms`.
    """
    table = interactions.reindex(columns=[*interactions.columns, *(name for name in _OF if name not in interactions)])
    length, width, begin, end, motion = (table[name].astype(float) for name in _OF)
    length = length.fillna(width)
    stress = length.notna().groupby(table["scene"]).transform("any").astype(bool)
    ran = rms["speed"].where(rms["status"] != RunStatus.NOT_RUN)
    pairs = pd.MultiIndex.from_frame(table[["blade", "scene"]])
    first, last = (ends.to_series().reindex(pairs).to_numpy() for ends in (ran.min("speed"), ran.max("speed")))
    return interactions.assign(
        frequency=table["engine_order"].astype(float) * table["peak_speed_rad_s"] / (2.0 * np.pi),
        size=length.where(stress, 1e3 * motion).fillna(0.0),
        unit=np.where(stress, "rad/s", "mm"),
        onward=(begin <= first) | (end >= last),
    )
