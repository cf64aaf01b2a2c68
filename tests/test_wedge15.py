"""The element."""

import numpy as np
import pytest

from r37core.fem.wedge15 import MASS_RULE, NODES, STIFFNESS_RULE, quadrature, shape_functions, shape_gradients

INSIDE = np.array([[0.2, 0.3, -0.4], [0.6, 0.1, 0.7], [0.1, 0.1, 0.0]])


def test_each_shape_function_is_one_at_its_node_only():
    np.testing.assert_allclose(shape_functions(NODES), np.eye(15), atol=1e-15)


def test_complete_quadratics_are_reproduced():
    def quadratics(p):
        x, y, z = p.T
        return np.stack([1 + 0 * x, x, y, z, x * x, y * y, z * z, x * y, y * z, x * z], axis=1)

    np.testing.assert_allclose(shape_functions(INSIDE) @ quadratics(NODES), quadratics(INSIDE), atol=1e-14)


def test_gradients_are_the_slopes():
    step = 1e-6
    for axis in range(3):
        move = step * np.eye(3)[axis]
        slope = (shape_functions(INSIDE + move) - shape_functions(INSIDE - move)) / (2 * step)
        np.testing.assert_allclose(shape_gradients(INSIDE)[:, :, axis], slope, atol=1e-9)


@pytest.mark.parametrize(("rule", "degree"), [(STIFFNESS_RULE, 2), (MASS_RULE, 4)])
def test_quadrature_is_exact_to_its_degree(rule, degree):
    from math import factorial

    points, weights = rule
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            exact = factorial(i) * factorial(j) / factorial(i + j + 2) * 2.0 / 3.0
            assert weights @ (points[:, 0] ** i * points[:, 1] ** j * points[:, 2] ** 2) == pytest.approx(exact)


def test_unknown_rule():
    with pytest.raises(KeyError):
        quadrature(4, 3)
