"""The table of elements, matrices against closed-form answers, and elastic forces at large displacement."""

import resource
import sys
from dataclasses import replace
from itertools import product
from math import factorial
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from box_mesh import box_mesh

from r37core.fem.assembly import NodePattern, assemble_stiffness, block_matrix
from r37core.fem.elements import ELEMENTS, box_rule, tetrahedron_rule, wedge_rule
from r37core.fem.large_displacement import LargeDisplacement
from r37core.fem.material import Material
from r37core.fem.matrices import assemble, centrifugal_load
from r37core.fem.solver import factorise, lowest_modes
from r37core.fem.stress import stress_at

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


def on_tetrahedron(i, j, k):
    """Integral of x^i y^j z^k."""
    return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3)


def on_wedge(i, j, k):
    return factorial(i) * factorial(j) / factorial(i + j + 2) * 2.0 / (k + 1.0) * (k % 2 == 0)


def on_box(*exponents):
    return np.prod([2.0 / (exponent + 1.0) * (exponent % 2 == 0) for exponent in exponents])


@pytest.mark.parametrize(
    ("rule", "exact", "axes", "degree"),
    [
        (wedge_rule(1, 2), on_wedge, 2, 1),
        (wedge_rule(3, 3), on_wedge, 2, 2),
        (wedge_rule(6, 3), on_wedge, 2, 4),
        (tetrahedron_rule(1), on_tetrahedron, 3, 1),
        (tetrahedron_rule(4), on_tetrahedron, 3, 2),
        (tetrahedron_rule(15), on_tetrahedron, 3, 5),
        (box_rule(3), on_box, 1, 5),
    ],
)
def test_quadrature_is_exact_to_its_degree(rule, exact, axes, degree):
    """Of a degree in the first `axes` together, and in each other one."""
    points, weights = rule
    for exponents in product(range(degree + 1), repeat=3):
        if sum(exponents[:axes]) <= degree:
            found = weights @ np.prod(points**exponents, axis=1)
            assert found == pytest.approx(exact(*exponents), rel=1e-12, abs=1e-14)


def mixed(i, j, k):
    return "hexahedron20" if i % 2 else "wedge15"


def stacked(i, j, k):
    return "tetra10" if k else "wedge15"


QUADRATIC = {name: name for name, element in ELEMENTS.items() if element.quadratic} | {"mixed": mixed, "stacked": stacked}
LINEAR = [name for name, element in ELEMENTS.items() if not element.quadratic]
each_quadratic = pytest.mark.parametrize("kind", QUADRATIC.values(), ids=QUADRATIC)
each_kind = pytest.mark.parametrize("kind", [*QUADRATIC.values(), *LINEAR], ids=[*QUADRATIC, *LINEAR])

MATERIAL = Material(youngs_modulus=180e9, density=8000.0, poissons_ratio=0.3, yield_stress=1.38e9)
SLENDER = replace(MATERIAL, poissons_ratio=0.0)
"""A beam's own: another Poisson's ratio holds its root."""


def unclamped(matrices):
    """The same matrices with every node free."""
    return replace(matrices, free_nodes=np.arange(len(matrices.indptr) - 1))


def straightened(mesh):
    """The same mesh with straight edges."""
    points = mesh.points.copy()
    for name, nodes in mesh.blocks.items():
        for (i, j), middle in ELEMENTS[name].edges.items():
            points[nodes[:, middle]] = 0.5 * (points[nodes[:, i]] + points[nodes[:, j]])
    return replace(mesh, points=points)


@each_kind
def test_patch(kind):
    """A linear displacement field is carried exactly by distorted elements: constant stress, no inner forces."""
    # the four points of the tetrahedron are exact only where its edges are straight
    mesh = box_mesh(1.0, 0.7, 0.5, (2, 2, 2), warp=1.5, element=kind)
    mesh = straightened(mesh) if "tetra10" in mesh.blocks else mesh
    gradient = 1e-3 * np.array([[1.0, 0.4, -0.2], [0.3, -0.7, 0.5], [0.1, 0.2, 0.9]])
    displacement = mesh.points @ gradient.T
    strain = 0.5 * (gradient + gradient.T)
    lame, shear = MATERIAL.lame_constants
    expected = 2 * shear * strain + lame * np.trace(strain) * np.eye(3)
    for name, nodes in mesh.blocks.items():
        element = ELEMENTS[name]
        gradients, _ = element.physical_gradients(mesh.points[nodes], element.stiffness_rule[0])
        stress = stress_at(gradients, displacement[nodes], MATERIAL)
        np.testing.assert_allclose(stress, np.broadcast_to(expected, stress.shape), atol=1e-9 * np.abs(expected).max())
    matrices = unclamped(assemble(mesh, MATERIAL))
    force = (matrices.stiffness() @ displacement.ravel()).reshape(-1, 3)
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    inner = np.all((mesh.points > low + 1e-9) & (mesh.points < high - 1e-9), axis=1)
    assert inner.any()
    assert np.abs(force[inner]).max() < 1e-9 * np.abs(force).max()


@each_element
def test_one_element_has_six_motions_without_energy(element):
    points = element.nodes @ np.array([[1.0, 0.2, 0.1], [0.0, 0.9, 0.3], [0.1, 0.0, 1.2]])
    blocks = {element.name: np.arange(len(points))[None]}
    pattern = NodePattern.build(blocks, len(points))
    stiffness = assemble_stiffness(pattern, blocks, points, MATERIAL)
    values = np.linalg.eigvalsh(block_matrix(pattern.indptr, pattern.indices, stiffness).toarray())
    assert np.abs(values[:6]).max() < 1e-10 * values[-1]
    assert values[6] > 1e-4 * values[-1]


@each_kind
def test_mass_of_a_box(kind):
    mesh = box_mesh(0.3, 0.2, 0.1, (2, 2, 2), warp=1.0, element=kind)
    matrices = assemble(mesh, MATERIAL)
    assert matrices.total_mass == pytest.approx(8000 * 0.3 * 0.2 * 0.1, rel=1e-6)
    load = centrifugal_load(mesh.blocks, mesh.points, 8000.0).sum(axis=0)
    np.testing.assert_allclose(load, np.array([0.15, 0.1, 0.0]) * matrices.total_mass, rtol=1e-2, atol=1e-9)
    # mass times radius
    arm = (mesh.points * [1.0, 1.0, 0.0]).ravel()
    np.testing.assert_allclose(load, (unclamped(matrices).mass() @ arm).reshape(-1, 3).sum(axis=0), rtol=1e-9, atol=1e-9)


def test_matrices_are_symmetric_and_positive(matrices):
    for matrix in (matrices.stiffness(), matrices.mass(), matrices.geometric_stiffness()):
        assert abs(matrix - matrix.T).max() < 1e-12 * abs(matrix).max()
    values, _ = lowest_modes(matrices.stiffness(), matrices.mass(), 1)
    assert values[0] > 0.0


def layers(kind):
    return 2 if kind is stacked else 1


def beam_modes(mesh, count, material=MATERIAL, speed=0.0, softening=False):
    matrices = assemble(mesh, material)
    stiffness = matrices.stiffness() + speed**2 * matrices.geometric_stiffness()
    if softening:
        stiffness = stiffness + speed**2 * matrices.spin_softening()
    values, modes = lowest_modes(stiffness, matrices.mass(), count)
    return values, modes.reshape(-1, 3, count)


@each_quadratic
def test_cantilever(kind):
    """Frequencies of Euler-Bernoulli, Timoshenko's correction below 0.1% at this slenderness (Blevins), and a tip load."""
    length, side, force = 1.0, 0.02, 100.0
    mesh = box_mesh(length, side, side, (24, 1, layers(kind)), element=kind)
    values, _ = beam_modes(mesh, 4, SLENDER)
    bending = np.sqrt(180e9 * side**2 / 12.0 / 8000.0) / length**2
    assert np.sqrt(values[:2]) == pytest.approx([1.87510407**2 * bending] * 2, rel=1e-3)
    assert np.sqrt(values[2:4]) == pytest.approx([4.69409113**2 * bending] * 2, rel=4e-3)
    load = np.zeros_like(mesh.points)
    tip = np.flatnonzero(mesh.parameters[:, 1] == 1.0)
    load[tip, 2] = force / len(tip)
    deflection = assemble(mesh, SLENDER).displaced_by(load)[tip, 2].mean()
    inertia = side**4 / 12.0
    shear = 1.2 * force * length / (0.5 * 180e9 * side**2)
    assert deflection == pytest.approx(force * length**3 / (3 * 180e9 * inertia) + shear, rel=2e-3)


@pytest.mark.parametrize("kind", LINEAR)
def test_linear_elements_are_too_stiff_and_converge(kind):
    """A stubby cantilever; second-order hexahedra as the reference."""
    exact = beam_modes(box_mesh(0.1, 0.02, 0.02, (10, 2, 2), element="hexahedron20"), 2)[0][0]
    errors = [beam_modes(box_mesh(0.1, 0.02, 0.02, (5 * n, n, n), element=kind), 2)[0][0] / exact - 1.0 for n in (2, 4)]
    assert errors[0] > 2.5 * errors[1] > 0.0
    assert errors[1] < 0.7


@pytest.mark.parametrize("hub_ratio", [0.0, 1.0, 3.0])
@each_kind
def test_rotating_beam_flapwise_coefficient(kind, hub_ratio):
    """omega^2 = omega_0^2 + (1.193 + 1.571 R/L) Omega^2 for the first flapwise mode of a uniform cantilever."""
    length, side = 1.0, 0.02
    origin = (hub_ratio * length, -side / 2, -side / 2)
    mesh = box_mesh(length, side, 0.6 * side, (16, 1, layers(kind)), origin=origin, element=kind)
    speed = 20.0

    def flapwise(at_speed):
        values, modes = beam_modes(mesh, 2, speed=at_speed)
        return values[np.argmax(np.sum(modes[:, 2, :] ** 2, axis=0))]

    coefficient = (flapwise(speed) - flapwise(0.0)) / speed**2
    assert coefficient == pytest.approx(1.193 + 1.571 * hub_ratio, rel=0.01)


def test_spin_softening_lowers_lead_lag_by_omega_squared():
    side, speed = 0.02, 20.0
    mesh = box_mesh(1.0, side, 1.5 * side, (16, 1, 1), origin=(0.5, -side / 2, -0.75 * side))
    without, modes = beam_modes(mesh, 2, speed=speed)
    with_softening, softened = beam_modes(mesh, 2, speed=speed, softening=True)
    lag = int(np.argmax(np.sum(modes[:, 1, :] ** 2, axis=0)))
    softened_lag = int(np.argmax(np.sum(softened[:, 1, :] ** 2, axis=0)))
    assert without[lag] - with_softening[softened_lag] == pytest.approx(speed**2, rel=1e-4)
    # flapwise motion is parallel to the axis but for the turning of the sections
    assert without[1 - lag] - with_softening[1 - softened_lag] == pytest.approx(0.0, abs=2e-3 * speed**2)


def test_results_do_not_change_from_run_to_run(mesh, matrices):
    again = assemble(mesh, MATERIAL)
    np.testing.assert_array_equal(again.stiffness_blocks, matrices.stiffness_blocks)
    np.testing.assert_array_equal(again.geometric_pairs, matrices.geometric_pairs)


@pytest.fixture(scope="module", params=ELEMENTS)
def solid(request):
    mesh = box_mesh(0.1, 0.03, 0.01, (3, 2, 1), warp=0.5, element=request.param)
    return LargeDisplacement(mesh.blocks, mesh.points, MATERIAL)


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
    stiffness = assemble_stiffness(pattern, solid.blocks, solid.points, MATERIAL)
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


@pytest.mark.skipif(sys.platform != "linux", reason="Linux tells how much address space is taken")
def test_factors_without_room_are_an_error_with_what_they_need():
    """SuperLU would enlarge its arrays again and again."""
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    matrix = sp.dia_array((np.ones((3, 10**6)), [-1, 0, 1]), shape=(10**6, 10**6))
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + 10**9, hard))
    try:
        with pytest.raises(
            MemoryError, match=r"the factors of 1000000 degrees of freedom need room for 1200 MB; raise the limit"
        ):
            factorise(matrix)
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
