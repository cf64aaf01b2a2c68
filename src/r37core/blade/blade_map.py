"""Shape of any blade as a map from (chord, span, thickness) to space, and what follows from the map alone."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy import ndarray

from .profile import PARAMETER_UNITS, PRESSURE, SUCTION, BladeShapeError, Profile
from .stacking import Placement, conical_stacking, span_weights

_BULGE_REACH = 4.0
"""Edge radii from a round edge within which the lines chord = const are bent."""


class BladeMap(ABC):
    """Map of a blade: chord 0 (leading) to 1 (trailing edge), span 0 (hub) to 1 (tip), thickness -1 (pressure) to 1 (suction).

    `spans`: fractions at which the shape is given; `round_edges`: whether edges are closed by arcs, or cut straight;
    `thickness_sign`: 1 where the suction side is at the larger angle about the axis, -1 where the pressure side is.
    """

    spans: ndarray
    round_edges: bool
    thickness_sign: float = 1.0

    @abstractmethod
    def position(self, chord, span, thickness) -> ndarray:
        """Cartesian coordinates (m), shape (points, 3), of parameter points given as arrays of one shape (points,)."""

    @abstractmethod
    def described(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """Variables and coordinates of geometry.nc from which the blade can be made again, as xarray takes them."""

    def normal(self, chord, span) -> ndarray:
        """Unit vector from the pressure to the suction side, shape (points, 3)."""
        ones = np.ones_like(chord)
        across = self.position(chord, span, ones) - self.position(chord, span, -ones)
        return across / np.linalg.norm(across, axis=1, keepdims=True)

    def dimensions(self) -> tuple[float, float]:
        """Mean length along the chord and along the span (m), on the camber surface: the scale of the parameter plane."""
        steps = np.linspace(0.0, 1.0, 41)
        chord, span = (a.ravel() for a in np.meshgrid(steps, steps, indexing="ij"))
        points = self.position(chord, span, np.zeros_like(chord)).reshape(41, 41, 3)
        along_chord = np.linalg.norm(np.diff(points, axis=0), axis=2).sum(axis=0).mean()
        along_span = np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1).mean()
        return float(along_chord), float(along_span)

    def volume(self) -> float:
        """Volume (m3) by Gauss quadrature of the map's Jacobian determinant over the parameters."""
        # fine near the edges, where the round ends fade within about 2% of the chord
        chord_edges = np.concatenate([[0.0, 0.005, 0.01, 0.02], np.linspace(0.1, 0.9, 9), [0.98, 0.99, 0.995, 1.0]])
        chord, chord_weight = _composite_gauss(chord_edges, 4)
        span, span_weight = _composite_gauss(self.spans, 3)
        thickness, thickness_weight = _composite_gauss(np.array([-1.0, 1.0]), 8)
        determinant = self._determinant(*(a.ravel() for a in np.meshgrid(chord, span, thickness, indexing="ij")))
        weight = np.einsum("i,j,k->ijk", chord_weight, span_weight, thickness_weight).ravel()
        return float(determinant @ weight)

    def _determinant(self, chord: ndarray, span: ndarray, thickness: ndarray) -> ndarray:
        step = 1e-5
        place = np.array([chord, span, thickness])
        shifts = step * np.eye(3)[:, :, None]
        columns = [(self.position(*(place + shift)) - self.position(*(place - shift))) / (2.0 * step) for shift in shifts]
        return self.thickness_sign * np.linalg.det(np.stack(columns, axis=2))

    def _check_orientation(self) -> None:
        """The map must not fold: neighbouring profiles, or the two sides, would cross.

        (chord, span, thickness_sign * thickness) point along (z, x, y), a right-handed order, so the determinant is positive.
        """
        axes = np.linspace(0.001, 0.999, 21), np.linspace(0.005, 0.995, 60), [-0.99, 0.0, 0.99]
        chord, span, thickness = (a.ravel() for a in np.meshgrid(*axes, indexing="ij"))
        determinant = self._determinant(chord, span, thickness)
        if np.any(determinant <= 0.0):
            position = int(np.argmin(determinant))
            raise BladeShapeError(
                f"span {100 * span[position]:.1f}%: profiles or the two sides of the blade cross here "
                f"(chord {100 * chord[position]:.0f}%); check thickness, radii, sweep and lean near this span"
            )


def edge_share(distance: ndarray, radius: float) -> ndarray:
    """How far lines chord = const at a `distance` (m) from a round edge of this `radius` (m) follow its arc, 1 to 0."""
    return np.clip(1.0 - distance / (_BULGE_REACH * radius), 0.0, None) ** 2


def _composite_gauss(edges: ndarray, order: int) -> tuple[ndarray, ndarray]:
    nodes, weights = np.polynomial.legendre.leggauss(order)
    half = np.diff(edges) / 2.0
    points = (edges[:-1] + half)[:, None] + half[:, None] * nodes
    return points.ravel(), (half[:, None] * weights).ravel()


class Blade(BladeMap):
    """A blade: profiles from hub to tip, each placed on its cone, joined by a cubic spline along the span.

    Parameters run over chord 0 (leading) to 1 (trailing edge), span 0 (hub) to 1 (tip) and thickness -1 (pressure) to
    1 (suction side). Frame: z along the axis, downstream, 0 at the centre of the hub profile's leading-edge circle;
    x radial along the stacking line; the rotor turns towards negative theta (angle from x to y).

    `round_edges` closes the edges by their circles; otherwise they are cut blunt between the tangent points.
    Raises BladeShapeError when the profiles cross.
    """

    def __init__(self, profiles: Sequence[Profile], placement: Placement, round_edges: bool):
        self.profiles = list(profiles)
        self.placement = placement
        self.spans = np.array([p.parameters.span for p in self.profiles])
        self.round_edges = round_edges
        self._weights = span_weights(self.spans)
        self._check_orientation()

    def position(self, chord, span, thickness) -> ndarray:
        """Cartesian coordinates (m), shape (points, 3), of parameter points given as arrays of one shape (points,)."""
        chord, span, thickness = (np.atleast_1d(np.asarray(a, dtype=float)) for a in (chord, span, thickness))
        weights, share = self._weights(span), (1.0 + thickness) / 2.0
        # points share few chords: along the span of a grid, through the thickness of a mesh
        chords, inverse = np.unique(chord, return_inverse=True)
        cylindrical = np.zeros((3, len(chord)))
        for i, profile in enumerate(self.profiles):
            pressure, suction = (np.array(profile.surfaces[side].point(chords))[:, inverse] for side in (PRESSURE, SUCTION))
            # on the profile's cone: straight from side to side across the thickness, bent forward at round edges
            point = (1.0 - share) * pressure + share * suction
            for edge, end in ((profile.leading_edge, 0.0), (profile.trailing_edge, 1.0)) if self.round_edges else ():
                fade = edge_share(np.abs(chord - end) * profile.surfaces[PRESSURE].length, edge.radius)
                pressure_side, suction_side = (np.array(edge.point(side))[:, None] for side in (-1.0, 1.0))
                straight = (1.0 - share) * pressure_side + share * suction_side
                point = point + fade * (np.array(edge.point(thickness)) - straight)
            m, theta = point
            cylindrical[0] += weights[:, i] * profile.cone.radius(m)
            cylindrical[1] += weights[:, i] * (theta + self.placement.rotation[i])
            cylindrical[2] += weights[:, i] * (profile.cone.axial(m) + self.placement.axial[i])
        radius, theta, axial = cylindrical
        return np.stack([radius * np.cos(theta), radius * np.sin(theta), axial], axis=1)

    def described(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """Table rows, placement, section properties and surface rates of geometry.nc."""
        # heavy, and the configuration imports this module
        from r37core.base.variable import about

        data: dict = {
            name: ("profile", [getattr(p.parameters, name) for p in self.profiles], about(units, name.replace("_", " ")))
            for name, units in PARAMETER_UNITS.items()
        }
        conical = conical_stacking(self.profiles)
        data |= {
            "axial_placement": ("profile", self.placement.axial, about("m", "axial shift of the profile")),
            "rotation": ("profile", self.placement.rotation, about("rad", "rotation of the profile about the axis")),
            "conical_axial_placement": ("profile", conical.axial, about("m", "axial shift by conical stacking alone")),
            "conical_rotation": ("profile", conical.rotation, about("rad", "rotation by conical stacking alone")),
            "section_area": ("profile", [p.area for p in self.profiles], about("m2", "area on the unrolled cone")),
            "stagger": ("profile", [p.stagger for p in self.profiles], about("rad", "stagger angle")),
            "surface_rate": (
                ("profile", "side", "segment"),
                [[[p.surfaces[s].front.rate, p.surfaces[s].rear.rate] for s in (PRESSURE, SUCTION)] for p in self.profiles],
                about("rad m-1", "turning rate of the surface segment"),
            ),
        }
        return data, {"segment": ["inlet", "outlet"]}
