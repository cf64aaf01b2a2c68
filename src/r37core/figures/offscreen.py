"""Rendering without a display. Run as a program it draws one test picture and fails if that does not work."""

import os
import sys
from pathlib import Path
from typing import Any

# VTK picks its window when first imported; this one needs neither a display nor a graphics card
if sys.platform == "linux":
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")

import numpy as np
import pyvista
from numpy import ndarray

from r37core.base.io import atomic_write, readable


def new_plotter(columns: int, size: tuple[int, int]) -> pyvista.Plotter:
    """An off-screen plotter with `columns` panels side by side and a window of `size` pixels."""
    return pyvista.Plotter(shape=(1, columns), off_screen=True, window_size=list(size), border=False)


def read_grid(file: Path | str) -> Any:
    """The mesh of a file (.vtu). Raises InputFileError where it cannot be read."""
    with readable(file):
        return pyvista.read(file)


def surface_of(grid: Any) -> Any:
    """Surface of a mesh, with its curved faces."""
    return grid.extract_surface(nonlinear_subdivision=1, algorithm="dataset_surface")


def draw_edges(plotter: pyvista.Plotter, surface: Any) -> None:
    """Edges of a surface in the current panel."""
    plotter.add_mesh(surface.extract_feature_edges(feature_angle=50.0), color="black", line_width=1.5)


def sides(grid: Any) -> tuple[str, str]:
    """Names of the sides of a blade that are seen from negative and from positive y."""
    pressure, suction = (grid.points[grid.point_data[f"tip_{side}_edge"] > 0, 1].mean() for side in ("pressure", "suction"))
    return ("pressure side", "suction side") if pressure < suction else ("suction side", "pressure side")


def look(
    plotter: pyvista.Plotter,
    seen_from: tuple[float, float, float] = (0.25, -1.0, 0.9),
    zoom: float = 1.3,
    close_up: ndarray | None = None,
) -> None:
    """Show all of the current panel, or the points of a `close_up`, shape (points, 3), from a direction; the radius is up."""
    plotter.camera_position = [seen_from, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    bounds = None if close_up is None else np.stack([close_up.min(axis=0), close_up.max(axis=0)], axis=1).ravel()
    plotter.reset_camera(bounds=bounds)  # type: ignore[call-arg]  # the wrapper hides the method from mypy
    plotter.camera.zoom(zoom)


def rendered(plotter: pyvista.Plotter) -> ndarray:
    """Picture that was drawn, as pixels of shape (height, width, 3), and the end of the plotter."""
    pixels = np.asarray(plotter.screenshot(return_img=True))
    plotter.close()
    return pixels


def without_margins(pixels: ndarray) -> ndarray:
    """The part of a picture, shape (height, width, 3), that is not white."""
    drawn = np.argwhere((pixels < 255).any(axis=2))
    (top, left), (bottom, right) = drawn.min(axis=0), drawn.max(axis=0) + 1
    return pixels[top:bottom, left:right]


def save_picture(plotter: pyvista.Plotter, file: Path | str) -> None:
    """Write what was drawn into a PNG and end with the plotter."""
    with atomic_write(file) as partial:
        plotter.screenshot(partial)
    plotter.close()


if __name__ == "__main__":
    plotter = new_plotter(1, (64, 64))
    plotter.add_mesh(pyvista.Sphere())
    picture = plotter.screenshot(return_img=True)
    if picture is None or picture.min() == picture.max():
        sys.exit("VTK rendered an empty picture")
