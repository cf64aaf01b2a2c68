"""Rendering without a display. Run as a program it draws one test picture and fails if that does not work."""

from __future__ import annotations

import os
import sys

# VTK picks its window when first imported; this one needs neither a display nor a graphics card
if sys.platform == "linux":
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")

import pyvista


def new_plotter(columns: int, size: tuple[int, int], rows: int = 1) -> pyvista.Plotter:
    """An off-screen plotter with `columns` panels side by side in each of `rows` and a window of `size` pixels."""
    return pyvista.Plotter(shape=(rows, columns), off_screen=True, window_size=list(size), border=False)


if __name__ == "__main__":
    plotter = new_plotter(1, (64, 64))
    plotter.add_mesh(pyvista.Sphere())
    picture = plotter.screenshot(return_img=True)
    if picture is None or picture.min() == picture.max():
        sys.exit("VTK rendered an empty picture")
