"""The files of one blade's structure, each made when it is asked for, and kept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from r37core.blade.definition import BladeDefinition
from r37core.config import Settings, plain, si_fields
from r37core.exchange.importing.source import MatricesSource, MeshSource
from r37core.plain import to_plain
from r37core.plans.code import CodeHashes
from r37core.rom.reduction_choice import ReductionChoice, boundary_placed

from .structure_cache import cached_file

_HERE = Path(__file__).parent


@dataclass(frozen=True)
class StructureFiles:
    """The structure of the blade `name` in `settings`. Methods give files; the first call of one may take minutes."""

    settings: Settings
    name: str

    def reduced_model(self, tip_line: str) -> Path:
        """The reduced model (.nc) with contact nodes on this line. Raises what making it raises."""
        return self._reduced(tip_line)[0]

    def contact_model(self, tip_line: str) -> Path:
        """What a simulation starts from (.npz). Raises what making it raises."""
        rom, made_of = self._reduced(tip_line)
        return _made("contact.npz", [made_of, tip_line], lambda file: _steps().contact(file, rom, tip_line))

    def stress_operator(self, tip_line: str) -> Path:
        """The stress per motion of a blade with a mesh (.npz). Raises what making it raises."""
        rom, made_of = self._reduced(tip_line)
        elastic = self.settings.blades[self.name].elastic.material
        assert elastic is not None
        return _made("stress.npz", made_of, lambda file: _steps().stress(file, rom, elastic))

    def campbell(self) -> Path:
        """The Campbell diagram (.nc), without provenance. Raises what making it raises."""
        structure = self.settings.structure
        line, highest = structure.boundary.tip_line, structure.maximum_speed_rad_s
        rom, made_of = self._reduced(line)
        numbers = si_fields(self.settings.campbell)
        return _made(
            "campbell.nc",
            [made_of, highest, line, numbers],
            lambda file: _steps().campbell(file, rom, highest, line, numbers),
        )

    def _reduced(self, tip_line: str) -> tuple[Path, object]:
        """The reduced model, and what it is made of."""
        with boundary_placed(self.settings.place_of_contact(self.name)):
            return self._made_of(tip_line)

    def _made_of(self, tip_line: str) -> tuple[Path, object]:
        blade = self.settings.blades[self.name]
        choice = self.settings.reduction_choice(self.name, tip_line)
        if isinstance(blade.definition, MatricesSource):
            return self._from_matrices(blade.definition, choice)
        elastic = blade.elastic.material
        assert elastic is not None
        mesh, mesh_made_of = self._mesh(blade.definition)
        made_of = to_plain([mesh_made_of, elastic, choice])
        return _made("rom.nc", made_of, lambda file: _steps().reduced_model(file, mesh, elastic, choice)), made_of

    def _from_matrices(self, source: MatricesSource, choice: ReductionChoice) -> tuple[Path, object]:
        made_of = to_plain([source, choice])
        root, places = self.settings.root, self.settings.places[self.name]
        return _made("rom.nc", made_of, lambda file: _steps().imported_matrices(file, source, choice, root, places)), made_of

    def _mesh(self, definition: BladeDefinition | MeshSource) -> tuple[Path, object]:
        """The mesh (.vtu), and what it is made of."""
        if isinstance(definition, MeshSource):
            source, root, places = definition, self.settings.root, self.settings.places[self.name]
            made_of = to_plain(source)
            return _made("mesh.vtu", made_of, lambda file: _steps().imported_mesh(file, source, root, places)), made_of
        shape, edges, level = definition, self.settings.structure.edges, plain(self.settings.fidelity.mesh)
        made_of = to_plain([shape, edges, level])

        def make(file: Path) -> None:
            geometry = _made("geometry.nc", [shape, edges], lambda built: _steps().geometry(built, shape, edges))
            _steps().mesh(file, geometry, level)

        return _made("mesh.vtu", made_of, make), made_of


def _steps() -> Any:
    """The module of the steps. It brings gmsh and VTK, which take seconds to load and are not needed for what is kept."""
    return import_module("r37.structure_steps")


def _made(name: str, made_of: object, make: Callable[[Path], None]) -> Path:
    return cached_file(name, [_code(), made_of], make)


_LIBRARIES = ("gmsh", "h5py", "meshio", "numpy", "scipy")
"""Those that the numbers of a structure come from."""


@cache
def _code() -> list[str]:
    """Hash of the code of the steps, and versions of libraries: others make other files, and environments share the cache."""
    return [CodeHashes(_HERE.parent, _HERE, packages=("r37", "r37core"))("structure_steps"), *map(_version, _LIBRARIES)]


def _version(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        # installed by another way than pip's
        return ""
