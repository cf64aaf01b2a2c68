"""A mesh from another program as a blade: read, checked, turned to the blade's frame, its root and tip found."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from r37core.exchange.refusal import ImportRefused, blamed
from r37core.fem.surface import nodes_of, outer_faces
from r37core.mesh.blade_mesh import NODE_SETS, BladeMesh

from .abaqus_reader import read_abaqus
from .frame import blade_parameters
from .mesh_checks import checked, without_free_nodes
from .meshio_reader import read_ansys, read_nastran, read_with_meshio
from .raw_mesh import RawMesh
from .source import MeshSource, mesh_files
from .tip import check_revolution, check_sense, find_tip_lines

_READERS: dict[str, Callable[[Path], RawMesh]] = {
    ".inp": read_abaqus,
    ".msh": read_with_meshio,
    ".vtu": read_with_meshio,
    ".med": read_with_meshio,
    ".bdf": read_nastran,
    ".nas": read_nastran,
    ".cdb": read_ansys,
}


def import_mesh(source: MeshSource, folder: Path | str = ".") -> tuple[BladeMesh, np.ndarray]:
    """The blade's mesh and the scaled Jacobian of each element, shape (elements,); `folder`: what `source.file` starts from.

    Raises ImportRefused, with the file's name and the reason, for a mesh that cannot be computed with.
    """
    with blamed("mesh"):
        raw = _read(source.file, Path(folder))
    with blamed("mesh", source.file):
        raw, quality = checked(without_free_nodes(raw) if source.drop_free_nodes else raw, source.minimum_scaled_jacobian)
    with blamed("rotor_axis", source.file):
        raw = source.orientation.to_blade(raw)
    surface = outer_faces(raw.blocks)
    with blamed("root", source.file):
        root = nodes_of(source.root.faces("root", raw, surface))
    with blamed("tip", source.file):
        tip_faces = source.tip.faces("tip", raw, surface)
        tip = nodes_of(tip_faces)
        if np.intersect1d(root, tip).size:
            raise ImportRefused(f"root ({source.root.describe()}) and tip ({source.tip.describe()}) share nodes")
        check_revolution(raw.points[tip], source.revolution_tolerance)
        lines = find_tip_lines(raw.points, tip_faces, source.pressure_side_forward)
        if source.sense_check:
            check_sense(raw.points, lines, source.pressure_side_forward)
    parameters, normals = blade_parameters(raw.points, root, tip, source.pressure_side_forward)
    sets = dict.fromkeys(NODE_SETS, np.empty(0, dtype=np.int64)) | {"root": root, "tip": tip}
    # the edges come last: nodes that they share with the camber line count by their place on the edge
    for name, (nodes, fractions) in reversed(lines.lines.items()):
        sets[name] = nodes
        parameters[nodes, 0] = fractions
    sets["leading_edge"], sets["trailing_edge"] = (np.array([node]) for node in lines.corners)
    parameters[root, 1], parameters[tip, 1] = 0.0, 1.0
    return BladeMesh(raw.points, raw.blocks, parameters, normals, sets), quality


def _read(name: str, root: Path) -> RawMesh:
    """The mesh of the file `name` in the folder `root`; ImportRefused for a file that is missing, unknown or unsuitable."""
    file = mesh_files(name, root)[0]
    try:
        return _READERS[file.suffix.lower()](file)
    except ImportRefused as error:
        raise ImportRefused(f"{name}: {error}") from None
    except Exception as error:
        raise ImportRefused(f"{name}: cannot be read ({type(error).__name__}: {error})") from error
