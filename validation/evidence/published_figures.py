"""Pictures of what the paper publishes, of ours: response, stress and wear."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE, WIDTH_ABOVE_YIELD

from r37core.figures import style
from r37core.figures.maps import draw_cells
from r37core.results.measures import leading_edge

from .benchmark_measures import history_of
from .last_revolution import width_above_yield
from .published_checks import Runs
from .published_windows import BARE

FINE, COARSE = 248, 62
"""Instants of a revolution at which the paper recovers stress: for a picture of it, and for its largest value."""

_DECADES = 4.0

SCENES = {"lined": ("abradable lining", "C0"), "direct": ("bare casing", "C1")}
"""Kind of scene -> its label and colour."""

_DIRECTIONS = {"rms_normal": "normal to the casing", "rms_tangential": "tangential"}


def draw_reference(lined: xr.Dataset, bare: xr.Dataset) -> Figure:
    """Rms of the reference blade in both scenes over the whole range; dotted: published peaks."""
    runs = {"lined": leading_edge(lined), "direct": leading_edge(bare)}
    figure, panels = plt.subplots(2, 1, figsize=(style.PAGE, 5.0), sharex=True)
    for axes, (name, direction) in zip(panels, _DIRECTIONS.items(), strict=True):
        for scene, run in runs.items():
            label, color = SCENES[scene]
            axes.semilogy(run["speed"], 1e3 * run[name], color=color, linewidth=1.1, label=label)
        for row in INTERACTIONS:
            if row.blade == "Ref":
                axes.axvline(row.peak, color="C0", linestyle=":", linewidth=0.9)
                axes.annotate(
                    f"1B/{row.engine_order}", (row.peak + 4, 0.96), xycoords=("data", "axes fraction"), fontsize=7, va="top"
                )
        axes.axvline(DIRECT_PEAK, color="C1", linestyle=":", linewidth=0.9)
        axes.set_ylabel(f"rms, {direction} (mm)")
    panels[0].legend(loc="upper right", bbox_to_anchor=(0.73, 1.0))
    panels[0].set_title("blade Ref, leading edge, last half of the run; dotted: published peaks")
    panels[1].set_xlabel("speed (rad/s)")
    style.rpm_axis(panels[0])
    return figure


def draw_histories(shipped: Runs) -> Figure:
    """Largest stress of every revolution of the reference blade in both scenes, at three published speeds."""
    runs = {"lined": shipped[INTERACTIONS[0].name], "direct": shipped[BARE]}
    figure, panels = plt.subplots(1, 3, figsize=(style.PAGE, 2.9), sharey=True)
    for axes, speed in zip(panels, (INTERACTIONS[0].peak, DIRECT_PEAK, QUIET), strict=True):
        for scene, run in runs.items():
            label, color = SCENES[scene]
            history = 1e-9 * history_of(run, speed)
            shown = np.where(history > 0.0, history, np.nan)
            axes.semilogy(run["revolution"], shown, color=color, linewidth=1.2, label=label)
        style.yield_lines(axes, {name: float(run["yield_stress"]) for name, run in runs.items()})
        axes.set(xlabel="revolution", title=f"{speed:g} rad/s")
    panels[0].set_ylabel("largest von Mises of the revolution (GPa)")
    panels[0].legend()
    return figure


def draw_revolution(stress: np.ndarray, speed: float) -> Figure:
    """Largest stress (Pa) at FINE instants of the last revolution, shape (FINE,), and at COARSE of them."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 2.6))
    share = np.arange(FINE) / FINE
    axes.plot(share, 1e-9 * stress, "-", label=f"{FINE} instants")
    step = FINE // COARSE
    axes.plot(share[::step], 1e-9 * stress[::step], "o", markersize=3, label=f"{COARSE} instants")
    axes.set(
        xlabel="share of the last revolution", ylabel="largest von Mises (GPa)", title=f"{speed:g} rad/s, abradable lining"
    )
    figure.legend(*axes.get_legend_handles_labels(), loc="outside right upper")
    return figure


def draw_stress_over_speed(runs: Runs) -> Figure:
    """Largest stress of the last revolution of the reference blade in both scenes, with the yield line."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 3.0))
    for kind, (label, _) in SCENES.items():
        run = runs[kind]
        axes.semilogy(
            run["speed"], 1e-9 * run["max_von_mises_last_revolution"], marker=".", markersize=2, linewidth=0.9, label=label
        )
    style.yield_lines(axes, {REFERENCE: float(runs["lined"]["yield_stress"])}, named=True)
    for interaction in INTERACTIONS:
        if interaction.blade == REFERENCE:
            axes.axvline(interaction.peak, color="0.5", linestyle=":", linewidth=0.8)
    axes.set(xlabel="speed (rad/s); dotted: published peaks", ylabel="largest von Mises (GPa)")
    style.rpm_axis(axes)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def draw_wear(response: xr.Dataset) -> Figure:
    """Wear round the casing over speed, and its spatial content: the amplitude of each number of lobes."""
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 3.2), sharex=True)
    worn = response["wear"].dropna("speed", how="all")
    values = 1e3 * worn.transpose("angle", "speed").values
    picture = draw_cells(panels[0], worn["speed"].values, np.degrees(worn["angle"].values), values, cmap="viridis")
    figure.colorbar(picture, ax=panels[0], location="bottom", aspect=35, label="wear (mm)")
    panels[0].set_ylabel("angle round the casing (degrees)")
    content = response["wear_harmonic"].dropna("speed", how="all")
    values = np.maximum(1e3 * content.transpose("lobes", "speed").values, 1e-12)
    top = max(float(values[1:].max()), 1e-9)
    norm = LogNorm(top / 10**_DECADES, top)
    picture = draw_cells(panels[1], content["speed"].values, content["lobes"].values, values, norm=norm, cmap="magma")
    figure.colorbar(picture, ax=panels[1], location="bottom", aspect=35, label="amplitude of the wear's lobes (mm)")
    panels[1].set(ylabel="lobes", ylim=(0.5, 12.5))
    for axes in panels:
        axes.set_xlabel("speed (rad/s)")
        axes.grid(False)
        style.rpm_axis(axes)
    return figure


def draw_widths(shipped: Runs) -> Figure:
    """Length of the speeds above yield about 1B with order 4, of every blade; the published one of the reference as a line."""
    figure, axes = plt.subplots(figsize=(style.COLUMN, 2.6))
    widths: Mapping[str, float] = {blade: width_above_yield(shipped[f"{blade}_4"]) for blade in BLADES}
    styles = style.blade_styles(BLADES)
    bars = axes.bar(list(widths), list(widths.values()), color=[styles[blade]["color"] for blade in BLADES])
    axes.bar_label(bars, fmt="%.3g", fontsize=7)
    axes.axhline(WIDTH_ABOVE_YIELD, color="0.2", linestyle="--", linewidth=0.9, label=f"published for {REFERENCE}")
    axes.set_ylabel("speeds above yield (rad/s)")
    axes.legend()
    return figure
