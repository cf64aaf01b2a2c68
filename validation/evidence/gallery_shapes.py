"""Rendered figures of the gallery: mode shapes, the region of stress."""

from pathlib import Path

import numpy as np
import pyvista

from r37core.base.io import readable
from r37core.figures import style
from r37core.figures.offscreen import look, new_plotter, save_picture
from r37core.mesh.mesh_files import read_vtu
from r37core.rom.naming import NAMED_MODES
from r37core.rom.region_choice import RegionChoice

_HEIGHT = 380
_SWING = 0.02
"""Largest displacement that a mode is drawn with (m)."""


def draw_modes(file: Path | str, png: Path | str) -> None:
    """The first three modes of a modes_<speed>.vtu, as `add_mode` shows them."""
    with readable(file):
        grid = pyvista.read(file)
    plotter = new_plotter(len(NAMED_MODES), (400 * len(NAMED_MODES), _HEIGHT))
    for column, name in enumerate(NAMED_MODES):
        plotter.subplot(0, column)
        add_mode(plotter, grid, name)
        frequency = float(grid.field_data[f"frequency of mode {name} (Hz)"][0])
        _finish(plotter, f"{name}, {frequency:.0f} Hz")
    save_picture(plotter, png)


def add_mode(plotter: pyvista.Plotter, grid: pyvista.DataSet, name: str) -> None:
    """A blade moved by a mode and coloured by the size of its displacement. Lines are the edges of the blade at rest."""
    shape = np.asarray(grid.point_data[f"mode {name}"])
    size = np.linalg.norm(shape, axis=1)
    moved = grid.copy()
    moved.points = grid.points + _SWING / size.max() * shape
    moved.point_data["size"] = size / size.max()
    plotter.add_mesh(_surface(moved), scalars="size", cmap="viridis", smooth_shading=True, show_scalar_bar=False)
    plotter.add_mesh(_surface(grid).extract_feature_edges(), color="black", line_width=1.5)


def draw_mesh(file: Path | str, region: RegionChoice, png: Path | str) -> None:
    """A mesh with its elements, and the elements on which stress is recovered."""
    with readable(file):
        grid = pyvista.read(file)
    elements = region.elements(read_vtu(file), np.empty(0, dtype=int)).values()
    inside = np.unique(np.concatenate([nodes.ravel() for nodes in elements]))
    plotter = new_plotter(2, (600, _HEIGHT + 60))
    plotter.subplot(0, 0)
    plotter.add_mesh(_surface(grid), color="white", show_edges=True, edge_color="grey", line_width=0.5)
    _finish(plotter, f"{grid.n_points} nodes")
    plotter.subplot(0, 1)
    plotter.add_mesh(_surface(grid), color="white", opacity=0.35)
    part = grid.extract_points(inside, adjacent_cells=False)
    plotter.add_mesh(_surface(part), color=style.COLOURS[1], show_edges=True, line_width=0.5)
    _finish(plotter, "region of stress")
    save_picture(plotter, png)


def _surface(grid: pyvista.DataSet) -> pyvista.PolyData:
    return grid.extract_surface(nonlinear_subdivision=0, algorithm="dataset_surface")


def _finish(plotter: pyvista.Plotter, title: str) -> None:
    plotter.add_text(title, font_size=9)
    look(plotter)
