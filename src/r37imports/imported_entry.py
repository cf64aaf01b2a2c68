"""Blades of other programs in blades.yaml: a mesh, or a directory of matrices."""

from itertools import product
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from r37core.blade.definition import Definition
from r37core.config.blade_kind import BladeKind
from r37core.config.blade_sections import (
    CONTACT_IN_WORDS,
    KINEMATICS_IN_WORDS,
    Contact,
    Kinematics,
    MaterialSection,
    RegionSection,
    refuse_taken_names,
)
from r37core.config.declaring import declared_by, section_of, si, si_form
from r37core.config.section import ByName, FileName, LeftOut, Name, Section, either, left_out, option, refused
from r37core.fem.orientation import Orientation
from r37imports.importing.files import digest_of, matrix_files, mesh_files
from r37imports.importing.source import CyclicFaces, MatricesSource, MeshSource, Where
from r37imports.refusal import ASKED

Length = Annotated[float, Field(ge=-100, le=100)] | LeftOut
Radius = Annotated[float, Field(ge=0, le=100)] | LeftOut


@declared_by(Where)
class SurfaceRule(Section):
    """All outer faces within limits; r is the distance from the rotor axis, x radial, z along the axis downstream."""

    r_at_least_m: Radius = left_out("Lower bound of the distance from the rotor axis")
    r_at_most_m: Radius = left_out("Upper bound of the distance from the rotor axis")
    x_at_least_m: Length = left_out("Lower bound of the radial coordinate")
    x_at_most_m: Length = left_out("Upper bound of the radial coordinate")
    z_at_least_m: Length = left_out("Lower bound of the axial coordinate")
    z_at_most_m: Length = left_out("Upper bound of the axial coordinate")

    def _check(self) -> None:
        if not (self._limits() or self.cone_zr_m or self.planes_m or self.sets):
            raise refused("a rule without limits", "a limit such as r_at_least_m, or cone_zr_m, planes_m or sets")
        if [0.0, 0.0, 0.0] in self.planes_m:
            raise refused("a plane through the origin", "planes that do not contain it", "planes_m")
        first, last = self.cone_zr_m or ([0.0, 0.0], [1.0, 0.0])
        if first == last:
            raise refused("one point twice", "two points [z, r]", "cone_zr_m")
        if min(first[1], last[1]) < 0.0:
            raise refused(f"{self.cone_zr_m}", "two points [z, r], with radii of 0 or more", "cone_zr_m")

    def _limits(self) -> tuple[tuple[str, str, float], ...]:
        names = product("rxz", ("at_least", "at_most"))
        limits = ((axis, bound, getattr(self, f"{axis}_{bound}_m")) for axis, bound in names)
        return tuple(limit for limit in limits if limit[-1] is not None)

    def where(self) -> Where:
        """The rule as the import takes it."""
        return si_form(Where, self, limits=self._limits())


SetOrRule: Any = either(FileName, SurfaceRule, rows=Annotated[list[FileName], Field(min_length=1)])


CyclicSection: Any = section_of(CyclicFaces, "The mesh is one sector of a disc, whose other sectors are carried.")

LengthUnit = Literal["m", "cm", "mm", "um", "in", "ft"] | Annotated[float, Field(ge=1e-9, le=1e3)]


@declared_by(Orientation)
class Oriented(BladeKind):
    """How a file of another program describes space."""

    base: Name | LeftOut = left_out("Blade that gives what is left out")
    length_unit: LengthUnit = option("Unit of the coordinates, or its length in metres")
    sense_check: bool = option("Whether a blade whose trailing edge leads, or whose pressure side is convex, is refused", True)

    def orientation(self) -> Orientation:
        """Unit and axes as the import takes them."""
        return si_form(Orientation, self)

    def definition(self, name: str, root: Path, check_sense: bool) -> Definition:
        """The source of `source`, with directions checked. Raises ImportRefused and OSError."""
        self.orientation().check()
        return self.source(root)

    def source(self, root: Path) -> Definition:
        """Source as the import takes it, with files from the folder `root`; ImportRefused where they are missing."""
        raise NotImplementedError


@declared_by(MeshSource)
class MeshEntry(Oriented):
    """A blade given by a mesh of solid elements."""

    key = "mesh"
    file_keys = ("mesh",)

    mesh: FileName = option("Mesh file: .inp, .msh, .vtu, .med, .bdf, .nas, or .cdb with the package meshlane")
    material: MaterialSection
    root: SetOrRule = option("Clamped nodes: sets of the file (BOUNDARY: those of *BOUNDARY) or a rule")
    tip: SetOrRule = option("Faces towards the casing: a set of the file or a rule")
    contact: Contact = option(CONTACT_IN_WORDS, "patches")
    kinematics: Kinematics = option(KINEMATICS_IN_WORDS, "quadratic")
    cyclic: CyclicSection | LeftOut = left_out("Disc that the mesh is a sector of; root is then its bore or flange")
    stress_regions: ByName[RegionSection] | LeftOut = left_out("Regions in place of, or beside, those of config.yaml")

    def _check(self) -> None:
        refuse_taken_names(self.stress_regions or ())
        if self.hub_zr_m is not None and self.hub_zr_m[0][0] == self.hub_zr_m[1][0]:
            raise refused("the same z twice", "two points [z, r] of different z", "hub_zr_m")
        if self.cyclic is not None and self.kinematics != "linear":
            raise refused(self.kinematics, "linear on a disc (large displacements are not computed there)", "kinematics")

    def source(self, root: Path) -> MeshSource:
        """Mesh to import, from the folder `root`; ImportRefused for a file that is not there or of another kind."""
        ends, digest = {"root": _where(self.root), "tip": _where(self.tip)}, digest_of(mesh_files(self.mesh, root))
        cyclic = None if self.cyclic is None else si(self.cyclic)
        source = si_form(MeshSource, self, file=self.mesh, orientation=self.orientation(), digest=digest, cyclic=cyclic, **ends)
        if ASKED in (self.root, self.tip):
            # answered before any job, in a dry run too; what reads meshes takes time to load
            from r37imports.importing.import_mesh import import_mesh

            import_mesh(source, root)
        return source


@declared_by(MatricesSource)
class MatricesEntry(Oriented):
    """A blade given by matrices, full or reduced; there is no stress without a mesh."""

    key = "matrices"
    file_keys = ("matrices",)
    has_material = False

    matrices: FileName = option("Folder with M and K_<speed> at three speeds (.mtx), and boundary.csv")
    contact: Literal["points", "patches"] = option(
        "Contact acts on the nodes of boundary.csv (points) or on patches of its complete tip line", "points"
    )
    kinematics: Literal["linear"] = option("Always: matrices say nothing of large displacements", "linear")

    def source(self, root: Path) -> MatricesSource:
        """Matrices to import, from the folder `root`; ImportRefused where files are missing."""
        digest = digest_of(matrix_files(self.matrices, root).values())
        return si_form(MatricesSource, self, folder=self.matrices, orientation=self.orientation(), digest=digest)


def _where(rule: Any) -> Where:
    if isinstance(rule, SurfaceRule):
        return rule.where()
    return Where((rule,) if isinstance(rule, str) else tuple(rule), tolerance=0.0)
