"""Motions up, down and from rest over the speed, and what dwells find."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.figures import style

from .choice import MOTIONS
from .dataset import swept
from .dwelling import Lasting

COLOURS = {"up": "#D55E00", "down": "#0072B2", "rest": "0.25"}
LINES = {"up": "-", "down": "-", "rest": ":"}
MARKERS = {Lasting.LASTING: "o", Lasting.SWITCHING: "D", Lasting.TRANSIENT: "x"}


def draw_second_motions(motions: xr.Dataset, dwells: pd.DataFrame, title: str, *, blade: str, scene: str) -> Figure:
    """One blade in one scene: motion and stress of the three motions, and what becomes of the larger one in dwells."""
    pair = swept(motions)
    stress = "max_von_mises_median" in pair and bool(pair["max_von_mises_median"].notnull().any())
    found = dwells[(dwells["blade"] == blade) & (dwells["scene"] == scene)]
    figure, panels = plt.subplots(3 + stress, 1, figsize=(style.PAGE, 2.0 * (3 + stress)), sharex=True)
    _draw_motions(panels[0], pair)
    panels[0].set_ylabel("rms (mm)")
    if stress:
        for motion in MOTIONS:
            panels[1].plot(
                pair["speed"], 1e-9 * pair["max_von_mises_median"].sel(motion=motion), LINES[motion], color=COLOURS[motion]
            )
        style.yield_lines(panels[1], {blade: float(pair["yield_stress"])}, named=True)
        panels[1].set_ylabel("median von Mises (GPa)")
    shares, exponents = panels[-2:]
    for kind, marker in MARKERS.items():
        those = found[found["high"] == str(kind)]
        if len(those):
            shares.plot(
                those["speed_rad_s"], those["share_of_time_high"], marker, color=COLOURS["up"], label=f"larger motion {kind}"
            )
    shares.set(ylabel="share of time\nin larger motion", ylim=(-0.05, 1.05))
    for of, label, colour in (("high", "larger", COLOURS["up"]), ("low", "smaller", COLOURS["down"])):
        exponents.plot(
            found["speed_rad_s"], found[f"lyapunov_exponent_{of}"], ".", color=colour, label=f"exponent, {label} motion"
        )
    exponents.axhline(0.0, color="0.6", linewidth=0.8)
    exponents.set_ylabel("exponent\nper revolution")
    for axes in panels:
        shade(axes, pair)
    panels[0].set_title(f"{title}: carried up and down, and from rest; leading edge, normal and tangential together")
    panels[-1].set_xlabel("speed (rad/s)")
    style.rpm_axis(panels[0])
    figure.legend(*style.legend_entries(panels), loc="outside lower center", ncols=4)
    return figure


def draw_overview(motions: xr.Dataset, title: str) -> Figure:
    """All blades of a scene: the three motions, one panel for each."""
    pairs = {blade: swept(motions.sel(blade=blade)) for blade in motions["blade"].values.tolist()}
    there = {blade: pair for blade, pair in pairs.items() if pair.sizes["speed"]}
    figure, grid = plt.subplots(
        max(len(there), 1), 1, figsize=(style.PAGE, 1.2 * max(len(there), 1) + 0.8), sharex=True, squeeze=False
    )
    for axes, (blade, pair) in zip(grid[:, 0], there.items(), strict=False):
        _draw_motions(axes, pair)
        shade(axes, pair)
        axes.set_ylabel(f"{blade} (mm)")
    grid[0, 0].set_title(f"{title}: rms of the leading edge, normal and tangential together")
    grid[-1, 0].set_xlabel("speed (rad/s)")
    style.rpm_axis(grid[0, 0])
    figure.legend(*style.legend_entries(grid[:, 0]), loc="outside lower center", ncols=4)
    return figure


def shade(axes: Axes, pair: xr.Dataset) -> None:
    """Shade the speeds at which the motions differ."""
    speeds, differ = pair["speed"].values, pair["differ"].values > 0.0
    if len(speeds) > 1:
        half = 0.5 * float(np.diff(speeds).min())
        for number, speed in enumerate(speeds[differ]):
            label = "motions differ" if number == 0 else None
            axes.axvspan(speed - half, speed + half, color="0.88", linewidth=0, zorder=0, label=label)


def _draw_motions(axes: Axes, pair: xr.Dataset) -> None:
    for motion in MOTIONS:
        mean, scatter = (1e3 * pair[name].sel(motion=motion) for name in ("motion_mean", "motion_scatter"))
        label = "from rest" if motion == "rest" else f"carried {motion}"
        axes.plot(pair["speed"], mean, LINES[motion], color=COLOURS[motion], label=label, linewidth=1.0)
        axes.fill_between(pair["speed"], mean - scatter, mean + scatter, color=COLOURS[motion], alpha=0.15, linewidth=0)
