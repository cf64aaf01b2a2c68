"""Check whether the tip of a blade agrees with the sense of rotation, and its concave side with the side of the pressure.

Source: velocity triangles, as in Dixon and Hall, Fluid Mechanics and Thermodynamics of Turbomachinery, chapters 4, 5 and 7. The
flow relative to a rotor runs against the rotation, at the inlet of a compressor and at the outlet of a turbine, so the
leading edge is ahead. The pressure side is the concave one. It looks along the rotation in a compressor, against it in a
turbine.
"""

from dataclasses import dataclass

import numpy as np
from numpy import ndarray

from .profile import BladeShapeError, ProfileParameters

LEAST = np.radians(5.0)
"""Stagger and camber (rad) below which the tip tells nothing: tips of fans have little camber, some of the other sign."""


@dataclass(frozen=True)
class TipSense:
    """Sense of the tip's section in the blade's frame, where the rotor turns towards negative theta.

    `stagger` (rad): from the axis to the chord, positive where the leading edge is ahead; `camber` (rad): by how much the
    camber line turns, positive where the side that looks along the rotation is concave.
    """

    stagger: float
    camber: float

    def leads(self) -> bool | None:
        """True where the leading edge is ahead in the rotation; None where that cannot be decided."""
        return _sign(self.stagger)

    def fits(self, pressure_forward: bool) -> bool | None:
        """True if the concave side is the given pressure side (`pressure_forward`: along the rotation); None as in `leads`."""
        forward = _sign(self.camber)
        return None if forward is None else forward == pressure_forward


def sense_of_line(points: ndarray) -> TipSense:
    """Sense of the line half-way between the sides: `points`, shape (n, 3), from leading to trailing edge in the blade's frame.

    The camber is that of the circular arc with the line's mean height over the chord.
    """
    radius, angle = np.hypot(points[:, 0], points[:, 1]), np.arctan2(points[:, 1], points[:, 0])
    line = np.stack([radius.mean() * (angle - angle[0]), points[:, 2] - points[0, 2]], axis=1)
    stagger = float(np.arctan2(*line[-1]))
    chord = np.linalg.norm(line[-1])
    along = line @ line[-1] / chord**2
    height = line @ np.array([np.cos(stagger), -np.sin(stagger)]) / chord
    # a flat arc is 1.5 times as high at its middle as on average
    middle = 1.5 * np.trapezoid(height, along)
    return TipSense(stagger, float(4.0 * np.arctan(2.0 * middle)))


def sense_of_profile(profile: ProfileParameters) -> TipSense:
    """Sense of a table's row: both arcs of the centreline are as steep as the mean of the angles at their ends."""
    angles = np.array([profile.inlet_angle, profile.transition_angle, profile.outlet_angle])
    lengths = np.diff([0.0, profile.transition_axial, profile.outlet_axial])
    rise = lengths @ np.tan(0.5 * (angles[1:] + angles[:-1]))
    return TipSense(float(np.arctan2(rise, profile.outlet_axial)), float(angles[0] - angles[-1]))


def check_profile_sense(profile: ProfileParameters) -> None:
    """Refuse the profile at the tip where it is a mirror image, or cambered as in a turbine, with BladeShapeError."""
    sense = sense_of_profile(profile)
    unless = "; sense_check: false takes the blade as it is"
    if sense.leads() is False:
        raise BladeShapeError(
            f"{profile.label}: found a stagger of {np.degrees(sense.stagger):.1f} degrees, so the trailing edge would lead in "
            f"the rotation; change the sign of kappa_ic, kappa_tc and kappa_oc in all rows{unless}"
        )
    if sense.fits(pressure_forward=True) is False:
        raise BladeShapeError(
            f"{profile.label}: found kappa_ic {np.degrees(profile.inlet_angle):.1f} and kappa_oc "
            f"{np.degrees(profile.outlet_angle):.1f} degrees, so the pressure side would be convex; allowed: a kappa_ic that "
            f"is not much smaller than kappa_oc, as in a compressor{unless}"
        )


def _sign(angle: float) -> bool | None:
    return None if abs(angle) < LEAST else angle > 0.0
