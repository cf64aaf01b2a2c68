"""What an elastic casing does over speed: its waves by nodal diameter, and its energy."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from . import style
from .cells import draw_cells


def draw_casing_map(maps: xr.Dataset, title: str) -> Figure:
    """Level of forward and backward waves over speed and nodal diameter, below it the casing's energy.

    In decibels below the largest level of the whole map.
    """
    # neither speeds that diverged, nor modes of other scenes or too fast for the samples
    maps = maps.dropna("speed", how="all", subset=["casing_energy"])
    maps = maps.dropna("casing_mode", how="all", subset=["casing_energy"])
    figure, panels = plt.subplots(2, 2, figsize=(style.PAGE, 4.4), sharex=True, height_ratios=[3.0, 1.0])
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
        of_diameter = np.array([np.sqrt(np.sum(level[diameters == diameter] ** 2, axis=0)) for diameter in every])
        decibels = 20.0 * np.log10(np.maximum(of_diameter / largest, 1e-30))
        decibels[~np.isin(every, diameters)] = np.nan
        picture = draw_cells(axes, speed, every, decibels, vmin=-60.0, vmax=0.0, cmap="magma")
        axes.set_title(f"{wave}: {'with' if wave == 'forward' else 'against'} the rotor")
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(False)
    panels[0, 0].set_ylabel("nodal diameters")
    figure.colorbar(picture, ax=panels[0], label=f"rms (dB below {1e3 * largest:.3g} mm)")
    energy = maps["casing_energy"].transpose("casing_mode", "speed").values.sum(axis=0)
    look = "." if len(speed) == 1 else "-"
    panels[1, 0].semilogy(speed, np.maximum(energy, 1e-15), look)
    panels[1, 0].set(xlabel="speed (rad/s)", ylabel="energy (J)")
    total = 1e3 * np.sqrt(sum(np.sum(level**2, axis=0) for level in levels.values()))
    panels[1, 1].semilogy(speed, np.maximum(total, 1e-12), look)
    panels[1, 1].set(xlabel="speed (rad/s)", ylabel="rms (mm)")
    return figure
