"""The largest stress of each of many revolutions, of those nodes and instants that may have it. Light: jobs import it.

All nodes at all instants of a hundred revolutions would take ten times as long as the simulation.
"""

from collections.abc import Callable
from functools import reduce

import numpy as np

from .operator import StressOperator


def largest_of_revolutions(
    stress: StressOperator, states: np.ndarray, shapes: np.ndarray, rotation: np.ndarray, per_revolution: int
) -> tuple[np.ndarray, np.ndarray]:
    """Largest von Mises stress (Pa) of each revolution, and its node by its place in the operator, shape (revolutions,).

    `states`, shape (instants, numbers), of whole revolutions of `per_revolution` instants each; `shapes`, shape (coordinates,
    numbers): reduced coordinates per number; `rotation`, shape (shapes,): amplitudes of rotation's shapes, or none.

    Nodes that are the worst at some instant of the last revolution are looked at in all instants, all nodes at the instant of
    each revolution that is the worst so far, until neither gives another one. A node that is the worst at another instant
    alone is missed. In single precision.
    """
    states, shapes = stress.band_part(states, shapes)
    squares, states = _squares(stress, shapes, rotation), states.astype(np.float32)
    everything, revolutions = slice(None), np.arange(len(states) // per_revolution)
    nodes = np.unique(squares(states[-per_revolution:], everything).argmax(axis=1))
    new, largest = nodes, np.zeros(len(states), dtype=np.float32)
    node_of = np.full(len(states), -1)
    while len(new):
        np.maximum(largest, squares(states, new).max(axis=1), out=largest)
        worst = largest.reshape(-1, per_revolution).argmax(axis=1) + revolutions * per_revolution
        worst = worst[node_of[worst] < 0]
        worst_squares = squares(states[worst], everything)
        largest[worst], node_of[worst] = worst_squares.max(axis=1), worst_squares.argmax(axis=1)
        new = np.setdiff1d(node_of[worst], nodes)
        nodes = np.union1d(nodes, new)
    worst = largest.reshape(-1, per_revolution).argmax(axis=1) + revolutions * per_revolution
    return np.sqrt(largest[worst].astype(float)), node_of[worst]


def _squares(
    stress: StressOperator, shapes: np.ndarray, rotation: np.ndarray
) -> Callable[[np.ndarray, np.ndarray | slice], np.ndarray]:
    """Gives squares of the von Mises stress, shape (instants, nodes), for states and some of the nodes."""
    vibration_part, rotation_part = np.split(stress.deviatoric[:, :, : len(shapes) + len(rotation)], [len(shapes)], axis=2)
    per_number, still = vibration_part @ shapes.astype(np.float32), rotation_part @ rotation.astype(np.float32)

    def squares(states: np.ndarray, nodes: np.ndarray | slice) -> np.ndarray:
        # part by part: a sum over a short last axis takes several times as long
        parts = zip(per_number[:, nodes], still[:, nodes], strict=True)
        return reduce(np.add, (np.square(states @ rows.T + constant) for rows, constant in parts))

    return squares


def stress_cycles(
    stress: StressOperator, states: np.ndarray, shapes: np.ndarray, rotation: np.ndarray, per_revolution: int
) -> tuple[np.ndarray, np.ndarray]:
    """Alternating stress (Pa), shape (revolutions, nodes), and mean stress (Pa), shape (nodes,); arguments as above.

    Alternating: largest von Mises stress of the tensor less its mean over time, in each revolution. With the mean it does not
    depend on the axes, and is at least the radius of the smallest sphere about the path of the tensor: of a wave whose halves
    differ it is more than half of the range. Mean: sum of the mean normal stresses, negative in compression. All nodes at all
    instants, in single precision: stress is linear, so the mean is that of the states, and rotation changes it alone.
    """
    states, shapes = stress.band_part(states, shapes)
    mean_state = states.mean(axis=0)
    parts = stress.deviatoric[:, :, : len(shapes)] @ shapes.astype(np.float32)
    vibration = (states - mean_state).astype(np.float32)

    def largest_square(revolution: np.ndarray) -> np.ndarray:
        return reduce(np.add, (np.square(revolution @ part.T) for part in parts)).max(axis=0)

    revolutions = vibration.reshape(-1, per_revolution, vibration.shape[1])
    alternating = np.sqrt(np.stack([largest_square(revolution) for revolution in revolutions]))
    mean = stress.trace[:, : len(shapes) + len(rotation)] @ np.concatenate([shapes @ mean_state, rotation])
    return alternating, mean.astype(np.float32)


def largest_cycles(alternating: np.ndarray, mean: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs of stress_cycles that can be the largest by alternating/S_f + mean/S_u in a revolution, whatever the strengths.

    Alternating and mean stress (Pa), shape (pairs,), revolution by revolution, and how many are of each, shape (revolutions,).
    They are the corners of the upper right convex hull of all nodes' pairs, compression as a mean of 0.
    """
    order, revolutions = np.argsort(-mean, kind="stable"), len(alternating)
    mean, alternating = np.maximum(mean[order], 0.0), alternating[:, order]
    highest = np.maximum.accumulate(alternating, axis=1)
    # only where it is above that of all nodes with a larger mean
    revolution, node = np.nonzero(np.diff(highest, axis=1, prepend=-1.0) > 0.0)
    mean, alternating = mean[node], alternating[revolution, node]
    while not (kept := _corners(revolution, mean.astype(float), alternating.astype(float))).all():
        revolution, mean, alternating = revolution[kept], mean[kept], alternating[kept]
    return alternating, mean, np.bincount(revolution, minlength=revolutions).astype(np.int32)


def _corners(revolution: np.ndarray, mean: np.ndarray, alternating: np.ndarray) -> np.ndarray:
    """Mask of the pairs above the line between their neighbours, of ascending alternating stress, in the same revolution.

    One on or below it is no corner, whatever becomes of its neighbours.
    """
    kept = np.ones(len(revolution), dtype=bool)
    fall, rise = -np.diff(mean), np.diff(alternating)
    inner = (revolution[2:] == revolution[1:-1]) & (revolution[1:-1] == revolution[:-2])
    kept[1:-1] = ~inner | (rise[:-1] * fall[1:] > rise[1:] * fall[:-1])
    return kept
