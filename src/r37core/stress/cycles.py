"""Alternating and mean stress of a run's revolutions, for its fatigue. Light: jobs import it.

Equivalents of Sines for multiaxial stress, as in Dowling, Mechanical Behavior of Materials: the von Mises stress of the
amplitudes, and the sum of the mean normal stresses.
"""

from dataclasses import dataclass
from functools import reduce

import numpy as np

from .operator import StressOperator


@dataclass(frozen=True)
class StressCycles:
    """Stress (Pa) of all nodes over whole revolutions: `alternating`, shape (revolutions, nodes), and `mean`, shape (nodes,).

    `alternating`: largest von Mises stress of the tensor less its mean over time, in each revolution. With the mean it does not
    depend on the axes, and is at least the radius of the smallest sphere about the path of the tensor: of a wave whose halves
    differ it is more than half of the range. `mean`: sum of the mean normal stresses, negative in compression.
    """

    alternating: np.ndarray
    mean: np.ndarray


def stress_cycles(
    stress: StressOperator, states: np.ndarray, shapes: np.ndarray, rotation: np.ndarray, per_revolution: int
) -> StressCycles:
    """Alternating and mean stress of the vibration's `states` with rotation; numbers as of largest_of_revolutions.

    All nodes at all instants, revolution by revolution, in single precision: stress is linear, so the mean is that of the
    states, and rotation changes nothing but the mean.
    """
    mean_state = states.mean(axis=0)
    parts = stress.deviatoric[:, :, : len(shapes)] @ shapes.astype(np.float32)
    vibration = (states - mean_state).astype(np.float32)

    def largest_square(revolution: np.ndarray) -> np.ndarray:
        return reduce(np.add, (np.square(revolution @ part.T) for part in parts)).max(axis=0)

    revolutions = vibration.reshape(-1, per_revolution, vibration.shape[1])
    alternating = np.sqrt(np.stack([largest_square(revolution) for revolution in revolutions]))
    mean = stress.trace[:, : len(shapes) + len(rotation)] @ np.concatenate([shapes @ mean_state, rotation])
    return StressCycles(alternating, mean.astype(np.float32))


@dataclass(frozen=True)
class LargestCycles:
    """Pairs of `alternating` and `mean` stress (Pa), shape (pairs,), of which one has the largest share of any revolution.

    `counts`, shape (revolutions,): how many pairs are of each revolution, in their order. The mean is never below 0.
    """

    alternating: np.ndarray
    mean: np.ndarray
    counts: np.ndarray


def largest_cycles(cycles: StressCycles) -> LargestCycles:
    """The pairs that can be the largest by alternating/S_f + mean/S_u in a revolution, whatever the two strengths are.

    They are the corners of the upper right convex hull of the pairs of all nodes: exact, and a few of each revolution.
    Compression counts as a mean of 0.
    """
    order = np.argsort(-cycles.mean, kind="stable")
    mean, alternating = np.maximum(cycles.mean[order], 0.0), cycles.alternating[:, order]
    highest = np.maximum.accumulate(alternating, axis=1)
    # only where it is above that of all nodes with a larger mean
    revolution, node = np.nonzero(np.diff(highest, axis=1, prepend=-1.0) > 0.0)
    mean, alternating = mean[node], alternating[revolution, node]
    while True:
        kept = _corners(revolution, mean.astype(float), alternating.astype(float))
        if kept.all():
            counts = np.bincount(revolution, minlength=len(cycles.alternating))
            return LargestCycles(alternating, mean, counts.astype(np.int32))
        revolution, mean, alternating = revolution[kept], mean[kept], alternating[kept]


def _corners(revolution: np.ndarray, mean: np.ndarray, alternating: np.ndarray) -> np.ndarray:
    """Which pairs lie above the line between their neighbours, of ascending alternating stress, in the same revolution.

    One on or below it is no corner, whatever becomes of its neighbours.
    """
    kept = np.ones(len(revolution), dtype=bool)
    fall, rise = -np.diff(mean), np.diff(alternating)
    inner = (revolution[2:] == revolution[1:-1]) & (revolution[1:-1] == revolution[:-2])
    kept[1:-1] = ~inner | (rise[:-1] * fall[1:] > rise[1:] * fall[:-1])
    return kept
