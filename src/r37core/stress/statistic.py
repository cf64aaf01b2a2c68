"""The stress of a run as a statistic of its revolutions: one scatters by a tenth on most blades in direct contact.

Apart from what simulations import: a changed statistic runs none of them again.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import inf, isfinite
from typing import Any

import numpy as np

HIGH = 0.9
"""Share of the revolutions that the high quantile is not exceeded in."""


@dataclass(frozen=True)
class Strengths:
    """Stress amplitude that a material endures at zero mean, and its tensile strength (Pa); infinite where not known."""

    fatigue_strength: float = inf
    ultimate_strength: float = inf

    @property
    def are_known(self) -> bool:
        """True where a material has a fatigue strength."""
        return isfinite(self.fatigue_strength)

    def share(self, alternating: np.ndarray, mean: np.ndarray) -> np.ndarray:
        """Share of the Goodman line, alternating/S_f + mean/S_u of stresses (Pa), compression as 0; NaN without strengths."""
        if not self.are_known:
            return np.full(np.shape(alternating), np.nan)
        tension = np.maximum(np.asarray(mean, dtype=float), 0.0)
        return np.asarray(alternating, dtype=float) / self.fatigue_strength + tension / self.ultimate_strength


UNKNOWN = Strengths()


def goodman_statistic(run: Mapping[str, np.ndarray], strengths: Strengths) -> dict[str, np.ndarray]:
    """Numbers of a run, as fatigue_numbers has them, against its material's `strengths`, which are among them.

    Largest share of all nodes and revolutions, with its two stresses (Pa), median of the largest of each revolution, and the
    share of revolutions with a node above the line. NaN of a diverged run, and without strengths.
    """
    alternating, mean, counts = run["cycle_alternating"], run["cycle_mean"], run["cycle_counts"]
    share = strengths.share(alternating, mean)
    names = ["goodman_share", "goodman_share_median", "share_of_revolutions_above_goodman"]
    names += ["goodman_alternating_stress", "goodman_mean_stress"]
    values: tuple[Any, ...] = len(names) * (np.nan,)
    if len(share) and np.isfinite(share).all():
        largest, worst = np.maximum.reduceat(share, np.cumsum(counts) - counts), share.argmax()
        values = share[worst], np.median(largest), np.mean(largest > 1.0), alternating[worst], mean[worst]
    statistic = asdict(strengths) | dict(zip(names, values, strict=True))
    return {name: np.array(value, dtype=float) for name, value in statistic.items()}


def stress_statistic(of_revolutions: np.ndarray, yield_stress: float) -> dict[str, np.ndarray]:
    """Largest, median and HIGH quantile (Pa) of the largest stress of each revolution (Pa), and the share of them above yield.

    `of_revolutions`, shape (revolutions,): of the last half of a run; NaN where there is one among them: it diverged.
    """
    ended = bool(np.isfinite(of_revolutions).all())
    median, high, ever = np.quantile(of_revolutions, (0.5, HIGH, 1.0)) if ended else 3 * (np.nan,)
    return {
        "max_von_mises_ever": np.array(ever),
        "max_von_mises_median": np.array(median),
        "max_von_mises_high": np.array(high),
        "share_of_revolutions_above_yield": np.array(np.mean(of_revolutions > yield_stress) if ended else np.nan),
    }
