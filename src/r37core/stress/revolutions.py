"""The largest stress of each of many revolutions, of those nodes and instants that may have it. Light: jobs import it.

With the deviatoric parts a to e below the von Mises stress is the length of a vector that is linear in the motion:

    a = sqrt(3)/2 (xx - yy),  b = zz - (xx + yy)/2,  c, d, e = sqrt(3) (xy, yz, zx);  von Mises^2 = a^2 + b^2 + c^2 + d^2 + e^2

All nodes at all instants of a hundred revolutions would take ten times as long as the simulation.
"""

from __future__ import annotations

import numpy as np

from .operator import StressOperator


def largest_of_revolutions(
    stress: StressOperator, states: np.ndarray, shapes: np.ndarray, rotation: np.ndarray, per_revolution: int
) -> np.ndarray:
    """Largest von Mises stress (Pa) of each revolution, shape (revolutions,).

    `states`, shape (instants, numbers), of whole revolutions of `per_revolution` instants each; `shapes`, shape (coordinates,
    numbers): reduced coordinates per number; `rotation`, shape (shapes,): amplitudes of rotation's shapes, or none.

    Nodes that are the worst at some instant of the last revolution are looked at in all instants, all nodes at the instant of
    each revolution that is the worst so far, until neither gives another one. A node that is the worst at another instant
    alone is missed. In single precision.
    """
    parts = _deviatoric(stress.operator).astype(np.float32)
    per_number = parts[:, :, : len(shapes)] @ shapes.astype(np.float32)
    still = parts[:, :, len(shapes) : len(shapes) + len(rotation)] @ rotation.astype(np.float32)
    states = states.astype(np.float32)

    def squares(instants: np.ndarray | slice, nodes: np.ndarray | slice) -> np.ndarray:
        rows = per_number[nodes]
        values = states[instants] @ rows.reshape(-1, rows.shape[2]).T + still[nodes].ravel()
        return np.square(values, out=values).reshape(len(values), len(rows), rows.shape[1]).sum(axis=2)

    everything, revolutions = slice(None), np.arange(len(states) // per_revolution)
    nodes = np.unique(squares(slice(-per_revolution, None), everything).argmax(axis=1))
    new, largest = nodes, np.zeros(len(states), dtype=np.float32)
    seen = np.zeros(len(states), dtype=bool)
    while len(new):
        np.maximum(largest, squares(everything, new).max(axis=1), out=largest)
        worst = largest.reshape(-1, per_revolution).argmax(axis=1) + revolutions * per_revolution
        worst = worst[~seen[worst]]
        seen[worst] = True
        at_worst = squares(worst, everything)
        largest[worst] = at_worst.max(axis=1)
        new = np.setdiff1d(at_worst.argmax(axis=1), nodes)
        nodes = np.union1d(nodes, new)
    return np.sqrt(largest.reshape(-1, per_revolution).max(axis=1).astype(float))


def _deviatoric(operator: np.ndarray) -> np.ndarray:
    """The parts a to e per coordinate, shape (nodes, 5, coordinates), of an operator of shape (6, nodes, coordinates)."""
    xx, yy, zz, xy, yz, zx = operator
    root = np.sqrt(3.0)
    return np.stack([0.5 * root * (xx - yy), zz - 0.5 * (xx + yy), root * xy, root * yz, root * zx], axis=1)
