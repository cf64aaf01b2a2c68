"""Results for other programs, and matrices that come back."""

from dataclasses import replace

import numpy as np
import pytest
import pyvista
from box_operator import box_operator
from defaults import Orientation
from full_matrices import write_full_matrices

from r37core.time_integration.speed_file import write_speed
from r37studies.fields import Target, WorstInstant, worst_instants, write_modes, write_stress

NAMES = {"M.mtx", "K_0.mtx", "K_1000.mtx", "K_2000.mtx", "boundary.csv"}
FOREIGN = Orientation("mm", (0.6, 0.8, 0), (0, 0, 1), "positive", (5.0, 6.0, 7.0))


@pytest.fixture(scope="module")
def directory(matrices, model, tmp_path_factory):
    folder = tmp_path_factory.mktemp("matrices")
    write_full_matrices(matrices, model.contact_nodes, (0.0, 1000.0, 2000.0), folder)
    return folder


def test_modes(whole, mesh, tmp_path):
    write_modes(mesh, whole, [0.0, 1500.0], 4, Target(tmp_path))
    collection = pyvista.get_reader(tmp_path / "modes.pvd")
    assert list(collection.time_values) == [0.0, 1500.0]
    grid = pyvista.read(tmp_path / "modes_1500.vtu")
    assert set(grid.point_data.keys()) == {"mode 1B", "mode 1T", "mode 2B", "mode 4"}
    frequency = grid.field_data["frequency of mode 1B (Hz)"][0]
    assert frequency == pytest.approx(whole.modes(1500.0, 1)[0][0] / (2 * np.pi))
    assert np.abs(grid.point_data["mode 1B"][mesh.node_set("root")]).max() == 0.0


@pytest.fixture
def instant(whole, steel, tmp_path):
    """The worst of three runs, of which the second diverged: the second snapshot of the last."""
    shapes = whole.modes(0.0, 3)[1].T * [[1e-4], [5e-4], [1e-4]]
    recovery, speeds = box_operator(whole, steel), (900.0, 1000.0, 1200.0)
    for speed, scale in zip(speeds, (1.0, 9.0, 2.0), strict=True):
        write_speed({"status": np.array(int(speed == 1000.0)), "snapshots": scale * shapes}, tmp_path / f"{speed}.npz", {})
    files = [tmp_path / f"{speed}.npz" for speed in speeds]
    assert list(worst_instants(files, speeds, recovery, only_worst=False)) == [900.0, 1200.0]
    assert worst_instants(files[1:2], speeds[1:2], recovery, only_worst=True) == {}
    found = worst_instants(files, speeds, recovery, only_worst=True)
    assert list(found) == [1200.0]
    stresses = recovery.max_von_mises(2.0 * shapes)
    assert (found[1200.0].number, found[1200.0].largest) == (1, stresses[1]) and np.argmax(stresses) == 1
    np.testing.assert_array_equal(found[1200.0].revolution, 2.0 * shapes)
    return found


def test_stress_of_the_worst_instant(whole, mesh, steel, instant, tmp_path):
    write_stress(mesh, whole, steel, instant, Target(tmp_path))
    grid = pyvista.read(tmp_path / "stress_1200.vtu")
    coordinates = instant[1200.0].revolution[instant[1200.0].number]
    np.testing.assert_allclose(grid.point_data["displacement"], whole.whole_blade.basis @ coordinates)
    # averaged over all elements at a node here, over those of the submesh there
    here = grid.point_data["von Mises stress"][whole.stress_regions["box"].nodes.nodes].max()
    assert here == pytest.approx(instant[1200.0].largest, rel=0.25)
    nothing = WorstInstant(1.0, np.zeros((1, 1)), 0)
    with pytest.raises(ValueError, match="does not recover the whole blade"):
        write_stress(mesh, replace(whole, whole_blade=None), steel, {0.0: nothing}, Target(tmp_path))


def test_results_in_the_axes_of_another_program(whole, mesh, steel, instant, tmp_path):
    """Points, displacement and stress turn together: the same strain energy density, and elements the right way out."""
    write_stress(mesh, whole, steel, instant, Target(tmp_path))
    ours = pyvista.read(tmp_path / "stress_1200.vtu")
    write_stress(mesh, whole, steel, instant, Target(tmp_path, FOREIGN))
    theirs = pyvista.read(tmp_path / "stress_1200.vtu")
    rows = FOREIGN.rows
    np.testing.assert_allclose((theirs.points - [5, 6, 7]) * 1e-3 @ rows.T, ours.points, atol=1e-12)
    np.testing.assert_allclose(1e-3 * theirs.point_data["displacement"] @ rows.T, ours.point_data["displacement"], atol=1e-15)
    xx, yy, zz, xy, yz, zx = theirs.point_data["stress"].T
    tensor = np.stack([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]).transpose(2, 0, 1)
    back = rows @ tensor @ rows.T
    components = np.stack([back[:, a, b] for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))], axis=1)
    np.testing.assert_allclose(components, ours.point_data["stress"], atol=1e-6 * np.abs(components).max())
    assert theirs.compute_cell_sizes()["Volume"].min() > 0.0
