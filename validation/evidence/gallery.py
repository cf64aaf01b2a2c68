"""Pictures of docs/gallery.md: our counterparts of figures of the paper, at level `standard`."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from published import DIRECT_PEAK, INTERACTIONS, REFERENCE

from r37core.base.dataset_file import read_dataset
from r37core.figures import style
from r37core.figures.campbell_diagram import draw_campbell
from r37core.figures.maps import draw_cells, draw_spectral_map
from r37core.results.measures import leading_edge

from .paper_box import box_part

SCENES = {"lined": ("abradable lining", "C0"), "direct": ("bare casing", "C1")}
"""Kind of scene -> its label and colour."""

_DIRECTIONS = {"rms_normal": "normal to the casing", "rms_tangential": "tangential"}
_DECADES = 4.0

_DOTS_PER_INCH = 120
"""So that the pages of docs/ stay small."""


def charts(input: Any, output: Any, params: Any) -> None:
    """All pictures. Inputs: lined, direct, campbell."""
    diagram, runs = read_dataset(input.campbell), {kind: box_part(read_dataset(input[kind])) for kind in SCENES}
    figures = {
        "campbell": draw_campbell(diagram, REFERENCE),
        "reference": draw_reference(runs),
        "spectrum_lined": draw_spectral_map(runs["lined"], diagram, f"{REFERENCE}, {SCENES['lined'][0]}"),
        "stress": draw_stress(runs),
        "wear_content": draw_wear(runs["lined"]),
    }
    for name, figure in figures.items():
        style.save(figure, output[name], dots_per_inch=_DOTS_PER_INCH)


def draw_reference(runs: dict[str, xr.Dataset]) -> Figure:
    """Rms of the reference blade in both scenes over the whole range; dotted: published peaks."""
    figure, panels = plt.subplots(2, 1, figsize=(style.PAGE, 5.0), sharex=True)
    for axes, (name, direction) in zip(panels, _DIRECTIONS.items(), strict=True):
        for kind, (label, color) in SCENES.items():
            axes.semilogy(runs[kind]["speed"], 1e3 * leading_edge(runs[kind])[name], color=color, linewidth=1.1, label=label)
        _published_peaks(axes)
        axes.axvline(DIRECT_PEAK, color="C1", linestyle=":", linewidth=0.9)
        axes.set_ylabel(f"rms, {direction} (mm)")
    panels[0].legend(loc="upper right", bbox_to_anchor=(0.73, 1.0))
    panels[0].set_title("blade Ref, leading edge, last half of the run; dotted: published peaks")
    panels[1].set_xlabel("speed (rad/s)")
    style.rpm_axis(panels[0])
    return figure


def draw_stress(runs: dict[str, xr.Dataset]) -> Figure:
    """Largest stress of the last revolution of the reference blade in both scenes, with the yield line."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 3.0))
    for kind, (label, _) in SCENES.items():
        stress = 1e-9 * runs[kind]["max_von_mises_last_revolution"]
        axes.semilogy(runs[kind]["speed"], stress, marker=".", markersize=2, linewidth=0.9, label=label)
    style.yield_lines(axes, {REFERENCE: float(runs["lined"]["yield_stress"])}, named=True)
    _published_peaks(axes)
    axes.set(xlabel="speed (rad/s); dotted: published peaks", ylabel="largest von Mises (GPa)")
    style.rpm_axis(axes)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _published_peaks(axes: Axes) -> None:
    """Lines at the published peaks with lining, and their names."""
    for row in INTERACTIONS:
        if row.blade == REFERENCE:
            axes.axvline(row.peak, color="C0", linestyle=":", linewidth=0.9)
            place = {"xy": (row.peak + 4, 0.96), "xycoords": ("data", "axes fraction")}
            axes.annotate(f"1B/{row.engine_order}", fontsize=7, va="top", **place)


def draw_wear(response: xr.Dataset) -> Figure:
    """Wear round the casing over speed, and its spatial content: the amplitude of each number of lobes."""
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 3.2), sharex=True)
    worn, content = (response[name].dropna("speed", how="all") for name in ("wear", "wear_harmonic"))
    values = 1e3 * worn.transpose("angle", "speed").values
    picture = draw_cells(panels[0], worn["speed"].values, np.degrees(worn["angle"].values), values, cmap="viridis")
    figure.colorbar(picture, ax=panels[0], location="bottom", aspect=35, label="wear (mm)")
    panels[0].set_ylabel("angle round the casing (degrees)")
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
