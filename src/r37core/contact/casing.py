"""Shape of the casing, as the distance between undeformed blade tip and casing or lining."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Casing:
    """A casing that slowly becomes lobed.

    Distance = clearance - amplitude * clearance * (1 - exp(-a t)) f(theta), with
    f = exp(-[((theta mod p)/p - 1/2)/width]^2), p = 2 pi / lobes, and a such that 99% is reached at `rise_fraction` of the
    run. `clearance` in m, `amplitude` in clearances; no lobes: a circular casing. Source: section 5 of the benchmark.
    """

    clearance: float
    lobes: int = 2
    width: float = 0.15
    amplitude: float = 2.0
    rise_fraction: float = 0.2

    def shape(self, theta: np.ndarray) -> np.ndarray:
        """f(theta), between 0 and 1, for angles in rad."""
        if self.lobes == 0:
            return np.zeros_like(theta)
        period = 2.0 * np.pi / self.lobes
        return np.exp(-((((theta % period) / period - 0.5) / self.width) ** 2))

    def rise_rate(self, duration: float) -> float:
        """The rate a (1/s) for a run of `duration` (s); infinite when the casing is deformed from the start."""
        return -np.log(0.01) / (self.rise_fraction * duration) if self.rise_fraction > 0.0 else np.inf

    def distance(self, theta: np.ndarray, time: np.ndarray, duration: float) -> np.ndarray:
        """Distance (m) between tip and casing or lining at angles (rad) and times (s) of a run of `duration` (s)."""
        grown = 1.0 - np.exp(-self.rise_rate(duration) * np.asarray(time)) if self.rise_fraction > 0.0 else 1.0
        return self.clearance * (1.0 - self.amplitude * grown * self.shape(theta))
