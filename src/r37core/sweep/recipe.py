"""Files of one blade's structure, each made by its stage when it is asked for, and kept under all that it is made of."""

from __future__ import annotations

import logging
import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import r37core
from r37core.base.io import Named, function_named, room_for, scratch_folder
from r37core.base.plain import to_plain
from r37core.base.process_wide import one_thread
from r37core.config import Settings
from r37core.machine_code.kept import kept_file, numerics
from r37core.plans.code import CodeHashes
from r37core.plans.provenance import Attributes
from r37core.plans.stages import structure_stages
from r37core.plans.sweep_plan import Sweep

LOGGER = logging.getLogger("r37")
"""Logger of what a call or a job does now."""

STRUCTURES = ".structures"
"""Folder of such files next to the members and designs that they are for."""

_FILES = {
    "geometry": "geometry.nc",
    "mesh": "mesh.vtu",
    "reduced_model": "rom.nc",
    "contact_model": "contact.npz",
    "stress_operator": "stress.npz",
    "campbell_of_blade": "campbell.nc",
}
"""Stage -> name of the file that others read, also of what a blade of another program has in its place."""

_MAKING = threading.RLock()
"""Held by the thread that makes structures: gmsh, and what reads meshes of others, serve one at a time."""


@dataclass(frozen=True)
class Recipe:
    """Recipe of a file: the `step` that makes it, from files with recipes of their own, with plain `params`.

    `blade`, `title`: what is made, for messages; `name`: of the file; `modules`: those that the step imports by name.
    """

    blade: str
    step: str
    title: str
    name: str
    modules: tuple[str, ...] = ()
    inputs: Mapping[str, Recipe] = field(default_factory=dict)
    params: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def made_of(self) -> list[Any]:
        """All that the content of the file follows from, as plain values."""
        return to_plain([code_of(self.step, *self.modules), [part.made_of for part in self.inputs.values()], self.params])

    def file(self, folder: Path, attributes: Mapping[str, Any]) -> Path:
        """The file in the folder, made now where it is missing, which may take minutes. Raises what making it raises.

        `attributes`: as of `structure_attributes`.
        """
        with _MAKING, room_for(folder / self.name):
            return kept_file(self.name, self.made_of, lambda file: self._make(file, folder, attributes), folder)

    def _make(self, file: Path, folder: Path, attributes: Mapping[str, Any]) -> None:
        files = {key: part.file(folder, attributes) for key, part in self.inputs.items()}
        LOGGER.info("%s: %s", self.blade, self.title)
        # SciPy has a library of its own, which simulations do not load
        with one_thread(), scratch_folder() as aside:
            # a mesh is also written for Gmsh
            output = {file.stem: file, file.suffix[1:]: file, "msh": aside / "mesh.msh"}
            # what a file says of its making is said by whom it is read for
            params = {**self.params, **attributes, "code": code_of(self.step, *self.modules), "provenance": Attributes()}
            shown = run_step(self.step, files, output, params)
        if shown:
            LOGGER.info("%s: %s", self.blade, shown)


def recipes(settings: Settings, blade: str, tip_lines: Mapping[str, str | None], *, kept: bool = True) -> dict[str, Recipe]:
    """Recipes of the files of stages, by the names of their rules, each with contact nodes on a line of the tip.

    Without a line that of config.yaml counts. `kept`: whether the user's cache has a copy of the reduced model.
    """
    stages = structure_stages(Sweep(settings))
    others = settings.blades[blade].definition.stages

    @cache
    def stage_recipe(stage: str, tip_line: str) -> Recipe:
        made = stages[others.get(stage, stage)]
        inputs = {key: stage_recipe(other, tip_line) for key, other in made.reads.items()}
        params = made.values(Named(blade=blade, tip_line=tip_line))
        values = {key: value for key, value in params.items() if not isinstance(value, Attributes)}
        values |= {"kept": kept} if "kept" in values else {}
        return Recipe(blade, made.step, made.title, _FILES[stage], tuple(made.modules), inputs, to_plain(values))

    return {stage: stage_recipe(stage, line or settings.structure.boundary.tip_line) for stage, line in tip_lines.items()}


def structure_attributes(settings: Settings, blade: str) -> Attributes:
    """Parameters of the stages of a blade's structure that are for messages: where its keys stand, and its files."""
    structure, wildcards = Sweep(settings), Named(blade=blade)
    contact, locations = structure.location_of_contact(wildcards), structure.locations(wildcards)
    return Attributes(contact=contact, locations=locations, folder=structure.folder)


def run_step(step: str, input: Mapping[str, Any], output: Mapping[str, Any], params: Mapping[str, Any]) -> Any:
    """Do a step, named as `r37core.fem.steps.mesh`, whose module is imported now. Gives and raises what it does."""
    return function_named(step)(Named(**input), Named(**output), Named(**params))


@cache
def code_of(step: str, *modules: str) -> list[str]:
    """Hash of the code of a step, and what its numbers come from: others make other files, and environments share folders."""
    source = Path(r37core.__file__).parent.parent
    return [CodeHashes(source, source)(step, *modules), *numerics("gmsh", "h5py", "meshio", "numpy", "scipy")]
