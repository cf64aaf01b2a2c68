"""Where a blade of another program comes from: its mesh or its matrices. Light: the configuration imports it."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from r37core.exchange.orientation import Orientation
from r37core.exchange.refusal import ImportRefused

from .where import Where

SUFFIXES = (".inp", ".msh", ".vtu", ".med", ".bdf", ".nas", ".cdb")
"""Of mesh files that can be read."""


MASS_UNITS = {"kg": 1.0, "g": 1e-3, "t": 1e3}
"""Name of a unit of mass -> kg."""

STIFFNESS_UNITS = {"N/m": 1.0, "N/mm": 1e3}
"""Name of a unit of stiffness -> N/m."""


@dataclass(frozen=True)
class MeshSource:
    """Where a blade's mesh is and how to read it.

    `file`; its `orientation`; where `root` and `tip` are; `pressure_side_forward`: whether the pressure side looks towards
    the rotation, as in a compressor; `revolution_tolerance` (m): how far the tip may be from a surface of revolution;
    `drop_free_nodes`: whether nodes of no solid element are left out instead of refused; `minimum_scaled_jacobian`: elements
    below are refused; `sense_check`: whether a tip that contradicts rotation or pressure side is refused; `digest`: hash of
    the files.
    """

    file: str
    orientation: Orientation
    root: Where
    tip: Where
    pressure_side_forward: bool
    revolution_tolerance: float
    drop_free_nodes: bool
    minimum_scaled_jacobian: float
    sense_check: bool
    digest: str = ""


@dataclass(frozen=True)
class MatricesSource:
    """A directory of matrices, the axes of its boundary nodes, units of mass and stiffness, and a hash of the files.

    `sense_check`: whether a rotation that the nodes contradict is refused.
    """

    folder: str
    orientation: Orientation
    mass_unit: str
    stiffness_unit: str
    sense_check: bool
    digest: str = ""


def mesh_files(name: str, root: Path) -> list[Path]:
    """The mesh file `name` in the folder `root` and those that it includes (*INCLUDE of an Abaqus deck).

    Raises ImportRefused for a file of an unknown kind and for one that is not there.
    """
    file = root / name
    if file.suffix.lower() not in SUFFIXES:
        raise ImportRefused(f"found a file of kind '{file.suffix}'; allowed: {', '.join(SUFFIXES)}", "mesh")
    found: list[Path] = []
    waiting = [(name, file)]
    while waiting:
        called, one = waiting.pop(0)
        if not one.is_file():
            raise ImportRefused(f"there is no file {called}", "mesh")
        if one not in found:
            found.append(one)
            waiting += [(part, one.parent / part) for part in _included(one)] if one.suffix.lower() == ".inp" else []
    return found


def matrix_files(name: str, root: Path) -> dict[str, Path]:
    """`M`, `K_<speed>` and `boundary` -> file, in the folder `name` of `root`; ImportRefused where one is missing."""
    folder = root / name
    files = [file for file in sorted(folder.glob("*")) if file.suffix in (".mtx", ".npz") or file.name == "boundary.csv"]
    found = {file.stem: file for file in files}
    speeds = [stem for stem in found if stem.startswith("K_")]
    missing = [stem for stem in ("M", "boundary") if stem not in found]
    if missing or len(speeds) != 3 or len(found) != len(files):
        raise ImportRefused(
            f"{name}: found {', '.join(file.name for file in files) or 'no files'}; needed: M and K_<speed> at three speeds in "
            "rad/s, one of them 0 (each .mtx or .npz), and boundary.csv",
            "matrices",
        )
    return found


def digest_of(files: Iterable[Path]) -> str:
    """Short hash of what the files hold."""
    digest = hashlib.sha256()
    for file in files:
        with open(file, "rb") as stream:
            digest.update(hashlib.file_digest(stream, "sha256").digest())
    return digest.hexdigest()[:16]


def _included(deck: Path) -> list[str]:
    """Names of the files that a deck includes."""
    names = []
    with open(deck, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if line[:8].upper() == "*INCLUDE":
                names += [word.partition("=")[2].strip() for word in line.split(",")[1:] if "=" in word]
    return names
