"""Elastic forces at large displacement: derivatives, invariance, and the stiffness of linear theory."""

import numpy as np
import pytest
from box_mesh import box_mesh

from r37core.fem.assembly import NodePattern, assemble_stiffness, block_matrix
from r37core.fem.elements import ELEMENTS
from r37core.fem.large_displacement import LargeDisplacement
from r37core.fem.material import Material

STEEL = Material(180e9, 8000.0, 0.3)


@pytest.fixture(scope="module", params=ELEMENTS)
def solid(request):
    mesh = box_mesh(0.1, 0.03, 0.01, (3, 2, 1), warp=0.5, element=request.param)
    return LargeDisplacement(mesh.blocks, mesh.points, STEEL)


@pytest.fixture
def fields(solid):
    """Displacements of a tenth of the box's height."""
    return 1e-3 * np.random.default_rng(0).standard_normal((4, *solid.points.shape))


def third_derivative(solid, first, second, third):
    """Of forces that are a cubic it is the change of the second derivative, wherever that begins."""
    return solid.second_derivative(third, first, second) - solid.second_derivative(np.zeros_like(third), first, second)


def error(found, wanted):
    return np.abs(found - wanted).max() / np.abs(wanted).max()


def test_with_no_displacement_the_tangent_is_the_stiffness(solid):
    pattern = NodePattern.build(solid.blocks, len(solid.points))
    stiffness = assemble_stiffness(pattern, solid.blocks, solid.points, STEEL)
    assert error(solid.tangent(np.zeros_like(solid.points), pattern), stiffness) < 1e-14


def test_the_forces_are_a_cubic_with_these_derivatives(solid, fields):
    """Their Taylor series ends after the third derivative, which is the same everywhere."""
    displacement, first, second, third = fields
    pattern = NodePattern.build(solid.blocks, len(solid.points))
    tangent = block_matrix(pattern.indptr, pattern.indices, solid.tangent(displacement, pattern))
    series = solid.forces(displacement) + (tangent @ first.ravel()).reshape(first.shape)
    series += solid.second_derivative(displacement, first, first) / 2.0 + third_derivative(solid, first, first, first) / 6.0
    assert error(series, solid.forces(displacement + first)) < 1e-12
    change = solid.second_derivative(displacement + third, first, second) - solid.second_derivative(displacement, first, second)
    assert error(third_derivative(solid, first, second, third), change) < 1e-12


def test_a_turned_solid_has_turned_forces(solid, fields):
    rotation = np.linalg.qr(np.random.default_rng(1).standard_normal((3, 3)))[0]
    rotation *= np.linalg.det(rotation)
    displaced = solid.points + fields[0]
    turned = solid.forces(displaced @ rotation.T - solid.points)
    assert error(turned, solid.forces(fields[0]) @ rotation.T) < 1e-12


def test_strain_energies_are_those_of_the_third_derivative(solid, fields):
    a, b, c, d = fields
    pairs = {"da": (d, a), "bc": (b, c), "db": (d, b), "ca": (c, a), "dc": (d, c), "ab": (a, b)}
    energies = solid.strain_energies(list(pairs.values()))
    total = sum(energies[2 * number, 2 * number + 1] for number in range(3))
    assert total == pytest.approx(np.sum(d * third_derivative(solid, a, b, c)), rel=1e-10)
