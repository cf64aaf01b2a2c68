"""The blades of a rotor that run on one lining. Plain numbers only, as of a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Rotor:
    """Blades whose roots stand still: all meet the same casing, and are coupled by what they wear of its lining and, where it
    is elastic, by what they bend it.

    `numbers` of the blades, from 1; `angles` (rad) at which they stand, in the sense of growing theta: the rotor turns against
    it, so a blade passes the casing after those at smaller angles. `frequency_factors`: all frequencies of a blade over those
    of the reduced model; `longer` (m): by how much a blade is longer than that. `shared_lining`: whether all wear one lining,
    or each its own.
    """

    numbers: tuple[int, ...]
    angles: tuple[float, ...]
    frequency_factors: tuple[float, ...]
    longer: tuple[float, ...]
    shared_lining: bool = True

    @property
    def order(self) -> tuple[int, ...]:
        """Places of the blades in the order in which they pass the casing; of two at one angle the first goes first."""
        return tuple(map(int, np.argsort(np.mod(self.angles, 2.0 * np.pi), kind="stable")))
