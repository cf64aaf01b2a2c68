"""The best of the tried designs, without regard to scatter: an order by one objective, and those that none beats in several."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .problem import Evaluated


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
