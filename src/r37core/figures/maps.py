"""Maps over speed: the spectrum against engine order, the wear against angle."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from r37core.rom.naming import NAMED_MODES

from . import style

_DECADES = 4.0


def draw_map(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """The map of wear or of spectra, whichever the dataset has."""
    return (draw_wear_map if "wear" in maps else draw_spectral_map)(maps, campbell, title)


def draw_spectral_map(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """Amplitudes, normal and tangential, over speed and engine order, with the named modes' frequencies as lines."""
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 3.8), sharex=True, sharey=True)
    figure.suptitle(f"spectrum: {title}")
    for axes, (name, direction) in zip(panels, (("amplitude", "normal"), ("amplitude_tangential", "tangential")), strict=True):
        _draw_spectrum(axes, maps[name].dropna("speed", how="all"), campbell, direction)
    panels[0].set_ylabel("engine order")
    return figure


def _draw_spectrum(axes: Axes, amplitude: xr.DataArray, campbell: xr.Dataset, direction: str) -> None:
    if not amplitude.sizes["speed"]:
        axes.text(0.5, 0.5, "every run diverged", ha="center", transform=axes.transAxes)
        return
    values = np.maximum(1e3 * amplitude.transpose("engine_order", "speed").values, 1e-12)
    top = max(float(np.nanmax(values)), 1e-11)
    picture = axes.pcolormesh(
        amplitude["speed"],
        amplitude["engine_order"],
        values,
        norm=LogNorm(top / 10**_DECADES, top),
        cmap="magma",
        rasterized=True,
    )
    axes.figure.colorbar(picture, ax=axes, location="bottom", aspect=35, label=f"amplitude, {direction}, leading edge (mm)")
    for mode in NAMED_MODES:
        frequency = campbell["frequency"].sel(mode=mode)
        speed = frequency["speed"].values[1:]
        order = 2.0 * np.pi * frequency.values[1:] / speed
        axes.plot(speed, order, color="white", linewidth=0.8, linestyle="--")
        axes.annotate(mode, (0.99, np.interp(amplitude["speed"].values[-1], speed, order)), color="white",
                      xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=8)  # fmt: skip
    axes.set(xlabel="speed (rad/s)")
    axes.set_ylim(0.0, float(amplitude["engine_order"].max()))
    axes.set_xlim(float(amplitude["speed"].min()), float(amplitude["speed"].max()))
    style.rpm_axis(axes)
    axes.grid(False)


def draw_wear_map(maps: xr.Dataset, campbell: xr.Dataset, title: str) -> Figure:
    """Wear over speed and angle of one blade and scene; ticks mark the crossings of 1B with engine orders."""
    wear = maps["wear"].dropna("speed", how="all")
    figure, axes = plt.subplots(figsize=(style.COLUMN * 1.4, 3.4))
    picture = axes.pcolormesh(
        wear["speed"], np.degrees(wear["angle"]), 1e3 * wear.transpose("angle", "speed").values, cmap="viridis", rasterized=True
    )
    figure.colorbar(picture, ax=axes, label="wear (mm)")
    low, high = axes.get_xlim()
    for order, speed in campbell["crossing_speed"].sel(mode="1B").to_series().dropna().items():
        if low <= speed <= high:
            axes.axvline(speed, color="white", linewidth=0.7, linestyle=":")
            axes.annotate(f"1B/{order}", (speed, 350.0), color="white", fontsize=7)
    axes.set(xlabel="speed (rad/s)", ylabel="angle round the casing (degrees)", title=f"wear: {title}")
    style.rpm_axis(axes)
    axes.grid(False)
    return figure
