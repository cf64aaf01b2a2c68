"""Cycles of a stress that changes over time: by rainflow counting. Light: jobs import it."""

from dataclasses import dataclass, replace

import numpy as np

from .operator import StressOperator


@dataclass(frozen=True)
class StressCycles:
    """Cycles of a stress: amplitude and mean (Pa), and how often each is there, 0.5 of one that does not close.

    Each of shape (cycles,).
    """

    amplitude: np.ndarray
    mean: np.ndarray
    count: np.ndarray


def rainflow_cycles(stress: np.ndarray) -> StressCycles:
    """Cycles of a `stress` (Pa) over time, shape (instants,), as ASTM E1049-85 counts them."""
    import rainflow

    change = np.diff(stress)
    turning = np.flatnonzero(change[:-1] * change[1:] <= 0.0) + 1
    counted = [(size, mean, count) for size, mean, count, *_ in rainflow.extract_cycles(stress[[0, *turning, -1]])]
    size, mean, count = np.array(counted, dtype=float).reshape(-1, 3).T
    return StressCycles(0.5 * size, mean, count)


def worst_nodes(stress: StressOperator, shapes: np.ndarray) -> StressOperator:
    """The operator of those nodes alone that have the largest von Mises stress of one of the `shapes`.

    `shapes`, shape (shapes, coordinates): reduced coordinates.
    """
    nodes = np.unique(stress.von_mises(shapes).argmax(axis=1))
    places = None if stress.places is None else stress.places[nodes]
    return replace(stress, operator=stress.operator[:, nodes], places=places, is_complete=False)
