"""Variables, objectives and constraints of a search, and what a design gives of them.

All are plain values, which `r37core.base.plain` carries. Light: the workflow imports this whether there is a search or not.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from r37studies.surrogate.designs import Design, Value

from .section import QuantitySection, SearchSection

QUASI_RANDOM = "quasi_random"
"""Method without a surrogate."""

START = "start"
"""Name of the design that the search starts at."""

UNKNOWN: Value = (math.nan, math.nan)


@dataclass(frozen=True)
class SearchChoice:
    """Variables, objectives and constraints of the section `entry`, whose measures are chosen.

    `start`: values of the variables that the start has, None where unknown.
    """

    entry: SearchSection
    start: tuple[float | None, ...]

    @property
    def quantities(self) -> dict[str, QuantitySection]:
        """Quantities of objectives and constraints, by name."""
        return {**self.entry.objectives, **self.entry.constraints}

    def design(
        self, name: str, values: Sequence[float | None], number: int, gave: Mapping[str, Any] | str, tried: Mapping[str, Design]
    ) -> Design:
        """The design of round `number` that `gave` quantities, or the reason why it cannot be built; `tried`: those before it.

        What is None is not known.
        """
        measured, refused = ({}, gave) if isinstance(gave, str) else (gave, "")
        quantities = {name: (_number(value), _number(scatter)) for name, (value, scatter) in measured.items()}
        objectives, scatters = zip(*(quantities.get(objective, UNKNOWN) for objective in self.entry.objectives), strict=True)
        margins = tuple(self.margins(quantities, tried[START].quantities if tried else quantities))
        return Design(name, tuple(map(_number, values)), objectives, scatters, margins, number, refused, quantities)

    def margins(self, values: Mapping[str, Value], start: Mapping[str, Value]) -> list[float]:
        """Margins by which each bound is kept, in its quantity's unit, below 0 where it is not: constraint by constraint."""
        margins = []
        for name, constraint in self.entry.constraints.items():
            value, reference = (of.get(name, UNKNOWN)[0] for of in (values, start))
            lowest, highest = constraint.bounds(reference)
            margins += [
                margin for bound, margin in ((lowest, value - lowest), (highest, highest - value)) if math.isfinite(bound)
            ]
        return margins


def _number(value: float | None) -> float:
    return math.nan if value is None else value
