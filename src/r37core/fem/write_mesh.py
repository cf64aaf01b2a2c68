"""A blade's mesh written in the formats of other programs, with its root and tip as named surfaces."""

from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import meshio
import numpy as np

from r37core.base.io import atomic_write
from r37core.fem.surface import chosen, mask_within, outer_faces
from r37core.mesh.blade_mesh import NODE_SETS, BladeMesh

GROUPS = {"blade": 1, "root": 2, "tip": 3}
"""Name of a group of cells -> its number."""

_FACE_TYPES = {(3, False): "triangle", (3, True): "triangle6", (4, False): "quad", (4, True): "quad8"}


def write_mesh(mesh: BladeMesh, file: Path | str) -> None:
    """Write .vtu or .msh (2.2); coordinates in m.

    .vtu has node sets as marks, .msh the groups of GROUPS: solids, and the faces of root and tip.
    """
    file = Path(file)
    # meshio prints
    with atomic_write(file) as partial, redirect_stdout(StringIO()):
        if file.suffix == ".vtu":
            marks = {name: mesh.mask(name).astype(np.int8) for name in NODE_SETS}
            meshio.Mesh(mesh.points, dict(mesh.blocks), point_data=marks).write(partial)
            return
        cells, numbers, surface = list(mesh.blocks.items()), [GROUPS["blade"]] * len(mesh.blocks), outer_faces(mesh.blocks)
        for name in ("root", "tip"):
            within = chosen(surface, mask_within(surface, mesh.mask(name)))
            cells += [(_FACE_TYPES[part.corners, part.quadratic], part.nodes) for part in within]
            numbers += [GROUPS[name]] * len(within)
        # of each cell
        groups = [np.full(len(nodes), number) for number, (_, nodes) in zip(numbers, cells, strict=True)]
        data = {"gmsh:physical": groups, "gmsh:geometrical": groups}
        names = {name: np.array([number, 3 if name == "blade" else 2]) for name, number in GROUPS.items()}
        grid = meshio.Mesh(mesh.points, cells, cell_data=data, field_data=names)
        grid.write(partial, file_format="gmsh22", binary=False)
