"""Shape of a blade given by section curves, as a map from (chord, span, thickness) to space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy

from r37core.blade.blade_map import BladeMap, edge_share
from r37core.blade.profile import BladeShapeError
from r37core.blade.stacking import Placement

from .section_curve import SectionCurve, cartesian

if TYPE_CHECKING:
    import xarray as xr

BEYOND = 0.05
"""Share of the height by which hub and tip may lie beyond the first and the last section."""
_TOLERANCE = 1e-12


class Meridian:
    """Radius (m) over z (m) through points (z, r): monotone cubic between them, straight beyond.

    A single point is a cylinder. Raises BladeShapeError for a curve that runs back in z.
    """

    def __init__(self, points: Sequence[tuple[float, float]] | np.ndarray):
        self.points = np.array(points, dtype=float)
        z, r = self.points.T
        if len(z) > 1 and z[0] > z[-1]:
            z, r = z[::-1], r[::-1]
        if np.any(np.diff(z) <= 0.0):
            raise BladeShapeError(
                f"the meridian runs back in z near z = {z[int(np.argmin(np.diff(z)))]:.5g} m; allowed: one radius at every z"
            )
        if len(z) == 1:
            z, r = z + np.array([0.0, 1.0]), r[[0, 0]]
        self._ends = z[[0, -1]]
        self._curve = scipy.interpolate.PchipInterpolator(z, r)
        self._slope = self._curve.derivative()

    def radius(self, z: np.ndarray) -> np.ndarray:
        """Radius (m) at axial places (m)."""
        inside = np.clip(z, *self._ends)
        return self._curve(inside) + self._slope(inside) * (z - inside)

    def slope(self, z: np.ndarray) -> np.ndarray:
        """Rise of the radius on z at axial places (m)."""
        return self._slope(np.clip(z, *self._ends))


class SectionBlade(BladeMap):
    """A blade: sections from hub to tip, each shifted by its placement, joined by a cubic spline along the span.

    `places`: fractions of the height at which the sections lie; `hub` and `tip`: surfaces that cut the blade, else its first
    and last section do. Raises BladeShapeError where sections cross, or hub or tip lies outside them.
    """

    def __init__(
        self,
        sections: Sequence[SectionCurve],
        places: np.ndarray,
        placement: Placement,
        hub: Meridian | None,
        tip: Meridian | None,
        round_edges: bool,
        pressure_forward: bool = True,
    ):
        self.sections, self.places, self.placement = list(sections), places, placement
        self.hub, self.tip = hub, tip
        self.spans = np.array([0.0, *places[(places > 0.0) & (places < 1.0)], 1.0])
        self.round_edges = round_edges
        self.thickness_sign = 1.0 if pressure_forward else -1.0
        # a spline through fewer sections than four is of lower order
        order = min(3, len(places) - 1)
        self._weights = scipy.interpolate.make_interp_spline(places, np.eye(len(places)), k=order)
        self._slopes = self._weights.derivative()
        self._check_orientation()

    @property
    def pressure_forward(self) -> bool:
        """True where the pressure side looks along the rotation, as in a compressor."""
        return self.thickness_sign > 0.0

    def position(self, chord, span, thickness) -> np.ndarray:
        """Cartesian coordinates (m), shape (points, 3), of parameter points given as arrays of one shape (points,)."""
        chord, span, thickness = (np.atleast_1d(np.asarray(a, dtype=float)) for a in (chord, span, thickness))
        # (r, theta, z) of each point in every section, shape (sections, 3, points)
        lines = np.array([self._section_points(number, chord, thickness) for number in range(len(self.sections))])
        first = np.zeros(len(span)) if self.hub is None else self._met(lines, self.hub, 0.0, "hub")
        last = np.ones(len(span)) if self.tip is None else self._met(lines, self.tip, 1.0, "tip")
        return cartesian(np.einsum("ps,scp->cp", self._weights(first + span * (last - first)), lines).T)

    def _section_points(self, number: int, chord: np.ndarray, thickness: np.ndarray) -> np.ndarray:
        """(r, theta, z) in one section, shape (3, points): straight from side to side, bent outwards at round edges."""
        section, share = self.sections[number], 0.5 * (1.0 + thickness)
        # points share few chords: along the span of a grid, through the thickness of a mesh
        chords, inverse = np.unique(chord, return_inverse=True)
        pressure, suction = (side.point(chords)[:, inverse] for side in (section.pressure, section.suction))
        point = (1.0 - share) * pressure + share * suction
        if self.round_edges:
            for edge, end in ((section.leading_edge, 0.0), (section.trailing_edge, 1.0)):
                point += edge_share(np.abs(chord - end) * section.pressure.length, edge.radius) * edge.bulge(thickness)
        shift = self.placement.rotation[number], self.placement.axial[number]
        return point + np.array([0.0, *shift])[:, None]

    def _met(self, lines: np.ndarray, surface: Meridian, start: float, what: str) -> np.ndarray:
        """Places along the span, shape (points,), where lines through all sections meet a surface; Newton's method."""
        place = np.full(lines.shape[2], start)
        for _ in range(50):
            radius, _, z = np.einsum("ps,scp->cp", self._weights(place), lines)
            d_radius, _, d_z = np.einsum("ps,scp->cp", self._slopes(place), lines)
            step = (surface.radius(z) - radius) / (d_radius - surface.slope(z) * d_z)
            place = place + np.clip(step, -0.2, 0.2)
            if np.max(np.abs(step)) < _TOLERANCE:
                break
        outside = np.maximum(self.places[0] - place, place - self.places[-1])
        if not np.max(outside) <= BEYOND:
            first, last = self.sections[0].radius, self.sections[-1].radius
            height = last - first
            raise BladeShapeError(
                f"{what}: its surface lies up to {1e3 * height * np.max(outside):.3g} mm outside the sections, which reach "
                f"from {first:.5g} to {last:.5g} m; allowed: {100 * BEYOND:g}% of the height, "
                f"{1e3 * height * BEYOND:.3g} mm; give sections that reach it, or another {what}"
            )
        return place

    def described(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """Points of the sections one after the other, and what cuts them, for geometry.nc."""
        # heavy, and the configuration imports this module
        from r37core.base.variable import about

        curves = self.sections
        data: dict = {
            "section_point": (
                ("section_point_number", "axis"),
                np.concatenate([curve.file_points for curve in curves]),
                about("m", "points of the section curves"),
            ),
            "section_size": (
                "section",
                [len(curve.file_points) for curve in curves],
                about("1", "number of points of the section"),
            ),
            "place": ("section", self.places, about("1", "fraction of the height at which the section lies")),
            "axial_placement": ("section", self.placement.axial, about("m", "axial shift of the section")),
            "rotation": ("section", self.placement.rotation, about("rad", "rotation of the section about the axis")),
            "stagger": ("section", [curve.stagger for curve in curves], about("rad", "stagger angle")),
            "pressure_forward": (
                (),
                int(self.pressure_forward),
                about("1", "1 where the pressure side looks along the rotation"),
            ),
        }
        for name, surface in (("hub", self.hub), ("tip", self.tip)):
            if surface is not None:
                dims = (f"{name}_point", "meridian_axis")
                data[f"{name}_meridian"] = (dims, np.array(surface.points), about("m", f"axial place and radius of the {name}"))
        return data, {"meridian_axis": ["z", "r"]}


def section_blade(dataset: xr.Dataset) -> SectionBlade:
    """The blade of a geometry.nc with section curves."""
    places, ends = dataset["place"].values, np.cumsum(dataset["section_size"].values)
    pressure_forward = bool(dataset["pressure_forward"])
    sections = [
        SectionCurve(points, f"section {number + 1} of {len(places)} from the hub", pressure_forward)
        for number, points in enumerate(np.split(dataset["section_point"].values, ends[:-1]))
    ]
    placement = Placement(dataset["axial_placement"].values, dataset["rotation"].values)
    hub, tip = (
        Meridian(dataset[f"{name}_meridian"].values) if f"{name}_meridian" in dataset else None for name in ("hub", "tip")
    )
    return SectionBlade(sections, places, placement, hub, tip, dataset.attrs["edges"] == "round", pressure_forward)
