"""Response of the readings about the four interactions, and of direct contact over the whole range."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib.pyplot as plt
import xarray as xr
from matplotlib.figure import Figure

from r37core.studies.reading_list import LINED, RIGID
from r37core.studies.readings import WINDOWS
from r37core.studies.validation import DIRECT_PEAK, PEAKS

from . import style  # noqa: F401  (sets the style)

_SHOWN_LINED = ("benchmark", "vector", "against", "against_shared", "shared", "camber")
_SHOWN_RIGID = ("benchmark", "vector", "against", "against_vector")


def draw_readings(lined: Mapping[str, xr.Dataset], rigid: Mapping[str, xr.Dataset]) -> Figure:
    """Radial rms of the leading edge; dotted: the published peaks."""
    figure = plt.figure(figsize=(11.0, 7.2))
    grid = figure.add_gridspec(2, len(WINDOWS))
    for column, order in enumerate(sorted(WINDOWS, reverse=True)):
        axes = figure.add_subplot(grid[0, column])
        for name in _SHOWN_LINED:
            run = lined[name].sel(speed=slice(*WINDOWS[order]))
            line = 1.8 if name == "benchmark" else 0.9
            axes.plot(run["speed"], 1e3 * run["rms_radial"], linewidth=line, label=LINED[name].what)
        axes.axvline(PEAKS[order], color="0.4", linestyle=":")
        axes.set_title(f"abradable, 1B/{order}", fontsize=9)
        if column == 0:
            axes.set_ylabel("rms, radial (mm)")
            figure.legend(loc="outside upper center", ncols=2, fontsize=8)
    axes = figure.add_subplot(grid[1, :])
    for name in _SHOWN_RIGID:
        run = rigid[name]
        axes.plot(run["speed"], 1e3 * run["rms_radial"], linewidth=1.8 if name == "benchmark" else 0.9, label=RIGID[name].what)
    axes.axvline(DIRECT_PEAK, color="0.4", linestyle=":")
    axes.set(xlabel="speed (rad/s)", ylabel="rms, radial (mm)", title="direct contact")
    axes.legend(fontsize=7)
    return figure
