"""Figures of the presets."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from r37core.figures import style

from .case import LEVEL
from .tradeoff_tables import QUANTITIES, costs_of

_FLOOR = 1e-7
"""Smallest error that is drawn: the reference has none."""


def draw_parameter(table: pd.DataFrame, parameter: str) -> Figure:
    """Errors at the peak and the CPU time per run over one parameter's values, one column per scene."""
    varied = table[table["parameter"] == parameter]
    scenes = list(varied["scene"].unique())
    size = (0.5 * style.PAGE * len(scenes), 4.0)
    figure, panels = plt.subplots(2, len(scenes), figsize=size, sharex=True, sharey="row", squeeze=False)
    for scene, errors, costs in zip(scenes, *panels, strict=True):
        cases = varied[varied["scene"] == scene]
        labels = [str(value) for value in cases["value"]]
        for name in QUANTITIES:
            error = cases[f"error_{name}"].to_numpy(float)
            if np.any(np.isfinite(error)):
                errors.plot(labels, np.maximum(error, _FLOOR), "o-", label=name.replace("_", " "))
        errors.set(yscale="log", title=scene)
        costs.plot(labels, cases["cpu_s"], "s-", color="0.3")
        costs.set(yscale="log", xlabel=parameter.replace("_", " "))
        costs.tick_params(axis="x", rotation=30)
    panels[0, 0].set_ylabel("relative error at the peak")
    panels[1, 0].set_ylabel("CPU s per run")
    figure.legend(*style.legend_entries(panels[0]), loc="outside lower center", ncols=6)
    return figure


def draw_tradeoff(table: pd.DataFrame) -> Figure:
    """Error of the normal rms at the peak over CPU time per run, all parameters; levels stand out."""
    scenes = list(table["scene"].unique())
    size = (0.5 * style.PAGE * max(len(scenes), 2), 4.0)
    figure, panels = plt.subplots(1, len(scenes), figsize=size, sharey=True, squeeze=False)
    for axes, scene in zip(panels[0], scenes, strict=True):
        for number, (parameter, cases) in enumerate(table[table["scene"] == scene].groupby("parameter", sort=False)):
            error, is_level = np.maximum(cases["error_rms_normal"], _FLOOR), parameter == LEVEL
            marker = "*" if is_level else "osv^Dx+"[number % 7]
            label, markersize = str(parameter).replace("_", " "), 11 if is_level else 5
            axes.loglog(cases["cpu_s"], error, marker, label=label, markersize=markersize)
            for x, y, name in zip(cases["cpu_s"], error, cases["value"], strict=True) if is_level else ():
                if np.isfinite(x * y):
                    axes.annotate(str(name), (x, y), fontsize=7, xytext=(4, 4), textcoords="offset points")
        # names of levels stand to the right of their marks
        axes.margins(x=0.15)
        axes.set(xlabel="CPU s per run", title=scene)
    panels[0, 0].set_ylabel("relative error of the mean normal rms at the peak")
    figure.legend(*style.legend_entries(panels[0]), loc="outside lower center", ncols=5)
    return figure


def draw_growth(table: pd.DataFrame, growth: pd.DataFrame) -> Figure:
    """One panel per pair of parameter and cost, with the fitted power law."""
    columns = 3
    rows = max(1, -(-len(growth) // columns))
    figure, panels = plt.subplots(rows, columns, figsize=(style.PAGE, 2.2 * rows), squeeze=False)
    for axes, pair in zip(panels.ravel(), growth.itertuples(), strict=False):
        costs = costs_of(table, pair.parameter, pair.cost)
        values = costs.index.to_numpy()
        axes.loglog(values, costs, "o")
        axes.loglog(values, costs.iloc[-1] * (values / values[-1]) ** pair.exponent, "--", color="0.5")
        axes.set(title=f"{pair.of}: exponent {pair.exponent:.2f}")
        axes.set(xlabel=pair.parameter.replace("_", " "), ylabel=pair.cost.replace("_", " "))
    for axes in np.ravel(panels)[len(growth) :]:
        axes.set_visible(False)
    if growth.empty:
        figure.text(0.5, 0.5, "no parameter was varied over three values", ha="center")
    return figure


COLOURS = {"accurate": "#009E73", "degraded": "#E69F00", "diverged": "#D55E00", "refused": "0.7", "unsound": "#000000"}
"""Outcome -> colour."""


def draw_stability(table: pd.DataFrame) -> Figure:
    """The outcome of every value of every extreme, one panel per scene."""
    names, scenes = list(table["what"].unique()), list(table["scene"].unique())
    height = 0.8 + 0.26 * len(names)
    figure, panels = plt.subplots(1, len(scenes), figsize=(style.PAGE, height), sharey=True, squeeze=False)
    places = table.groupby(["scene", "what"]).cumcount()
    for axes, scene in zip(panels[0], scenes, strict=True):
        for outcome, colour in COLOURS.items():
            rows = table[(table["scene"] == scene) & (table["outcome"] == outcome)]
            heights = [names.index(name) for name in rows["what"]]
            axes.scatter(places[rows.index], heights, marker="s", s=70, color=colour, label=outcome)
            for x, y, value in zip(places[rows.index], heights, rows["value"], strict=True):
                axes.annotate(f"{value:g}", (x, y), xytext=(7, 0), textcoords="offset points", fontsize=5.5, va="center")
        axes.set(title=scene, xticks=[], xlim=(-0.5, places.max() + 1.0), ylim=(len(names) - 0.5, -0.5))
        axes.set_yticks(range(len(names)), [name.replace("_", " ") for name in names])
        axes.grid(False)
    figure.legend(*style.legend_entries(panels[0]), loc="outside lower center", ncols=len(COLOURS))
    return figure


def draw_estimate(table: pd.DataFrame) -> Figure:
    """A bar for each part of the cost, and one for all."""
    figure, axes = plt.subplots(figsize=(style.COLUMN, 1.8))
    bars = axes.barh(table["part"], table["core_hours"])
    axes.bar_label(bars, fmt="%.3g", fontsize=6, padding=2)
    axes.margins(x=0.2)
    axes.invert_yaxis()
    axes.set(xlabel="core hours", title=f"{table['simulations'].iloc[0]} simulations")
    return figure
