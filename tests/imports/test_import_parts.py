"""The parts of an import at their borders; a wrong sense of rotation is told from the tip's geometry, and refused."""

import json
import warnings
from contextlib import nullcontext
from dataclasses import replace

import meshio
import numpy as np
import pytest
import pyvista
from box_mesh import box_mesh, plate
from defaults import Orientation
from import_defaults import MatricesSource, MeshSource, Where, refused

from r37core.base.plain import from_plain, to_plain
from r37core.blade.profile import BladeShapeError
from r37core.blade.sense import check_profile_sense, sense_of_line, sense_of_profile
from r37core.config import ConfigError
from r37core.fem.orientation import OURS
from r37core.fem.surface import outer_faces
from r37core.fem.write_mesh import write_mesh
from r37core.figures.blade_shapes import draw_blade_shapes
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import write_vtu
from r37core.product.extensions import read_settings
from r37imports.importing import ends, meshio_reader, tip
from r37imports.importing.files import matrix_files
from r37imports.importing.fitting_entry import find_axes
from r37imports.importing.import_mesh import blade_parameters, import_mesh
from r37imports.importing.raw_mesh import RawMesh
from r37imports.refusal import MeshWarning


def raw(mesh):
    return RawMesh(mesh.points, np.arange(1, len(mesh.points) + 1), mesh.blocks, {})


def refused_unless(fits, message):
    return nullcontext() if fits else refused(message)


def turned(points, degrees):
    """About z."""
    angle = np.radians(degrees)
    return points @ np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])


def staggered(points, degrees):
    """About x; with a positive angle the leading edge goes ahead."""
    angle = np.radians(degrees)
    return points @ np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])


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


def test_sets_of_a_mesh_are_its_whole_numbers_by_value():
    """Of nodes and cells; numbers with a fraction and vectors are none."""
    cells = [("line", np.array([[0, 1]])), ("line", np.array([[1, 2]]))]
    numbers = {"mark": [0, 1, 1], "part": [7, 8, 7], "heat": [0.0, 1.0, 1.0], "pair": np.zeros((3, 2), dtype=int)}
    sets = {"some": [np.array([0]), np.array([0])], "first": [np.array([0]), None]}
    mesh = meshio.Mesh(np.zeros((3, 3)), cells, numbers, {"region": [[1], [2]]}, cell_sets=sets)
    sets = {name: set(nodes.tolist()) for name, nodes in meshio_reader._sets(mesh)}
    assert sets == {
        "mark=0": {0}, "mark=1": {1, 2}, "mark": {1, 2}, "part=7": {0, 2}, "part=8": {1},
        "region=1": {0, 1}, "region=2": {1, 2}, "some": {0, 1, 2}, "first": {0, 1},
    }  # fmt: skip


@pytest.mark.parametrize(
    "names",
    [["K_0.mtx", "K_1.mtx", "K_2.mtx", "boundary.csv"], ["M.mtx", "K_0.mtx", "K_1.mtx", "K_2.mtx", "K_3.mtx", "boundary.csv"]],
)
def test_a_folder_of_matrices_has_each_file_once(tmp_path, names):
    for name in names:
        (tmp_path / name).write_text("")
    with refused("needed: M and K_<speed> at three speeds"):
        matrix_files("", tmp_path)


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


def test_a_tip_that_waves_is_no_surface_of_revolution():
    """A polynomial of the number of places along the axis would follow it."""
    z = np.linspace(0.0, 0.03, 13)
    radius = 0.25 + 5e-4 * np.cos(200.0 * np.pi * z)
    with refused("no surface of revolution"):
        tip.check_revolution(np.stack([radius, np.zeros(13), z], axis=1), 1e-4)


@pytest.mark.parametrize("forward", [True, False])
@pytest.mark.parametrize(("stagger_deg", "place_deg", "z"), [(0.0, 0.0, 0.0), (80.0, 0.0, 0.0), (0.0, 45.0, -3.0)])
def test_normals_of_sections_look_to_the_suction_side(forward, stagger_deg, place_deg, z):
    """However staggered the blade is, and wherever round and along the axis it lies."""
    mesh = plate("hexahedron20", (6, 1, 3))
    points = turned(staggered(mesh.points - np.array([0.0, 0.0, 0.015]), stagger_deg) + np.array([0.0, 0.0, z]), place_deg)
    parameters, normals = blade_parameters(points, mesh.node_set("root"), mesh.node_set("tip"), forward)
    side = np.array([[0.0, 1.0 if forward else -1.0, 0.0]])
    expected = turned(staggered(side, stagger_deg), place_deg)[0]
    np.testing.assert_allclose(normals, np.broadcast_to(expected, normals.shape), atol=0.03)
    np.testing.assert_allclose(parameters[:, 2], side[0, 1] * mesh.points[:, 1] / 0.002, atol=0.3)


UPSTREAM = (0.0, 0.0, -1.0)
ANGLES = r"leading edge at [-+]\d+\.\d degrees and its trailing edge at [-+]\d+\.\d degrees .* \(stagger -6\d\.\d degrees\)"


def source(file, orientation=OURS, **changes):
    return MeshSource(str(file), orientation, Where(("root",)), Where(("tip",)), **changes)


BLADES = ["Ref", "CS100", *(pytest.param(name, marks=pytest.mark.slow) for name in ("L50", "L100", "S50", "S100", "CS50"))]


@pytest.fixture(scope="module", params=BLADES)
def exported(request, settings, tmp_path_factory):
    """One blade of the benchmark as another program has it."""
    folder = tmp_path_factory.mktemp(request.param)
    mesh = generate_mesh(settings.blades[request.param].definition.build(round_edges=True), 600, 1, 8, folder / "ours.msh")
    write_mesh(mesh, folder / "blade.msh")
    return folder / "blade.msh"


def test_the_seven_blades_as_they_are(exported):
    with warnings.catch_warnings():
        warnings.simplefilter("error", MeshWarning)
        import_mesh(source(exported))


@pytest.mark.parametrize(
    ("turn", "forward", "key", "message"),
    [
        ({"rotation": "positive"}, True, "rotation", rf"{ANGLES}; .*; change rotation; sense_check: false"),
        ({"rotor_axis": UPSTREAM, "rotation": "positive"}, True, "rotor_axis", rf"{ANGLES}; .*; change rotor_axis if it"),
        ({"rotor_axis": UPSTREAM}, True, "pressure_side", r"looks along .* is convex \(camber -\d\.\d degrees, stagger \+6"),
        ({}, False, "pressure_side", r"against the rotation and is convex .* give pressure_side: forward"),
        ({"rotation": "positive"}, False, "rotor_axis", rf"{ANGLES}; .* else both rotation and pressure_side"),
    ],
)
def test_the_seven_blades_turned_the_wrong_way(exported, turn, forward, key, message):
    wrong = source(exported, replace(OURS, **turn), pressure_side_forward=forward)
    with refused(message) as refusal:
        import_mesh(wrong)
    assert refusal.value.key == key
    import_mesh(replace(wrong, sense_check=False))


def turned_plate(folder, stagger):
    mesh = plate()
    write_mesh(replace(mesh, points=staggered(mesh.points - [0.0, 0.0, 0.015], stagger)), folder / "plate.vtu")
    return source(folder / "plate.vtu", revolution_tolerance=1e-3)


@pytest.mark.parametrize("stagger", [0.0, 4.0, -4.0])
@pytest.mark.parametrize("rotation", ["positive", "negative"])
def test_a_flat_plate_along_the_axis_tells_nothing(tmp_path, stagger, rotation):
    given = turned_plate(tmp_path, stagger)
    with pytest.warns(MeshWarning) as said:
        import_mesh(replace(given, orientation=replace(OURS, rotation=rotation)))
    rotation, side = (str(one.message) for one in said)
    assert rotation.startswith("rotation is taken as given: the tip's stagger of ")
    assert side.startswith("pressure_side is taken as given: the tip's camber of ")


def test_a_table_tells_the_stagger_of_its_blade(settings):
    definition = settings.blades["Ref"].definition
    for row, profile in zip(definition.profiles, definition.build(round_edges=True).profiles, strict=True):
        assert sense_of_profile(row).stagger == pytest.approx(profile.stagger, abs=np.radians(1.0))


def test_a_table_of_a_turbine(settings):
    tip = settings.blades["Ref"].definition.profiles[-1]
    check_profile_sense(replace(tip, outlet_angle=tip.inlet_angle + np.radians(4.9)))
    with pytest.raises(BladeShapeError, match=r"span 100%: found kappa_ic 62\.2 and kappa_oc 67\.3 degrees"):
        check_profile_sense(replace(tip, outlet_angle=tip.inlet_angle + np.radians(5.1)))


def test_a_mirrored_table(config_copy):
    table, blades = config_copy / "config/profiles/rotor37.csv", config_copy / "config/blades.yaml"
    head, *rows = [line.split(",") for line in table.read_text().splitlines()]
    mirrored = [[f"-{cell}" if "kappa" in name else cell for name, cell in zip(head, row, strict=True)] for row in rows]
    (table.parent / "mirrored.csv").write_text("\n".join(",".join(row) for row in [head, *mirrored]) + "\n")
    blades.write_text(blades.read_text().replace("profiles/rotor37.csv", "profiles/mirrored.csv"))
    found = r"^config/profiles/mirrored\.csv: blade Ref: span 100%: found a stagger of -60\.\d degrees, so the trailing edge "
    remedy = "would lead in the rotation; change the sign of kappa_ic, kappa_tc and kappa_oc in all rows; sense_check: false"
    with refused(found + remedy, ConfigError):
        read_settings(config_copy)
    blades.write_text(blades.read_text().replace("\nRef:\n", "\nRef:\n  sense_check: false\n"))
    # blades with this base have the same table
    assert set(read_settings(config_copy).blades) >= {"Ref", "CS100"}


def test_the_picture_of_a_blade_names_the_side_in_view(mesh, tmp_path, monkeypatch):
    """And the blade below it in lines that fit, clear of the rotation."""
    named, titles = [], []
    monkeypatch.setattr(pyvista.Plotter, "add_text", lambda self, text, position, **how: titles.append((text, position)))
    monkeypatch.setattr(pyvista.Plotter, "add_point_labels", lambda self, points, labels, **how: named.append(labels))
    edges = ("tip_pressure_edge", "tip_suction_edge")
    swapped = mesh.node_sets | {name: mesh.node_set(other) for name, other in zip(edges, reversed(edges), strict=True)}
    files = {name: tmp_path / f"{name[:7]}.vtu" for name in ("ours", "swapped_in_a_long_name_2026")}
    for file, shown in zip(files.values(), (mesh, replace(mesh, node_sets=swapped)), strict=True):
        write_vtu(shown, file, np.ones(sum(map(len, mesh.blocks.values()))))
    draw_blade_shapes(files, tmp_path / "blades.png")
    assert named == [["LE", "TE", "pressure side", "rotation"], ["LE", "TE", "suction side", "rotation"]]
    assert titles == [("ours", "lower_edge"), ("swapped_in_a_long_name\n_2026", "lower_edge")]


@pytest.mark.parametrize(("limit", "taken"), [(("x", "at_most", 0.2), True), (("r", "at_most", 0.203), False)])
def test_a_rule_that_cuts_a_smooth_face_is_refused(limit, taken):
    """The root is a plane and on no cone: a rule by the radius catches a strip in its middle."""
    mesh = box_mesh(0.08, 0.09, 0.004, (4, 9, 1), origin=(0.2, -0.045, 0.0), element="hexahedron20")
    surface, where = outer_faces(mesh.blocks), Where(limits=(limit,), tolerance=1e-6)
    end = ends.find_end("root", mesh.points, surface)
    assert end is None or not end.straight
    caught = ends.caught_by(where, "root", raw(mesh), surface)
    message = r"root: .* caught [1-8] of the 9 faces that look towards the axis: widen it, or take .* with end_check: false"
    with nullcontext() if taken else refused(message):
        ends.check_end("root", where, caught, end, mesh.points, surface)


CONE = Where(limits=(("r", "at_least", 0.2),), cone_zr=((0.0, 0.1), (0.2, 0.3)))
SOURCES = [MeshSource("blade.inp", OURS, Where(("ROOT",)), CONE), MatricesSource("folder", OURS)]


@pytest.mark.parametrize("source", SOURCES, ids=lambda source: type(source).__name__)
def test_jobs_get_sources_as_they_are(source):
    assert from_plain(type(source), json.loads(json.dumps(to_plain(source)))) == source
