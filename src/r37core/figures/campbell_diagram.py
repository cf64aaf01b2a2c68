"""Campbell diagrams."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.rom.naming import NAMED_MODES

from . import style

_ROOM = 0.07


def draw_campbell(campbell: xr.Dataset, title: str) -> Figure:
    """One blade: frequencies over speed with engine orders and crossings, and the dynamic clearance of 1B and 1T."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.PAGE, 3.6), width_ratios=[1.7, 1.0])
    speed = campbell["speed"].values
    highest = 1.3 * float(campbell["frequency"].sel(mode="2B").max())
    left.set(xlabel="speed (rad/s)", ylabel="frequency (Hz)", ylim=(0.0, highest), xlim=(0.0, speed[-1]))
    _draw_engine_orders(left, campbell["engine_order"].values, speed, highest)
    for name in campbell["mode"].values:
        frequency = campbell["frequency"].sel(mode=name)
        if float(frequency.min()) > highest:
            continue
        (line,) = left.plot(speed, frequency, label=str(name))
        crossing = campbell["crossing_speed"].sel(mode=name)
        left.plot(crossing, crossing * campbell["engine_order"] / (2.0 * np.pi), "o", color=line.get_color(), markersize=3.5)
    left.set_title(f"Campbell diagram, blade {title}")
    left.legend(loc="upper left", ncols=3)
    style.rpm_axis(left)
    for name in NAMED_MODES[:2]:
        clearance = campbell["dynamic_clearance"].sel(mode=name)
        right.plot(1e3 * clearance["tangential_displacement"], 1e3 * clearance, label=name)
    right.set(xlabel="tangential displacement (mm)", ylabel="change of clearance (mm)")
    right.set_title("dynamic clearance, leading edge")
    right.legend()
    return figure


def draw_campbell_overview(campbell: xr.Dataset) -> Figure:
    """All blades: one panel for each named mode."""
    figure, panels = plt.subplots(1, len(NAMED_MODES), figsize=(style.PAGE, 3.2))
    speed = campbell["speed"].values
    styles = style.blade_styles(campbell["blade"].values)
    for axes, name in zip(panels, NAMED_MODES, strict=True):
        frequencies = campbell["frequency"].sel(mode=name)
        for blade in campbell["blade"].values:
            axes.plot(speed, frequencies.sel(blade=blade), label=str(blade), **styles[str(blade)])
        low, high = float(frequencies.min()), float(frequencies.max())
        margin = 0.08 * (high - low)
        axes.set(xlabel="speed (rad/s)", title=name, xlim=(0.0, speed[-1]), ylim=(low - margin, high + margin))
        _draw_engine_orders(axes, campbell["engine_order"].values, speed, high)
        style.rpm_axis(axes, most_ticks=5)
    panels[0].set_ylabel("frequency (Hz)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=7)
    return figure


def _draw_engine_orders(axes: Axes, orders: np.ndarray, speed: np.ndarray, highest: float) -> None:
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    labelled = np.array([np.inf, np.inf])
    for order in orders:
        axes.plot(speed, order * speed / (2.0 * np.pi), color="0.7", linewidth=0.6, zorder=0)
        end = 0.97 * min(speed[-1], 2.0 * np.pi * highest / order)
        place = np.array([(end - left) / (right - left), (order * end / (2.0 * np.pi) - low) / (high - low)])
        # high orders lie close together: a number only where there is room for it
        if np.linalg.norm(place - labelled) > _ROOM:
            axes.annotate(str(order), (end, order * end / (2.0 * np.pi)), fontsize=6, color="0.4", annotation_clip=True)
            labelled = place
