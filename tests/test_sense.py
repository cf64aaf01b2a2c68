"""A wrong sense of rotation turns a contact that bites into one that slips: it is told from the tip's geometry, and refused."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
import pyvista
from box_mesh import box_mesh
from defaults import MatricesSource, MeshSource, Orientation, Where

from r37core.blade.profile import BladeShapeError
from r37core.blade.sense import check_profile_sense, sense_of_profile
from r37core.config import ConfigError
from r37core.exchange.importing.import_mesh import import_mesh
from r37core.exchange.importing.matrices_in import import_matrices
from r37core.exchange.importing.tip import check_sense_of_nodes
from r37core.exchange.orientation import OURS
from r37core.exchange.refusal import ImportRefused, MeshWarning
from r37core.exchange.write_mesh import write_mesh
from r37core.exports.matrices_out import write_reduced_matrices
from r37core.figures.blade_shapes import draw_blade_shapes
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import write_vtu
from r37core.product.reading import read_settings

UPSTREAM = (0.0, 0.0, -1.0)
ANGLES = r"leading edge at [-+]\d+\.\d degrees and its trailing edge at [-+]\d+\.\d degrees .* \(stagger -6\d\.\d degrees\)"


def source(file, orientation=OURS, **changes):
    return MeshSource(str(file), orientation, Where("root"), Where("tip"), **changes)


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
    ("changes", "key", "message"),
    [
        ({"rotation": "positive"}, "rotation", rf"{ANGLES}; .*; change rotation; sense_check: false"),
        ({"rotor_axis": UPSTREAM, "rotation": "positive"}, "rotor_axis", rf"{ANGLES}; .*; change rotor_axis if it points"),
        ({"rotor_axis": UPSTREAM}, "pressure_side", r"looks along .* is convex \(camber -\d\.\d degrees, stagger \+6"),
    ],
)
def test_the_seven_blades_turned_the_wrong_way(exported, changes, key, message):
    wrong = replace(OURS, **changes)
    with pytest.raises(ImportRefused, match=message) as refusal:
        import_mesh(source(exported, wrong))
    assert refusal.value.key == key
    import_mesh(source(exported, wrong, sense_check=False))


def test_the_wrong_pressure_side(exported):
    with pytest.raises(ImportRefused, match=r"against the rotation and is convex .* give pressure_side: forward") as refusal:
        import_mesh(source(exported, pressure_side_forward=False))
    assert refusal.value.key == "pressure_side"
    with pytest.raises(ImportRefused, match=rf"{ANGLES}; .* else both rotation and pressure_side"):
        import_mesh(source(exported, replace(OURS, rotation="positive"), pressure_side_forward=False))


def turned_plate(folder, stagger):
    """A flat plate, turned about the blade by an angle (degrees); the leading edge goes ahead with a positive one."""
    mesh = box_mesh(0.06, 0.004, 0.03, (6, 1, 3), origin=(0.2, -0.002, -0.015), element="hexahedron20")
    angle = np.radians(stagger)
    x, y, z = mesh.points.T
    turned = np.stack([x, y * np.cos(angle) + z * np.sin(angle), z * np.cos(angle) - y * np.sin(angle)], axis=1)
    write_mesh(replace(mesh, points=turned), folder / "plate.vtu")
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


def test_a_flat_plate_at_an_angle_tells_the_rotation(tmp_path):
    given = turned_plate(tmp_path, 30.0)
    with pytest.warns(MeshWarning, match="pressure_side is taken as given"):
        import_mesh(given)
    with pytest.raises(ImportRefused, match="change rotation, or rotor_axis if it points upstream"):
        import_mesh(replace(given, orientation=replace(OURS, rotation="positive")))


def test_matrices(model, settings, tmp_path):
    write_reduced_matrices(model, (0.0, 1000.0, 2000.0), tmp_path)
    choice = settings.reduction_choice("Ref")
    wrong = MatricesSource(str(tmp_path), Orientation("m", (0, 0, 1), (1, 0, 0), "positive"))
    with pytest.raises(ImportRefused, match=rf"boundary\.csv: found the tip's {ANGLES}") as refusal:
        import_matrices(wrong, choice)
    assert refusal.value.key == "rotation"
    import_matrices(replace(wrong, sense_check=False), choice)


@pytest.mark.parametrize(
    ("points", "what"),
    [
        ([[0.25, 0.0, 0.0]], "the stagger of a single contact node"),
        ([[0.25, 0.0, 0.0], [0.25, 0.001, 0.03]], r"the tip's stagger of \+1\.9 degrees"),
    ],
)
def test_nodes_that_tell_nothing(points, what):
    with pytest.warns(MeshWarning, match=f"rotation is taken as given: {what} does not prove it"):
        check_sense_of_nodes(np.array(points))


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
    with pytest.raises(ConfigError, match=found + remedy):
        read_settings(config_copy)
    blades.write_text(blades.read_text().replace("\nRef:\n", "\nRef:\n  sense_check: false\n"))
    # blades with this base have the same table
    assert set(read_settings(config_copy).blades) >= {"Ref", "CS100"}


def test_the_picture_of_a_blade_names_the_side_in_view(mesh, tmp_path, monkeypatch):
    named = []
    monkeypatch.setattr(pyvista.Plotter, "add_point_labels", lambda self, points, labels, **how: named.append(labels))
    edges = ("tip_pressure_edge", "tip_suction_edge")
    swapped = mesh.node_sets | {name: mesh.node_set(other) for name, other in zip(edges, reversed(edges), strict=True)}
    files = {name: tmp_path / f"{name}.vtu" for name in ("ours", "swapped")}
    for file, shown in zip(files.values(), (mesh, replace(mesh, node_sets=swapped)), strict=True):
        write_vtu(shown, file, np.ones(sum(map(len, mesh.blocks.values()))))
    draw_blade_shapes(files, tmp_path / "blades.png")
    assert named == [["LE", "TE", "pressure side", "rotation"], ["LE", "TE", "suction side", "rotation"]]
