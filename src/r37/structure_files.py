"""The files of one blade's structure, each made by its stage of the workflow when it is asked for, and kept."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import r37core
from r37core.base.io import Named, room_for, scratch_folder
from r37core.base.plain import to_plain
from r37core.config import ConfigError, Settings
from r37core.exchange.importing.source import MatricesSource, MeshSource
from r37core.machine_code.kept import kept_file, named_folder, numerics, writable_folder
from r37core.plans.code import CodeHashes
from r37core.plans.provenance import Attributes, Provenance
from r37core.plans.samples import NOMINAL
from r37core.plans.stages import Stage, structure_stages
from r37core.plans.structure_plan import Structure

from .jobs import parallel_results, run_step
from .stages import LOGGER

_FILES = {
    "geometry": "geometry.nc",
    "mesh": "mesh.vtu",
    "reduced_model": "rom.nc",
    "contact_model": "contact.npz",
    "stress_operator": "stress.npz",
    "campbell_of_blade": "campbell.nc",
}
"""Stage -> name of the file that others read, also of what a blade of another program has in its place."""

_IMPORTED = {MeshSource: {"mesh": "imported_mesh"}, MatricesSource: {"reduced_model": "imported_matrices"}}
"""Stages of a blade of another program in place of others."""

_MAKING = threading.RLock()
"""Held by the thread that makes structures: gmsh, and what reads meshes of others, serve one at a time."""


@dataclass(frozen=True)
class Recipe:
    """How a file of the cache is made: by a stage, from files with recipes of their own, and parameters.

    `blade`: for messages; `name`: of the file.
    """

    blade: str
    stage: Stage
    name: str
    inputs: Mapping[str, Recipe]
    params: Mapping[str, Any]

    @cached_property
    def made_of(self) -> list[Any]:
        """Parameters that determine the content of the file, as plain values; Attributes do not count."""
        counting = {key: value for key, value in self.params.items() if not isinstance(value, Attributes)}
        return to_plain([_code(self.stage.step), [part.made_of for part in self.inputs.values()], counting])

    def file(self) -> Path:
        """The file, from the cache or made now, which may take minutes. Raises what making it raises."""
        folder = cache_folder()
        with _MAKING, room_for(folder / self.name):
            return kept_file(self.name, self.made_of, self._make, folder)

    def _make(self, file: Path) -> None:
        files = {key: part.file() for key, part in self.inputs.items()}
        LOGGER.info("%s: %s", self.blade, self.stage.title)
        with scratch_folder() as aside:
            # a mesh is also written for Gmsh
            output = {file.stem: file, file.suffix[1:]: file, "msh": aside / "mesh.msh"}
            # what a file of the cache says of its making is said by whom it is read for
            params = {**self.params, "code": _code(self.stage.step), "provenance": Attributes()}
            shown = run_step(self.stage.step, files, output, params)
        if shown:
            LOGGER.info("%s: %s", self.blade, shown)


def recipe(settings: Settings, blade: str, stage: str, tip_line: str | None = None) -> Recipe:
    """The recipe of the file of a stage, by the name of its rule; contact nodes lie on `tip_line`, else as config.yaml says."""
    wildcards = Named(blade=blade, member=NOMINAL, tip_line=tip_line or settings.structure.boundary.tip_line)
    stages = structure_stages(Structure(settings), Provenance(settings))
    imported = _IMPORTED.get(type(settings.blades[blade].definition), {})

    def of(stage: str) -> Recipe:
        name = imported.get(stage, stage)
        inputs = {key: of(other) for key, other in stages[name].reads.items()}
        return Recipe(blade, stages[name], _FILES[stage], inputs, stages[name].values(wildcards))

    return of(stage)


def structure_file(settings: Settings, blade: str, stage: str, tip_line: str | None = None) -> Path:
    """The file of a recipe, with the numbers that one thread of linear algebra gives. Raises what making it raises."""
    (file,) = parallel_results([recipe(settings, blade, stage, tip_line).file], 1)
    return file


def cache_folder() -> Path:
    """The user's cache folder. ConfigError if it cannot be written."""
    try:
        return writable_folder()
    except OSError as error:
        refusal = f"R37_CACHE: found the cache folder {named_folder()}, which cannot be written ({error.strerror})"
        raise ConfigError(f"{refusal}; allowed: a folder that can") from None


@cache
def _code(step: str) -> list[str]:
    """Hash of the code of a step, and what its numbers come from: others make other files, and environments share the cache."""
    source = Path(r37core.__file__).parent.parent
    return [CodeHashes(source, source)(f"{r37core.__name__}.{step}"), *numerics("gmsh", "h5py", "meshio", "numpy", "scipy")]
