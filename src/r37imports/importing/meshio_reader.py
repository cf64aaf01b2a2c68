"""Readers of .msh, .vtu, .bdf and .med by meshio: one place for what it leaves open.

An entity counts in every group that names it, and groups of one name are one group.
"""

import contextlib
import io
import re
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import gmsh
import meshio
import numpy as np
from meshio._mesh import topological_dimension

from r37core.base.io import NO_ROOM
from r37core.mesh.generate import quiet_gmsh
from r37imports.refusal import ImportRefused

from .bulk_data import bulk_cards
from .coordinate_systems import GridPoints
from .raw_mesh import RawMesh, solid_blocks

# meshio 5.3.5 knows the 15-node wedge in its formats but not here, and stops when a mesh has one
topological_dimension.setdefault("wedge15", 3)

_FIELDS = {"CTRIA3": 6, "CQUAD4": 7, "CTRIA6": 9, "CQUAD8": 11}
"""Fields up to the last node of shells; meshio takes the material angle after it for a node."""


def read_with_meshio(file: Path) -> RawMesh:
    """The mesh of a file in a format of meshio."""
    return raw_mesh(meshio.read(file))


def read_msh(file: Path) -> RawMesh:
    """The mesh of a file of gmsh, of version 2.2, 4.0 or 4.1. meshio knows one group of an entity; gmsh knows all of them.

    Raises ImportRefused for another kind of file: gmsh would run it as a script. It opens a copy, next to which no file has
    options.
    """
    content = file.read_bytes()
    head = re.match(rb"(?:\$Comments.*?\$EndComments\s+)?\$MeshFormat\s+(\d\S*)", content, re.DOTALL)
    if head is None:
        raise ImportRefused("found no $MeshFormat at its beginning; allowed: a mesh that gmsh has written")
    version = head[1]
    is_old = version.startswith(b"2")
    # of equal names gmsh and meshio keep one
    section = content.partition(b"$PhysicalNames")[2].partition(b"$EndPhysicalNames")[0]
    named = re.findall(rb'(?m)^\s*(\d)\s+(\d+)\s+"(.*)"', section)
    names = {(int(dimension), int(group)): name.decode(errors="replace") for dimension, group, name in named}
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "mesh.msh"
        copy.write_bytes(content)
        if version in (b"4", b"4.0"):
            # version 4.0, which meshio does not read
            with quiet_gmsh():
                gmsh.option.setNumber("Mesh.SaveAll", 1)
                gmsh.open(str(copy))
                gmsh.write(str(copy))
        mesh = meshio.read(copy)
        # before version 4 each element has its group, and one of several groups is there several times
        field = "gmsh:physical" if is_old else "gmsh:geometrical"
        groups = list(_groups_of_gmsh(copy))
    numbers = mesh.cell_data.get(field, [np.zeros(len(block.data), dtype=int) for block in mesh.cells])
    sets = []
    for dimension, group, entities in groups:
        wanted = [group] if is_old else entities
        pairs = zip(mesh.cells, numbers, strict=True)
        # a group names a surface that is turned round by a negative number
        nodes = _joined(block.data[np.isin(np.abs(own), wanted)] for block, own in pairs if block.dim == dimension)
        sets += [(name, nodes) for name in (f"gmsh:physical={group}", names.get((dimension, group))) if name]
    mesh.cell_data.pop("gmsh:physical", None)
    # meshio has numbers of surfaces for cells
    mesh.cell_sets.clear()
    raw = raw_mesh(mesh, sets)
    return replace(raw, blocks={name: _once(block) for name, block in raw.blocks.items()}) if is_old else raw


def _once(block: np.ndarray) -> np.ndarray:
    """The elements of a block, each once, in their order."""
    _, first = np.unique(block, axis=0, return_index=True)
    return block[np.sort(first)]


def _groups_of_gmsh(file: Path) -> Iterator[tuple[int, int, np.ndarray]]:
    """Dimension, number and entities of each physical group of a file."""
    with quiet_gmsh():
        gmsh.open(str(file))
        for dimension, group in gmsh.model.getPhysicalGroups():
            yield dimension, group, np.abs(gmsh.model.getEntitiesForPhysicalGroup(dimension, group))


def read_med(file: Path) -> RawMesh:
    """The mesh of a file of Salome; names of its groups may have any letter, which meshio does not read."""
    # slow to import, and few meshes come in it
    import h5py

    with tempfile.TemporaryDirectory() as folder:
        plain = Path(shutil.copy(file, folder))
        with h5py.File(plain, "r+") as content:
            families = content.require_group(f"FAS/{next(iter(content['ENS_MAA']))}")
            tags = {place: _names_of(families.pop(place)) for place in ("NOEUD", "ELEME") if place in families}
        mesh = meshio.read(plain)
    mesh.point_tags, mesh.cell_tags = tags.get("NOEUD", {}), tags.get("ELEME", {})
    return raw_mesh(mesh)


def _names_of(families: Mapping[str, Any]) -> dict[int, list[str]]:
    """Number of each family -> names of its groups, each of at most 80 bytes in UTF-8 or Latin-1."""
    names = {}
    for family in families.values():
        rows = family["GRO"]["NOM"] if "GRO" in family else ()
        fields = [np.asarray(name, dtype=np.int8).tobytes().rstrip(b"\0 ") for name in rows]
        names[int(family.attrs["NUM"])] = [_text(field) for field in fields]
    return names


def _text(field: bytes) -> str:
    try:
        return field.decode()
    except UnicodeDecodeError:
        return field.decode("latin-1")


def read_nastran(file: Path) -> RawMesh:
    """The mesh of a bulk data file, in Nastran's basic coordinate system.

    Raises ImportRefused for a file without nodes or without its end, for coordinate systems that it lacks, and for solids some
    of whose mid-nodes are blank.
    """
    cards = list(bulk_cards(file))
    names = {card[0].partition(" ")[0] for card in cards}
    if "INCLUDE" in names:
        raise ImportRefused("found INCLUDE; write the deck as one file")
    if lacking := {"GRID", "ENDDATA"} - names:
        raise ImportRefused(
            f"found no {max(lacking)} in its bulk data; the file is empty, cut short, or no deck of Nastran: write it again"
        )
    for card in cards:
        _check_nodes(card)
    grid = GridPoints(cards)
    numbered = zip(grid.labels, grid.positions.tolist(), strict=True)
    points = [["GRID", str(label), "", *map(repr, point)] for label, point in numbered]
    # with commas and marks, as meshio reads all of them
    lines = [
        f"{','.join(card[:9])}" + "".join(f"\n+,{','.join(card[i : i + 8])}" for i in range(9, len(card), 8))
        for card in (["BEGIN BULK"], *points, *(card[: _FIELDS.get(card[0])] for card in cards if card[0] != "GRID"))
    ]
    return raw_mesh(meshio.nastran.read(io.StringIO("\n".join([*lines, ""]))))


_CORNERS = {"CTETRA": (4, 10), "CPYRAM": (5, 13), "CPENTA": (6, 15), "CHEXA": (8, 20)}
"""Solids of Nastran: number of their corners, and of all their nodes."""


def _check_nodes(card: list[str]) -> None:
    """Refuse a solid some of whose mid-nodes are blank or 0: Nastran leaves such an edge straight, and without a node."""
    if (name := card[0]) in _CORNERS:
        filled = [cell.strip("0") != "" for cell in card[3:]]
        count = max((place for place, is_filled in enumerate(filled, 1) if is_filled), default=0)
        if not all(filled[:count]) or count not in _CORNERS[name]:
            raise ImportRefused(
                f"{name} {card[1]}: found {sum(filled)} nodes; allowed: {' or '.join(map(str, _CORNERS[name]))}, with all "
                "mid-nodes or none: let the preprocessor fill in the others"
            )


def quietly(read: Callable[[Path], RawMesh], file: Path) -> RawMesh:
    """Result of `read` for the file, its prints kept back; ImportRefused for any error, and for an attempt to exit.

    That there is no room for a file is said by who writes it: see r37core.base.io.room_for.
    """
    printed = io.StringIO()
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            return read(file)
    except ImportRefused:
        raise
    except (Exception, SystemExit) as error:
        if getattr(error, "errno", None) in NO_ROOM:
            raise
        lacking = f"something names {error}, which the file lacks; are there elements without their mid-nodes?"
        cause = (
            lacking
            if isinstance(error, KeyError)
            else f"{type(error).__name__}: {str(error) or 'the file is damaged'}; write it again"
        )
        if "Incompatible cell data 'gmsh:physical'" in str(error):
            cause = "some elements are in no physical group: give all volumes one, or write with Mesh.SaveAll = 0"
        elif read is read_msh:
            cause = "it is damaged, or has partitions: let gmsh write it with Mesh.MshFileVersion = 2.2"
        reason = " ".join(printed.getvalue().split()) or cause
        raise ImportRefused(f"the reader gave up: {reason}") from None


def raw_mesh(mesh: Any, groups: Iterable[tuple[str, np.ndarray]] = ()) -> RawMesh:
    """The solids and named sets of a mesh of meshio, and further `groups`: those of one name are one set."""
    blocks = solid_blocks((block.type, block.data) for block in mesh.cells)
    points = np.zeros((len(mesh.points), 3))
    points[:, : np.shape(mesh.points)[1]] = mesh.points
    parts: dict[str, list[np.ndarray]] = {}
    for name, nodes in (*_sets(mesh), *groups):
        if len(nodes):
            parts.setdefault(name, []).append(nodes)
    sets = {name: np.unique(np.concatenate(several)) for name, several in parts.items()}
    return RawMesh(points, np.arange(1, len(points) + 1), blocks, sets)


def _sets(mesh: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Named sets of nodes and of cells (as their nodes), groups of MED, and whole-number fields by value.

    A field of whole numbers on nodes or cells is a set for each value: `name=value`, and `name` where it only marks nodes.
    """
    single, cells = np.arange(len(mesh.points))[:, None], [block.data for block in mesh.cells]
    of_points = {name: [(single, np.asarray(values))] for name, values in mesh.point_data.items()}
    of_cells = {name: list(zip(cells, map(np.asarray, parts), strict=True)) for name, parts in mesh.cell_data.items()}
    for fields in (of_points, of_cells):
        for name, pairs in fields.items():
            if all(values.ndim == 1 and np.issubdtype(values.dtype, np.integer) for _, values in pairs):
                distinct = np.unique(np.concatenate([values for _, values in pairs]))
                for value in distinct[:_MOST_VALUES]:
                    yield f"{name}={value}", _nodes_where(pairs, value)
                if fields is of_points and set(distinct.tolist()) <= {0, 1}:
                    yield name, _nodes_where(pairs, 1)
    for kind, fields in (("cell_tags", of_cells), ("point_tags", of_points)):
        for number, names in (getattr(mesh, kind, None) or {}).items():
            for name in names:
                yield name, _nodes_where(fields[kind], number)
    if not getattr(mesh, "cell_tags", None):
        for name, members in mesh.cell_sets.items():
            chosen = zip(cells, members, strict=True)
            yield name, _joined(block[np.asarray(some, dtype=int)] for block, some in chosen if some is not None)
    for name, nodes in mesh.point_sets.items():
        yield name, np.asarray(nodes, dtype=int)


def _nodes_where(pairs: Iterable[tuple[np.ndarray, np.ndarray]], number: int) -> np.ndarray:
    """Nodes of the cells that have `number` in a field, of `pairs` of cells and values."""
    return _joined(nodes[values == number] for nodes, values in pairs)


def _joined(parts: Iterable[np.ndarray]) -> np.ndarray:
    """All numbers of some arrays, one after another."""
    return np.concatenate([np.empty(0, dtype=int), *map(np.ravel, parts)])


_MOST_VALUES = 100
