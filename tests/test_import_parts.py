"""The parts that an import is made of, one at a time: what each does at its borders."""

import warnings
from dataclasses import replace
from types import SimpleNamespace

import meshio
import numpy as np
import pytest
from box_mesh import box_mesh, plate
from defaults import Orientation

from r37core.blade.sense import sense_of_line
from r37core.exchange.importing import ends, fitting_entry, mesh_checks, meshio_reader, source, tip
from r37core.exchange.importing.abaqus_reader import read_abaqus
from r37core.exchange.importing.deck_text import deck_lines
from r37core.exchange.importing.fitting_entry import find_axes
from r37core.exchange.importing.frame import blade_parameters
from r37core.exchange.importing.import_mesh import size_in_words
from r37core.exchange.importing.raw_mesh import RawMesh
from r37core.exchange.importing.source import digest_of, matrix_files
from r37core.exchange.orientation import OURS
from r37core.exchange.refusal import ImportRefused
from r37core.fem.elements import ELEMENTS
from r37core.fem.surface import outer_faces


def raw(mesh):
    return RawMesh(mesh.points, np.arange(1, len(mesh.points) + 1), mesh.blocks, {})


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


def test_lines_of_a_deck_have_no_comments_and_none_is_empty(tmp_path):
    (tmp_path / "a.inp").write_text("** of ours\n*NODE,\n  NSET=A\n\n   \n1, 2.\n ** more\n2, 3.\n")
    assert list(deck_lines(tmp_path / "a.inp")) == ["*NODE,NSET=A", "1, 2.", "2, 3."]


def test_coordinates_that_a_deck_leaves_out_are_zero_and_nodes_of_an_assembly_are_none(tmp_path):
    mesh = box_mesh(1.0, 1.0, 1.0, (1, 1, 1), element="hexahedron")
    lines = ["*PART, NAME=A", "*NODE"]
    for number, point in enumerate(mesh.points, start=1):
        cells = [f"{number}", *(f"{x:g}" for x in point)]
        while cells[-1] == "0":
            cells.pop()
        lines.append(", ".join(cells))
    lines += ["*ELEMENT, TYPE=C3D8", ", ".join(map(str, [1, *(mesh.blocks["hexahedron"][0] + 1)])), "*END PART"]
    lines += ["*ASSEMBLY, NAME=B", "*INSTANCE, NAME=C, PART=A", "*END INSTANCE", "*NODE", "1, 9., 9., 9.", "*END ASSEMBLY"]
    (tmp_path / "a.inp").write_text("\n".join(lines))
    again = read_abaqus(tmp_path / "a.inp")
    np.testing.assert_array_equal(again.points, mesh.points)


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


@pytest.mark.parametrize(("off", "holds"), [(1e-6, True), (1e-9, False)])
def test_clamped_nodes_hold_where_they_are_off_one_line(off, holds):
    """By more than a millionth of the blade's size."""
    points = np.array([[0.2, 0.0, 0.0], [0.2, 0.0, 0.01], [0.2, off, 0.02], [0.26, 0.0, 0.0], [0.26, 0.01, 0.01]])
    if holds:
        ends.check_root(points, np.arange(3), np.arange(3, 5))
    else:
        with pytest.raises(ImportRefused, match="found 3 nodes on one line"):
            ends.check_root(points, np.arange(3), np.arange(3, 5))


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


@pytest.mark.parametrize("unit", ["m", "um", 0.5])
def test_a_unit_that_fits_is_that_of_the_span_about_the_rotor_s_axis(unit):
    """In millimetres, whatever was said, and wherever along the axis the blade lies."""
    mesh = plate()
    theirs = replace(raw(mesh), points=1e3 * mesh.points + [0.0, 0.0, 5e4])
    orientation = replace(OURS, length_unit=unit)
    assert fitting_entry._fitting_unit(orientation, theirs) == "mm"


def test_the_size_of_a_mesh_is_that_about_the_axis():
    mesh = plate()
    line = np.flatnonzero(np.isclose(mesh.points[:, 0], 0.26) & np.isclose(mesh.points[:, 1], 0.0))
    sets = mesh.node_sets | {"leading_edge": line[:1], "trailing_edge": line[-1:]}
    assert "0.26 m at the leading and 0.26 m at the trailing edge, of the root 0.2 m" in size_in_words(
        replace(mesh, node_sets=sets)
    )


def test_a_long_list_is_cut_after_five():
    assert mesh_checks._some(np.arange(5)) == "0, 1, 2, 3, 4"
    assert mesh_checks._some(np.arange(6)) == "0, 1, 2, 3, 4, ..."


@pytest.mark.parametrize("thin", [1.0, 0.01])
def test_elements_of_the_other_winding_are_turned_however_thin(thin):
    mesh = plate("hexahedron20")
    skewed = mesh.points + np.array([0.0, 0.0, 1.0]) * (mesh.points[:, :1] - 0.2) * (0.0 if thin == 1.0 else 30.0)
    name, element = "hexahedron20", ELEMENTS["hexahedron20"]
    nodes = mesh.blocks[name]
    theirs = replace(raw(mesh), points=skewed, blocks={name: nodes[:, element.mirrored]})
    again, quality = mesh_checks._right_way_out(theirs, name, theirs.blocks[name])
    assert (quality.min() < 0.1) == (thin != 1.0) and quality.min() > 0.0
    np.testing.assert_array_equal(again, nodes)


def test_sets_of_a_mesh_are_its_whole_numbers_by_value():
    """Of nodes and cells; numbers with a fraction and vectors are none."""
    points = np.zeros((5, 3))
    cells = [("line", np.array([[0, 1], [2, 3]])), ("line", np.array([[3, 4]]))]
    mesh = meshio.Mesh(
        points,
        cells,
        point_data={
            "mark": np.array([0, 0, 1, 1, 0]),
            "part": np.array([7, 8, 8, 8, 7]),
            "heat": np.array([0.0, 1.0, 1.0, 0.0, 0.0]),
            "pair": np.zeros((5, 2), dtype=int),
        },
        cell_data={"region": [np.array([1, 2]), np.array([2])]},
        cell_sets={"some": [np.array([1]), np.array([0])], "first": [np.array([0]), None]},
    )
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


def test_a_digest_has_sixteen_digits(tmp_path):
    (tmp_path / "a").write_text("a")
    assert len(digest_of([tmp_path / "a"])) == 16


def test_thirty_names_of_sets_are_shown():
    for number, more in ((30, ""), (31, ", and 1 more")):
        sets = {f"s{i:02}": np.arange(3) for i in range(number)}
        mesh = SimpleNamespace(sets=sets, points=np.zeros((5, 3)))
        with pytest.raises(ImportRefused) as refused:
            source._set_members("root", "none", mesh)
        assert str(refused.value).endswith(f"s29 (3 nodes){more}")


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
    if fits:
        tip.check_revolution(points, 1.0000001e-4)
    else:
        with pytest.raises(ImportRefused, match="no surface of revolution"):
            tip.check_revolution(points, 1.0000001e-4)


def test_the_camber_line_is_half_way_between_the_edges():
    """Three rows of nodes; the middle one alone lies between the sides."""
    mesh = plate("hexahedron20", (2, 1, 8))
    nodes = np.flatnonzero(np.isclose(mesh.points[:, 0], 0.26))
    y, z = mesh.points[nodes, 1], mesh.points[nodes, 2]

    def row(height):
        here = nodes[np.isclose(y, height)]
        return here[np.argsort(mesh.points[here, 2])]

    line, fractions = tip._camber(mesh.points, nodes, row(-0.002), row(0.002))
    np.testing.assert_array_equal(line, row(0.0))
    np.testing.assert_allclose(fractions, mesh.points[line, 2] / 0.03, atol=0.5 / 200)
    assert z.max() == pytest.approx(0.03)


def test_a_corner_far_from_the_end_is_a_part_of_the_side():
    """Farther than 1.2 thicknesses, or a quarter of the line."""
    path = np.array([[0.0, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.01, 0.1], [0.0, 0.02, 0.1]])
    assert tip._between_corners(path, np.arange(4), 0.01).tolist() == [1, 2]
    assert tip._between_corners(path, np.arange(4), 0.005).tolist() == [0, 1, 2, 3]
    short = np.array([[0.0, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.01, 0.011], [0.0, 0.02, 0.011]])
    assert tip._between_corners(short, np.arange(4), 0.1).tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize(
    ("size", "angle", "refused"), [(1e3, 1e-7, True), (1e3, 1e-5, False), (1e-3, 1e-7, True), (1e-3, 1e-5, False)]
)
@pytest.mark.parametrize("of", ["both", "axis", "radial"])
def test_directions_are_parallel_by_their_angle_whatever_their_length(size, angle, refused, of):
    axis, radial = np.array([0.0, 0.0, 1.0]), np.array([0.0, np.sin(angle), np.cos(angle)])
    axis, radial = axis * (size if of != "radial" else 1.0), radial * (size if of != "axis" else 1.0)
    orientation = Orientation("m", tuple(axis), tuple(radial), "positive")
    if refused:
        with pytest.raises(ImportRefused, match="must be two directions, not parallel"):
            _ = orientation.rows
    else:
        _ = orientation.rows


def test_points_and_vectors_come_back_from_the_file():
    orientation = Orientation("mm", (0.6, 0.8, 0), (0, 0, 1), "positive", (5.0, 6.0, 7.0))
    points = np.random.default_rng(3).normal(size=(4, 3))
    np.testing.assert_allclose(orientation.points_to_blade(orientation.to_file(points)), points, atol=1e-12)
    moved = orientation.to_file(points + 1e-3) - orientation.to_file(points)
    np.testing.assert_allclose(orientation.vectors_to_file(np.full((4, 3), 1e-3)), moved, atol=1e-9)


@pytest.mark.parametrize(("degrees", "fits"), [(0.0, True), (40.0, True), (100.0, False), (180.0, False)])
def test_a_blade_lies_about_its_radial_direction(degrees, fits):
    """However far along the axis it is."""
    mesh = plate()
    placed = replace(raw(mesh), points=turned(mesh.points, degrees) + np.array([0.0, 0.0, 3.0]))
    if fits:
        OURS.to_blade(placed)
    else:
        with pytest.raises(ImportRefused, match="degrees round the axis from `radial`"):
            OURS.to_blade(placed)


def test_a_tip_that_waves_is_no_surface_of_revolution():
    """A polynomial of the number of places along the axis would follow it."""
    z = np.linspace(0.0, 0.03, 13)
    radius = 0.25 + 5e-4 * np.cos(200.0 * np.pi * z)
    with pytest.raises(ImportRefused, match="no surface of revolution"):
        tip.check_revolution(np.stack([radius, np.zeros(13), z], axis=1), 1e-4)


def test_contact_nodes_run_along_their_line():
    points = np.array([[0.25, 0.0, 0.0], [0.25, 0.001, 0.01], [0.25, 0.002, 0.02], [0.25, 0.003, 0.03]])
    tip.check_order(points)
    with pytest.raises(ImportRefused, match="contact node 3 does not lie beyond the one before it"):
        tip.check_order(points[[0, 2, 1, 3]])


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
