"""Second picture of README: the first bending mode of the benchmark's blade, and what linear theory computes over speed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pyvista
import xarray as xr
from matplotlib.axes import Axes
from published import DIRECT_PEAK, INTERACTIONS, REFERENCE

from r37core.base.dataset_file import read_dataset
from r37core.base.io import readable
from r37core.figures import style
from r37core.figures.offscreen import look, new_plotter, rendered
from r37core.results.interaction_choice import InteractionChoice
from r37core.results.interactions import find_interactions, titles
from r37core.results.measures import motion
from r37core.results.regions import read_judged

from .answer import NEUTRAL, ON_ANY_PAGE
from .gallery import SCENES

_NAMED = 2e-3
"""Motion (m) from which on a peak is named."""

_SWING = 0.02
"""Largest displacement that the mode is drawn with (m)."""

_AXES = {"radial": (1.0, 0.0, 0.0), "downstream": (0.0, 0.0, 1.0)}


def draw(input: Any, output: Any, params: Any) -> None:
    """Above the motion of the blade over speed, below the blade. Inputs: modes, lined, direct, campbell. Output: picture."""
    runs = {kind: read_judged(getattr(input, kind)) for kind in SCENES}
    with plt.rc_context(ON_ANY_PAGE):
        figure = plt.figure(figsize=(5.2, 4.6))
        response, blade = figure.subplots(2, 1, height_ratios=[1.5, 1.0])
        blade.imshow(_first_bending(Path(input.modes) / "modes_0.vtu"))
        blade.set_axis_off()
        blade.set_title("first bending mode, 1B: colour by displacement")
        _draw_response(response, runs, read_dataset(input.campbell))
        style.save(figure, output.picture, dots_per_inch=150)


def _first_bending(file: Path) -> np.ndarray:
    """Picture of the mode, coloured by displacement, with edges at rest and axes, on nothing."""
    with readable(file):
        grid = pyvista.read(file)
    plotter = new_plotter(1, (1000, 640))
    shape = np.asarray(grid.point_data["mode 1B"])
    size = np.linalg.norm(shape, axis=1)
    moved = grid.copy()
    moved.points = grid.points + _SWING / size.max() * shape
    moved.point_data["size"] = size / size.max()
    plotter.add_mesh(_surface(moved), scalars="size", cmap="viridis", smooth_shading=True, show_scalar_bar=False)
    plotter.add_mesh(_surface(grid).extract_feature_edges(), color="black", line_width=1.5)
    low, high = np.reshape(grid.bounds, (3, 2)).T
    corner, length = (
        np.array([low[0] + 0.5 * (high[0] - low[0]), 0.5 * (low[1] + high[1]), high[2] + 0.02]),
        0.25 * (high[0] - low[0]),
    )
    for direction in _AXES.values():
        plotter.add_mesh(pyvista.Arrow(start=corner, direction=direction, scale=length), color=NEUTRAL)
    ends = [corner + 1.15 * length * np.array(direction) for direction in _AXES.values()]
    shown: dict[str, Any] = {"shape": None, "always_visible": True, "show_points": False}
    plotter.add_point_labels(ends, list(_AXES), font_size=34, text_color=NEUTRAL, **shown)
    look(plotter, zoom=1.0)
    pixels = rendered(plotter)
    drawn = (pixels < 250).any(axis=2)
    used = np.argwhere(drawn)
    (top, left), (bottom, right) = used.min(axis=0), used.max(axis=0) + 1
    return np.dstack([pixels, np.where(drawn, 255, 0).astype(np.uint8)])[top:bottom, left:right]


def _surface(grid: pyvista.DataSet) -> pyvista.PolyData:
    return grid.extract_surface(nonlinear_subdivision=0, algorithm="dataset_surface")


def _draw_response(axes: Axes, runs: dict[str, xr.Dataset], campbell: xr.Dataset) -> None:
    """Rms of the leading edge over speed in both scenes, peaks with their names, and the published peaks as triangles."""
    for kind, (label, color) in SCENES.items():
        axes.plot(runs[kind]["speed"], 1e3 * motion(runs[kind]), color=color, label=label)
    top = 1e3 * float(motion(runs["lined"]).max())
    peaks = find_interactions(runs["lined"], campbell, InteractionChoice())
    names = titles(peaks)
    for peak in peaks:
        if peak["peak_motion_m"] > _NAMED:
            speed = peak["peak_speed_rad_s"]
            place = (speed, 1e3 * peak["peak_motion_m"])
            axes.annotate(names[speed], place, (0, 2), textcoords="offset points", ha="center", va="bottom", fontsize=9)
    published = [(row.peak, "lined") for row in INTERACTIONS if row.blade == REFERENCE] + [(DIRECT_PEAK, "direct")]
    for number, (speed, kind) in enumerate(published):
        label = "published peak" if number == 0 else "_"
        axes.plot(speed, 1.2 * top, "v", color=SCENES[kind][1], markersize=6, linestyle="none", label=label)
    axes.set(xlabel="speed (rad/s)", ylabel="rms of the tip (mm)", ylim=(0.0, 1.3 * top))
    axes.set_title("blade Ref by linear theory", loc="left", fontweight="bold")
    axes.figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3, handlelength=1.2)
