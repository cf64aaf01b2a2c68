"""Unit and axes of a file, and the way to the blade's frame and back."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from r37core.base.declared import Key
from r37core.base.units import LENGTH_UNITS
from r37core.exchange.importing.raw_mesh import RawMesh
from r37core.fem.elements import ELEMENTS
from r37core.mesh.blade_mesh import BladeMesh

from .refusal import ImportRefused, warn_of

Vector = tuple[float, float, float]

_SPAN_BETWEEN = (1e-3, 5.0)
_USUAL_SPAN = 0.1
_TIP_RADIUS_BETWEEN = (5e-3, 10.0)
_USUAL_TIP_RADIUS = (0.01, 3.0)
"""Radii of a tip (m), from the smallest turbochargers to the last stages of steam turbines."""
_RADIAL_WITHIN = np.cos(np.radians(45.0))


def fitting_units(span: float) -> list[str]:
    """Units in which a blade of this span, in its file's numbers, has a plausible size; the likeliest first."""
    sizes = {name: span * metres for name, metres in LENGTH_UNITS.items()}
    plausible = [name for name, size in sizes.items() if _SPAN_BETWEEN[0] < size < _SPAN_BETWEEN[1]]
    return sorted(plausible, key=lambda name: abs(np.log(sizes[name] / _USUAL_SPAN)))


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
        """Raise ImportRefused where the two directions are none or parallel."""
        axis, radial = np.array(self.rotor_axis, dtype=float), np.array(self.radial, dtype=float)
        if not np.linalg.norm(np.cross(axis, radial)) > 1e-6 * np.linalg.norm(axis) * np.linalg.norm(radial):
            raise ImportRefused(
                f"rotor_axis {self.rotor_axis} and radial {self.radial} must be two directions, not parallel", "radial"
            )

    @property
    def rows(self) -> np.ndarray:
        """Orthonormal rows x, y, z of the blade's frame in the file's axes, shape (3, 3); left-handed where mirrored.

        Raises ImportRefused where the two directions are parallel.
        """
        self.check()
        axis, radial = np.array(self.rotor_axis, dtype=float), np.array(self.radial, dtype=float)
        z = axis / np.linalg.norm(axis)
        x = radial - (radial @ z) * z
        x /= np.linalg.norm(x)
        y = np.cross(z, x)
        return np.stack([x, y if self.rotation == "negative" else -y, z])

    def to_blade(self, mesh: RawMesh) -> RawMesh:
        """The mesh in metres and the blade's frame. Raises ImportRefused for a blade of no plausible size or place."""
        points = self.points_to_blade(mesh.points)
        self.check_place(points)
        return replace(mesh, points=points, blocks=self._mirrored(mesh.blocks))

    def contact_nodes_to_blade(self, points: np.ndarray) -> np.ndarray:
        """Contact nodes at the tip, shape (n, 3), in metres and the blade's frame. Raises ImportRefused as `to_blade`."""
        placed = self.points_to_blade(points)
        radius = np.hypot(placed[:, 0], placed[:, 1])
        low, high = _TIP_RADIUS_BETWEEN
        if not low <= radius.min() <= radius.max() <= high:
            raise ImportRefused(
                f"the contact nodes would lie {radius.min():.3g} to {radius.max():.3g} m from the rotor axis (allowed: {low:g} "
                f"to {high:g} m); length_unit {self.length_unit}, rotor_axis or axis_point does not fit the file",
                "length_unit",
            )
        self._check_side(placed, "the contact nodes' middle")
        self.warn_of_size(placed)
        return placed

    def warn_of_size(self, points: np.ndarray) -> None:
        """Warn of `points` (m) of the blade's frame, shape (n, 3), that reach as far from the axis as hardly any blade does."""
        tip, (low, high) = float(np.hypot(points[:, 0], points[:, 1]).max()), _USUAL_TIP_RADIUS
        if not low <= tip <= high:
            warn_of(
                f"length_unit {self.length_unit} gives a tip radius of {tip:.3g} m; those of blades are {low:g} to {high:g} m: "
                "check length_unit, rotor_axis and axis_point"
            )

    def points_to_blade(self, points: np.ndarray) -> np.ndarray:
        """Points of the file, shape (n, 3), in metres and the blade's frame."""
        return self.metres_per_unit * (points - np.array(self.axis_point, dtype=float)) @ self.rows.T

    def to_file(self, points: np.ndarray) -> np.ndarray:
        """Points (m) of the blade's frame, shape (n, 3), in the file's unit and axes."""
        return self.vectors_to_file(points) + np.array(self.axis_point, dtype=float)

    def vectors_to_file(self, vectors: np.ndarray) -> np.ndarray:
        """Displacements (m) of the blade's frame, shape (n, 3), in the file's unit and axes."""
        return vectors @ self.rows / self.metres_per_unit

    def mesh_to_file(self, mesh: BladeMesh) -> BladeMesh:
        """The blade's mesh in the file's unit and axes, its elements the right way out there."""
        return replace(mesh, points=self.to_file(mesh.points), blocks=self._mirrored(mesh.blocks))

    def _mirrored(self, blocks: Mapping[str, np.ndarray]) -> Mapping[str, np.ndarray]:
        """The elements the right way out on the other side, from the file to the blade's frame or back."""
        if np.linalg.det(self.rows) > 0.0:
            return blocks
        return {name: nodes[:, ELEMENTS[name].mirrored] for name, nodes in blocks.items()}

    def check_place(self, points: np.ndarray) -> None:
        """Raise ImportRefused where a blade at `points` (m), shape (n, 3), in its frame has no plausible size or place."""
        radius = np.hypot(points[:, 0], points[:, 1])
        span = float(np.ptp(radius))
        sizes = " x ".join(f"{size:.3g}" for size in np.ptp(points, axis=0))
        low, high = _SPAN_BETWEEN
        if not low < span < high:
            own = span / self.metres_per_unit
            fitting = [f"{name} ({own * LENGTH_UNITS[name]:.3g} m)" for name in fitting_units(own)]
            raise ImportRefused(
                f"the blade would be {sizes} m in size (radial, tangential, axial) with a span of {span:.3g} m (allowed: "
                f"{low:g} to {high:g} m); length_unit {self.length_unit} or rotor_axis does not fit the file; "
                f"fitting units: {', '.join(fitting) or 'none, give metres per unit'}",
                "length_unit",
            )
        self._check_side(points, "the blade's middle")
        if radius.max() > _TIP_RADIUS_BETWEEN[1]:
            raise ImportRefused(
                f"the blade would reach to {radius.max():.3g} m from the rotor axis (allowed: {_TIP_RADIUS_BETWEEN[1]:g} m); "
                "check axis_point, rotor_axis and length_unit",
                "axis_point",
            )
        if radius.min() < 1e-3 * span:
            raise ImportRefused("the rotor axis passes through the blade; check rotor_axis and axis_point")

    def _check_side(self, points: np.ndarray, what: str) -> None:
        mean = points.mean(axis=0)
        if not mean[0] > _RADIAL_WITHIN * np.hypot(mean[0], mean[1]):
            x, y, z = np.round(mean[:2] @ self.rows[:2] / np.hypot(mean[0], mean[1]), 3) + 0.0
            raise ImportRefused(
                f"{what} lies at {np.degrees(np.arctan2(mean[1], mean[0])):.0f} degrees round the axis from "
                f"`radial`; rotor_axis, axis_point or radial does not fit the file; fitting: radial: [{x:g}, {y:g}, {z:g}]",
                "radial",
            )


OURS = Orientation("m", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), "negative")
"""The blade's own frame."""
