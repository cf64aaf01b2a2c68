"""A picture of the blades, rendered off screen."""

from collections.abc import Mapping
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib
import numpy as np
import pyvista
from matplotlib.colors import to_rgb

from .offscreen import draw_edges, look, new_plotter, read_grid, save_picture, sides, surface_of
from .style import blade_styles

_BESIDE = 0.09
"""Distance of a name from what it names, as a share of the blade's height."""
_LINE = 22
"""Letters of a name in a line of a panel."""
_LETTERS = str(Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans.ttf"))
"""Font of all other figures."""


def draw_blade_shapes(meshes: Mapping[str, Path | str], file: Path | str) -> None:
    """Draw the blades (name -> mesh, .vtu) side by side, each in its colour of all figures, into a PNG.

    An arrow shows the rotation; leading and trailing edge (LE, TE) and the side that is seen have their names.
    """
    plotter, styles = new_plotter(len(meshes), (440 * len(meshes), 600)), blade_styles(meshes)
    for i, (name, mesh_file) in enumerate(meshes.items()):
        plotter.subplot(0, i)
        grid = read_grid(mesh_file)
        # colours half way to white, because black letters stand on them
        light = [0.5 + 0.5 * part for part in to_rgb(styles[name]["color"])]
        surface = surface_of(grid)
        plotter.add_mesh(surface, color=light, ambient=0.35, diffuse=0.65, smooth_shading=True, split_sharp_edges=True)
        draw_edges(plotter, surface)
        _mark_sense(plotter, grid)
        # below, clear of the rotation
        plotter.add_text(fill(name, _LINE), position="lower_edge", font_size=13, font_file=_LETTERS)
        look(plotter)
    save_picture(plotter, file)


def _mark_sense(plotter: pyvista.Plotter, grid: Any) -> None:
    """An arrow along the rotation, towards negative theta, above the tip; names of it, both edges and the side in view."""
    height = float(np.ptp(grid.points[:, 0]))
    leading, trailing, tip = (
        grid.points[np.flatnonzero(grid.point_data[name])].mean(axis=0) for name in ("leading_edge", "trailing_edge", "tip")
    )
    start = tip + height * np.array([0.12, 0.2, 0.0])
    plotter.add_mesh(pyvista.Arrow(start=start, direction=(0.0, -1.0, 0.0), scale=0.5 * height), color="black")
    # the camera looks from negative y
    side, _ = sides(grid)
    middle = grid.points.mean(axis=0)
    # names stand next to the edges, where nothing lies under them
    ends = [edge + _BESIDE * height * (edge - middle) / np.linalg.norm(edge - middle) for edge in (leading, trailing)]
    above = start + height * np.array([_BESIDE, -0.25, 0.0])
    plotter.add_point_labels(
        np.array([*ends, middle, above]),
        ["LE", "TE", side, "rotation"],
        font_size=24,
        font_file=_LETTERS,
        show_points=False,
        always_visible=True,
        shape=None,
        justification_horizontal="center",
        text_color="black",
    )
