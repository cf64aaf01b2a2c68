"""The largest stress of each of many revolutions, of those nodes and instants that may have it. Light: jobs import it.

All nodes at all instants of a hundred revolutions would take ten times as long as the simulation.
"""

from collections.abc import Callable
from functools import partial, reduce

import numpy as np
from numpy import ndarray

from .operator import StressOperator

_FEW = 8
"""Numbers of a state, rotation as one of them, up to which all nodes are looked at in all instants."""

_AT_ONCE = 20
"""Revolutions whose stresses are in memory at a time: more do not fit in a core's cache."""


def largest_of_revolutions(
    stress: StressOperator, states: ndarray, shapes: ndarray, rotation: ndarray, per_revolution: int
) -> tuple[ndarray, ndarray]:
    """Largest von Mises stress (Pa) of each revolution, and its node by its place in the operator, shape (revolutions,).

    `states`, shape (instants, numbers), of whole revolutions of `per_revolution` instants each; `shapes`, shape (coordinates,
    numbers): reduced coordinates per number; `rotation`, shape (shapes,): amplitudes of rotation's shapes, or none.

    Where a state has _FEW numbers no node is missed, nor an instant; else see `_searched`. In single precision.
    """
    parts, columns = _linear(stress, states, shapes, rotation)
    search = _all if len(columns) <= _FEW else _searched
    largest = search(parts, columns, per_revolution).reshape(-1, per_revolution)
    worst = largest.argmax(axis=1) + np.arange(len(largest)) * per_revolution
    squares = _squares(parts, columns[:, worst])
    return np.sqrt(squares.max(axis=0).astype(float)), squares.argmax(axis=0)


def _linear(stress: StressOperator, states: ndarray, shapes: ndarray, rotation: ndarray) -> tuple[ndarray, ndarray]:
    """Parts whose length is the von Mises stress, shape (5, nodes, numbers), per number of a state, shape (numbers, instants).

    A steady stress of rotation is that of one more number, which is 1. In single precision.
    """
    states, shapes = stress.band_part(states, shapes)
    vibration_part, rotation_part = np.split(stress.deviatoric[:, :, : len(shapes) + len(rotation)], [len(shapes)], axis=2)
    parts, columns = vibration_part @ shapes.astype(np.float32), states.T.astype(np.float32, order="C")
    if len(rotation):
        parts = np.concatenate([parts, rotation_part @ rotation[:, None].astype(np.float32)], axis=2)
        columns = np.concatenate([columns, np.ones_like(columns[:1])])
    return parts, columns


def _squares(parts: ndarray, columns: ndarray) -> ndarray:
    """Squares of the von Mises stress, shape (nodes, instants)."""
    stresses = parts.reshape(-1, len(columns)) @ columns
    return reduce(np.add, np.square(stresses, out=stresses).reshape(*parts.shape[:2], -1))


def _all(parts: ndarray, columns: ndarray, per_revolution: int) -> ndarray:
    """Largest square of the von Mises stress over all nodes at each instant, shape (instants,).

    With the parts D_n of a node and the numbers s of a state, in products, of which there are few:

        |D_n s|^2 = sum over i <= j of (2 - delta_ij) (D_n^T D_n)_ij s_i s_j.
    """
    first, second = np.triu_indices(len(columns))
    weights = (parts[..., first] * parts[..., second]).sum(axis=0) * np.where(first == second, 1.0, 2.0).astype(np.float32)
    return _blockwise(lambda block: (weights @ (block[first] * block[second])).max(axis=0), columns, per_revolution)


def _searched(parts: ndarray, columns: ndarray, per_revolution: int) -> ndarray:
    """Largest square of the von Mises stress over some nodes at each instant, shape (instants,).

    Nodes that are the worst at some instant of the last revolution are looked at in all instants, all nodes at the instant of
    each revolution that is the worst so far, until neither gives another one. A node that is the worst at another instant
    alone is missed.
    """
    revolutions = np.arange(columns.shape[1] // per_revolution) * per_revolution
    nodes = new = np.unique(_squares(parts, columns[:, -per_revolution:]).argmax(axis=0))
    largest, seen = np.zeros(columns.shape[1], dtype=np.float32), np.zeros(columns.shape[1], dtype=bool)
    while len(new):
        np.maximum(largest, _blockwise(partial(_worst, parts[:, new]), columns, per_revolution), out=largest)
        worst = largest.reshape(-1, per_revolution).argmax(axis=1) + revolutions
        worst = worst[~seen[worst]]
        squares = _squares(parts, columns[:, worst])
        largest[worst], seen[worst] = squares.max(axis=0), True
        new = np.setdiff1d(squares.argmax(axis=0), nodes)
        nodes = np.union1d(nodes, new)
    return largest


def _worst(parts: ndarray, columns: ndarray) -> ndarray:
    """Largest square over the nodes, shape (instants,)."""
    return _squares(parts, columns).max(axis=0)


def _blockwise(function: Callable[[ndarray], ndarray], columns: ndarray, per_revolution: int) -> ndarray:
    """Results of a function over all instants, applied to a block of whole revolutions at a time."""
    length = _AT_ONCE * per_revolution
    return np.concatenate([function(columns[:, first : first + length]) for first in range(0, columns.shape[1], length)])


def stress_cycles(
    stress: StressOperator, states: ndarray, shapes: ndarray, rotation: ndarray, per_revolution: int, later: int
) -> tuple[ndarray, ndarray]:
    """Alternating stress (Pa), shape (revolutions, nodes), and mean stress (Pa), shape (nodes,); arguments as above.

    Alternating: largest von Mises stress of the tensor less its mean over the `later` revolutions, in each revolution. With the
    mean it does not depend on the axes, and is at least the radius of the smallest sphere about the path of the tensor: of a
    wave whose halves differ it is more than half of the range. Mean: sum of the mean normal stresses, negative in compression.
    All nodes at all instants, in single precision: stress is linear, so the mean is that of the states, and rotation changes it
    alone.
    """
    states, shapes = stress.band_part(states, shapes)
    mean_state = states[-later * per_revolution :].mean(axis=0)
    parts = stress.deviatoric[:, :, : len(shapes)] @ shapes.astype(np.float32)
    vibration = (states - mean_state).astype(np.float32)

    def largest_square(revolution: ndarray) -> ndarray:
        return reduce(np.add, (np.square(revolution @ part.T) for part in parts)).max(axis=0)

    revolutions = vibration.reshape(-1, per_revolution, vibration.shape[1])
    alternating = np.sqrt(np.stack([largest_square(revolution) for revolution in revolutions]))
    mean = stress.trace[:, : len(shapes) + len(rotation)] @ np.concatenate([shapes @ mean_state, rotation])
    return alternating, mean.astype(np.float32)


def largest_cycles(alternating: ndarray, mean: ndarray) -> tuple[ndarray, ndarray, ndarray]:
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


def _corners(revolution: ndarray, mean: ndarray, alternating: ndarray) -> ndarray:
    """Mask of the pairs above the line between their neighbours, of ascending alternating stress, in the same revolution.

    One on or below it is no corner, whatever becomes of its neighbours.
    """
    kept = np.ones(len(revolution), dtype=bool)
    fall, rise = -np.diff(mean), np.diff(alternating)
    inner = (revolution[2:] == revolution[1:-1]) & (revolution[1:-1] == revolution[:-2])
    kept[1:-1] = ~inner | (rise[:-1] * fall[1:] > rise[1:] * fall[:-1])
    return kept
