"""A blade profile: multiple circular arcs on a cone, closed by edge circles.

Source: section 2 of the benchmark; Piollet, Nyssen, Batailly, "Blade/casing rubbing interactions in aircraft
engines: numerical benchmark and design guidelines based on NASA rotor 37".
"""

from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np
import scipy
from numpy import ndarray

from .cone import Cone, ConstantRatePath

SUCTION, PRESSURE = 1, -1
_SIDES = {SUCTION: "suction", PRESSURE: "pressure"}
_QUARTER_TURN = np.pi / 2.0


class BladeShapeError(ValueError):
    """An impossible blade shape; the message names the span at fault and, where known, the blade."""


@dataclass(frozen=True)
class ProfileParameters:
    """The table row of one profile. Lengths in m, angles in rad, span as a fraction of the blade's height.

    Suffixes: inlet (ic), outlet (oc), transition between the two arcs (tc), maximum thickness (mc).
    """

    span: float
    inlet_radius: float
    outlet_radius: float
    inlet_angle: float
    transition_angle: float
    outlet_angle: float
    inlet_thickness: float
    maximum_thickness: float
    outlet_thickness: float
    maximum_thickness_axial: float
    transition_axial: float
    outlet_axial: float

    @property
    def label(self) -> str:
        """Name of the profile in messages."""
        return f"span {100 * self.span:g}%"

    def check(self) -> None:
        """Raise BladeShapeError where a radius or thickness is not positive, an angle or an axial position impossible."""
        for name in ("inlet_radius", "outlet_radius", "inlet_thickness", "maximum_thickness", "outlet_thickness"):
            if not getattr(self, name) > 0.0:
                raise BladeShapeError(f"{self.label}: {name} is {getattr(self, name):g} m; it must be positive")
        for name in ("inlet_angle", "transition_angle", "outlet_angle"):
            if not abs(getattr(self, name)) < _QUARTER_TURN:
                raise BladeShapeError(
                    f"{self.label}: {name} is {np.degrees(getattr(self, name)):g} degrees, so |sin kappa| passes 1 on "
                    "the segment; it must lie between -90 and 90 degrees"
                )
        for name in ("maximum_thickness_axial", "transition_axial"):
            if not 0.0 < getattr(self, name) < self.outlet_axial:
                raise BladeShapeError(
                    f"{self.label}: {name} is {getattr(self, name):g} m; it must lie between 0 and outlet_axial "
                    f"({self.outlet_axial:g} m)"
                )


PARAMETER_UNITS = dict.fromkeys((field.name for field in fields(ProfileParameters)), "m")
PARAMETER_UNITS |= {"span": "1", "inlet_angle": "rad", "transition_angle": "rad", "outlet_angle": "rad"}
"""Units of the parameters."""


@dataclass(frozen=True)
class DoubleArc:
    """Two constant-rate paths, `rear` from the end of `front`, and their lengths (m).

    The centreline of a profile, between the centres of its edge circles, or one of its sides, between the tangent points.
    """

    front: ConstantRatePath
    front_length: float
    rear: ConstantRatePath
    rear_length: float

    @property
    def length(self) -> float:
        """Length of both paths (m)."""
        return self.front_length + self.rear_length

    def point(self, chord):
        """(m, theta) at the fraction `chord` (0 leading, 1 trailing edge) of the length."""
        s = np.asarray(chord, dtype=float) * self.length
        is_front = s <= self.front_length
        front = self.front.point(np.where(is_front, s, self.front_length))
        rear = self.rear.point(np.where(is_front, 0.0, s - self.front_length))
        return tuple(np.where(is_front, f, r) for f, r in zip(front, rear, strict=True))

    def angle(self, chord: float) -> float:
        """Angle to the local ruling (rad) at the fraction `chord`."""
        s = chord * self.length
        if s <= self.front_length:
            return float(self.front.angle(s))
        return float(self.rear.angle(s - self.front_length))


@dataclass(frozen=True)
class EdgeCircle:
    """The circle that closes a profile: centre on the cone, radius (m), and the angles (rad, from the ruling through
    the centre) at which it meets the pressure and the suction surface; the arc between them passes the nose."""

    cone: Cone
    m: float
    theta: float
    radius: float
    pressure_direction: float
    suction_direction: float

    def point(self, thickness):
        """(m, theta) on the arc; `thickness` runs from -1 (pressure side) over 0 (nose) to 1 (suction side)."""
        share = (1.0 + np.asarray(thickness)) / 2.0
        direction = (1.0 - share) * self.pressure_direction + share * self.suction_direction
        return self.cone.offset(self.m, self.theta, direction, self.radius)


def centreline(p: ProfileParameters) -> DoubleArc:
    """The centreline on the profile's cone, from (m, theta) = (0, 0) at the centre of the leading-edge circle."""
    cone = Cone(p.inlet_radius, float(np.arctan2(p.outlet_radius - p.inlet_radius, p.outlet_axial)))
    m_transition, m_outlet = (axial / np.cos(cone.half_angle) for axial in (p.transition_axial, p.outlet_axial))
    front, front_length = ConstantRatePath.between(cone, 0.0, 0.0, p.inlet_angle, m_transition, p.transition_angle)
    theta = float(front.point(front_length)[1])
    rear, rear_length = ConstantRatePath.between(cone, m_transition, theta, p.transition_angle, m_outlet, p.outlet_angle)
    return DoubleArc(front, front_length, rear, rear_length)


class Profile:
    """A profile on its cone, built from its table row.

    Attributes: `cone`, `centreline`, `surfaces` by side (`SUCTION`, `PRESSURE`), `leading_edge` and `trailing_edge` circles.

    Raises BladeShapeError where a thickness is not positive, a point is out of order or |sin kappa| passes 1.
    """

    def __init__(self, parameters: ProfileParameters):
        self.parameters = parameters
        parameters.check()
        self.centreline = centreline(parameters)
        self.cone = self.centreline.front.cone
        self._m_outlet = parameters.outlet_axial / np.cos(self.cone.half_angle)
        self._theta_outlet = float(self.centreline.rear.point(self.centreline.rear_length)[1])
        self.surfaces = {side: self._build_surface(side) for side in (PRESSURE, SUCTION)}
        self.leading_edge, self.trailing_edge = self._build_edges()

    def _build_surface(self, side: int) -> DoubleArc:
        p = self.parameters
        thickest_in_front = p.maximum_thickness_axial < p.transition_axial
        carrier = self.centreline.front if thickest_in_front else self.centreline.rear
        m_thickest = p.maximum_thickness_axial / np.cos(self.cone.half_angle)
        s = carrier.length_to(m_thickest)
        m_centre, theta_centre = (float(v) for v in carrier.point(s))
        kappa = float(carrier.angle(s))
        m, theta = self.cone.offset(m_centre, theta_centre, kappa + side * _QUARTER_TURN, p.maximum_thickness / 2.0)
        start = ConstantRatePath(self.cone, float(m), float(theta), kappa, 0.0)

        inlet_turn = (0.0, 0.0, p.inlet_thickness / 2.0)
        outlet_turn = (self._m_outlet, self._theta_outlet, p.outlet_thickness / 2.0)
        first, first_end = self._path_tangent_to(start, side, *(inlet_turn if thickest_in_front else outlet_turn))
        junction = self._length_to_transition_normal(first, side)
        beyond = first.started_at(junction)
        second, second_end = self._path_tangent_to(beyond, side, *(outlet_turn if thickest_in_front else inlet_turn))
        if thickest_in_front:
            return DoubleArc(first.started_at(first_end), junction - first_end, second, second_end)
        return DoubleArc(second.started_at(second_end), -second_end, beyond, first_end - junction)

    def _path_tangent_to(self, start: ConstantRatePath, side: int, m: float, theta: float, radius: float):
        """The path from `start` that ends tangent to the circle (m, theta, radius). Returns (path, end length).

        Tangency on the proper side: going back along the end point's normal by the radius lands on the centre.
        """
        scale = abs(m - start.m)

        def miss(unknowns):
            path, s = replace(start, rate=unknowns[0] / scale), unknowns[1] * scale
            m_end, theta_end = path.point(s)
            back = self.cone.offset(m_end, theta_end, path.angle(s) - side * _QUARTER_TURN, radius)
            along, across = self.cone.unroll(m, theta, *back)
            return np.array([along, across]) / scale

        guess = np.array([0.0, (m - start.m) / (scale * np.cos(start.kappa))])
        solution = scipy.optimize.root(miss, guess, tol=1e-14)
        path, end = replace(start, rate=solution.x[0] / scale), float(solution.x[1] * scale)
        if np.max(np.abs(miss(solution.x))) > 1e-10 or not abs(path.angle(end)) < _QUARTER_TURN:
            raise BladeShapeError(
                f"{self.parameters.label}: no {_SIDES[side]}-side arc with |sin kappa| < 1 runs from the point of maximum "
                "thickness to the edge circle; check the angles, thicknesses and axial positions of this row"
            )
        return path, end

    def _length_to_transition_normal(self, path: ConstantRatePath, side: int) -> float:
        p, rear = self.parameters, self.centreline.rear

        def ahead(s: float) -> float:
            along, across = self.cone.unroll(rear.m, rear.theta, *path.point(s))
            return float(along * np.cos(p.transition_angle) + across * np.sin(p.transition_angle))

        guess = -ahead(0.0)
        margin = 0.2 * abs(guess) + p.maximum_thickness
        try:
            return float(scipy.optimize.brentq(ahead, guess - margin, guess + margin, xtol=1e-15))
        except ValueError:
            raise BladeShapeError(
                f"{p.label}: the {_SIDES[side]} side never meets the normal at the transition point; "
                "check z_mc_cm, z_tc_cm and the thicknesses of this row"
            ) from None

    def _build_edges(self) -> tuple[EdgeCircle, EdgeCircle]:
        p = self.parameters
        edges = []
        for chord, m, theta, radius, nose_turn in (
            (0.0, 0.0, 0.0, p.inlet_thickness / 2.0, 2.0 * np.pi),
            (1.0, self._m_outlet, self._theta_outlet, p.outlet_thickness / 2.0, 0.0),
        ):
            directions = {}
            for side, surface in self.surfaces.items():
                _, theta_end = surface.point(chord)
                turn = np.sin(self.cone.half_angle) * (float(theta_end) - theta)
                directions[side] = surface.angle(chord) + side * _QUARTER_TURN + turn
            # the arc passes the nose: behind the centre at the leading edge, ahead of it at the trailing edge
            pressure_direction = directions[PRESSURE] + nose_turn
            edges.append(EdgeCircle(self.cone, m, theta, radius, pressure_direction, directions[SUCTION]))
        return edges[0], edges[1]

    def outline(self, points_per_side: int = 1000):
        """Closed outline with round edges as (m, theta), from the leading edge along the pressure side and back."""
        chord = np.linspace(0.0, 1.0, points_per_side)
        arc = np.linspace(-1.0, 1.0, 101)
        parts = [
            self.surfaces[PRESSURE].point(chord),
            self.trailing_edge.point(arc[1:-1]),
            self.surfaces[SUCTION].point(chord[::-1]),
            self.leading_edge.point(arc[::-1][1:-1]),
        ]
        m, theta = (np.concatenate(coordinate) for coordinate in zip(*parts, strict=True))
        return m, theta

    @cached_property
    def _area_and_centroid(self) -> tuple[float, float, float]:
        m, theta = self.outline()
        area, along, across = area_and_centroid(*self.cone.unroll(0.0, 0.0, m, theta))
        direction, distance = np.arctan2(across, along), np.hypot(along, across)
        m_centroid, theta_centroid = self.cone.offset(0.0, 0.0, direction, distance)
        return abs(area), float(m_centroid), float(theta_centroid)

    @property
    def area(self) -> float:
        """Area on the unrolled cone (m2), round edges included."""
        return self._area_and_centroid[0]

    @property
    def centroid(self) -> tuple[float, float]:
        """Centre of area on the unrolled cone, as (m, theta)."""
        return self._area_and_centroid[1:]

    @property
    def stagger(self) -> float:
        """Angle (rad) of the line through the centreline's end points to the axis: arctan((y_oc - y_ic)/(z_oc - z_ic))."""
        p = self.parameters
        # the blade is stacked with the centre of area at theta = 0
        theta_inlet, theta_outlet = -self.centroid[1], self._theta_outlet - self.centroid[1]
        rise = p.outlet_radius * np.sin(theta_outlet) - p.inlet_radius * np.sin(theta_inlet)
        return float(np.arctan2(rise, p.outlet_axial))


def area_and_centroid(x: ndarray, y: ndarray) -> tuple[float, float, float]:
    """Signed area (positive counter-clockwise) and centre of area of the closed polygon with corners (x, y).

    Shoelace formula, about the mean corner to keep the digits of a small polygon far from the origin.
    """
    x_mean, y_mean = float(np.mean(x)), float(np.mean(y))
    x, y = x - x_mean, y - y_mean
    x_next, y_next = np.roll(x, -1), np.roll(y, -1)
    cross = x * y_next - x_next * y
    area = 0.5 * float(np.sum(cross))
    x_centroid = float(np.sum((x + x_next) * cross)) / (6.0 * area)
    y_centroid = float(np.sum((y + y_next) * cross)) / (6.0 * area)
    return area, x_mean + x_centroid, y_mean + y_centroid
