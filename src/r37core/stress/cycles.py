"""Cycles of a stress that changes over time: by rainflow counting. Light: jobs import it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .operator import StressOperator

if TYPE_CHECKING:
    from .statistic import Strengths

_COUNTED = 24
"""Nodes that are counted of each kind: that reach farthest, and that are farthest on average."""


@dataclass(frozen=True)
class StressCycles:
    """Cycles of a stress: amplitude and mean (Pa), and how often each is there, 0.5 of one that does not close.

    Each of shape (cycles,).
    """

    amplitude: np.ndarray
    mean: np.ndarray
    count: np.ndarray


def rainflow_cycles(stress: np.ndarray, mean: np.ndarray | None = None) -> StressCycles:
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


def operator_numbers(stress: StressOperator, states: np.ndarray, shapes: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """Numbers that the operator maps to stress, shape (instants, numbers), in single precision.

    `states`, shape (instants, modes), and their `shapes`, shape (coordinates, modes): of the vibration; `rotation`, shape
    (instants, shapes): amplitudes of rotation's shapes.
    """
    states, shapes = stress.band_part(states, shapes)
    return np.concatenate([states @ shapes.T, rotation], axis=1).astype(np.float32)


def largest_damage(stress: StressOperator, numbers: np.ndarray, strengths: Strengths) -> tuple[float, float]:
    """Largest range of the stress (Pa) of all nodes, and the largest Miner's sum of those that may have it: NaN without a line.

    `numbers`: operator_numbers over time. At a node the path of the deviator, in parts whose length is the von Mises stress, is
    counted along the direction in which it varies most; the mean of a cycle is that of the sum of the normal stresses, as in
    r37core.stress.revolutions. Those nodes are counted whose path reaches farthest from its mean, or is farthest from it on
    average, both with their means by Goodman's line.
    """
    traces = stress.trace[:, : numbers.shape[1]]
    left = np.maximum(1.0 - np.maximum(traces @ numbers.mean(axis=0, dtype=float), 0.0) / strengths.ultimate_strength, 1e-9)
    farthest, average, ranges = (np.zeros(len(traces)) for _ in range(3))
    for node in range(len(traces)):
        path, direction = _path(stress, numbers, node)
        ranges[node] = np.ptp(path @ direction)
        if strengths.have_line:
            distance = np.linalg.norm(path, axis=1)
            largest = max(float(distance.max()), 1e-30)
            share = float(np.mean((distance / largest) ** strengths.exponent)) ** (1.0 / strengths.exponent)
            farthest[node], average[node] = largest / left[node], share * largest / left[node]
    if not strengths.have_line:
        return float(ranges.max()), np.nan
    nodes = np.union1d(np.argsort(-farthest)[:_COUNTED], np.argsort(-average)[:_COUNTED])
    damage = []
    for node in nodes:
        path, direction = _path(stress, numbers, node)
        trace = numbers @ traces[node]
        damage.append(strengths.miner_sum(rainflow_cycles((path @ direction).astype(float), trace.astype(float))))
    return float(ranges.max()), float(np.max(damage))


def _path(stress: StressOperator, numbers: np.ndarray, node: int) -> tuple[np.ndarray, np.ndarray]:
    """Deviator of a node less its mean, shape (instants, 5), and the direction in which it varies most, shape (5,)."""
    path = numbers @ stress.deviatoric[:, node, : numbers.shape[1]].T
    path = path - path.mean(axis=0)
    return path, np.linalg.eigh((path.T @ path).astype(float))[1][:, -1]
