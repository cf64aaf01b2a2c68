"""Picture of README: what the main job computes of the reference blade."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from published import DIRECT_PEAK, INTERACTIONS, REFERENCE

from r37core.base.io import readable
from r37core.figures import style
from r37core.figures.offscreen import look, new_plotter, rendered
from r37core.results.measures import motion

from .gallery_shapes import add_mode
from .published_figures import SCENES
from .published_runs import swept

_DOTS_PER_INCH = 150


def draw(input: Any, output: Any, params: Any) -> None:
    """Left the blade in 1B, right its response next to the published peaks. Inputs: modes, responses. Output: picture."""
    responses = swept(input.responses)
    figure = plt.figure(figsize=(style.PAGE, 2.9))
    blade, response = figure.subplots(1, 2, width_ratios=[1.0, 2.6])
    blade.imshow(_first_bending(Path(input.modes) / "modes_0.vtu"), interpolation="none")
    blade.set_axis_off()
    blade.set_title("first bending mode, 1B")
    _draw_response(response, {kind: responses[REFERENCE, kind == "lined"] for kind in SCENES})
    _save(figure, output.picture)


def _first_bending(file: Path) -> np.ndarray:
    with readable(file):
        grid = pyvista.read(file)
    plotter = new_plotter(1, (500, 640))
    add_mode(plotter, grid, "1B")
    look(plotter)
    pixels = rendered(plotter)
    used = np.argwhere((pixels < 250).any(axis=2))
    (top, left), (bottom, right) = used.min(axis=0), used.max(axis=0)
    return pixels[top : bottom + 1, left : right + 1]


def _draw_response(axes: Axes, runs: dict[str, Any]) -> None:
    """Rms of the leading edge over speed in both scenes, and the published peaks as triangles."""
    for kind, (label, color) in SCENES.items():
        axes.plot(runs[kind]["speed"], 1e3 * motion(runs[kind]), color=color, label=label)
    top = 1e3 * motion(runs["lined"]).max()
    for row in INTERACTIONS:
        if row.blade == REFERENCE:
            axes.annotate(f"1B/{row.engine_order}", (row.peak, 1.11 * top), ha="center", va="bottom", fontsize=7)
            label = "published peak" if row is INTERACTIONS[0] else "_"
            axes.plot(row.peak, 1.08 * top, "v", color=SCENES["lined"][1], markersize=5, linestyle="none", label=label)
    axes.plot(DIRECT_PEAK, 1.08 * top, "v", color=SCENES["direct"][1], markersize=5, linestyle="none")
    axes.set(xlabel="speed (rad/s)", ylabel="rms of the tip's motion (mm)", ylim=(0.0, 1.25 * top))
    axes.legend(loc="upper left", bbox_to_anchor=(0.49, 0.76), handlelength=1.2)


def _save(figure: Figure, file: str) -> None:
    style.save(figure, file, dots_per_inch=_DOTS_PER_INCH)
