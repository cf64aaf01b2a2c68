"""Designs as a map over two numbers that vary: how long they are above yield, and where requirements are met."""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.plain import from_plain
from r37core.results.operating import LENGTH

from .compared import Compared

_LENGTH = "length_certain_rad_s"


def draw_design_map(
    title: str, table: pd.DataFrame, compared: Mapping[str, Any], verdict: pd.DataFrame | None = None
) -> Figure:
    """Length above yield in most revolutions over two keys, a panel for each of what does not vary.

    `compared`: a Compared, as plain values; `verdict`: verdict.csv, whose requirements are lines where their margin is 0, and
    marks on the designs that meet them.
    """
    chosen = from_plain(Compared, compared)
    column = LENGTH if LENGTH in table and table[LENGTH].notna().any() else _LENGTH
    rows, keys = chosen.rows(table), chosen.keys
    panels = [(str(name), part) for name, part in rows.groupby(chosen.other, sort=False)] if chosen.other else [(title, rows)]
    across = min(len(panels), 2)
    down = -(-len(panels) // across)
    size = (style.PAGE if across == 2 else 4.6, 3.2 * down + 0.7)
    figure, grid = plt.subplots(down, across, figsize=size, squeeze=False, sharex=True, sharey=True)
    colours = {"cmap": "cividis", "vmin": 0.0, "vmax": max(float(rows[column].max()), 1.0)}
    for axes, (name, part) in zip(grid.flat, panels, strict=False):
        cells = axes.pcolormesh(*_cells(part, keys, column), **colours)
        axes.set_title(name)
        _label(axes, part, keys)
        if verdict is not None:
            _draw_verdict(axes, part, keys, verdict)
    for axes in list(grid.flat)[len(panels) :]:
        axes.set_axis_off()
    inside = " in operation" if column == LENGTH else ""
    figure.colorbar(cells, ax=grid, label=f"above yield in most revolutions{inside} (rad/s)")
    handles, labels = style.legend_entries(grid.flat)
    if handles:
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
    figure.suptitle(f"family {title.replace('__', ' x ')}")
    return figure


def _cells(rows: pd.DataFrame, keys: Sequence[str], column: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners of cells, one unit for each value, and values; values may lie at any distance."""
    values = rows.pivot_table(index=keys[1], columns=keys[0], values=column, aggfunc="max", dropna=False).to_numpy(float)
    return np.arange(values.shape[1] + 1) - 0.5, np.arange(values.shape[0] + 1) - 0.5, values


def _label(axes: Axes, rows: pd.DataFrame, keys: Sequence[str]) -> None:
    for axis, key in zip((axes.xaxis, axes.yaxis), keys, strict=True):
        values = np.unique(rows[key])
        axis.set_ticks(np.arange(len(values)), [f"{value:.4g}" for value in values])
        axis.set_label_text(key)
    axes.grid(visible=False)


def _draw_verdict(axes: Axes, rows: pd.DataFrame, keys: Sequence[str], verdict: pd.DataFrame) -> None:
    """A mark on each design that meets all requirements, and a line where the margin of each requirement is 0."""
    judged = rows[["blade", "scene", *keys]].merge(verdict, on=["blade", "scene"])
    places = {key: np.unique(rows[key]) for key in keys}
    meets = judged.assign(meets=judged["verdict"] == "meets").groupby(["blade", "scene", *keys])["meets"].all().reset_index()
    good = meets[meets["meets"]]
    if len(good):
        at = [np.searchsorted(places[key], good[key]) for key in keys]
        axes.plot(*at, "o", color="white", markeredgecolor="black", markersize=5, label="meets all requirements")
    for number, (name, part) in enumerate(judged.groupby("requirement", sort=False)):
        margin = part.pivot_table(index=keys[1], columns=keys[0], values="margin", aggfunc="min", dropna=False).to_numpy(float)
        if min(margin.shape) > 1 and np.nanmin(margin) < 0.0 < np.nanmax(margin):
            colour = style.COLOURS[(1 + number) % len(style.COLOURS)]
            axes.contour(margin, levels=[0.0], colors=[colour], linewidths=1.4)
            axes.plot([], [], color=colour, label=f"limit: {name}")
