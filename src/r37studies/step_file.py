"""STEP file of a blade's surface: six B-spline faces, written by gmsh's OpenCASCADE."""

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import gmsh
import numpy as np
from scipy.interpolate import make_interp_spline

from r37core.base.io import atomic_write
from r37core.blade.blade_map import BladeMap
from r37core.mesh.generate import quiet_gmsh

_SPAN = np.linspace(0.0, 1.0, 33)
_THICKNESS = np.sin(np.linspace(-0.5, 0.5, 13) * np.pi)
# dense at the ends, where the sections close round the edges
_CHORD = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 61))
_START, _END = np.zeros(1), np.ones(1)
_FACES = (
    (_CHORD, _SPAN, -_END),
    (_CHORD, _SPAN, _END),
    (_START, _SPAN, _THICKNESS),
    (_END, _SPAN, _THICKNESS),
    (_CHORD, _START, _THICKNESS),
    (_CHORD, _END, _THICKNESS),
)
"""Chord, span and thickness on pressure side, suction side, both edges, root and tip."""
_MILLIMETRES = 1e3
_SEWING = 1e-3  # mm
_DEGREE = 3


def write_step(blade: BladeMap, file: Path | str) -> None:
    """Write the blade as one closed solid, in mm, in the blade's frame.

    Each face is the tensor-product cubic spline through points of the blade, with the same knots along common edges.
    Raises RuntimeError when OpenCASCADE cannot close the faces to a solid.
    """
    with quiet_gmsh(), atomic_write(file) as partial:
        for axes in _FACES:
            _add_face(blade, axes)
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


def _add_face(blade: BladeMap, axes: Sequence[np.ndarray]) -> None:
    """Add the B-spline surface through the blade's points on a grid of chord, span and thickness."""
    chord, span, thickness = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
    u, v = (axis for axis in axes if len(axis) > 1)
    points = _MILLIMETRES * blade.position(chord, span, thickness).reshape(len(u), len(v), 3)
    along_u = make_interp_spline(u, points, k=_DEGREE, axis=0)
    along_v = make_interp_spline(v, along_u.c, k=_DEGREE, axis=1)
    # the axis of interpolation comes first in the coefficients: u runs fastest
    tags = [gmsh.model.occ.addPoint(*pole) for pole in along_v.c.reshape(-1, 3)]
    (knots_u, counts_u), (knots_v, counts_v) = (np.unique(spline.t, return_counts=True) for spline in (along_u, along_v))
    gmsh.model.occ.addBSplineSurface(
        tags,
        len(u),
        degreeU=_DEGREE,
        degreeV=_DEGREE,
        knotsU=knots_u,
        knotsV=knots_v,
        multiplicitiesU=counts_u,
        multiplicitiesV=counts_v,
    )
