"""What a user says of a blade of another program: its files, where root and tip are. Light: the configuration imports it."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

from r37core.declared import Key
from r37core.exchange.orientation import Orientation
from r37core.exchange.refusal import ImportRefused
from r37core.units import MASS_UNITS, STIFFNESS_UNITS

from .deck_text import included_files, is_deck
from .where import Where

DECK = ".inp"
"""Ending of a deck of Abaqus or CalculiX; the text tells it too."""

SUFFIXES = (DECK, ".msh", ".vtu", ".med", ".bdf", ".nas", ".cdb")
"""Of mesh files that can be read."""


@dataclass(frozen=True)
class MeshSource:
    """Where a blade's mesh is and how to read it.

    `sense_check`: whether a tip that contradicts rotation or pressure side is refused; `digest`: hash of the files.
    """

    file: str
    orientation: Orientation
    root: Where
    tip: Where
    pressure_side_forward: Annotated[
        bool,
        Key(
            "forward: the pressure side looks towards the rotation, as in a compressor",
            name="pressure_side",
            words={"forward": True, "backward": False},
        ),
    ] = True
    revolution_tolerance: Annotated[
        float, Key("how far the tip may be from a surface of revolution", "_m", ge=1e-9, le=0.1)
    ] = 1e-4
    drop_free_nodes: Annotated[bool, Key("leave out nodes of no solid element instead of refusing them")] = False
    minimum_scaled_jacobian: Annotated[
        float, Key("meshes with elements below are refused; 1 is ideal, 0 folded", ge=1e-6, le=1)
    ] = 0.02
    end_check: Annotated[bool, Key("refuse a root or tip with side faces, or without a part of the blade's end")] = True
    sense_check: bool = field(kw_only=True)
    digest: str = ""


@dataclass(frozen=True)
class MatricesSource:
    """A directory of matrices, the axes of its boundary nodes, units of mass and stiffness, and a hash of the files.

    `sense_check`: whether a rotation that the nodes contradict is refused.
    """

    folder: str
    orientation: Orientation
    mass_unit: Annotated[str, Key("of M", one_of=MASS_UNITS)]
    stiffness_unit: Annotated[str, Key("of the K_<speed>", one_of=STIFFNESS_UNITS)]
    sense_check: bool
    digest: str = ""


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
    ours = (file for file in sorted(folder.glob("*")) if file.suffix in (".mtx", ".npz") or file.name == "boundary.csv")
    files = [file for file in ours if os.path.isfile(file)]
    by_stem = {file.stem: file for file in files}
    speeds = [stem for stem in by_stem if stem.startswith("K_")]
    missing = [stem for stem in ("M", "boundary") if stem not in by_stem]
    if missing or len(speeds) != 3 or len(by_stem) != len(files):
        raise ImportRefused(
            f"{name}: found {', '.join(file.name for file in files) or 'no files'}; needed: M and K_<speed> at three speeds in "
            "rad/s, one of them 0 (each .mtx or .npz), and boundary.csv",
            "matrices",
        )
    return by_stem


def digest_of(files: Iterable[Path]) -> str:
    """Short hash of what the files hold."""
    digest = hashlib.sha256()
    for file in files:
        with open(file, "rb") as stream:
            digest.update(hashlib.file_digest(stream, "sha256").digest())
    return digest.hexdigest()[:16]
