"""Variables of a search, what is known of a design once its jobs are done, and which designs are the best.

All are plain values, which `r37core.plain` carries. Light: the workflow imports this whether there is a search or not.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

DONE, REFUSED = "done", "refused"

FEWEST_DONE = 3
"""Fewest built designs for a fit; with fewer, proposals stay away from all that was tried."""


@dataclass(frozen=True)
class SearchVariable:
    """A number of the blade and the range that is searched; any unit. Raises ValueError for a range without a width."""

    key: str
    lowest: float
    highest: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.lowest) and math.isfinite(self.highest) and self.lowest < self.highest):
            raise ValueError(f"{self.key}: found {self.lowest} to {self.highest}; needed: two numbers, the lower first")


@dataclass(frozen=True)
class Evaluated:
    """A design that has been tried.

    `values` has a number for each variable. Every one of the `objectives` is to be minimised; its standard deviation stands in
    `scatters`, 0 or NaN where it is not known. Every one of the `margins` is at least 0 where its constraint is kept. With the
    status "refused" the design could not be built: objectives, scatters and margins are NaN.
    """

    name: str
    values: tuple[float, ...]
    objectives: tuple[float, ...]
    scatters: tuple[float, ...]
    margins: tuple[float, ...]
    status: str

    @property
    def is_done(self) -> bool:
        """Whether there is a finite number for every objective and margin."""
        return self.status == DONE and all(map(math.isfinite, (*self.objectives, *self.margins)))

    @property
    def is_feasible(self) -> bool:
        """Whether it could be built and keeps every constraint."""
        return self.is_done and all(margin >= 0 for margin in self.margins)


def shares(variables: Sequence[SearchVariable], values: Sequence[Sequence[float]]) -> np.ndarray:
    """Where designs [design, variable] lie in the ranges: 0 at the lowest values, 1 at the highest."""
    lowest, width = _ranges(variables)
    return (np.asarray(values, dtype=float).reshape(-1, len(variables)) - lowest) / width


def designs_at(variables: Sequence[SearchVariable], points: np.ndarray) -> list[tuple[float, ...]]:
    """Values of the designs at `points` (shares of the ranges), in decimal steps of at most 1e-4 of each range, within it."""
    lowest, width = _ranges(variables)
    # a range of 20 has steps of 0.001, one of 0.3 of 0.00001
    decimals = [4 - math.floor(math.log10(each)) for each in width]
    return [
        tuple(
            min(max(round(float(value), places), variable.lowest), variable.highest)
            for value, places, variable in zip(lowest + point * width, decimals, variables, strict=True)
        )
        for point in points
    ]


def _ranges(variables: Sequence[SearchVariable]) -> tuple[np.ndarray, np.ndarray]:
    lowest = np.array([variable.lowest for variable in variables])
    return lowest, np.array([variable.highest for variable in variables]) - lowest


def not_dominated(evaluated: Sequence[Evaluated]) -> list[Evaluated]:
    """The feasible designs than which no feasible one is better in an objective and as good in all, in the same order."""
    feasible = [design for design in evaluated if design.is_feasible]
    values = np.array([design.objectives for design in feasible])
    return [
        design
        for design, own in zip(feasible, values, strict=True)
        if not np.any((values <= own).all(1) & (values < own).any(1))
    ]


def best_first(evaluated: Sequence[Evaluated], objective: int = 0) -> list[Evaluated]:
    """The feasible designs by one objective, the lowest first.

    Of equals the one with the larger smallest margin comes first, each margin in multiples of its standard deviation over all
    designs, since units differ; then the name decides.
    """
    done = [design for design in evaluated if design.is_done]
    deviations = np.std([design.margins for design in done], axis=0) if done else np.array([])

    def rank(design: Evaluated) -> tuple[float, float, str]:
        scaled = np.array(design.margins) / np.where(deviations > 0, deviations, 1.0)
        return design.objectives[objective], -float(scaled.min(initial=np.inf)), design.name

    return sorted((design for design in done if design.is_feasible), key=rank)
