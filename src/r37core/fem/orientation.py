"""Unit and axes of a file, and the way to the blade's frame and back."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key
from r37core.base.io import EntryRefused
from r37core.base.units import LENGTH_UNITS
from r37core.fem.elements import ELEMENTS
from r37core.mesh.blade_mesh import BladeMesh

Vector = tuple[float, float, float]


class OrientationError(EntryRefused):
    """Directions that are none, or parallel."""

    key = "radial"


@dataclass(frozen=True)
class Orientation:
    """How a file describes space.

    `length_unit`: a key of LENGTH_UNITS, or metres per unit.

    The blade's frame has z downstream, x radial, and a rotor that turns towards negative theta. A blade that turns the other
    way is mirrored: in an isotropic material its mirror image has the same motion, and every sign keeps its meaning.
    """

    length_unit: str | float
    rotor_axis: Annotated[Vector, Key("Downstream direction of the rotor axis, in the file's axes", ge=-1e9, le=1e9)]
    radial: Annotated[Vector, Key("Direction from the axis to the blade, in the file's axes", ge=-1e9, le=1e9)]
    rotation: Annotated[
        str, Key("Sense of the rotation about rotor_axis, by the right-hand rule", one_of=("positive", "negative"))
    ]
    axis_point: Annotated[Vector, Key("A point of the axis, in the file's unit", ge=-1e9, le=1e9)] = (0.0, 0.0, 0.0)

    @property
    def metres_per_unit(self) -> float:
        """Length of the file's unit (m)."""
        return LENGTH_UNITS[self.length_unit] if isinstance(self.length_unit, str) else self.length_unit

    def check(self) -> None:
        """Raise OrientationError where the two directions are none or parallel."""
        axis, radial = np.array(self.rotor_axis, dtype=float), np.array(self.radial, dtype=float)
        if not np.linalg.norm(np.cross(axis, radial)) > 1e-6 * np.linalg.norm(axis) * np.linalg.norm(radial):
            raise OrientationError(
                f"rotor_axis {self.rotor_axis} and radial {self.radial} must be two directions, not parallel"
            )

    @property
    def rows(self) -> ndarray:
        """Orthonormal rows x, y, z of the blade's frame in the file's axes, shape (3, 3); left-handed where mirrored.

        Raises OrientationError where the two directions are parallel.
        """
        self.check()
        axis, radial = np.array(self.rotor_axis, dtype=float), np.array(self.radial, dtype=float)
        z = axis / np.linalg.norm(axis)
        x = radial - (radial @ z) * z
        x /= np.linalg.norm(x)
        y = np.cross(z, x)
        return np.stack([x, y if self.rotation == "negative" else -y, z])

    def points_to_blade(self, points: ndarray) -> ndarray:
        """Points of the file, shape (n, 3), in metres and the blade's frame."""
        return self.metres_per_unit * (points - np.array(self.axis_point, dtype=float)) @ self.rows.T

    def to_file(self, points: ndarray) -> ndarray:
        """Points (m) of the blade's frame, shape (n, 3), in the file's unit and axes."""
        return self.vectors_to_file(points) + np.array(self.axis_point, dtype=float)

    def vectors_to_file(self, vectors: ndarray) -> ndarray:
        """Displacements (m) of the blade's frame, shape (n, 3), in the file's unit and axes."""
        return vectors @ self.rows / self.metres_per_unit

    def mesh_to_file(self, mesh: BladeMesh) -> BladeMesh:
        """The blade's mesh in the file's unit and axes, its elements the right way out there."""
        return replace(mesh, points=self.to_file(mesh.points), blocks=self.mirrored(mesh.blocks))

    def mirrored(self, blocks: Mapping[str, ndarray]) -> Mapping[str, ndarray]:
        """The elements the right way out on the other side, from the file to the blade's frame or back."""
        if np.linalg.det(self.rows) > 0.0:
            return blocks
        return {name: nodes[:, ELEMENTS[name].mirrored] for name, nodes in blocks.items()}


OURS = Orientation("m", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), "negative")
"""The blade's own frame."""
