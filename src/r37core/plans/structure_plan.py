"""The plan of the structure: what the rules from shape, or import, to Campbell diagram compute with."""

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from r37core.base.plain import to_plain
from r37core.config import Settings
from r37core.config.settings import location_of_contact

from .paths import WHOLE_BLADE_MODEL
from .provenance import Attributes, shape_hash, structure_provenance

STAGES = ("geometry", "mesh", "reduced_model")
"""Stages that a blade of another kind may have others in place of."""


@dataclass(frozen=True)
class Structure:
    """Inputs and numbers of the rules from shape, or import, to Campbell diagram: a part of the plan of a Sweep.

    Methods with `wildcards` are inputs and parameters of rules.
    """

    settings: Settings

    def definition(self, wildcards: Any) -> Any:
        """Shape of a blade, or the mesh or matrices to import."""
        return to_plain(self.settings.blades[wildcards.blade].definition)

    def material(self, wildcards: Any) -> dict[str, float] | None:
        """Material of a blade; None for one of matrices."""
        return to_plain(self.settings.blades[wildcards.blade].material)

    def disc(self, wildcards: Any) -> dict[str, float] | None:
        """Disc under a blade; None of one that is clamped."""
        return to_plain(self.settings.blades[wildcards.blade].disc)

    def elastic(self, wildcards: Any) -> dict[str, float]:
        """Material of a blade with a mesh, without its strengths."""
        return to_plain(self.settings.blades[wildcards.blade].elastic.material)

    def location_of_contact(self, wildcards: Any) -> Attributes:
        """Where stands what a blade's contact acts on; another line re-runs nothing."""
        return Attributes(location=location_of_contact(self.settings, wildcards.blade))

    def boundary(self, wildcards: Any) -> dict[str, Any]:
        """Contact nodes of the reduced model, on the line of the wildcard, or as config.yaml has them."""
        return to_plain(self.settings.boundary_choice(wildcards.blade, getattr(wildcards, "tip_line", None)))

    def reduction(self, wildcards: Any) -> dict[str, Any]:
        """Reduction of a blade."""
        return to_plain(self.settings.reduction_choice(wildcards.blade))

    def whole_blade_model(self, wildcards: Any) -> str:
        """The model that recovers the whole blade, with the contact nodes of a scene, or else those of config.yaml."""
        scene = getattr(wildcards, "scene", None)
        tip_line = self.settings.scenes[scene].tip_line if scene else self.settings.structure.boundary.tip_line
        return WHOLE_BLADE_MODEL.format(blade=wildcards.blade, tip_line=tip_line)

    def made_by(self, rule: str) -> list[str]:
        """Names of the blades that a rule of the structure makes a file of, such as `mesh` or `imported_mesh`."""
        blades = self.settings.blades.items()
        return [name for name, blade in blades if rule in (blade.definition.stages.get(stage, stage) for stage in STAGES)]

    @property
    def meshed_blades(self) -> list[str]:
        """Blades that have a mesh, ours or another program's."""
        return [name for name, blade in self.settings.blades.items() if not blade.is_matrices]

    def pattern(self, rule: str) -> str:
        """Pattern of the blades that a rule is for, for its wildcard; it fits nothing without any."""
        return "|".join(map(re.escape, self.made_by(rule))) or "(?!)"

    def files(self, wildcards: Any) -> list[str]:
        """Files that a blade is imported from, as seen from the current folder where that is possible."""
        files = self.settings.blades[wildcards.blade].definition.files(self.settings.root)
        return [_seen_from_here(file) for file in files]

    def locations(self, wildcards: Any) -> Attributes:
        """Where the keys of a blade stand, as `file:line: blade.key`; a new line re-runs nothing."""
        return Attributes(self.settings.designs.locations_of_keys(wildcards.blade))

    def shape_provenance(self, wildcards: Any) -> Attributes:
        """Attributes of a blade's geometry."""
        return Attributes(blade=wildcards.blade, input_hash=shape_hash(self.settings, wildcards.blade))

    def structure_provenance(self, wildcards: Any) -> Attributes:
        """Attributes of a blade's mesh, reduced model and Campbell diagram."""
        return self.settings.made(structure_provenance, wildcards.blade)

    @property
    def folder(self) -> Attributes:
        """The folder that file names start from; another place of the project re-runs nothing."""
        return Attributes(folder=str(self.settings.root))


def _seen_from_here(file: Path) -> str:
    absolute, here = Path(os.path.abspath(file)), Path.cwd()
    return str(absolute.relative_to(here)) if absolute.is_relative_to(here) else str(absolute)
