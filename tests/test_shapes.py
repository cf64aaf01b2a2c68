"""Shapes to look at: the .glb files read back by another program, against what was written; stills; the page in a browser."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import pyvista
from box_mesh import box_mesh
from browser import opened
from vtkmodules.vtkIOGeometry import vtkGLTFReader

from r37core.base.io import read_json, write_json
from r37core.exchange.fields import WorstInstant, displacement_of, mode_shapes, stress_of
from r37core.explorer import write_page
from r37core.figures.style import save
from r37core.shapes import INDEX, PARTS, shapes_contents
from r37core.shapes.gltf import MovingSurface, write_glb
from r37core.shapes.moving import LARGEST_SHOWN, _skin, write_mode_shapes, write_worst_shapes
from r37core.shapes.stills import draw_shapes
from r37core.stress.operator import von_mises
from r37core.stress.recovery import stress_operator


def chunks(file):
    """JSON and binary chunk of a .glb file, by the specification's layout."""
    data = file.read_bytes()
    assert data[:4] == b"glTF"
    assert int.from_bytes(data[8:12], "little") == len(data)
    length = int.from_bytes(data[12:16], "little")
    assert length % 4 == 0
    assert data[16:20] == b"JSON"
    binary = data[20 + length :]
    assert binary[4:8] == b"BIN\0"
    assert int.from_bytes(binary[:4], "little") == len(binary) - 8
    return json.loads(data[20 : 20 + length]), binary[8:]


def accessor(content, binary, number):
    about = content["accessors"][number]
    view = content["bufferViews"][about["bufferView"]]
    assert view["byteOffset"] % 4 == 0
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[about["type"]]
    dtype = {5126: "<f4", 5123: "<u2", 5125: "<u4"}[about["componentType"]]
    values = np.frombuffer(binary, dtype, about["count"] * width, view["byteOffset"]).reshape(-1, width)
    if "min" in about:
        np.testing.assert_array_equal(values.min(axis=0), np.float32(about["min"]))
        np.testing.assert_array_equal(values.max(axis=0), np.float32(about["max"]))
    return values


def points_at(file, time):
    """Points of a .glb in the blade's frame at a time (s), as VTK's own reader moves them."""
    reader = vtkGLTFReader()
    reader.SetFileName(str(file))
    reader.ApplyDeformationsToGeometryOn()
    reader.SetFrameRate(1000)
    reader.UpdateInformation()
    reader.EnableAnimation(0)
    reader.UpdateTimeStep(time)
    surface = pyvista.wrap(reader.GetOutput()).combine().extract_surface(algorithm="dataset_surface")
    return np.asarray(surface.points)[:, [1, 2, 0]]


def nearest(points, others):
    return np.linalg.norm(points[:, None] - others[None], axis=2).min(axis=1).max()


@pytest.fixture
def surface():
    generator = np.random.default_rng(3)
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    triangles = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    times = np.linspace(0.0, 2.0, 9)
    weights = np.stack([np.sin(np.pi * times), times / 2.0], axis=1)
    targets = generator.uniform(-0.1, 0.1, (2, 4, 3))
    colours = generator.uniform(0.0, 1.0, (4, 3))
    return MovingSurface(points, triangles, np.arange(4.0), colours, targets, times, weights, weights[3], {"unit": "Pa"})


def test_a_file_has_what_was_written_and_another_program_moves_it_the_same_way(surface, tmp_path):
    write_glb(surface, "tetrahedron", tmp_path / "one.glb")
    content, binary = chunks(tmp_path / "one.glb")
    primitive = content["meshes"][0]["primitives"][0]
    points = accessor(content, binary, primitive["attributes"]["POSITION"])
    np.testing.assert_allclose(points[:, [1, 2, 0]], surface.points)
    np.testing.assert_array_equal(accessor(content, binary, primitive["indices"]).reshape(-1, 3), surface.triangles)
    np.testing.assert_array_equal(accessor(content, binary, primitive["attributes"]["_VALUE"]).ravel(), surface.values)
    colour = accessor(content, binary, primitive["attributes"]["COLOR_0"]) / 65535.0
    linear = np.where(surface.colours <= 0.04045, surface.colours / 12.92, ((surface.colours + 0.055) / 1.055) ** 2.4)
    np.testing.assert_allclose(colour[:, :3], linear, atol=1e-5)
    assert content["asset"]["extras"] == {"unit": "Pa"}
    assert content["meshes"][0]["weights"] == surface.rest_weights.tolist()
    sampler = content["animations"][0]["samplers"][0]
    np.testing.assert_allclose(accessor(content, binary, sampler["output"]).reshape(-1, 2), surface.weights, atol=1e-7)
    for step in (0, 2, 5):
        expected = surface.points + np.einsum("k,knd->nd", surface.weights[step], surface.targets)
        assert nearest(expected, points_at(tmp_path / "one.glb", surface.times[step])) < 1e-5


def test_modes_swing(whole, mesh, steel, tmp_path):
    write_mode_shapes(mesh, whole, steel, 4, tmp_path)
    entries = read_json(tmp_path / INDEX)
    assert [entry["shape"] for entry in entries] == ["mode_1B", "mode_1T", "mode_2B", "mode_4"]
    assert entries[0]["title"].endswith("Hz at rest")
    names, _, displacements = mode_shapes(whole, 0.0, 4)
    assert pyvista.read(tmp_path / "modes_0.vtu").point_data["mode 1B"].shape == displacements[0].shape
    # the stress of each mode is that of the vibration in its shape alone
    coordinates = whole.modes(0.0, 8)[1].T
    for number, name in enumerate(names):
        stress = pyvista.read(tmp_path / "modes_0.vtu").point_data[f"von Mises stress of mode {name}"]
        np.testing.assert_allclose(
            stress, von_mises(stress_of(mesh, whole, steel, WorstInstant(0.0, coordinates, number), 0.0)[1])
        )
    size = np.linalg.norm(displacements[1], axis=1)
    height = np.ptp(np.hypot(*mesh.points[:, :2].T))
    swung = mesh.points + displacements[1] * (LARGEST_SHOWN * height / size.max())
    # a quarter of the two seconds
    shown = points_at(tmp_path / "mode_1T.glb", 0.5)
    assert nearest(shown, swung) < 1e-6
    assert np.linalg.norm(shown - points_at(tmp_path / "mode_1T.glb", 0.0), axis=1).max() > 0.05 * height


@pytest.fixture
def instant(whole, steel):
    """A revolution in which two modes swing, the first three times and the second twice."""
    angle = 2.0 * np.pi * np.arange(62) / 62
    shapes = whole.modes(0.0, 2)[1].T
    revolution = 2e-4 * (np.outer(np.sin(3 * angle), shapes[0]) + 0.2 * np.outer(np.cos(2 * angle), shapes[1]))
    stress = stress_operator(whole, steel).max_von_mises(revolution)
    number = int(np.argmax(stress))
    return WorstInstant(float(stress[number]), revolution, number)


@pytest.mark.parametrize(("share", "said"), [(0.99, ", above yield: outside the linear model;"), (1.01, " MPa;")])
def test_the_worst_instant_moves_as_the_blade_did(whole, mesh, steel, instant, tmp_path, share, said):
    """And stress above yield is said to be outside the linear model."""
    material = replace(steel, yield_stress=share * instant.largest)
    write_worst_shapes(mesh, whole, material, {1150.5: instant}, {1150.5: "1B/4"}, tmp_path)
    (entry,) = read_json(tmp_path / INDEX)
    assert entry["title"].startswith("1B/4 at 1150.5 rad/s (10986 rpm)") and said in entry["title"]
    assert (tmp_path / "stress.pvd").exists()
    content, binary = chunks(tmp_path / "stress_1150.5.glb")
    # two modes: two targets
    (primitive,) = content["meshes"][0]["primitives"]
    assert len(primitive["targets"]) == 2
    rest = accessor(content, binary, primitive["attributes"]["POSITION"])[:, [1, 2, 0]].astype(float)
    targets = [accessor(content, binary, one["POSITION"])[:, [1, 2, 0]] for one in primitive["targets"]]
    weights = accessor(content, binary, content["animations"][0]["samplers"][0]["output"]).reshape(-1, 2)
    assert len(weights) == 63
    np.testing.assert_array_equal(weights[0], weights[-1])
    order = [int(np.argmin(np.linalg.norm(mesh.points - point, axis=1))) for point in rest]
    motion = entry["magnification"] * displacement_of(whole, instant.revolution)[:, order]
    shown = np.einsum("tk,knd->tnd", weights[:-1], targets)
    np.testing.assert_allclose(shown, motion, atol=1e-6)
    np.testing.assert_allclose(content["meshes"][0]["weights"], weights[instant.number], atol=1e-6)
    stress = pyvista.read(tmp_path / "stress_1150.5.vtu").point_data["von Mises stress"]
    np.testing.assert_allclose(accessor(content, binary, primitive["attributes"]["_VALUE"]).ravel(), stress[order], rtol=1e-6)
    assert 0.05 < np.linalg.norm(motion, axis=2).max() / np.ptp(np.hypot(*mesh.points[:, :2].T)) <= 1.001 * LARGEST_SHOWN


@pytest.mark.parametrize("element", ["wedge15", "hexahedron20", "tetra10"])
def test_the_skin_is_closed(element):
    """Each edge of the triangles is there twice, once in each direction; the volume inside is the box's."""
    box = box_mesh(0.3, 0.2, 0.1, (2, 2, 1), element=element)
    nodes, triangles = _skin(box)
    edges = np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    assert {tuple(edge) for edge in edges.tolist()} == {tuple(edge) for edge in edges[:, ::-1].tolist()}
    a, b, c = np.moveaxis(box.points[nodes][triangles], 1, 0)
    assert np.sum(a * np.cross(b, c)) / 6.0 == pytest.approx(0.3 * 0.2 * 0.1)


@pytest.fixture
def folders(whole, mesh, steel, instant, tmp_path):
    folders = {"": tmp_path / "Ref/modes", "abradable": tmp_path / "Ref/stress_abradable"}
    write_mode_shapes(mesh, whole, steel, 3, folders[""])
    instants, titles = {900.0: instant, 1150.5: instant}, {900.0: "1B/7, abradable", 1150.5: "1B/5, abradable"}
    write_worst_shapes(mesh, whole, steel, instants, titles, folders["abradable"])
    return folders


def test_stills(folders, tmp_path):
    for name, folder in folders.items():
        files = [tmp_path / f"of_{name}.{suffix}" for suffix in ("png", "pdf")]
        save(draw_shapes(folder), files, "What is seen.")
        picture = np.asarray(pyvista.read(files[0]).point_data.active_scalars)
        assert len(np.unique(picture, axis=0)) > 200
        assert b"/FontFile" in files[1].read_bytes()
    write_json([], folders[""] / INDEX)
    save(draw_shapes(folders[""]), tmp_path / "none.png")


def test_what_the_page_holds(folders):
    contents = shapes_contents(folders, "../0123/explorer.html")
    assert contents["explorer_in_report"] == "../0123/explorer.html"
    contents = contents["shapes"]
    stresses = ["stress_abradable/stress_900", "stress_abradable/stress_1150.5"]
    assert [one["name"] for one in contents][2:] == ["modes/mode_2B", *stresses]
    assert contents[-1]["files"] == ["Ref/stress_abradable/stress_1150.5.glb", "Ref/stress_abradable/stress_1150.5.vtu"]
    assert all((folders[""].parents[1] / file).exists() for one in contents for file in one["files"])


@pytest.mark.slow
def test_the_page_moves_the_blade(folders, tmp_path):
    """In headless Chromium: as the files say, without a message in the console."""
    write_page(shapes_contents(folders), "Shapes of Ref", tmp_path / "Ref.html", PARTS)
    # of what the browser says of drawing without a graphics card, only that is no fault which is about speed
    about_speed = re.compile(r"Canvas2D: Multiple readback|GL Driver Message .*Performance")
    more = {"kept": lambda message: not about_speed.search(message), "place": "#scene=abradable&speed=1150.4"}
    with opened(tmp_path / "Ref.html", {"width": 1200, "height": 800}, reduced_motion="reduce", **more) as page:
        page.wait_for_selector("html[data-ready]")
        assert page.text_content("#now").startswith("1B/5, abradable at 1150.5 rad/s")
        (entry,) = [one for one in read_json(folders["abradable"] / INDEX) if one["speed_rad_s"] == 1150.5]
        expected = points_at(folders["abradable"] / "stress_1150.5.glb", entry["worst_s"])
        np.testing.assert_allclose(nearest(np.array(page.evaluate("shown()")).T, expected), 0.0, atol=1e-6)
        page.keyboard.press("ArrowUp")
        page.keyboard.press("ArrowUp")
        assert page.text_content("#now").startswith("mode 2B")
        assert page.text_content("#play") == "Play"
        before = page.evaluate("shown()")
        page.locator("h1").click()
        page.keyboard.press(" ")
        page.wait_for_function(
            "before => Math.max(...shown()[1].map((y, at) => Math.abs(y - before[1][at]))) > 1e-4", arg=before
        )
        page.keyboard.press(" ")
        assert page.problems == []
