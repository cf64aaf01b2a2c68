"""The table of elements: shape functions, derivatives, quadrature, faces."""

from math import factorial

import numpy as np
import pytest

from r37core.fem.elements import ELEMENTS
from r37core.fem.quadrature import box_rule, tetrahedron_rule, wedge_rule

INSIDE = np.array([[0.2, 0.3, 0.4], [0.6, 0.1, 0.2], [0.1, 0.1, 0.0]])
each_element = pytest.mark.parametrize("element", ELEMENTS.values(), ids=ELEMENTS)


def polynomials(points, degree):
    """All monomials up to a degree, in columns."""
    exponents = [(i, j, k) for i in range(3) for j in range(3) for k in range(3) if i + j + k <= degree]
    return np.prod(points[:, None, :] ** np.array(exponents), axis=2)


@each_element
def test_each_shape_function_is_one_at_its_node_only(element):
    np.testing.assert_allclose(element.shape_functions(element.nodes), np.eye(len(element.nodes)), atol=1e-15)


@each_element
def test_complete_polynomials_are_reproduced(element):
    degree = 2 if element.quadratic else 1
    interpolated = element.shape_functions(INSIDE) @ polynomials(element.nodes, degree)
    np.testing.assert_allclose(interpolated, polynomials(INSIDE, degree), atol=1e-14)


@each_element
def test_gradients_are_the_slopes(element):
    step = 1e-6
    for axis in range(3):
        move = step * np.eye(3)[axis]
        slope = (element.shape_functions(INSIDE + move) - element.shape_functions(INSIDE - move)) / (2 * step)
        np.testing.assert_allclose(element.shape_gradients(INSIDE)[:, :, axis], slope, atol=1e-9)


@each_element
def test_faces_close_the_element_and_look_outwards(element):
    """The flux of (x, y, z) through the faces is three times the volume."""
    volume = element.mass_rule[1].sum()
    flux = 0.0
    for face, corners in zip(element.faces, element.shape.faces, strict=True):
        points = element.nodes[list(corners)]
        flux += sum(
            points[0] @ np.cross(points[i] - points[0], points[i + 1] - points[0]) / 2 for i in range(1, len(points) - 1)
        )
        middle = element.nodes[list(face[len(corners) :])]
        assert np.array_equal(middle, (points + np.roll(points, -1, axis=0))[: len(middle)] / 2)
    assert flux == pytest.approx(3 * volume)


@each_element
def test_mirrored_order_turns_it_inside_out(element):
    turned = element.nodes[None, element.mirrored] * [2.0, 3.0, 4.0]
    determinant = np.linalg.det(element.jacobian(turned, element.mass_rule[0]))
    np.testing.assert_allclose(determinant, -24.0)


@pytest.mark.parametrize(("rule", "degree"), [(wedge_rule(1, 2), 1), (wedge_rule(3, 3), 2), (wedge_rule(6, 3), 4)])
def test_wedge_quadrature_is_exact_to_its_degree(rule, degree):
    points, weights = rule
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            exact = factorial(i) * factorial(j) / factorial(i + j + 2) * 2.0 / 3.0
            assert weights @ (points[:, 0] ** i * points[:, 1] ** j * points[:, 2] ** 2) == pytest.approx(exact)


@pytest.mark.parametrize(("count", "degree"), [(1, 1), (4, 2), (15, 5)])
def test_tetrahedron_quadrature_is_exact_to_its_degree(count, degree):
    points, weights = tetrahedron_rule(count)
    assert len(points) == count
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            for k in range(degree + 1 - i - j):
                exact = factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3)
                assert weights @ np.prod(points ** [i, j, k], axis=1) == pytest.approx(exact, rel=1e-12)


def test_box_quadrature_is_exact_to_its_degree():
    points, weights = box_rule(3)
    assert weights @ np.prod(points ** [4, 2, 4], axis=1) == pytest.approx(2 / 5 * 2 / 3 * 2 / 5)
    assert weights @ np.prod(points ** [5, 0, 2], axis=1) == pytest.approx(0.0)
