"""Tables of the tip's edge, as edge_steps reads them by their addresses."""

import numpy as np

from r37core.machine_code.alignment import LANES, NUMBER_BYTES, address_of, aligned_zeros, padded

from ..problem import Problem

FEW = 16
"""Nodes that every step with contact forces looks at: by a cosine along the edge, as the ends are where it goes deepest."""

DEEPER = 0.1
"""How much deeper the edge may go than every contact node, as a share of the tip's length."""


class EdgeTables:
    """Tables of the edge of a `problem`: a few nodes come first, then all, in groups.

    `rows`, shape (directions, nodes, lanes): displacement of the edge's nodes per mode and product. `contact_lanes`: of the
    contact nodes.
    """

    def __init__(self, problem: Problem, rows: np.ndarray, contact_lanes: int):
        edge = problem.edge
        nodes = len(edge.casing.tip.radius)
        few = np.rint((nodes - 1) * (0.5 - 0.5 * np.cos(np.pi * np.arange(FEW) / (FEW - 1)))).astype(int)
        # of a short edge the few are all
        order = np.concatenate([few if nodes > 2 * FEW else few[:0], np.arange(nodes)])
        lanes = padded(len(order))
        self._groups = lanes // LANES
        self._few = FEW // LANES if nodes > 2 * FEW else self._groups
        self.rows = _grouped(rows[:, order], lanes)
        flexibility = np.zeros((len(order), 3, contact_lanes))
        if edge.flexibility.size:
            own = edge.flexibility[order].reshape(len(order), 3, -1)
            flexibility[..., : own.shape[-1]] = own
        self.flexibility = _grouped(flexibility.reshape(1, len(order), -1), lanes)
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

    @property
    def fields(self) -> dict[str, float]:
        """Sizes and addresses of the tables, as the record of the edge has them."""
        vectors = {name: address_of(getattr(self, name)) for name in ("rows", "flexibility", "clearance")}
        plain = ("radius", "theta", "table", "steps", "shares")
        numbers = {name: address_of(getattr(self, name), NUMBER_BYTES) for name in plain}
        return {"few": self._few, "groups": self._groups, "near": self._near, **vectors, **numbers}


def _grouped(values: np.ndarray, lanes: int) -> np.ndarray:
    """Numbers of nodes, shape (directions, nodes, columns), as groups of eight, shape (directions, groups, columns, 8).

    Nodes are padded with zeros.
    """
    directions, nodes, columns = values.shape
    groups = aligned_zeros((directions, lanes // LANES, columns, LANES))
    padded_nodes = np.zeros((directions, lanes, columns))
    padded_nodes[:, :nodes] = values
    groups[:] = padded_nodes.reshape(directions, -1, LANES, columns).swapaxes(2, 3)
    return groups
