"""Waterfall: spectra over frequency, one above the other by speed."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.rom.naming import NAMED_MODES

from . import style

_LINES = 40
_PER_LINE = 250
_DECADES = 3.0
_HEIGHT = 6.0
"""Of the largest amplitude, in distances between lines."""


def draw_waterfall(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """Spectra of one blade and scene, normal and tangential, with engine orders and the frequencies of the named modes."""
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 4.6), sharex=True, sharey=True)
    figure.suptitle(f"waterfall: {title}")
    highest = 1.15 * float(campbell["frequency"].sel(mode="2B").max())
    for axes, (name, direction) in zip(panels, (("amplitude", "normal"), ("amplitude_tangential", "tangential")), strict=True):
        _draw(axes, maps[name].dropna("speed", how="all"), campbell, highest)
        axes.set(xlabel="frequency (Hz)", xlim=(0.0, highest))
        axes.set_title(f"leading edge, {direction}", pad=14)
        axes.grid(False)
    panels[0].set_ylabel("speed (rad/s)")
    style.rpm_axis_beside(panels[1])
    return figure


def _draw(axes: Axes, amplitude: xr.DataArray, campbell: xr.Dataset, highest: float) -> None:
    speeds = amplitude["speed"].values
    values = amplitude.transpose("speed", "engine_order").values
    if not speeds.size:
        return
    rows = thinned(speeds, values.max(axis=1))
    low, high = float(speeds[0]), float(speeds[-1])
    distance = max(high - low, 1.0) / _LINES
    top = max(float(values.max()), 1e-15)
    order, coarse = _largest_of_bins(amplitude["engine_order"].values, values[rows])
    for place in range(len(rows))[::-1]:
        speed = speeds[rows[place]]
        height = np.clip(np.log10(np.maximum(coarse[place], 1e-30) / top) / _DECADES + 1.0, 0.0, None)
        frequency = order * speed / (2.0 * np.pi)
        kept = frequency <= highest
        line = speed + _HEIGHT * distance * height[kept]
        axes.fill_between(frequency[kept], speed, line, facecolor="white", linewidth=0.0, zorder=2.0 - 1e-3 * place)
        axes.plot(frequency[kept], line, color=style.COLOURS[0], linewidth=0.5, zorder=2.0 - 1e-3 * place + 5e-4)
    _draw_orders(axes, float(order[-1]), low, high, highest)
    for mode in NAMED_MODES:
        frequency = campbell["frequency"].sel(mode=mode)
        axes.plot(frequency, frequency["speed"], color=style.COLOURS[1], linestyle="--", linewidth=0.8, zorder=4)
        x = float(np.interp(high, frequency["speed"].values, frequency.values))
        axes.annotate(mode, (x, 1.0), xycoords=("data", "axes fraction"), color=style.COLOURS[1], fontsize=7, ha="center")
    axes.set_ylim(low, high + _HEIGHT * distance)


def thinned(speeds: np.ndarray, largest: np.ndarray) -> list[int]:
    """Rows of at most _LINES speeds, ascending: of each stretch of speeds the one with the largest amplitude."""
    stretch = np.minimum(((speeds - speeds[0]) / max(float(np.ptp(speeds)), 1e-9) * _LINES).astype(int), _LINES - 1)
    rows = np.arange(len(speeds))
    return [int(rows[stretch == one][np.argmax(largest[stretch == one])]) for one in np.unique(stretch)]


def _largest_of_bins(order: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Middles of at most _PER_LINE bins of engine orders, and the largest value in each, shape (speeds, bins)."""
    width = -(-len(order) // _PER_LINE)
    whole = len(order) // width * width
    return order[:whole].reshape(-1, width).mean(axis=1), values[:, :whole].reshape(len(values), -1, width).max(axis=2)


def _draw_orders(axes: Axes, highest_order: float, low: float, high: float, highest: float) -> None:
    for order in range(1, int(highest_order) + 1):
        axes.plot(
            [order * low / (2 * np.pi), order * high / (2 * np.pi)],
            [low, high],
            color="0.6",
            linewidth=0.4,
            linestyle=":",
            zorder=4,
        )
        end = min(high, 2.0 * np.pi * highest / order)
        if end > low:
            axes.annotate(str(order), (order * end / (2 * np.pi), end), fontsize=6, color="0.4", ha="right", zorder=5)
