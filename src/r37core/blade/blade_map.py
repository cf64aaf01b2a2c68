"""Shape of any blade as a map from (chord, span, thickness) to space, and what follows from the map alone."""

from abc import ABC, abstractmethod

import numpy as np

from .profile import BladeShapeError

_BULGE_REACH = 4.0
"""Edge radii from a round edge within which the lines chord = const are bent."""


class BladeMap(ABC):
    """Map of a blade: chord 0 (leading) to 1 (trailing edge), span 0 (hub) to 1 (tip), thickness -1 (pressure) to 1 (suction).

    `spans`: fractions at which the shape is given; `round_edges`: whether edges are closed by arcs, or cut straight;
    `thickness_sign`: 1 where the suction side is at the larger angle about the axis, -1 where the pressure side is.
    """

    spans: np.ndarray
    round_edges: bool
    thickness_sign: float = 1.0

    @abstractmethod
    def position(self, chord, span, thickness) -> np.ndarray:
        """Cartesian coordinates (m), shape (points, 3), of parameter points given as arrays of one shape (points,)."""

    def normal(self, chord, span) -> np.ndarray:
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

    def _determinant(self, chord: np.ndarray, span: np.ndarray, thickness: np.ndarray) -> np.ndarray:
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


def edge_share(distance: np.ndarray, radius: float) -> np.ndarray:
    """How far lines chord = const at a `distance` (m) from a round edge of this `radius` (m) follow its arc, 1 to 0."""
    return np.clip(1.0 - distance / (_BULGE_REACH * radius), 0.0, None) ** 2


def _composite_gauss(edges: np.ndarray, order: int) -> tuple[np.ndarray, np.ndarray]:
    nodes, weights = np.polynomial.legendre.leggauss(order)
    half = np.diff(edges) / 2.0
    points = (edges[:-1] + half)[:, None] + half[:, None] * nodes
    return points.ravel(), (half[:, None] * weights).ravel()
