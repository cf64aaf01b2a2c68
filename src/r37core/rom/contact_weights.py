"""Contact nodes: each is a node of the mesh, or a patch of the tip, whose displacement is a weighted mean.

A force on one node is a point load, whose displacement has no limit as the mesh is refined. On a patch k the displacement is

    u_k = integral of N_k u / integral of N_k = sum over nodes j of w_kj u_j,

with N_k a hat along the tip, 1 at the patch's position and 0 at those of its neighbours, and u the elements' own displacement
field. Forces act by the transposed weights, so that they do the work f_k u_k and no energy is made. The hats add up to one: the
patches share the tip without gap or overlap. Sources: the consistent loads of Zienkiewicz and Taylor, The Finite Element
Method; weighted means as in mortar contact, B. I. Wohlmuth, SIAM J. Numer. Anal. 38 (2000) 989.
"""

import numpy as np
import scipy.sparse as sp

from r37core.fem.traces import Trace, chain_trace, edge_traces
from r37core.mesh.blade_mesh import TIP_LINES, BladeMesh

from .reduction_choice import POINTS, BoundaryChoice, boundary_nodes, patches_on


def contact_weights(mesh: BladeMesh, choice: BoundaryChoice) -> sp.csr_array:
    """Weights w_kj of the mesh's nodes in each contact node's displacement, shape (contact nodes, nodes); rows add up to one.

    Raises BoundaryError when the tip line has too few nodes.
    """
    if choice.contact == POINTS:
        nodes = boundary_nodes(mesh, choice)
        return sp.csr_array((np.ones(len(nodes)), (np.arange(len(nodes)), nodes)), shape=(len(nodes), len(mesh.points)))
    line, chord = mesh.node_set(TIP_LINES[choice.tip_line]), mesh.parameters[:, 0]
    choice = patches_on(choice, chord[line], f"mesh nodes of the tip line '{choice.tip_line}'")
    return _means(choice, chord, _line_traces(mesh, line))


def weights_along(points: np.ndarray, chord: np.ndarray, choice: BoundaryChoice) -> sp.csr_array:
    """Weights of nodes on a line, whose elements are not known: linear between neighbours; shape (contact nodes, nodes).

    `points` (m), shape (nodes, 3), and fractions `chord` of the line's length. Raises BoundaryError for too few nodes.
    """
    choice = patches_on(choice, chord, "nodes of boundary.csv")
    numbers = np.arange(len(points))
    return _means(choice, chord, [chain_trace(points, np.stack([numbers[:-1], numbers[1:]], axis=1))])


def tip_lengths(points: np.ndarray, chord: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Length (m) of tip, along the casing's meridian, that each contact node stands for, shape (positions,).

    The integral of the nodes' hats over the tip's line: together they cover it once. `points` (m), shape (nodes, 3), and
    fractions `chord` of the nodes on the line, in order; `positions`: fractions of the contact nodes.
    """
    radius, axial = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    meridian = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(radius), np.diff(axial)))])
    hats = np.array([np.interp(chord, positions, unit) for unit in np.eye(len(positions))])
    return np.trapezoid(hats, meridian, axis=1)


def mean_positions(points: np.ndarray, weights: sp.csr_array) -> np.ndarray:
    """Positions (m), shape (contact nodes, 3): weighted means of radius, angle and axial position, so on the tip's cone."""
    alone = np.diff(weights.indptr) == 1
    radius, theta = np.hypot(points[:, 0], points[:, 1]), np.arctan2(points[:, 1], points[:, 0])
    radius, theta, axial = weights @ radius, weights @ theta, weights @ points[:, 2]
    positions = np.stack([radius * np.cos(theta), radius * np.sin(theta), axial], axis=1)
    # a single node is where it is, to the bit
    positions[alone] = points[weights.indices[weights.indptr[:-1][alone]]]
    return positions


def _line_traces(mesh: BladeMesh, line: np.ndarray) -> list[Trace]:
    """Edges of the elements along the line; where the elements have none there, as inside a face, straight pieces."""
    traces = edge_traces(mesh.points, mesh.blocks, np.isin(np.arange(len(mesh.points)), line))
    covered = sum((trace.values.shape[1] - 1) * len(trace.nodes) for trace in traces)
    return traces if covered == len(line) - 1 else [chain_trace(mesh.points, np.stack([line[:-1], line[1:]], axis=1))]


def _means(choice: BoundaryChoice, chord: np.ndarray, traces: list[Trace]) -> sp.csr_array:
    """Weights of hats along the chord, from integrals over edges; `chord`: of every node."""
    count = choice.most_nodes
    positions, total = choice.chord_positions(count), np.zeros((count, len(chord)))
    for trace in traces:
        node_chord = chord[trace.nodes] @ trace.values.T
        for row, unit in zip(total, np.eye(count), strict=True):
            shares = (np.interp(node_chord, positions, unit) * trace.measures) @ trace.values
            np.add.at(row, trace.nodes, shares)
    return sp.csr_array(total / total.sum(axis=1, keepdims=True))
