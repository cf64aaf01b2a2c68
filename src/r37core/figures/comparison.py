"""Blades side by side around an interaction that they share."""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from r37core.time_integration.status import RunStatus

from . import style


def shared_order(campbell: xr.Dataset, low: float, high: float) -> int | None:
    """The lowest engine order of those that cross 1B of most blades between `low` and `high` (rad/s); None where none does."""
    crossing = campbell["crossing_speed"].sel(mode="1B")
    count = ((crossing >= low) & (crossing <= high)).sum("blade").values
    return int(campbell["engine_order"].values[int(np.argmax(count))]) if count.max() else None


def draw_comparison(
    campbell: xr.Dataset, rms: xr.Dataset, stress: xr.Dataset | None = None, title: str = "", *, below: float, above: float
) -> Figure:
    """All blades in one scene about their crossing of 1B with the engine order that most of them meet.

    Speeds are those above the crossing, as shares of it: the crossings of the blades lie hundreds of rad/s apart. The
    picture reaches from `below` to `above` the crossing, as shares too: where peaks are looked for. Runs that diverged are
    crosses of the blade's colour at the upper edge.
    """
    styles = style.blade_styles(rms["blade"].values)
    order = shared_order(campbell, float(rms["speed"].min()), float(rms["speed"].max()))
    panels_of = {"rms, normal (mm)": 1e3 * rms["rms_normal"].sel(tip_point="leading_edge")}
    panels_of["rms, tangential (mm)"] = 1e3 * rms["rms_tangential"].sel(tip_point="leading_edge")
    if stress is not None:
        panels_of["largest von Mises (GPa)"] = 1e-9 * stress["max_von_mises"]
    figure, panels = plt.subplots(len(panels_of), 1, figsize=(style.PAGE, 1.9 * len(panels_of) + 0.5), sharex=True)
    for axes, (label, values) in zip(panels, panels_of.items(), strict=True):
        for blade in values["blade"].values if order else []:
            crossing = float(campbell["crossing_speed"].sel(blade=blade, mode="1B", engine_order=order))
            about = slice((1.0 - below) * crossing, (1.0 + above) * crossing)
            curve = values.sel(blade=blade, speed=about).dropna("speed")
            status = rms["status"].sel(blade=blade, speed=about)
            diverged = status["speed"].values[status.values == RunStatus.DIVERGED]
            if curve.size or len(diverged):
                above_crossing = 100 * (curve["speed"] / crossing - 1.0)
                axes.plot(above_crossing, curve, marker=".", markersize=3, label=str(blade), **styles[str(blade)])
                style.mark_diverged(axes, 100 * (diverged / crossing - 1.0), styles[str(blade)]["color"])
        axes.axvline(0.0, color="0.5", linewidth=0.8, linestyle=":")
        axes.set_ylabel(label)
    if stress is not None:
        style.yield_lines(panels[-1], stress["yield_stress"].to_series(), named=True)
    label = f"speed above the crossing of 1B with engine order {order} (%)" if order else "no crossing of 1B was run"
    panels[-1].set_xlabel(label)
    panels[0].set_title(f"blades in scene {title}")
    if panels[0].lines[:-1]:
        figure.legend(*style.legend_entries(panels), loc="outside lower center", ncols=5)
    return figure
