"""Figures that only the gallery has: stress, wear and clearances in the manner of the paper."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.figures.campbell_diagram import draw_campbell
from r37core.figures.maps import draw_cells, draw_spectral_map
from r37core.results.measures import peak_of, width_above_yield
from validation.published import BLADES, INTERACTIONS, REFERENCE, VARIANTS, WIDTH_ABOVE_YIELD
from validation.studies.measures import history_of
from validation.studies.modelling_choices.figures import SCENES, draw_blades, draw_histories, draw_reference
from validation.studies.modelling_choices.validation import Runs

from .cases import COARSE, FINE

_DECADES = 4.0
_DOTS_PER_INCH = 120
"""So that the pages of docs/ stay small."""


@dataclass(frozen=True)
class GalleryData:
    """What the gallery shows, of a sweep and a few runs beside it.

    `campbells` by blade, `swept` responses by blade and kind of scene; runs about the interactions and over all speeds, by the
    names of the modelling choices' windows; `revolution`: stress (Pa) of the reference blade at FINE instants of the last
    revolution, shape (FINE,); `scenes`: names by kind.
    """

    campbells: Mapping[str, xr.Dataset]
    swept: Mapping[tuple[str, str], xr.Dataset]
    shipped: Runs
    survey: Runs
    revolution: np.ndarray
    scenes: Mapping[str, str]


def gallery_figures(data: GalleryData) -> dict[str, Callable[[str], None]]:
    """All figures of the gallery but the rendered ones, each to be drawn into a file."""
    campbell = data.campbells[REFERENCE]
    lined = {blade: data.swept[blade, "lined"] for blade in BLADES}
    drawn: dict[str, Callable[[], Figure]] = {
        "campbell": lambda: draw_campbell(campbell, REFERENCE),
        "reference": lambda: draw_reference(data.survey, data.shipped),
        "revolution": lambda: draw_revolution(data.revolution, INTERACTIONS[0].peak),
        "histories": lambda: draw_histories(data.shipped),
        "stress": lambda: draw_stress_over_speed(data.survey),
        "wear_content": lambda: draw_wear(lined[REFERENCE]),
        "variants_spectra": lambda: draw_variant_spectra(lined, data.campbells),
        "variants_response": lambda: draw_blades(data.shipped),
        "clearances": lambda: draw_clearances(data.campbells),
        "peak_histories": lambda: draw_peak_histories(data.shipped),
        "widths": lambda: draw_widths(data.shipped),
    }
    for kind, (label, _) in SCENES.items():
        drawn[f"spectrum_{kind}"] = partial(draw_spectral_map, data.swept[REFERENCE, kind], campbell, f"{REFERENCE}, {label}")
    return {name: partial(_save, draw) for name, draw in drawn.items()}


def _save(draw: Callable[[], Figure], file: str) -> None:
    style.save(draw(), file, dots_per_inch=_DOTS_PER_INCH)


def draw_revolution(stress: np.ndarray, speed: float) -> Figure:
    """Largest stress (Pa) at FINE instants of the last revolution, shape (FINE,), and at COARSE of them."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 2.6))
    share = np.arange(FINE) / FINE
    axes.plot(share, 1e-9 * stress, "-", label=f"{FINE} instants")
    step = FINE // COARSE
    axes.plot(share[::step], 1e-9 * stress[::step], "o", markersize=3, label=f"{COARSE} instants")
    axes.set(xlabel="share of the last revolution", ylabel="largest von Mises (GPa)", title=f"{speed:g} rad/s, lined")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside right upper")
    return figure


def draw_stress_over_speed(survey: Runs) -> Figure:
    """Largest stress of the last revolution of the reference blade in both scenes, with the yield line."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 3.0))
    for kind, (label, _) in SCENES.items():
        run = survey[f"Ref_{kind}"]
        axes.semilogy(run["speed"], 1e-9 * run["max_von_mises"], marker=".", markersize=2, linewidth=0.9, label=label)
    style.yield_lines(axes, {REFERENCE: float(survey["Ref_lined"]["yield_stress"])}, named=True)
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
