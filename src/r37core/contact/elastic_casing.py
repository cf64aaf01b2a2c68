"""All waves round an elastic casing, also those that a simulation leaves out: critical speeds, and its give under a force.

Of a ring they follow from its formula (r37core.contact.ring) for any number n of nodal diameters. With x = n^2, D = E I/R^4:

    (omega_n/n)^2 rho A = (D (x - 1)^2 + k_r + k_t/x)/(x + 1).
"""

from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import ceil, floor, sqrt

import numpy as np

from .ring import Ring, RingMode, critical_speed

MOST_LISTED = 1000
"""Nodal diameters of the shortest wave that is listed; that of a steel foil 0.1 mm thick, with a tip that moves at 500 m/s."""


@dataclass(frozen=True)
class ElasticCasing:
    """A flexible casing: `modes` that its simulations have, and the `ring` they are of; None where they are given."""

    modes: tuple[RingMode, ...]
    ring: Ring | None = None

    def modes_met(self, speed: float, frequency: float = 0.0) -> tuple[RingMode, ...]:
        """Modes in ascending order: all that simulations have, and all others that a rotor may meet.

        Those others are of a ring: waves that a rotor of at most `speed` (rad/s) sees with at most `frequency` (rad/s), or that
        it overtakes. At most MOST_LISTED nodal diameters.
        """
        if self.ring is None:
            return self.modes
        highest = min(shortest_met(self.ring, speed, frequency), MOST_LISTED)
        return replace(self.ring, highest_nodal_diameter=max(highest, self.ring.highest_nodal_diameter)).modes()

    def overtaken(self, speed: float) -> tuple[RingMode, ...]:
        """Modes whose waves a rotor of this speed (rad/s) overtakes."""
        return tuple(mode for mode in self.modes_met(speed) if mode.frequency < mode.nodal_diameter * speed)

    @property
    def critical_speed(self) -> float:
        """The lowest speed (rad/s) at which a rotor overtakes a wave, whether simulations have it or not; infinite without."""
        return critical_speed(self.modes) if self.ring is None else slowest_wave(self.ring)[1]


def shortest_met(ring: Ring, speed: float, frequency: float = 0.0) -> int:
    """Nodal diameters beyond which no wave is seen with `frequency` (rad/s) or less from a rotor of `speed` (rad/s) or less.

    As (x - 1)^2/(x + 1) > x - 3, every omega_n exceeds c (n^2 - 3) with c^2 = D/(rho A), and a wave is seen with omega_n - n
    Omega at least. So there are none where c (n^2 - 3) - n Omega > omega.
    """
    c = sqrt(ring.bending / ring.mass)
    return floor((speed + sqrt(speed**2 + 4.0 * c * (frequency + 3.0 * c))) / (2.0 * c))


def slowest_wave(ring: Ring) -> tuple[int, float]:
    """Nodal diameters of the wave that the rotor overtakes first, and the speed (rad/s) at which it does.

    The square of the speed is convex in x >= 1, and so has one minimum. It grows where
    D ((x + 1)^2 - 4) > k_r + k_t (2 x + 1)/x^2, at the latest from (x + 1)^2 = 4 + (k_r + 3 k_t)/D on.
    """
    radial, tangential = ring.radial_foundation, ring.tangential_foundation

    def square(n: int) -> float:
        return (ring.bending * (n**2 - 1.0) ** 2 + radial + tangential / n**2) / (n**2 + 1.0)

    first = 1 if radial + tangential > 0.0 else 2
    last = first + ceil((4.0 + (radial + 3.0 * tangential) / ring.bending) ** 0.25)
    number = bisect_left(range(last), True, lo=first, key=lambda n: square(n + 1) >= square(n))
    return number, sqrt(square(number) / ring.mass)


def flexibility_of(modes: Iterable[RingMode]) -> float:
    """Static flexibility (m/N) of the wall under a radial force, of these modes."""
    return float(sum(mode.radial**2 / mode.modal_mass / mode.frequency**2 for mode in modes))


def flexibility(ring: Ring) -> float:
    """Static flexibility (m/N) of the wall under a radial force, of all modes.

    Breathing, and 1/(pi R) times the sum over n of 1/(D (x - 1)^2 + k_r + k_t/x): a quotient of polynomials in x = n^2, in
    partial fractions of the sum over n of 1/(n^2 - a^2) = (1 - pi a cot(pi a))/(2 a^2). Without a foundation that of
    1/(n^2 - 1)^2 from n = 2 on is pi^2/12 - 11/16.
    """
    bending, radial, tangential = ring.bending, ring.radial_foundation, ring.tangential_foundation
    breathing = flexibility_of(ring.modes()[:1])
    if radial + tangential == 0.0:
        return breathing + (np.pi**2 / 12.0 - 11.0 / 16.0) / (np.pi * ring.radius * bending)
    # D (x - 1)^2 + k_r, and k_t/x beside it where there is one
    denominator = np.polynomial.Polynomial([bending + radial, -2.0 * bending, bending])
    numerator = np.polynomial.Polynomial([1.0])
    if tangential > 0.0:
        numerator = np.polynomial.Polynomial([0.0, 1.0])
        denominator = denominator * numerator + tangential
    roots = denominator.roots().astype(complex)
    shares = numerator(roots) / denominator.deriv()(roots)
    angles = np.pi * np.sqrt(roots)
    total = np.sum(shares * (1.0 - angles / np.tan(angles)) / (2.0 * roots)).real
    return breathing + float(total) / (np.pi * ring.radius)


ENOUGH = 0.95
"""Share of the static flexibility that the modes of a simulation hold."""

FASTEST_TIP = 550.0
"""Speed (m/s) of the fastest tips of compressors: a ring has the waves that they overtake, whichever speeds are run."""


def nodal_diameters_for(ring: Ring, speed: float, share: float = ENOUGH) -> int:
    """The fewest nodal diameters whose modes have this share of the flexibility, and all waves that the rotor overtakes.

    The rotor of at most `speed` (rad/s). MOST_LISTED at most.
    """
    modes = replace(ring, highest_nodal_diameter=MOST_LISTED).modes()
    given_way = np.cumsum([flexibility_of([mode]) for mode in modes])
    enough = modes[min(int(np.sum(given_way < share * flexibility(ring))), len(modes) - 1)]
    return max(mode.nodal_diameter for mode in (enough, *ElasticCasing((), ring).overtaken(speed)))
