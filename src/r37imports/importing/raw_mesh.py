"""A mesh as a file gives it: in the file's units and axes, with its sets as node numbers."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from r37core.fem.elements import ELEMENTS
from r37imports.refusal import ImportRefused

_SURFACE = ("vertex", "line", "triangle", "quad", "polygon")
_WITH_FACE_NODES = ("hexahedron27", "wedge18")


@dataclass(frozen=True)
class RawMesh:
    """Mesh as a reader found it in a file.

    `points`: shape (nodes, 3), in the file's unit; `labels`: the file's own numbers of the nodes, shape (nodes,); `blocks`:
    element type -> nodes, shape (elements, nodes of the type), solids only; `sets`: name -> node numbers from 0.
    """

    points: np.ndarray
    labels: np.ndarray
    blocks: Mapping[str, np.ndarray]
    sets: Mapping[str, np.ndarray]

    def __post_init__(self) -> None:
        """Raise ImportRefused for an element or a set with a node that the file lacks."""
        for name, nodes in {**self.blocks, **self.sets}.items():
            if ((nodes < 0) | (nodes >= len(self.points))).any():
                raise ImportRefused(f"{name} names a node that the file lacks; write it again")


def solid_blocks(cells: Iterable[tuple[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """The solid elements among `cells` (type, nodes), joined by type in the order of the table of elements.

    Raises ImportRefused for solids that the table lacks and where there are none.
    """
    parts: dict[str, list[np.ndarray]] = {}
    for name, nodes in cells:
        if len(nodes) and not name.startswith(_SURFACE):
            block = np.asarray(nodes, dtype=np.int64)
            damaged = name in ELEMENTS and block.shape[1] != len(ELEMENTS[name].nodes)
            parts.setdefault(f"{name} with {block.shape[1]} nodes" if damaged else name, []).append(block)
    unknown = [name for name in parts if name not in ELEMENTS]
    if unknown:
        remedy = (
            "; leave nodes on faces out (Mesh.SecondOrderIncomplete = 1 in gmsh)"
            if set(unknown) & set(_WITH_FACE_NODES)
            else ""
        )
        raise ImportRefused(f"found elements of type {', '.join(unknown)}; allowed: {', '.join(ELEMENTS)}{remedy}")
    if not parts:
        raise ImportRefused(f"found no solid elements; allowed: {', '.join(ELEMENTS)}")
    return {name: np.concatenate(parts[name]) for name in ELEMENTS if name in parts}
