"""What a new user meets with a mesh of another program: the refusal of the first attempt says what the second must have."""

import re
from dataclasses import replace
from pathlib import Path

import gmsh
import numpy as np
import pytest
import yaml
from box_mesh import TITANIUM, box_mesh, plate, write_deck, write_with_gmsh
from defaults import Orientation
from import_defaults import MeshSource, Where, assert_same_sets, refused
from refusal_tables import pattern_of, refusal_rows

from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.elements import ELEMENTS
from r37core.fem.orientation import OURS
from r37core.fem.write_mesh import write_mesh
from r37core.mesh.generate import generate_mesh, quiet_gmsh
from r37core.rom.region_choice import RegionChoice
from r37imports.imported_entry import MeshEntry, SurfaceRule
from r37imports.importing.files import mesh_files
from r37imports.importing.import_mesh import import_mesh, size_in_words
from r37imports.importing.meshio_reader import read_msh
from r37imports.refusal import ImportRefused, MeshWarning, located

THEIRS = Orientation("mm", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), "negative")
"""x along the rotor's axis, y through the blade."""


@pytest.fixture(scope="module")
def theirs(settings, tmp_path_factory):
    """A folder with CS50 as another group has it, `cs50.dat`: Abaqus text in mm and its own axes, no sets, *BOUNDARY."""
    folder = tmp_path_factory.mktemp("theirs")
    ours = generate_mesh(settings.blades["CS50"].definition.build(round_edges=True), 600, 1, 8, folder / "ours.msh")
    write_abaqus(THEIRS.mesh_to_file(ours), folder / "cs50.dat", TITANIUM, "another group's")
    text = re.sub(r"(?s)\*NSET.*?(?=\*MATERIAL)", "", (folder / "cs50.dat").read_text())
    clamped = "\n".join(f"{node + 1}, 1, 3" for node in ours.node_set("root"))
    (folder / "cs50.dat").write_text(text.replace("ROOT, 1, 3", clamped))
    return ours, folder


ENTRY = {"mesh": "cs50.dat", "length_unit": "mm", "rotor_axis": [1.0, 0.0, 0.0], "radial": [0.0, 1.0, 0.0]}
ENTRY |= {"rotation": "negative", "material": {}, "root": "BOUNDARY", "tip": {"r_at_least_m": 0.2435}}
OF_OURS = ENTRY | {"length_unit": "m", "rotor_axis": [0.0, 0.0, 1.0], "radial": [1.0, 0.0, 0.0], "root": "root"}
"""For a mesh in the blade's frame."""

TABLE = Path(__file__).with_name("refusals.txt")

TIP = [[0.001368, 0.25233], [0.0282954, 0.244993]]
"""The tip's meridian, (z, r) in m."""


def attempt(folder, entry):
    return import_mesh(MeshEntry.model_validate(entry).source(folder), folder)[0]


@pytest.mark.parametrize(("kind", "changes", "said"), refusal_rows(TABLE, "second attempt"))
def test_the_second_attempt_works(theirs, kind, changes, said):
    """Lines of the message, taken over as they are, make an entry that is accepted."""
    ours, folder = theirs
    first = ENTRY | yaml.safe_load(changes)
    with refused(f"(?s){pattern_of(said)}") as refusal:
        attempt(folder, first)
    lines = yaml.safe_load("\n".join(line for line in str(refusal.value).splitlines() if line.startswith("  ")))
    mesh = attempt(folder, first | lines)
    assert_same_sets(mesh, ours, "root", "tip", "tip_pressure_edge")
    np.testing.assert_allclose(mesh.points, ours.points, atol=1e-9)


def test_a_rule_may_be_taken_as_it_is(theirs):
    ours, folder = theirs
    wide = ENTRY | {"root": {"r_at_most_m": 0.188}, "tip": {"cone_zr_m": TIP, "tolerance_m": 1e-4}}
    with refused(r"root: the rule .* side faces: narrow it, or take what was caught with end_check"):
        attempt(folder, wide)
    assert len(attempt(folder, wide | {"end_check": False}).node_set("root")) > len(ours.node_set("root"))


def bent(points):
    """Nodes of the blade near the casing moved by up to 0.6 mm, so that the tip's meridian is an arc."""
    radius = np.hypot(points[:, 0], points[:, 1])
    share = np.clip((points[:, 2] - TIP[0][0]) / (TIP[1][0] - TIP[0][0]), 0.0, 1.0)
    out = 2.4e-3 * share * (1.0 - share) * np.clip((radius - 0.23) / 0.015, 0.0, 1.0)
    return points * np.stack([1.0 + out / radius, 1.0 + out / radius, np.ones(len(points))], axis=1)


def test_a_curved_tip_is_no_cone_but_still_one_end(theirs):
    """Its rule is offered, with a wider tolerance; another that catches less is not refused for that."""
    ours, folder = theirs
    write_mesh(replace(ours, points=bent(ours.points)), folder / "bent.vtu")
    entry = OF_OURS | {"mesh": "bent.vtu"}
    with refused("no surface of revolution") as refusal:
        attempt(folder, entry)
    tip = yaml.safe_load(refusal.value.fitting["tip"])
    assert tip["tolerance_m"] > 5e-4
    mesh = attempt(folder, entry | {"tip": tip, "revolution_tolerance_m": 1e-3})
    assert_same_sets(mesh, ours, "tip")


@pytest.mark.parametrize("unit", [1, 0.0254, 0.25])
def test_metres_per_unit(theirs, unit):
    """A unit without a name, as of coordinates over a reference length."""
    ours, folder = theirs
    write_mesh(replace(ours, points=ours.points / unit), folder / "scaled.vtu")
    mesh = attempt(folder, OF_OURS | {"mesh": "scaled.vtu", "length_unit": unit, "tip": {"cone_zr_m": TIP}})
    np.testing.assert_allclose(mesh.points, ours.points, atol=1e-9)


@pytest.fixture
def deck(tmp_path):
    """Write the deck of a plate, changed as text, to a file of this name in a folder that is given back."""

    def write(change=lambda text: text, name="mesh.inp"):
        write_deck(tmp_path / name, change)
        return tmp_path

    return write


def read(folder, name="mesh.inp", root="root", tip="tip", **changes):
    return import_mesh(MeshSource(name, OURS, Where((root,)), Where((tip,)), sense_check=False, **changes), folder)[0]


@pytest.mark.parametrize(("kind", "changes", "message"), refusal_rows(TABLE, "plate"))
def test_orientation_and_rules_that_do_not_fit(tmp_path, kind, changes, message):
    """The location of the key to blame goes in front where the configuration gives one."""
    write_mesh(plate(), tmp_path / "mesh.vtu")
    key, _, said = message.partition(": ... ")
    place = f"blades.yaml:3: Fan.{key}"
    entry = OF_OURS | {"mesh": "mesh.vtu", "tip": "tip"} | yaml.safe_load(changes)
    with refused(f"(?s)^{place}: .*{pattern_of(said)}") as refusal, located({key: place}):
        attempt(tmp_path, entry)
    assert refusal.value.key == key


@pytest.mark.parametrize(("kind", "change", "message"), refusal_rows(TABLE, "deck"))
def test_decks_that_are_refused(deck, kind, change, message):
    old, new = (part.replace(" / ", "\n") for part in change.split(" -> "))
    with refused(rf"(?s)mesh\.inp: .*{pattern_of(message)}"):
        read(deck(lambda text: text.replace(old, new, 1)))


@pytest.mark.parametrize("name", ["mesh.dat", "mesh.msh", "mesh.nas", "mesh.TXT", "mesh"])
def test_decks_are_recognised_by_their_text(deck, name):
    """CalculiX's own preprocessor writes .msh; others .dat, .k or nothing."""
    folder = deck(lambda text: "** made elsewhere\n\n" + text.lower().replace("*heading", " *Heading"), name)
    assert_same_sets(read(folder, name), plate(), "tip")
    (folder / "more.inc").write_text("*NSET, NSET=EXTRA\n1\n")
    with open(folder / name, "a") as stream:
        stream.write('*INCLUDE, INPUT="more.inc"\n')
    assert [file.name for file in mesh_files(name, folder)] == [name, "more.inc"]


@pytest.mark.parametrize("text", ["solid blade\n", "*KEYWORD\n*NODE\n", "", "\n**\n"])
def test_other_texts_are_no_decks(tmp_path, text):
    (tmp_path / "mesh.dat").write_text(text)
    with refused(r"found a file of kind '\.dat' whose text does not begin with a keyword of Abaqus"):
        read(tmp_path, "mesh.dat")


def boundary(rows):
    """Change of the deck's *BOUNDARY; a row with N is one for each node of the root."""
    nodes = plate().node_set("root") + 1
    lines = [row.replace("N", str(node)) for row in rows.split(" / ") for node in (nodes if "N" in row else [0])]
    return lambda text: text.replace("*BOUNDARY\nROOT, 1, 3", "\n".join(["*Boundary, op=new", *lines]))


@pytest.mark.parametrize(
    "rows",
    [
        "N, 1, 3",
        "N, 1, 6, 0.",
        "N, 1 / N, 2 / N, 3",
        "Root, encastre",
        "root, pinned / 1, 2, 2, 0.5",
        "Blade-1.N, 1, 3, 0.0",
        "root, 1, 3 / tip, 3 / tip, 1, 2, 0.1",
    ],
)
def test_nodes_that_the_deck_clamps_are_a_set(deck, rows):
    mesh = read(deck(boundary(rows)), root="boundary")
    assert_same_sets(mesh, plate(), "root")


@pytest.mark.parametrize("row", ["root, 1, 2", "root, 1, 3, 0.1", "nowhere, 1, 3", "*BOUNDARY, type=velocity / root, 1, 3"])
def test_nodes_that_move_are_not_clamped(deck, row):
    with refused(r"found no set 'boundary'; (.|\n)*file: ALL_NODES \(174 nodes\), BLADE"):
        read(deck(boundary(row)), root="boundary")


def with_sets(**sets):
    """Change of a deck that has these sets of nodes too."""
    rows = [f"*NSET, NSET={name}\n" + ",\n".join(map(str, nodes + 1)) for name, nodes in sets.items()]
    return lambda text: text.replace("*MATERIAL", "\n".join([*rows, "*MATERIAL"]), 1)


def test_any_nodes_may_be_the_root(deck):
    """Of a set BOUNDARY of the file; without a whole face, and inside, as of a dovetail's flanks."""
    members = np.flatnonzero(plate().points[:, 0] < 0.212)[::2]
    folder = deck(with_sets(Boundary=plate().node_set("root")[:10], SOME=members))
    assert len(read(folder, root="BOUNDARY").node_set("root")) == 10
    assert len(read(folder, root="some").node_set("root")) == len(members)


def test_sets_of_corners_get_their_mid_nodes(deck):
    """Some preprocessors pick corners alone: a face of them is meant with its mid-nodes."""
    mesh = plate()
    corners = np.unique(mesh.blocks["hexahedron20"][:, :8])
    folder = deck(with_sets(**{f"{name}_CORNERS": np.intersect1d(mesh.node_set(name), corners) for name in ("root", "tip")}))
    with pytest.warns(MeshWarning, match=r"tip: the set 'tip_corners' has corners of elements alone \(8 nodes\); the 10 mid"):
        again = read(folder, root="root_corners", tip="tip_corners")
    assert_same_sets(again, mesh, "root", "tip")


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (("line", "tip"), "root: found 3 nodes on one line, which do not hold the blade"),
        (("blade", "tip"), r"root: (\d+) of its \d+ nodes are the tip's too"),
        (("none", "tip"), "the set 'none', which has 0 nodes"),
    ],
)
def test_roots_that_cannot_be_meant(deck, names, message):
    folder = deck(with_sets(LINE=np.lexsort(plate().points.T[::-1])[:3], NONE=np.array([99998])))
    with refused(message):
        read(folder, root=names[0], tip=names[1])


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.filterwarnings("ignore:elements of first order")
def test_a_mesh_of_one_element(tmp_path, element):
    write_mesh(plate(element, (1, 1, 1)), tmp_path / "mesh.vtu")
    with refused(r"found a mesh of \d+ nodes, too few to tell sections between root and tip"):
        read(tmp_path, "mesh.vtu")


@pytest.mark.parametrize(
    ("cell", "message"),
    [
        ((2, 1, 1), r"the mesh has holes \(1 closed inside, one near \(0\.225, .*, 0\.015\)\): elements may be missing"),
        ((2, 0, 1), r"the mesh has holes \(corners - edges \+ faces of its surface is 0 and not 2\)"),
    ],
)
@pytest.mark.parametrize("element", ["hexahedron20", "wedge15"])
def test_an_element_that_is_missing_inside_is_told(tmp_path, element, cell, message):
    """In the middle of three layers, or of one; at the outside it is a notch, as a blade may have."""
    layers = 3 if cell[1] else 1
    mesh = plate(element, (6, layers, 3))
    (nodes,) = mesh.blocks.values()
    place = (np.array(cell) + 0.5) / (6, layers, 3) * (0.06, 0.004, 0.03) + (0.2, -0.002, 0.0)
    here = np.all(np.abs(mesh.points[nodes].mean(axis=1) - place) < np.array((0.005, 0.002 / layers, 0.005)), axis=1)
    write_mesh(replace(mesh, blocks={element: nodes[~here]}), tmp_path / "mesh.vtu")
    with pytest.warns(MeshWarning, match=message):
        read(tmp_path, "mesh.vtu", drop_free_nodes=True)


def test_elements_of_two_orders_must_not_touch(tmp_path):
    mesh = plate()
    nodes = mesh.blocks["hexahedron20"]
    mixed = replace(mesh, blocks={"hexahedron": nodes[:9, :8], "hexahedron20": nodes[9:]})
    write_mesh(mixed, tmp_path / "mesh.vtu")
    with refused(r"the mid-nodes of 10 edges, for example between the nodes \d+, \d+, belong"):
        read(tmp_path, "mesh.vtu", drop_free_nodes=True)


@pytest.mark.parametrize("face", ["S0", "S7", "S", "P1", "SPOS", "S1.5"])
def test_faces_that_an_element_lacks(deck, face):
    folder = deck(lambda text: text.replace("*MATERIAL", f"*SURFACE, NAME=CROWN\n1, {face}\n*MATERIAL"))
    with refused(rf"surface CROWN: found the face {re.escape(face)}; allowed: S1, .*, S6$"):
        read(folder, tip="crown")


@pytest.mark.parametrize("called", ["mesh.inp", "../{folder}/mesh.inp", "more.inc"])
def test_a_deck_that_includes_itself(deck, called, tmp_path):
    folder = deck(lambda text: f"{text} *Include, input={called.format(folder=tmp_path.name)}")
    (folder / "more.inc").write_text("*INCLUDE, INPUT=mesh.inp\n")
    with refused(r"includes mesh\.inp, which includes it; take one \*INCLUDE out"):
        read(folder)


def test_a_deck_may_include_a_file_twice(deck):
    with refused(r"mesh\.inp has a line \*INCLUDE that names no file; allowed: \*INCLUDE, INPUT="):
        mesh_files("mesh.inp", deck(lambda text: text + "*INCLUDE\n"))
    folder = deck(lambda text: text + "*INCLUDE, INPUT=a.inc\n*INCLUDE, INPUT=a.inc\n")
    (folder / "a.inc").write_text("*NSET, NSET=EXTRA\n1\n")
    assert [file.name for file in mesh_files("mesh.inp", folder)] == ["mesh.inp", "a.inc"]
    read(folder)


def test_rows_of_an_included_file_continue_the_block(deck):
    folder = deck(lambda text: text.replace("*ELEMENT", "*INCLUDE, INPUT=more.inc\n*ELEMENT", 1))
    (folder / "more.inc").write_text("99999, 0.2, 0., 0.\n")
    with refused(r"1 of \d+ nodes belong to no .*\(99999\)"):
        read(folder)


def test_a_long_chain_of_included_files(deck):
    folder = deck(lambda text: text + "*INCLUDE, INPUT=0.inc\n")
    for number in range(2000):
        (folder / f"{number}.inc").write_text(f"*INCLUDE, INPUT={number + 1}.inc\n")
    with refused(r"^\S+\.inc is included over 50 files; put what it holds into fewer files"):
        mesh_files("mesh.inp", folder)


@pytest.mark.parametrize(
    ("change", "lacking"),
    [
        (lambda text: "", "GRID"),
        (lambda text: text[: len(text) // 10], "ENDDATA"),
        (lambda text: text[: 9 * len(text) // 10], "ENDDATA"),
        (lambda text: text.replace("BEGIN BULK\n", "", 1) + "BEGIN BULK\n", "GRID"),
    ],
)
def test_bulk_data_that_is_cut_short_or_begins_after_its_end(tmp_path, change, lacking):
    """Without a card meshio waits for one for ever."""
    write_with_gmsh(plate(), tmp_path / "mesh.bdf")
    (tmp_path / "mesh.bdf").write_text(change((tmp_path / "mesh.bdf").read_text()))
    with refused(rf"mesh\.bdf: found no {lacking} in its bulk data; the file is empty, cut short"):
        read(tmp_path, "mesh.bdf")


def test_the_first_answer_recognises_a_flat_tip(tmp_path):
    """Of a plate at 45 degrees to the axis, whose ends are planes; what it proposes is taken by the next run."""
    mesh = box_mesh(0.06, 0.004, 0.03, (6, 1, 6), origin=(0.2, -0.002, -0.015), element="hexahedron20")
    y, z = mesh.points[:, 1], mesh.points[:, 2]
    points = np.stack([mesh.points[:, 0], np.sqrt(0.5) * (y + z), np.sqrt(0.5) * (z - y)], axis=1)
    write_mesh(replace(mesh, points=points), tmp_path / "flat.vtu")
    source = MeshSource("flat.vtu", OURS, Where(("?",)), Where(("?",)))
    with refused(r"root: found no set '\?'; and tip: found no set '\?'; with length_unit") as refusal:
        import_mesh(source, tmp_path)
    assert re.search(r"\n  root: .*\n  tip: .*\n  # sets of the file: leading_edge .*\nthen run", str(refusal.value), re.DOTALL)
    entry = yaml.safe_load("\n".join(f"{key}: {value}" for key, value in refusal.value.fitting.items()))
    assert 1.37e-4 < entry["revolution_tolerance_m"] < 1.6e-4
    ends = {what: SurfaceRule.model_validate(entry[what]).where() for what in ("root", "tip")}
    with refused("no surface of revolution"):
        import_mesh(replace(source, **ends), tmp_path)
    import_mesh(replace(source, **ends, revolution_tolerance=entry["revolution_tolerance_m"]), tmp_path)


def write_boxes(file, boxes, options=(), grouped=(), partitions=0, size=1e22):
    """Boxes joined by their faces, in tetrahedra of second order or with other options of gmsh, some in a group."""
    with quiet_gmsh():
        for name, value in (
            {"Mesh.ElementOrder": 2, "Mesh.SecondOrderIncomplete": 0, "Mesh.MeshSizeMax": size} | dict(options)
        ).items():
            gmsh.option.setNumber(name, value)
        first, *others = [(3, gmsh.model.occ.addBox(*box)) for box in boxes]
        if others:
            gmsh.model.occ.fragment([first], others)
        gmsh.model.occ.synchronize()
        if "Mesh.Recombine3DAll" in dict(options):
            gmsh.model.mesh.setTransfiniteAutomatic(recombine=True)
        if grouped:
            gmsh.model.addPhysicalGroup(3, grouped, name="blade")
        gmsh.model.mesh.generate(3)
        if partitions:
            gmsh.model.mesh.partition(partitions)
        gmsh.write(str(file))


BOX, NEXT = (0.0, 0.2, 0.0, 0.004, 0.05, 0.03), (0.0, 0.25, 0.0, 0.004, 0.05, 0.03)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"options": {"Mesh.SaveAll": 1}, "grouped": [1]},
            "some elements are in no physical group: ... , or write with Mesh.SaveAll = 0",
        ),
        (
            {"options": {"Mesh.Recombine3DAll": 1}, "grouped": [1, 2]},
            "hexahedron27; ... ; leave nodes on faces out (Mesh.SecondOrderIncomplete = 1",
        ),
        ({"partitions": 2}, "the reader gave up: it is damaged, ... : let gmsh write it with Mesh.MshFile"),
    ],
)
def test_what_gmsh_has_written_otherwise(tmp_path, changes, said):
    """Groups, elements with nodes on their faces, and partitions: what cannot be read has a remedy."""
    write_boxes(tmp_path / "boxes.msh", (BOX, NEXT), **changes)
    with refused(pattern_of(said)):
        attempt(tmp_path, OF_OURS | {"mesh": "boxes.msh"})


def test_the_remedy_for_partitions_works(tmp_path):
    write_boxes(tmp_path / "box.msh", [BOX], {"Mesh.MshFileVersion": 2.2}, partitions=2)
    assert list(read_msh(tmp_path / "box.msh").blocks) == ["tetra10"]


def test_a_root_of_several_sets(deck):
    """As the flanks of a fir tree: their nodes together, the mid-nodes of each; a set that is not there is named."""
    mesh = plate()
    root, y = mesh.node_set("root"), mesh.points[mesh.node_set("root"), 1]
    folder = deck(with_sets(LEFT=root[y < -0.001], RIGHT=root[y > 0.001]))
    entry = OF_OURS | {"mesh": "mesh.inp", "tip": "tip", "sense_check": False}
    held = attempt(folder, entry | {"root": ["left", "RIGHT"]}).node_set("root")
    np.testing.assert_array_equal(held, root[np.abs(y) > 0.001])
    for wrong in (["LEFT", "UNDER"], {"sets": ["LEFT"], "without": ["UNDER"]}):
        with refused(r"root: found no set 'UNDER'(.|\n)*# sets of the file: .*, LEFT"):
            attempt(folder, entry | {"root": wrong})


def test_sets_that_a_root_is_without(deck):
    """Of a set, of sets and of a rule, whose faces at the nodes that are left out go with them."""
    mesh = plate()
    root, y = mesh.node_set("root"), mesh.points[mesh.node_set("root"), 1]
    folder = deck(with_sets(RIGHT=root[y > 0.001]))
    entry = OF_OURS | {"mesh": "mesh.inp", "tip": "tip", "sense_check": False, "end_check": False}
    held = attempt(folder, entry | {"root": {"sets": ["root"], "without": ["right"]}}).node_set("root")
    np.testing.assert_array_equal(held, root[y <= 0.001])
    low = {"sets": ["root"], "z_at_most_m": 0.01, "without": ["right"]}
    held = attempt(folder, entry | {"root": low}).node_set("root")
    np.testing.assert_array_equal(held, root[(y <= 0.001) & (mesh.points[root, 2] <= 0.0101)])
    with refused(r"no outer face .* the rule 'x at most 0\.2 m, to 0\.0001 m' without 'right'; give"):
        attempt(folder, entry | {"root": {"x_at_most_m": 0.2, "without": ["right"]}})


DOVETAIL = ((180, 9), (188, 9), (194, 5), (197, 5), (197, 14), (200, 14))
FIR_TREE = ((176, 2), (179, 4), (182, 4), (184, 2), (186, 6), (189, 6), (191, 4), (195, 4), (197, 14), (200, 14))


def write_rooted(file, outline, skewed=0):
    """A plate of 2 mm, cut by a cone, on a root with half of this outline (x, y) in mm; `skewed`: shift along its 40 mm."""
    with quiet_gmsh():
        occ = gmsh.model.occ
        points = [occ.addPoint(x, y, -20) for x, y in (*outline, *((x, -y) for x, y in outline[::-1]))]
        lines = [occ.addLine(*ends) for ends in zip(points, [*points[1:], points[0]], strict=True)]
        foot = occ.extrude([(2, occ.addPlaneSurface([occ.addCurveLoop(lines)]))], 0, skewed, 40)[1]
        plate_, _ = occ.intersect([(3, occ.addBox(198, -1, -15, 60, 2, 30))], [(3, occ.addCone(0, 0, -30, 0, 0, 60, 252, 246))])
        occ.fuse([foot], plate_)
        occ.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeMax", 8)
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
        gmsh.write(str(file))


@pytest.mark.parametrize(
    ("outline", "skewed", "flanks"),
    [(DOVETAIL, 0, [(188, 194)]), (DOVETAIL, 6, [(188, 194)]), (FIR_TREE, 0, [(182, 184), (189, 191)])],
)
def test_the_flanks_of_a_root_are_proposed_before_its_bottom(tmp_path, outline, skewed, flanks):
    """With the tip's cone, not that of the platform, many times its size; the second attempt clamps the flanks alone."""
    write_rooted(tmp_path / "foot.msh", outline, skewed)
    entry = FOOTED | {"length_unit": "mm", "root": "?", "tip": "?"}
    with pytest.raises(ImportRefused) as refusal:
        attempt(tmp_path, entry)
    fitting = {what: yaml.safe_load(refusal.value.fitting[what]) for what in ("root", "tip")}
    (z0, r0), (z1, r1) = fitting["tip"]["cone_zr_m"]
    assert (z0, r0, z1, r1) == pytest.approx((-0.015, 0.2505, 0.015, 0.2475), abs=2e-6)
    assert len(fitting["root"]["planes_m"]) == 2 * len(flanks)
    mesh = attempt(tmp_path, entry | fitting)
    x, y, z = 1e3 * mesh.points.T
    half = np.interp(x, *np.transpose(outline))
    across = np.abs(y - skewed * (z + 20.0) / 40.0)
    expected = np.any([(x > low - 1e-6) & (x < high + 1e-6) for low, high in flanks], axis=0) & (across > half - 1e-6)
    np.testing.assert_array_equal(mesh.node_set("root"), np.flatnonzero(expected))
    fewer = {"planes_m": fitting["root"]["planes_m"][1:]}
    with refused(r"planes_m, .* caught \d+ of the \d+ faces that look outward, as flanks: widen"):
        attempt(tmp_path, entry | fitting | {"root": fewer})


def test_a_tip_without_a_proposal_says_why(tmp_path):
    """Of a plate with a notch in its tip: one cone catches two faces."""
    mesh = plate()
    middle = mesh.points[mesh.blocks["hexahedron20"]].mean(axis=1)
    kept = mesh.blocks["hexahedron20"][~((middle[:, 0] > 0.25) & (np.abs(middle[:, 2] - 0.015) < 0.004))]
    write_mesh(replace(mesh, blocks={"hexahedron20": kept}), tmp_path / "notch.vtu")
    with refused(r"\n  # tip: no cone catches one whole face alone; give sets of the file, or limits"):
        attempt(tmp_path, OF_OURS | {"mesh": "notch.vtu", "tip": "?", "drop_free_nodes": True, "sense_check": False})


@pytest.fixture(scope="module")
def footed(tmp_path_factory):
    """A folder with a plate of 50 mm on a foot of 20 mm, `foot.msh`: x radial, z along the axis, metres."""
    folder = tmp_path_factory.mktemp("footed")
    write_boxes(
        folder / "foot.msh", [(0.18, -0.015, -0.02, 0.02, 0.03, 0.04), (0.2, -0.002, -0.015, 0.05, 0.004, 0.03)], size=0.005
    )
    return folder


FOOTED = OF_OURS | {"mesh": "foot.msh", "root": {"x_at_most_m": 0.18}, "tip": {"x_at_least_m": 0.25}, "sense_check": False}


def test_the_span_of_a_modelled_root_begins_at_its_platform(footed):
    """The first answer says where, and no element of the foot is in the region of the airfoil."""
    with pytest.raises(ImportRefused) as refusal:
        attempt(footed, FOOTED | {"root": "?", "tip": "?"})
    assert "planes_m" not in str(refusal.value)
    suggested = yaml.safe_load(re.search(r"hub_zr_m: (.*)", str(refusal.value))[1])
    assert [z for z, _ in suggested] == [-0.02, 0.02] and [r for _, r in suggested] == pytest.approx([0.2, 0.2], abs=5e-4)
    region = RegionChoice(minimum_span=0.05, maximum_span=0.9)
    lowest = {}
    for name, entry in {"clamped": FOOTED, "platform": FOOTED | {"hub_zr_m": suggested}}.items():
        mesh = attempt(footed, entry)
        x, span = mesh.points[:, 0], mesh.parameters[:, 1]
        elements = region.elements(mesh, mesh.node_set("tip_pressure_edge"))["tetra10"]
        lowest[name] = x[elements].min()
        said = size_in_words(mesh, MeshEntry.model_validate(entry).source(footed))
        assert ("span begins at the clamped faces; the root is modelled" in said) == (name == "clamped")
        assert span.min() == 0.0 and span.max() == 1.0
    np.testing.assert_allclose(span[x > 0.205], (x[x > 0.205] - 0.2) / 0.05, atol=0.02)
    assert not span[x < 0.2].any()
    assert lowest["clamped"] < 0.19 and 0.2 < lowest["platform"] < 0.21
    with refused("found a tip that is not above hub_zr_m"):
        attempt(footed, FOOTED | {"hub_zr_m": [[0.0, 0.26], [0.1, 0.26]]})
