"""Stills of shapes: modes, and the worst instants of interactions, rendered off screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
import pyvista

from r37core.figures.offscreen import look, new_plotter, save_picture
from r37core.io import read_json, readable

from . import INDEX
from .moving import COLOUR_MAP, LARGEST_SHOWN

_COLUMNS, _PANEL = 6, (300, 420)


def draw_shapes(folder: Path, file: Path | str) -> None:
    """Draw all shapes of a folder that exchange.shapes has written, each beside its undeformed blade, into a PNG.

    Modes: coloured by the displacement as a share of its largest; worst instants: by the von Mises stress (MPa), each on a
    scale of its own. A folder without shapes gives a picture that says so.
    """
    entries: Sequence[Mapping[str, Any]] = read_json(folder / INDEX)
    rows = max(1, ceil(len(entries) / _COLUMNS))
    columns = max(1, ceil(len(entries) / rows))
    plotter = new_plotter(columns, (columns * _PANEL[0], rows * _PANEL[1]), rows)
    for number, entry in enumerate(entries):
        plotter.subplot(*divmod(number, columns))
        _draw(plotter, folder, entry)
    if not entries:
        plotter.add_text("no interaction that ran to its end", font_size=8)
    save_picture(plotter, file)


def _draw(plotter: pyvista.Plotter, folder: Path, entry: Mapping[str, Any]) -> None:
    name = str(entry["shape"])
    of_mode = name.startswith("mode_")
    file = folder / ("modes_0.vtu" if of_mode else f"{name}.vtu")
    with readable(file):
        grid = pyvista.read(file)
    moved = f"mode {name.removeprefix('mode_')}" if of_mode else "displacement"
    size = np.linalg.norm(grid.point_data[moved], axis=1)
    if of_mode:
        values, label, largest = size / size.max(), "share of the largest", 1.0
        factor = LARGEST_SHOWN * float(np.ptp(np.hypot(*grid.points[:, :2].T))) / float(size.max())
    else:
        values, label, largest = 1e-6 * grid.point_data["von Mises stress"], "MPa", 1e-6 * entry["largest_shown"]
        factor = float(entry["magnification"])
    grid.point_data[label] = values
    still = grid.extract_surface(nonlinear_subdivision=1, algorithm="dataset_surface")
    bar: Any = {"width": 0.8, "position_x": 0.1, "title_font_size": 15, "label_font_size": 15, "n_labels": 2, "fmt": "%.0f"}
    plotter.add_mesh(still.extract_feature_edges(feature_angle=50.0), color="black", line_width=1)
    plotter.add_mesh(
        still.warp_by_vector(moved, factor=factor),
        scalars=label,
        clim=(0.0, largest),
        cmap=COLOUR_MAP,
        ambient=0.55,
        diffuse=0.5,
        smooth_shading=True,
        split_sharp_edges=True,
        # each panel has a bar of its own, which VTK tells apart by their titles
        scalar_bar_args=bar | {"title": label + " " * plotter.renderers.active_index},
    )
    plotter.add_text(_words(str(entry["title"])), font_size=8)
    look(plotter, seen_from=(0.35, -1.0, -0.25), zoom=1.1)


def _words(title: str) -> str:
    """A title as lines that fit a panel."""
    return title.replace(" at ", "\nat ").replace(": ", "\n").replace("; ", "\n").replace(", ", "\n")
