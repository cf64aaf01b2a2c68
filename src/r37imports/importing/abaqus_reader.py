"""Reader of Abaqus and CalculiX decks.

meshio's reader is not used: version 5.3.5 keeps only the last of several *NODE blocks, drops what follows a comment inside a
block, ignores sets made of sets, and stops at surface elements that gmsh writes, the first three without a word.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np
from scipy.spatial.transform import Rotation

from r37core.fem.elements import ELEMENTS
from r37imports.refusal import ImportRefused

from .deck_text import deck_lines, deck_number, keyword_and_options
from .raw_mesh import RawMesh, solid_blocks

T = TypeVar("T")

CLAMPED = "BOUNDARY"
"""Name of the set of the nodes that *BOUNDARY clamps."""

_TYPES = {element.abaqus: name for name, element in ELEMENTS.items()}
# keywords that make or move nodes and elements
_GENERATORS = ("SYSTEM", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY")


@dataclass
class _Deck:
    points: dict[int, list[float]] = field(default_factory=dict)
    solids: dict[str, dict[int, list[int]]] = field(default_factory=dict)
    others: dict[int, list[int]] = field(default_factory=dict)
    node_sets: dict[str, list[int]] = field(default_factory=dict)
    element_sets: dict[str, list[int]] = field(default_factory=dict)
    nodes_of_elements: list[tuple[str, str]] = field(default_factory=list)
    surfaces: dict[str, list[tuple[str, str]]] = field(default_factory=dict)
    held: list[tuple[str, range]] = field(default_factory=list)
    components: dict[str, list[tuple[str, list[list[str]]]]] = field(default_factory=dict)
    scope: str = ""


def read_abaqus(file: Path) -> RawMesh:
    """The mesh of a deck with one part, where its instance stands; sets of nodes, elements and faces become sets of nodes.

    The nodes that *BOUNDARY holds in all three directions are the set CLAMPED.

    Raises ImportRefused for decks with several parts or instances, and for what cannot be read.
    """
    deck = _Deck()
    for keyword, options, rows in deck_blocks(file):
        _take(deck, keyword, options, rows)
    labels = np.array(list(deck.points), dtype=np.int64)
    number = {label: i for i, label in enumerate(deck.points)}
    try:
        points = _placed(deck, np.array(list(deck.points.values()), dtype=float).reshape(-1, 3))
        cells = [(name, np.array([[number[n] for n in row] for row in of.values()])) for name, of in deck.solids.items()]
    except KeyError as error:
        raise ImportRefused(f"an element names node {error.args[0]}, which the deck lacks") from None
    sets = {
        name: np.array(sorted({number[label] for label in of_set if label in number}), dtype=np.int64)
        for name, of_set in _node_lists(deck)
    }
    return RawMesh(points, labels, solid_blocks(cells), sets)


def deck_blocks(file: Path) -> Iterator[tuple[str, dict[str, str], list[list[str]]]]:
    """Keyword, options and data rows of every block of a deck and of what it includes."""
    keyword = ""
    options: dict[str, str] = {}
    rows: list[list[str]] = []
    for line in deck_lines(file):
        if line.startswith("*"):
            yield keyword, options, rows
            (keyword, options), rows = keyword_and_options(line), []
        else:
            rows.append([cell.strip() for cell in line.split(",")])
    yield keyword, options, rows


def _take(deck: _Deck, keyword: str, options: dict[str, str], rows: list[list[str]]) -> None:
    if keyword in _GENERATORS:
        raise ImportRefused(f"found *{keyword}; write the deck with every node and element in one Cartesian system")
    if keyword == "NODE" and options.get("SYSTEM", "R").upper() != "R":
        raise ImportRefused("found *NODE in cylindrical or spherical coordinates; write the deck in Cartesian ones")
    if keyword in ("PART", "ASSEMBLY", "INSTANCE"):
        deck.scope = keyword
        # nodes of its own may follow how an instance is placed
        known = deck.components.setdefault(keyword, [])
        known.append((options.get("NAME", "?"), rows))
        if len(known) > 1:
            names = ", ".join(name for name, _ in known)
            raise ImportRefused(f"found several {keyword.lower()}s ({names}); allowed: one blade in one part")
    elif keyword.startswith("END "):
        deck.scope = "ASSEMBLY" if keyword == "END INSTANCE" else ""
    elif keyword == "NODE" and deck.scope == "ASSEMBLY":
        return  # reference points, numbered from 1 once more
    elif keyword == "NODE":
        nodes = [(int(row[0]), ([deck_number(cell) for cell in row[1:] if cell] + [0.0] * 3)[:3]) for row in rows]
        _define(deck.points, "node", nodes)
        _add(deck.node_sets, options.get("NSET"), [int(row[0]) for row in rows])
    elif keyword == "ELEMENT":
        _take_elements(deck, options, rows)
    elif keyword == "NSET" and "ELSET" in options:
        deck.nodes_of_elements.append((options.get("NSET", ""), options["ELSET"]))
    elif keyword in ("NSET", "ELSET"):
        sets = deck.node_sets if keyword == "NSET" else deck.element_sets
        _add(sets, options.get(keyword), _members(sets, "GENERATE" in options, rows))
    elif keyword == "BOUNDARY" and options.get("TYPE", "DISPLACEMENT").upper() == "DISPLACEMENT":
        # neither of another model nor of a motion over time
        if options.keys().isdisjoint(("SUBMODEL", "USER", "AMPLITUDE")):
            deck.held += [(row[0], _directions_held(row)) for row in rows]
    elif keyword == "SURFACE" and options.get("TYPE", "ELEMENT").upper() == "ELEMENT":
        deck.surfaces[options.get("NAME", "")] = [(row[0], row[1].upper() if len(row) > 1 else "") for row in rows]


def _placed(deck: _Deck, points: np.ndarray) -> np.ndarray:
    """The points where the deck's instance stands: shifted, then turned about an axis (Abaqus, *INSTANCE)."""
    for name, rows in deck.components.get("INSTANCE", []):
        try:
            shift, *turn = [np.array([deck_number(cell) for cell in row if cell]) for row in rows] or [np.zeros(3)]
            points = points + shift
            for numbers in turn:
                first, along, degrees = numbers[:3], numbers[3:6] - numbers[:3], numbers[6]
                if not along.any():
                    raise ValueError
                axis = along / np.linalg.norm(along)
                points = first + Rotation.from_rotvec(degrees * axis, degrees=True).apply(points - first)
        except (ValueError, IndexError):
            raise ImportRefused(
                f"instance {name}: how it is placed cannot be read; allowed: three numbers that shift it, then seven "
                "that turn it"
            ) from None
    return points


def _take_elements(deck: _Deck, options: dict[str, str], rows: list[list[str]]) -> None:
    kind = options.get("TYPE", "").upper()
    solid = re.fullmatch(r"([A-Z]?C3D\d+)[A-Z]*", kind)
    name = _TYPES.get(solid[1]) if solid else None
    numbers = [int(cell) for row in rows for cell in row if cell]
    if name is None:
        if solid:
            raise ImportRefused(f"found elements of type {kind}; allowed: {', '.join(_TYPES)}")
        # one row each: surface and line elements have at most nine nodes
        deck.others |= {int(row[0]): [int(cell) for cell in row[1:] if cell.isdigit()] for row in rows}
        _add(deck.element_sets, options.get("ELSET"), [int(row[0]) for row in rows])
        return
    width = 1 + len(ELEMENTS[name].nodes)
    if len(numbers) % width:
        raise ImportRefused(f"elements of type {kind} must have {width - 1} nodes each; a row is too long or too short")
    elements = [(numbers[i], numbers[i + 1 : i + width]) for i in range(0, len(numbers), width)]
    _define(deck.solids.setdefault(name, {}), "element", elements)
    _add(deck.element_sets, options.get("ELSET"), [number for number, _ in elements])


def _define(known: dict[int, list[T]], what: str, entries: list[tuple[int, list[T]]]) -> None:
    """Add `entries` by number; a number that comes twice must have the same values both times."""
    for number, values in entries:
        if known.setdefault(number, values) != values:
            raise ImportRefused(f"{what} {number} is given twice, and not alike; number nodes and elements once")


_MOST_GENERATED = 10_000_000
"""Numbers of a set in one row: more nodes than a blade has."""


def _members(sets: dict[str, list[int]], generated: bool, rows: list[list[str]]) -> list[int]:
    """Numbers listed, generated, or taken over from other sets."""
    members: list[int] = []
    for row in rows:
        cells = [cell for cell in row if cell]
        if generated:
            first, last, step = ([int(cell) for cell in cells] + [1])[:3]
            if step < 1 or last - first >= _MOST_GENERATED * step:
                raise ImportRefused(
                    f"a set has GENERATE with {', '.join(cells)}; allowed: first, last and a positive step, "
                    f"at most {_MOST_GENERATED} numbers"
                )
            members += range(first, last + 1, step)
        else:
            members += [number for cell in cells for number in _named(sets, cell)]
    return members


def _named(sets: dict[str, list[int]], cell: str) -> list[int]:
    """The number that a cell has, or the members of the set that it names; Part-1-1.12 is number 12 of an instance."""
    plain = cell.strip('"').rpartition(".")[2]
    return [int(plain)] if plain.isdigit() else sets.get(_found(sets, plain), [])


def _directions_held(row: list[str]) -> range:
    """Directions in which a row of *BOUNDARY (node or set, first and last direction, value) holds the place: of 1, 2, 3."""
    first, last, value = ([*row[1:], "", "", ""])[:3]
    if first.upper() in ("ENCASTRE", "PINNED"):
        return range(1, 4)
    if not first.isdigit() or float(value or 0.0):
        return range(0)
    return range(int(first), min(int(last or first), 3) + 1)


def _node_lists(deck: _Deck) -> Iterator[tuple[str, list[int]]]:
    """Every set as node labels: of nodes, of elements (their nodes), of element faces, of clamped nodes."""
    solids = {label: nodes for same_type in deck.solids.values() for label, nodes in same_type.items()}
    elements = solids | deck.others
    element_nodes = {name: [n for e in members for n in elements.get(e, [])] for name, members in deck.element_sets.items()}
    yield from element_nodes.items()
    node_sets = {name: element_nodes.get(_found(deck.element_sets, of), []) for name, of in deck.nodes_of_elements}
    for name, faces in deck.surfaces.items():
        nodes: list[int] = []
        for of, face in faces:
            for element in _named(deck.element_sets, of):
                nodes += _face_nodes(name, solids[element], face) if element in solids else elements.get(element, [])
        yield name, nodes
    node_sets |= deck.node_sets
    held = [{n for cell, of in deck.held if direction in of for n in _named(node_sets, cell)} for direction in (1, 2, 3)]
    clamped = set.intersection(*held)
    if clamped and not _found(node_sets, CLAMPED):
        yield CLAMPED, sorted(clamped)
    yield from node_sets.items()


def _face_nodes(surface: str, nodes: list[int], face: str) -> list[int]:
    """Nodes of face S1, S2, ... of a solid element, all of it where no face is named; ImportRefused for a face it lacks."""
    if not face:
        return nodes
    element = next(e for e in ELEMENTS.values() if len(e.nodes) == len(nodes))
    # numbered as in the table of elements
    faces = {f"S{number}": places for number, places in enumerate(element.faces, start=1)}
    if face not in faces:
        raise ImportRefused(f"surface {surface}: found the face {face}; allowed: {', '.join(faces)}")
    return [nodes[i] for i in faces[face]]


def _add(sets: dict[str, list[int]], name: str | None, members: list[int]) -> None:
    if name is not None:
        sets.setdefault(_found(sets, name) or name, []).extend(members)


def _found(sets: dict[str, list[int]], name: str) -> str:
    """The set's name as first written: decks do not tell capital letters."""
    return next((known for known in sets if known.upper() == name.upper()), "")
