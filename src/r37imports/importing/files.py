"""Files of blades of other programs: which there are, of which kind, and a hash of what they hold."""

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path

from r37imports.refusal import ImportRefused

from .deck_text import included_files, is_deck

DECK = ".inp"
"""Ending of a deck of Abaqus or CalculiX; the text tells it too."""

SUFFIXES = (DECK, ".msh", ".vtu", ".med", ".bdf", ".nas", ".cdb")
"""Endings of mesh files that can be read."""


def mesh_files(name: str, root: Path) -> list[Path]:
    """The mesh file `name` in the folder `root` and those that it includes (*INCLUDE of an Abaqus deck).

    Raises ImportRefused for a file of an unknown kind, for one that is not there, and for one that includes itself.
    """
    file = root / name
    if not os.path.isfile(file):
        raise ImportRefused(f"there is no file {name}", "mesh")
    return [file, *(included_files(file) if kind_of(file) == DECK else [])]


def kind_of(file: Path) -> str:
    """How a mesh file is read, one of SUFFIXES: DECK where its text is Abaqus's, else its ending; ImportRefused for others."""
    if is_deck(file):
        return DECK
    suffix = file.suffix.lower()
    if suffix not in SUFFIXES:
        raise ImportRefused(
            f"found a file of kind '{suffix}' whose text does not begin with a keyword of Abaqus, such as *NODE; allowed: "
            f"{', '.join(SUFFIXES)}, and Abaqus text with any ending",
            "mesh",
        )
    return suffix


def matrix_files(name: str, root: Path) -> dict[str, Path]:
    """`M`, `K_<speed>` and `boundary` -> file, in the folder `name` of `root`; ImportRefused where one is missing."""
    folder = root / name
    if not os.path.isdir(folder):
        raise ImportRefused(f"there is no folder {name}", "matrices")
    ours = (file for file in sorted(folder.glob("*")) if os.path.isfile(file))
    files = [file for file in ours if file.suffix == ".mtx" or file.name == "boundary.csv"]
    files_of_stem = {file.stem: file for file in files}
    speeds = [stem for stem in files_of_stem if stem.startswith("K_")]
    missing = [stem for stem in ("M", "boundary") if stem not in files_of_stem]
    if missing or len(speeds) != 3 or len(files_of_stem) != len(files):
        raise ImportRefused(
            f"{name}: found {', '.join(file.name for file in files) or 'no files'}; needed: M and K_<speed> at three speeds in "
            "rad/s, one of them 0 (each .mtx), and boundary.csv",
            "matrices",
        )
    return files_of_stem


def digest_of(files: Iterable[Path]) -> str:
    """Short hash of what the files hold."""
    digest = hashlib.sha256()
    for file in files:
        with open(file, "rb") as stream:
            digest.update(hashlib.file_digest(stream, "sha256").digest())
    return digest.hexdigest()[:16]
