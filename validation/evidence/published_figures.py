"""Pictures of what the paper publishes, of ours: response, stress, wear and clearances."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE, VARIANTS, WIDTH_ABOVE_YIELD

from r37core.figures import style
from r37core.figures.maps import draw_cells
from r37core.results.measures import leading_edge, peak_of, peak_speed, width_above_yield

from .benchmark_measures import history_of
from .published_checks import PEAK_WITHIN, Runs
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


def draw_blades(shipped: Runs) -> Figure:
    """Rms of all blades about their interaction of 1B with order 4; dotted: published peaks."""
    figure, panels = plt.subplots(2, 1, figsize=(style.PAGE, 5.2), sharex=True)
    for axes, (name, direction) in zip(panels, _DIRECTIONS.items(), strict=True):
        _draw_about_order_4(axes, shipped, name, 1e3)
        axes.set_ylabel(f"rms, {direction} (mm)")
    style.rpm_axis(panels[0])
    _legend_above(figure, panels[0])
    panels[1].set_xlabel("speed (rad/s); dotted: published peaks")
    return figure


def _draw_about_order_4(axes: Axes, shipped: Runs, name: str, scale: float) -> None:
    """One curve for each blade, and its published peak."""
    for number, row in enumerate(INTERACTIONS[: len(BLADES)]):
        run, color = leading_edge(shipped[row.name]), f"C{number}"
        axes.plot(run["speed"], scale * run[name], ".-", color=color, markersize=3, linewidth=1.0, label=row.blade)
        axes.axvline(row.peak, color=color, linestyle=":", linewidth=0.9)


def _legend_above(figure: Figure, axes: Axes) -> None:
    """The legend of one panel above the figure, out of the way of its peaks."""
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=len(BLADES) + 1, fontsize=8)


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


def draw_choices(choices: Mapping[str, Runs]) -> Figure:
    """One row for each choice: error of every peak speed in percent, and how many there are; grey: what counts as agreeing."""
    figure, axes = plt.subplots(figsize=(9.0, 0.32 * len(choices) + 1.6))
    axes.axvspan(-100 * PEAK_WITHIN, 100 * PEAK_WITHIN, color="0.92", zorder=0)
    rows = np.arange(len(choices))
    for number, published in enumerate(INTERACTIONS):
        speeds = [peak_speed(runs[published.name]) if published.name in runs else np.nan for runs in choices.values()]
        errors = 100.0 * (np.array(speeds) / published.peak - 1.0)
        marker = "o" if published.engine_order == 4 else "^sD"[published.engine_order - 5]
        color = f"C{number}" if published.engine_order == 4 else "C0"
        axes.plot(errors, rows, marker, color=color, alpha=0.8, markersize=5, linestyle="none", label=published.label)
    for row, runs in enumerate(choices.values()):
        found_peaks = sum(np.isfinite(peak_speed(runs[published.name])) for published in INTERACTIONS if published.name in runs)
        axes.annotate(
            f"{found_peaks} of {len(INTERACTIONS)}", (1.01, row), xycoords=("axes fraction", "data"), va="center", fontsize=8
        )
    axes.set_yticks(rows, list(choices))
    axes.invert_yaxis()
    axes.set(xlabel="peak speed less the published one (%)")
    axes.annotate("peaks found", (1.01, 1.0), xycoords="axes fraction", va="bottom", fontsize=8)
    figure.legend(loc="outside lower center", ncols=5, fontsize=8)
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
        axes.semilogy(run["speed"], 1e-9 * run["max_von_mises"], marker=".", markersize=2, linewidth=0.9, label=label)
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


def draw_variant_spectra(responses: Mapping[str, xr.Dataset], campbells: Mapping[str, xr.Dataset]) -> Figure:
    """Spectral maps of the variants, normal to the casing, on one scale, with the frequency of 1B."""
    figure, grid = plt.subplots(2, 3, figsize=(style.PAGE, 4.2), sharex=True, sharey=True)
    shown = {blade: 1e3 * responses[blade]["amplitude"].sel(engine_order=slice(0.0, 12.0)) for blade in VARIANTS}
    top = max(float(amplitude.max()) for amplitude in shown.values())
    for axes, blade in zip(grid.flat, VARIANTS, strict=True):
        amplitude = shown[blade].dropna("speed", how="all")
        values = np.maximum(amplitude.transpose("engine_order", "speed").values, 1e-12)
        norm = LogNorm(top / 10**_DECADES, top)
        picture = draw_cells(axes, amplitude["speed"].values, amplitude["engine_order"].values, values, norm=norm, cmap="magma")
        frequency = campbells[blade]["frequency"].sel(mode="1B").isel(speed=slice(1, None))
        axes.plot(frequency["speed"], 2.0 * np.pi * frequency / frequency["speed"], "--", color="white", linewidth=0.7)
        axes.set(xlim=(float(amplitude["speed"].min()), float(amplitude["speed"].max())), ylim=(0.0, 12.0))
        axes.set_title(blade, pad=4 if axes in grid[1] else None)
        axes.grid(False)
    for axes in grid[0]:
        style.rpm_axis(axes, most_ticks=4)
    figure.supxlabel("speed (rad/s)", fontsize=8)
    figure.supylabel("engine order", fontsize=8)
    figure.colorbar(picture, ax=grid, label="amplitude, normal (mm)", aspect=40)
    return figure


def draw_clearances(campbells: Mapping[str, xr.Dataset]) -> Figure:
    """Dynamic clearance of all blades along 1B and 1T."""
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 3.2), sharey=True)
    styles = style.blade_styles(BLADES)
    for axes, mode in zip(panels, ("1B", "1T"), strict=True):
        for blade in BLADES:
            curve = campbells[blade]["dynamic_clearance"].sel(mode=mode)
            axes.plot(1e3 * curve["tangential_displacement"], 1e3 * curve, label=blade, **styles[blade])
        axes.set(xlabel="tangential displacement (mm)", title=mode)
    panels[0].set_ylabel("change of clearance (mm)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=7)
    return figure


def draw_peak_histories(shipped: Runs) -> Figure:
    """Largest stress of every revolution of each blade at its own lined peak of 1B with order 4."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 3.2))
    styles = style.blade_styles(BLADES)
    for blade in BLADES:
        run = shipped[f"{blade}_4"]
        speed = float(peak_of(run)["speed"])
        history = 1e-9 * history_of(run, speed)
        label = f"{blade}, {speed:g} rad/s"
        axes.semilogy(run["revolution"], np.where(history > 0.0, history, np.nan), label=label, **styles[blade])
    style.yield_lines(axes, {blade: float(shipped[f"{blade}_4"]["yield_stress"]) for blade in BLADES})
    axes.set(xlabel="revolution", ylabel="largest von Mises (GPa)", ylim=(1e-3, None))
    figure.legend(*axes.get_legend_handles_labels(), loc="outside right upper")
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
