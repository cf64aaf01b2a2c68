"""The axes of a mesh of another program, found from its shape: those about which its ends are cones and its tip makes sense."""

from __future__ import annotations

import warnings
from dataclasses import replace
from itertools import product

import numpy as np

from r37core.exchange.orientation import Orientation
from r37core.exchange.refusal import ImportRefused, MeshWarning
from r37core.fem.surface import outer_faces

from .ends import find_end
from .raw_mesh import RawMesh
from .tip import check_sense, find_tip_lines

_SIZE = 0.1  # m: of the mesh while its axes are looked for, whatever its unit


def find_axes(mesh: RawMesh, like: Orientation) -> Orientation | None:
    """The orientation `like` this one, but with axes along the file's own that the shape of the mesh fits; None without any.

    The rotor axis is the one about which the ends are cones. Of its two directions and the two senses of rotation one has
    leading edge and pressure side where a compressor has them. A tip without stagger or camber tells none.
    """
    size = np.ptp(mesh.points, axis=0).max()
    surface = outer_faces(mesh.blocks)
    candidates = [(_SIZE, like)]
    for axis in np.eye(3):
        middle = (mesh.points.mean(axis=0) - like.axis_point) * (1.0 - axis)
        radial = tuple(np.where(np.arange(3) == np.argmax(np.abs(middle)), np.sign(middle), 0.0).tolist())
        tried = replace(like, length_unit=_SIZE / size, rotor_axis=tuple(axis), radial=radial, rotation="negative")
        placed = tried.points_to_blade(mesh.points)
        hub, casing = (find_end(what, placed, surface) for what in ("root", "tip"))
        if hub is not None and casing is not None and hub.straight and casing.straight:
            candidates.append((hub.rule.tolerance + casing.rule.tolerance, tried))
    _, best = min(candidates, key=lambda candidate: candidate[0])
    if best is like:
        return None
    fitting = [
        turned
        for sign, rotation in product((1.0, -1.0), ("positive", "negative"))
        if _makes_sense(mesh, turned := _turned(best, sign, rotation))
    ]
    return replace(fitting[0], length_unit=like.length_unit) if len(fitting) == 1 else None


def _turned(orientation: Orientation, sign: float, rotation: str) -> Orientation:
    x, y, z = (sign * part + 0.0 for part in orientation.rotor_axis)
    return replace(orientation, rotor_axis=(x, y, z), rotation=rotation)


def _makes_sense(mesh: RawMesh, orientation: Orientation) -> bool:
    """Whether leading edge and pressure side of the tip fit the orientation, and follow from its shape."""
    placed = orientation.to_blade(mesh)
    casing = find_end("tip", placed.points, outer_faces(placed.blocks))
    if casing is None:
        return False
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", MeshWarning)
            check_sense(placed.points, find_tip_lines(placed.points, casing.faces, True), True)
    except (ImportRefused, MeshWarning):
        return False
    return True
