"""The reduced model against the full one."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
import scipy.sparse as sp
from defaults import BoundaryChoice

from r37core.base.io import InputFileError
from r37core.fem.solver import lowest_modes
from r37core.rom.contact_weights import tip_contact
from r37core.rom.craig_bampton import combine_columns, constraint_and_fixed_modes
from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.rom.reduction_choice import BoundaryError
from r37core.rom.rom_file import read_reduced_model, write_reduced_model


def full_frequencies(matrices, speed, count=10):
    stiffness = matrices.stiffness() + speed**2 * matrices.geometric_stiffness()
    return np.sqrt(lowest_modes(stiffness, matrices.mass(), count)[0])


def boundary_rows(matrices, model):
    """Contact nodes' displacements from all of them: a 1 in each row."""
    dofs = (3 * np.searchsorted(matrices.free_nodes, model.contact_nodes.nodes)[:, None] + np.arange(3)).ravel()
    return sp.csr_array((np.ones(len(dofs)), (np.arange(len(dofs)), dofs)), shape=(len(dofs), matrices.mass().shape[0]))


def test_frequencies_are_those_of_the_full_model(matrices, model, reduced):
    """Ten fixed-interface modes: six frequencies within 1e-4, ten within 5e-4, all from above (Rayleigh); twenty: ten."""
    richer = reduced(fixed_interface_modes=20)
    for speed in (0.0, 450.0, 1000.0, 1630.0, 2000.0):
        full = full_frequencies(matrices, speed)
        error = model.modes(speed, 10)[0] / full - 1.0
        assert np.all(error > -1e-9)
        assert np.all(error[:6] < 1e-4)
        assert np.all(error < 5e-4)
        np.testing.assert_allclose(richer.modes(speed, 10)[0], full, rtol=1e-4)


def test_columns_are_counted(model, reduction):
    assert len(model.singular_values) == 3 * (8 * 3 + 10) == 102
    assert model.size == np.sum(model.singular_values > reduction.basis_tolerance * model.singular_values[0])
    assert 60 < model.size <= 102


def test_stiffness_has_no_fourth_power_of_speed(model):
    assert model.quadratic_residual < 1e-11


def test_boundary_coordinates_are_the_displacements(mesh, model):
    line = model.tip_lines["pressure_edge"]
    for i, node in enumerate(model.contact_nodes.nodes):
        row = int(np.flatnonzero(line.nodes == node)[0])
        np.testing.assert_allclose(line.basis[row], np.eye(3, model.size, 3 * i), atol=1e-12)


def test_static_response_to_a_tip_load_is_exact(mesh, matrices, model):
    load = np.zeros_like(mesh.points)
    load[model.contact_nodes.nodes[2]] = [10.0, -40.0, 25.0]
    exact = matrices.displaced_by(load)
    force = np.zeros(model.size)
    force[6:9] = [10.0, -40.0, 25.0]
    reduced = la.solve(model.stiffness, force, assume_a="pos")
    for part in (*model.tip_lines.values(), model.stress_regions["box"].nodes):
        error = part.basis @ reduced - exact[part.nodes]
        assert np.abs(error).max() < 1e-9 * np.abs(exact).max()


@pytest.mark.slow
def test_order_and_scale_of_columns_do_not_matter(matrices, model, reduction):
    boundary = boundary_rows(matrices, model)
    stiffness, geometric, mass = matrices.stiffness(), matrices.geometric_stiffness(), matrices.mass()
    sets = [
        constraint_and_fixed_modes((stiffness + speed**2 * geometric).tocsr(), mass, boundary, 10) for speed in reduction.speeds
    ]
    columns = np.hstack([part for pair in sets for part in pair])
    generator = np.random.default_rng(5)
    shuffled = columns[:, generator.permutation(102)] * 10.0 ** generator.uniform(-6.0, 6.0, 102)

    def frequencies(some_columns):
        vectors = combine_columns(sets[0][0], some_columns, mass, boundary, reduction.basis_tolerance)[0]
        reduced = vectors.T @ (stiffness @ vectors) + 1500.0**2 * (vectors.T @ (geometric @ vectors))
        return np.sqrt(la.eigh(reduced, vectors.T @ (mass @ vectors), eigvals_only=True)[:10])

    np.testing.assert_allclose(frequencies(shuffled), frequencies(columns), rtol=1e-10)


def test_dependent_columns_are_dropped(matrices, model):
    boundary = boundary_rows(matrices, model)
    mass = matrices.mass()
    constraint, fixed = constraint_and_fixed_modes(matrices.stiffness(), mass, boundary, 10)
    twice = np.hstack([constraint, fixed, 3.0 * constraint, fixed])
    vectors, singular_values = combine_columns(constraint, twice, mass, boundary, 1e-8)
    assert len(singular_values) == 68
    assert vectors.shape[1] == 34


@pytest.mark.slow
def test_rotation_terms_only_when_asked(mesh, matrices, reduced, model, tmp_path):
    assert model.spin_softening is None
    assert model.whole_blade is None
    write_reduced_model(model, tmp_path / "rom.nc")
    again = read_reduced_model(tmp_path / "rom.nc")
    assert again.spin_softening is None and again.whole_blade is None
    full = reduced(spin_softening=True, recover_whole_blade=True, fixed_interface_modes=20)
    assert full.whole_blade.basis.shape == (len(mesh.points), 3, full.size)
    stiffness = matrices.stiffness() + 1500.0**2 * (matrices.geometric_stiffness() + matrices.spin_softening())
    exact = np.sqrt(lowest_modes(stiffness, matrices.mass(), 10)[0])
    np.testing.assert_allclose(full.modes(1500.0, 10)[0], exact, rtol=1e-4)


def test_file_holds_the_model(mesh, model, tmp_path):
    file = tmp_path / "rom.nc"
    write_reduced_model(replace(model, contact="patches"), file, {"blade": "Ref"})
    again = read_reduced_model(file)
    assert again.contact == "patches"
    for field in ("points", "basis"):
        np.testing.assert_array_equal(getattr(again.contact_nodes, field), getattr(model.contact_nodes, field))
    for name in ("stiffness", "mass", "geometric_stiffness", "shape_products", "contact_chord"):
        np.testing.assert_array_equal(getattr(again, name), getattr(model, name))
    assert list(again.stress_regions) == list(model.stress_regions)
    for name, region in model.stress_regions.items():
        found = again.stress_regions[name]
        assert (found.description, found.highest_frequency) == (region.description, region.highest_frequency)
        for ours, theirs in ((found.elements["wedge15"], region.elements["wedge15"]), (found.places, region.places)):
            np.testing.assert_array_equal(ours, theirs)
        np.testing.assert_array_equal(found.evaluated, region.evaluated)
    for line in model.tip_lines:
        np.testing.assert_array_equal(again.tip_lines[line].basis, model.tip_lines[line].basis)
    assert (again.tolerance, again.shape_names) == (model.tolerance, model.shape_names)
    assert again.mesh_nodes == len(mesh.points)
    file.write_bytes(file.read_bytes()[:5000])
    with pytest.raises(InputFileError, match=r"rom\.nc: cannot be read"):
        read_reduced_model(file)


@pytest.mark.parametrize("tip_line", ["pressure_edge", "camber", "suction_edge"])
@pytest.mark.parametrize("corners", [True, False])
@pytest.mark.parametrize("count", [1, 8])
def test_boundary_nodes_lie_on_their_line(mesh, tip_line, corners, count):
    choice = BoundaryChoice(tip_line, count, corners)
    nodes = tip_contact(mesh, choice).weights.indices
    chord, span, thickness = mesh.parameters[nodes].T
    assert np.all(span == 1.0)
    assert np.all(thickness == {"pressure_edge": -1.0, "camber": 0.0, "suction_edge": 1.0}[tip_line])
    np.testing.assert_allclose(chord, choice.chord_positions(choice.nodes), atol=0.5 / 14)
    assert (corners and count > 1) == (chord[0] == 0.0 and chord[-1] == 1.0)


def test_too_many_boundary_nodes_are_refused(mesh):
    with pytest.raises(BoundaryError, match="40 boundary nodes do not fit on the 15 mesh nodes of the tip line 'camber'"):
        tip_contact(mesh, BoundaryChoice("camber", 40))


def test_the_box(mesh, model):
    region = model.stress_regions["box"]
    x, _, z = region.nodes.points.T
    elements = region.elements["wedge15"]
    assert len(elements) >= 4
    assert x.max() < 0.197 and z.min() > 0.0165 and z.max() < 0.0265
    assert not set(region.nodes.nodes) & set(mesh.node_set("root"))
    assert elements.max() == len(region.nodes.nodes) - 1


@pytest.mark.parametrize(
    ("points", "angle"), [([[0.0, 0.25, 0.01], [0.26, 0.0, 0.03]], np.arctan(0.5)), ([[0.2, 0.0, 0.1]], 0.0)]
)
def test_the_cone_of_a_line_goes_through_its_ends(points, angle):
    nothing = np.empty((len(points), 3, 0))
    assert RecoveryNodes(np.arange(len(points)), np.array(points), nothing, nothing).cone_angle == pytest.approx(angle)
