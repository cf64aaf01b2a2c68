"""A blade's mesh written in the formats of other programs, with its root and tip as named surfaces."""

from pathlib import Path

import meshio
import numpy as np

from r37core.base.io import atomic_write
from r37core.exchange.importing.meshio_reader import quietly
from r37core.fem.surface import chosen, mask_within, outer_faces
from r37core.mesh.blade_mesh import NODE_SETS, BladeMesh

GROUPS = {"blade": 1, "root": 2, "tip": 3}
"""Name of a group of cells -> its number where a format wants one (gmsh, MED, Nastran)."""

_FACE_TYPES = {(3, False): "triangle", (3, True): "triangle6", (4, False): "quad", (4, True): "quad8"}


def write_mesh(mesh: BladeMesh, file: Path | str) -> None:
    """Write .vtu, .msh (2.2), .med or .bdf; coordinates in m.

    .vtu has node sets as marks; the others have the groups of GROUPS: solids, and the faces of root and tip.
    """
    file = Path(file)
    with atomic_write(file) as partial:
        quietly(lambda target: _WRITERS[file.suffix](mesh, target), partial)


def _vtu(mesh: BladeMesh, file: Path) -> None:
    marks = {name: np.isin(np.arange(len(mesh.points)), mesh.node_set(name)).astype(np.int8) for name in NODE_SETS}
    meshio.Mesh(mesh.points, dict(mesh.blocks), point_data=marks).write(file)


def _msh(mesh: BladeMesh, file: Path) -> None:
    cells, groups = _grouped(mesh)
    data = {"gmsh:physical": groups, "gmsh:geometrical": groups}
    names = {name: np.array([number, 3 if name == "blade" else 2]) for name, number in GROUPS.items()}
    meshio.Mesh(mesh.points, cells, cell_data=data, field_data=names).write(file, file_format="gmsh22", binary=False)


def _med(mesh: BladeMesh, file: Path) -> None:
    # MED joins all cells of a type: faces of root and tip that share one must be one block
    cells, groups = _grouped(mesh)
    joined = {kind: [i for i, (name, _) in enumerate(cells) if name == kind] for kind, _ in cells}
    tags = [-np.concatenate([groups[i] for i in positions]) for positions in joined.values()]
    blocks = [(kind, np.concatenate([cells[i][1] for i in positions])) for kind, positions in joined.items()]
    content = meshio.Mesh(mesh.points, blocks, cell_data={"cell_tags": tags})
    content.cell_tags = {-number: [name] for name, number in GROUPS.items()}
    content.point_tags = {}
    content.write(file)


def _bdf(mesh: BladeMesh, file: Path) -> None:
    cells, groups = _grouped(mesh)
    # sixteen characters of a field hold eleven digits of a negative number, and no exponent below -9
    small = np.abs(mesh.points) < 1e-9
    scale = 10.0 ** (10 - np.floor(np.log10(np.where(small, 1.0, np.abs(mesh.points)))))
    points = np.where(small, 0.0, np.round(mesh.points * scale) / scale)
    meshio.Mesh(points, cells, cell_data={"nastran:ref": groups}).write(file, file_format="nastran")


_WRITERS = {".vtu": _vtu, ".msh": _msh, ".med": _med, ".bdf": _bdf}


def _grouped(mesh: BladeMesh) -> tuple[list[tuple[str, np.ndarray]], list[np.ndarray]]:
    """Cells of the solids and of the faces of root and tip, and the number of the group of each."""
    cells = list(mesh.blocks.items())
    numbers = [GROUPS["blade"]] * len(cells)
    surface = outer_faces(mesh.blocks)
    for name in ("root", "tip"):
        members = np.isin(np.arange(len(mesh.points)), mesh.node_set(name))
        within = chosen(surface, mask_within(surface, members))
        faces = [(_FACE_TYPES[part.corners, part.quadratic], part.nodes) for part in within]
        cells += faces
        numbers += [GROUPS[name]] * len(faces)
    return cells, [np.full(len(nodes), number) for number, (_, nodes) in zip(numbers, cells, strict=True)]
