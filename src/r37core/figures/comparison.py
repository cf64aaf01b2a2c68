"""Blades compared by their speeds above yield, scene by scene."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.rom.reduction_choice import LINEAR

from . import style

_MOST_RANKED = 60
"""Blades whose bars fit in a picture."""

_IN_MOST = "length_most_revolutions_rad_s"
_LENGTHS = {
    "length_ever_rad_s": "in any revolution",
    "length_some_revolutions_rad_s": "in some revolutions",
    _IN_MOST: "in most revolutions",
}
"""Lengths above yield, each a bar on the one before, and what they are called."""


def draw_ranking(ranking: pd.DataFrame, scenes: Sequence[str] | None = None) -> Figure:
    """Bars of the speeds above yield in most revolutions, in some and ever, a panel per scene with its blades by their rank.

    Blades that cannot be told apart share a rank and a background. `scenes`: those that are drawn, or all. Of many blades the
    first and the last are drawn; a row between them says how many are left out.
    """
    scenes = [name for name in dict.fromkeys(ranking["scene"]) if scenes is None or name in scenes]
    tables = {scene: _shown_blades(ranking[ranking["scene"] == scene].set_index("blade")) for scene in scenes}
    columns = min(len(scenes), 2)
    rows = -(-len(scenes) // columns)
    size = (style.PAGE, 0.7 + rows * (0.5 + 0.34 * max(3, *map(len, tables.values()))))
    figure, panels = plt.subplots(rows, columns, figsize=size, squeeze=False)
    for axes in panels.flat[len(scenes) :]:
        axes.set_visible(False)
    contacts = ranking["contact"].unique()
    for axes, (scene, table) in zip(panels.flat, tables.items(), strict=False):
        _draw_bars(axes, table, named=len(contacts) > 1)
        tied = len(table) > 1 and len(set(zip(table["rank"], table["contact"], strict=True))) == 1
        title = f"{style.scene_words(scene)}{': cannot be ranked' if tied else ''}"
        axes.set(title=title, xlabel="speeds above yield (rad/s): most / some / ever")
    if len(contacts) == 1 and contacts[0]:
        nodes, _, kinematics = contacts[0].partition(", ")
        figure.suptitle(f"contact: {nodes}; kinematics: {kinematics or LINEAR}")
    figure.legend(*style.legend_entries(list(panels.flat)), loc="outside lower center", ncols=4)
    return figure


def _shown_blades(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of a scene by blade; of many the first and the last, with one of nothing between them."""
    if len(rows) <= _MOST_RANKED:
        return rows
    half = _MOST_RANKED // 2
    return rows.reindex([*rows.index[:half], f"({len(rows) - _MOST_RANKED} more)", *rows.index[-half:]])


def _draw_bars(axes: Axes, rows: pd.DataFrame, *, named: bool) -> None:
    """Bars of one scene, the best above; with `named` contacts under the names of the blades."""
    positions = np.arange(float(len(rows)))
    for (name, label), height, alpha in zip(_LENGTHS.items(), (0.84, 0.66, 0.4), (0.15, 0.4, 1.0), strict=True):
        axes.barh(positions, rows[name], height, color="C0", alpha=alpha, label=label)
    low, high, meaning = _range(rows)
    if np.isfinite(low).any():
        axes.errorbar(
            rows[_IN_MOST], positions, xerr=[low, high], fmt="none", ecolor="0.15", elinewidth=1.0, capsize=2.5, label=meaning
        )
    ends = np.fmax(rows[list(_LENGTHS)].max(axis=1), rows[_IN_MOST] + np.nan_to_num(high))
    largest = np.nanmax([1.0, *ends])
    for position, end, (_, row) in zip(positions, ends, rows.iterrows(), strict=True):
        if np.isfinite(end):
            numbers = " / ".join(f"{row[name]:.0f}" for name in reversed(_LENGTHS))
            axes.text(end + 0.02 * largest, position, numbers, va="center", fontsize=7)
    # a rank is among blades of one contact; rows are in the order of both
    rank = rows["rank"].astype(object).where(rows["rank"].notna(), "")
    shared = pd.Series(list(zip(rank, rows["contact"].fillna(""), strict=True)))
    ties = shared.duplicated(keep=False).values & (rank != "").values
    group = (shared != shared.shift()).cumsum()
    for _, places in pd.Series(positions)[ties].groupby(group[ties]):
        axes.axhspan(places.min() - 0.48, places.max() + 0.48, color="0.5", alpha=0.15, linewidth=0.0, zorder=0.0)
    names = [
        "\n".join([f"{place}{' =' if tie else ''}  {blade}", *([contact] if named and contact else [])])
        for blade, (place, contact), tie in zip(rows.index, shared, ties, strict=True)
    ]
    axes.set_yticks(positions, names)
    axes.grid(visible=False, axis="y")
    axes.set_axisbelow(True)
    axes.set(xlim=(0.0, 1.45 * largest), ylim=(len(rows) - 0.5, -0.5))


def _range(rows: pd.DataFrame) -> tuple[np.ndarray, np.ndarray, str]:
    """Reach (rad/s) of the length in most revolutions, below and above, shape (blades,), NaN if unknown, and its meaning."""
    if f"{_IN_MOST}_low" in rows and rows[f"{_IN_MOST}_low"].notna().any():
        low, high = rows[_IN_MOST] - rows[f"{_IN_MOST}_low"], rows[f"{_IN_MOST}_high"] - rows[_IN_MOST]
        return low.clip(lower=0.0).values, high.clip(lower=0.0).values, "nine tenths of the members"
    within = rows["length_most_revolutions_within_rad_s"].values
    return np.minimum(within, rows[_IN_MOST].values), within, "in most revolutions, known to within"
