"""The blade as a map from (chord, span, thickness) to space."""

from collections.abc import Sequence

import numpy as np

from .blade_map import BladeMap, edge_share
from .profile import PRESSURE, SUCTION, Profile
from .stacking import Placement, span_weights


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

    def position(self, chord, span, thickness) -> np.ndarray:
        """Cartesian coordinates (m), shape (points, 3), of parameter points given as arrays of one shape (points,)."""
        chord, span, thickness = (np.atleast_1d(np.asarray(a, dtype=float)) for a in (chord, span, thickness))
        weights = self._weights(span)
        # points share few chords: along the span of a grid, through the thickness of a mesh
        chords, inverse = np.unique(chord, return_inverse=True)
        cylindrical = np.zeros((3, len(chord)))
        for i, profile in enumerate(self.profiles):
            pressure, suction = (np.array(profile.surfaces[side].point(chords))[:, inverse] for side in (PRESSURE, SUCTION))
            m, theta = self._section_point(profile, chord, thickness, pressure, suction)
            cylindrical[0] += weights[:, i] * profile.cone.radius(m)
            cylindrical[1] += weights[:, i] * (theta + self.placement.rotation[i])
            cylindrical[2] += weights[:, i] * (profile.cone.axial(m) + self.placement.axial[i])
        radius, theta, axial = cylindrical
        return np.stack([radius * np.cos(theta), radius * np.sin(theta), axial], axis=1)

    def _section_point(
        self, profile: Profile, chord: np.ndarray, thickness: np.ndarray, pressure: np.ndarray, suction: np.ndarray
    ) -> np.ndarray:
        """(m, theta) on the profile's cone: straight from side to side across the thickness, bent forward at round edges."""
        share = (1.0 + thickness) / 2.0
        point = (1.0 - share) * pressure + share * suction
        if self.round_edges:
            for edge, end in ((profile.leading_edge, 0.0), (profile.trailing_edge, 1.0)):
                fade = edge_share(np.abs(chord - end) * profile.surfaces[PRESSURE].length, edge.radius)
                pressure_side, suction_side = (np.array(edge.point(side))[:, None] for side in (-1.0, 1.0))
                straight = (1.0 - share) * pressure_side + share * suction_side
                point = point + fade * (np.array(edge.point(thickness)) - straight)
        return point
