"""The table of elements: node coordinates, shape functions and their derivatives, quadrature, faces.

Names and node order of meshio, which are those of VTK, Abaqus and CalculiX: corners first, then mid-nodes. Local
coordinates: tetrahedra on the unit simplex; wedges xi, eta on the unit triangle, zeta from -1 to 1; hexahedra from -1 to 1.

An element's shape functions are the polynomials spanned by a set of monomials that are 1 at one node and 0 at all others
(Zienkiewicz and Taylor, The Finite Element Method: complete quadratics for the tetrahedron, serendipity for wedge and
hexahedron), so nodes and exponents define an element and no element has formulas of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product

import numpy as np

from .quadrature import Rule, box_rule, tetrahedron_rule, wedge_rule


@dataclass(frozen=True)
class Element:
    """One type of element.

    `name`: as in meshio; `abaqus`: as in Abaqus and CalculiX; `corners`: how many nodes are corners; `nodes`: local
    coordinates, shape (n, 3); `exponents`: of the monomials that span the shape functions, shape (n, 3); `stiffness_rule`
    and `mass_rule`: quadrature; `corner_faces`: corners of each face, counter-clockwise seen from outside; `ideal`:
    determinant of the edges at a corner of the ideal element, whose edges have length 1.
    """

    name: str
    abaqus: str
    corners: int
    nodes: np.ndarray
    exponents: np.ndarray
    stiffness_rule: Rule
    mass_rule: Rule
    corner_faces: tuple[tuple[int, ...], ...]
    ideal: float

    @property
    def quadratic(self) -> bool:
        """Whether the edges have mid-nodes."""
        return len(self.nodes) > self.corners

    @cached_property
    def _coefficients(self) -> np.ndarray:
        # all are multiples of 1/8: rounding takes away the inverse's round-off
        return np.round(np.linalg.inv(_monomials(self.nodes, self.exponents)), 12)

    def shape_functions(self, points: np.ndarray) -> np.ndarray:
        """Values of the shape functions, shape (points, n), at local `points`, shape (points, 3)."""
        return _monomials(points, self.exponents) @ self._coefficients

    def shape_gradients(self, points: np.ndarray) -> np.ndarray:
        """Local derivatives of the shape functions, shape (points, n, 3), at local `points`, shape (points, 3)."""
        slopes = []
        for axis in range(3):
            lowered = np.maximum(self.exponents - np.eye(3, dtype=int)[axis], 0)
            slopes.append((_monomials(points, lowered) * self.exponents[:, axis]) @ self._coefficients)
        return np.stack(slopes, axis=2)

    def jacobian(self, coordinates: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Derivatives of x_i by local coordinate k, shape (elements, points, 3, 3).

        `coordinates`: nodes of each element, shape (elements, n, 3); `points`: local points, shape (points, 3).
        """
        return np.einsum("qak,eai->eqik", self.shape_gradients(points), coordinates, optimize=True)

    def physical_gradients(self, coordinates: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Shape-function gradients in space, shape (elements, points, n, 3), and determinants, shape (elements, points).

        `coordinates`: nodes of each element, shape (elements, n, 3); `points`: local points, shape (points, 3).
        """
        jacobian = self.jacobian(coordinates, points)
        return self.shape_gradients(points)[None] @ np.linalg.inv(jacobian), np.linalg.det(jacobian)

    @cached_property
    def edges(self) -> dict[frozenset[int], int]:
        """Mid-node of every edge, by the edge's two corners; empty for a linear element."""
        middle = {tuple(self.nodes[[i, j]].mean(axis=0)): frozenset((i, j)) for i, j in combinations(range(self.corners), 2)}
        return {middle[tuple(self.nodes[node])]: node for node in range(self.corners, len(self.nodes))}

    @cached_property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        """Nodes of each face: corners counter-clockwise seen from outside, then the mid-nodes in the same turn."""
        faces = []
        for corners in self.corner_faces:
            edges = [frozenset(ends) for ends in zip(corners, (*corners[1:], corners[0]), strict=True)]
            faces.append((*corners, *(self.edges[edge] for edge in edges if self.quadratic)))
        return tuple(faces)

    @cached_property
    def mirrored(self) -> np.ndarray:
        """Order of the nodes that turns the element inside out, shape (n,)."""
        swapped = self.nodes[:, [1, 0, 2]]
        return np.abs(swapped[:, None] - self.nodes).sum(axis=2).argmin(axis=1)

    @cached_property
    def edge_directions(self) -> np.ndarray:
        """Local directions of the edges, without those parallel to another, shape (directions, 3)."""
        directions: list[np.ndarray] = []
        for face in self.corner_faces:
            for i, j in zip(face, (*face[1:], face[0]), strict=True):
                direction = self.nodes[j] - self.nodes[i]
                if all(np.any(np.cross(direction, other)) for other in directions):
                    directions.append(direction / np.abs(direction).max())
        return np.array(directions)


def _monomials(points: np.ndarray, exponents: np.ndarray) -> np.ndarray:
    """x^i y^j z^k at `points`, shape (points, 3), for every row of `exponents`, shape (n, 3); result (points, n)."""
    return np.prod(np.asarray(points, dtype=float)[:, None, :] ** exponents, axis=2)


def _exponents(allowed) -> np.ndarray:
    return np.array([e for e in product(range(3), repeat=3) if allowed(*e)])


def _nodes(corners: Sequence[tuple[float, ...]], edges: tuple[tuple[int, int], ...]) -> np.ndarray:
    vertices = np.array(corners, dtype=float)
    return np.concatenate([vertices, *(vertices[[edge]].mean(axis=1) for edge in edges)])


_TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
_WEDGE = [(x, y, z) for z in (-1, 1) for x, y in ((0, 0), (1, 0), (0, 1))]
_BOX = [(x, y, z) for z in (-1, 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
_TETRAHEDRON_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
_WEDGE_EDGES = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
_BOX_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
_TETRAHEDRON_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
_WEDGE_FACES = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))
_BOX_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))

# The stiffness rules are those of the elements of the same name in CalculiX. The wedge's nine points have no spurious modes
# and are closer to converged than eighteen. The mass rules integrate the mass of a straight-sided element exactly.
ELEMENTS = {
    element.name: element
    for element in (
        Element(
            name="tetra10",
            abaqus="C3D10",
            corners=4,
            nodes=_nodes(_TETRAHEDRON, _TETRAHEDRON_EDGES),
            exponents=_exponents(lambda i, j, k: i + j + k <= 2),
            stiffness_rule=tetrahedron_rule(4),
            mass_rule=tetrahedron_rule(15),
            corner_faces=_TETRAHEDRON_FACES,
            ideal=np.sqrt(0.5),
        ),
        Element(
            name="wedge15",
            abaqus="C3D15",
            corners=6,
            nodes=_nodes(_WEDGE, _WEDGE_EDGES),
            exponents=_exponents(lambda i, j, k: i + j + k <= 2 or (i + j <= 2 and k == 1) or (i + j <= 1 and k == 2)),
            stiffness_rule=wedge_rule(3, 3),
            mass_rule=wedge_rule(6, 3),
            corner_faces=_WEDGE_FACES,
            ideal=np.sqrt(0.75),
        ),
        Element(
            name="hexahedron20",
            abaqus="C3D20",
            corners=8,
            nodes=_nodes(_BOX, _BOX_EDGES),
            exponents=_exponents(lambda i, j, k: (i, j, k).count(2) <= 1),
            stiffness_rule=box_rule(3),
            mass_rule=box_rule(3),
            corner_faces=_BOX_FACES,
            ideal=1.0,
        ),
        Element(
            name="tetra",
            abaqus="C3D4",
            corners=4,
            nodes=_nodes(_TETRAHEDRON, ()),
            exponents=_exponents(lambda i, j, k: i + j + k <= 1),
            stiffness_rule=tetrahedron_rule(1),
            mass_rule=tetrahedron_rule(4),
            corner_faces=_TETRAHEDRON_FACES,
            ideal=np.sqrt(0.5),
        ),
        Element(
            name="wedge",
            abaqus="C3D6",
            corners=6,
            nodes=_nodes(_WEDGE, ()),
            exponents=_exponents(lambda i, j, k: i + j <= 1 and k <= 1),
            stiffness_rule=wedge_rule(3, 2),
            mass_rule=wedge_rule(3, 2),
            corner_faces=_WEDGE_FACES,
            ideal=np.sqrt(0.75),
        ),
        Element(
            name="hexahedron",
            abaqus="C3D8",
            corners=8,
            nodes=_nodes(_BOX, ()),
            exponents=_exponents(lambda i, j, k: max(i, j, k) <= 1),
            stiffness_rule=box_rule(2),
            mass_rule=box_rule(2),
            corner_faces=_BOX_FACES,
            ideal=1.0,
        ),
    )
}
"""Every element by its name in meshio: second order first, then the linear ones, which are too stiff in bending."""
