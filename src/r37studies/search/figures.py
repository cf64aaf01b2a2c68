"""A search: how good its designs became, and the objectives against each other."""

from collections.abc import Iterator
from itertools import combinations
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from r37core.base.units import shown_unit
from r37core.figures import style

from .problem import START

_START_LOOK: dict[str, Any] = {"color": "0.15", "marker": "s", "markersize": 5, "linestyle": "none", "zorder": 5}
_BEST_LOOK: dict[str, Any] = {"color": style.COLOURS[1], "marker": "*", "markersize": 8, "linestyle": "none", "zorder": 6}
_FRONT_LOOK: dict[str, Any] = {"color": style.COLOURS[1], "marker": "o", "markersize": 4.5, "zorder": 4, "clip_on": False}

_MOST_NAMED = 8
"""Designs that none is better than, with their names beside them."""


class _Objective(NamedTuple):
    """Drawn numbers of an objective: label of its axis, and values and scatter [design] in its shown unit."""

    label: str
    values: np.ndarray
    scatter: np.ndarray


def draw_designs(search: xr.Dataset) -> Figure:
    """Best value of each objective over the number of designs; objectives against each other, a single one over the rounds."""
    objectives = [_objective(search, name) for name in search["objective"].values]
    pairs = list(combinations(objectives, 2))
    columns = 1 if len(pairs) <= 3 else 2
    rows = -(-max(len(pairs), 1) // columns)
    heights = max(1.7 * len(objectives), (3.2 if len(pairs) <= 1 else 2.4) * rows)
    figure = plt.figure(figsize=(style.PAGE, heights + 0.6))
    left, right = figure.subfigures(1, 2, width_ratios=[1.0, 1.15 if columns == 1 else 1.7], squeeze=False)[0]
    panels_of_best = _panels(left, len(objectives), 1)
    for number, (axes, objective) in enumerate(zip(panels_of_best, objectives, strict=True)):
        _draw_best(axes, search, objective, style.COLOURS[number % len(style.COLOURS)])
    panels_of_best[-1].set_xlabel("designs tried; dotted: the first designs end")
    panels = _panels(right, rows, columns)
    if pairs:
        for axes, (across, up) in zip(panels, pairs, strict=False):
            _draw_pair(axes, search, across, up, joined=len(pairs) == 1)
    else:
        _draw_rounds(panels[0], search, objectives[0])
    for axes in panels[max(len(pairs), 1) :]:
        axes.set_axis_off()
    figure.legend(*style.legend_entries(panels), loc="outside lower center", ncols=3)
    figure.suptitle(_title(search))
    return figure


def _objective(search: xr.Dataset, name: str) -> _Objective:
    objective_data = search.sel(objective=name)
    unit, factor = shown_unit(objective_data["objective_unit"].item())
    values, scatter = (factor * objective_data[f"objective_{part}"].values for part in ("value", "scatter"))
    return _Objective(f"{name} ({unit})" if unit else str(name), values, scatter)


def _title(search: xr.Dataset) -> str:
    """How many designs there are, and how many of them are of use."""
    designs = search.isel(design=slice(1, None))
    feasible, refused = int(designs["feasible"].sum()), int(np.sum(designs["refused"].values != ""))
    built = f", {refused} cannot be built" if refused else ""
    constraints = f", {feasible} keep all constraints" if search.sizes["constraint"] else ""
    return f"search: {designs.sizes['design']} designs{constraints}{built}"


def _panels(figure: Any, rows: int, columns: int) -> list[Axes]:
    return list(figure.subplots(rows, columns, squeeze=False).flat)


def _draw_best(axes: Axes, search: xr.Dataset, objective: _Objective, colour: str) -> None:
    """Best feasible value so far over the number of designs, the start as a line, and where the first designs end."""
    # the start is the first of all
    values = np.where(search["feasible"].values == 1, objective.values, np.inf)[1:]
    best = np.minimum.accumulate(np.where(np.isnan(values), np.inf, values))
    numbers = np.arange(1, len(values) + 1)
    if np.isfinite(best).any():
        axes.plot(numbers, np.where(np.isfinite(best), best, np.nan), drawstyle="steps-post", color=colour)
        axes.plot(numbers[-1], best[-1], "o", color=colour, markersize=4, clip_on=False)
        near: dict[str, Any] = {"textcoords": "offset points", "ha": "right", "va": "bottom", "fontsize": 7}
        axes.annotate(f"{best[-1]:.4g}", (numbers[-1], best[-1]), (-3, 4), color=colour, **near)
    else:
        why = "no design keeps all constraints" if search.sizes["constraint"] else "no design could be built"
        axes.set_title(why, fontsize=7)
    level = objective.values[0]
    if np.isfinite(level):
        axes.axhline(level, color=_START_LOOK["color"], linewidth=0.9, linestyle="--")
        near = {"transform": axes.get_yaxis_transform(), "va": "bottom", "ha": "right", "fontsize": 7}
        axes.text(1.0, level, f"start {level:.4g}", color=_START_LOOK["color"], **near)
    first = int(np.sum(search["round"].values == 0))
    if first < len(values):
        axes.axvline(first + 0.5, color="0.5", linewidth=0.8, linestyle=":")
    axes.set_xlim(0.0, len(values) + 1.0)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(f"best {objective.label}")
    axes.set_ylim(_limits(np.append(best[np.isfinite(best)], level)))


def _draw_pair(axes: Axes, search: xr.Dataset, across: _Objective, up: _Objective, joined: bool) -> None:
    """An objective against another: lower left is better."""
    for kept, look in _kinds(search):
        _bars(axes, across, up, kept)
        _points(axes, across.values[kept], up.values[kept], **look)
    front = search["not_dominated"].values.astype(bool)
    order = np.flatnonzero(front)[np.lexsort((up.values[front], across.values[front]))]
    look = {**_FRONT_LOOK, "linestyle": "-" if joined else "none", "label": "none is better in all objectives"}
    _points(axes, across.values[order], up.values[order], drawstyle="steps-post", **look)
    if len(order) <= _MOST_NAMED:
        for index in order[order > 0]:
            at = across.values[index], up.values[index]
            axes.annotate(str(search["design"].values[index]), at, (4, 3), textcoords="offset points", fontsize=6, color="0.2")
    _points(axes, across.values[:1], up.values[:1], label=START, clip_on=False, **_START_LOOK)
    axes.set_xlabel(across.label)
    axes.set_ylabel(up.label)
    axes.set_xlim(_limits(across.values))
    axes.set_ylim(_limits(up.values))


def _draw_rounds(axes: Axes, search: xr.Dataset, objective: _Objective) -> None:
    """The single objective over the rounds, the start before the first."""
    rounds = search["round"].values
    for kept, look in _kinds(search):
        _bars(axes, _Objective("", rounds.astype(float), np.full(len(rounds), np.nan)), objective, kept)
        _points(axes, rounds[kept], objective.values[kept], **look)
    best = search["order"].values == 1
    _points(axes, rounds[best], objective.values[best], label="best", **_BEST_LOOK)
    _points(axes, rounds[:1], objective.values[:1], label=START, **_START_LOOK)
    axes.set_xlabel("round, 0 the first designs")
    axes.set_ylabel(objective.label)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda round, _: START if round == -1 else f"{round:.0f}"))
    axes.set_ylim(_limits(objective.values))


def _kinds(search: xr.Dataset) -> Iterator[tuple[np.ndarray, dict[str, Any]]]:
    """Which designs break a constraint, and which keep all of them, and how they are drawn; only what there is."""
    feasible = search["feasible"].values.astype(bool)
    common: dict[str, Any] = {"marker": "o", "linestyle": "none", "markersize": 4, "clip_on": False}
    breaks, keeps = "breaks a constraint", "keeps all constraints" if search.sizes.get("constraint", 1) else "designs"
    pale = {**common, "color": "0.72", "markerfacecolor": "none", "markeredgewidth": 0.7, "zorder": 2, "label": breaks}
    plain = {**common, "color": style.COLOURS[0], "markeredgewidth": 0.0, "zorder": 3, "label": keeps}
    tried = np.arange(len(feasible)) > 0
    for kept, look in ((tried & ~feasible, pale), (tried & feasible, plain)):
        if kept.any():
            yield kept, look


def _points(axes: Axes, x: np.ndarray, y: np.ndarray, **look: Any) -> None:
    """Designs whose numbers are known; without any neither mark nor legend, which an unclipped empty line would spoil."""
    known = np.isfinite(x) & np.isfinite(y)
    if known.any():
        axes.plot(x[known], y[known], **look)


def _bars(axes: Axes, across: _Objective, up: _Objective, kept: np.ndarray) -> None:
    """A standard deviation by chance either way, where it is known."""
    widths = [np.where(np.isfinite(of.scatter) & kept, of.scatter, 0.0) for of in (across, up)]
    there = kept & ((widths[0] > 0.0) | (widths[1] > 0.0))
    if there.any():
        width, height = (of[there] for of in widths)
        look: dict[str, Any] = {"linestyle": "none", "ecolor": "0.6", "elinewidth": 0.6, "zorder": 1}
        axes.errorbar(across.values[there], up.values[there], height, width, label="standard deviation by chance", **look)


def _limits(values: np.ndarray) -> tuple[float, float]:
    """Limits of an axis on which all designs are seen, however wide the band is."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    room = 0.12 * (high - low) or 0.1 * abs(high) or 1.0
    return low - room, high + room
