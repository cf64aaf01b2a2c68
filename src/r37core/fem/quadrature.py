"""Quadrature on tetrahedra, wedges and boxes: pairs of local points, shape (n, 3), and weights, shape (n,)."""

from itertools import permutations, product

import numpy as np

Rule = tuple[np.ndarray, np.ndarray]

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
