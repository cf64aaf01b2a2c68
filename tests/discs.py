"""Sectors of discs that tests share, and the whole disc as one mesh."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy.sparse as sp
from box_mesh import box_mesh
from scipy.spatial import cKDTree

from r37core.fem.orientation import Orientation
from r37core.mesh.blade_mesh import BladeMesh
from r37imports.importing.import_mesh import import_mesh
from r37imports.importing.source import CyclicFaces, MeshSource, Where

EXAMPLE = Path(__file__).parents[1] / "examples/blisk"
AXES = Orientation("m", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), "negative")
BLISK = MeshSource("sector.msh", AXES, Where(("bore",)), Where(("tip",)), hub_zr=((-0.1, 0.17), (0.1, 0.17)), sense_check=False)


def mesh_sector(file, sectors, size=0.014):
    """Write the mesh of the example's sector, coarse."""
    runpy.run_path(str(EXAMPLE / "sector.py"))["mesh_sector"](str(file), sectors, size)


def blisk(folder, sectors, **cyclic):
    """The example's sector as it is imported."""
    mesh_sector(folder / "sector.msh", sectors)
    return import_mesh(replace(BLISK, cyclic=CyclicFaces(sectors, **cyclic)), folder)[0]


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
