"""Files of meshes that are damaged in any way: the import takes them or refuses them, in no other error and no long time."""

import random
import re
import time

import meshio
import pytest
from box_mesh import plate, write_deck, write_with_gmsh
from import_defaults import MeshSource, Where

from r37core.fem.orientation import OURS
from r37core.fem.write_mesh import write_mesh
from r37imports.importing.import_mesh import import_mesh
from r37imports.refusal import ImportRefused

ROOT, TIP = Where(limits=(("x", "at_most", 0.2),), tolerance=1e-6), Where(limits=(("x", "at_least", 0.26),), tolerance=1e-6)


def write_archive(mesh, file):
    meshlane = pytest.importorskip("meshlane", reason="meshlane (make setup)")
    meshlane.write(file, meshio.Mesh(mesh.points, dict(mesh.blocks)), file_format="ansysInp")


def read(file):
    return import_mesh(MeshSource(str(file), OURS, ROOT, TIP, sense_check=False, revolution_tolerance=1e-3))


WRITERS = {"msh": write_mesh, "bdf": write_with_gmsh, "inp": lambda mesh, file: write_deck(file), "cdb": write_archive}


def cut_short(data, chance):
    return data[: chance.randrange(len(data))]


def with_lines(change):
    """Damage of some lines between two places."""

    def damage(data, chance):
        lines = data.splitlines(keepends=True)
        first, last = sorted(chance.sample(range(len(lines)), 2))
        return b"".join(change(lines, first, min(last, first + chance.choice((1, 5, 50)))))

    return damage


def other_number(data, chance):
    """Counts, numbers of nodes and elements, references and coordinates."""
    number = chance.choice(list(re.finditer(rb"[-+.\deE]+", data)))
    words = (b"nan", b"-1", b"0", b"7", b"1e308", b"", "\N{SUPERSCRIPT TWO}".encode(), b"1.5", b"x", b"99999999999999999999")
    return data[: number.start()] + chance.choice(words) + data[number.end() :]


def other_bytes(data, chance):
    changed = bytearray(data)
    for _ in range(3):
        changed[chance.randrange(len(changed))] = chance.randrange(256)
    return bytes(changed)


DAMAGES = {
    "cut short": cut_short,
    "without lines": with_lines(lambda lines, first, last: lines[:first] + lines[last:]),
    "lines twice": with_lines(lambda lines, first, last: lines[:last] + lines[first:]),
    "exchanged": with_lines(lambda lines, first, last: lines[:first] + lines[last:] + lines[first:last]),
    "other number": other_number,
    "other bytes": other_bytes,
}


@pytest.mark.parametrize("suffix", WRITERS)
@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.filterwarnings("ignore")
def test_a_damaged_mesh_is_taken_or_refused(tmp_path, suffix, damage):
    file = tmp_path / f"mesh.{suffix}"
    WRITERS[suffix](plate(), file)
    whole, began = file.read_bytes(), time.monotonic()
    for seed in range(6):
        file.write_bytes(DAMAGES[damage](whole, random.Random(seed)))
        try:
            read(file)
        except ImportRefused as refusal:
            assert str(refusal).startswith(str(file))
    assert time.monotonic() - began < 30.0


@pytest.mark.parametrize(
    ("suffix", "comment"), [("bdf", b"$ caf\xe9\n"), ("inp", b"** caf\xe9\n"), ("cdb", b"/TITLE,caf\xe9\n")]
)
@pytest.mark.filterwarnings("ignore")
def test_a_comment_in_latin_1(tmp_path, suffix, comment):
    file = tmp_path / f"mesh.{suffix}"
    WRITERS[suffix](plate(), file)
    file.write_bytes(comment + file.read_bytes())
    mesh, _ = read(file)
    assert len(mesh.points) == len(plate().points)
