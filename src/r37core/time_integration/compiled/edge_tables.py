"""Tables of the tip's edge, as edge_steps reads them by their addresses."""

from typing import Protocol

import numpy as np

from r37core.machine_code.alignment import LANES, NUMBER_BYTES, address_of, aligned_zeros, padded

from ..problem import Problem
from .layout import Kind

FEW = 16
"""Nodes that every step with contact forces looks at: by a cosine along the edge, as the ends are where it goes deepest."""

DEEPER = 0.1
"""How much deeper the edge may go than every contact node, as a share of the tip's length."""


class LanesOfModes(Protocol):
    """Lanes of a laid-out problem: how many, and which of them are of its modes and of its products of second order."""

    mode_lanes: int
    mode_columns: np.ndarray | slice
    product_columns: slice


class EdgeTables:
    """Tables of the edge of a `problem`, for a program of this `kind`: a few nodes come first, then all, in groups.

    `lanes_of_modes`: where those of the problem's modes and products are among so many.
    """

    def __init__(self, problem: Problem, kind: Kind, lanes_of_modes: LanesOfModes):
        modes = lanes_of_modes.mode_lanes
        edge, capacity_nodes = problem.edge, padded(len(problem.casing.tip.radius))
        nodes = len(edge.casing.tip.radius)
        few = np.rint((nodes - 1) * (0.5 - 0.5 * np.cos(np.pi * np.arange(FEW) / (FEW - 1)))).astype(int)
        # of a short edge the few are all
        order = np.concatenate([few if nodes > 2 * FEW else few[:0], np.arange(nodes)])
        lanes = padded(len(order))
        self._groups = lanes // LANES
        self._few = FEW // LANES if nodes > 2 * FEW else self._groups
        directions = slice(None) if kind.exact_gap else slice(1)
        operator = edge.motion.displacement_operator[directions, order]
        columns = np.zeros((*operator.shape[:2], modes))
        columns[..., lanes_of_modes.mode_columns] = operator
        columns[..., lanes_of_modes.product_columns] = edge.motion.product_operator[directions, order]
        self.rows = aligned_zeros((len(operator), self._groups, modes, LANES))
        for direction, values in enumerate(columns):
            self.rows[direction] = _grouped(values, lanes)
        self.flexibility = aligned_zeros((self._groups, 3 * capacity_nodes, LANES))
        if edge.flexibility.size:
            flexibility = edge.flexibility[order].reshape(len(order), 3, -1)
            room = np.zeros((len(order), 3, capacity_nodes))
            room[..., : flexibility.shape[-1]] = flexibility
            self.flexibility[:] = _grouped(room.reshape(len(order), -1), lanes)
        # a lane that only pads a vector never passes the casing
        self.clearance, self.radius, self.theta = (aligned_zeros((lanes,)) for _ in range(3))
        self.clearance[:] = self.radius[:] = 1.0
        self.clearance[: len(order)] = edge.room[order]
        self.radius[: len(order)], self.theta[: len(order)] = edge.casing.tip.radius[order], edge.casing.tip.theta[order]
        self._near = max(0.5 * edge.depth, DEEPER * float(problem.model.tip_lengths.sum()))
        self._lay_out_casing(problem)

    def _lay_out_casing(self, problem: Problem) -> None:
        """Set the casing's shape at the steps of two turns, and where among them each node is."""
        steps = problem.grid.steps_per_revolution
        first = float(self.theta[0])
        turns = 2.0 * np.pi / steps * (np.arange(steps) - 1.0)
        self.table = np.resize(problem.scene.casing.shape(first - turns), 2 * steps + 4)
        ahead = np.mod((first - self.theta) * (steps / (2.0 * np.pi)), steps)
        self.steps = np.minimum(ahead.astype(np.int64), steps - 1)
        t = ahead - self.steps
        # of Lagrange's cubic through values at -1, 0, 1 and 2
        outer = -t * (t - 1) * (t - 2) / 6, (t + 1) * t * (t - 1) / 6
        inner = (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2
        self.shares = np.ascontiguousarray(np.stack([outer[0], *inner, outer[1]], axis=1))

    def put_into(self, record: np.void) -> None:
        """Put sizes and addresses into the record of the edge."""
        record["few"], record["groups"], record["near"] = self._few, self._groups, self._near
        for name in ("rows", "flexibility", "clearance"):
            record[name] = address_of(getattr(self, name))
        for name in ("radius", "theta", "table", "steps", "shares"):
            record[name] = address_of(getattr(self, name), NUMBER_BYTES)


def _grouped(values: np.ndarray, lanes: int) -> np.ndarray:
    """Numbers of nodes, shape (nodes, columns), as groups of eight, shape (groups, columns, 8); padded with zeros."""
    room = np.zeros((lanes, values.shape[1]))
    room[: len(values)] = values
    return room.reshape(-1, LANES, values.shape[1]).swapaxes(1, 2)
