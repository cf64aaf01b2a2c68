"""The files of one blade's structure, each made by its step of the workflow when it is asked for, and kept."""

from __future__ import annotations

import os
import tempfile
import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import r37core
from r37core.config import BladeSettings, ConfigError, Settings, plain, si_fields
from r37core.exchange.importing.source import MatricesSource, MeshSource
from r37core.io import Named, room_for, scratch_folder
from r37core.kept import kept_file, users_cache
from r37core.plain import to_plain
from r37core.plans.code import CodeHashes
from r37core.plans.import_plan import Imported
from r37core.plans.provenance import Attributes
from r37core.plans.samples import NOMINAL, Pair, Sample, Samples
from r37core.plans.structure_plan import Structure

from .jobs import run_step
from .stages import LOGGER

_STAGES = {
    "blade.steps.geometry": "shape",
    "exchange.importing.steps.imported_matrices": "import of the matrices",
    "exchange.importing.steps.imported_mesh": "import of the mesh",
    "fem.steps.mesh": "mesh",
    "results.steps.campbell_of_blade": "Campbell diagram",
    "rom.steps.contact_model": "contact model",
    "rom.steps.reduced_model": "matrices and reduced model, the longest stage",
    "stress.steps.stress_operator": "stress operator",
}
"""What a step is called while it works."""


_MAKING = threading.RLock()
"""Held by the thread that makes structures: gmsh, and what reads meshes of others, serve one at a time."""


@dataclass(frozen=True)
class Recipe:
    """How a file of the cache is made: by a step of the workflow, from files with recipes of their own, and parameters."""

    blade: str
    step: str
    name: str
    inputs: Mapping[str, Recipe]
    params: Mapping[str, Any]

    @cached_property
    def made_of(self) -> list[Any]:
        """What its content follows from, as plain values; Attributes do not count."""
        counting = {key: value for key, value in self.params.items() if not isinstance(value, Attributes)}
        return to_plain([_code(self.step), [part.made_of for part in self.inputs.values()], counting])

    def file(self) -> Path:
        """The file, from the cache or made now, which may take minutes. Raises what making it raises."""
        folder = cache_folder()
        with _MAKING, room_for(folder / self.name):
            return kept_file(self.name, self.made_of, self._make, folder)

    def _make(self, file: Path) -> None:
        files = {key: part.file() for key, part in self.inputs.items()}
        LOGGER.info("%s: %s", self.blade, _STAGES[self.step])
        with scratch_folder() as aside:
            # a mesh is also written for Gmsh
            output = {file.stem: file, file.suffix[1:]: file, "msh": aside / "mesh.msh"}
            params = {**self.params, "code": _code(self.step), "provenance": Attributes()}
            shown = run_step(self.step, files, output, params)
        if shown:
            LOGGER.info("%s: %s", self.blade, shown)


@dataclass(frozen=True)
class StructureFiles:
    """Recipes of the structure of the blade `name` in `settings`, or of a `member` of a sample `beside` (see Samples)."""

    settings: Settings
    name: str
    beside: Mapping[str, Mapping[Pair, Sample]] = field(default_factory=dict)
    member: str = NOMINAL

    def reduced_model(self, tip_line: str) -> Recipe:
        """The reduced model (.nc) with contact nodes on this line."""
        structure, wildcards = self._structure, self._wildcards(tip_line=tip_line)
        common = {"reduction": structure.reduction(wildcards), "contact": structure.location_of_contact(wildcards)}
        if isinstance(self._blade.definition, MatricesSource):
            return Recipe(self._label, "exchange.importing.steps.imported_matrices", "rom.nc", {}, {**self._source(), **common})
        material, before = structure.elastic(wildcards), Attributes(file=None)
        params = {"material": material, "made_before": before, **common}
        return Recipe(self._label, "rom.steps.reduced_model", "rom.nc", {"mesh": self._mesh()}, params)

    def contact_model(self, tip_line: str) -> Recipe:
        """What a simulation starts from (.npz)."""
        inputs = {"rom": self.reduced_model(tip_line)}
        return Recipe(self._label, "rom.steps.contact_model", "contact.npz", inputs, {"tip_line": tip_line})

    def stress_operator(self, tip_line: str) -> Recipe:
        """The stress per motion of a blade with a mesh (.npz)."""
        inputs, material = {"rom": self.reduced_model(tip_line)}, self._structure.elastic(self._wildcards())
        return Recipe(self._label, "stress.steps.stress_operator", "stress.npz", inputs, {"material": material})

    def campbell(self) -> Recipe:
        """The Campbell diagram (.nc), without provenance."""
        structure = self.settings.structure
        params = {
            "campbell": si_fields(self.settings.config.campbell),
            "maximum_speed": structure.maximum_speed_rad_s,
            "tip_line": structure.boundary.tip_line,
        }
        inputs = {"rom": self.reduced_model(structure.boundary.tip_line)}
        return Recipe(self._label, "results.steps.campbell_of_blade", "campbell.nc", inputs, params)

    def geometry(self) -> Recipe:
        """The shape of a blade with profiles (.nc)."""
        # a member whose shape is the nominal one has its mesh, as in the workflow
        nominal = self._blade.definition == self.settings.blades[self.name].definition
        wildcards = Named(blade=self.name, member=NOMINAL if nominal else self.member)
        params = {"definition": self._structure.definition(wildcards), "edges": self.settings.structure.edges}
        return Recipe(self._label, "blade.steps.geometry", "geometry.nc", {}, params)

    def _mesh(self) -> Recipe:
        if isinstance(self._blade.definition, MeshSource):
            return Recipe(self._label, "exchange.importing.steps.imported_mesh", "mesh.vtu", {}, self._source())
        params = {"mesh": plain(self.settings.fidelity.mesh)}
        return Recipe(self._label, "fem.steps.mesh", "mesh.vtu", {"geometry": self.geometry()}, params)

    @property
    def _label(self) -> str:
        return ", ".join(part for part in (self.name, self.member.rstrip("/")) if part)

    @property
    def _blade(self) -> BladeSettings:
        return Samples(self.settings, self.beside).blade(self._wildcards())

    @property
    def _structure(self) -> Structure:
        return Structure(self.settings, self.beside)

    def _source(self) -> dict[str, Any]:
        """Parameters of an import."""
        imported, wildcards = Imported(self.settings), self._wildcards()
        return {"source": imported.source(wildcards), "folder": imported.folder, "locations": imported.locations(wildcards)}

    def _wildcards(self, **more: str) -> Named:
        return Named(blade=self.name, member=self.member, **more)


def cache_folder() -> Path:
    """The folder that R37_CACHE names, else `r37` of XDG_CACHE_HOME, else ~/.cache/r37. ConfigError if it cannot be written."""
    named = os.environ.get("R37_CACHE")
    folder = Path(named) if named else users_cache()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        refusal = f"R37_CACHE: found the cache folder {folder}, which cannot be written ({error.strerror})"
        raise ConfigError(f"{refusal}; allowed: a folder that can") from None
    return folder


_LIBRARIES = ("gmsh", "h5py", "meshio", "numpy", "scipy")
"""Those that the numbers of a structure come from."""


@cache
def _code(step: str) -> list[str]:
    """Hash of the code of a step, and versions of libraries: others make other files, and environments share the cache."""
    source = Path(r37core.__file__).parent.parent
    return [CodeHashes(source, source)(f"{r37core.__name__}.{step}"), *map(_version, _LIBRARIES)]


def _version(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        # installed by another way than pip's
        return ""
