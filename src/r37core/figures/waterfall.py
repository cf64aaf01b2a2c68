"""Waterfall: spectra over frequency, one above the other by speed."""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.rom.naming import NAMED_MODES

from . import style
from .maps import DIRECTIONS, largest_of_bins

_LINES = 24
_MOST_BINS = 250
_DECIBELS = 60.0
_HEIGHT = 2.5
"""Height of the largest amplitude, in distances between lines."""


def draw_waterfall(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """Spectra of one blade and scene, normal and tangential, with engine orders and the frequencies of the named modes.

    All lines have one scale, in decibels below the largest amplitude of either direction; one hides what is behind it.
    """
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 5.0), sharex=True, sharey=True)
    figure.suptitle(f"waterfall: {title}")
    highest = 1.15 * float(campbell["frequency"].sel(mode="2B").max())
    completed = maps[list(DIRECTIONS)].dropna("speed", how="all")
    top = max([1e-15, *(float(completed[name].max()) for name in DIRECTIONS if completed.sizes["speed"])])
    rows = thinned(completed["speed"].values, completed.to_dataarray().max(("variable", "engine_order")).values)
    for axes, (name, direction) in zip(panels, DIRECTIONS.items(), strict=True):
        if rows:
            _draw(axes, completed[name], rows, campbell, highest, top)
        else:
            style.say(axes, style.ALL_DIVERGED)
        axes.set(xlabel="frequency (Hz)", xlim=(0.0, highest))
        axes.set_title(f"leading edge, {direction}", pad=14)
        axes.grid(False)
    panels[0].set_ylabel(style.SPEED_LABEL)
    style.rpm_axis_beside(panels[1])
    return figure


def _draw(axes: Axes, amplitude: xr.DataArray, rows: list[int], campbell: xr.Dataset, highest: float, top: float) -> None:
    speeds = amplitude["speed"].values
    values = amplitude.transpose("speed", "engine_order").values
    low, high = float(speeds[0]), float(speeds[-1])
    largest_height = _HEIGHT * (max(high - low, 1.0) / _LINES)
    order, coarse = largest_of_bins(amplitude["engine_order"].values, values[rows], _MOST_BINS)
    for line_number, row in enumerate(rows):
        speed = speeds[row]
        height = np.clip(20.0 * np.log10(np.maximum(coarse[line_number], 1e-30) / top) / _DECIBELS + 1.0, 0.0, None)
        frequency = order * speed / (2.0 * np.pi)
        shown = frequency <= highest
        line = speed + largest_height * height[shown]
        # the lowest speed is in front
        front = 2.0 - 1e-3 * line_number
        axes.fill_between(frequency[shown], speed, line, facecolor="white", linewidth=0.0, zorder=front)
        axes.plot(frequency[shown], line, color="0.15", linewidth=0.5, zorder=front + 5e-4)
    _draw_orders(axes, float(order[-1]), low, high, highest)
    for mode in NAMED_MODES:
        colour = style.mode_colour(campbell, mode)
        frequency = campbell["frequency"].sel(mode=mode)
        axes.plot(frequency, frequency["speed"], color=colour, linestyle="--", linewidth=0.9, zorder=4)
        x = float(np.interp(high, frequency["speed"].values, frequency.values))
        axes.annotate(mode, (x, 1.0), xycoords=("data", "axes fraction"), color=colour, fontsize=7, ha="center")
    axes.set_ylim(low, high + largest_height)
    # how high the largest amplitude stands, at the lower right, where orders end
    x, y = 0.97 * highest, low + 0.4 * largest_height
    bar = {"arrowstyle": "|-|", "mutation_scale": 2.0, "linewidth": 0.7}
    axes.annotate("", (x, y), (x, y + largest_height), arrowprops=bar, zorder=5)
    axes.annotate(f"{_DECIBELS:.0f} dB ", (x, y + 0.5 * largest_height), fontsize=6, ha="right", va="center", zorder=5)


def thinned(speeds: np.ndarray, largest: np.ndarray) -> list[int]:
    """Rows of at most _LINES + 1 speeds, ascending: those with the largest amplitudes that lie far enough apart."""
    apart = float(np.ptp(speeds)) / _LINES if len(speeds) else 0.0
    rows: list[int] = []
    for row in np.argsort(-largest, kind="stable"):
        if all(abs(speeds[row] - speeds[other]) >= apart for other in rows):
            rows.append(int(row))
    return sorted(rows)


def _draw_orders(axes: Axes, highest_order: float, low: float, high: float, highest: float) -> None:
    ends = np.array([low, high])
    for order in range(1, int(highest_order) + 1):
        axes.plot(order * ends / (2 * np.pi), ends, color="0.6", linewidth=0.4, linestyle=":", zorder=4)
        end = min(high, 2.0 * np.pi * highest / order)
        if end > low:
            end_point = (order * end / (2 * np.pi), end)
            clear = {"facecolor": "white", "alpha": 0.8, "linewidth": 0.0, "pad": 0.3}
            axes.annotate(str(order), end_point, fontsize=6, color="0.3", ha="right", zorder=5, bbox=clear)
