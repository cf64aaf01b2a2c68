"""A section of a blade as a closed curve through points: its edges, its two sides and the arcs that close them.

An edge begins where the section is as thick as twice the depth below its nose: of a circle at the points of tangency, as in
`profile.py`. A straight edge between two corners stays straight. A sharp one is cut where it has 5% of the largest thickness,
because elements need a face there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import scipy

from r37core.blade.cone import Cone
from r37core.blade.profile import BladeShapeError, area_and_centroid

_CORNER, _TIP = np.radians(60.0), np.radians(110.0)
"""Turns of the curve at a point from which on it is a corner, or the tip of a sharp edge."""
_TWO_CORNERS = np.radians(140.0)
"""Turn of both corners of a straight edge: a round edge through few points turns less at two of them."""
_PER_INTERVAL = 8
"""Samples of the curve between two points."""
_THINNEST = 0.05
"""Thickness of an edge's face, as a share of the largest thickness."""
_DEEPEST = 0.25
"""Share of the chord within which an edge has to begin."""

Point = tuple[float, float, float]


@dataclass(frozen=True)
class CurvePart:
    """Part of a section's curve: cylindrical coordinates (r, theta, z) by a spline over the share of its length."""

    spline: scipy.interpolate.CubicSpline
    length: float

    @classmethod
    def through(cls, points: np.ndarray) -> CurvePart:
        """The part through points (r, theta, z), shape (n, 3), in their order."""
        r, theta, z = points.T
        steps = np.sqrt(np.diff(r) ** 2 + np.diff(z) ** 2 + (0.5 * (r[1:] + r[:-1]) * np.diff(theta)) ** 2)
        kept = np.concatenate([[True], steps > 1e-6 * steps.sum()])
        # the end counts, whatever lies next to it
        kept[-1], kept[-2] = True, kept[-2] and steps[-1] > 1e-6 * steps.sum()
        places = np.concatenate([[0.0], np.cumsum(steps)])[kept]
        return cls(scipy.interpolate.CubicSpline(places / places[-1], points[kept]), float(places[-1]))

    def point(self, share: np.ndarray) -> np.ndarray:
        """(r, theta, z), shape (3, points), at shares (points,) of the length."""
        return self.spline(share).T


@dataclass(frozen=True)
class SectionEdge:
    """Edge of a section between its corners on the pressure and on the suction side; `arc` is None where it is straight."""

    corners: np.ndarray
    arc: CurvePart | None
    radius: float

    def bulge(self, thickness: np.ndarray) -> np.ndarray:
        """Offset (r, theta, z), shape (3, points), of the arc from the straight line between the corners."""
        if self.arc is None:
            return np.zeros((3, len(thickness)))
        share = 0.5 * (1.0 + thickness)
        straight = np.outer(self.corners[0], 1.0 - share) + np.outer(self.corners[1], share)
        return self.arc.point(share) - straight


class SectionCurve:
    """A section with its edges and sides, from the points of a closed curve.

    `points`: shape (n, 3), m, in the blade's frame, in their order either way round, the first not repeated at the end;
    `label`: for messages; `pressure_forward`: whether the pressure side looks along the rotation, towards smaller angles.
    Attributes: `cone` through the points, `outline` on it unrolled, shape (n, 2), `pressure` and `suction` side from the
    leading edge on, `leading_edge`, `trailing_edge`. Raises BladeShapeError for a curve that crosses itself or lacks an edge.
    """

    def __init__(self, points: Sequence[Point] | np.ndarray, label: str, pressure_forward: bool = True):
        self.label = label
        self.file_points = np.asarray(points, dtype=float)
        self.points = _cylindrical(self.file_points)
        self.cone, self._inlet_z = _cone_through(self.points)
        self._middle = self._meridional(0.5 * (self.points[:, 2].min() + self.points[:, 2].max())), self.points[:, 1].mean()
        self.outline = self._unrolled(self.points)
        _check_simple(self.outline, label)
        self._dense, corners = _sampled(self.points, self.outline)
        self._plane = self._unrolled(self._dense)
        ends = _ends(self._plane, self._dense[:, 2])
        limits = [self._edge_limits(end, other, corners) for end, other in (ends, ends[::-1])]
        self._build_parts(limits, pressure_forward)

    def _unrolled(self, cylindrical: np.ndarray) -> np.ndarray:
        """Points (r, theta, z) on the unrolled cone, shape (n, 2), seen from the middle of the points."""
        return np.stack(self.cone.unroll(*self._middle, self._meridional(cylindrical[:, 2]), cylindrical[:, 1]), axis=1)

    def _meridional(self, z):
        return (z - self._inlet_z) / np.cos(self.cone.half_angle)

    def _edge_limits(self, end: int, other: int, corners: np.ndarray) -> _EdgeLimits:
        """Where the edge at the dense point `end` meets both sides, as signed numbers of samples from its nose."""
        near = _near_end(self._plane, end, other, corners)
        if len(near) == 2:
            # the shorter way round between two corners
            count, (first, second) = len(self._plane), near.astype(float).tolist()
            if (second - first) % count > (first - second) % count:
                first, second = second, first
            second = _beyond(second, first, count)
            return _EdgeLimits(first, 0.5 * (first + second), second, False)
        limits = _thickness_limits(self._plane, end, other, bool(len(near)))
        if limits is None:
            which = "leading" if self._dense[end, 2] <= self._dense[other, 2] else "trailing"
            raise BladeShapeError(
                f"{self.label}: found no {which} edge: the curve is as thick there as it is deep; allowed: a closed curve "
                "round a blade's section"
            )
        return limits

    def _build_parts(self, limits: Sequence[_EdgeLimits], pressure_forward: bool) -> None:
        """Sides between the edges, leading edge first, and what closes them."""
        leading, trailing = limits
        count = len(self._dense)
        ahead = self._part(leading.after, _beyond(trailing.before, leading.after, count))
        back = self._part(trailing.after, _beyond(leading.before, trailing.after, count))[::-1]
        # once round counter-clockwise, the way to the trailing edge is along the side at smaller angles
        ahead_is_pressure = (area_and_centroid(*self._plane.T)[0] > 0.0) == pressure_forward
        sides = (ahead, back) if ahead_is_pressure else (back, ahead)
        self.pressure, self.suction = (CurvePart.through(side) for side in sides)
        arcs = [self._part(edge.before, _beyond(edge.after, edge.before, count)) for edge in (leading, trailing)]
        # at the leading edge the curve comes from the side that it goes back on
        arcs = [arcs[0][::-1], arcs[1]] if ahead_is_pressure else [arcs[0], arcs[1][::-1]]
        self.leading_edge, self.trailing_edge = (_edge(arc, edge.round) for arc, edge in zip(arcs, limits, strict=True))
        self._noses = _interpolated(self._dense, np.array([edge.nose for edge in limits]))

    def _part(self, first: float, last: float) -> np.ndarray:
        """Points (r, theta, z) from one place to another, upwards, shape (n, 3)."""
        inner = np.arange(int(np.floor(first)) + 1, int(np.ceil(last)))
        ends = _interpolated(self._dense, np.array([first, last]))
        return np.concatenate([ends[:1], self._dense[inner % len(self._dense)], ends[1:]])

    @cached_property
    def centroid(self) -> tuple[float, float]:
        """Centre of area on the unrolled cone, as (m, theta)."""
        _, along, across = area_and_centroid(*self._plane.T)
        m, theta = self.cone.offset(*self._middle, np.arctan2(across, along), np.hypot(along, across))
        return float(m), float(theta)

    @property
    def radius(self) -> float:
        """Distance of the centre of area from the axis (m)."""
        return float(self.cone.radius(self.centroid[0]))

    @property
    def z(self) -> float:
        """Axial place of the centre of area (m)."""
        return float(self._inlet_z + self.cone.axial(self.centroid[0]))

    @property
    def stagger(self) -> float:
        """Angle (rad) to the axis of the line through the noses of both edges, seen from the centre of area."""
        return self._direction(self._noses)

    def _direction(self, ends: np.ndarray) -> float:
        """Angle (rad) to the axis of the line between two points (r, theta, z), shape (2, 3), as `Profile.stagger`."""
        (r_first, theta_first, z_first), (r_last, theta_last, z_last) = ends
        middle = self.centroid[1]
        rise = r_last * np.sin(theta_last - middle) - r_first * np.sin(theta_first - middle)
        return float(np.arctan2(rise, z_last - z_first))

    def camber_line(self, shares: np.ndarray) -> np.ndarray:
        """Points half-way between the sides, shape (n, 3), m, in the blade's frame, from leading to trailing edge."""
        return cartesian(0.5 * (self.pressure.point(shares) + self.suction.point(shares)).T)

    def rotated(self, angle: float) -> tuple[Point, ...]:
        """Points of the section turned on its cone about its centre of area, so that `angle` (rad) is added to its stagger.

        What lies off the cone stays so.
        """
        turn = angle
        for _ in range(5):
            # on the unrolled cone angles are nearly those that the stagger is measured by
            turn += angle - (self._direction(self._turned(self._noses, turn)) - self.stagger)
        return tuple(map(tuple, cartesian(self._turned(self.points, turn)).tolist()))

    def _turned(self, points: np.ndarray, angle: float) -> np.ndarray:
        """Points (r, theta, z), shape (n, 3), turned on the unrolled cone by `angle` (rad) about the centre of area."""
        r, theta, z = points.T
        m, (m_centre, theta_centre) = self._meridional(z), self.centroid
        along, across = self.cone.unroll(m_centre, theta_centre, m, theta)
        m_new, theta_new = self.cone.offset(m_centre, theta_centre, np.arctan2(across, along) + angle, np.hypot(along, across))
        r_new = self.cone.radius(m_new) + r - self.cone.radius(m)
        return np.stack([r_new, theta_new, self._inlet_z + self.cone.axial(m_new)], axis=1)


@dataclass(frozen=True)
class _EdgeLimits:
    """Places on the dense curve where an edge begins (`before`), has its nose, and ends (`after`), in the curve's direction."""

    before: float
    nose: float
    after: float
    round: bool


def _edge(arc: np.ndarray, is_round: bool) -> SectionEdge:
    """Edge of an arc from the pressure to the suction side."""
    corners = arc[[0, -1]]
    width = float(np.linalg.norm(np.diff(cartesian(corners), axis=0)))
    return SectionEdge(corners, CurvePart.through(arc) if is_round else None, 0.5 * width)


def _beyond(place: float, start: float, count: int) -> float:
    """The place, as many rounds on as put it behind `start`."""
    return start + (place - start) % count


def _cylindrical(points: np.ndarray) -> np.ndarray:
    """(r, theta, z), shape (n, 3), of points in the blade's frame; angles continue across 180 degrees."""
    x, y, z = points.T
    middle = np.arctan2(y.mean(), x.mean())
    turned = np.arctan2(y * np.cos(middle) - x * np.sin(middle), x * np.cos(middle) + y * np.sin(middle))
    return np.stack([np.hypot(x, y), middle + turned, z], axis=1)


def cartesian(points: np.ndarray) -> np.ndarray:
    """Points in the blade's frame, shape (n, 3), of (r, theta, z)."""
    r, theta, z = points.T
    return np.stack([r * np.cos(theta), r * np.sin(theta), z], axis=1)


def _cone_through(points: np.ndarray) -> tuple[Cone, float]:
    """Cone about the axis next to points (r, theta, z), and the z of its inlet circle, where the section begins."""
    r, _, z = points.T
    line = np.polynomial.Polynomial.fit(z, r, 1) if np.ptp(z) > 0.0 else np.polynomial.Polynomial([r.mean(), 0.0])
    first = float(z.min())
    rise = float(line(first + 1.0) - line(first))
    return Cone(float(line(first)), float(np.arctan(rise))), first


def _check_simple(plane: np.ndarray, label: str) -> None:
    """Raise BladeShapeError where the polygon through points, shape (n, 2), crosses itself or comes back to a point."""
    start, end = plane, np.roll(plane, -1, axis=0)
    count, along = len(plane), int(np.argmax(np.ptp(plane, axis=0)))
    low, high = np.minimum(start, end)[:, along], np.maximum(start, end)[:, along]
    order = np.argsort(low, kind="stable")
    # pieces cross only where they overlap along the section; few do, so that the cost rises with the number of points
    following = np.searchsorted(low[order], high[order], side="right") - np.arange(count) - 1
    blocks = np.searchsorted(np.cumsum(following), np.arange(10**6, following.sum(), 10**6))
    for places in np.split(np.arange(count), blocks):
        earlier = np.repeat(places, following[places])
        starts = np.repeat(np.cumsum(following[places]) - following[places], following[places])
        later = earlier + 1 + np.arange(len(earlier)) - starts
        piece, other = np.sort([order[earlier], order[later]], axis=0)
        first_sides = _side(start[piece], end[piece], start[other]) * _side(start[piece], end[piece], end[other])
        other_sides = _side(start[other], end[other], start[piece]) * _side(start[other], end[other], end[piece])
        # pieces that follow each other share a point
        apart = other - piece
        crossed = (first_sides <= 0.0) & (other_sides <= 0.0) & (apart > 1) & (apart < count - 1)
        for first, second in sorted(zip(piece[crossed].tolist(), other[crossed].tolist(), strict=True)):
            way = end[first] - start[first]
            shares = [(part[second] - start[first]) @ way / (way @ way) for part in (start, end)]
            # pieces on one straight line cross where they overlap
            if max(shares) >= 0.0 and min(shares) <= 1.0:
                raise BladeShapeError(
                    f"{label}: the curve crosses itself, between points {first + 1} and {first + 2} and points "
                    f"{second + 1} and {second + 2}; allowed: points in their order, once round"
                )


def _side(start: np.ndarray, end: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Sign of where points lie seen along lines from start to end."""
    along, across = end - start, points - start
    return np.sign(along[..., 0] * across[..., 1] - along[..., 1] * across[..., 0])


def turns(plane: np.ndarray) -> np.ndarray:
    """Angle (rad), positive counter-clockwise, by which the polygon through points, shape (n, 2), turns at each of them."""
    steps = np.roll(plane, -1, axis=0) - plane
    before = np.roll(steps, 1, axis=0)
    cross = before[:, 0] * steps[:, 1] - before[:, 1] * steps[:, 0]
    return np.arctan2(cross, np.sum(before * steps, axis=1))


def _corners(plane: np.ndarray) -> np.ndarray:
    """Numbers of points that are corners of a straight edge, or the tip of a sharp one."""
    angles, count = np.abs(turns(plane)), len(plane)
    sharp = np.flatnonzero(angles > _TIP)
    candidates = np.flatnonzero((angles > _CORNER) & (angles <= _TIP))
    paired = [
        corner
        for first, second in zip(candidates, np.roll(candidates, -1), strict=True)
        if first != second
        and angles[first] + angles[second] > _TWO_CORNERS
        # between them the edge is straight
        and np.all(angles[np.arange(first + 1, first + (second - first) % count) % count] < 0.1)
        and (second - first) % count < count // 4
        for corner in (first, second)
    ]
    return np.unique(np.concatenate([sharp, np.array(paired, dtype=int)]).astype(int))


def _sampled(points: np.ndarray, plane: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cubic splines through the points (r, theta, z) of a closed curve, sampled, and the samples that are corners.

    A spline ends at a corner. Sample i * _PER_INTERVAL is point i.
    """
    count, corners = len(points), _corners(plane)
    # once round, from the first corner where there is one
    start = corners.min(initial=count) % count
    order = (start + np.arange(count + 1)) % count
    lengths = np.linalg.norm(np.diff(plane[order], axis=0), axis=1)
    places, closed = np.concatenate([[0.0], np.cumsum(lengths)]), points[order]
    wanted = (places[:-1, None] + lengths[:, None] * (np.arange(_PER_INTERVAL) / _PER_INTERVAL)).ravel()
    if not len(corners):
        return scipy.interpolate.CubicSpline(places, closed, bc_type="periodic")(wanted), corners
    samples = np.empty((len(wanted), 3))
    for first, last in pairwise([*(corners - start), count]):
        between, part = slice(first, last + 1), slice(first * _PER_INTERVAL, last * _PER_INTERVAL)
        spline = scipy.interpolate.make_interp_spline(places[between], closed[between], k=min(3, last - first))
        samples[part] = spline(wanted[part])
    return np.roll(samples, start * _PER_INTERVAL, axis=0), corners * _PER_INTERVAL


def _ends(plane: np.ndarray, z: np.ndarray) -> tuple[int, int]:
    """Numbers of the two points, among the samples, that are farthest apart, the one upstream first."""
    points = plane[::_PER_INTERVAL]
    hull = _PER_INTERVAL * np.sort(scipy.spatial.ConvexHull(points).vertices)
    start = plane[hull[np.argmax(np.linalg.norm(plane[hull] - plane[hull[0]], axis=1))]]
    away = plane[hull] - start
    chord = away[np.argmax(np.linalg.norm(away, axis=1))]
    # of many points only those can be farthest apart that are as far from some corner of the box along the chord
    box = away @ np.array([chord, [-chord[1], chord[0]]]).T
    reach = np.linalg.norm(np.maximum(box.max(axis=0) - box, box - box.min(axis=0)), axis=1)
    hull = hull[reach >= (1.0 - 1e-9) * (chord @ chord)]
    distances = scipy.spatial.distance.cdist(plane[hull], plane[hull])
    first, second = (int(hull[number]) for number in np.unravel_index(np.argmax(distances), distances.shape))
    return (first, second) if z[first] <= z[second] else (second, first)


def _near_end(plane: np.ndarray, end: int, other: int, corners: np.ndarray) -> np.ndarray:
    """Corners that are of the edge at one end."""
    end_distance, other_distance = (np.linalg.norm(plane[corners] - plane[place], axis=1) for place in (end, other))
    near = corners[end_distance < other_distance]
    distance = np.linalg.norm(plane[near] - plane[end], axis=1)
    return near[np.argsort(distance, kind="stable")][:2]


def _thickness_limits(plane: np.ndarray, end: int, other: int, sharp: bool) -> _EdgeLimits | None:
    """Limits of a round edge where the section is as thick as twice the depth, of a `sharp` or thin one where it is cut."""
    count, chord = len(plane), float(np.linalg.norm(plane[end] - plane[other]))
    largest = 1.4 * abs(area_and_centroid(*plane.T)[0]) / chord
    thinnest = _THINNEST * largest
    depths = chord * np.concatenate([np.geomspace(1e-5, 0.02, 200), np.linspace(0.02, _DEEPEST, 201)[1:]])
    inward, nose = (plane[other] - plane[end]) / chord, end
    first = 0
    for _ in range(8):
        if not sharp:
            near = (end + np.arange(-count // 8, count // 8 + 1)) % count
            nose = int(near[np.argmin(plane[near] @ inward)])
        places = [_places_at(plane, nose, inward, depths, step) for step in (-1, 1)]
        sides = [_interpolated(plane, nose + place) for place in places]
        thickness = np.linalg.norm(sides[0] - sides[1], axis=1)
        if sharp:
            break
        begun = np.flatnonzero(thickness <= 2.0 * depths)
        if not len(begun):
            return None
        first = int(begun[0])
        if not first:
            break
        middle = 0.5 * (sides[0][first] + sides[1][first]) - plane[nose]
        inward = middle / np.linalg.norm(middle)
    is_round = first > 0 and thickness[first] >= thinnest
    if is_round:
        # between two of the depths
        excess = thickness[first - 1 : first + 1] - 2.0 * depths[first - 1 : first + 1]
        share = excess[0] / (excess[0] - excess[1])
        before, after = (place[first - 1] + share * (place[first] - place[first - 1]) for place in places)
    else:
        thick = np.flatnonzero(thickness >= thinnest)
        if not len(thick):
            return None
        before, after = (place[thick[0]] for place in places)
    return _EdgeLimits(nose + float(before), float(nose), nose + float(after), is_round)


def _places_at(plane: np.ndarray, nose: int, inward: np.ndarray, depths: np.ndarray, step: int) -> np.ndarray:
    """Signed numbers of samples from the nose, one way, at which the curve first lies as deep as `depths`."""
    count = len(plane)
    numbers = step * np.arange(count // 2)
    depth = np.maximum.accumulate((plane[(nose + numbers) % count] - plane[nose]) @ inward)
    # a depth that is reached once counts at its first place
    rising = np.concatenate([[True], np.diff(depth) > 0.0])
    return np.interp(depths, depth[rising], numbers[rising].astype(float))


def _interpolated(samples: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Points at places of the samples of a closed curve, linear between them."""
    low = np.floor(places).astype(int)
    share = (places - low)[:, None]
    return (1.0 - share) * samples[low % len(samples)] + share * samples[(low + 1) % len(samples)]
