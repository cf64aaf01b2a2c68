"""Readers of .msh, .vtu, .bdf and .med by meshio, of .cdb by meshlane: one place for what meshio leaves open."""

import contextlib
import io
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import meshio
import numpy as np
from meshio._mesh import topological_dimension

from r37core.base.io import NO_ROOM
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
    return _raw(meshio.read(file))


def read_nastran(file: Path) -> RawMesh:
    """The mesh of a bulk data file, in Nastran's basic coordinate system.

    Raises ImportRefused for a file without nodes or without its end, and for coordinate systems that it lacks.
    """
    cards = list(bulk_cards(file))
    names = {card[0].partition(" ")[0] for card in cards}
    if lacking := {"GRID", "ENDDATA"} - names:
        raise ImportRefused(
            f"found no {max(lacking)} in its bulk data; the file is empty, cut short, or no deck of Nastran: write it again"
        )
    if "INCLUDE" in names:
        raise ImportRefused("found INCLUDE; write the deck as one file")
    grid = GridPoints(cards)
    numbered = zip(grid.labels, grid.positions.tolist(), strict=True)
    points = [["GRID", str(label), "", *map(repr, point)] for label, point in numbered]
    # with commas and marks, as meshio reads all of them
    lines = [
        f"{','.join(card[:9])}" + "".join(f"\n+,{','.join(card[i : i + 8])}" for i in range(9, len(card), 8))
        for card in (["BEGIN BULK"], *points, *(card[: _FIELDS.get(card[0])] for card in cards if card[0] != "GRID"))
    ]
    return _raw(meshio.nastran.read(io.StringIO("\n".join([*lines, ""]))))


def read_ansys(file: Path) -> RawMesh:
    """The mesh of an Ansys archive (.cdb), by the extra package meshlane."""
    try:
        import meshlane
    except ImportError:
        raise ImportRefused(
            "Ansys archives need the extra package meshlane: pip install -e '.[ansys]' in the project's folder"
        ) from None
    # titles and names may be in Latin-1
    text = io.StringIO(file.read_text(encoding="utf-8", errors="replace"))
    return _raw(meshlane.read(text, "ansysInp"))


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
        elif read is read_with_meshio and file.suffix == ".msh":
            cause = "it is damaged, or has partitions or version 4.0: let gmsh write it with Mesh.MshFileVersion = 2.2"
        reason = " ".join(printed.getvalue().split()) or cause
        raise ImportRefused(f"the reader gave up: {reason}") from None


def _raw(mesh: Any) -> RawMesh:
    blocks = solid_blocks((block.type, block.data) for block in mesh.cells)
    points = np.zeros((len(mesh.points), 3))
    points[:, : np.shape(mesh.points)[1]] = mesh.points
    sets = {name: np.unique(nodes) for name, nodes in _sets(mesh)}
    return RawMesh(points, np.arange(1, len(points) + 1), blocks, {name: nodes for name, nodes in sets.items() if len(nodes)})


def _sets(mesh: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Named sets of nodes and of cells (as their nodes), groups of gmsh and MED, and whole-number fields by value.

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
    if "gmsh:physical" in of_cells:
        for name, (number, dimension) in mesh.field_data.items():
            of_blocks = zip(mesh.cells, of_cells["gmsh:physical"], strict=True)
            yield name, _nodes_where([pair for block, pair in of_blocks if block.dim == dimension], number)
    elif not getattr(mesh, "cell_tags", None):
        for name, members in mesh.cell_sets.items():
            # of gmsh's bounding entities meshio has numbers of surfaces, not of cells
            if name != "gmsh:bounding_entities":
                parts = [
                    block[np.asarray(some, dtype=int)].ravel()
                    for block, some in zip(cells, members, strict=True)
                    if some is not None
                ]
                yield name, np.concatenate([np.empty(0, dtype=int), *parts])
    for name, nodes in mesh.point_sets.items():
        yield name, np.asarray(nodes, dtype=int)


def _nodes_where(pairs: Iterable[tuple[np.ndarray, np.ndarray]], number: int) -> np.ndarray:
    """Nodes of the cells that have `number` in a field, of `pairs` of cells and values."""
    return np.concatenate([np.empty(0, dtype=int), *(nodes[values == number].ravel() for nodes, values in pairs)])


_MOST_VALUES = 100
