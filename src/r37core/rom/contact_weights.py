"""Contact nodes: each is a node of the mesh, or a patch of the tip, whose displacement is a weighted mean.

A force on one node is a point load, whose displacement has no limit as the mesh is refined. On a patch k the displacement is

    u_k = integral of N_k u / integral of N_k = sum over nodes j of w_kj u_j,

with N_k a hat along the tip, 1 at the patch's position and 0 at those of its neighbours, and u the elements' own displacement
field. Forces act by the transposed weights, so that they do the work f_k u_k and no energy is made. The hats add up to one: the
patches share the tip without gap or overlap. Sources: the consistent loads of Zienkiewicz and Taylor, The Finite Element
Method; weighted means as in mortar contact, B. I. Wohlmuth, SIAM J. Numer. Anal. 38 (2000) 989.
"""

from dataclasses import dataclass

import numpy as np
from numpy import ndarray
from scipy.sparse import csr_array

from r37core.fem.traces import Trace, chain_trace, edge_traces
from r37core.mesh.blade_mesh import TIP_LINES, BladeMesh

from .recovery_nodes import RecoveryNodes, cylinder
from .reduction_choice import POINTS, BoundaryChoice, contact_positions


@dataclass(frozen=True)
class TipContact:
    """Contact nodes on a tip's `line`, which has some of the nodes that are at fractions `chord` of it.

    `weights`, shape (contact nodes, nodes): of the nodes in each one's displacement; rows add up to one. `lengths` (m), shape
    (contact nodes,): of tip that each stands for, see tip_lengths.
    """

    line: ndarray
    chord: ndarray
    weights: csr_array
    lengths: ndarray

    @property
    def mean_chord(self) -> ndarray:
        """Fractions of the chord of the contact nodes, shape (contact nodes,)."""
        return self.weights @ self.chord

    def nodes(self, every: RecoveryNodes) -> RecoveryNodes:
        """The contact nodes as means of `every` node, each with the number of the nearest node of the tip's line."""
        nearest = _nearest(self.chord[self.line], self.mean_chord)
        fields = (mean_fields(self.weights, nodes) for nodes in (every.basis, every.rotation_shapes))
        return RecoveryNodes(every.nodes[self.line[nearest]], mean_positions(every.points, self.weights), *fields)


def tip_contact(mesh: BladeMesh, boundary: BoundaryChoice) -> TipContact:
    """Contact nodes on the tip of a mesh. Raises BoundaryError when it has too few nodes."""
    line, chord = mesh.node_set(TIP_LINES[boundary.tip_line]), mesh.parameters[:, 0]
    positions = contact_positions(boundary, chord[line], f"mesh nodes of the tip line '{boundary.tip_line}'")
    lengths = tip_lengths(mesh.points[line], chord[line], positions)
    if boundary.contact == POINTS:
        nodes = line[_nearest(chord[line], positions)]
        weights = csr_array((np.ones(len(nodes)), (np.arange(len(nodes)), nodes)), shape=(len(nodes), len(chord)))
    else:
        traces = edge_traces(mesh.points, mesh.blocks, np.isin(np.arange(len(mesh.points)), line))
        if sum((trace.values.shape[1] - 1) * len(trace.nodes) for trace in traces) != len(line) - 1:
            # the elements have no edges there, as inside a face
            traces = [chain_trace(mesh.points, np.stack([line[:-1], line[1:]], axis=1))]
        weights = _means(positions, chord, traces)
    return TipContact(line, chord, weights, lengths)


def contact_along(points: ndarray, chord: ndarray, boundary: BoundaryChoice) -> TipContact:
    """Patches of nodes on a line, whose elements are not known: their displacement is linear between neighbours.

    `points` (m), shape (nodes, 3), and fractions `chord` of the line's length. Raises BoundaryError for too few nodes.
    """
    positions, numbers = contact_positions(boundary, chord, "nodes of boundary.csv"), np.arange(len(points))
    weights = _means(positions, chord, [chain_trace(points, np.stack([numbers[:-1], numbers[1:]], axis=1))])
    return TipContact(numbers, chord, weights, tip_lengths(points, chord, positions))


def mean_fields(weights: csr_array, fields: ndarray) -> ndarray:
    """Fields at the contact nodes, shape (contact nodes, 3, columns), from those at all nodes, shape (nodes, 3, columns)."""
    nodes, axes, columns = fields.shape
    return (weights @ fields.reshape(nodes, axes * columns)).reshape(weights.shape[0], axes, columns)


def tip_lengths(points: ndarray, chord: ndarray, positions: ndarray) -> ndarray:
    """Length (m) of tip, along the casing's meridian, that each contact node stands for, shape (positions,).

    The integral of the nodes' hats over the tip's line: together they cover it once. `points` (m), shape (nodes, 3), and
    fractions `chord` of the nodes on the line, in order; `positions`: fractions of the contact nodes.
    """
    radius, _, axial = cylinder(points)
    meridian = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(radius), np.diff(axial)))])
    hats = np.array([np.interp(chord, positions, unit) for unit in np.eye(len(positions))])
    return np.trapezoid(hats, meridian, axis=1)


def mean_positions(points: ndarray, weights: csr_array) -> ndarray:
    """Positions (m), shape (contact nodes, 3): weighted means of radius, angle and axial position, so on the tip's cone."""
    alone = np.diff(weights.indptr) == 1
    radius, theta, axial = (weights @ part for part in cylinder(points))
    positions = np.stack([radius * np.cos(theta), radius * np.sin(theta), axial], axis=1)
    # a single node is where it is, to the bit
    positions[alone] = points[weights.indices[weights.indptr[:-1][alone]]]
    return positions


def _nearest(chord: ndarray, positions: ndarray) -> ndarray:
    """Place of the node nearest to each of some positions, among nodes at fractions `chord`."""
    return np.abs(chord - positions[:, None]).argmin(axis=1)


def _means(positions: ndarray, chord: ndarray, traces: list[Trace]) -> csr_array:
    """Weights of hats at `positions` of the chord, from integrals over edges; `chord`: of every node."""
    total = np.zeros((len(positions), len(chord)))
    for trace in traces:
        node_chord = chord[trace.nodes] @ trace.values.T
        for row, unit in zip(total, np.eye(len(positions)), strict=True):
            shares = (np.interp(node_chord, positions, unit) * trace.measures) @ trace.values
            np.add.at(row, trace.nodes, shares)
    return csr_array(total / total.sum(axis=1, keepdims=True))
