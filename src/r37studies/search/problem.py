"""Variables, objectives and constraints of a search, and what a design gives of them.

All are plain values, which `r37core.base.plain` carries. Light: the workflow imports this whether there is a search or not.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from r37studies.surrogate.designs import Design, SearchVariable, Value

from .quantity import Quantity

QUASI_RANDOM = "quasi_random"
"""Method without a surrogate."""

START = "start"
"""Name of the design that the search starts at."""

UNKNOWN: Value = (math.nan, math.nan)


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

    `start`: values of the variables that the start has, None where unknown. How many designs are proposed is not part of it, so
    that more of them make none of those before anew.
    """

    variables: tuple[SearchVariable, ...]
    objectives: Mapping[str, Quantity]
    constraints: Mapping[str, Constraint]
    method: str
    seed: int
    start: tuple[float | None, ...]

    @property
    def quantities(self) -> dict[str, Quantity]:
        """Quantities of objectives and constraints, by name."""
        return {**self.objectives, **{name: constraint.quantity for name, constraint in self.constraints.items()}}

    def design(
        self, name: str, values: Sequence[float | None], number: int, gave: Mapping[str, Any] | str, tried: Mapping[str, Design]
    ) -> Design:
        """The design of round `number` that `gave` quantities, or the reason why it cannot be built; `tried`: those before it.

        What is None is not known.
        """
        measured, refused = ({}, gave) if isinstance(gave, str) else (gave, "")
        quantities = {name: (_number(value), _number(scatter)) for name, (value, scatter) in measured.items()}
        objectives, scatters = zip(*(quantities.get(objective, UNKNOWN) for objective in self.objectives), strict=True)
        margins = tuple(self.margins(quantities, tried[START].quantities if tried else quantities))
        return Design(name, tuple(map(_number, values)), objectives, scatters, margins, number, refused, quantities)

    def margins(self, values: Mapping[str, Value], start: Mapping[str, Value]) -> list[float]:
        """Margins by which each bound is kept, in its quantity's unit, below 0 where it is not: constraint by constraint."""
        margins = []
        for name, constraint in self.constraints.items():
            value, reference = (of.get(name, UNKNOWN)[0] for of in (values, start))
            lowest, highest = constraint.bounds(reference)
            if lowest > -math.inf:
                margins.append(value - lowest)
            if highest < math.inf:
                margins.append(highest - value)
        return margins


def _number(value: float | None) -> float:
    return math.nan if value is None else value
