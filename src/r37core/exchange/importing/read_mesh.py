"""A mesh file read by the reader of its format."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from r37core.exchange.refusal import ImportRefused

from .abaqus_reader import read_abaqus
from .meshio_reader import read_ansys, read_nastran, read_with_meshio
from .raw_mesh import RawMesh
from .source import mesh_files

_READERS: dict[str, Callable[[Path], RawMesh]] = {
    ".inp": read_abaqus,
    ".msh": read_with_meshio,
    ".vtu": read_with_meshio,
    ".med": read_with_meshio,
    ".bdf": read_nastran,
    ".nas": read_nastran,
    ".cdb": read_ansys,
}


def read_mesh(name: str, root: Path | str = ".") -> RawMesh:
    """The mesh of the file `name` in the folder `root`; ImportRefused for a file that is missing, unknown or unsuitable."""
    file = mesh_files(name, Path(root))[0]
    try:
        return _READERS[file.suffix.lower()](file)
    except ImportRefused as error:
        raise ImportRefused(f"{name}: {error}") from None
    except Exception as error:
        raise ImportRefused(f"{name}: cannot be read ({type(error).__name__}: {error})") from error
