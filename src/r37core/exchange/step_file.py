"""STEP file of a blade's surface: six B-spline faces, written by gmsh's OpenCASCADE."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import gmsh
import numpy as np
from scipy.interpolate import make_interp_spline

from r37core.blade.blade_surface import Blade
from r37core.io import atomic_write
from r37core.mesh.generate import quiet_gmsh

_SPAN = np.linspace(0.0, 1.0, 33)
_THICKNESS = np.sin(np.linspace(-0.5, 0.5, 13) * np.pi)
# dense at the ends, where the sections close round the edges
_CHORD = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 61))
_MILLIMETRES = 1e3
_SEWING = 1e-3  # mm
_DEGREE = 3


def write_step(blade: Blade, file: Path | str) -> None:
    """Write the blade as one closed solid, in mm, in the blade's frame.

    Each face is the tensor-product cubic spline through points of the blade, with the same knots along common edges.
    Raises RuntimeError when OpenCASCADE cannot close the faces to a solid.
    """
    with quiet_gmsh(), atomic_write(file) as partial:
        for points in _sampled(blade):
            _face(points)
        occ = gmsh.model.occ
        occ.remove(occ.getEntities(0))  # the poles
        occ.healShapes(tolerance=_SEWING, sewFaces=True, makeSolids=True)
        occ.synchronize()
        if [len(gmsh.model.getEntities(dimension)) for dimension in range(4)] != [8, 12, 6, 1]:
            raise RuntimeError(f"{file}: the faces of the blade do not close to a solid")
        with _nothing_printed():
            gmsh.write(str(partial))


@contextmanager
def _nothing_printed() -> Iterator[None]:
    """Keep OpenCASCADE's statistics, which it prints past Python and gmsh, off the screen."""
    sys.stdout.flush()
    screen, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        yield
    finally:
        os.dup2(screen, 1)
        os.close(screen)
        os.close(nowhere)


def _sampled(blade: Blade) -> list[np.ndarray]:
    """Points (mm) on pressure side, suction side, both edges, root and tip, shape (u, v, 3) each."""
    end = np.ones(1)
    grids = [
        (_CHORD, _SPAN, -end),
        (_CHORD, _SPAN, end),
        (0.0 * end, _SPAN, _THICKNESS),
        (end, _SPAN, _THICKNESS),
        (_CHORD, 0.0 * end, _THICKNESS),
        (_CHORD, end, _THICKNESS),
    ]
    faces = []
    for axes in grids:
        chord, span, thickness = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
        shape = [len(axis) for axis in axes if len(axis) > 1]
        faces.append(_MILLIMETRES * blade.position(chord, span, thickness).reshape(*shape, 3))
    return faces


def _parameters(count: int) -> np.ndarray:
    return next(axis for axis in (_CHORD, _SPAN, _THICKNESS) if len(axis) == count)


def _face(points: np.ndarray) -> int:
    """Tag of the B-spline surface through a grid of points, shape (u, v, 3)."""
    along_u = make_interp_spline(_parameters(points.shape[0]), points, k=_DEGREE, axis=0)
    along_v = make_interp_spline(_parameters(points.shape[1]), along_u.c, k=_DEGREE, axis=1)
    # the axis of interpolation comes first in the coefficients: u runs fastest
    tags = [gmsh.model.occ.addPoint(*pole) for pole in along_v.c.reshape(-1, 3)]
    knots = [np.unique(spline.t, return_counts=True) for spline in (along_u, along_v)]
    return int(
        gmsh.model.occ.addBSplineSurface(
            tags,
            points.shape[0],
            degreeU=_DEGREE,
            degreeV=_DEGREE,
            knotsU=knots[0][0],
            knotsV=knots[1][0],
            multiplicitiesU=knots[0][1],
            multiplicitiesV=knots[1][1],
        )
    )
