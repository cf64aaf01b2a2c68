"""The parts that an import is made of, one at a time: what each does at its borders."""

import warnings
from contextlib import nullcontext
from dataclasses import replace

import meshio
import numpy as np
import pytest
from box_mesh import box_mesh, plate
from defaults import Orientation

from r37core.blade.sense import sense_of_line
from r37core.exchange.importing import ends, meshio_reader, tip
from r37core.exchange.importing.fitting_entry import find_axes
from r37core.exchange.importing.frame import blade_parameters
from r37core.exchange.importing.raw_mesh import RawMesh
from r37core.exchange.importing.source import matrix_files
from r37core.exchange.orientation import OURS
from r37core.exchange.refusal import ImportRefused
from r37core.fem.surface import outer_faces


def raw(mesh):
    return RawMesh(mesh.points, np.arange(1, len(mesh.points) + 1), mesh.blocks, {})


def refused_unless(fits, message):
    return nullcontext() if fits else pytest.raises(ImportRefused, match=message)


def turned(points, degrees):
    """About z."""
    angle = np.radians(degrees)
    return points @ np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])


@pytest.mark.parametrize("camber_deg", [2.0, 12.0])
@pytest.mark.parametrize("stagger_deg", [-30.0, 40.0])
@pytest.mark.parametrize("place_deg", [0.0, 70.0])
def test_the_sense_of_an_arc_is_its_stagger_and_camber(camber_deg, stagger_deg, place_deg):
    """On a tip far out, wherever it is round the axis."""
    camber, stagger = np.radians([camber_deg, stagger_deg])
    turn = np.linspace(-0.5, 0.5, 101) * camber
    along, up = 0.03 * np.sin(turn) / np.sin(0.5 * camber), 0.03 * (np.cos(turn) - np.cos(0.5 * camber)) / np.sin(0.5 * camber)
    z, y = along * np.cos(stagger) - up * np.sin(stagger), along * np.sin(stagger) + up * np.cos(stagger)
    line = turned(np.stack([5.0 * np.cos(y / 5.0), 5.0 * np.sin(y / 5.0), z], axis=1), place_deg)
    sense = sense_of_line(line)
    np.testing.assert_allclose(np.degrees([sense.stagger, sense.camber]), [stagger_deg, camber_deg], rtol=5e-3)


@pytest.mark.parametrize("upside_down", [False, True])
def test_axes_are_found_about_any_point_and_are_units(upside_down):
    mesh = box_mesh(0.06, 0.004, 0.03, (6, 2, 6), origin=(0.2, -0.002, 0.0), element="hexahedron20")
    x, y, z = mesh.points.T
    # on cones, staggered and cambered, as a compressor's blade is
    along = (z - 0.015) / 0.03
    y = y - 0.6 * (z - 0.015) - 0.006 * (1.0 - 4.0 * along**2)
    points = np.stack([np.sqrt(x**2 - y**2), y, z], axis=1)
    offset = np.array([0.5, -0.3, 0.2])
    # the file has its axis along y and the blade along z
    half_a_turn = np.array([-1.0, -1.0, 1.0]) if upside_down else np.ones(3)
    theirs = replace(raw(mesh), points=half_a_turn * points[:, [1, 2, 0]] + offset)
    like = Orientation("m", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), "positive", tuple(offset))
    axes = find_axes(theirs, like)
    assert axes is not None
    assert sorted(np.abs(axes.rotor_axis)) == [0.0, 0.0, 1.0] and abs(axes.rotor_axis[1]) == 1.0
    assert axes.radial == (0.0, 0.0, 1.0)


def test_a_ring_in_one_plane_is_a_cylinder_without_a_warning():
    angle = np.linspace(0.0, 0.3, 9)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rule = ends._cone(np.stack([0.2 * np.cos(angle), 0.2 * np.sin(angle), np.full(9, 0.01)], axis=1))
    assert rule.cone_zr == ((0.01, 0.2), (1.01, 0.2)) and rule.tolerance == ends._TOLERANCES[0]


def test_an_end_of_a_small_blade_is_straight_within_the_smallest_tolerance():
    """A blade of 2 mm, of which a share is less than that."""
    mesh = box_mesh(0.002, 0.0001, 0.001, (2, 1, 2), origin=(0.2, -0.00005, 0.0), element="hexahedron20")
    assert ends._TOLERANCES[0] > ends._STRAIGHT * 0.002
    for what in ("root", "tip"):
        end = ends.find_end(what, mesh.points, outer_faces(mesh.blocks))
        assert end.rule.tolerance == ends._TOLERANCES[0] and end.straight


def test_sets_of_a_mesh_are_its_whole_numbers_by_value():
    """Of nodes and cells; numbers with a fraction and vectors are none."""
    points = np.zeros((5, 3))
    cells = [("line", np.array([[0, 1], [2, 3]])), ("line", np.array([[3, 4]]))]
    numbers = {"mark": [0, 0, 1, 1, 0], "part": [7, 8, 8, 8, 7], "heat": [0.0, 1.0, 1.0, 0.0, 0.0], "pair": [[0, 0]] * 5}
    of_cells = {"region": [np.array([1, 2]), np.array([2])]}
    sets = {"some": [np.array([1]), np.array([0])], "first": [np.array([0]), None]}
    mesh = meshio.Mesh(points, cells, {name: np.array(of) for name, of in numbers.items()}, of_cells, cell_sets=sets)
    sets = {name: sorted(set(nodes.tolist())) for name, nodes in meshio_reader._sets(mesh)}
    assert sets == {
        "mark=0": [0, 1, 4], "mark=1": [2, 3], "mark": [2, 3], "part=7": [0, 4], "part=8": [1, 2, 3],
        "region=1": [0, 1], "region=2": [2, 3, 4], "some": [2, 3, 4], "first": [0, 1],
    }  # fmt: skip


@pytest.mark.parametrize(
    "names",
    [
        ["K_0.mtx", "K_1.mtx", "K_2.mtx", "boundary.csv"],
        ["M.mtx", "K_0.mtx", "K_1.mtx", "boundary.csv"],
        ["M.mtx", "M.npz", "K_0.mtx", "K_1.mtx", "K_2.mtx", "boundary.csv"],
        ["M.mtx", "K_0.mtx", "K_1.mtx", "K_2.mtx"],
        ["M.mtx", "K_0.mtx", "K_1.mtx", "K_2.mtx", "K_3.mtx", "boundary.csv"],
    ],
)
def test_a_folder_of_matrices_has_each_file_once(tmp_path, names):
    for name in names:
        (tmp_path / name).write_text("")
    with pytest.raises(ImportRefused, match="needed: M and K_<speed> at three speeds"):
        matrix_files("", tmp_path)


def test_the_sides_of_a_tip_are_told_by_their_middle_and_angles_by_their_place():
    # two nodes, the second ahead
    points = turned(np.array([[0.25, 0.0, 0.0], [0.25, -0.02, 0.03]]), 10.0)
    with pytest.raises(ImportRefused, match=r"leading edge at -10\.0 degrees and its trailing edge at -5\.4 degrees round"):
        tip.check_sense_of_nodes(points)


@pytest.mark.parametrize(("off", "fits"), [(1e-4, True), (1.001e-4, False)])
@pytest.mark.parametrize("length", [0.03, 1e-4])
def test_a_tip_may_be_as_far_from_a_surface_of_revolution_as_said(off, fits, length):
    """A parabola for one that is long, and a circle for one that is short along the axis."""
    z = np.repeat(np.linspace(0.0, length, 21), 2)
    radius = 0.25 + 2.0 * z**2 * (length > 0.01) + np.tile([off, -off], 21)
    points = np.stack([radius * np.cos(3.0 * z), radius * np.sin(3.0 * z), z], axis=1)
    points = np.concatenate([points, turned(points, 20.0)])
    with refused_unless(fits, "no surface of revolution"):
        tip.check_revolution(points, 1.0000001e-4)


def test_the_camber_line_is_half_way_between_the_edges():
    """Three rows of nodes; the middle one alone lies between the sides."""
    mesh = plate("hexahedron20", (2, 1, 8))
    nodes = np.flatnonzero(np.isclose(mesh.points[:, 0], 0.26))

    def row(height):
        here = nodes[np.isclose(mesh.points[nodes, 1], height)]
        return here[np.argsort(mesh.points[here, 2])]

    line, fractions = tip._camber(mesh.points, nodes, row(-0.002), row(0.002))
    np.testing.assert_array_equal(line, row(0.0))
    np.testing.assert_allclose(fractions, mesh.points[line, 2] / 0.03, atol=0.5 / 200)


def test_a_corner_far_from_the_end_is_a_part_of_the_side():
    """Farther than 1.2 thicknesses, or a quarter of the line."""
    path = np.array([[0.0, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.01, 0.1], [0.0, 0.02, 0.1]])
    assert tip._between_corners(path, np.arange(4), 0.01).tolist() == [1, 2]
    assert tip._between_corners(path, np.arange(4), 0.005).tolist() == [0, 1, 2, 3]
    short = np.array([[0.0, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.01, 0.011], [0.0, 0.02, 0.011]])
    assert tip._between_corners(short, np.arange(4), 0.1).tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize("size", [1e3, 1e-3])
@pytest.mark.parametrize(("angle", "fits"), [(1e-7, False), (1e-5, True)])
@pytest.mark.parametrize("of", ["both", "axis", "radial"])
def test_directions_are_parallel_by_their_angle_whatever_their_length(size, angle, fits, of):
    axis, radial = np.array([0.0, 0.0, 1.0]), np.array([0.0, np.sin(angle), np.cos(angle)])
    axis, radial = axis * (size if of != "radial" else 1.0), radial * (size if of != "axis" else 1.0)
    orientation = Orientation("m", tuple(axis), tuple(radial), "positive")
    with refused_unless(fits, "must be two directions, not parallel"):
        orientation.check()


@pytest.mark.parametrize(("degrees", "fits"), [(0.0, True), (40.0, True), (100.0, False), (180.0, False)])
def test_a_blade_lies_about_its_radial_direction(degrees, fits):
    """However far along the axis it is."""
    mesh = plate()
    placed = replace(raw(mesh), points=turned(mesh.points, degrees) + np.array([0.0, 0.0, 3.0]))
    with refused_unless(fits, "degrees round the axis from `radial`"):
        OURS.to_blade(placed)


def test_a_tip_that_waves_is_no_surface_of_revolution():
    """A polynomial of the number of places along the axis would follow it."""
    z = np.linspace(0.0, 0.03, 13)
    radius = 0.25 + 5e-4 * np.cos(200.0 * np.pi * z)
    with pytest.raises(ImportRefused, match="no surface of revolution"):
        tip.check_revolution(np.stack([radius, np.zeros(13), z], axis=1), 1e-4)


@pytest.mark.parametrize("forward", [True, False])
@pytest.mark.parametrize(("stagger_deg", "place_deg", "z"), [(0.0, 0.0, 0.0), (80.0, 0.0, 0.0), (0.0, 45.0, -3.0)])
def test_normals_of_sections_look_to_the_suction_side(forward, stagger_deg, place_deg, z):
    """However staggered the blade is, and wherever round and along the axis it lies."""
    mesh = plate("hexahedron20", (6, 1, 3))
    angle = np.radians(stagger_deg)
    x, y, axial = mesh.points.T
    axial = axial - 0.015
    standing = np.stack([x, y * np.cos(angle) + axial * np.sin(angle), axial * np.cos(angle) - y * np.sin(angle) + z], axis=1)
    points = turned(standing, place_deg)
    parameters, normals = blade_parameters(points, mesh.node_set("root"), mesh.node_set("tip"), forward)
    side = np.array([0.0, np.cos(angle), -np.sin(angle)]) * (1.0 if forward else -1.0)
    expected = turned(side[None], place_deg)[0]
    np.testing.assert_allclose(normals, np.broadcast_to(expected, normals.shape), atol=0.03)
    np.testing.assert_allclose(parameters[:, 2], (1.0 if forward else -1.0) * y / 0.002, atol=0.3)
