"""The files of one blade's structure, each made by its step of the workflow when it is asked for, and kept."""

from __future__ import annotations

import contextlib
import io
import os
import tempfile
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import r37core
from r37core.config import ConfigError, Settings, plain, si_fields
from r37core.exchange.importing.source import MatricesSource, MeshSource
from r37core.io import Named, room_for, scratch_folder
from r37core.kept import kept_file, users_cache
from r37core.plain import to_plain
from r37core.plans.code import CodeHashes
from r37core.plans.import_plan import Imported
from r37core.plans.provenance import Attributes
from r37core.plans.structure_plan import Structure


@dataclass(frozen=True)
class _Made:
    """A file of the cache, and what its content follows from."""

    file: Path
    made_of: object


@dataclass(frozen=True)
class StructureFiles:
    """The structure of the blade `name` in `settings`. Methods give files; the first call of one may take minutes."""

    settings: Settings
    name: str

    def reduced_model(self, tip_line: str) -> Path:
        """The reduced model (.nc) with contact nodes on this line. Raises what making it raises."""
        return self._reduced(tip_line).file

    def contact_model(self, tip_line: str) -> Path:
        """What a simulation starts from (.npz). Raises what making it raises."""
        return _made("rom.steps.contact_model", "contact.npz", {"rom": self._reduced(tip_line)}, tip_line=tip_line).file

    def stress_operator(self, tip_line: str) -> Path:
        """The stress per motion of a blade with a mesh (.npz). Raises what making it raises."""
        material = Structure(self.settings).elastic(self._wildcards())
        return _made("stress.steps.stress_operator", "stress.npz", {"rom": self._reduced(tip_line)}, material=material).file

    def campbell(self) -> Path:
        """The Campbell diagram (.nc), without provenance. Raises what making it raises."""
        structure = self.settings.structure
        return _made(
            "results.steps.campbell_of_blade",
            "campbell.nc",
            {"rom": self._reduced(structure.boundary.tip_line)},
            campbell=si_fields(self.settings.config.campbell),
            maximum_speed=structure.maximum_speed_rad_s,
            tip_line=structure.boundary.tip_line,
        ).file

    def _reduced(self, tip_line: str) -> _Made:
        structure, wildcards = Structure(self.settings), self._wildcards(tip_line=tip_line)
        common = {"reduction": structure.reduction(wildcards), "contact": structure.location_of_contact(wildcards)}
        if isinstance(self.settings.blades[self.name].definition, MatricesSource):
            return _made("exchange.importing.steps.imported_matrices", "rom.nc", {}, **self._source(), **common)
        material, before, inputs = structure.elastic(wildcards), Attributes(file=None), {"mesh": self._mesh()}
        return _made("rom.steps.reduced_model", "rom.nc", inputs, material=material, made_before=before, **common)

    def _mesh(self) -> _Made:
        definition, name = self.settings.blades[self.name].definition, "mesh.vtu"
        if isinstance(definition, MeshSource):
            return _made("exchange.importing.steps.imported_mesh", name, {}, **self._source())
        shape, edges = to_plain(definition), self.settings.structure.edges
        geometry = _made("blade.steps.geometry", "geometry.nc", {}, definition=shape, edges=edges)
        return _made("fem.steps.mesh", name, {"geometry": geometry}, mesh=plain(self.settings.fidelity.mesh))

    def _source(self) -> dict[str, Any]:
        """Parameters of an import."""
        imported, wildcards = Imported(self.settings), self._wildcards()
        return {"source": imported.source(wildcards), "folder": imported.folder, "locations": imported.locations(wildcards)}

    def _wildcards(self, **more: str) -> Named:
        return Named(blade=self.name, **more)


def _made(step: str, name: str, inputs: dict[str, _Made], **params: Any) -> _Made:
    """The file called `name` that a step makes, from the cache or made now; of `params` Attributes do not count."""
    counting = {key: value for key, value in params.items() if not isinstance(value, Attributes)}
    made_of = to_plain([_code(step), [part.made_of for part in inputs.values()], counting])

    def make(file: Path) -> None:
        module, function = f"{r37core.__name__}.{step}".rsplit(".", 1)
        files = Named(**{key: part.file for key, part in inputs.items()})
        with scratch_folder() as aside, contextlib.redirect_stdout(io.StringIO()):
            # a mesh is also written for Gmsh
            output = Named(**{file.stem: file, file.suffix[1:]: file, "msh": aside / "mesh.msh"})
            values = Named(**params, code=_code(step), provenance=Attributes())
            # imported here: it brings gmsh and VTK, which take seconds to load and are not needed for what is kept
            getattr(import_module(module), function)(files, output, values)

    folder = cache_folder()
    with room_for(folder / name):
        return _Made(kept_file(name, made_of, make, folder), made_of)


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
