"""A whole rotor over speed: a map of its blades, the worst stress, growth, and nodal diameters.

Motion is the leading edge's displacement, normal and tangential together.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.figures.danger_rows import LEGEND, draw_danger_rows
from r37core.figures.maps import draw_cells
from r37core.time_integration.status import RunStatus

from .dataset import blades_above_yield, worst_place

_MOTION = "rms of the motion (mm)"
_DECADES = 3.0
_NAMED = 3


def draw_rotor(rotor: xr.Dataset, title: str) -> Figure:
    """Four panels of one blade shape in one scene, and above all a row of its dangerous speeds: see the captions."""
    figure = plt.figure(figsize=(style.PAGE, 5.8))
    above, below = figure.subfigures(2, 1, squeeze=False, height_ratios=[1.2, 4.6])[:, 0]
    row, panels = above.subplots(), below.subplots(2, 2)
    draw_danger_rows(row, {"rotor": rotor}, ["C0"])
    row.set_xlabel(style.SPEED_LABEL)
    style.legend_below(above, (), 3, LEGEND)
    figure.suptitle(f"{title}: a rotor of {rotor.sizes['blade_number']} blades")
    _draw_map(panels[0, 0], rotor)
    _draw_worst(panels[0, 1], rotor)
    worst = rotor.isel(speed=worst_place(rotor, "blade_rms"))
    # largest displacement of every blade in each span of revolutions, the largest by name
    growth, axes = 1e3 * worst["blade_maximum"].transpose("span", "blade_number").values, panels[1, 0]
    order = np.argsort(-np.nan_to_num(worst["blade_rms"].values), kind="stable")
    axes.plot(worst["span"], growth[:, order[_NAMED:]], color="0.75", linewidth=0.6)
    for row in order[:_NAMED]:
        axes.plot(worst["span"], growth[:, row], label=f"blade {int(worst['blade_number'][row])}")
    axes.set(xlabel=f"revolution at {float(worst['speed']):g} rad/s", ylabel="largest displacement (mm)")
    axes.legend(fontsize=6)
    panels[1, 1].bar(worst["nodal_diameter"], 100.0 * worst["nodal_diameter_share"].fillna(0.0), width=0.8)
    panels[1, 1].set(xlabel=f"nodal diameters at {float(worst['speed']):g} rad/s", ylabel="share of the motion (%)")
    return figure


def _draw_map(axes: Axes, rotor: xr.Dataset) -> None:
    """Motion of every blade over speed; red crosses: the blade that diverged first."""
    values = 1e3 * rotor["blade_rms"].transpose("blade_number", "speed").values
    speeds, diverged = rotor["speed"].values, rotor["status"].values == RunStatus.DIVERGED
    top = max(float(np.nan_to_num(values).max()), 1e-12)
    alone = len(speeds) < 2 or len(values) < 2
    if alone:
        axes.plot(speeds, values.T, ".-")
        axes.set_ylabel(_MOTION)
    else:
        norm = LogNorm(top / 10**_DECADES, top, clip=True)
        numbers = rotor["blade_number"].values.astype(float)
        picture = draw_cells(axes, speeds, numbers, np.maximum(values, 1e-30), norm=norm, cmap="magma")
        axes.figure.colorbar(picture, ax=axes, label=_MOTION)
        axes.set_ylabel("blade")
        axes.grid(False)
    if diverged.any():
        places = np.zeros(len(speeds)) if alone else rotor["leader"].values
        axes.plot(speeds[diverged], places[diverged], "rx", label="diverged")
        axes.legend(loc="upper left", fontsize=6)
    axes.set_xlabel(style.SPEED_LABEL)


def _draw_worst(axes: Axes, rotor: xr.Dataset) -> None:
    """Band of the stress of the worst blade, stress of the median one, and how many blades are above yield at once."""
    speeds, number = rotor["speed"].values, rotor.sizes["blade_number"]
    axes.set_xlabel(style.SPEED_LABEL)
    if "blade_max_von_mises_ever" not in rotor:
        axes.plot(speeds, 1e3 * rotor["blade_rms"].max("blade_number"), ".-", markersize=3)
        axes.set_ylabel(f"largest {_MOTION}")
        return
    style.stress_band(axes, speeds, rotor, "worst blade")
    median = 1e-9 * rotor["blade_max_von_mises_ever"].median("blade_number")
    axes.plot(speeds, median, "-", color="0.5", label="median blade, all revolutions")
    style.yield_lines(axes, {"": rotor["yield_stress"].item()}, named=True, linear=style.is_linear(rotor))
    axes.set_ylabel(style.stress_label(rotor))
    lost = int(np.sum(rotor["status"].values == RunStatus.DIVERGED))
    diverged = f"\n{lost} of {len(speeds)} speeds diverged" if lost else ""
    above = f"at most {blades_above_yield(rotor)} of {number} blades above yield in most revolutions"
    axes.set_title(f"{above}{diverged}", fontsize=7)
    axes.legend(loc="upper left", fontsize=6)
