"""A picture of the blades' meshes, rendered off screen."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pyvista

from r37core.io import readable

from .offscreen import look, new_plotter, save_picture


def draw_blade_shapes(meshes: Mapping[str, Path | str], file: Path | str) -> None:
    """Draw the meshes (blade name -> .vtu) side by side, coloured by the scaled Jacobian, into a PNG."""
    plotter = new_plotter(len(meshes), (260 * len(meshes), 420))
    for i, (name, mesh_file) in enumerate(meshes.items()):
        plotter.subplot(0, i)
        with readable(mesh_file):
            surface = pyvista.read(mesh_file).extract_surface(nonlinear_subdivision=1, algorithm="dataset_surface")
        last = i == len(meshes) - 1
        plotter.add_mesh(
            surface,
            scalars="scaled_jacobian",
            clim=(0.0, 1.0),
            cmap="viridis",
            smooth_shading=True,
            split_sharp_edges=True,
            show_scalar_bar=last,
            scalar_bar_args={"title": "scaled Jacobian", "width": 0.8, "position_x": 0.1} if last else None,
        )
        plotter.add_text(name, font_size=10)
        look(plotter)
    save_picture(plotter, file)
