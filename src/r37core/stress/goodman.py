"""The Goodman line of a material. Not imported by simulations, so other strengths run none of them again."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import inf, isfinite

import numpy as np

GOODMAN = (
    "goodman_share",
    "goodman_share_median",
    "share_of_revolutions_above_goodman",
    "goodman_alternating_stress",
    "goodman_mean_stress",
)
"""Numbers of goodman_statistic."""


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
    statistic = {**asdict(strengths), **dict.fromkeys(GOODMAN, np.nan)}
    if len(share) and np.isfinite(share).all():
        largest, worst = np.maximum.reduceat(share, np.cumsum(counts) - counts), share.argmax()
        values = share[worst], np.median(largest), np.mean(largest > 1.0), alternating[worst], mean[worst]
        statistic |= dict(zip(GOODMAN, values, strict=True))
    return {name: np.array(value, dtype=float) for name, value in statistic.items()}
