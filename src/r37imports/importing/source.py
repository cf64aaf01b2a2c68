"""Description of a blade of another program: its files, where root and tip are. Light: the configuration imports it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, ClassVar

import numpy as np

from r37core.base.declared import Key
from r37core.base.units import MASS_UNITS, STIFFNESS_UNITS
from r37core.blade.definition import Definition
from r37core.fem.elements import ELEMENTS
from r37core.fem.orientation import Orientation
from r37core.rom.recovery_nodes import cylinder
from r37imports.refusal import ASKED, ImportRefused, warn_of

from .files import matrix_files, mesh_files
from .raw_mesh import RawMesh


@dataclass(frozen=True)
class Where:
    """A part of the mesh: nodes of the `sets`, or of all the mesh, that keep the limits and are in no set of `without`.

    `limits`: (coordinate, bound, value in m) with coordinate r, x or z of the blade's frame and bound `at_least` or
    `at_most`; `cone_zr`: two points (z, r) in m of a straight meridian that the nodes lie on; `planes`: the nodes lie on one
    of them, each given by its point (m) nearest to the origin; `tolerance` (m): of limits, cone and planes.
    """

    sets: Annotated[tuple[str, ...], Key("sets of the file")] = ()
    without: Annotated[tuple[str, ...], Key("sets left out")] = ()
    limits: tuple[tuple[str, str, float], ...] = ()
    cone_zr: Annotated[
        tuple[tuple[float, float], tuple[float, float]] | None,
        Key("two points [z, r] of the straight meridian that the faces lie on", "_m", ge=-100, le=100),
    ] = None
    planes: Annotated[tuple[tuple[float, float, float], ...], Key("planes, each by its point nearest the origin", "_m")] = ()
    tolerance: Annotated[float, Key("how far beyond a limit a face may lie", "_m", ge=1e-9, le=0.1)] = 1e-4

    def nodes(self, what: str, mesh: RawMesh) -> np.ndarray:
        """Mask over the nodes of `mesh`. Raises ImportRefused, naming `what` is looked for, where there is no such set."""
        named, left_out = (
            np.any([_edge_nodes(what, name, mesh) for name in names], axis=0) for names in (self.sets, self.without)
        )
        return self.within(mesh.points) & (named | (not self.sets)) & ~left_out

    def within(self, points: np.ndarray) -> np.ndarray:
        """Mask over `points` (m), shape (n, 3), that keep limits, cone and planes."""
        x, y, z = points.T
        coordinates = {"r": np.hypot(x, y), "x": x, "z": z}
        members = np.ones(len(points), dtype=bool)
        for name, bound, value in self.limits:
            sign = 1.0 if bound == "at_least" else -1.0
            members &= sign * (coordinates[name] - value) >= -self.tolerance
        if self.cone_zr is not None:
            members &= np.abs(self.off_cone(points)) <= self.tolerance
        if self.planes:
            distances = np.linalg.norm(self.planes, axis=1)
            off = points @ (self.planes / distances[:, None]).T - distances
            members &= (np.abs(off) <= self.tolerance).any(axis=1)
        return members

    def off_cone(self, points: np.ndarray) -> np.ndarray:
        """Distance (m) of `points`, shape (n, 3), from the cone, shape (n,)."""
        assert self.cone_zr is not None
        (z0, r0), (z1, r1) = self.cone_zr
        radius, _, z = cylinder(points)
        return ((radius - r0) * (z1 - z0) - (z - z0) * (r1 - r0)) / np.hypot(z1 - z0, r1 - r0)

    def describe(self) -> str:
        """The rule in words."""
        parts = [f"{name} {bound.replace('_', ' ')} {value:g} m" for name, bound, value in self.limits]
        if self.cone_zr is not None:
            parts.append("the cone through (z, r) = ({:g}, {:g}) and ({:g}, {:g}) m".format(*self.cone_zr[0], *self.cone_zr[1]))
        parts += ["a plane of planes_m"] * bool(self.planes)
        named = ["the set " + " and ".join(map(repr, self.sets))] if self.sets else []
        rules = [f"the rule '{' and '.join(parts)}, to {self.tolerance:g} m'"] if parts else []
        return " and ".join(named + rules) + "".join(f" without '{name}'" for name in self.without)

    def as_yaml(self) -> str:
        """The rule of planes or of a cone as an entry of blades.yaml has it."""
        key = "planes_m" if self.planes else "cone_zr_m"
        return f"{{ {key}: {self.points_as_yaml()}, tolerance_m: {_plain(self.tolerance)} }}"

    def points_as_yaml(self) -> str:
        """The points (m) of planes or cone as an entry of blades.yaml has them."""
        points = [", ".join(map(_plain, point)) for point in self.planes or self.cone_zr or ()]
        return f"[[{'], ['.join(points)}]]"


@dataclass(frozen=True)
class CyclicFaces:
    """The disc that a mesh is one sector of: number of sectors, and the sets of the two faces that are cut."""

    sectors: Annotated[int, Key("Number of equal sectors of the disc", ge=3, le=400)]
    low: Annotated[str, Key("Set of one cut face; ? finds both")] = ASKED
    high: Annotated[str, Key("Set of the other cut face")] = ASKED


@dataclass(frozen=True)
class MeshSource(Definition):
    """Where a blade's mesh is and how to read it.

    `sense_check`: whether a tip that contradicts rotation or pressure side is refused; `digest`: hash of the files.
    """

    stages: ClassVar[Mapping[str, str]] = {"geometry": "", "mesh": "imported_mesh"}

    file: str
    orientation: Orientation
    root: Where
    tip: Where
    pressure_side_forward: Annotated[
        bool,
        Key(
            "forward: the pressure side faces the rotation, as in a compressor",
            name="pressure_side",
            words={"forward": True, "backward": False},
        ),
    ] = True
    revolution_tolerance: Annotated[
        float, Key("Largest distance of the tip from a surface of revolution", "_m", ge=1e-9, le=0.1)
    ] = 1e-4
    drop_free_nodes: Annotated[bool, Key("Whether nodes without a solid element are left out instead of refused")] = False
    minimum_scaled_jacobian: Annotated[
        float, Key("Smallest scaled Jacobian of an accepted mesh; 1 is ideal, 0 folded", ge=1e-6, le=1)
    ] = 0.02
    end_check: Annotated[bool, Key("Whether a root or tip that is incomplete or has side faces is refused")] = True
    hub_zr: Annotated[
        tuple[tuple[float, float], tuple[float, float]] | None,
        Key("two points [z, r] of the platform's top, where the span begins; left out: at the root", "_m", ge=-100, le=100),
    ] = None
    cyclic: CyclicFaces | None = None
    sense_check: bool = field(kw_only=True)
    digest: str = ""

    def files(self, root: Path) -> list[Path]:
        """The mesh file and those that it includes. Raises ImportRefused as `mesh_files`."""
        return mesh_files(self.file, root)

    def height(self, points: np.ndarray) -> np.ndarray | None:
        """Distance (m) of `points`, shape (n, 3), above the platform's top, shape (n,); None without a platform."""
        if self.hub_zr is None:
            return None
        return Where(cone_zr=self.hub_zr).off_cone(points) * np.sign(self.hub_zr[1][0] - self.hub_zr[0][0])


@dataclass(frozen=True)
class MatricesSource(Definition):
    """A directory of matrices, the axes of its boundary nodes, units of mass and stiffness, and a hash of the files.

    `sense_check`: whether a rotation that the nodes contradict is refused.
    """

    stages: ClassVar[Mapping[str, str]] = {"geometry": "", "mesh": "", "reduced_model": "imported_matrices"}

    folder: str
    orientation: Orientation
    mass_unit: Annotated[str, Key("Unit of M", one_of=MASS_UNITS)]
    stiffness_unit: Annotated[str, Key("Unit of the K_<speed>", one_of=STIFFNESS_UNITS)]
    sense_check: bool
    digest: str = ""

    def files(self, root: Path) -> list[Path]:
        """The files of the folder. Raises ImportRefused as `matrix_files`."""
        return list(matrix_files(self.folder, root).values())


def _plain(number: float) -> str:
    """Number without an exponent: some readers of YAML take 1e-05 for a text."""
    return np.format_float_positional(number, trim="-")


def _edge_nodes(what: str, name: str, mesh: RawMesh) -> np.ndarray:
    """The nodes of a set, whose name may differ in capitals.

    Where it has corners of elements alone, with the mid-nodes of edges between them.
    """
    found = [nodes for known, nodes in mesh.sets.items() if known.upper() == name.upper()]
    if not found:
        raise ImportRefused(f"{what}: found no set '{name}'")
    members, middle, between = np.zeros((3, len(mesh.points)), dtype=bool)
    members[found[-1]] = True
    for kind, nodes in mesh.blocks.items():
        for edge, middle_node in ELEMENTS[kind].edges.items():
            middle[nodes[:, middle_node]] = True
            between[nodes[members[nodes[:, list(edge)]].all(axis=1), middle_node]] = True
    if (members & middle).any() or not between.any():
        return members
    warn_of(
        f"{what}: the set '{name}' has corners of elements alone ({members.sum()} nodes); the {between.sum()} mid-nodes "
        "between them are taken too"
    )
    return members | between
