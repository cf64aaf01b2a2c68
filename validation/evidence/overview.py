"""Second picture of README: the first bending mode of the benchmark's blade, and what linear theory computes over speed."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.axes import Axes
from published import DIRECT_PEAK, INTERACTIONS, REFERENCE

from r37core.base.dataset_file import read_dataset
from r37core.base.io import readable
from r37core.figures import style
from r37core.figures.offscreen import look, new_plotter, rendered
from r37core.results.measures import motion

from .answer import ON_ANY_PAGE
from .gallery import SCENES

_SWING = 0.02
"""Largest displacement that the mode is drawn with (m)."""


def draw(input: Any, output: Any, params: Any) -> None:
    """Above the motion of the blade over speed, below the blade. Inputs: modes, lined, direct. Output: picture."""
    with plt.rc_context(ON_ANY_PAGE):
        figure = plt.figure(figsize=(5.2, 4.6))
        response, blade = figure.subplots(2, 1, height_ratios=[1.5, 1.0])
        blade.imshow(_first_bending(Path(input.modes) / "modes_0.vtu"))
        blade.set_axis_off()
        blade.set_title("first bending mode, 1B: colour by displacement")
        _draw_response(response, {kind: input[kind] for kind in SCENES})
        style.save(figure, output.picture, dots_per_inch=150)


def _first_bending(file: Path) -> np.ndarray:
    """Picture of the mode, coloured by displacement, with edges at rest, on nothing."""
    with readable(file):
        grid = pyvista.read(file)
    shape = np.asarray(grid.point_data["mode 1B"])
    size = np.linalg.norm(shape, axis=1)
    moved = grid.copy()
    moved.points = grid.points + _SWING / size.max() * shape
    moved.point_data["size"] = size
    plotter = new_plotter(1, (1000, 640))
    surface, edges = (each.extract_surface(nonlinear_subdivision=0, algorithm="dataset_surface") for each in (moved, grid))
    plotter.add_mesh(surface, scalars="size", cmap="viridis", smooth_shading=True, show_scalar_bar=False)
    plotter.add_mesh(edges.extract_feature_edges(), color="black", line_width=1.5)
    look(plotter, zoom=1.0)
    pixels = rendered(plotter)
    drawn = (pixels < 250).any(axis=2)
    (top, left), (bottom, right) = np.argwhere(drawn).min(axis=0), np.argwhere(drawn).max(axis=0) + 1
    return np.dstack([pixels, np.where(drawn, 255, 0).astype(np.uint8)])[top:bottom, left:right]


def _draw_response(axes: Axes, files: dict[str, str]) -> None:
    """Rms of the leading edge over speed in both scenes, and the published peaks as triangles with their names."""
    runs, top = {kind: read_dataset(file) for kind, file in files.items()}, 0.0
    for kind, (label, color) in SCENES.items():
        axes.plot(runs[kind]["speed"], 1e3 * motion(runs[kind]), color=color, label=label)
        top = max(top, 1e3 * float(motion(runs[kind]).max()))
    peaks = {f"1B/{row.engine_order}": (row.peak, "lined") for row in INTERACTIONS if row.blade == REFERENCE}
    for name, (speed, kind) in {**peaks, "": (DIRECT_PEAK, "direct")}.items():
        label = "_" if name else "published peak"
        axes.plot(speed, 1.1 * top, "v", color=SCENES[kind][1], markersize=6, linestyle="none", label=label)
        axes.annotate(name, (speed, 1.1 * top), (0, 5), textcoords="offset points", ha="center", fontsize=9)
    axes.set(xlabel="speed (rad/s)", ylabel="rms of the tip (mm)", ylim=(0.0, 1.35 * top))
    axes.set_title("blade Ref by linear theory", loc="left", fontweight="bold")
    axes.figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3, handlelength=1.2)
