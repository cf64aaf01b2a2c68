"""Meshes: node counts, node sets, quality, files."""

import os

import gmsh
import numpy as np
import pytest
import pyvista

from r37core.base.io import InputFileError
from r37core.fem.elements import ELEMENTS
from r37core.fem.mesh_quality import MeshQualityError, check_quality, mesh_quality
from r37core.mesh.blade_mesh import NODE_SETS
from r37core.mesh.generate import generate_mesh, quiet_gmsh
from r37core.mesh.mesh_files import read_vtu, write_vtu


@pytest.mark.slow
@pytest.mark.parametrize(("nodes", "layers", "tip_elements"), [(2500, 1, 14), (10000, 1, 28), (20000, 1, 42), (9000, 2, 21)])
def test_node_count_is_met(blade, nodes, layers, tip_elements):
    mesh = generate_mesh(blade, nodes, layers, tip_elements)
    assert len(mesh.points) == pytest.approx(nodes, rel=0.02)
    assert len(mesh.node_set("tip_pressure_edge")) == 2 * tip_elements + 1
    assert len(mesh.node_set("tip_camber_line")) == tip_elements + 1 if layers == 1 else 2 * tip_elements + 1
    assert mesh_quality(mesh).min() > 0.2
    wedge = ELEMENTS["wedge15"]
    determinant = np.linalg.det(wedge.jacobian(mesh.points[mesh.blocks["wedge15"]], wedge.mass_rule[0]))
    assert np.sum(determinant @ wedge.mass_rule[1]) == pytest.approx(blade.volume(), rel=2e-3)


def test_impossible_count_is_refused(blade):
    with pytest.raises(ValueError, match=r"mesh: no mesh of about 600 nodes has 300 elements"):
        generate_mesh(blade, 600, 1, 300)


def test_every_node_is_used_once(mesh):
    assert np.array_equal(np.unique(mesh.blocks["wedge15"]), np.arange(len(mesh.points)))
    assert len(np.unique(np.round(mesh.points, 9), axis=0)) == len(mesh.points)


def test_node_sets_lie_where_they_should(blade, mesh):
    for name, side in {"tip_pressure_edge": -1.0, "tip_suction_edge": 1.0, "tip_camber_line": 0.0}.items():
        nodes = mesh.node_set(name)
        assert np.all(np.diff(mesh.parameters[nodes, 0]) > 0.0)
        assert np.all(mesh.parameters[nodes, 1:] == (1.0, side))
    np.testing.assert_array_equal(mesh.points, blade.position(*mesh.parameters.T))
    assert np.all(mesh.parameters[mesh.node_set("root"), 1] == 0.0)
    assert set(mesh.node_set("root")).isdisjoint(mesh.free_nodes)
    with pytest.raises(KeyError):
        mesh.node_set("hub")


def test_same_mesh_every_time(blade, mesh):
    again = generate_mesh(blade, nodes=2500, layers=1, tip_elements=14)
    np.testing.assert_array_equal(again.points, mesh.points)
    np.testing.assert_array_equal(again.blocks["wedge15"], mesh.blocks["wedge15"])


def test_quality_check_names_the_key(mesh):
    quality = mesh_quality(mesh)
    assert quality.min() <= np.quantile(quality, 0.01) <= 1.0
    message = r"^span \d+\.\d%: element \d+ has .* minimum_scaled_jacobian .*, chord_percent"
    with pytest.raises(MeshQualityError, match=message) as raised:
        check_quality(mesh, quality, 0.9)
    worst = mesh.parameters[mesh.blocks["wedge15"][quality.argmin()], 1].mean()
    assert f"span {100 * worst:.1f}%" in str(raised.value)


def test_vtu_round_trip(mesh, tmp_path):
    quality, file = mesh_quality(mesh), tmp_path / "mesh.vtu"
    write_vtu(mesh, file, quality)
    again = read_vtu(file)
    for field in ("points", "parameters", "normals"):
        np.testing.assert_array_equal(getattr(again, field), getattr(mesh, field))
    np.testing.assert_array_equal(again.blocks["wedge15"], mesh.blocks["wedge15"])
    for name in NODE_SETS:
        np.testing.assert_array_equal(again.node_set(name), mesh.node_set(name))
    grid = pyvista.read(file)
    assert grid.field_data["scaled_jacobian_minimum"][0] == quality.min()
    assert grid.compute_cell_sizes()["Volume"].min() > 0.0
    for name in NODE_SETS:
        np.testing.assert_array_equal(np.flatnonzero(grid.point_data[name]), np.sort(mesh.node_set(name)))
    # half written
    file.write_bytes(file.read_bytes()[:2000])
    with pytest.raises(InputFileError, match=r"mesh\.vtu: cannot be read"):
        read_vtu(file)


def test_msh_has_the_mapped_nodes_and_named_groups(blade, tmp_path):
    file = tmp_path / "mesh.msh"
    mesh = generate_mesh(blade, 1500, 1, 10, file)
    with quiet_gmsh():
        gmsh.open(str(file))
        groups = {gmsh.model.getPhysicalName(*group): group for group in gmsh.model.getPhysicalGroups()}
        assert set(groups) == {"blade", *NODE_SETS}
        tags, points, _ = gmsh.model.mesh.getNodes()
        np.testing.assert_allclose(points.reshape(-1, 3)[np.argsort(tags)], mesh.points, atol=1e-12)
        for name in NODE_SETS:
            nodes, _ = gmsh.model.mesh.getNodesForPhysicalGroup(*groups[name])
            assert len(nodes) == len(mesh.node_set(name))
        assert gmsh.model.mesh.getElementsByType(18)[0].size == len(mesh.blocks["wedge15"])


def test_a_broken_pipe_raises_after_a_mesh():
    with quiet_gmsh():
        pass
    reading, writing = os.pipe()
    os.close(reading)
    with pytest.raises(BrokenPipeError):
        os.write(writing, b"x")
    os.close(writing)
