"""Designs that have been tried: what is known of one once its jobs are done, and which are the best.

All are plain values, which `r37core.base.plain` carries.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

FEWEST_DONE = 3
"""Fewest built designs for a fit; with fewer, proposals stay away from all that was tried."""

Value = tuple[float, float]
"""Value of a quantity, and its standard deviation; NaN for what is not known."""

Ranges = Sequence[Sequence[float]]
"""Lowest and highest value of each number that is varied, in its unit."""


@dataclass(frozen=True)
class Design:
    """A design that has been tried.

    `values` has a number for each variable. Every one of the `objectives` is to be minimised; its standard deviation stands in
    `scatters`, 0 or NaN where it is not known. Every one of the `margins` is at least 0 where its constraint is kept. Of a
    design that could not be built objectives, scatters and margins are NaN, and `refused` says why. `round`: which proposed
    it; `quantities`: by name, as they were measured.
    """

    name: str
    values: tuple[float, ...]
    objectives: tuple[float, ...]
    scatters: tuple[float, ...]
    margins: tuple[float, ...]
    round: int = 0
    refused: str = ""
    quantities: Mapping[str, Value] = field(default_factory=dict)

    @property
    def is_done(self) -> bool:
        """True if every objective and margin is a finite number."""
        return all(map(math.isfinite, (*self.objectives, *self.margins)))

    @property
    def is_feasible(self) -> bool:
        """True if it could be built and keeps every constraint."""
        return self.is_done and all(margin >= 0 for margin in self.margins)


def shares(ranges: Ranges, values: Sequence[Sequence[float]]) -> np.ndarray:
    """Where designs [design, variable] lie in the ranges: 0 at the lowest values, 1 at the highest."""
    lowest, highest = np.transpose(ranges)
    return (np.asarray(values, dtype=float).reshape(-1, len(ranges)) - lowest) / (highest - lowest)


def designs_at(ranges: Ranges, points: np.ndarray) -> list[tuple[float, ...]]:
    """Values of the designs at `points` (shares of the ranges), in decimal steps of at most 1e-4 of each range, within it."""
    lowest, highest = np.transpose(ranges)
    width = highest - lowest
    # a range of 20 has steps of 0.001, one of 0.3 of 0.00001
    decimals = [4 - math.floor(math.log10(each)) for each in width]
    values = [list(map(round, (lowest + point * width).tolist(), decimals)) for point in points]
    return [tuple(each) for each in np.clip(np.reshape(values, (-1, len(ranges))), lowest, highest).tolist()]


def not_dominated(evaluated: Sequence[Design]) -> list[Design]:
    """The feasible designs than which no feasible one is better in an objective and as good in all, in the same order."""
    feasible = [design for design in evaluated if design.is_feasible]
    values = np.array([design.objectives for design in feasible])
    beaten = ((values <= own).all(1) & (values < own).any(1) for own in values)
    return [design for design, better in zip(feasible, beaten, strict=True) if not better.any()]


def best_first(evaluated: Sequence[Design]) -> list[Design]:
    """The feasible designs by the first objective, the lowest first.

    Of equals the one with the larger smallest margin comes first, each margin in multiples of its standard deviation over all
    designs, since units differ; then the name decides.
    """
    done = [design for design in evaluated if design.is_done]
    deviations = np.std([design.margins for design in done], axis=0) if done else np.array([])

    def rank(design: Design) -> tuple[float, float, str]:
        scaled = np.array(design.margins) / np.where(deviations > 0, deviations, 1.0)
        return design.objectives[0], -float(scaled.min(initial=np.inf)), design.name

    return sorted((design for design in done if design.is_feasible), key=rank)
