"""Designs as a map over two numbers that vary, in a figure and in the explorer: how long above yield, and what they meet."""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, QuadMesh
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from r37core.base.plain import from_plain
from r37core.explorer.contents import packed
from r37core.figures import style

from .compared import Compared, axis_of_key
from .table import compared_in, length_column, unknown_length


def draw_design_map(
    title: str, table: pd.DataFrame, compared: Mapping[str, Any], verdict: pd.DataFrame | None = None
) -> Figure:
    """Length of the dangerous speeds over two keys, a panel for each of what does not vary; hatched where some are unknown.

    Where no design is dangerous, the largest share of the Goodman line in all that was tried is drawn instead.
    `compared`: a Compared, as plain values; `verdict`: verdict.csv, whose requirements are lines round the designs
    that do not fail them, and marks on those that meet all.
    """
    chosen = from_plain(Compared, compared)
    keys = chosen.keys
    rows, column, label, digits = measured(chosen.rows(table), verdict)
    panels = [(str(name), part) for name, part in rows.groupby(chosen.other, sort=False)] if chosen.other else [(title, rows)]
    across = min(len(panels), 3)
    down = -(-len(panels) // across)
    size = (4.6 if across == 1 else style.PAGE, (2.7 if across == 3 else 3.2) * down + 0.7)
    figure, grid = plt.subplots(down, across, figsize=size, squeeze=False, sharex=True, sharey=True)
    highest = max(float(rows[column].max()), 1.0)
    for axes, (name, part) in zip(grid.flat, panels, strict=False):
        unknown = _grid(part.assign(unknown=unknown_length(part)), keys, "unknown", "max")
        cells = _draw_cells(axes, _grid(part, keys, column, "max"), unknown, highest, digits)
        axes.set_title(name)
        for axis, key in zip((axes.xaxis, axes.yaxis), keys, strict=True):
            words, factor = axis_of_key(key)
            values = factor * np.unique(part[key])
            axis.set_ticks(np.arange(len(values)), [f"{value:.4g}" for value in values])
            axis.set_label_text(words)
        axes.grid(visible=False)
        axes.label_outer()
        if verdict is not None:
            _draw_verdict(axes, part, keys, verdict)
    for axes in list(grid.flat)[len(panels) :]:
        axes.set_axis_off()
    figure.colorbar(cells, ax=grid, label=label)
    hatched = Patch(**style.UNKNOWN)
    style.legend_below(figure, grid.flat, 2, {UNKNOWN: hatched} if unknown_length(rows).any() else None)
    figure.suptitle(f"family {title.replace('__', ' x ')}")
    return figure


UNKNOWN = "unknown at some speeds: the model is left first"
"""Label of designs with unknown speeds."""


def measured(rows: pd.DataFrame, verdict: pd.DataFrame | None) -> tuple[pd.DataFrame, str, str, int]:
    """Rows with the column that is drawn, here and in the explorer, its name, its label and the digits of its values."""
    column = length_column(rows)
    if verdict is not None and not rows[column].any():
        tried = verdict[verdict["requirement"] == "goodman_share"][["blade", "scene", "value_highest"]]
        if len(tried):
            label = "largest share of the Goodman line"
            return rows.merge(tried, on=["blade", "scene"]), "value_highest", label, 2
    return rows, column, f"dangerous speeds{' in operation' if 'operating' in column else ''} (rad/s)", 0


def contents(designs: pd.DataFrame, verdict: pd.DataFrame | None = None) -> list[dict[str, object]]:
    """A map of each family of two keys: its `family`, `axes`, `other` (blade or scene, of which each has a map), and cells.

    `axes`: label and factor of each key; `cells`: blade, scene and values of the keys; `values`, `label` and `digits`: those
    of the figure (measured), `unknown`: unknown_length, by cell.
    """
    maps: list[dict[str, object]] = []
    for name, compared in compared_in(designs).items():
        if len(compared.keys) == 2:
            rows, column, label, digits = measured(designs[designs["family"] == name], verdict)
            cells = rows[["blade", "scene", *compared.keys]].to_numpy().tolist()
            values, unknown = packed(rows[column].to_numpy(float)), packed(unknown_length(rows).to_numpy(float))
            about = {"family": name, "axes": [axis_of_key(key) for key in compared.keys], "other": compared.other}
            maps.append(about | {"cells": cells, "values": values, "unknown": unknown, "label": label, "digits": digits})
    return maps


def _grid(rows: pd.DataFrame, keys: Sequence[str], column: str, together: str) -> np.ndarray:
    """Values over the second and the first key, whatever the distance of these."""
    return rows.pivot_table(index=keys[1], columns=keys[0], values=column, aggfunc=together, dropna=False).to_numpy(float)


def _draw_cells(axes: Axes, values: np.ndarray, unknown: np.ndarray, highest: float, digits: int) -> QuadMesh:
    """Cells of one unit each with their values; of a length with those that are `unknown` both ends of its bracket."""
    corners = (np.arange(count + 1) - 0.5 for count in values.shape[::-1])
    cells = axes.pcolormesh(*corners, values, cmap="cividis", vmin=0.0, vmax=highest)
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            colour = "white" if value < 0.5 * highest else "black"
            text, more = f"{value:.{digits}f}", unknown[row, column]
            if more > 0.0:
                axes.add_patch(Rectangle((column - 0.5, row - 0.5), 1.0, 1.0, **style.UNKNOWN))
                text += "" if digits else f" to {value + more:.0f}"
            axes.text(column, row, text, color=colour, fontsize=8, ha="center", va="center")
    return cells


def _draw_verdict(axes: Axes, rows: pd.DataFrame, keys: Sequence[str], verdict: pd.DataFrame) -> None:
    """A mark on each design that meets all requirements, and lines round those that do not fail one."""
    judged = rows[["blade", "scene", *keys]].merge(verdict, on=["blade", "scene"])
    meets, keeps = judged["verdict"].isin(["meets", "does not apply"]), judged["verdict"] != "fails"
    judged = judged.assign(meets=meets.astype(float), keeps=keeps.astype(float))
    up, across = np.nonzero(_grid(judged, keys, "meets", "min") == 1.0)
    if len(up):
        axes.plot(across, up - 0.3, "o", color="white", markeredgecolor="black", markersize=5, label="meets all requirements")
    for number, (name, part) in enumerate(judged.groupby("requirement", sort=False)):
        borders = _borders(_grid(part, keys, "keeps", "min"))
        if borders:
            # dashed on solid, where limits lie on each other
            colour, dashes = style.COLOURS[(1 + number) % len(style.COLOURS)], "--" if number % 2 else "-"
            lines = LineCollection(
                borders, linewidths=2.0, colors=colour, linestyles=dashes, label=f"limit of {name}".replace("_", " ")
            )
            axes.add_collection(lines, autolim=False)


def _borders(inside: np.ndarray) -> list[list[tuple[float, float]]]:
    """Sides of cells between those inside, 1, and others, 0, as pairs of points; none to cells without a design, NaN."""
    borders = []
    for axis in (1, 0):
        for row, column in zip(*np.nonzero(np.abs(np.diff(inside, axis=axis)) == 1.0), strict=True):
            end = column + 0.5, row + 0.5
            borders.append([(end[0] - (axis == 0), end[1] - (axis == 1)), end])
    return borders
