"""What a search looks for, as plain numbers that a rule can hold."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from .problem import DONE, REFUSED, Evaluated, SearchVariable
from .quantity import Quantity

QUASI_RANDOM = "quasi_random"
"""Method without a surrogate."""

START = "start"
"""Name of the design that the search starts at."""

Value = tuple[float | None, float | None]
"""Value of a quantity, and its standard deviation; None for what is not known."""


@dataclass(frozen=True)
class Constraint:
    """Bounds of a quantity, in its unit; with `percent` in percent of the start's value."""

    quantity: Quantity
    lowest: float | None
    highest: float | None
    lowest_percent: float | None
    highest_percent: float | None

    def bounds(self, start: float) -> tuple[float, float]:
        """Lowest and highest value, infinite without a bound, where the start has the value `start`."""
        low = self.lowest if self.lowest_percent is None else 0.01 * self.lowest_percent * start
        high = self.highest if self.highest_percent is None else 0.01 * self.highest_percent * start
        return -math.inf if low is None else low, math.inf if high is None else high


@dataclass(frozen=True)
class SearchChoice:
    """Variables, objectives and constraints by name, and how designs are proposed; see SearchSection.

    How many are proposed is not part of it, so that more of them make none of those before anew.
    """

    variables: tuple[SearchVariable, ...]
    objectives: Mapping[str, Quantity]
    constraints: Mapping[str, Constraint]
    method: str
    seed: int

    @property
    def quantities(self) -> dict[str, Quantity]:
        """Quantities of objectives and constraints, by name."""
        return {**self.objectives, **{name: constraint.quantity for name, constraint in self.constraints.items()}}

    def margins(self, values: Mapping[str, Value], start: Mapping[str, Value]) -> list[float]:
        """Margins by which each bound is kept, in its quantity's unit, below 0 where it is not: constraint by constraint."""
        margins = []
        for name, constraint in self.constraints.items():
            value, reference = (number(of[name][0]) for of in (values, start))
            lowest, highest = constraint.bounds(reference)
            if lowest > -math.inf:
                margins.append(value - lowest)
            if highest < math.inf:
                margins.append(highest - value)
        return margins


@dataclass(frozen=True)
class Design:
    """A design that has been tried: `values` of the variables, the `round` that proposed it, and its quantities by name.

    `refused`: why it could not be built; its quantities are not there then.
    """

    values: tuple[float, ...]
    round: int
    refused: str | None
    quantities: Mapping[str, Value]

    def evaluated(self, name: str, choice: SearchChoice, start: Mapping[str, Value]) -> Evaluated:
        """The design as proposals take it."""
        if self.refused is not None:
            missing = (math.nan,) * len(choice.objectives)
            bounds = len(choice.margins(start, start))
            return Evaluated(name, self.values, missing, missing, (math.nan,) * bounds, REFUSED)
        of = [self.quantities[objective] for objective in choice.objectives]
        return Evaluated(
            name,
            self.values,
            tuple(number(value) for value, _ in of),
            tuple(number(scatter) for _, scatter in of),
            tuple(choice.margins(self.quantities, start)),
            DONE,
        )


def number(value: float | None) -> float:
    """The value; NaN for one that is not known."""
    return math.nan if value is None else value
