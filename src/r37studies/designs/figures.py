"""A family of designs: robustness and structure against what varies."""

from collections.abc import Mapping
from textwrap import fill
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from r37core.base.plain import from_plain
from r37core.base.units import shown_unit, unit_of
from r37core.figures import style
from r37core.results.columns import LENGTHS, names

from .compared import Compared, axis_of_key
from .table import STRUCTURE

_ROBUSTNESS = (
    "shift_1b_rad_s", *names(LENGTHS), "largest_median_stress_pa", "largest_stress_pa", "largest_goodman_share"
)  # fmt: skip
_DRAWN = {"blade": (*names(STRUCTURE), *_ROBUSTNESS), "scene": (*_ROBUSTNESS, "exceedance_integral_rad_s", "largest_rms_m")}
"""Measures that a family of blades, or of scenes, is chosen by."""

_TITLES = {
    "mass_kg": "mass",
    "frequency_1b_hz": "1B at rest",
    "frequency_1t_hz": "1T at rest",
    "clearance_loss_1b_m": "loss of clearance, 1B",
    "clearance_loss_1t_m": "loss of clearance, 1T",
    "shift_1b_rad_s": "shift of 1B",
    "length_dangerous_rad_s": "dangerous speeds",
    "length_unknown_rad_s": "unknown speeds",
    "length_most_revolutions_rad_s": "sustained speeds",
    "largest_median_stress_pa": "median stress",
    "largest_stress_pa": "largest stress",
    "largest_goodman_share": "Goodman share",
    "exceedance_integral_rad_s": "integral above yield",
    "largest_rms_m": "largest rms, both directions",
}
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
    figure, grid = style.panels(count, 3, 2.1 * count + (0.9 if len(keys) > 1 else 0.1), sharex=True)
    for axes, measure in zip(grid.flat, drawn, strict=True):
        unit, factor = shown_unit(unit_of(measure))
        for name, rows in table.groupby(chosen.other, sort=False):
            if len(keys) == 1:
                rows = rows.sort_values(keys[0])
                places, marker = axis_of_key(keys[0])[1] * rows[keys[0]], "o-"
            else:
                places, marker = np.arange(len(rows)), "o"
                axes.set_xticks(places, rows[kind])
            axes.plot(places, factor * rows[measure], marker, markersize=4, label=str(name))
        axes.set_ylabel(f"{fill(_TITLES[measure], _LABEL_WIDTH)}\n({unit})")
    # what does not depend on the scene is the same line twice
    style.legend_below(figure, [grid.flat[-1]], 4)
    for axes in grid[-1]:
        if len(keys) == 1:
            axes.set_xlabel(axis_of_key(keys[0])[0])
        else:
            axes.tick_params(axis="x", rotation=90, labelsize=6)
    figure.suptitle(f"family {title}: {table[kind].nunique()} designs over {', '.join(keys)}")
    return figure
