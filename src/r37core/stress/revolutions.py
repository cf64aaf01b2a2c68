"""The largest stress of each of many revolutions, of those nodes and instants that may have it. Light: jobs import it.

All nodes at all instants of a hundred revolutions would take ten times as long as the simulation.
"""

from functools import reduce

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
    vibration_part, rotation_part = np.split(stress.deviatoric[:, :, : len(shapes) + len(rotation)], [len(shapes)], axis=2)
    per_number, still = vibration_part @ shapes.astype(np.float32), rotation_part @ rotation.astype(np.float32)
    states = states.astype(np.float32)

    def squares(instants: np.ndarray | slice, nodes: np.ndarray | slice) -> np.ndarray:
        # part by part: a sum over a short last axis takes several times as long
        chosen, parts = states[instants], zip(per_number[:, nodes], still[:, nodes], strict=True)
        return reduce(np.add, (np.square(chosen @ rows.T + constant) for rows, constant in parts))

    everything, revolutions = slice(None), np.arange(len(states) // per_revolution)
    nodes = np.unique(squares(slice(-per_revolution, None), everything).argmax(axis=1))
    new, largest = nodes, np.zeros(len(states), dtype=np.float32)
    seen = np.zeros(len(states), dtype=bool)
    while len(new):
        np.maximum(largest, squares(everything, new).max(axis=1), out=largest)
        worst = largest.reshape(-1, per_revolution).argmax(axis=1) + revolutions * per_revolution
        worst = worst[~seen[worst]]
        seen[worst] = True
        worst_squares = squares(worst, everything)
        largest[worst] = worst_squares.max(axis=1)
        new = np.setdiff1d(worst_squares.argmax(axis=1), nodes)
        nodes = np.union1d(nodes, new)
    return np.sqrt(largest.reshape(-1, per_revolution).max(axis=1).astype(float))
