"""The plan for blades of other programs: which there are, from which files, and where their keys stand."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from r37core.blade.definition import BladeDefinition
from r37core.config import Settings
from r37core.exchange.importing.source import MatricesSource, MeshSource, matrix_files, mesh_files
from r37core.plain import to_plain

from .provenance import Attributes


@dataclass(frozen=True)
class Imported:
    """Blades by what gives them; methods with `wildcards` are inputs and parameters of rules."""

    settings: Settings

    def given_by(self, *kinds: type) -> list[str]:
        """Names of the blades that are given in one of these ways."""
        return [name for name, blade in self.settings.blades.items() if isinstance(blade.definition, kinds)]

    @property
    def with_mesh(self) -> list[str]:
        """Blades that have a mesh, ours or another program's."""
        return self.given_by(BladeDefinition, MeshSource)

    @property
    def profiles(self) -> str:
        """Pattern of the blades given by profiles, for a rule's wildcard."""
        return _pattern(self.given_by(BladeDefinition))

    @property
    def meshes(self) -> str:
        """Pattern of the blades given by a mesh."""
        return _pattern(self.given_by(MeshSource))

    @property
    def matrices(self) -> str:
        """Pattern of the blades given by matrices."""
        return _pattern(self.given_by(MatricesSource))

    def files(self, wildcards: Any) -> list[str]:
        """What a blade is imported from, as seen from the current folder where that is possible."""
        source = self.settings.blades[wildcards.blade].definition
        if isinstance(source, MeshSource):
            files = mesh_files(source.file, self.settings.root)
        else:
            assert isinstance(source, MatricesSource)
            files = list(matrix_files(source.folder, self.settings.root).values())
        return [_seen_from_here(file) for file in files]

    def source(self, wildcards: Any) -> Any:
        """What to import."""
        return to_plain(self.settings.blades[wildcards.blade].definition)

    def locations(self, wildcards: Any) -> Attributes:
        """Where the keys of a blade stand, as `file:line: blade.key`; a new line re-runs nothing."""
        return Attributes(self.settings.designs.locations_of_keys(wildcards.blade))

    @property
    def folder(self) -> Attributes:
        """The folder that file names start from; another place of the project re-runs nothing."""
        return Attributes(folder=str(self.settings.root))


def _pattern(names: Iterable[str]) -> str:
    """One of these names; never anything where there are none."""
    return "|".join(map(re.escape, names)) or "(?!)"


def _seen_from_here(file: Path) -> str:
    absolute, here = Path(os.path.abspath(file)), Path.cwd()
    return str(absolute.relative_to(here)) if absolute.is_relative_to(here) else str(absolute)
