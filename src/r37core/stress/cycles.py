"""Cycles of a stress that changes over time: by rainflow counting. Light: jobs import it."""

from dataclasses import dataclass

import numpy as np
from numpy import ndarray


@dataclass(frozen=True)
class StressCycles:
    """Cycles of a stress: amplitude and mean (Pa), and how often each is there, 0.5 of one that does not close.

    Each of shape (cycles,).
    """

    amplitude: ndarray
    mean: ndarray
    count: ndarray


def rainflow_cycles(stress: ndarray, mean: ndarray | None = None) -> StressCycles:
    """Cycles of a `stress` (Pa) over time, shape (instants,), as ASTM E1049-85 counts them.

    `mean` (Pa), shape (instants,): of what the mean of a cycle is taken, that of its two ends; by default of the stress itself.
    """
    import rainflow

    change = np.diff(stress)
    turning = np.concatenate([[0], np.flatnonzero(change[:-1] * change[1:] <= 0.0) + 1, [len(stress) - 1]])
    level = (stress if mean is None else mean)[turning]
    counted = [
        (size, 0.5 * (level[begin] + level[end]), count)
        for size, _, count, begin, end in rainflow.extract_cycles(stress[turning])
    ]
    size, means, count = np.array(counted, dtype=float).reshape(-1, 3).T
    return StressCycles(0.5 * size, means, count)
