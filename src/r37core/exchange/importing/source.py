"""What a user says of a blade of another program: its files, where root and tip are. Light: the configuration imports it."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from r37core.exchange.orientation import Orientation
from r37core.exchange.refusal import ImportRefused
from r37core.fem.surface import Faces, faces_within

from .raw_mesh import RawMesh

SUFFIXES = (".inp", ".msh", ".vtu", ".med", ".bdf", ".nas", ".cdb")
"""Of mesh files that can be read."""


MASS_UNITS = {"kg": 1.0, "g": 1e-3, "t": 1e3}
"""Name of a unit of mass -> kg."""

STIFFNESS_UNITS = {"N/m": 1.0, "N/mm": 1e3}
"""Name of a unit of stiffness -> N/m."""


@dataclass(frozen=True)
class Where:
    """A part of the surface: all faces whose nodes are in the set `set_name` or keep all the limits given.

    `limits`: (coordinate, bound, value in m) with coordinate r, x or z of the blade's frame and bound `at_least` or
    `at_most`; `cone_zr`: two points (z, r) in m of a straight meridian that the faces lie on; `tolerance` (m): of limits and
    cone.
    """

    set_name: str | None = None
    limits: tuple[tuple[str, str, float], ...] = ()
    cone_zr: tuple[tuple[float, float], tuple[float, float]] | None = None
    tolerance: float = field(kw_only=True)

    def faces(self, what: str, mesh: RawMesh, surface: list[Faces]) -> list[Faces]:
        """Faces of `surface`, the outer faces of `mesh`; ImportRefused, naming `what` is looked for, where there are none."""
        members = self._members(what, mesh)
        found = faces_within(surface, members)
        if not found:
            inside = "" if self.set_name is None else f" of set '{self.set_name}', which has {members.sum()} nodes,"
            raise ImportRefused(
                f"{what}: no outer face has all its nodes within {self.describe()}{inside and ';'}{inside} give another set "
                "or rule, or a wider tolerance_m"
            )
        return found

    def describe(self) -> str:
        """The rule in words."""
        if self.set_name is not None:
            return f"the set '{self.set_name}'"
        parts = [f"{name} {bound.replace('_', ' ')} {value:g} m" for name, bound, value in self.limits]
        if self.cone_zr is not None:
            parts.append("the cone through (z, r) = ({:g}, {:g}) and ({:g}, {:g}) m".format(*self.cone_zr[0], *self.cone_zr[1]))
        return f"{' and '.join(parts)}, to {self.tolerance:g} m"

    def _members(self, what: str, mesh: RawMesh) -> np.ndarray:
        """Mask over the nodes."""
        if self.set_name is not None:
            names = {name.upper(): name for name in mesh.sets}
            if self.set_name.upper() not in names:
                known = ", ".join(sorted(mesh.sets)) or "none"
                raise ImportRefused(f"{what}: found no set '{self.set_name}'; the file has: {known}")
            members = np.zeros(len(mesh.points), dtype=bool)
            members[mesh.sets[names[self.set_name.upper()]]] = True
            return members
        x, y, z = mesh.points.T
        coordinates = {"r": np.hypot(x, y), "x": x, "z": z}
        members = np.ones(len(mesh.points), dtype=bool)
        for name, bound, value in self.limits:
            sign = 1.0 if bound == "at_least" else -1.0
            members &= sign * (coordinates[name] - value) >= -self.tolerance
        if self.cone_zr is not None:
            (z0, r0), (z1, r1) = self.cone_zr
            length = np.hypot(z1 - z0, r1 - r0)
            off = ((coordinates["r"] - r0) * (z1 - z0) - (z - z0) * (r1 - r0)) / length
            members &= np.abs(off) <= self.tolerance
        return members


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
