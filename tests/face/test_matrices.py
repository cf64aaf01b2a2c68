"""Matrices that are exported, and imported again."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
from import_defaults import MatricesSource
from test_contact_patches import PATCHES, SPEEDS, every, patched  # noqa: F401

from r37core.fem.orientation import OURS
from r37core.rom.contact_weights import contact_along, mean_fields
from r37core.rom.reduction_choice import BoundaryError
from r37imports.importing.matrices_in import import_matrices
from r37studies.exports.matrices_out import table_nodes, write_full_matrices, write_reduced_matrices


@pytest.fixture(scope="module")
def directory(mesh, matrices, patched, tmp_path_factory):
    """Full matrices of the blade on patches, with all nodes of its edge in boundary.csv."""
    folder = tmp_path_factory.mktemp("matrices")
    np.testing.assert_array_equal(table_nodes(patched, "pressure_edge").nodes, mesh.node_set("tip_pressure_edge"))
    write_full_matrices(matrices, patched, "pressure_edge", SPEEDS, folder)
    return folder


def test_patches_of_full_matrices(directory, patched, reduction):
    """Nodes on the line, and no elements: hats of straight pieces, on a coarse mesh within a percent of the elements' own."""
    again = import_matrices(MatricesSource(str(directory), OURS), replace(PATCHES, nodes=5), reduction)
    assert len(again.singular_values) == len(patched.singular_values)
    np.testing.assert_allclose(again.modes(1000.0, 8)[0], patched.modes(1000.0, 8)[0], rtol=1e-4)
    found, ours = (la.inv(model.stiffness)[:15, :15] for model in (again, patched))
    np.testing.assert_allclose(found, ours, atol=0.02 * np.abs(ours).max())
    np.testing.assert_allclose(again.contact_chord, patched.contact_chord, atol=0.02)


def test_patches_of_reduced_matrices_keep_every_motion(every, reduction, tmp_path):
    """A small model on all nodes of the edge, taken with other coordinates: its modes are the same, its patches means."""
    write_reduced_matrices(every, SPEEDS, tmp_path)
    again = import_matrices(MatricesSource(str(tmp_path), OURS), PATCHES, reduction)
    assert again.size == every.size
    np.testing.assert_allclose(again.modes(1500.0)[0][:40], every.modes(1500.0)[0][:40], rtol=1e-7)
    chord = np.linspace(0.0, 1.0, len(every.contact_nodes.nodes))
    weights = contact_along(every.contact_nodes.points, chord, PATCHES).weights
    rows = mean_fields(weights, every.contact_nodes.basis).reshape(12, -1)
    np.testing.assert_allclose(again.contact_nodes.basis.reshape(12, -1)[:, :12], np.eye(12), atol=1e-8)
    flexibility = rows @ la.solve(every.stiffness, rows.T)
    np.testing.assert_allclose(la.inv(again.stiffness)[:12, :12], flexibility, atol=2e-3 * np.abs(flexibility).max())


def test_matrices_without_the_nodes_for_patches(model, reduction, tmp_path):
    write_reduced_matrices(model, SPEEDS, tmp_path)
    source = MatricesSource(str(tmp_path), OURS)
    message = r"found 8 contact patches on the 8 nodes of boundary\.csv; allowed: at most 4 .* or contact: points"
    with pytest.raises(BoundaryError, match=message):
        import_matrices(source, replace(PATCHES, nodes=8), reduction)
    single = replace(PATCHES, nodes=1)
    with pytest.raises(BoundaryError, match=r"on the 1 nodes .* allowed: none .* because a patch is made of two or more"):
        contact_along(np.array([[0.25, 0.0, 0.0]]), np.array([0.5]), single)
