"""Maps over speed: the spectrum against engine order, the wear against angle, an elastic casing's waves."""

from typing import Any, cast

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.ticker import MaxNLocator
from numpy import ndarray
from xarray import DataArray, Dataset

from r37core.rom.naming import NAMED_MODES

from . import style

_MOST_BINS = 400
DIRECTIONS = {"amplitude": "normal", "amplitude_tangential": "tangential"}


def draw_spectral_map(maps: Dataset, campbell: Dataset, title: str) -> Figure:
    """Amplitudes, normal and tangential, over speed and engine order, with the named modes' frequencies as lines.

    In decibels below the largest amplitude at the same speed, so that what is not resonant is seen, too; that largest amplitude
    (mm) stands above the map. Order 0, the mean, does not count.
    """
    figure, grid = style.panels(2, 2, 4.4, sharex=True, sharey="row", height_ratios=[1.0, 4.0])
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


def _draw_spectrum(strip: Axes, axes: Axes, amplitude: DataArray, campbell: Dataset) -> AxesImage | None:
    if not amplitude.sizes["speed"]:
        style.say(axes, style.ALL_DIVERGED)
        strip.set_axis_off()
        return None
    speed = amplitude["speed"].values
    millimetres = 1e3 * amplitude.transpose("speed", "engine_order").values
    orders = amplitude["engine_order"].values
    # the largest value of each of not too many bins of orders
    width = -(-len(orders) // _MOST_BINS)
    whole = len(orders) // width * width
    order = orders[:whole].reshape(-1, width).mean(axis=1)
    values = millimetres[:, :whole].reshape(len(speed), -1, width).max(axis=2)
    largest = np.maximum(values[:, 1:].max(axis=1), 1e-12)
    strip.semilogy(speed, largest, linewidth=0.8)
    style.rpm_axis(strip, most_ticks=6)
    picture = _draw_decibels(axes, speed, order, (values / largest[:, None]).T)
    for mode in NAMED_MODES:
        frequency = campbell["frequency"].sel(mode=mode)
        turning = frequency["speed"].values[1:]
        order_of_mode = 2.0 * np.pi * frequency.values[1:] / turning
        axes.plot(turning, order_of_mode, color="white", linewidth=0.6, alpha=0.7, dashes=(3.0, 5.0))
        _write_on_dark(axes, mode, 0.99, float(np.interp(speed[-1], turning, order_of_mode)), ha="right", va="bottom")
    axes.set(xlabel=style.SPEED_LABEL, xlim=(float(speed[0]), float(speed[-1])), ylim=(0.0, round(float(order[-1]))))
    return picture


def _draw_decibels(axes: Axes, across: ndarray, upward: ndarray, shares: ndarray) -> AxesImage:
    """Cells as of draw_cells over whole numbers upward, coloured by the decibels of `shares` of the largest value."""
    decibels = 20.0 * np.log10(np.maximum(shares, 1e-30))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.grid(False)
    return draw_cells(axes, across, upward, decibels, vmin=-60.0, vmax=0.0, cmap="magma")


def _write_on_dark(axes: Axes, text: str, share: float, height: float, **where: Any) -> None:
    """White letters that a bright cell below them does not swallow; at a share of the panel's width."""
    shade = {"facecolor": "black", "alpha": 0.5, "linewidth": 0.0, "pad": 0.8}
    axes.text(share, height, text, color="white", fontsize=7, transform=axes.get_yaxis_transform(), bbox=shade, **where)


def draw_wear_map(maps: Dataset, campbell: Dataset, title: str) -> Figure:
    """Wear over speed and angle of one blade and scene, with the crossings of 1B, and speeds at which it is worn through."""
    wear = maps["wear"].dropna("speed", how="all")
    figure, axes = plt.subplots(figsize=(style.COLUMN * 1.4, 3.4))
    if wear.sizes["speed"]:
        degrees, millimetres = np.degrees(wear["angle"].values), 1e3 * wear.transpose("angle", "speed").values
        picture = draw_cells(axes, wear["speed"].values, degrees, millimetres, cmap="viridis")
        figure.colorbar(picture, ax=axes, label="wear (mm)")
        low, high = axes.get_xlim()
        for order, speed in style.crossings_seen(axes, campbell):
            axes.axvline(speed, color="white", linewidth=0.7, linestyle=":")
            _write_on_dark(axes, f"1B/{order}", (speed - low) / (high - low), 352.0, ha="left", va="top")
        # where some of the lining is worn through
        worn = maps["speed"].values[maps["worn_through_share"].values > 0.0]
        style.mark_above(axes, worn, "v", color="white", markeredgecolor="black", markersize=5, markeredgewidth=0.5)
    else:
        style.say(axes, style.ALL_DIVERGED)
    axes.set(xlabel=style.SPEED_LABEL, ylabel="angle round the casing (degrees)", title=f"wear: {title}")
    style.rpm_axis(axes)
    axes.grid(False)
    return figure


def draw_cells(axes: Axes, across: ndarray, upward: ndarray, values: ndarray, **look: Any) -> AxesImage:
    """Cells about ascending middles `across` and `upward`, coloured by `values`, shape (upward, across); NaN stays empty.

    `look`: what Axes.pcolorfast takes for colours.
    """
    # middles that are not evenly spaced give an AxesImage, too
    return cast(AxesImage, axes.pcolorfast(_edges(across), _edges(upward), values, **look))


def _edges(middles: ndarray) -> ndarray:
    """Edges of cells about ascending middles, half-way between them; a single one has a cell of length 1."""
    middles = np.asarray(middles, dtype=float)
    if len(middles) == 1:
        return middles[0] + np.array([-0.5, 0.5])
    between = 0.5 * (middles[1:] + middles[:-1])
    return np.concatenate([[2.0 * middles[0] - between[0]], between, [2.0 * middles[-1] - between[-1]]])


def draw_casing_map(maps: Dataset, title: str) -> Figure:
    """Level of forward and backward waves over speed and nodal diameter, below it the casing's energy.

    In decibels below the largest level of the whole map.
    """
    # neither speeds that diverged, nor modes of other scenes or too fast for the samples
    maps = maps.dropna("speed", how="all", subset=["casing_energy"])
    maps = maps.dropna("casing_mode", how="all", subset=["casing_energy"])
    figure, panels = style.panels(2, 2, 4.4, sharex=True, height_ratios=[3.0, 1.0])
    figure.suptitle(f"waves round the casing: {title}")
    speed, diameters = maps["speed"].values, maps["casing_nodal_diameter"].values
    levels = {wave: maps[f"casing_rms_{wave}"].transpose("casing_mode", "speed").values for wave in ("forward", "backward")}
    largest = max((float(level.max()) for level in levels.values() if level.size), default=0.0)
    if not largest > 0.0:
        style.say(panels[0, 0], "the casing is at rest" if len(speed) else style.ALL_DIVERGED)
        return figure
    every = np.arange(diameters.min(), diameters.max() + 1.0)
    for axes, (wave, level) in zip(panels[0], levels.items(), strict=True):
        # several modes of one nodal diameter add up; without any the row stays empty
        diameter_levels = np.array([np.sqrt(np.sum(level[diameters == diameter] ** 2, axis=0)) for diameter in every])
        diameter_levels[~np.isin(every, diameters)] = np.nan
        picture = _draw_decibels(axes, speed, every, diameter_levels / largest)
        axes.set_title(f"{wave}: {'with' if wave == 'forward' else 'against'} the rotor")
    panels[0, 0].set_ylabel("nodal diameters")
    figure.colorbar(picture, ax=panels[0], label=f"rms (dB below {1e3 * largest:.3g} mm)")
    energy = maps["casing_energy"].transpose("casing_mode", "speed").values.sum(axis=0)
    look = "." if len(speed) == 1 else "-"
    panels[1, 0].semilogy(speed, np.maximum(energy, 1e-15), look)
    panels[1, 0].set(xlabel=style.SPEED_LABEL, ylabel="energy (J)")
    total = 1e3 * np.sqrt(sum(np.sum(level**2, axis=0) for level in levels.values()))
    panels[1, 1].semilogy(speed, np.maximum(total, 1e-12), look)
    panels[1, 1].set(xlabel=style.SPEED_LABEL, ylabel="rms (mm)")
    return figure
