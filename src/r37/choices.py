"""A blade and a scene of a configuration, as they stand there or with values changed by the caller."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from r37core.config import BladeSettings, ConfigError, Document, SceneEntry, command_line_document, read_document
from r37core.config.blades import Blades, blade_settings
from r37core.config.families import Designs, with_designs, with_value
from r37core.config.scenes import Scenes

from .call_configuration import Configuration, existing_file, read_configuration


@dataclass(frozen=True)
class BladeChoice:
    """A blade by its `name`, with the `changes` (dotted key -> value) to its entry in blades.yaml."""

    name: str
    changes: Mapping[str, Any]
    configuration: Configuration = field(repr=False)

    @property
    def above(self) -> Document | None:
        """The changes as a document that lies on top of blades.yaml."""
        return _above("blade", self.name, self.changes)

    @cached_property
    def settings(self) -> BladeSettings:
        """Shape and material, in the SI. Raises ConfigError."""
        document = _changed("blade", self.configuration.checked.blades_file, self.name, self.above)
        root = self.configuration.root
        designs = _designs(document, root)
        if self.name not in designs.entries:
            raise _unknown("blade", self.name, designs.entries, document.name)
        return blade_settings(self.name, designs.entries, root, designs.document)


@dataclass(frozen=True)
class SceneChoice:
    """A scene by its `name`, with the `changes` (dotted key -> value) to its entry in scenes.yaml."""

    name: str
    changes: Mapping[str, Any]
    configuration: Configuration = field(repr=False)

    @property
    def above(self) -> Document | None:
        """The changes as a document that lies on top of scenes.yaml."""
        return _above("scene", self.name, self.changes)

    @cached_property
    def entry(self) -> SceneEntry:
        """The scene's keys, in the units of their names. Raises ConfigError."""
        document = _changed("scene", self.configuration.checked.scenes_file, self.name, self.above)
        entries = document.check(Scenes).root
        if self.name not in entries:
            raise _unknown("scene", self.name, entries, document.name)
        return entries[self.name]


def blades(*, file: Path | str | None = None, config: Path | str | None = None) -> list[str]:
    """Names of the blades, designs of families included: shipped ones, one's own (`config`), or of a blades.yaml (`file`).

    Raises ConfigError for files that cannot be read, or are no blades.
    """
    chosen = _configuration("blades_file", file, config)
    blades_file = Path(chosen.checked.blades_file)
    return list(_designs(read_document(blades_file.parent, str(blades_file)), chosen.root).entries)


def blade(name: str, *, file: Path | str | None = None, config: Path | str | None = None, **changes: Any) -> BladeChoice:
    """A blade of the shipped configuration, of one's own (`config`), or of one's own blades.yaml (`file`).

    `changes`: values of keys of its entry, in the units of their names, as `**{"material.density_kg_m3": 4430.0}`. Raises
    ConfigError for an unknown name, an impossible value or shape, and files that cannot be read.
    """
    chosen = BladeChoice(name, changes, _configuration("blades_file", file, config))
    _ = chosen.settings
    return chosen


def scene(name: str, *, file: Path | str | None = None, config: Path | str | None = None, **changes: Any) -> SceneChoice:
    """A scene of the shipped configuration, of one's own (`config`), or of one's own scenes.yaml (`file`).

    `changes`: values of keys of its entry, in the units of their names, as `**{"friction.coefficient": 0.1}`. Raises
    ConfigError for an unknown name, an impossible value, and files that cannot be read.
    """
    chosen = SceneChoice(name, changes, _configuration("scenes_file", file, config))
    _ = chosen.entry
    return chosen


def _configuration(key: str, file: Path | str | None, config: Path | str | None) -> Configuration:
    configuration = read_configuration(config)
    if file is None:
        return configuration
    return configuration.with_file(key, existing_file("file", file, "a file that is there"))


def _designs(document: Document, root: Path) -> Designs:
    return with_designs(document.check(Blades).root, root, document)


def _above(function: str, name: str, changes: Mapping[str, Any]) -> Document | None:
    if not changes:
        return None
    content: dict[str, Any] = {}
    for key, value in changes.items():
        content = with_value(content, key.split("."), value)
    return command_line_document({name: content}, f'r37.{function}("{name}")')


def _changed(kind: str, file: str, name: str, above: Document | None) -> Document:
    """The file with the changes to what it has under a name; ConfigError where it does not have that."""
    document = read_document(Path(file).parent, file)
    if above is None:
        return document
    if not isinstance(document.content, Mapping) or name not in document.content:
        raise _unknown(f"changed {kind}", name, document.content or (), document.name)
    return document.overlaid(above)


def _unknown(kind: str, name: str, known: Iterable[str], file: str) -> ConfigError:
    return ConfigError(f"{kind}: found '{name}'; allowed: {', '.join(known)} ({file})")
