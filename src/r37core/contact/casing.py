"""Shape of the casing, as the distance between undeformed blade tip and casing or lining."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key

from .laws import lobe_shape
from .ring import RingMode

_ROUNDED = 1e-5
"""Relative difference of speeds that are the same, given in rad/s and in rpm with six digits."""


@dataclass(frozen=True)
class Casing:
    """A casing that slowly becomes lobed.

    Distance = clearance - lobe_height * (1 - exp(-a t)) f(theta), with f = exp(-[((theta mod p)/p - 1/2)/width]^2),
    p = 2 pi / lobes, and a such that 99% is reached at `rise_fraction` of the run or, where they are given, after
    `rise_revolutions`. Lobes have the `height` (m) or, where that is None, `amplitude` times the clearance. `cone_angle` None:
    that of the blade's tip. Source: section 5 of the benchmark.

    The clearance is that of every speed, unless the blade or the casing grows with it. Then it is the cold one, at rest:
    `centrifugal`, the blade's static displacement is taken off; `growth` (m) of the casing is added, given at
    `growth_speeds` (rad/s), ascending, and linear between them. The lobes stay as they are.

    `change` (m) of the clearance by heat and tip wear, at `change_revolutions` of a run: linear between, constant beyond.

    `longer` (m): by how much the blade is longer than its model, as one of a rotor may be; it has so much less clearance.

    `ring`: modes of a flexible casing, which the contact forces move; without them it is rigid. `ring_radius` (m): of the ring
    that they are of, None where they are given.
    """

    clearance: Annotated[float, Key("Clearance at every speed, normal to the casing", "_m", ge=1e-6, le=0.1, optional=True)]
    lobes: Annotated[int, Key("Number of lobes; 0 is a circular casing", ge=0, le=100)] = 2
    width: Annotated[float, Key("Width of a lobe in shares of its period", ge=1e-3, le=100)] = 0.15
    amplitude: Annotated[float, Key("Height of the lobes; 2 without amplitude_m", "_clearances", ge=0, le=1000)] = 2.0
    rise_fraction: Annotated[float, Key("Share of the run in which lobes grow to 99%", ge=0, le=1)] = 0.2
    rise_revolutions: Annotated[
        float | None, Key("Revolutions in which lobes grow to 99%, in place of rise_fraction", ge=0, le=20000)
    ] = None
    cone_angle: Annotated[
        float | None,
        Key(
            "Half angle of the casing's cone, negative if it narrows downstream; tip: that of each blade's tip",
            "_deg",
            ge=-80,
            le=80,
            none="tip",
        ),
    ] = None
    height: Annotated[float | None, Key("The same, whatever the clearance", "_m", name="amplitude", ge=0, le=1)] = None
    centrifugal: bool = False
    longer: float = 0.0
    growth_speeds: tuple[float, ...] = ()
    growth: tuple[float, ...] = ()
    change_revolutions: tuple[float, ...] = ()
    change: tuple[float, ...] = ()
    ring: tuple[RingMode, ...] = ()
    ring_radius: float | None = None

    def shape(self, theta: ndarray) -> ndarray:
        """f(theta), between 0 and 1, for angles in rad."""
        if self.lobes == 0:
            return np.zeros_like(theta)
        return lobe_shape(theta, 2.0 * np.pi / self.lobes, self.width)

    def angle(self, tip_cone_angle: float) -> float:
        """Half angle (rad) of the casing's cone round a blade whose tip has `tip_cone_angle` (rad)."""
        return tip_cone_angle if self.cone_angle is None else self.cone_angle

    def rise_time(self, duration: float, revolutions: float) -> float:
        """Time (s) in which the lobes grow to 99% in a run of `duration` (s) and so many `revolutions`."""
        share = self.rise_fraction if self.rise_revolutions is None else self.rise_revolutions / revolutions
        return share * duration

    @property
    def changes_with_speed(self) -> bool:
        """True where the clearance depends on the speed."""
        return self.centrifugal or bool(self.growth)

    @property
    def lobe_height(self) -> float:
        """Height (m) of a lobe; 0 without lobes."""
        if not self.lobes:
            return 0.0
        return self.amplitude * self.clearance if self.height is None else self.height

    def lobe(self, theta: ndarray, time: ndarray, rise_time: float) -> ndarray:
        """Height (m) of the lobes, inwards, at angles (rad) and times (s); they grow to 99% in `rise_time` (s)."""
        grown = 1.0 - np.exp(-rise_rate(rise_time) * np.asarray(time)) if rise_time > 0.0 else 1.0
        return self.lobe_height * grown * self.shape(theta)

    def knows(self, speed: float) -> bool:
        """True where the casing's growth, if it has any, is given up to a speed (rad/s)."""
        return not self.growth_speeds or speed <= self.growth_speeds[-1] * (1.0 + _ROUNDED)

    def opening(self, speeds: ndarray) -> ndarray:
        """Clearance (m) that the casing's growth adds at `speeds` (rad/s), shape (speeds,).

        Raises ValueError beyond the speeds that it is given for.
        """
        if not self.growth:
            return np.zeros(len(speeds))
        if not self.knows(highest := float(np.max(speeds))):
            raise ValueError(
                f"casing.clearance.casing_growth: given up to {self.growth_speeds[-1]:g} rad/s; needed up to {highest:g} rad/s"
            )
        return np.interp(speeds, self.growth_speeds, self.growth)

    def change_at(self, revolutions: ndarray) -> ndarray:
        """Clearance (m) that so many revolutions of a run add, in their shape."""
        return np.interp(revolutions, self.change_revolutions or (0.0,), self.change or (0.0,))


def least_change(casing: Casing) -> float:
    """Smallest change (m) of a casing's clearance in a run; 0 where it does not change."""
    return min(casing.change, default=0.0)


def rise_rate(rise_time: float) -> float:
    """Rate a (1/s) at which lobes grow to 99% in `rise_time` (s); infinite when the casing is deformed from the start."""
    return -np.log(0.01) / rise_time if rise_time > 0.0 else np.inf


def approach(radius: ndarray, displacement: ndarray, cone_angle: float) -> ndarray:
    """Distance (m) by which displaced nodes come nearer to a cone about the axis, shape (...): exact for large displacements.

    cos(alpha) (sqrt((r + u_r)^2 + u_theta^2) - r) - sin(alpha) u_z of nodes at `radius` r (m), shape (...), with the radial,
    tangential and axial parts of `displacement` (m), shape (3, ...); `cone_angle` alpha (rad).
    """
    radial, tangential, axial = displacement
    outwards = np.hypot(radius + radial, tangential) - radius
    return np.cos(cone_angle) * outwards - np.sin(cone_angle) * axial


def casing_axes(cylindrical: ndarray, cone_angle: float) -> ndarray:
    """Turn radial, tangential and axial parts into those along the normal, the tangent and the meridian of a cone.

    `cylindrical`, shape (3, ...); `cone_angle` alpha (rad). Normal cos(alpha) u_r - sin(alpha) u_z, positive towards the
    casing; meridional sin(alpha) u_r + cos(alpha) u_z, positive downstream. Source: section 5 of the benchmark; drawing in
    docs/simulation.md.
    """
    radial, tangential, axial = cylindrical
    cosine, sine = np.cos(cone_angle), np.sin(cone_angle)
    return np.stack([cosine * radial - sine * axial, tangential, sine * radial + cosine * axial])
