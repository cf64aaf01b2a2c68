"""Sectors of discs that tests share, and the whole disc as one mesh."""

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from box_mesh import box_mesh
from scipy.spatial import cKDTree

from r37core.mesh.blade_mesh import BladeMesh


def plate_sector(inner, outer, thickness, sectors, counts):
    """A sector of an annular plate of bricks, clamped at its inner radius."""
    box = box_mesh(outer - inner, 2 * np.pi / sectors, thickness, counts, element="hexahedron20")
    x, angle, z = box.points.T
    points = np.stack([(inner + x) * np.cos(angle), (inner + x) * np.sin(angle), z], axis=1)
    return replace(box, points=points, cyclic=face_pairs(points, sectors))


def face_pairs(points, sectors):
    """Nodes of the low face, and those that they become by a turn of one sector."""
    distance, nearest = cKDTree(points).query(points @ turn(sectors).T)
    low = np.flatnonzero(distance < 1e-8)
    return np.stack([low, nearest[low]], axis=1)


def turn(sectors):
    """Matrix of the turn of one sector about z."""
    cosine, sine = np.cos(2 * np.pi / sectors), np.sin(2 * np.pi / sectors)
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def whole_disc(sector, sectors):
    """All sectors as one mesh, with the tip of the first one alone."""
    copies = [sector.points @ np.linalg.matrix_power(turn(sectors), number).T for number in range(sectors)]
    points, count = np.concatenate(copies), len(sector.points)
    same = cKDTree(points).query_pairs(1e-8, output_type="ndarray")
    joined = sp.coo_array((np.ones(len(same)), same.T), shape=(len(points), len(points)))
    _, number = sp.csgraph.connected_components(joined, directed=False)
    _, first = np.unique(number, return_index=True)
    blocks = {
        kind: np.concatenate([number[nodes + copy * count] for copy in range(sectors)]) for kind, nodes in sector.blocks.items()
    }
    sets = {name: number[nodes] for name, nodes in sector.node_sets.items()}
    root = np.concatenate([number[sector.node_set("root") + copy * count] for copy in range(sectors)])
    place = np.tile(np.arange(count), sectors)[first]
    parameters, normals = sector.parameters[place], sector.normals[place]
    beyond = first >= count
    # other blades are no part of the one whose modes are named
    parameters[beyond, 1] = 0.0
    return BladeMesh(points[first], blocks, parameters, normals, sets | {"root": np.unique(root)})
