"""Meshes from other programs: read, checked, turned, refused with a reason."""

import re
import sys
import warnings
from dataclasses import replace

import gmsh
import numpy as np
import pytest
from box_mesh import TITANIUM, plate, write_deck, write_with_gmsh
from defaults import Orientation
from import_defaults import MeshSource, Where, assert_same_sets, refused
from scipy import constants

from r37core.base.units import LENGTH_UNITS
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.elements import ELEMENTS
from r37core.fem.matrices import assemble
from r37core.fem.mesh_quality import mesh_quality
from r37core.fem.orientation import OURS
from r37core.fem.solver import lowest_modes
from r37core.fem.surface import chosen, mask_within, outer_faces
from r37core.fem.write_mesh import write_mesh
from r37core.mesh.generate import generate_mesh, quiet_gmsh
from r37core.mesh.mesh_files import write_vtu
from r37core.rom.naming import ideal_shapes
from r37imports.importing.abaqus_reader import read_abaqus
from r37imports.importing.ansys_reader import read_ansys
from r37imports.importing.bulk_data import bulk_cards
from r37imports.importing.coordinate_systems import GridPoints
from r37imports.importing.files import SUFFIXES, mesh_files
from r37imports.importing.import_mesh import _READERS, import_mesh
from r37imports.importing.meshio_reader import quietly, read_med, read_msh, read_nastran
from r37imports.importing.source import MASS_UNITS, STIFFNESS_UNITS
from r37imports.placement import warn_of_size
from r37imports.refusal import MeshWarning


def source(file, **changes):
    return replace(MeshSource(str(file), OURS, Where(("root",)), Where(("tip",))), **changes)


def difference(first, second):
    """Largest difference of stiffness and mass, relative to the largest entry."""
    pairs = [(getattr(first, name), getattr(second, name)) for name in ("stiffness_blocks", "mass_pairs")]
    return max(np.abs(a - b).max() / np.abs(b).max() for a, b in pairs)


@pytest.fixture(scope="module")
def files(blade, steel, tmp_path_factory):
    """The reference blade's mesh as every sort of file that we write."""
    folder = tmp_path_factory.mktemp("formats")
    mesh = generate_mesh(blade, 1500, 1, 14, folder / "gmsh.msh")
    write_abaqus(mesh, folder / "deck.inp", steel, "round trip")
    write_vtu(mesh, folder / "vtk.vtu", mesh_quality(mesh))
    return mesh, assemble(mesh, steel), folder


@pytest.mark.parametrize("name", ["deck.inp", "gmsh.msh", "vtk.vtu"])
def test_our_own_mesh_comes_back(files, steel, name):
    mesh, matrices, folder = files
    again, quality = import_mesh(source(name), folder)
    assert difference(assemble(again, steel), matrices) < 1e-12
    assert quality.min() == pytest.approx(mesh_quality(mesh).min(), rel=1e-6)
    assert_same_sets(again, mesh, "root", "tip", "tip_pressure_edge", "tip_suction_edge")
    edge = mesh.node_set("tip_pressure_edge")
    # nodes near the ends of an edge are near the camber line too; they count by their place on the edge
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(again.points[edge], axis=0), axis=1))])
    np.testing.assert_allclose(again.parameters[edge, 0], length / length[-1], atol=1e-12)
    np.testing.assert_allclose(again.parameters[edge, 0], mesh.parameters[edge, 0], atol=0.01)
    assert np.intersect1d(edge, again.node_set("tip_camber_line")).size
    shapes, wanted = ideal_shapes(again), ideal_shapes(mesh)
    for name, shape in shapes.items():
        assert np.sum(shape * wanted[name]) ** 2 > 0.9 * np.sum(shape**2) * np.sum(wanted[name] ** 2)


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.filterwarnings("ignore:elements of first order")
@pytest.mark.filterwarnings("ignore::UserWarning:meshio")
def test_every_element_in_every_format(element, tmp_path):
    mesh = plate(element)
    write_abaqus(mesh, tmp_path / "mesh.inp", TITANIUM, "plate")
    expected = assemble(mesh, TITANIUM)
    for suffix, write in {"vtu": write_mesh, "msh": write_mesh, "med": write_with_gmsh, "bdf": write_with_gmsh}.items():
        write(mesh, tmp_path / f"mesh.{suffix}")
    for suffix in ("inp", "vtu", "msh"):
        again, _ = import_mesh(source(f"mesh.{suffix}"), tmp_path)
        assert difference(assemble(again, TITANIUM), expected) < 1e-12, suffix
    for suffix, root, tip in (("med", "root", "tip"), ("bdf", "nastran:ref=2", "nastran:ref=3")):
        again, _ = import_mesh(source(f"mesh.{suffix}", root=Where((root,)), tip=Where((tip,))), tmp_path)
        # gmsh numbers the nodes anew
        np.testing.assert_allclose(*(np.sort(found.stiffness().diagonal()) for found in (assemble(again, TITANIUM), expected)))


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.filterwarnings("ignore:elements of first order")
def test_archives_of_ansys(element, tmp_path):
    """Written by the extra package that reads them, with components of nodes; wedges as hexahedra with repeated nodes."""
    meshlane = pytest.importorskip("meshlane", reason="meshlane (make setup)")
    mesh = plate(element)
    sets = {name.upper(): mesh.node_set(name) for name in ("root", "tip")}
    content = meshlane.Mesh(mesh.points, list(mesh.blocks.items()), point_sets=sets)
    meshlane.write(tmp_path / "mesh.cdb", content, file_format="ansysInp")
    again, _ = import_mesh(source("mesh.cdb"), tmp_path)
    assert list(again.blocks) == [element]
    assert difference(assemble(again, TITANIUM), assemble(mesh, TITANIUM)) < 1e-8


@pytest.mark.parametrize("number", [154, 200, 21, 14])
def test_elements_of_ansys_that_are_no_solids_are_left_out(number, tmp_path):
    """Surface effects, meshing facets, masses and springs; solids that nobody reads are refused by their name."""
    meshlane = pytest.importorskip("meshlane", reason="meshlane (make setup)")
    meshlane.write(tmp_path / "mesh.cdb", meshlane.Mesh(plate().points, list(plate().blocks.items())), file_format="ansysInp")
    rows = {154: range(1, 9), 200: range(1, 9), 21: [1], 14: [1, 2]}[number]
    extra = "".join(f"{field:9}" for field in (1, 2, 1, 1, 0, 0, 0, 0, len(rows), 0, 99, *rows))
    text = (tmp_path / "mesh.cdb").read_text().replace("ET,1,186", f"ET,1,186\nET,2,{number}")
    whole, block = (
        text.replace("       -1\nFINISH", f"{extra}\n       -1\nFINISH"),
        f"ETBLOCK,1,1\n(2i9,19a9)\n{2:9}{number:9}\n       -1",
    )
    for kind in (f"ET,2,{number}", f"et,2,NAME{number}", block):
        (tmp_path / "mesh.cdb").write_text(whole.replace(f"ET,2,{number}", kind))
        with pytest.warns(MeshWarning, match=rf"elements of the types {number} of Ansys are no solids, and are left out"):
            assert list(read_ansys(tmp_path / "mesh.cdb").blocks) == ["hexahedron20"]
    (tmp_path / "mesh.cdb").write_text(text.replace(f"ET,2,{number}", "ETBLOCK,1,1\n(2i9,19a9)\n        2       64\n       -1"))
    with refused("found elements of type SOLID64; allowed: SOLID185"):
        read_ansys(tmp_path / "mesh.cdb")


def test_archives_of_ansys_need_the_extra_package(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshlane", None)
    (tmp_path / "mesh.cdb").write_text("NBLOCK")
    with refused(r"mesh\.cdb: Ansys archives need .* pip install -e '\.\[ansys\]'"):
        import_mesh(source("mesh.cdb"), tmp_path)


def plate_of_gmsh(file, size, grouped=True):
    """A plate in millimetres, rotor axis along x, blade along z, in gmsh's own way to write a format."""
    with quiet_gmsh():
        gmsh.model.occ.addBox(0, -2, 200, 30, 4, 60)
        gmsh.model.occ.synchronize()
        if grouped:
            gmsh.model.addPhysicalGroup(3, [1], name="blade")
            for height, name in ((200, "root"), (260, "tip")):
                tags = [t for _, t in gmsh.model.getEntities(2) if abs(gmsh.model.occ.getCenterOfMass(2, t)[2] - height) < 1e-6]
                gmsh.model.addPhysicalGroup(2, tags, name=name)
        gmsh.option.setNumber("Mesh.ElementOrder", 2)
        gmsh.option.setNumber("Mesh.MeshSizeMax", size)
        gmsh.model.mesh.generate(3)
        gmsh.write(str(file))


@pytest.mark.parametrize("suffix", ["msh", "inp", "bdf", "med"])
def test_files_written_by_gmsh(tmp_path, suffix):
    file = tmp_path / f"plate.{suffix}"
    plate_of_gmsh(file, 6)
    rules = {"root": Where(limits=(("x", "at_most", 0.2),)), "tip": Where(limits=(("r", "at_least", 0.26),))}
    orientation = Orientation("mm", rotor_axis=(1, 0, 0), radial=(0, 0, 1), rotation="negative")
    given = source(file, orientation=orientation, **rules if suffix == "bdf" else {})
    mesh, _ = import_mesh(given)
    assert list(mesh.blocks) == ["tetra10"]
    values, _ = lowest_modes(*(getattr(assemble(mesh, TITANIUM), name)() for name in ("stiffness", "mass")), 1)
    # clamped beam, within what plate action and shear do to it
    beam = 1.8751**2 * np.sqrt(115e9 * 0.004**2 / 12 / 4400.0) / 0.06**2
    assert np.sqrt(values[0]) == pytest.approx(beam, rel=0.05)
    first, last = mesh.points[mesh.node_set("tip_pressure_edge")[[0, -1]]]
    np.testing.assert_allclose(first, [0.26, -0.002, 0.0], atol=1e-9)
    np.testing.assert_allclose(last, [0.26, -0.002, 0.03], atol=1e-9)


@pytest.mark.parametrize(("suffix", "version"), [("msh", 2.2), ("msh", 4.0), ("msh", 4.1), ("med", 4.1)])
def test_a_surface_counts_in_every_group_that_names_it(tmp_path, suffix, version):
    """Whatever its orientation; equal names are one group, with any letter."""
    file = tmp_path / f"plate.{suffix}"
    with quiet_gmsh():
        halves = [(3, gmsh.model.occ.addBox(start, -2, 200, 15, 4, 60)) for start in (0, 15)]
        gmsh.model.occ.fragment(halves[:1], halves[1:])
        gmsh.model.occ.synchronize()
        places = {tag: gmsh.model.occ.getCenterOfMass(2, tag) for _, tag in gmsh.model.getEntities(2)}
        feet = sorted((tag for tag, place in places.items() if abs(place[2] - 200.0) < 1e-6), key=lambda tag: places[tag][0])
        gmsh.model.addPhysicalGroup(3, [1, 2], name="blade")
        gmsh.model.addPhysicalGroup(2, feet[:1], name="gauges")
        # gmsh gives a surface that is turned round no name in MED
        second = feet[1] if suffix == "med" else -feet[1]
        (tmp_path / "turned.geo").write_text(f'Physical Surface("encastré", 9) = {{{feet[0]}, {second}}};', encoding="utf-8")
        gmsh.merge(str(tmp_path / "turned.geo"))
        if suffix == "msh":
            # MED has no two groups of one name
            for tag in feet:
                gmsh.model.addPhysicalGroup(2, [tag], name=f"both{tag}")
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 8)
        gmsh.model.mesh.generate(3)
        gmsh.write(str(file))
    if suffix == "msh":
        # nor would gmsh write two, which other programs do
        text = re.sub(r'"both\d+"', '"both"', file.read_text(encoding="utf-8"))
        file.write_text(text, encoding="utf-8")
    mesh = (read_med if suffix == "med" else read_msh)(file)
    bottom = np.flatnonzero(mesh.points[:, 2] < 200.0 + 1e-9)
    left = bottom[mesh.points[bottom, 0] < 15.0 + 1e-9]
    expected = {"encastré": bottom, "gauges": left} | ({"both": bottom} if suffix == "msh" else {})
    for name, nodes in expected.items():
        np.testing.assert_array_equal(mesh.sets[name], nodes)
    rules = {"orientation": Orientation("mm", rotor_axis=(1, 0, 0), radial=(0, 0, 1), rotation="negative")}
    rules |= {"tip": Where(limits=(("r", "at_least", 0.26),)), "sense_check": False}
    assert len(import_mesh(source(file, root=Where(("encastré",)), **rules))[0].node_set("root")) == len(bottom)
    with refused(r"'gauges' caught \d+ of the \d+ faces that look as its own do: widen it, .* end_check: false"):
        import_mesh(source(file, root=Where(("gauges",)), **rules))


def test_no_file_of_gmsh_runs_a_command(tmp_path):
    """Neither a script with a mesh's name, nor options next to a mesh."""
    command = f'SystemCall "touch {tmp_path}/done";'
    plate_of_gmsh(tmp_path / "plate.msh", 15)
    (tmp_path / "plate.msh.opt").write_text(command)
    assert list(read_msh(tmp_path / "plate.msh").blocks) == ["tetra10"]
    (tmp_path / "script.msh").write_text(f"// 4.0\n{command}\n")
    with refused(r"found no \$MeshFormat at its beginning; allowed: a mesh that gmsh has written"):
        read_msh(tmp_path / "script.msh")
    assert not (tmp_path / "done").exists()


def test_a_volume_of_two_groups_is_there_once_and_one_of_none_is_not_lost(tmp_path):
    with quiet_gmsh():
        plates = [(3, gmsh.model.occ.addBox(start, 0, 0, 10, 4, 60)) for start in (0, 10)]
        gmsh.model.occ.fragment(plates[:1], plates[1:])
        gmsh.model.occ.synchronize()
        for name in ("blade", "titanium"):
            gmsh.model.addPhysicalGroup(3, [1], name=name)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 15)
        gmsh.model.mesh.generate(3)
        count = len(gmsh.model.mesh.getElementsByType(11, 1)[0])
        for version, everything in ((2.2, 0), (4.0, 1)):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            gmsh.option.setNumber("Mesh.SaveAll", everything)
            gmsh.write(str(tmp_path / f"{version}.msh"))
    mesh = read_msh(tmp_path / "2.2.msh")
    assert len(mesh.blocks["tetra10"]) == count
    np.testing.assert_array_equal(mesh.sets["blade"], mesh.sets["titanium"])
    with refused("some elements are in no physical group"):
        quietly(read_msh, tmp_path / "4.0.msh")


SYSTEMS = """GRDSET,,3
CORD2R,3,,0.,0.,100.,0.,0.,200.
,0.,100.,100.
CORD2C,5,3,10.,0.,0.,10.,0.,1.
,11.,0.,0.
GRID,101,5,0.,0.,0.
GRID,102,5,0.,0.,1.
GRID,103,5,1.,90.,0.
CORD1S,7,101,102,103,8,101,102,103
CORD1C,9,101,102,103
CORD1R,10,101,102,103
CORD2S,11,3,10.,0.,0.,10.,0.,1.
+,10.,1.,0.
CORD2R,20,21,0.,0.,0.,0.,0.,1.
,1.,0.,0.
CORD2R,21,20,0.,0.,0.,0.,0.,1.
,1.,0.,0.
CORD2R,22,,0.,0.,0.,0.,0.,1.
,0.,0.,3.
CORD1R,23,101,102,1000
"""
"""System 3 has its x along y and its y against x, 100 above the origin; 5, 7 and 11 stand in it, 10 along its x."""


@pytest.mark.parametrize(
    ("system", "coordinates", "position"),
    [
        ("", "1,2,3", "-2,1,103"),
        ("0", "1,2,3", "1,2,3"),
        ("3", "1,2,3", "-2,1,103"),
        ("5", "2,90,5", "-2,10,105"),
        ("7", "2,90,90", "0,8,100"),
        ("8", "2,0,30", "0,10,102"),
        ("9", "2,0,4", "-2,10,104"),
        ("10", "1,2,3", "-1,8,103"),
        ("11", "2,30,0", "-1,10,101.7320508075689"),
    ],
)
def test_grid_points_of_nastran_stand_in_the_basic_system(tmp_path, system, coordinates, position):
    (tmp_path / "mesh.bdf").write_text(f"{SYSTEMS}GRID,1,{system},{coordinates}\n")
    grid = GridPoints(list(bulk_cards(tmp_path / "mesh.bdf")))
    np.testing.assert_allclose(grid.positions[grid.labels == 1], [np.fromstring(position, sep=",")], atol=1e-12)


@pytest.mark.parametrize(
    ("system", "message"),
    [
        (4, "coordinate system 4 of GRID is not defined"),
        (20, "coordinate system 20 of GRID is not defined, or by itself; allowed: CORD1 or CORD2 of kind R, C, S"),
        (22, "coordinate system 22: CORD2R needs three points of the file, not on one line"),
        (23, "coordinate system 23: CORD1R needs three points"),
        ("1 3", "GRID 1: found '1 3'; allowed: numbers, each within its field's columns"),
    ],
)
def test_coordinate_systems_that_have_no_axes(tmp_path, system, message):
    (tmp_path / "mesh.bdf").write_text(f"{SYSTEMS}GRID,1,{system},0.\n")
    with refused(message):
        GridPoints(list(bulk_cards(tmp_path / "mesh.bdf")))


def large_fields(text):
    """Bulk data whose cards GRID have fields of sixteen characters."""
    return re.sub(
        r"(?m)^GRID    (.{8})(.{8})(.{8})(.{8})",
        lambda card: "GRID*   " + "".join(f"{field:16}" for field in card.groups()) + "\n*       ",
        text,
    )


@pytest.mark.parametrize(
    "change",
    [
        lambda text: re.sub(r"(?m)^\+.{7}", " " * 8, re.sub(r"(?m)(?<!E)\+\w* *$", "", text)),
        large_fields,
        lambda text: text.replace("ENDDATA", "END BULK"),
        lambda text: "$ a comment\n" + text.lower().replace("\n", " $ another\n"),
        lambda text: text.replace("ENDDATA", "CQUAD4,900,2,1,2,3,4,0.,-.015\nCTRIA3,901,2,1,2,3,45.\nENDDATA"),
    ],
)
def test_bulk_data_as_other_programs_write_it(tmp_path, change):
    """Continuation without marks, larger fields, another end, small letters and comments, shells with an angle."""
    write_with_gmsh(plate(), tmp_path / "mesh.bdf")
    expected = read_nastran(tmp_path / "mesh.bdf")
    text = change((tmp_path / "mesh.bdf").read_text())
    (tmp_path / "other.bdf").write_text(text)
    again = read_nastran(tmp_path / "other.bdf")
    np.testing.assert_array_equal(again.points, expected.points)
    np.testing.assert_array_equal(again.blocks["hexahedron20"], expected.blocks["hexahedron20"])


@pytest.mark.parametrize("grouped", [False, True])
def test_meshes_of_gmsh_have_no_set_of_bounding_entities(tmp_path, grouped):
    """meshio has one of a 4.1 file, with gmsh's own numbers of surfaces in it."""
    plate_of_gmsh(tmp_path / "plate.msh", 15, grouped)
    mesh = read_msh(tmp_path / "plate.msh")
    assert list(mesh.blocks) == ["tetra10"] and not any("bounding" in name for name in mesh.sets)
    assert ("blade" in mesh.sets) == grouped


def test_the_other_rotation_mirrors_the_blade(files, steel):
    mesh, matrices, folder = files
    turned = replace(OURS, rotation="positive")
    again, quality = import_mesh(source("deck.inp", orientation=turned, sense_check=False), folder)
    assert quality.min() > 0.0
    np.testing.assert_allclose(again.points, mesh.points * [1, -1, 1], atol=1e-15)
    # what looked against the rotation now looks along it
    np.testing.assert_array_equal(again.node_set("tip_pressure_edge"), mesh.node_set("tip_suction_edge"))
    ours, theirs = (lowest_modes(m.stiffness(), m.mass(), 4)[0] for m in (matrices, assemble(again, steel)))
    np.testing.assert_allclose(theirs, ours, rtol=1e-8)
    np.testing.assert_allclose(turned.to_file(again.points), mesh.points, atol=1e-15)
    # so does the suction side of a turbine
    turbine, _ = import_mesh(source("deck.inp", pressure_side_forward=False, sense_check=False), folder)
    np.testing.assert_array_equal(turbine.node_set("tip_pressure_edge"), mesh.node_set("tip_suction_edge"))


def deck(tmp_path, change=lambda text: text, element="hexahedron20"):
    write_deck(tmp_path / "mesh.inp", change, element)
    return tmp_path / "mesh.inp"


def test_decks_as_other_programs_write_them(tmp_path):
    """Small letters, comments inside blocks, two *NODE blocks, no zeros, sets of sets, element faces, a reference point."""
    expected = assemble(plate(), TITANIUM)

    def rewritten(text):
        text = text.replace("*ELEMENT, TYPE=C3D20,", "** a comment\n*Element, type=c3d20R,")
        text = text.replace("NSET=ALL_NODES", "nset=all").replace("\n20, ", "\n\n ** half of them\n*NODE\n20, ", 1)
        text = text.replace(", 0.0\n", "\n")
        text = text.replace(", ELSET=BLADE", ",\n ELSET=BLADE").replace("NSET=TIP\n", 'NSET="TIP"\n')
        more = "*ASSEMBLY\n*NODE\n1, 9., 9., 9.\n*END ASSEMBLY\n*Nset, nset=Clamped\nROOT,"
        return text.replace("*MATERIAL", f"{more}\n*MATERIAL")

    mesh, _ = import_mesh(source(deck(tmp_path, rewritten), root=Where(("CLAMPED",))))
    assert difference(assemble(mesh, TITANIUM), expected) < 1e-12
    tip = plate()
    on_tip = np.isin(tip.blocks["hexahedron20"], tip.node_set("tip"))
    # x grows along local xi: corners 2 3 7 6, face S4 of Abaqus
    members = ", ".join(map(str, np.flatnonzero(on_tip.sum(axis=1) == 8) + 1))
    faces = f"*ELSET, ELSET=LAST\n{members}\n*SURFACE, NAME=CROWN\nLAST, S4\n*MATERIAL"
    mesh, _ = import_mesh(source(deck(tmp_path, lambda text: text.replace("*MATERIAL", faces)), tip=Where(("crown",))))
    assert_same_sets(mesh, tip, "tip")
    skin = [", ".join(map(str, [9000 + i, *(face + 1)])) for i, face in enumerate(tip_faces(tip))]
    shells = "*ELEMENT, TYPE=S8R, ELSET=SKIN\n" + "\n".join(skin) + "\n*NSET, NSET=CAP, ELSET=skin\n*MATERIAL"
    mesh, _ = import_mesh(source(deck(tmp_path, lambda text: text.replace("*MATERIAL", shells)), tip=Where(("cap",))))
    assert_same_sets(mesh, tip, "tip")


def tip_faces(mesh):
    members = np.isin(np.arange(len(mesh.points)), mesh.node_set("tip"))
    surface = outer_faces(mesh.blocks)
    return np.concatenate([part.nodes for part in chosen(surface, mask_within(surface, members))])


def test_an_instance_stands_where_its_assembly_puts_it(tmp_path):
    def assembled(text):
        # a part that is shifted by 5 along y and turned by 90 degrees about an axis along x through (0, 5, 1)
        placing = "0., 5., 0.\n0., 5., 1., 1., 5., 1., 90.\n"
        assembly = f"*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n{placing}*END INSTANCE\n*END ASSEMBLY\n"
        return f"*PART, NAME=P\n{text}\n*END PART\n{assembly}"

    still, placed = read_abaqus(deck(tmp_path, lambda text: text)), read_abaqus(deck(tmp_path, assembled))
    x, y, z = still.points.T
    assert np.allclose(placed.points, np.stack([x, 5.0 - (z - 1.0), 1.0 + y], axis=1), atol=1e-12)


def reordered(mesh, order):
    return replace(mesh, blocks={name: nodes[:, order] for name, nodes in mesh.blocks.items()})


def some_turned(mesh):
    nodes = mesh.blocks["hexahedron20"].copy()
    nodes[:2] = nodes[:2][:, ELEMENTS["hexahedron20"].mirrored]
    return replace(mesh, blocks={"hexahedron20": nodes})


def some_twice(mesh):
    """The first element once more, its nodes numbered from another corner, and the fourth as it is."""
    nodes = mesh.blocks["hexahedron20"]
    turned = [1, 2, 3, 0, 5, 6, 7, 4, 9, 10, 11, 8, 13, 14, 15, 12, 17, 18, 19, 16]
    return replace(mesh, blocks={"hexahedron20": np.concatenate([nodes, nodes[[0]][:, turned], nodes[[3]]])})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (some_twice, r"2 of 20 elements of type hexahedron20 are given twice.* \(numbers 1 and 19, 4 and 20 of their type"),
        (some_turned, r"2 of 18 elements of type hexahedron20 are inside out"),
        (lambda m: reordered(m, [*range(8), *range(16, 20), *range(8, 16)]), r"mid-nodes off their edges .* node order"),
    ],
)
def test_bad_elements_are_refused(tmp_path, change, message):
    write_mesh(change(plate()), tmp_path / "mesh.vtu")
    with refused(message):
        import_mesh(source("mesh.vtu"), tmp_path)


@pytest.mark.parametrize("slope", [0.0, 30.0])
def test_all_elements_of_the_other_winding_are_turned(tmp_path, slope):
    """However thin they are."""
    mesh = plate()
    mesh = replace(mesh, points=mesh.points + slope * (mesh.points[:, :1] - 0.2) * [0.0, 0.0, 1.0])
    write_mesh(reordered(mesh, ELEMENTS["hexahedron20"].mirrored), tmp_path / "mesh.vtu")
    # so thin that a side looks as the root does
    again, quality = import_mesh(source("mesh.vtu", minimum_scaled_jacobian=0.0, end_check=not slope), tmp_path)
    assert quality.min() > 0.0 and (quality.min() < 0.1) == (slope > 0.0)
    assert assemble(again, TITANIUM).total_mass == pytest.approx(4400 * 0.06 * 0.004 * 0.03)


def test_a_blade_larger_than_any_is_told():
    """16 m from the axis: inches for centimetres."""
    places = {0.25: False, 16.3: True, 3.1: True, 2.9: False, 0.005: True}
    for radius, told in places.items():
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            warn_of_size(OURS, radius * np.array([[0.9, 0.0, 0.0], [1.0, 0.0, 0.1]]))
        assert [f"tip radius of {radius:.3g} m" in str(warning.message) for warning in caught] == [True] * told


def test_units_are_those_of_si_and_every_suffix_has_a_reader():
    metric = {"m": 1.0, "cm": constants.centi, "mm": constants.milli, "um": constants.micro}
    assert pytest.approx(LENGTH_UNITS, rel=1e-15) == metric | {"in": constants.inch, "ft": constants.foot}
    assert pytest.approx(MASS_UNITS, rel=1e-15) == {"kg": 1.0, "g": constants.gram, "t": constants.metric_ton}
    assert pytest.approx(STIFFNESS_UNITS, rel=1e-15) == {"N/m": 1.0, "N/mm": 1.0 / constants.milli}
    assert _READERS.keys() == set(SUFFIXES)


def test_an_included_file_is_one_of_the_mesh(tmp_path):
    deck(tmp_path, lambda text: text.replace("*MATERIAL", "*Include, Input=parts/more.inp\n*MATERIAL"))
    (tmp_path / "parts").mkdir()
    with refused(r"there is no file parts/more\.inp"):
        mesh_files("mesh.inp", tmp_path)
    (tmp_path / "parts/more.inp").write_text("*NSET, NSET=EXTRA\n1, 2\n")
    assert [file.name for file in mesh_files("mesh.inp", tmp_path)] == ["mesh.inp", "more.inp"]
    with refused(r"found no set 'MISSING'; (.|\n)*file: .*EXTRA"):
        import_mesh(source("mesh.inp", root=Where(("MISSING",))), tmp_path)


def test_nodes_and_elements_of_a_deck_may_lie_in_files_of_their_own(tmp_path):
    """Numbers with the exponent of Fortran, too."""
    whole = read_abaqus(deck(tmp_path, lambda text: text + "*AMPLITUDE, NAME=LOAD, INPUT=not_there.dat\n"))
    head, nodes, elements, rest = re.split(
        r"(?m)^(?=\*NODE|\*ELEMENT|\*ELSET|\*NSET|\*SURFACE|\*MATERIAL)", deck(tmp_path).read_text(), maxsplit=3
    )
    for name, block in (("nodes", nodes), ("elements", elements)):
        keyword, _, rows = block.partition("\n")
        (tmp_path / f"{name}.dat").write_text(re.sub(r"(\d\.\d+)(?=[,\n])", r"\1D+00", rows))
        head += f"{keyword}, INPUT={name}.dat\n"
    (tmp_path / "mesh.inp").write_text(head + rest)
    again = read_abaqus(tmp_path / "mesh.inp")
    np.testing.assert_array_equal(again.points, whole.points)
    np.testing.assert_array_equal(again.blocks["hexahedron20"], whole.blocks["hexahedron20"])
    assert [file.name for file in mesh_files("mesh.inp", tmp_path)] == ["mesh.inp", "nodes.dat", "elements.dat"]


@pytest.mark.parametrize("blank", [" ", "0"])
def test_bulk_data_whose_mid_nodes_are_blank(tmp_path, blank):
    write_with_gmsh(plate("tetra10"), tmp_path / "mesh.bdf")
    text = re.sub(r"(?m)^(\+E1     .{8}).{8}", rf"\g<1>{blank:8}", (tmp_path / "mesh.bdf").read_text())
    (tmp_path / "mesh.bdf").write_text(text)
    with refused("CTETRA 1: found 9 nodes; allowed: 4 or 10, with all mid-nodes or none"):
        import_mesh(source("mesh.bdf"), tmp_path)
    (tmp_path / "mesh.bdf").write_text("INCLUDE 'mesh.blk'\n")
    with refused("found INCLUDE; write the deck as one file"):
        import_mesh(source("mesh.bdf"), tmp_path)


def test_files_that_cannot_be_read(tmp_path):
    texts = {"med": "no HDF5", "msh": "$MeshFormat\n9 0 8\n", "bdf": "GRID,x\n", "vtu": "<VTKFile", "inp": "*NODE\nx"}
    for suffix, text in texts.items():
        (tmp_path / f"a.{suffix}").write_text(text)
        with refused(rf"a\.{suffix}"):
            import_mesh(source(f"a.{suffix}"), tmp_path)


def test_a_reader_that_exits_does_not_escape(tmp_path):
    def read(file):
        print("Error: I give up")
        sys.exit(1)

    with refused("the reader gave up: Error: I give up"):
        quietly(read, tmp_path)


def test_linear_elements_are_warned_of(tmp_path):
    file = deck(tmp_path, element="hexahedron")
    with pytest.warns(MeshWarning, match=r"first order \(hexahedron\) are too stiff in bending"):
        import_mesh(source(file))
