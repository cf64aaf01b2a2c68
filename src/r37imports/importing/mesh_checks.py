"""Checks of an imported mesh before it is computed with: one part, no free nodes, well shaped elements in order, each once."""

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from r37core.fem.elements import ELEMENTS
from r37core.fem.mesh_quality import scaled_jacobian
from r37core.fem.surface import Faces, outer_faces
from r37imports.refusal import ImportRefused, warn_of

from .raw_mesh import RawMesh

ALONG_EDGE, OFF_EDGE = 0.24, 0.6
"""How far a mid-node may lie from the middle of its edge, along it and across it, in lengths of the edge.

Across: half a circle round a blade's nose in one element has 0.5; a wrong node order has 0.7 and more. Along: at 0.25 the
map of the element folds at the corner.
"""


def checked(mesh: RawMesh, minimum_scaled_jacobian: float) -> tuple[RawMesh, np.ndarray]:
    """The mesh, all elements right way out, and the scaled Jacobian of each, shape (elements,).

    Warns of linear elements, and of holes and cavities, which a blade may have and which a missing element leaves.

    A format of the other winding (MED) is recognised by all elements of a type being inside out. Raises ImportRefused.
    """
    if not np.all(np.isfinite(mesh.points)):
        raise ImportRefused("found coordinates that are not numbers")
    _check_free_nodes(mesh)
    _check_parts(mesh)
    for name, nodes in mesh.blocks.items():
        _check_once(mesh, name, nodes)
        _check_midside(mesh, name, nodes)
    blocks, quality = {}, {}
    for name, nodes in mesh.blocks.items():
        blocks[name], quality[name] = _right_way_out(mesh, name, nodes)
        _check_shape(mesh, name, quality[name], minimum_scaled_jacobian)
    _check_one_order(mesh)
    _tell_holes(mesh.points, outer_faces(blocks))
    linear = [name for name in blocks if not ELEMENTS[name].quadratic]
    if linear:
        warn_of(
            f"elements of first order ({', '.join(linear)}) are too stiff in bending: frequencies come out too high, often by "
            "10% and more; write the mesh with second-order elements"
        )
    return replace(mesh, blocks=blocks), np.concatenate(list(quality.values()))


def _check_free_nodes(mesh: RawMesh) -> None:
    free = np.setdiff1d(np.arange(len(mesh.points)), _used_nodes(mesh))
    if len(free):
        raise ImportRefused(
            f"{len(free)} of {len(mesh.points)} nodes belong to no solid element ({_some(mesh.labels[free])}); take them out, "
            "or say drop_free_nodes: true if they are reference or construction points"
        )


def _used_nodes(mesh: RawMesh) -> np.ndarray:
    return np.unique(np.concatenate([nodes.ravel() for nodes in mesh.blocks.values()]))


def without_free_nodes(mesh: RawMesh) -> RawMesh:
    """The mesh without the nodes that belong to no solid element."""
    used = _used_nodes(mesh)
    new_number = np.full(len(mesh.points), -1)
    new_number[used] = np.arange(len(used))
    sets = {name: new_number[nodes][new_number[nodes] >= 0] for name, nodes in mesh.sets.items()}
    return RawMesh(mesh.points[used], mesh.labels[used], {name: new_number[nodes] for name, nodes in mesh.blocks.items()}, sets)


def _check_parts(mesh: RawMesh) -> None:
    pairs = [np.stack([nodes[:, :-1].ravel(), nodes[:, 1:].ravel()]) for nodes in mesh.blocks.values()]
    rows, columns = np.concatenate(pairs, axis=1)
    graph = sp.coo_array((np.ones(len(rows)), (rows, columns)), shape=(len(mesh.points),) * 2)
    count, part = connected_components(graph, directed=False)
    if count > 1:
        size = np.ptp(mesh.points, axis=0).max()
        twice = len(mesh.points) - len(np.unique(np.round(mesh.points / (1e-6 * size)), axis=0))
        hint = f"; {twice} nodes lie on others: merge them" if twice else "; give one blade per file"
        raise ImportRefused(f"found {count} parts that share no node ({_some(np.sort(np.bincount(part))[::-1])} nodes){hint}")


def _check_once(mesh: RawMesh, name: str, nodes: np.ndarray) -> None:
    corners = np.sort(nodes[:, : ELEMENTS[name].corners], axis=1)
    _, first, of = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    original = first[of.ravel()]
    again = np.flatnonzero(original != np.arange(len(nodes)))
    if len(again):
        pairs = ", ".join(f"{original[i] + 1} and {i + 1}" for i in again[:5]) + (", ..." if len(again) > 5 else "")
        raise ImportRefused(
            f"{len(again)} of {len(nodes)} elements of type {name} are given twice, with the same corners (numbers {pairs} of "
            f"their type, near {_place(mesh.points[nodes[again[0]]].mean(axis=0))}); their mass and stiffness would count "
            "twice: delete the second ones"
        )


def _check_one_order(mesh: RawMesh) -> None:
    """Refuse edges of first-order elements that have a mid-node in the second-order element beside them."""
    edges: dict[bool, list[np.ndarray]] = {True: [], False: []}
    for name, nodes in mesh.blocks.items():
        element = ELEMENTS[name]
        corners = [nodes[:, edge] for edge in element.shape.edges]
        edges[element.quadratic].append(np.sort(np.concatenate(corners), axis=1))
    if not (edges[True] and edges[False]):
        return
    first, second = (np.unique(np.concatenate(edges[order]), axis=0) for order in (False, True))
    shared, times = np.unique(np.concatenate([first, second]), axis=0, return_counts=True)
    hanging = shared[times == 2]
    if len(hanging):
        raise ImportRefused(
            f"found elements of first beside some of second order; the mid-nodes of {len(hanging)} edges, for example between "
            f"the nodes {_some(mesh.labels[hanging[0]])}, belong to one side alone and would come apart from the other: write "
            "all elements in second order"
        )


def _tell_holes(points: np.ndarray, faces: list[Faces]) -> None:
    """Warn unless the surface is that of a ball: one piece, and corners - edges + faces = 2 (Euler's polyhedron formula)."""
    edges = np.unique(np.sort(np.concatenate([part.edges()[:, [0, 2]] for part in faces]), axis=1), axis=0)
    corners, local = np.unique(edges, return_inverse=True)
    starts, ends = local.reshape(-1, 2).T
    graph = sp.coo_array((np.ones(len(starts)), (starts, ends)), shape=(len(corners),) * 2)
    pieces, piece = connected_components(graph, directed=False)
    characteristic = len(corners) - len(edges) + sum(len(part.nodes) for part in faces)
    if (pieces, characteristic) != (1, 2):
        smallest = np.argmin(np.bincount(piece))
        cavities = f"{pieces - 1} closed inside, one near {_place(points[corners[piece == smallest]].mean(axis=0))}"
        through = f"corners - edges + faces of its surface is {characteristic} and not {2 * pieces}"
        holes = [cavities] * (pieces > 1) + [through] * (characteristic != 2 * pieces)
        warn_of(
            f"the mesh has holes ({'; '.join(holes)}): elements may be missing, and with them mass and stiffness; if the blade "
            "is hollow, all is well"
        )


def _check_midside(mesh: RawMesh, name: str, nodes: np.ndarray) -> None:
    for edge, middle in ELEMENTS[name].edges.items():
        start, end, point = (mesh.points[nodes[:, i]] for i in (*edge, middle))
        along, offset = end - start, point - 0.5 * (start + end)
        length = np.maximum(np.linalg.norm(along, axis=1), 1e-300)
        share = np.abs(np.sum(offset * along, axis=1)) / length**2
        across = np.linalg.norm(offset, axis=1) / length
        wrong = ~((share <= ALONG_EDGE) & (across <= OFF_EDGE))
        if wrong.any():
            first = np.argmax(wrong)
            raise ImportRefused(
                f"mid-nodes off their edges in {wrong.sum()} of {len(nodes)} elements of type {name}, for example node "
                f"{mesh.labels[nodes[first, middle]]}, {across[first]:.2f} edge lengths from the middle of its edge; the "
                "file's node order is another one, or the mesh is distorted"
            )


def _right_way_out(mesh: RawMesh, name: str, nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    element = ELEMENTS[name]
    quality = scaled_jacobian(element, mesh.points[nodes])
    turned = nodes[:, element.mirrored]
    mirrored = scaled_jacobian(element, mesh.points[turned])
    return (turned, mirrored) if np.all(quality < 0.0) and np.all(mirrored > 0.0) else (nodes, quality)


def _check_shape(mesh: RawMesh, name: str, quality: np.ndarray, minimum: float) -> None:
    inverted, worst = quality <= 0.0, np.argmin(quality)
    where = f"number {worst + 1} of its type, near {_place(mesh.points[mesh.blocks[name][worst]].mean(axis=0))}"
    if inverted.any():
        raise ImportRefused(f"{inverted.sum()} of {len(quality)} elements of type {name} are inside out or folded ({where})")
    if quality[worst] < minimum:
        raise ImportRefused(
            f"{np.sum(quality < minimum)} of {len(quality)} elements of type {name} have a scaled Jacobian below "
            f"minimum_scaled_jacobian ({minimum:g}), the worst {quality[worst]:.3g} ({where}); mesh finer there"
        )


def _some(values: np.ndarray) -> str:
    return ", ".join(map(str, values[:5].tolist())) + (", ..." if len(values) > 5 else "")


def _place(point: np.ndarray) -> str:
    return "(" + ", ".join(f"{x:.5g}" for x in point) + ")"
