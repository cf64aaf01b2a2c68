"""Maps over speed: the spectrum against engine order, the wear against angle, an elastic casing's waves."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.ticker import MaxNLocator

from r37core.rom.naming import NAMED_MODES

from . import style
from .casing_map import draw_casing_map
from .cells import draw_cells, largest_of_bins

_MOST_BINS = 400
DIRECTIONS = {"amplitude": "normal", "amplitude_tangential": "tangential"}


def draw_map(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """The map of wear, of the casing's waves or of spectra, whichever the dataset has."""
    if "casing_energy" in maps:
        return draw_casing_map(maps, title)
    return (draw_wear_map if "wear" in maps else draw_spectral_map)(maps, campbell, title)


def draw_spectral_map(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """Amplitudes, normal and tangential, over speed and engine order, with the named modes' frequencies as lines.

    In decibels below the largest amplitude at the same speed, so that what is not resonant is seen, too; that largest amplitude
    (mm) stands above the map. Order 0, the mean, does not count.
    """
    figure, grid = plt.subplots(2, 2, figsize=(style.PAGE, 4.4), sharex=True, sharey="row", height_ratios=[1.0, 4.0])
    figure.suptitle(f"spectrum: {title}, leading edge")
    pictures = []
    for strip, axes, (name, direction) in zip(*grid, DIRECTIONS.items(), strict=True):
        pictures.append(_draw_spectrum(strip, axes, maps[name].dropna("speed", how="all"), campbell))
        strip.set_title(direction)
    grid[0, 0].set_ylabel("largest (mm)")
    grid[1, 0].set_ylabel("engine order")
    if picture := next(filter(None, pictures), None):
        label = "amplitude (dB below the largest at that speed)"
        figure.colorbar(picture, ax=grid[1], location="bottom", aspect=60, label=label)
    return figure


def _draw_spectrum(strip: Axes, axes: Axes, amplitude: xr.DataArray, campbell: xr.Dataset) -> AxesImage | None:
    if not amplitude.sizes["speed"]:
        style.say(axes, style.ALL_DIVERGED)
        strip.set_axis_off()
        return None
    speed = amplitude["speed"].values
    millimetres = 1e3 * amplitude.transpose("speed", "engine_order").values
    order, values = largest_of_bins(amplitude["engine_order"].values, millimetres, _MOST_BINS)
    largest = np.maximum(values[:, 1:].max(axis=1), 1e-12)
    decibels = 20.0 * np.log10(np.maximum(values / largest[:, None], 1e-30))
    strip.semilogy(speed, largest, linewidth=0.8)
    style.rpm_axis(strip, most_ticks=6)
    picture = draw_cells(axes, speed, order, decibels.T, vmin=-60.0, vmax=0.0, cmap="magma")
    for mode in NAMED_MODES:
        frequency = campbell["frequency"].sel(mode=mode)
        turning = frequency["speed"].values[1:]
        order_of_mode = 2.0 * np.pi * frequency.values[1:] / turning
        axes.plot(turning, order_of_mode, color="white", linewidth=0.6, alpha=0.7, dashes=(3.0, 5.0))
        _write_on_dark(axes, mode, 0.99, float(np.interp(speed[-1], turning, order_of_mode)), ha="right", va="bottom")
    axes.set(xlabel="speed (rad/s)", xlim=(float(speed[0]), float(speed[-1])), ylim=(0.0, round(float(order[-1]))))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.grid(False)
    return picture


def _write_on_dark(axes: Axes, text: str, share: float, height: float, **where: Any) -> None:
    """White letters that a bright cell below them does not swallow; at a share of the panel's width."""
    shade = {"facecolor": "black", "alpha": 0.5, "linewidth": 0.0, "pad": 0.8}
    axes.text(share, height, text, color="white", fontsize=7, transform=axes.get_yaxis_transform(), bbox=shade, **where)


def draw_wear_map(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """Wear over speed and angle of one blade and scene, with the crossings of 1B, and speeds at which it is worn through."""
    wear = maps["wear"].dropna("speed", how="all")
    figure, axes = plt.subplots(figsize=(style.COLUMN * 1.4, 3.4))
    if wear.sizes["speed"]:
        degrees, millimetres = np.degrees(wear["angle"].values), 1e3 * wear.transpose("angle", "speed").values
        picture = draw_cells(axes, wear["speed"].values, degrees, millimetres, cmap="viridis")
        figure.colorbar(picture, ax=axes, label="wear (mm)")
        low, high = axes.get_xlim()
        for order, speed in campbell["crossing_speed"].sel(mode="1B").to_series().dropna().items():
            if low <= speed <= high:
                axes.axvline(speed, color="white", linewidth=0.7, linestyle=":")
                _write_on_dark(axes, f"1B/{order}", (speed - low) / (high - low), 352.0, ha="left", va="top")
        # triangles at the upper edge, where some of the lining is worn through
        worn = maps["speed"].values[maps["worn_through_share"].values > 0.0]
        look: dict[str, Any] = {"color": "white", "markeredgecolor": "black", "markersize": 5, "markeredgewidth": 0.5}
        axes.plot(worn, np.full(len(worn), 0.97), "v", transform=axes.get_xaxis_transform(), **look)
    else:
        style.say(axes, style.ALL_DIVERGED)
    axes.set(xlabel="speed (rad/s)", ylabel="angle round the casing (degrees)", title=f"wear: {title}")
    style.rpm_axis(axes)
    axes.grid(False)
    return figure
