"""How cost grows with each parameter."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from r37core.figures import style  # noqa: F401  (sets the style)

from .growth import Growth


def draw_growth(found: Sequence[Growth]) -> Figure:
    """One panel per pair of parameter and cost, with the fitted power law."""
    columns = 4
    rows = -(-len(found) // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(3.0 * columns, 2.6 * rows), squeeze=False)
    for axes, one in zip(panels.ravel(), found, strict=False):
        axes.loglog(one.values, one.costs, "o")
        axes.loglog(one.values, one.costs[-1] * (one.values / one.values[-1]) ** one.exponent, "--", color="0.5")
        axes.set_title(f"{one.of}: exponent {one.exponent:.2f}", fontsize=8)
        axes.set(xlabel=one.parameter.replace("_", " "), ylabel=one.cost.replace("_", " "))
    for axes in np.ravel(panels)[len(found) :]:
        axes.set_visible(False)
    return figure
