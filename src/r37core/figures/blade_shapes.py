"""A picture of the blades' meshes, rendered off screen."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pyvista

from r37core.io import atomic_write, readable

from .offscreen import new_plotter


def draw_blade_shapes(meshes: Mapping[str, Path | str], file: Path | str) -> None:
    """Draw the meshes (blade name -> .vtu) side by side, coloured by the scaled Jacobian, into a PNG."""
    plotter = new_plotter(len(meshes), (260 * len(meshes), 420))
    for i, (name, mesh_file) in enumerate(meshes.items()):
        plotter.subplot(0, i)
        with readable(mesh_file):
            grid = pyvista.read(mesh_file)
        last = i == len(meshes) - 1
        plotter.add_mesh(
            grid,
            scalars="scaled_jacobian",
            clim=(0.0, 1.0),
            cmap="viridis",
            show_edges=True,
            line_width=0.3,
            show_scalar_bar=last,
            scalar_bar_args={"title": "scaled Jacobian", "width": 0.8, "position_x": 0.1} if last else None,
        )
        plotter.add_text(name, font_size=10)
        plotter.view_vector((0.3, 1.0, 0.35), viewup=(1.0, 0.0, 0.0))
    with atomic_write(file) as partial:
        plotter.screenshot(partial)
    plotter.close()
