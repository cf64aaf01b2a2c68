"""Tolerances: the band that the members lie in, their chance of passing yield, and what their spread comes from."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.results.measures import leading_edge

from . import style

_CHANCE = "probability_above_yield"
_MEASURES = {"peak_speed": "peak speed", "width_above_yield": "width above yield", "largest_stress": "largest stress"}


def draw_tolerances(tolerances: xr.Dataset, nominal: xr.Dataset, title: str) -> Figure:
    """Band and median of rms and stress over speed with the nominal run, probability of passing yield, Sobol indices."""
    curves = [
        name for name in style.CURVES if f"{name}_quantile" in tolerances and tolerances[f"{name}_quantile"].notnull().any()
    ]
    chance = [_CHANCE] if _CHANCE in tolerances and tolerances[_CHANCE].notnull().any() else []
    indices = "sobol_total" in tolerances and bool(tolerances["sobol_total"].notnull().any())
    rows = len(curves) + len(chance)
    heights = [1.75 * rows + 0.6, *([1.7] if indices else [])]
    figure = plt.figure(figsize=(style.PAGE, sum(heights)))
    above, *below = figure.subfigures(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0]
    panels = above.subplots(rows, 1, sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(panels, curves, strict=False):
        _band(axes, tolerances, leading_edge(nominal), name)
    if chance:
        _probability(panels[-1], tolerances)
    panels[-1].set_xlabel("speed (rad/s)")
    style.rpm_axis(panels[0])
    if "max_von_mises" in curves:
        style.yield_lines(panels[curves.index("max_von_mises")], {"": float(tolerances["yield_stress"].median())}, named=True)
    above.legend(*style.legend_entries(panels), loc="outside lower center", ncols=5)
    above.suptitle(f"tolerances: {title}, {tolerances.sizes['member']} members")
    for part in below:
        _indices(part.subplots(1, 1), tolerances)
    return figure


def _band(axes: Axes, tolerances: xr.Dataset, nominal: xr.Dataset, name: str) -> None:
    label, scale = style.CURVES[name]
    spread = scale * tolerances[f"{name}_quantile"].dropna("speed", how="all")
    # of a run that diverged there is no number; the band leaves the panel
    shown = spread.where(np.isfinite(spread))
    low, median, high = (shown.isel(quantile=place) for place in range(3))
    speed, top = shown["speed"], float(shown.max()) * 1.5
    axes.fill_between(
        speed, low, high.fillna(top), color=style.COLOURS[0], alpha=0.25, linewidth=0, label="nine tenths of the members"
    )
    axes.plot(speed, median, color=style.COLOURS[0], label="median")
    if name in nominal:
        at = nominal[name].sel(speed=slice(speed.min(), speed.max())).dropna("speed")
        axes.plot(at["speed"], scale * at, color=style.COLOURS[1], linewidth=0.8, linestyle="--", label="nominal")
    axes.set_ylabel(label)
    axes.set_ylim(0.0, None)


def _probability(axes: Axes, tolerances: xr.Dataset) -> None:
    chance = tolerances[_CHANCE].dropna("speed")
    axes.fill_between(chance["speed"], 100.0 * chance, color=style.COLOURS[1], alpha=0.4, linewidth=0)
    axes.plot(chance["speed"], 100.0 * chance, color=style.COLOURS[1])
    axes.axhline(50.0, color="0.5", linewidth=0.6, linestyle=":")
    axes.set_ylim(0.0, 102.0)
    axes.set_ylabel("members above yield (%)")


def _indices(axes: Axes, tolerances: xr.Dataset) -> None:
    """Bars of the total index, with the first-order one as a dot in them."""
    numbers = tolerances["number"].values
    width = 0.8 / len(_MEASURES)
    for place, (measure, label) in enumerate(_MEASURES.items()):
        at = np.arange(len(numbers)) + (place - 0.5 * (len(_MEASURES) - 1)) * width
        of = tolerances.sel(measure=measure)
        total = of["sobol_total"].values
        ends = np.abs(np.array([of["sobol_total_low"].values, of["sobol_total_high"].values]) - total)
        look: dict[str, Any] = {"color": style.COLOURS[place], "alpha": 0.7}
        axes.bar(at, total, 0.9 * width, label=label, yerr=ends, error_kw={"linewidth": 0.6, "ecolor": "0.3"}, **look)
        axes.plot(at, of["sobol_first"].values, "k_", markersize=6)
    axes.set_xticks(np.arange(len(numbers)), [str(number).replace(".", "\n") for number in numbers], fontsize=6)
    # numbers whose indices are not known have their room, too
    axes.set_xlim(-0.5, len(numbers) - 0.5)
    # room for the legend
    axes.set_ylim(0.0, 1.25 * axes.get_ylim()[1])
    axes.set_ylabel("Sobol index")
    axes.set_title("share of the variance: total (bar, with nine tenths of bootstrap samples), alone (dash)")
    axes.legend(loc="upper right", ncols=3)
