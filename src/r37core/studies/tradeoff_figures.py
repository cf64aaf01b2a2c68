"""What accuracy costs: error over the value of a parameter, and error over cost of all of them."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from r37core.figures import style  # noqa: F401  (sets the style)

from .case import QUANTITIES

_FLOOR = 1e-7


def draw_parameter(together: xr.Dataset, parameter: str) -> Figure:
    """Errors at the peak and the CPU time per run over one parameter's values, one column per scene."""
    rows = np.flatnonzero(together["parameter"].values == parameter)
    labels = [str(value) for value in together["value"].values[rows]]
    scenes = together["scene"].values
    figure, panels = plt.subplots(2, len(scenes), figsize=(4.6 * len(scenes), 5.2), sharex=True, sharey="row", squeeze=False)
    for column, scene in enumerate(scenes):
        cases = together.isel(case=rows).sel(scene=scene)
        for name in QUANTITIES:
            error = cases["error"].sel(at="peak", quantity=name).values
            if np.any(np.isfinite(error)):
                panels[0, column].plot(labels, np.maximum(error, _FLOOR), "o-", label=name.replace("_", " "))
        panels[0, column].set_yscale("log")
        panels[0, column].set_title(str(scene), fontsize=9)
        panels[1, column].plot(labels, cases["cpu_s"].values, "s-", color="0.3")
        panels[1, column].set_yscale("log")
        panels[1, column].set_xlabel(parameter.replace("_", " "))
        panels[1, column].tick_params(axis="x", rotation=30)
    panels[0, 0].set_ylabel("relative error of the mean at the peak")
    panels[1, 0].set_ylabel("CPU s per run")
    panels[0, 0].legend(fontsize=7)
    return figure


def draw_pareto(together: xr.Dataset) -> Figure:
    """Error of the normal rms at the peak over CPU time per run, all parameters; levels stand out."""
    scenes = together["scene"].values
    figure, panels = plt.subplots(1, len(scenes), figsize=(5.4 * len(scenes), 4.6), sharey=True, squeeze=False)
    parameters = list(dict.fromkeys(together["parameter"].values))
    for axes, scene in zip(panels[0], scenes, strict=True):
        for number, parameter in enumerate(parameters):
            cases = together.isel(case=np.flatnonzero(together["parameter"].values == parameter)).sel(scene=scene)
            error = np.maximum(cases["error"].sel(at="peak", quantity="rms_normal").values, _FLOOR)
            level = parameter == "level"
            marker = "*" if level else "osv^Dx+"[number % 7]
            axes.loglog(cases["cpu_s"].values, error, marker, label=parameter.replace("_", " "), markersize=11 if level else 5)
            if level:
                for x, y, name in zip(cases["cpu_s"].values, error, cases["value"].values, strict=True):
                    axes.annotate(str(name), (x, y), fontsize=7, xytext=(4, 4), textcoords="offset points")
        axes.set(xlabel="CPU s per run", title=str(scene))
    panels[0, 0].set_ylabel("relative error of the mean normal rms at the peak")
    panels[0, -1].legend(fontsize=7)
    return figure
