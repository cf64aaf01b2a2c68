"""Stills of shapes: modes, and the worst instants of interactions, rendered off screen, with letters and colour bars beside."""

import textwrap
from collections.abc import Callable, Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from r37core.base.io import read_json, readable
from r37core.exchange.fields import modal_stress
from r37core.figures import style
from r37core.figures.offscreen import look, new_plotter, rendered, without_margins

from . import INDEX
from .moving import COLOUR_MAP, LARGEST_SHOWN, SHOWN

_COLUMNS, _PANEL_HEIGHT = 6, 2.9
_PIXELS = (600, 900)
_LETTERS = 29
"""Letters of a line that fits a panel."""


def draw_shapes(folder: Path) -> Figure:
    """Draw all shapes of a folder that `moving` has written, each with the outline of its undeformed blade.

    Modes twice, coloured by the displacement as a share of its largest, and below by the von Mises stress for 1 mm of it; worst
    instants by the von Mises stress (MPa). Each stress has a scale of its own. A folder without shapes gives a picture that
    says so.
    """
    entries: Sequence[Mapping[str, Any]] = read_json(folder / INDEX)
    views = (_displacement, _modal_stress) if entries and _is_mode(entries[0]) else (_stress,)
    blocks = max(1, ceil(len(entries) / _COLUMNS))
    rows, columns = blocks * len(views), max(1, ceil(len(entries) / blocks))
    size = (style.PAGE * columns / _COLUMNS, rows * _PANEL_HEIGHT)
    figure, grid = plt.subplots(rows, columns, figsize=size if entries else (4.0, 1.5), squeeze=False)
    for axes in grid.flat:
        axes.set_axis_off()
    for number, entry in enumerate(entries):
        block, column = divmod(number, columns)
        shape = _read(folder, entry)
        for row, view in enumerate(views):
            _draw(grid[len(views) * block + row, column], shape, entry, view)
    if not entries:
        grid[0, 0].text(0.5, 0.5, "no interaction that ran to its end", ha="center", va="center")
    return figure


def _is_mode(entry: Mapping[str, Any]) -> bool:
    return str(entry["shape"]).startswith("mode_")


def _read(folder: Path, entry: Mapping[str, Any]) -> Any:
    """The mesh with fields, of modes those of all of them."""
    file = folder / ("modes_0.vtu" if _is_mode(entry) else f"{entry['shape']}.vtu")
    with readable(file):
        return pyvista.read(file)


class _View(NamedTuple):
    """Drawing of a shape: colours, their label and largest value, and the field that moves it, times a factor."""

    values: np.ndarray
    label: str
    largest: float
    moved: str
    factor: float


def _displacement(grid: Any, entry: Mapping[str, Any]) -> _View:
    moved = f"mode {_mode(entry)}"
    size = np.linalg.norm(grid.point_data[moved], axis=1)
    factor = LARGEST_SHOWN * float(np.ptp(np.hypot(*grid.points[:, :2].T))) / float(size.max())
    return _View(size / size.max(), "share of the largest", 1.0, moved, factor)


def _modal_stress(grid: Any, entry: Mapping[str, Any]) -> _View:
    view, largest = _displacement(grid, entry), np.linalg.norm(grid.point_data[f"mode {_mode(entry)}"], axis=1).max()
    values = 1e-6 * grid.point_data[modal_stress(_mode(entry))] / (1e3 * largest)
    return view._replace(values=values, label="von Mises (MPa/mm)", largest=float(np.quantile(values, SHOWN)))


def _stress(grid: Any, entry: Mapping[str, Any]) -> _View:
    values, largest = 1e-6 * grid.point_data["von Mises stress"], 1e-6 * entry["largest_shown"]
    return _View(values, "von Mises stress (MPa)", largest, "displacement", float(entry["magnification"]))


def _mode(entry: Mapping[str, Any]) -> str:
    return str(entry["shape"]).removeprefix("mode_")


def _draw(axes: Axes, grid: Any, entry: Mapping[str, Any], view: Callable[[Any, Mapping[str, Any]], _View]) -> None:
    values, label, largest, moved, factor = view(grid, entry)
    grid.point_data["shown"] = values
    axes.imshow(_rendered(grid, moved, factor, largest), interpolation="none")
    axes.set_title(_words(str(entry["title"])), fontsize=6)
    colours = ScalarMappable(Normalize(0.0, largest), COLOUR_MAP)
    bar = axes.figure.colorbar(colours, ax=axes, location="bottom", shrink=0.8, aspect=18, pad=0.02, ticks=[0.0, largest])
    bar.ax.set_xticklabels(["0", f"{largest:.0f}"])
    bar.ax.tick_params(labelsize=6, length=2, pad=1)
    bar.set_label(label, fontsize=6, labelpad=1)


def _rendered(grid: Any, moved: str, factor: float, largest: float) -> np.ndarray:
    """The blade displaced by `factor` times the vectors `moved`, coloured by "shown" up to `largest`, as pixels."""
    still = grid.extract_surface(nonlinear_subdivision=1, algorithm="dataset_surface")
    plotter = new_plotter(1, _PIXELS)
    plotter.add_mesh(still.extract_feature_edges(feature_angle=50.0), color="black", line_width=1.5)
    plotter.add_mesh(
        still.warp_by_vector(moved, factor=factor),
        scalars="shown",
        clim=(0.0, largest),
        cmap=COLOUR_MAP,
        ambient=0.55,
        diffuse=0.5,
        smooth_shading=True,
        split_sharp_edges=True,
        show_scalar_bar=False,
    )
    look(plotter, seen_from=(0.35, -1.0, -0.25), zoom=1.25)
    return without_margins(rendered(plotter))


def _words(title: str) -> str:
    """A title as lines that fit a panel."""
    for long, short in _SHORT.items():
        title = title.replace(long, short)
    parts = title.replace(" at ", "\nat ").replace(": ", ":\n").replace("; ", "\n").split("\n")
    return "\n".join(line for part in parts for line in textwrap.wrap(part, _LETTERS))


_SHORT = {", above yield: outside the linear model": "; above yield, not linear", "displacement ": "shown "}
"""Replacements of words that break badly in a narrow panel."""
