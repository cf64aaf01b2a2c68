"""A search: how good its designs became, and the objectives against each other."""

from itertools import combinations, cycle
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from r37core.base.units import shown_unit
from r37core.figures import style

from .designs import START

_DOTS: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 4, "elinewidth": 0.6, "clip_on": False}
_FRONT: dict[str, Any] = {**_DOTS, "linestyle": "-", "drawstyle": "steps-post", "color": style.COLOURS[1], "zorder": 4}
_START: dict[str, Any] = {**_DOTS, "marker": "s", "color": "0.15", "zorder": 5}
_PALE: dict[str, Any] = {**_DOTS, "color": "0.72", "markerfacecolor": "none"}

_Axis = tuple[str, np.ndarray, np.ndarray]
"""Label of an axis, and values and scatter [design] in its unit."""


def draw_designs(search: xr.Dataset) -> Figure:
    """Best value of each objective over the number of designs, then each two objectives against each other."""
    objectives = [_objective(search, name) for name in search["objective"].values]
    pairs = list(combinations(objectives, 2))
    count = len(objectives) + len(pairs)
    rows = -(-count // 2)
    figure, grid = style.panels(rows, min(count, 2), 2.5 * rows + 0.7)
    for axes, objective, colour in zip(grid.flat, objectives, cycle(style.COLOURS), strict=False):
        _draw_best(axes, search, objective, colour)
    for axes, pair in zip(grid.flat[len(objectives) :], pairs, strict=False):
        _draw_pair(axes, search, *pair)
    for axes in grid.flat[count:]:
        axes.set_axis_off()
    style.legend_below(figure, grid.flat, 4)
    feasible, tried = int(search["feasible"][1:].sum()), search.sizes["design"] - 1
    figure.suptitle(f"search: {tried} designs, of which {feasible} can be built and keep all constraints")
    return figure


def _objective(search: xr.Dataset, name: str) -> _Axis:
    objective_data = search.sel(objective=name)
    unit, factor = shown_unit(objective_data["objective_unit"].item())
    values, scatter = (factor * objective_data[f"objective_{part}"].values for part in ("value", "scatter"))
    return f"{name} ({unit})" if unit else str(name), values, scatter


def _draw_best(axes: Axes, search: xr.Dataset, objective: _Axis, colour: str) -> None:
    """Best feasible value so far over the number of designs, the start as a line, and where the first designs end."""
    label, values, _ = objective
    # the start is the first of all
    feasible = (search["feasible"].values == 1) & np.isfinite(values)
    best = np.minimum.accumulate(np.where(feasible, values, np.inf)[1:])
    best[np.isinf(best)] = np.nan
    last = f"{best[-1]:.4g}" if np.isfinite(best[-1]) else "none"
    axes.plot(np.arange(1, len(values)), best, drawstyle="steps-post", color=colour)
    if np.isfinite(values[0]):
        axes.axhline(values[0], color=_START["color"], linewidth=0.9, linestyle="--")
    axes.axvline(np.sum(search["round"].values == 0) + 0.5, color="0.5", linewidth=0.8, linestyle=":")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set(xlim=(0.0, len(values)), xlabel="designs tried", ylabel=f"best {label}", title=f"{last}, start {values[0]:.4g}")


def _draw_pair(axes: Axes, search: xr.Dataset, across: _Axis, up: _Axis) -> None:
    """An objective against another, lower left is better, with the designs that none beats."""
    (xlabel, x, width), (ylabel, y, height) = across, up
    feasible, known, designs = search["feasible"].values == 1, np.isfinite(x) & np.isfinite(y), np.arange(len(x))
    front = search["not_dominated"].values == 1
    for chosen, look, label in (
        (~feasible & (designs > 0), _PALE, "breaks a constraint"),
        (feasible & (designs > 0), _DOTS, "keeps all constraints"),
        (front, _FRONT, "none is better in all objectives"),
        (designs == 0, _START, START),
    ):
        shown = np.flatnonzero(chosen & known)
        shown = shown[np.lexsort((y[shown], x[shown]))]
        # without any neither mark nor legend, which an unclipped empty line would spoil
        if shown.size:
            axes.errorbar(x[shown], y[shown], *np.nan_to_num([height[shown], width[shown]]), label=label, **look)
    axes.set(xlabel=xlabel, ylabel=ylabel)
