"""Geometry on a cone about the rotor axis, and constant-rate paths drawn on it.

A point of the cone is given by its meridional distance `m` along the ruling from the inlet circle and its
angle `theta` about the axis. The unrolled cone is a plane, in which lengths and angles are true; every
formula below also holds for a cylinder (half angle zero).
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy import ndarray

_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(12)


def _sine_over(scale: float, angle: ndarray) -> ndarray:
    """sin(scale * angle) / scale, finite when scale goes to zero."""
    return angle * np.sinc(scale * angle / np.pi)


@dataclass(frozen=True)
class Cone:
    """A cone about the axis: radius at the inlet circle (m) and half angle (rad, positive where it widens)."""

    inlet_radius: float
    half_angle: float

    def radius(self, m):
        """Distance from the axis (m)."""
        return self.inlet_radius + np.asarray(m) * np.sin(self.half_angle)

    def axial(self, m):
        """Axial distance from the inlet circle (m)."""
        return np.asarray(m) * np.cos(self.half_angle)

    def offset(self, m, theta, angle, distance):
        """(m, theta) after going straight, on the unrolled cone, by `distance` at `angle` to the local ruling."""
        sine = np.sin(self.half_angle)
        radius = self.radius(m)
        along, across = distance * np.cos(angle), distance * np.sin(angle)
        new_radius = np.hypot(radius + sine * along, sine * across)
        new_m = m + (2.0 * radius * along + sine * distance**2) / (radius + new_radius)
        tangent = across / (radius + sine * along)
        # of a cylinder the limit
        return new_m, theta + (np.arctan(sine * tangent) / sine if abs(sine) >= 1e-12 else tangent)

    def unroll(self, m0, theta0, m, theta):
        """Distances on the unrolled cone from (m0, theta0) to (m, theta): along the ruling of the first, and normal to it."""
        sine = np.sin(self.half_angle)
        turn = theta - theta0
        radius = self.radius(m)
        # 1 - cos(a) = 2 sin(a/2)^2 keeps the digits when the cone is nearly a cylinder
        versed = 2.0 * sine * _sine_over(sine, turn / 2.0) ** 2
        along = (m - m0) * np.cos(sine * turn) - self.radius(m0) * versed
        return along, radius * _sine_over(sine, turn)


@dataclass(frozen=True)
class ConstantRatePath:
    """A path whose angle `kappa` to the local ruling grows in proportion to its length (a "circular arc on a cone").

    dkappa/ds = rate, dm/ds = cos(kappa), r dtheta/ds = sin(kappa), hence sin(kappa) is linear in m.
    Source: NASA TP-1337 multiple-circular-arc blading; Piollet, Nyssen, Batailly, rotor 37 benchmark.
    """

    cone: Cone
    m: float
    theta: float
    kappa: float
    rate: float

    @classmethod
    def between(cls, cone: Cone, m: float, theta: float, kappa: float, m_end: float, kappa_end: float):
        """The path from (m, theta, kappa) that reaches angle `kappa_end` at `m_end`. Returns (path, length)."""
        length = (m_end - m) / (np.cos((kappa + kappa_end) / 2.0) * np.sinc((kappa_end - kappa) / (2.0 * np.pi)))
        return cls(cone, m, theta, kappa, (kappa_end - kappa) / length), length

    def angle(self, s):
        """Angle to the local ruling (rad) at path length `s` (m)."""
        return self.kappa + self.rate * np.asarray(s)

    def meridional(self, s):
        """Meridional distance (m) at path length `s` (m)."""
        half_turn = self.rate * np.asarray(s) / 2.0
        return self.m + s * np.cos(self.kappa + half_turn) * np.sinc(half_turn / np.pi)

    def point(self, s):
        """(m, theta) at path length `s` (m); theta by a 12-point Gauss quadrature of sin(kappa)/r."""
        s = np.asarray(s, dtype=float)
        inner = 0.5 * s[..., None] * (_GAUSS_NODES + 1.0)
        integrand = np.sin(self.angle(inner)) / self.cone.radius(self.meridional(inner))
        theta = self.theta + 0.5 * s * (integrand @ _GAUSS_WEIGHTS)
        return self.meridional(s), theta

    def started_at(self, s: float) -> Self:
        """Path begun at its path length `s` (m)."""
        m, theta = (float(coordinate) for coordinate in self.point(s))
        return replace(self, m=m, theta=theta, kappa=float(self.angle(s)))

    def length_to(self, m: float) -> float:
        """Path length (m) from the start to meridional distance `m`; sin(kappa) is linear in m."""
        sine = np.sin(self.kappa) + self.rate * (m - self.m)
        kappa = np.arcsin(sine)
        mean = np.cos((self.kappa + kappa) / 2.0) * np.sinc((kappa - self.kappa) / (2.0 * np.pi))
        return float((m - self.m) / mean)
