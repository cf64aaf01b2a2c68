"""A family of designs: robustness and structure against what varies."""

from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.base.plain import from_plain
from r37core.figures import style
from r37core.results.columns import LENGTHS, names

from .compared import Compared, axis_of_key
from .table import MEASURES, STRUCTURE

_ROBUSTNESS = (
    "shift_1b_rad_s", *names(LENGTHS), "largest_median_stress_pa", "largest_stress_pa", "largest_goodman_share"
)  # fmt: skip
_DRAWN = {"blade": (*names(STRUCTURE), *_ROBUSTNESS), "scene": (*_ROBUSTNESS, "exceedance_integral_rad_s", "largest_rms_m")}
"""Measures that a family of blades, or of scenes, is chosen by."""

_LABEL_WIDTH = 22
"""Letters in a line of an axis label."""


def draw_designs(title: str, table: pd.DataFrame, compared: Mapping[str, Any]) -> Figure:
    """Draw the measures of a family over the key that varies, or over the designs by name; a line for each of the other kind.

    `compared`: a Compared, as plain values.
    """
    chosen = from_plain(Compared, compared)
    table, kind, keys = chosen.rows(table), chosen.kind, chosen.keys
    drawn = _DRAWN[kind]
    count = len(drawn) // 3
    figure, grid = plt.subplots(count, 3, figsize=(style.PAGE, 2.1 * count + (0.9 if len(keys) > 1 else 0.1)), sharex=True)
    measures = {column.name: column for column in MEASURES}
    for axes, measure in zip(grid.flat, drawn, strict=True):
        column = measures[measure]
        for name, rows in table.groupby(chosen.other, sort=False):
            _draw(axes, rows.assign(**{measure: column.factor * rows[measure]}), measure, kind, keys, str(name))
        axes.set_ylabel(f"{fill(column.title, _LABEL_WIDTH)}\n({column.unit})")
    # what does not depend on the scene is the same line twice
    figure.legend(*style.legend_entries([grid.flat[-1]]), loc="outside lower center", ncols=4)
    for axes in grid[-1]:
        if len(keys) == 1:
            axes.set_xlabel(axis_of_key(keys[0])[0])
        else:
            axes.tick_params(axis="x", rotation=90, labelsize=6)
    figure.suptitle(f"family {title}: {table[kind].nunique()} designs over {', '.join(keys)}")
    return figure


def _draw(axes: Axes, rows: pd.DataFrame, column: str, kind: str, keys: Sequence[str], label: str) -> None:
    if len(keys) == 1:
        ordered = rows.sort_values(keys[0])
        axes.plot(axis_of_key(keys[0])[1] * ordered[keys[0]], ordered[column], "o-", markersize=4, label=label)
    else:
        places = np.arange(len(rows))
        axes.plot(places, rows[column], "o", markersize=4, label=label)
        axes.set_xticks(places, rows[kind])
