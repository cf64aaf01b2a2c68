"""A blade about its equilibrium under rotation: frequencies, statics in CalculiX, stress, files, and refusals."""

import numpy as np
import pytest
from box_mesh import box_mesh
from quadratic_cases import CHOICE, FAR, beam_model, held
from scipy.linalg import eigh

from r37core.config import ConfigError
from r37core.fem.equilibrium import NoEquilibriumError, Rotation
from r37core.fem.large_displacement import LargeDisplacement
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.fem.solver import lowest_modes
from r37core.fem.stress import recovered_stress, second_order_stress
from r37core.rom.contact_model import read_contact_model, write_contact_model
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model, write_reduced_model
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.recovery import stress_operators
from r37core.stress.revolutions import largest_of_revolutions
from r37core.time_integration.simulate import Simulation

SPEED = 1700.0


@pytest.fixture(scope="module")
def rotation(mesh, matrices, steel):
    return Rotation(LargeDisplacement(mesh.blocks, mesh.points, steel), matrices, follows=False)


@pytest.fixture(scope="module")
def equilibrium(rotation):
    """Displacement at a speed at which the reduced model has none of its own."""
    return next(rotation.equilibria([SPEED])).displacement


def test_forces_balance_at_the_equilibrium(rotation, equilibrium, matrices):
    load = SPEED**2 * np.linalg.norm(matrices.centrifugal_load)
    assert np.linalg.norm(rotation.residual(equilibrium, SPEED)) < 1e-8 * load


def test_the_tangent_is_the_derivative_of_the_forces(mesh, matrices, steel, equilibrium):
    """Spin softening in it."""
    softened = Rotation(LargeDisplacement(mesh.blocks, mesh.points, steel), matrices, follows=True)
    along = 1e-7 * softened.free(mesh.points)
    ends = (softened.residual(equilibrium + sign * softened.whole(along), SPEED) for sign in (-1.0, 1.0))
    expected, found = 0.5 * np.subtract(*ends), softened.tangent(equilibrium, SPEED) @ along
    assert np.linalg.norm(found - expected) < 1e-3 * np.linalg.norm(SPEED**2 * (matrices.spin_softening() @ along))


def test_frequencies_between_the_speeds_of_the_basis(rotation, equilibrium, displaced, matrices):
    """Of the full model's tangent, within 0.1% of the first, 0.5% of the others: as far as the basis has them at its speeds."""
    squares, _ = lowest_modes(rotation.tangent(equilibrium, SPEED), matrices.mass(), 4)
    frequencies, _ = displaced.modes(SPEED, 4)
    np.testing.assert_allclose(frequencies, np.sqrt(squares), rtol=5e-3)
    assert frequencies[0] == pytest.approx(np.sqrt(squares[0]), rel=1e-3)


def test_the_mean_stiffening_is_that_up_to_half_of_the_highest_speed(displaced):
    half = displaced.logarithmic_stiffness.speeds[0]
    squares = eigh(displaced.stiffness + half**2 * displaced.geometric_stiffness, displaced.mass, eigvals_only=True)
    np.testing.assert_allclose(np.sqrt(squares[:4]), displaced.modes(half, 4)[0], rtol=1e-6)


def test_displacement_between_the_speeds_of_the_basis(displaced, equilibrium):
    ours = displaced.whole_blade.rotation_shapes @ rotation_amplitudes(displaced.rotation_stiffening, SPEED)
    assert np.abs(ours - equilibrium).max() < 5e-3 * np.abs(equilibrium).max()


def test_frequencies_of_a_rotating_beam():
    """Flapping of a cantilever whose root is on the axis: w L^2 sqrt(m/EI) over W L^2 sqrt(m/EI).

    Wright, Smith, Thresher and Wang, J. Appl. Mech. 49 (1982) 197-202, table 1.
    """
    published = {0: 3.5160, 1: 3.6816, 2: 4.1373, 3: 4.7973, 4: 5.5850, 5: 6.4495, 6: 7.3604}
    # of a solid: bending stiffness and mass per length of the section
    unit = np.sqrt(200e9 * 0.01 * 0.002**3 / 12.0 / (8000.0 * 0.01 * 0.002)) / 0.2**2
    model = beam_model(along_axis=True, maximum=6.0 * unit, kinematics="rotating")
    for speed, frequency in published.items():
        assert model.modes(speed * unit, 1)[0][0] / unit == pytest.approx(frequency, rel=5e-3)


def test_a_blade_without_a_stable_position_is_refused():
    """A thin rod whose root is ahead of the axis is bent by its load, and with softening no stiffness holds it."""
    mesh = box_mesh(0.2, 0.002, 0.01, (8, 1, 1), origin=(0.2, -0.001, -0.005), element="hexahedron20")
    rubber = Material(5e4, 8000.0, 0.3)
    rotation = Rotation(LargeDisplacement(mesh.blocks, mesh.points, rubber), assemble(mesh, rubber), follows=True)
    with pytest.raises(NoEquilibriumError, match="maximum_speed_rad_s"):
        next(rotation.equilibria([1000.0]))


@pytest.fixture(scope="module")
def loads(displaced, matrices, mesh, rotation, equilibrium):
    """Nodal forces that move the leading edge by a millimetre along the first mode, in linear theory."""
    squares, modes = lowest_modes(rotation.tangent(equilibrium, SPEED), matrices.mass(), 1)
    mode, edge = rotation.whole(modes[:, 0]), mesh.node_set("tip_pressure_edge")[0]
    size = 1e-3 * np.sign(mode[edge, 1]) / np.linalg.norm(mode[edge])
    return rotation.whole(size * squares[0] * (matrices.mass() @ modes[:, 0]))


def outwards(mesh, displacement, before):
    """How far the leading edge has moved from the axis, beyond where it was before."""
    edge = mesh.node_set("tip_pressure_edge")[0]
    radii = [np.hypot(*(mesh.points + field)[edge, :2]) for field in (displacement, before)]
    return radii[0] - radii[1]


def moved_by_the_model(displaced, mesh, loads, motion):
    """Radial motion (m) of the leading edge in the reduced model, under a load along the first mode."""
    simulation = Simulation(contact_model(displaced, "pressure_edge"), SPEED, FAR, CHOICE)
    free = displaced.whole_blade.basis
    modes = simulation.problem.model.to_reduced @ simulation.problem.blade.modes
    force = motion * np.einsum("nxm,nx->m", free @ modes, loads)
    shape = displaced.whole_blade.basis @ (simulation.problem.model.to_reduced @ held(simulation, force)[1])
    rotated = displaced.whole_blade.rotation_shapes @ rotation_amplitudes(displaced.rotation_stiffening, SPEED)
    return outwards(mesh, rotated + shape, rotated)


@pytest.mark.slow
def test_motion_of_the_tip_in_the_full_model(displaced, mesh, rotation, equilibrium, loads):
    """Three millimetres there and back, by Newton's method from the reduced model's answer on."""
    for motion in (-3.0, 3.0):
        field = newton(rotation, equilibrium, motion * rotation.free(loads))
        full = outwards(mesh, field, equilibrium)
        assert moved_by_the_model(displaced, mesh, loads, motion) == pytest.approx(full, abs=5e-6)
        # what linear theory has is symmetric
        assert abs(full - motion * 7.4e-5) > 3e-5


def newton(rotation, start, force):
    """The position near another one under more forces, in ten steps."""
    from r37core.fem.solver import factorise

    field = start
    for share in np.linspace(0.0, 1.0, 11)[1:]:
        solve = factorise(rotation.tangent(field, SPEED))
        for _ in range(30):
            correction = solve(rotation.residual(field, SPEED) + share * force)
            field = field + rotation.whole(correction)
            if np.linalg.norm(correction) < 1e-9 * np.linalg.norm(field):
                break
    return field


def test_a_turned_body_has_no_stress(mesh, steel):
    turn = np.array([[np.cos(0.3), -np.sin(0.3), 0.0], [np.sin(0.3), np.cos(0.3), 0.0], [0.0, 0.0, 1.0]])
    field = (mesh.points @ turn.T - mesh.points)[:, :, None]
    first = recovered_stress(mesh.blocks, mesh.points, field, steel, False)
    second = second_order_stress(mesh.blocks, mesh.points, field, field, steel, False)
    assert np.abs(first).max() > 1e9
    assert np.abs(first + 0.5 * second).max() < 1.0


def test_the_largest_stress_of_a_revolution_has_the_products(displaced, steel):
    box = stress_operators(displaced, steel)["box"].displaced(SPEED)
    states = np.random.default_rng(0).standard_normal((32, 3)) * [3e-4, 5e-5, 2e-5]
    shapes, rotation = displaced.modes(SPEED, 3)[1], rotation_amplitudes(displaced.rotation_stiffening, SPEED)
    found, _ = largest_of_revolutions(box, states, shapes, rotation, 16)
    coordinates = np.hstack([states @ shapes.T, np.tile(rotation, (32, 1))])
    np.testing.assert_allclose(found, box.max_von_mises(coordinates).reshape(2, 16).max(axis=1), rtol=1e-4)


def test_files_hold_the_model(displaced, tmp_path):
    write_reduced_model(displaced, tmp_path / "rom.nc")
    again = read_reduced_model(tmp_path / "rom.nc")
    write_contact_model(contact_model(again, "pressure_edge"), tmp_path / "contact.npz")
    model, contact = read_contact_model(tmp_path / "contact.npz"), contact_model(displaced, "pressure_edge")
    for part in ("logarithmic_stiffness", "quadratic"):
        for name, value in vars(getattr(contact, part)).items():
            assert np.array_equal(getattr(getattr(model, part), name), value), name
    np.testing.assert_array_equal(model.modes_at(SPEED)[0], contact.modes_at(SPEED)[0])
    assert model.modes_at(SPEED)[0][0] == pytest.approx(displaced.modes(SPEED, 1)[0][0], rel=1e-9)


@pytest.mark.slow
def test_rotating_has_the_modes_alone(reduced, displaced, steel):
    model = reduced(kinematics="rotating")
    assert model.quadratic is None
    np.testing.assert_allclose(model.modes(SPEED, 3)[0], displaced.modes(SPEED, 3)[0], rtol=1e-3)
    # nor has its stress products
    operator = stress_operators(model, steel)["box"]
    assert operator.operator.shape[2] == model.size + len(model.rotation_stiffening)


def test_the_blade_whose_own_kinematics_cannot_be_had_is_named(with_blades):
    with pytest.raises(ConfigError, match=r"blades\.yaml:\d+: Own\.kinematics: found quadratic at the level 'paper'"):
        with_blades("Own: { base: Ref, kinematics: quadratic }", blades=["Ref", "Own"], fidelity="paper")
