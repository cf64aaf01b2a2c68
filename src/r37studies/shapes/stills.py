"""Stills of shapes: modes, and the worst instants of interactions, rendered off screen, with letters and colour bars."""

import textwrap
from collections.abc import Sequence
from math import ceil
from pathlib import Path
from typing import Any, Final, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from r37core.base.io import read_json
from r37core.figures import style
from r37core.figures.offscreen import draw_edges, look, new_plotter, read_grid, rendered, surface_of, without_margins
from r37studies.fields import REGION_STRESS, modal_frequency, modal_stress

from .worst_shapes import INDEX, LARGEST_SHOWN, blade_height

_COLUMNS, _PANEL_HEIGHT = 6, 2.9
_PIXELS = (600, 900)
_COLOUR_MAP: Final = "viridis"
_LETTERS = 29
"""Letters of a line that fits a panel."""

_SHOWN = 0.99
"""Share of the nodes within the colours: the few at contact and clamping have stresses that grow with every finer mesh."""


class _Shape(NamedTuple):
    """Drawing of a shape: title in lines, colours, their label and largest value, and the field that moves it by a factor."""

    grid: Any
    title: Sequence[str]
    values: np.ndarray
    label: str
    largest: float
    moved: str
    factor: float


def draw_modes(folder: Path) -> Figure:
    """Draw the modes of a folder, each with the outline of its undeformed blade.

    Above coloured by the displacement as a share of its largest, below by the von Mises stress for 1 mm of it, each on a scale
    of its own.
    """
    grid = read_grid(folder / "modes_0.vtu")
    names = [field.removeprefix("mode ") for field in grid.point_data if field.startswith("mode ")]
    return _draw([[_displacement(grid, name), _modal_stress(grid, name)] for name in names])


def draw_worst_instants(folder: Path) -> Figure:
    """Draw the worst instants of a folder by their von Mises stress (MPa), each on a scale of its own.

    Without worst instants the picture says so.
    """
    return _draw([[_stress(read_grid(folder / entry["file"]), entry)] for entry in read_json(folder / INDEX)])


def _displacement(grid: Any, mode: str) -> _Shape:
    size = np.linalg.norm(grid.point_data[f"mode {mode}"], axis=1)
    frequency = float(grid.field_data[modal_frequency(mode)][0])
    title = [f"mode {mode}, {frequency:.6g} Hz", "at rest"]
    factor = LARGEST_SHOWN * blade_height(grid.points) / float(size.max())
    return _Shape(grid, title, size / size.max(), "share of the largest", 1.0, f"mode {mode}", factor)


def _modal_stress(grid: Any, mode: str) -> _Shape:
    largest = np.linalg.norm(grid.point_data[f"mode {mode}"], axis=1).max()
    values = 1e-6 * grid.point_data[modal_stress(mode)] / (1e3 * largest)
    top = float(np.quantile(values, _SHOWN))
    return _displacement(grid, mode)._replace(values=values, label="von Mises (MPa/mm)", largest=top)


def _stress(grid: Any, entry: dict[str, Any]) -> _Shape:
    stress = grid.point_data["von Mises stress"]
    of_region = float(grid.field_data[REGION_STRESS][0])
    largest = 1e-6 * max(of_region, float(np.quantile(stress, _SHOWN)))
    return _Shape(
        grid, entry["title"], 1e-6 * stress, "von Mises stress (MPa)", largest, "displacement", float(entry["magnification"])
    )


def _draw(shapes: Sequence[Sequence[_Shape]]) -> Figure:
    """Columns of panels, one below the other; more columns than fit go into further blocks of rows."""
    if not shapes:
        return style.empty_figure("no interaction that ran to its end")
    views, blocks = len(shapes[0]), ceil(len(shapes) / _COLUMNS)
    rows, columns = blocks * views, ceil(len(shapes) / blocks)
    size = (style.PAGE * columns / _COLUMNS, rows * _PANEL_HEIGHT)
    figure, grid = plt.subplots(rows, columns, figsize=size, squeeze=False)
    for axes in grid.flat:
        axes.set_axis_off()
    for number, column in enumerate(shapes):
        for row, shape in enumerate(column):
            _draw_shape(grid[views * (number // columns) + row, number % columns], shape)
    return figure


def _draw_shape(axes: Axes, shape: _Shape) -> None:
    axes.imshow(_rendered(shape), interpolation="none")
    axes.set_title("\n".join(line for part in shape.title for line in textwrap.wrap(part, _LETTERS)), fontsize=6)
    colours = ScalarMappable(Normalize(0.0, shape.largest), _COLOUR_MAP)
    bar = axes.figure.colorbar(colours, ax=axes, location="bottom", shrink=0.8, aspect=18, pad=0.02, ticks=[0.0, shape.largest])
    bar.ax.set_xticklabels(["0", f"{shape.largest:.0f}"])
    bar.ax.tick_params(labelsize=6, length=2, pad=1)
    bar.set_label(shape.label, fontsize=6, labelpad=1)


def _rendered(shape: _Shape) -> np.ndarray:
    """The displaced blade in its colours, and the outline of the undeformed blade, as pixels."""
    shape.grid.point_data["shown"] = shape.values
    plotter = new_plotter(1, _PIXELS)
    draw_edges(plotter, still := surface_of(shape.grid))
    plotter.add_mesh(
        still.warp_by_vector(shape.moved, factor=shape.factor),
        scalars="shown",
        clim=(0.0, shape.largest),
        cmap=_COLOUR_MAP,
        ambient=0.55,
        diffuse=0.5,
        smooth_shading=True,
        split_sharp_edges=True,
        show_scalar_bar=False,
    )
    look(plotter, seen_from=(0.35, -1.0, -0.25), zoom=1.25)
    return without_margins(rendered(plotter))
