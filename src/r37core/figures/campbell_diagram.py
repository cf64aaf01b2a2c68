"""Campbell diagrams."""

from collections.abc import Mapping
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy import ndarray
from xarray import Dataset

from r37core.base.plain import from_plain
from r37core.contact.elastic_casing import ElasticCasing
from r37core.fem.sector import aliased
from r37core.results.casing_coincidence import coincidences, modes_met, seen_from_rotor, waves_of
from r37core.rom.naming import NAMED_MODES, mode_label

from . import style


def draw_campbell(campbell: Dataset, title: str, casings: Mapping[str, Any] | None = None) -> Figure:
    """One blade: frequencies over speed with engine orders and crossings, and the dynamic clearance of 1B and 1T.

    `casings`: elastic ones by scene, as plain values; their waves are seen from the rotor, paler where simulations have none.
    """
    figure, ((left, right),) = style.panels(1, 2, 3.6, width_ratios=[1.7, 1.0])
    speed = campbell["speed"].values
    highest = 1.3 * float(campbell["frequency"].sel(mode="2B").max())
    left.set(xlabel=style.SPEED_LABEL, ylabel="frequency (Hz)", ylim=(0.0, highest), xlim=(0.0, speed[-1]))
    draw_engine_orders(left, campbell["engine_order"].values, speed, highest)
    for name in campbell["mode"].values:
        frequency = campbell["frequency"].sel(mode=name)
        if float(frequency.min()) > highest:
            continue
        colour = style.mode_colour(campbell, name)
        left.plot(speed, frequency, label=mode_label(str(name)), color=colour)
        crossing = campbell["crossing_speed"].sel(mode=name)
        left.plot(crossing, crossing * campbell["engine_order"] / (2.0 * np.pi), "o", color=colour, markersize=3.5)
    # those that scenes share once
    scenes: dict[ElasticCasing, list[str]] = {}
    for scene, casing in (casings or {}).items():
        scenes.setdefault(from_plain(ElasticCasing, casing), []).append(scene)
    for (elastic, names), colour in zip(scenes.items(), cycle(("#8C510A", "#762A83", "#01665E")), strict=False):
        whose = "casing" if len(scenes) == 1 else f"casing of {', '.join(names)}"
        _draw_casing(left, campbell, elastic, whose, colour)
    left.set_title(f"Campbell diagram, blade {title}")
    left.legend(loc="upper left", ncols=3, frameon=bool(casings), framealpha=0.9)
    style.rpm_axis(left)
    for name in NAMED_MODES[:2]:
        clearance = 1e3 * campbell["dynamic_clearance"].sel(mode=name)
        right.plot(1e3 * clearance["tangential_displacement"], clearance, label=name, color=style.mode_colour(campbell, name))
    right.set(xlabel="tangential displacement (mm)", ylabel="change of clearance (mm)", title="dynamic clearance, leading edge")
    right.legend()
    return figure


def _draw_casing(axes: Axes, campbell: Dataset, casing: ElasticCasing, whose: str, colour: str) -> None:
    """Waves of an elastic casing, and where named modes of the blade meet them."""
    speeds, highest = campbell["speed"].values, axes.get_ylim()[1]
    dashes = {"forward": (4.0, 2.0), "backward": (1.0, 1.5)}
    named: set[str] = set()
    for mode, wave in [(ring_mode, wave) for ring_mode in modes_met(casing, campbell) for wave in waves_of(ring_mode)]:
        seen = np.abs(seen_from_rotor(mode, wave, speeds))
        if seen.min() > highest:
            continue
        what, alpha = (wave, 1.0) if mode in casing.modes else ("not simulated", 0.4)
        label = "_" if what in named else f"{whose}, {what}"
        named.add(what)
        axes.plot(speeds, seen, color=colour, linewidth=0.5, dashes=dashes[wave], zorder=1, alpha=alpha, label=label)
        for name in NAMED_MODES:
            for crossing in coincidences(campbell["frequency"].sel(mode=name), mode, wave):
                axes.plot(*crossing, "D", color=colour, markersize=2.5, markerfacecolor="white", zorder=4, alpha=alpha)


def draw_engine_orders(axes: Axes, orders: ndarray, speed: ndarray, highest: float, letters: float = 6) -> None:
    """Lines, with their numbers where they leave the panel: beside it at the right, within it at the top."""
    beside: dict[str, Any] = {"xytext": (2, 0), "ha": "left", "va": "center"}
    white = {"facecolor": "white", "linewidth": 0, "pad": 0.6}
    top: dict[str, Any] = {"xytext": (0, -3), "ha": "center", "va": "top", "bbox": white}
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    labelled = np.array([np.inf, np.inf])
    for order in orders:
        axes.plot(speed, order * speed / (2.0 * np.pi), color="0.7", linewidth=0.6, zorder=0)
        end = min(speed[-1], 2.0 * np.pi * highest / order)
        end_on_axes = np.array([(end - left) / (right - left), (order * end / (2.0 * np.pi) - low) / (high - low)])
        # high orders lie close together: a number only where there is room for it
        if end_on_axes[1] > 0.0 and np.linalg.norm(end_on_axes - labelled) > 0.07:
            look = beside if end == speed[-1] else top
            place = (end, order * end / (2.0 * np.pi))
            axes.annotate(
                str(order), place, fontsize=letters, color="0.3", textcoords="offset points", annotation_clip=False, **look
            )
            labelled = end_on_axes


def draw_interference(campbell: Dataset, title: str) -> Figure:
    """Frequencies of all nodal diameters at rest and at the highest speed, and the engine orders that excite them there.

    Source: M. P. Singh et al., SAFE diagram, Proc. 17th Turbomachinery Symposium (1988) 93-101.
    """
    figure, ((axes,),) = style.panels(1, 1, 3.6)
    diameters, sectors = campbell["nodal_diameter"].values, int(campbell["sectors"])
    highest = 1.3 * float(campbell["nodal_frequency"].sel(mode="2B").max())
    axes.set(xlabel="nodal diameter", ylabel="frequency (Hz)", ylim=(0.0, highest), xlim=(-0.5, diameters[-1] + 0.5))
    speed = float(campbell["speed"].max())
    orders = np.arange(0, 2 * sectors + 1)
    excited = [aliased(int(order), sectors) for order in orders]
    axes.plot(excited, orders * speed / (2.0 * np.pi), color="0.6", linewidth=0.8, label=f"engine orders, {speed:g} rad/s")
    for place, filled in ((0, False), (-1, True)):
        every = campbell["disc_frequency"].isel(speed=place)
        axes.plot(diameters, every.T, "o", color="0.6", markersize=2.5, markerfacecolor="0.6" if filled else "white", zorder=2)
        for name in NAMED_MODES:
            colour, family = style.mode_colour(campbell, name), campbell["nodal_frequency"].sel(mode=name).isel(speed=place)
            label = f"{mode_label(name)}" if filled else "_"
            look = {"markersize": 4.0, "markerfacecolor": colour if filled else "white", "zorder": 3}
            axes.plot(diameters, family, "o-", color=colour, linewidth=0.6, label=label, **look)
    axes.set_title(f"interference diagram, blade {title}, {sectors} sectors")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), title="filled: spinning, open: at rest")
    return figure
