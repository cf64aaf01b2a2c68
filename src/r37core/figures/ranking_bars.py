"""Which blade? Speeds above yield of all blades, scene by scene."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import style

_CERTAIN, _POSSIBLE = "length_certain_rad_s", "length_possible_rad_s"


def draw_ranking(ranking: pd.DataFrame) -> Figure:
    """Bars of certain and possible length of speed above yield, a panel per scene, blades in the order of the first one."""
    scenes = list(dict.fromkeys(ranking["scene"]))
    first = ranking[ranking["scene"] == scenes[0]].sort_values("rank", kind="stable")["blade"]
    blades = list(dict.fromkeys([*first, *ranking["blade"]]))
    columns = min(len(scenes), 2)
    rows = -(-len(scenes) // columns)
    size = (style.PAGE, 0.5 + rows * (0.4 + 0.34 * max(len(blades), 3)))
    figure, panels = plt.subplots(rows, columns, figsize=size, sharey=True, squeeze=False)
    for axes in panels.flat[len(scenes) :]:
        axes.set_visible(False)
    for axes, scene in zip(panels.flat, scenes, strict=False):
        _draw(axes, ranking[ranking["scene"] == scene].set_index("blade").reindex(blades))
        axes.set(title=scene, xlabel="speeds above yield (rad/s)")
    panels[0][0].set_yticks(np.arange(len(blades)), blades)
    panels[0][0].invert_yaxis()
    figure.legend(*style.legend_entries(list(panels.flat)), loc="outside lower center", ncols=3)
    return figure


def _draw(axes: Axes, rows: pd.DataFrame) -> None:
    positions = np.arange(float(len(rows)))
    axes.barh(positions, rows[_POSSIBLE], 0.76, color="C0", alpha=0.35, label="in some revolutions")
    axes.barh(positions, rows[_CERTAIN], 0.44, color="C0", label="in most revolutions")
    low, high, meaning = _range(rows)
    if np.isfinite(low).any():
        axes.errorbar(
            rows[_CERTAIN], positions, xerr=[low, high], fmt="none", ecolor="0.15", elinewidth=1.0, capsize=2.5, label=meaning
        )
    high = np.nan_to_num(high)
    largest = np.nanmax([1.0, *rows[_POSSIBLE], *(rows[_CERTAIN] + high)])
    for position, above, (_, row) in zip(positions, high, rows.iterrows(), strict=True):
        if np.isfinite(row[_CERTAIN]):
            ends = np.nanmax([row[_POSSIBLE], row[_CERTAIN] + above])
            axes.text(ends + 0.02 * largest, position, f"{row[_CERTAIN]:.0f} to {row[_POSSIBLE]:.0f}", va="center", fontsize=7)
    axes.set_xlim(0.0, 1.25 * largest)


def _range(rows: pd.DataFrame) -> tuple[np.ndarray, np.ndarray, str]:
    """How far the certain length may lie below and above (rad/s), shape (blades,) each, NaN if unknown, and by what."""
    if f"{_CERTAIN}_low" in rows and rows[f"{_CERTAIN}_low"].notna().any():
        low, high = rows[_CERTAIN] - rows[f"{_CERTAIN}_low"], rows[f"{_CERTAIN}_high"] - rows[_CERTAIN]
        return low.clip(lower=0.0).values, high.clip(lower=0.0).values, "nine tenths of the members"
    scatter = rows["length_certain_scatter_rad_s"].values
    return scatter, scatter, "standard deviation by chance"
