"""Damage by the cycles of a stress: of the node where it is largest. Light: jobs import it."""

import numpy as np

from r37core.stress.cycles import StressCycles, rainflow_cycles
from r37core.stress.operator import StressOperator
from r37core.stress.statistic import Strengths


def operator_numbers(stress: StressOperator, states: np.ndarray, shapes: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """Numbers that the operator maps to stress, shape (instants, numbers), in single precision.

    `states`, shape (instants, modes), and their `shapes`, shape (coordinates, modes): of the vibration; `rotation`, shape
    (instants, shapes): amplitudes of rotation's shapes.
    """
    states, shapes = stress.band_part(states, shapes)
    return np.concatenate([states @ shapes.T, rotation], axis=1).astype(np.float32)


def goodman_shares(stress: StressOperator, numbers: np.ndarray, strengths: Strengths) -> np.ndarray:
    """Largest share of the Goodman line of all nodes in each revolution, shape (revolutions,).

    `numbers`: operator_numbers, shape (revolutions, instants, numbers). Stresses are those of r37core.stress.revolutions.
    """
    parts, traces = (each[..., : numbers.shape[-1]] for each in (stress.deviatoric, stress.trace))
    shares = []
    for revolution in numbers:
        mean = revolution.mean(axis=0)
        alternating = np.sqrt(sum(np.square((revolution - mean) @ part.T) for part in parts))
        shares.append(strengths.share(alternating.max(axis=0), traces @ mean).max())
    return np.array(shares)


def largest_damage(stress: StressOperator, numbers: np.ndarray, strengths: Strengths) -> tuple[float, float]:
    """Largest range of the stress (Pa) and largest Miner's sum of all nodes; NaN for the sum without an S-N line.

    `numbers`: operator_numbers over time. At a node the path of the deviator, in parts whose length is the von Mises stress, is
    counted along the direction in which it varies most; the mean of a cycle is that of the sum of the normal stresses, as in
    r37core.stress.revolutions. A node is not counted whose sum could not be the largest: it has no more cycles than half its
    instants, none of them larger than its range, nor about a larger mean than its largest.
    """
    traces = stress.trace[:, : numbers.shape[1]]
    ranges, bounds = np.zeros(len(traces)), np.zeros(len(traces))
    for node, trace in enumerate(traces):
        path, direction = _path(stress, numbers, node)
        ranges[node] = np.ptp(path @ direction)
        worst = StressCycles(0.5 * ranges[node, None], np.max(numbers @ trace, keepdims=True), np.array([0.5 * len(numbers)]))
        bounds[node] = strengths.miner_sum(worst)
    if not strengths.have_line:
        return float(ranges.max()), np.nan
    damage = 0.0
    for node in np.argsort(-bounds, kind="stable"):
        if bounds[node] <= damage:
            break
        path, direction = _path(stress, numbers, node)
        cycles = rainflow_cycles((path @ direction).astype(float), (numbers @ traces[node]).astype(float))
        damage = max(damage, strengths.miner_sum(cycles))
    return float(ranges.max()), damage


def _path(stress: StressOperator, numbers: np.ndarray, node: int) -> tuple[np.ndarray, np.ndarray]:
    """Deviator of a node less its mean, shape (instants, 5), and the direction in which it varies most, shape (5,)."""
    path = numbers @ stress.deviatoric[:, node, : numbers.shape[1]].T
    path = path - path.mean(axis=0)
    return path, np.linalg.eigh((path.T @ path).astype(float))[1][:, -1]
