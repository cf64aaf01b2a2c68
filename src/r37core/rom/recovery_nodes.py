"""Nodes of a blade that move with the reduced coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy import ndarray


def cylinder(points: ndarray) -> tuple[ndarray, ndarray, ndarray]:
    """Radius (m), angle (rad) and axial position (m) of points, shape (n, 3)."""
    return np.hypot(points[:, 0], points[:, 1]), np.arctan2(points[:, 1], points[:, 0]), points[:, 2]


@dataclass(frozen=True)
class RecoveryNodes:
    """Nodes whose displacement can be recovered from the reduced coordinates.

    `nodes`: mesh node numbers, shape (n,); `points` (m), shape (n, 3); `basis`, shape (n, 3, coordinates): displacement
    (x, y, z) per unit of each reduced coordinate; `rotation_shapes` (m s2/rad2), shape (n, 3, shapes): what rotation does,
    see r37core.rom.rotation.
    """

    nodes: ndarray
    points: ndarray
    basis: ndarray
    rotation_shapes: ndarray

    @property
    def fields(self) -> ndarray:
        """Displacement per reduced coordinate, then per amplitude of rotation's shapes, shape (n, 3, coordinates + shapes)."""
        return np.concatenate([self.basis, self.rotation_shapes], axis=2)

    def select(self, which: list[int]) -> RecoveryNodes:
        """Some of the nodes, by their place."""
        return RecoveryNodes(self.nodes[which], self.points[which], self.basis[which], self.rotation_shapes[which])

    @property
    def cone_angle(self) -> float:
        """Half angle (rad) of the cone through the first and the last node, negative where it narrows downstream.

        Zero for a single node. The nodes of a tip line lie on the cone of the tip profile.
        """
        radius, _, axial = cylinder(self.points)
        length = axial[-1] - axial[0]
        return float(np.arctan((radius[-1] - radius[0]) / length)) if length != 0.0 else 0.0

    def cylindrical(self, displacement: ndarray) -> ndarray:
        """Turn displacements (..., n, 3) from x, y, z to radial, tangential (growing theta) and axial parts."""
        _, theta, _ = cylinder(self.points)
        x, y, z = np.moveaxis(displacement, -1, 0)
        cosine, sine = np.cos(theta), np.sin(theta)
        return np.stack([cosine * x + sine * y, cosine * y - sine * x, z], axis=-1)
