"""A search: how good its designs became, and the objectives against each other."""

from collections.abc import Mapping
from itertools import combinations, cycle, zip_longest
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from r37core.base.units import shown_unit
from r37core.figures import style

from .designs import START

_START_LOOK: dict[str, Any] = {"color": "0.15", "marker": "s", "markersize": 5, "linestyle": "none", "zorder": 5}
_BEST_LOOK: dict[str, Any] = {"color": style.COLOURS[1], "marker": "*", "markersize": 8, "linestyle": "none", "zorder": 6}
_FRONT_LOOK: dict[str, Any] = {"color": style.COLOURS[1], "marker": "o", "markersize": 4.5, "zorder": 4, "clip_on": False}

_MOST_NAMED = 8
"""Designs that none is better than, with their names beside them."""

_Axis = tuple[str, np.ndarray, np.ndarray]
"""Label of an axis, and values and scatter [design] in its unit."""


def draw_designs(search: xr.Dataset) -> Figure:
    """Best value of each objective over the number of designs; objectives against each other, a single one over the rounds."""
    objectives = [_objective(search, name) for name in search["objective"].values]
    rounds = "round, 0 the first designs", search["round"].values.astype(float), np.full(search.sizes["design"], np.nan)
    pairs = list(combinations(objectives, 2)) or [(rounds, objectives[0])]
    columns = 1 if len(pairs) <= 3 else 2
    rows = -(-len(pairs) // columns)
    heights = max(1.7 * len(objectives), (3.2 if len(pairs) == 1 else 2.4) * rows)
    figure = plt.figure(figsize=(style.PAGE, heights + 0.6))
    left, right = figure.subfigures(1, 2, width_ratios=[1.0, 1.15 if columns == 1 else 1.7], squeeze=False)[0]
    panels_of_best = left.subplots(len(objectives), squeeze=False).flat
    for axes, objective, colour in zip(panels_of_best, objectives, cycle(style.COLOURS), strict=False):
        _draw_best(axes, search, objective, colour)
    axes.set_xlabel("designs tried; dotted: the first designs end")
    panels = list(right.subplots(rows, columns, squeeze=False).flat)
    for axes, pair in zip_longest(panels, pairs):
        if pair:
            _draw_pair(axes, search, pair, is_front=len(objectives) > 1, joined=len(pairs) == 1)
        else:
            axes.set_axis_off()
    if len(objectives) == 1:
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda round, _: START if round == -1 else f"{round:.0f}"))
    style.legend_below(figure, panels, 3)
    figure.suptitle(_title(search))
    return figure


def _objective(search: xr.Dataset, name: str) -> _Axis:
    objective_data = search.sel(objective=name)
    unit, factor = shown_unit(objective_data["objective_unit"].item())
    values, scatter = (factor * objective_data[f"objective_{part}"].values for part in ("value", "scatter"))
    return f"{name} ({unit})" if unit else str(name), values, scatter


def _title(search: xr.Dataset) -> str:
    """How many designs there are, and how many of them are of use."""
    designs = search.isel(design=slice(1, None))
    feasible, refused = int(designs["feasible"].sum()), int(np.sum(designs["refused"].values != ""))
    built = f", {refused} cannot be built" if refused else ""
    constraints = f", {feasible} keep all constraints" if search.sizes["constraint"] else ""
    return f"search: {designs.sizes['design']} designs{constraints}{built}"


def _draw_best(axes: Axes, search: xr.Dataset, objective: _Axis, colour: str) -> None:
    """Best feasible value so far over the number of designs, the start as a line, and where the first designs end."""
    label, values, _ = objective
    # the start is the first of all
    feasible = (search["feasible"].values == 1) & np.isfinite(values)
    best = np.minimum.accumulate(np.where(feasible, values, np.inf)[1:])
    best[np.isinf(best)] = np.nan
    last, level = best[-1], values[0]
    near: dict[str, Any] = {"transform": axes.get_yaxis_transform(), "va": "bottom", "ha": "right", "fontsize": 7}
    axes.plot(np.arange(1, len(values)), best, drawstyle="steps-post", color=colour)
    if np.isfinite(last):
        axes.text(1.0, last, f"{last:.4g}", color=colour, **near)
    else:
        why = "no design keeps all constraints" if search.sizes["constraint"] else "no design could be built"
        axes.set_title(why, fontsize=7)
    if np.isfinite(level):
        axes.axhline(level, color=_START_LOOK["color"], linewidth=0.9, linestyle="--")
        axes.text(1.0, level, f"start {level:.4g}", color=_START_LOOK["color"], **near)
    first = int(np.sum(search["round"].values == 0))
    if first < len(best):
        axes.axvline(first + 0.5, color="0.5", linewidth=0.8, linestyle=":")
    axes.set_xlim(0.0, len(values))
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(f"best {label}")
    axes.set_ylim(_limits(np.append(best, level)))


def _draw_pair(axes: Axes, search: xr.Dataset, pair: tuple[_Axis, _Axis], is_front: bool, joined: bool) -> None:
    """An objective against another, lower left is better, with the designs that none beats, or over rounds with the best."""
    (xlabel, x, width), (ylabel, y, height) = pair

    def points(chosen: np.ndarray, look: Mapping[str, Any], **more: Any) -> None:
        # without any neither mark nor legend, which an unclipped empty line would spoil
        chosen = chosen[np.isfinite(x[chosen]) & np.isfinite(y[chosen])]
        if chosen.size:
            axes.plot(x[chosen], y[chosen], **{**look, **more})

    bars = np.nan_to_num([width, height])
    there = np.flatnonzero(bars.any(0) & (np.arange(len(x)) > 0))
    if there.size:
        look: dict[str, Any] = {"linestyle": "none", "ecolor": "0.6", "elinewidth": 0.6, "zorder": 1}
        axes.errorbar(x[there], y[there], *bars[::-1, there], label="standard deviation by chance", **look)
    feasible = search["feasible"].values == 1
    keeps = "keeps all constraints" if search.sizes["constraint"] else "designs"
    dot: dict[str, Any] = {"marker": "o", "linestyle": "none", "markersize": 4, "clip_on": False}
    pale = {"color": "0.72", "markerfacecolor": "none", "markeredgewidth": 0.7, "zorder": 2, "label": "breaks a constraint"}
    points(np.flatnonzero(~feasible[1:]) + 1, dot, **pale)
    points(np.flatnonzero(feasible[1:]) + 1, dot, color=style.COLOURS[0], markeredgewidth=0.0, zorder=3, label=keeps)
    if is_front:
        front = np.flatnonzero(search["not_dominated"].values)
        order = front[np.lexsort((y[front], x[front]))]
        look = {"linestyle": "-" if joined else "none", "drawstyle": "steps-post", "label": "none is better in all objectives"}
        points(order, _FRONT_LOOK, **look)
        for index in order[order > 0] if len(order) <= _MOST_NAMED else ():
            name = str(search["design"].values[index])
            axes.annotate(name, (x[index], y[index]), (4, 3), textcoords="offset points", fontsize=6, color="0.2")
    else:
        points(np.flatnonzero(search["order"].values == 1), _BEST_LOOK, label="best")
    points(np.array([0]), _START_LOOK, label=START, clip_on=False)
    axes.set(xlabel=xlabel, ylabel=ylabel, xlim=_limits(x), ylim=_limits(y))


def _limits(values: np.ndarray) -> tuple[float, float]:
    """Limits of an axis on which all designs are seen, however far apart they are."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    room = 0.12 * (high - low) or 0.1 * abs(high) or 1.0
    return low - room, high + room
