"""An elastic casing: modes of a ring round the blade, by nodal diameter, from its dimensions or as a test gives them.

At the angle theta a mode of n nodal diameters displaces the casing by

    radially      w = radial (q_c cos n theta + q_s sin n theta),
    tangentially  v = tangential (q_s cos n theta - q_c sin n theta).

q_c and q_s are two oscillators alike. A ring that bends without being stretched has dv/dtheta + w = 0: tangential = radial/n.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key

MOST_NODAL_DIAMETERS = 100
"""Largest number of nodal diameters of a ring's modes in a simulation."""


@dataclass(frozen=True)
class RingMode:
    """Mode of the casing, in the frame that does not turn.

    Angular `frequency` (rad/s); `modal_mass` of q_c and of q_s; `radial` and `tangential`: its shape.
    """

    nodal_diameter: Annotated[int, Key("Number of waves round the circumference", ge=0, le=200)]
    frequency: Annotated[float, Key("Natural frequency of the standing casing", "_hz", ge=1e-3, le=1e7)]
    modal_mass: Annotated[float, Key("Modal mass for a radial displacement of 1 at the antinode", "_kg", ge=1e-9, le=1e9)]
    damping_ratio: Annotated[float, Key("Damping ratio of the mode", ge=0, lt=1)] = 0.005
    radial: float = 1.0
    tangential: float = 0.0


@dataclass(frozen=True)
class Ring:
    """A ring of one material on an elastic foundation.

    `radial_foundation` and `tangential_foundation`: stiffness per length of its circumference.
    """

    radius: Annotated[float, Key("Radius of the middle line, from the tip's to a quarter more", "_m", ge=1e-3, le=100)]
    thickness: Annotated[float, Key("Radial thickness, at most a fifth of the radius", "_m", ge=1e-6, le=10)]
    width: Annotated[float, Key("Axial width", "_m", ge=1e-6, le=100)]
    elastic_modulus: Annotated[float, Key("Young's modulus", "_pa", ge=1e3, le=1e15)]
    density: Annotated[float, Key("Density", "_kg_m3", ge=1e-3, le=1e6)]
    damping_ratio: Annotated[float, Key("Damping ratio of every mode", ge=0, lt=1)] = 0.005
    radial_foundation: Annotated[
        float, Key("Radial foundation stiffness per length of circumference; 0: a free ring", "_n_m2", ge=0, le=1e15)
    ] = 0.0
    tangential_foundation: Annotated[
        float, Key("Tangential foundation stiffness per length of circumference; 0: no rotation mode", "_n_m2", ge=0, le=1e15)
    ] = 0.0
    highest_nodal_diameter: Annotated[
        int,
        Key(
            "Highest nodal diameter of a mode; left out: found from the ring; too low a number is refused",
            ge=2,
            le=MOST_NODAL_DIAMETERS,
        ),
    ] = MOST_NODAL_DIAMETERS

    @property
    def mass(self) -> float:
        """Mass per length of circumference (kg/m): rho A."""
        return self.density * self.width * self.thickness

    @property
    def bending(self) -> float:
        """Stiffness against bending as that of a foundation (N/m2): E I/R^4."""
        return self.elastic_modulus * self.width * self.thickness**3 / 12.0 / self.radius**4

    def modes(self) -> tuple[RingMode, ...]:
        """Breathing, turning where a foundation holds it, and bending with 1, 2, ... nodal diameters.

        omega_0^2 = E/(rho R^2) + k_r/(rho A) of breathing, k_t/(rho A) of turning, and of bending without stretching
        omega_n^2 = (E I/R^4 n^2 (n^2 - 1)^2 + k_r n^2 + k_t)/(rho A (n^2 + 1)), with I = b t^3/12 of the area A = b t.
        Source: Timoshenko, Vibration Problems in Engineering, vibration of circular rings in their plane. A ring without a
        foundation has no mode of one nodal diameter: nothing holds it.
        """
        mass, round_mass = self.mass, 2.0 * np.pi * self.radius * self.mass
        stretching = self.elastic_modulus * self.width * self.thickness / self.radius**2
        modes = [self._mode(0, (stretching + self.radial_foundation) / mass, round_mass, 1.0, 0.0)]
        if self.tangential_foundation > 0.0:
            modes.append(self._mode(0, self.tangential_foundation / mass, round_mass, 0.0, 1.0))
        for n in range(1, self.highest_nodal_diameter + 1):
            square = self.bending * n**2 * (n**2 - 1.0) ** 2 + self.radial_foundation * n**2 + self.tangential_foundation
            if square > 0.0:
                square /= mass * (n**2 + 1.0)
                modes.append(self._mode(n, square, 0.5 * round_mass * (1.0 + 1.0 / n**2), 1.0, 1.0 / n))
        return tuple(modes)

    def _mode(self, nodal_diameter: int, square: float, mass: float, radial: float, tangential: float) -> RingMode:
        return RingMode(nodal_diameter, float(np.sqrt(square)), float(mass), self.damping_ratio, radial, tangential)


def critical_speed(modes: Sequence[RingMode]) -> float:
    """The lowest speed (rad/s) at which the rotor overtakes a wave of these modes; infinite without nodal diameters.

    Above it a wave takes energy from the rotor through the contact, and damping of the blade feeds it, too.
    """
    return min((mode.frequency / mode.nodal_diameter for mode in modes if mode.nodal_diameter), default=float("inf"))


@dataclass(frozen=True, eq=False)
class RingMotion:
    """The modes of a casing as oscillators of unit mass: all q_c, then all q_s.

    The blade's nodes are fixed in the rotor's frame, where the casing turns towards growing theta. A step turns the pair
    (q_c, q_s), its increments and nothing else: free motion and recursion are those of the frame that does not turn, with no
    stiffness lost to the rotation, at critical speeds, too.
    """

    modes: tuple[RingMode, ...]

    def _twice(self, values: Sequence[float]) -> ndarray:
        return np.tile(np.array(values, dtype=float), 2)

    @property
    def nodal_diameters(self) -> ndarray:
        """Nodal diameters of each mode, shape (modes,)."""
        return np.array([mode.nodal_diameter for mode in self.modes], dtype=float)

    @property
    def frequencies(self) -> ndarray:
        """Angular frequencies (rad/s), in the frame that does not turn, shape (2 modes,)."""
        return self._twice([mode.frequency for mode in self.modes])

    @property
    def damping_ratios(self) -> ndarray:
        """Damping ratio of each coordinate, shape (2 modes,)."""
        return self._twice([mode.damping_ratio for mode in self.modes])

    @property
    def size(self) -> ndarray:
        """Largest radial displacement per coordinate (kg^-1/2), tangential without a radial one, shape (2 modes,)."""
        return self._twice([(mode.radial or mode.tangential) / np.sqrt(mode.modal_mass) for mode in self.modes])

    def displacement(self, theta: ndarray) -> ndarray:
        """Radial, tangential and axial displacement (m) of the casing at angles (rad), per coordinate.

        `theta`, shape (nodes,). Returns shape (3, nodes, 2 modes).
        """
        radial, tangential, mass = np.array([(mode.radial, mode.tangential, mode.modal_mass) for mode in self.modes]).T
        angles = theta[:, None] * self.nodal_diameters
        cosine, sine = np.cos(angles) / np.sqrt(mass), np.sin(angles) / np.sqrt(mass)
        out = np.hstack([radial * cosine, radial * sine])
        along = np.hstack([-tangential * sine, tangential * cosine])
        return np.stack([out, along, np.zeros_like(out)])
