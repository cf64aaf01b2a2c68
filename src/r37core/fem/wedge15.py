"""The 15-node quadratic wedge: shape functions, their derivatives, and quadrature.

Node order of Abaqus, CalculiX (C3D15) and VTK: corners 0-2 (bottom), 3-5 (top), then the mid-nodes of the bottom edges
01, 12, 20, of the top edges 34, 45, 53, and of the vertical edges 03, 14, 25. Local coordinates: xi, eta on the unit
triangle, zeta from -1 (bottom) to 1 (top).
"""

from __future__ import annotations

import numpy as np

_EDGES = ((0, 1), (1, 2), (2, 0))
_AREA_GRADIENT = np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])

NODES = np.array(
    [[x, y, z] for z in (-1.0, 1.0) for x, y in ((0, 0), (1, 0), (0, 1))]
    + [[x, y, z] for z in (-1.0, 1.0) for x, y in ((0.5, 0), (0.5, 0.5), (0, 0.5))]
    + [[x, y, 0.0] for x, y in ((0, 0), (1, 0), (0, 1))],
    dtype=float,
)
"""Local coordinates of the 15 nodes, shape (15, 3)."""


def shape_functions(points: np.ndarray) -> np.ndarray:
    """Values of the 15 shape functions, shape (points, 15), at local `points`, shape (points, 3)."""
    xi, eta, zeta = np.asarray(points, dtype=float).T
    area = np.stack([1.0 - xi - eta, xi, eta])
    bubble = 1.0 - zeta**2
    values = np.empty((len(xi), 15))
    for layer, rise in enumerate((1.0 - zeta, 1.0 + zeta)):
        for i in range(3):
            values[:, 3 * layer + i] = 0.5 * area[i] * ((2.0 * area[i] - 1.0) * rise - bubble)
        for k, (i, j) in enumerate(_EDGES):
            values[:, 6 + 3 * layer + k] = 2.0 * area[i] * area[j] * rise
    for i in range(3):
        values[:, 12 + i] = area[i] * bubble
    return values


def shape_gradients(points: np.ndarray) -> np.ndarray:
    """Local derivatives of the shape functions, shape (points, 15, 3), at local `points`, shape (points, 3)."""
    xi, eta, zeta = np.asarray(points, dtype=float).T
    area = np.stack([1.0 - xi - eta, xi, eta])
    bubble = 1.0 - zeta**2
    gradients = np.empty((len(xi), 15, 3))
    for layer, (rise, slope) in enumerate(((1.0 - zeta, -1.0), (1.0 + zeta, 1.0))):
        for i in range(3):
            by_area = 0.5 * ((4.0 * area[i] - 1.0) * rise - bubble)
            gradients[:, 3 * layer + i, :2] = by_area[:, None] * _AREA_GRADIENT[i]
            gradients[:, 3 * layer + i, 2] = 0.5 * area[i] * ((2.0 * area[i] - 1.0) * slope + 2.0 * zeta)
        for k, (i, j) in enumerate(_EDGES):
            node = 6 + 3 * layer + k
            product = area[i][:, None] * _AREA_GRADIENT[j] + area[j][:, None] * _AREA_GRADIENT[i]
            gradients[:, node, :2] = 2.0 * rise[:, None] * product
            gradients[:, node, 2] = 2.0 * area[i] * area[j] * slope
    for i in range(3):
        gradients[:, 12 + i, :2] = bubble[:, None] * _AREA_GRADIENT[i]
        gradients[:, 12 + i, 2] = -2.0 * zeta * area[i]
    return gradients


def quadrature(triangle_points: int, line_points: int) -> tuple[np.ndarray, np.ndarray]:
    """Points, shape (n, 3), and weights, shape (n,): a triangle rule (3 or 6 points) times a Gauss rule through zeta.

    Triangle rules: degree 2 with 3 points, degree 4 with 6 points (Dunavant, Int. J. Num. Meth. Eng. 21, 1985).
    """
    orbits = {
        3: ((1.0 / 6.0, 1.0 / 6.0),),
        6: ((0.445948490915965, 0.111690794839005), (0.091576213509771, 0.054975871827661)),
    }[triangle_points]
    triangle = []
    for a, weight in orbits:
        triangle += [(a, a, weight), (1.0 - 2.0 * a, a, weight), (a, 1.0 - 2.0 * a, weight)]
    zeta, zeta_weight = np.polynomial.legendre.leggauss(line_points)
    points = [(x, y, z) for z in zeta for x, y, _ in triangle]
    weights = [w * wz for wz in zeta_weight for _, _, w in triangle]
    return np.array(points), np.array(weights)


STIFFNESS_RULE = quadrature(3, 3)
"""Nine points, the rule of C3D15 in Abaqus and CalculiX: no spurious modes, and closer to converged than the full rule."""

MASS_RULE = quadrature(6, 3)
"""Eighteen points: integrates the consistent mass of a straight-sided wedge exactly."""


def physical_gradients(coordinates: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Shape-function gradients in space and Jacobian determinants.

    `coordinates`: nodes of each element, shape (elements, 15, 3); `points`: local points, shape (points, 3).
    Returns gradients, shape (elements, points, 15, 3), and determinants, shape (elements, points).
    """
    local = shape_gradients(points)
    jacobian = np.einsum("qak,eai->eqik", local, coordinates, optimize=True)
    determinant = np.linalg.det(jacobian)
    gradients = local[None] @ np.linalg.inv(jacobian)
    return gradients, determinant
