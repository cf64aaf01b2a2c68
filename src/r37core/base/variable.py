"""Description of a variable in a file of results. Light: the simulations import it."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Variable:
    """Variable of a file's table: `dims` beyond those that a dataset adds to all, meaning, `dtype` as a dataset stores it.

    `states`: what its whole numbers mean, the last one for what was not run or is not known; each has a `text`.
    """

    dims: tuple[str, ...]
    units: str
    long_name: str
    dtype: str = "f8"
    states: type[IntEnum] | None = None

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes of the variable in a file, after the CF conventions."""
        states: list[Any] = list(self.states or ())
        flags = {"flag_values": np.array(states, "i1"), "flag_meanings": " ".join(state.text for state in states)}
        return about(self.units, self.long_name) | (flags if states else {})


def about(units: str, long_name: str) -> dict[str, str]:
    """Attributes of a variable, after the CF conventions."""
    return {"units": units, "long_name": long_name}
