"""A whole rotor over speed: a map of its blades, the worst stress and who leads, growth, and nodal diameters."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.figures.cells import draw_cells

_DECADES = 3.0
_NAMED = 3


def draw_rotor(rotor: xr.Dataset, title: str) -> Figure:
    """Four panels of one blade shape in one scene: see the captions."""
    figure, panels = plt.subplots(2, 2, figsize=(style.PAGE, 4.6))
    figure.suptitle(f"{title}: a rotor of {rotor.sizes['blade_number']} blades")
    _draw_map(panels[0, 0], rotor)
    _draw_worst(panels[0, 1], rotor)
    worst = rotor.isel(speed=int(np.nan_to_num(rotor["blade_rms"].max("blade_number").values).argmax()))
    _draw_growth(panels[1, 0], worst)
    _draw_waves(panels[1, 1], worst)
    return figure


def _draw_map(axes: Axes, rotor: xr.Dataset) -> None:
    """rms of every blade over speed."""
    values = 1e3 * np.nan_to_num(rotor["blade_rms"].transpose("blade_number", "speed").values)
    speeds = rotor["speed"].values
    top = max(float(values.max()), 1e-12)
    if len(speeds) < 2 or len(values) < 2:
        axes.plot(speeds, values.T, ".-")
        axes.set_ylabel("rms, normal (mm)")
    else:
        norm = LogNorm(top / 10**_DECADES, top, clip=True)
        numbers = rotor["blade_number"].values.astype(float)
        picture = draw_cells(axes, speeds, numbers, np.maximum(values, 1e-30), norm=norm, cmap="magma")
        axes.figure.colorbar(picture, ax=axes, label="rms, normal (mm)")
        axes.set_ylabel("blade")
        axes.grid(False)
    axes.set_xlabel("speed (rad/s)")


def _draw_worst(axes: Axes, rotor: xr.Dataset) -> None:
    """Largest stress of any blade, coloured by how many are above yield; the median blade beside it."""
    speeds, number = rotor["speed"].values, rotor.sizes["blade_number"]
    axes.set_xlabel("speed (rad/s)")
    if "blade_max_von_mises" not in rotor:
        axes.plot(speeds, 1e3 * rotor["blade_rms"].max("blade_number"), ".-", markersize=3)
        axes.set_ylabel("rms, normal, largest (mm)")
        return
    stress = 1e-9 * rotor["blade_max_von_mises"]
    axes.plot(speeds, stress.max("blade_number"), ".-", markersize=3, label="worst blade")
    axes.plot(speeds, stress.median("blade_number"), "-", color="0.5", label="median blade")
    style.yield_lines(axes, {"": rotor["yield_stress"].item()}, named=True)
    axes.set_ylabel("largest von Mises (GPa)")
    most = int(np.round(number * float(rotor["blades_above_yield"].max())))
    axes.set_title(f"at most {most} of {number} blades above yield at one speed", fontsize=8)
    axes.legend(loc="upper left", fontsize=6)


def _draw_growth(axes: Axes, run: xr.Dataset) -> None:
    """Largest displacement of every blade in each span of revolutions, the largest by name."""
    growth = 1e3 * run["blade_maximum"]
    order = np.argsort(-np.nan_to_num(run["blade_rms"].values))
    for rank, row in enumerate(order[::-1]):
        named = len(order) - 1 - rank < min(_NAMED, len(order))
        look = {"linewidth": 1.2, "zorder": 3} if named else {"color": "0.75", "linewidth": 0.6, "zorder": 2}
        label = f"blade {int(run['blade_number'][row])}" if named else "_"
        axes.plot(run["span"], growth.isel(blade_number=int(row)), label=label, **look)
    axes.set_xlabel(f"revolution at {float(run['speed']):g} rad/s")
    axes.set_ylabel("largest normal displacement (mm)")
    axes.legend(fontsize=6)


def _draw_waves(axes: Axes, run: xr.Dataset) -> None:
    """Shares of the nodal diameters of the blades' motion."""
    axes.bar(run["nodal_diameter"], 100.0 * run["nodal_diameter_share"].fillna(0.0), width=0.8)
    axes.set_xlabel(f"nodal diameters at {float(run['speed']):g} rad/s")
    axes.set_ylabel("share of the motion (%)")
