"""Tolerances: the band that the members lie in, their chance of passing yield, and what their spread comes from."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from r37core.figures import style
from r37core.figures.danger_rows import LEGEND, LINE_LOOK, ROW_HEIGHT, draw_danger_rows
from r37core.results.columns import MOST_REVOLUTIONS
from r37core.results.danger import ratio_inside
from r37core.results.measures import leading_edge, ran
from r37core.time_integration.status import RunStatus

from .number_ranks import CONFIDENCE

_CHANCE = "probability_above_yield"
_MEASURES = {"peak_speed": "peak speed", "length_dangerous": "length of dangerous speeds", "largest_stress": "largest stress"}


def draw_tolerances(tolerances: xr.Dataset, nominal: xr.Dataset, title: str) -> Figure:
    """Band and median of rms and stress over speed with the nominal run, shares of the members, where the spread is from."""
    curves = [
        name for name in style.CURVES if f"{name}_quantile" in tolerances and tolerances[f"{name}_quantile"].notnull().any()
    ]
    chance = [_CHANCE] if _CHANCE in tolerances and tolerances[_CHANCE].notnull().any() else []
    is_ranked = bool(tolerances["rank_coefficient"].notnull().any())
    rows = len(curves) + len(chance)
    heights = [1.75 * rows + ROW_HEIGHT + 0.9, *[1.7] * is_ranked]
    figure = plt.figure(figsize=(style.PAGE, sum(heights)))
    above, *below = figure.subfigures(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0]
    ratios = [*[1.75] * rows, ROW_HEIGHT]
    *panels, row = above.subplots(rows + 1, 1, sharex=True, squeeze=False, height_ratios=ratios)[:, 0]
    for axes, name in zip(panels, curves, strict=False):
        _band(axes, tolerances, leading_edge(nominal), name)
    if chance:
        _shares(panels[-1], tolerances.dropna("speed", subset=[_CHANCE]))
    draw_danger_rows(row, {"nominal": ran(nominal)}, [style.COLOURS[1]])
    row.set_xlabel(style.SPEED_LABEL)
    style.rpm_axis(panels[0])
    if "max_von_mises_ever" in curves:
        style.yield_lines(
            panels[curves.index("max_von_mises_ever")], {"": float(tolerances["yield_stress"].median())}, named=True
        )
    style.legend_below(above, panels, 3, LEGEND)
    above.suptitle(f"tolerances: {title}, {tolerances.sizes['member']} members")
    for part in below:
        _numbers(part.subplots(1, 1), tolerances)
    return figure


def _band(axes: Axes, tolerances: xr.Dataset, nominal: xr.Dataset, name: str) -> None:
    label, scale = style.CURVES[name]
    spread = scale * tolerances[f"{name}_quantile"].dropna("speed", how="all")
    # a run that diverged has no number; the band leaves the panel
    shown = spread.where(np.isfinite(spread))
    low, median, high = (shown.isel(quantile=quantile) for quantile in range(3))
    speed, top = shown["speed"], float(shown.max()) * 1.5
    band = "nine tenths of the members"
    axes.fill_between(speed, low, high.fillna(top), color=style.COLOURS[0], alpha=0.25, linewidth=0, label=band)
    axes.plot(speed, median, color=style.COLOURS[0], label="median")
    if name in nominal:
        curve = nominal[name].sel(speed=slice(speed.min(), speed.max())).dropna("speed")
        axes.plot(curve["speed"], scale * curve, color=style.COLOURS[1], linewidth=0.8, linestyle="--", label="nominal")
    axes.set_ylabel(label)
    axes.set_ylim(0.0, None)


def _shares(axes: Axes, members: xr.Dataset) -> None:
    """Shares of the members that are dangerous, unknown and sustained over speed, each as a row of danger_rows has it."""
    speed = members["speed"]
    dangerous, low, high = (100.0 * members[f"{_CHANCE}{end}"] for end in ("", "_low", "_high"))
    unknown = 100.0 * (members["exit_revolution"].notnull() & ~(ratio_inside(members) > 1.0)).mean("member")
    above = members["share_of_revolutions_above_yield"].where(members["status"] != RunStatus.DIVERGED, 1.0)
    axes.fill_between(speed, 0.0, dangerous, color="0.25", linewidth=0)
    axes.fill_between(speed, dangerous, dangerous + unknown, **style.UNKNOWN)
    axes.plot(speed, 100.0 * (above > MOST_REVOLUTIONS).mean("member"), **LINE_LOOK)
    for end in (low, high):
        axes.plot(speed, end, ":", color=style.COLOURS[1], label=f"{CONFIDENCE:.0%} interval of the dangerous")
    axes.set(ylim=(0.0, 102.0), ylabel="members (%)")


def _numbers(axes: Axes, tolerances: xr.Dataset) -> None:
    """Rank coefficient of each number with its interval; pale: it may have any place in the ranking."""
    numbers = tolerances["number"].values
    width = 0.8 / len(_MEASURES)
    places_possible = tolerances["rank_place_high"] - tolerances["rank_place_low"] + 1
    known = places_possible < tolerances["rank_coefficient"].notnull().sum("number")
    for row, measure in enumerate(_MEASURES):
        places = np.arange(len(numbers)) + (row - 0.5 * (len(_MEASURES) - 1)) * width
        bottom, value, top = (tolerances[f"rank_coefficient{end}"].sel(measure=measure).values for end in ("_low", "", "_high"))
        clear = known.sel(measure=measure).values
        look: dict[str, Any] = {"color": style.COLOURS[row], "error_kw": {"linewidth": 0.6, "ecolor": "0.3"}}
        for chosen, alpha in ((clear, 0.7), (~clear, 0.15)):
            ends = np.abs(np.array([bottom, top]) - value)[:, chosen]
            axes.bar(places[chosen], value[chosen], 0.9 * width, yerr=ends, alpha=alpha, **look)
    axes.set_ylabel("rank coefficient")
    axes.set_title(f"what each number moves, {CONFIDENCE:.0%} interval; pale: may have any place in the ranking")
    axes.axhline(0.0, color="0.3", linewidth=0.5)
    axes.set_xticks(np.arange(len(numbers)), [str(number).replace(".", "\n") for number in numbers], fontsize=6)
    # numbers whose indices are not known have their room, too
    axes.set_xlim(-0.5, len(numbers) - 0.5)
    # room for the legend
    bottom_end, top_end = axes.get_ylim()
    axes.set_ylim(bottom_end, top_end + 0.25 * (top_end - bottom_end))
    # not those of the bars: a measure may have none whose place is known
    named = [Patch(color=style.COLOURS[row], alpha=0.7, label=label) for row, label in enumerate(_MEASURES.values())]
    axes.legend(handles=named, loc="upper right", ncols=3)
