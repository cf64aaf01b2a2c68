"""The table of elements: node coordinates, shape functions and their derivatives, quadrature, faces.

Names and node order of meshio, which are those of VTK, Abaqus and CalculiX: corners first, then mid-nodes. Local
coordinates: tetrahedra on the unit simplex; wedges xi, eta on the unit triangle, zeta from -1 to 1; hexahedra from -1 to 1.

An element's shape functions are the polynomials spanned by a set of monomials that are 1 at one node and 0 at all others
(Zienkiewicz and Taylor, The Finite Element Method: complete quadratics for the tetrahedron, serendipity for wedge and
hexahedron), so shape and monomials define an element and no element has formulas of its own.

Quadrature on tetrahedra, wedges and boxes: pairs of local points, shape (n, 3), and weights, shape (n,).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations, product

import numpy as np
from numpy import ndarray

Rule = tuple[ndarray, ndarray]

_TRIANGLE_ORBITS: dict[int, tuple[tuple[float, float], ...]] = {
    1: ((1.0 / 3.0, 0.5),),
    3: ((1.0 / 6.0, 1.0 / 6.0),),
    6: ((0.445948490915965, 0.111690794839005), (0.091576213509771, 0.054975871827661)),
}
_ROOT15 = np.sqrt(15.0)
_TETRAHEDRON_ORBITS: dict[int, tuple[tuple[float, float, int, float], ...]] = {
    1: ((0.25, 0.25, 1, 1.0),),
    4: (((5.0 - np.sqrt(5.0)) / 20.0, (5.0 + 3.0 * np.sqrt(5.0)) / 20.0, 3, 0.25),),
    15: (
        (0.25, 0.25, 1, 16.0 / 135.0),
        ((7.0 - _ROOT15) / 34.0, (13.0 + 3.0 * _ROOT15) / 34.0, 3, (2665.0 + 14.0 * _ROOT15) / 37800.0),
        ((7.0 + _ROOT15) / 34.0, (13.0 - 3.0 * _ROOT15) / 34.0, 3, (2665.0 - 14.0 * _ROOT15) / 37800.0),
        ((10.0 - 2.0 * _ROOT15) / 40.0, (10.0 + 2.0 * _ROOT15) / 40.0, 2, 10.0 / 189.0),
    ),
}


def wedge_rule(triangle_points: int, line_points: int) -> Rule:
    """A triangle rule (1, 3 or 6 points) times a Gauss rule through zeta.

    Triangle rules: degree 1, 2 and 4 (Dunavant, Int. J. Num. Meth. Eng. 21, 1985). Raises KeyError for another number.
    """
    triangle = []
    for a, weight in _TRIANGLE_ORBITS[triangle_points]:
        orbit = [(a, a, weight), (1.0 - 2.0 * a, a, weight), (a, 1.0 - 2.0 * a, weight)]
        triangle += orbit if triangle_points > 1 else orbit[:1]
    zeta, zeta_weight = np.polynomial.legendre.leggauss(line_points)
    points = [(x, y, z) for z in zeta for x, y, _ in triangle]
    weights = [w * wz for wz in zeta_weight for _, _, w in triangle]
    return np.array(points), np.array(weights)


def tetrahedron_rule(count: int) -> Rule:
    """1, 4 or 15 points: degree 1, 2 and 5 (Keast, Comput. Meth. Appl. Mech. Eng. 55, 1986); KeyError for other numbers."""
    points: list[tuple[float, ...]] = []
    weights: list[float] = []
    for a, b, repeated, weight in _TETRAHEDRON_ORBITS[count]:
        # volume coordinates: `repeated` times a, the rest b
        orbit = sorted(set(permutations([a] * repeated + [b] * (4 - repeated)))) if a != b else [(a,) * 4]
        points += [volume[1:] for volume in orbit]
        weights += [weight / 6.0] * len(orbit)
    return np.array(points), np.array(weights)


def box_rule(count: int) -> Rule:
    """Gauss rule with `count` points along each side of the box from -1 to 1."""
    nodes, line_weights = np.polynomial.legendre.leggauss(count)
    points = [(x, y, z) for z, y, x in product(nodes, repeat=3)]
    weights = [a * b * c for a, b, c in product(line_weights, repeat=3)]
    return np.array(points), np.array(weights)


@dataclass(frozen=True)
class Shape:
    """Shape that the elements of first and of second order share.

    `corners`: local coordinates, shape (n, 3); `edges`: two corners of each; `faces`: corners of each, counter-clockwise seen
    from outside; `ideal`: determinant of the edges at a corner of the ideal element, whose edges have length 1.
    """

    corners: ndarray
    edges: tuple[tuple[int, int], ...]
    faces: tuple[tuple[int, ...], ...]
    ideal: float


@dataclass(frozen=True)
class Element:
    """Type of element.

    `name`: as in meshio; `abaqus`: as in Abaqus and CalculiX; `spans`: whether x^i y^j z^k is among the monomials that span
    the shape functions, of i, j and k up to 2; `stiffness_rule` and `mass_rule`: quadrature.
    """

    name: str
    abaqus: str
    shape: Shape
    spans: Callable[[int, int, int], bool]
    stiffness_rule: Rule
    mass_rule: Rule

    @cached_property
    def exponents(self) -> ndarray:
        """Exponents of the monomials, shape (n, 3)."""
        return np.array([e for e in product(range(3), repeat=3) if self.spans(*e)])

    @property
    def corners(self) -> int:
        """Number of nodes that are corners."""
        return len(self.shape.corners)

    @property
    def quadratic(self) -> bool:
        """True where the edges have mid-nodes."""
        return len(self.exponents) > self.corners

    @cached_property
    def edges(self) -> dict[frozenset[int], int]:
        """Mid-node of every edge, by the edge's two corners; empty for a linear element."""
        numbered = enumerate(self.shape.edges, start=self.corners)
        return {frozenset(edge): node for node, edge in numbered if self.quadratic}

    @cached_property
    def nodes(self) -> ndarray:
        """Local coordinates of the nodes, shape (n, 3)."""
        corners = self.shape.corners
        return np.array([*corners, *(corners[list(edge)].mean(axis=0) for edge in self.edges)])

    @cached_property
    def _coefficients(self) -> ndarray:
        # all are multiples of 1/8: rounding takes away the inverse's round-off
        return np.round(np.linalg.inv(_monomials(self.nodes, self.exponents)), 12)

    def shape_functions(self, points: ndarray) -> ndarray:
        """Values of the shape functions, shape (points, n), at local `points`, shape (points, 3)."""
        return _monomials(points, self.exponents) @ self._coefficients

    def shape_gradients(self, points: ndarray) -> ndarray:
        """Local derivatives of the shape functions, shape (points, n, 3), at local `points`, shape (points, 3)."""
        slopes = []
        for axis in range(3):
            lowered = np.maximum(self.exponents - np.eye(3, dtype=int)[axis], 0)
            slopes.append((_monomials(points, lowered) * self.exponents[:, axis]) @ self._coefficients)
        return np.stack(slopes, axis=2)

    def jacobian(self, coordinates: ndarray, points: ndarray) -> ndarray:
        """Derivatives of x_i by local coordinate k, shape (elements, points, 3, 3).

        `coordinates`: nodes of each element, shape (elements, n, 3); `points`: local points, shape (points, 3).
        """
        return np.einsum("qak,eai->eqik", self.shape_gradients(points), coordinates, optimize=True)

    def physical_gradients(self, coordinates: ndarray, points: ndarray) -> tuple[ndarray, ndarray]:
        """Shape-function gradients in space, shape (elements, points, n, 3), and determinants, shape (elements, points).

        `coordinates`: nodes of each element, shape (elements, n, 3); `points`: local points, shape (points, 3).
        """
        jacobian = self.jacobian(coordinates, points)
        return self.shape_gradients(points)[None] @ np.linalg.inv(jacobian), np.linalg.det(jacobian)

    @cached_property
    def faces(self) -> tuple[tuple[int, ...], ...]:
        """Nodes of each face: corners counter-clockwise seen from outside, then the mid-nodes in the same turn."""
        faces = []
        for corners in self.shape.faces:
            edges = [frozenset(ends) for ends in zip(corners, (*corners[1:], corners[0]), strict=True)]
            faces.append((*corners, *(self.edges[edge] for edge in edges if self.quadratic)))
        return tuple(faces)

    @cached_property
    def mirrored(self) -> ndarray:
        """Order of the nodes that turns the element inside out, shape (n,)."""
        swapped = self.nodes[:, [1, 0, 2]]
        return np.abs(swapped[:, None] - self.nodes).sum(axis=2).argmin(axis=1)

    @cached_property
    def edge_directions(self) -> ndarray:
        """Local directions of the edges, without those parallel to another, shape (directions, 3)."""
        directions: list[ndarray] = []
        for face in self.shape.faces:
            for i, j in zip(face, (*face[1:], face[0]), strict=True):
                direction = self.nodes[j] - self.nodes[i]
                if all(np.any(np.cross(direction, other)) for other in directions):
                    directions.append(direction / np.abs(direction).max())
        return np.array(directions)


def _monomials(points: ndarray, exponents: ndarray) -> ndarray:
    """x^i y^j z^k at `points`, shape (points, 3), for every row of `exponents`, shape (n, 3); result (points, n)."""
    return np.prod(np.asarray(points, dtype=float)[:, None, :] ** exponents, axis=2)


_TETRAHEDRON = Shape(
    corners=np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float),
    edges=((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    faces=((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    ideal=np.sqrt(0.5),
)
_WEDGE = Shape(
    corners=np.array([(x, y, z) for z in (-1, 1) for x, y in ((0, 0), (1, 0), (0, 1))], dtype=float),
    edges=((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    faces=((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    ideal=np.sqrt(0.75),
)
_BOX = Shape(
    corners=np.array([(x, y, z) for z in (-1, 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], dtype=float),
    edges=((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    faces=((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    ideal=1.0,
)

# The stiffness rules are those of the elements of the same name in CalculiX. The wedge's nine points have no spurious modes
# and are closer to converged than eighteen. The mass rules integrate the mass of a straight-sided element exactly.
ELEMENTS = {
    element.name: element
    for element in (
        Element("tetra10", "C3D10", _TETRAHEDRON, lambda i, j, k: i + j + k <= 2, tetrahedron_rule(4), tetrahedron_rule(15)),
        Element("wedge15", "C3D15", _WEDGE, lambda i, j, k: i + j <= 2 and i + j + k <= 3, wedge_rule(3, 3), wedge_rule(6, 3)),
        Element("hexahedron20", "C3D20", _BOX, lambda i, j, k: (i, j, k).count(2) <= 1, box_rule(3), box_rule(3)),
        Element("tetra", "C3D4", _TETRAHEDRON, lambda i, j, k: i + j + k <= 1, tetrahedron_rule(1), tetrahedron_rule(4)),
        Element("wedge", "C3D6", _WEDGE, lambda i, j, k: i + j <= 1 and k <= 1, wedge_rule(3, 2), wedge_rule(3, 2)),
        Element("hexahedron", "C3D8", _BOX, lambda i, j, k: max(i, j, k) <= 1, box_rule(2), box_rule(2)),
    )
}
"""Every element by its name in meshio: second order first, then the linear ones, which are too stiff in bending."""
