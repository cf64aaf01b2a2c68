"""The stress of a run as a statistic of its revolutions: one scatters by a tenth on most blades in direct contact.

Apart from what simulations import: a changed statistic runs none of them again.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

import numpy as np
from numpy import ndarray

from .cycles import StressCycles

HIGH = 0.9
"""Share of the revolutions that the high quantile is not exceeded in."""


@dataclass(frozen=True)
class Strengths:
    """Stress amplitude that a material endures at zero mean, and its tensile strength (Pa); infinite where not known.

    It endures that amplitude for so many `cycles`, and others by the `exponent` of its S-N line, infinite where not known.
    """

    fatigue_strength: float = inf
    ultimate_strength: float = inf
    cycles: float = 1e7
    exponent: float = inf

    @property
    def are_known(self) -> bool:
        """True where a material has a fatigue strength."""
        return isfinite(self.fatigue_strength)

    @property
    def have_line(self) -> bool:
        """True where a material has an S-N line."""
        return isfinite(self.exponent)

    def share(self, alternating: ndarray, mean: ndarray) -> ndarray:
        """Share of the Goodman line, alternating/S_f + mean/S_u of stresses (Pa), compression as 0; NaN without strengths."""
        if not self.are_known:
            return np.full(np.shape(alternating), np.nan)
        tension = np.maximum(np.asarray(mean, dtype=float), 0.0)
        return np.asarray(alternating, dtype=float) / self.fatigue_strength + tension / self.ultimate_strength

    def miner_sum(self, cycles: StressCycles) -> float:
        """Share of the life that cycles use, by Palmgren and Miner; NaN without an S-N line.

        Of so many cycles N of an amplitude S_a and a mean S_m, compression as 0, by Goodman and Basquin:
        n/N with N = N_f (S_f/S)^k and S = S_a/(1 - S_m/S_u). There is no amplitude below which a cycle does no damage.
        """
        if not self.have_line:
            return np.nan
        left = 1.0 - np.maximum(cycles.mean, 0.0) / self.ultimate_strength
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            amplitude = np.where(left > 0.0, cycles.amplitude / np.maximum(left, 0.0), np.inf)
            return float(np.sum(cycles.count / self.cycles * (amplitude / self.fatigue_strength) ** self.exponent))


UNKNOWN = Strengths()


def goodman_statistic(run: Mapping[str, ndarray], strengths: Strengths) -> dict[str, ndarray]:
    """Numbers of a run, as fatigue_numbers has them, against its material's `strengths`, which are among them.

    Of each region the largest share of all nodes and revolutions, with its two stresses (Pa); of the later revolutions the
    median of the largest of each, and the share of those with a node above the line. NaN of a diverged run, and without
    strengths.
    """
    later = int(run["statistic_revolutions"])
    rows = [_goodman(alternating, mean, counts, strengths, later) for alternating, mean, counts in _cycles_of_regions(run)]
    names = ["goodman_share", "goodman_share_median", "share_of_revolutions_above_goodman"]
    names += ["goodman_alternating_stress", "goodman_mean_stress"]
    limits = {name: np.array(getattr(strengths, name)) for name in ("fatigue_strength", "ultimate_strength")}
    return limits | dict(zip(names, np.array(rows, dtype=float).T, strict=True))


def goodman_history(run: Mapping[str, ndarray], strengths: Strengths) -> ndarray:
    """Largest share of the Goodman line of all nodes in each revolution, shape (regions, revolutions); none if it diverged."""
    return np.stack([_largest_shares(strengths.share(*pair), counts) for *pair, counts in _cycles_of_regions(run)])


def _cycles_of_regions(run: Mapping[str, ndarray]) -> Iterator[tuple[ndarray, ...]]:
    """Alternating and mean stress (Pa) of the largest cycles of each region, and their number in each revolution."""
    ends = np.cumsum(run["cycle_counts"].sum(axis=1))[:-1]
    return zip(np.split(run["cycle_alternating"], ends), np.split(run["cycle_mean"], ends), run["cycle_counts"], strict=True)


def _largest_shares(share: ndarray, counts: ndarray) -> ndarray:
    """The largest of the shares of each revolution, which has so many of them."""
    return np.maximum.reduceat(share, np.cumsum(counts) - counts) if len(share) else share


def _goodman(alternating: ndarray, mean: ndarray, counts: ndarray, strengths: Strengths, later: int) -> tuple[Any, ...]:
    """Numbers of one region, medians and shares over so many later revolutions."""
    share = strengths.share(alternating, mean)
    if not len(share) or not np.isfinite(share).all():
        return 5 * (np.nan,)
    last, worst = _largest_shares(share, counts)[-later:], share.argmax()
    return share[worst], np.median(last), np.mean(last > 1.0), alternating[worst], mean[worst]


def stress_statistic(of_revolutions: ndarray, yield_stress: float) -> dict[str, ndarray]:
    """Median and HIGH quantile (Pa) of the largest stress of each revolution (Pa), and the share of them above yield.

    `of_revolutions`, shape (..., revolutions): of the last half of a run; NaN where there is one among them: it diverged.
    """
    ended = np.isfinite(of_revolutions).all(axis=-1)
    median, high = np.quantile(of_revolutions, (0.5, HIGH), axis=-1)
    return {
        "max_von_mises_median": np.where(ended, median, np.nan),
        "max_von_mises_high": np.where(ended, high, np.nan),
        "share_of_revolutions_above_yield": np.where(ended, np.mean(of_revolutions > yield_stress, axis=-1), np.nan),
    }
