"""A box of elements, clamped at one end, whose exact answers are known, and nodes of meshes that tests share."""

from itertools import permutations, product

import gmsh
import numpy as np

from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.elements import ELEMENTS
from r37core.fem.material import Material
from r37core.fem.write_mesh import write_mesh
from r37core.mesh.blade_mesh import BladeMesh, parametric_node_sets
from r37core.mesh.generate import quiet_gmsh

TITANIUM = Material(115e9, 4400.0, 0.32, 9e8)

_SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
_TRIANGLES = [[_SQUARE[0], _SQUARE[1], _SQUARE[2]], [_SQUARE[0], _SQUARE[2], _SQUARE[3]]]
_STEPS = np.eye(3, dtype=int)


def _tetrahedra():
    """The six tetrahedra between opposite corners of a cube (Kuhn), right-handed."""
    cells = []
    for order in permutations(range(3)):
        corners = np.concatenate([[[0, 0, 0]], np.cumsum(_STEPS[list(order)], axis=0)])
        cells.append(corners if np.linalg.det(corners[1:]) > 0 else corners[[0, 2, 1, 3]])
    return cells


_SPLITS = {
    "hexahedron": [[(*p, up) for up in (0, 1) for p in _SQUARE]],
    "wedge": [[(*p, up) for up in (0, 1) for p in triangle] for triangle in _TRIANGLES],
    "tetra": _tetrahedra(),
}


def box_mesh(length, width, height, counts, origin=(0.0, 0.0, 0.0), warp=0.0, element="wedge15"):
    """Elements in a box: x along `length` (clamped at its start), y along `width`, z along `height` (wedges' axis).

    `counts`: cells along x, y, z, each cut into elements. `warp` moves inner nodes smoothly, for the patch test.
    `element`: a type, or a function of the cell's (i, j, k) that gives one.
    """
    corners = {}
    for cell in product(*map(range, counts)):
        name = element(*cell) if callable(element) else element
        for split in _SPLITS[name.rstrip("0123456789")]:
            corners.setdefault(name, []).append(np.array(split) + cell)
    blocks, nodes = {}, []
    for name in (name for name in ELEMENTS if name in corners):
        of_element = np.array(corners[name], dtype=float)
        middle = [of_element[:, list(edge)].mean(axis=1) for edge in ELEMENTS[name].edges]
        blocks[name] = np.concatenate([of_element, *(m[:, None] for m in middle)], axis=1)
        nodes.append(np.round(2.0 * blocks[name]).astype(int).reshape(-1, 3))
    grid, numbers = np.unique(np.concatenate(nodes), axis=0, return_inverse=True)
    parts = np.split(numbers.ravel(), np.cumsum([len(part) for part in nodes])[:-1])
    blocks = {name: part.reshape(of.shape[:2]) for (name, of), part in zip(blocks.items(), parts, strict=True)}
    share = grid / (2.0 * np.array(counts))
    bump = np.prod(share * (1.0 - share), axis=1)
    points = share * np.array([length, width, height])
    points = points + warp * bump[:, None] * np.array([length, -width, 0.5 * height]) + np.array(origin)
    parameters = np.stack([share[:, 1], share[:, 0], 2.0 * share[:, 2] - 1.0], axis=1)
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    return BladeMesh(points, blocks, parameters, normals, parametric_node_sets(parameters))


def plate(element="hexahedron20", counts=(6, 1, 3)):
    """A plate 60 mm high, 4 mm thick, 30 mm along the axis, on a radius of 200 mm: x radial, y tangential, z axial."""
    return box_mesh(0.06, 0.004, 0.03, counts, origin=(0.2, -0.002, 0.0), element=element)


def write_deck(file, change=lambda text: text, element="hexahedron20"):
    """The plate's deck, changed as text."""
    write_abaqus(plate(element), file, TITANIUM, "plate")
    file.write_text(change(file.read_text()))


def write_with_gmsh(mesh, file):
    """A mesh in a format of gmsh's, .med or .bdf, as users convert the .msh file."""
    write_mesh(mesh, file.with_suffix(".msh"))
    with quiet_gmsh():
        gmsh.open(str(file.with_suffix(".msh")))
        gmsh.write(str(file))


def inner_places(model, mesh):
    """Places in the region of the stress of three nodes all of whose elements belong to it."""
    region = model.stress_regions["box"].nodes.nodes
    outside = [nodes[~np.isin(nodes, region).all(axis=1)] for nodes in mesh.blocks.values()]
    inner = np.flatnonzero(~np.isin(region, np.concatenate([nodes.ravel() for nodes in outside])))
    return inner[[0, len(inner) // 2, -1]]
