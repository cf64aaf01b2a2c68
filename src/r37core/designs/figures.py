"""A family of designs: robustness and structure against what varies."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.figures import style

from .table import MEASURES, STRUCTURE

_DRAWN = (*STRUCTURE, "shift_1b_rad_s", "length_certain_rad_s", "length_possible_rad_s", "largest_median_stress_pa")


def draw_designs(title: str, table: pd.DataFrame, varied: Sequence[str], blades: Sequence[str] | None = None) -> Figure:
    """What a family is chosen by, a line or points per scene: over the one key that varies, or over the designs by name.

    `blades`: those of the table that are drawn, or all.
    """
    if blades is not None:
        table = table[table["blade"].isin(blades)]
    figure, grid = plt.subplots(3, 3, figsize=(style.PAGE, 6.4), sharex=True)
    for axes, column in zip(grid.flat, _DRAWN, strict=True):
        word = MEASURES[column]
        for scene, rows in table.groupby("scene", sort=False):
            _draw(axes, rows.assign(**{column: word.factor * rows[column]}), column, varied, str(scene))
        axes.set_ylabel(f"{word.title} ({word.unit})")
    # what does not depend on the scene is the same line twice
    figure.legend(*style.legend_entries([grid.flat[5]]), loc="outside lower center", ncols=4)
    for axes in grid[-1]:
        if len(varied) == 1:
            axes.set_xlabel(varied[0])
        else:
            axes.tick_params(axis="x", rotation=90)
    figure.suptitle(f"family {title}: {table['blade'].nunique()} designs over {', '.join(varied)}")
    return figure


def _draw(axes: Axes, rows: pd.DataFrame, column: str, keys: Sequence[str], label: str) -> None:
    if len(keys) == 1:
        ordered = rows.sort_values(keys[0])
        axes.plot(ordered[keys[0]], ordered[column], "o-", markersize=4, label=label)
    else:
        rows_of_blades = np.arange(len(rows))
        axes.plot(rows_of_blades, rows[column], "o", markersize=4, label=label)
        axes.set_xticks(rows_of_blades, rows["blade"])
