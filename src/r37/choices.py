"""A blade and a scene of a configuration, as they stand there or with values changed by the caller."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from r37core.base.varied_number import with_value
from r37core.config import BladeSettings, ConfigError, Document, command_line_document, read_document
from r37core.config.blades import blade_settings
from r37core.config.families import Designs
from r37core.config.messages import did_you_mean, single_line
from r37core.config.reading import designs_of_file
from r37core.config.scenes import SceneEntry
from r37core.config.section import Without
from r37core.config.shape_keys import SECTION_KEYS, SHARES

from .arguments import plain_value
from .call_configuration import Configuration, read_configuration
from .stages import stages


@dataclass(frozen=True)
class Choice:
    """An entry of a file by its `name`, with `changes` (dotted key -> value), under a name of its own if it has a `base`."""

    name: str
    changes: Mapping[str, Any]
    configuration: Configuration = field(repr=False)
    base: str | None = None

    kind: ClassVar[str]

    @cached_property
    def designs(self) -> Designs[Any]:
        """All entries of the file with the changes on top, designs of families included. Raises ConfigError."""
        return designs_of_file(self.kind, self.configuration.root, self.file, self.above)

    @property
    def is_family(self) -> bool:
        """True for a family of designs: no blade or scene by itself. Raises ConfigError."""
        return self.name in self.designs.families

    @property
    def label(self) -> str:
        """Name in figures and attributes: with the changes, unless these have a name."""
        unnamed = {} if self.base else self.changes
        return ", ".join([self.name, *(single_line(f"{key}={plain_value(value)}") for key, value in unnamed.items())])

    @property
    def told(self) -> dict[str, str]:
        """Attributes of a dataset with the changes of the entry; empty without any."""
        if not self.changes and not self.base:
            return {}
        base = {"base": self.base} if self.base else {}
        changes = json.dumps({**base, **{key: plain_value(value) for key, value in self.changes.items()}}, default=str)
        return {self.kind: self.label, f"{self.kind}_changes": changes}

    @property
    def file(self) -> str:
        """Name of the file with the entry."""
        return getattr(self.configuration.checked, f"{self.kind}s_file")

    @cached_property
    def above(self) -> Document | None:
        """The changes as a document that lies on top of the file. Raises ConfigError."""
        if not self.changes and not self.base:
            return None
        original, file = self.base or self.name, read_document(Path(self.file).parent, self.file)
        place, entries = f'r37.{self.kind}("{original}")', file.content if isinstance(file.content, Mapping) else {}
        if original not in entries:
            raise _unknown(f"changed {self.kind}", original, entries, file.name)
        content: dict[str, Any] = {}
        for key, value in self.changes.items():
            content = with_value(content, key, self._left_out(entries[original]) if value is None else plain_value(value))
        changed = command_line_document({self.name: content}, place)
        if self.base is None:
            return changed
        if self.name in entries:
            raise ConfigError(f"{place}: name: found '{self.name}', which {file.name} has; allowed: another name")
        content = self._copied(entries[original], original)
        return command_line_document({self.name: content}, f"{file.name}: {original}").overlaid(changed)

    def _copied(self, entry: Any, original: str) -> Any:
        """The content of an entry under another name."""
        return entry

    def _left_out(self, entry: Any) -> Any:
        """Value that leaves a key of an entry out."""
        return Without.KEY

    def check(self) -> None:
        """Raises ConfigError for what the entry cannot be."""
        if self.name not in self.designs.names:
            raise _unknown(self.kind, self.name, self.designs.names, self.file)


@dataclass(frozen=True)
class BladeChoice(Choice):
    """A blade, the result of `r37.blade`: its `name`, and the `changes` (dotted key -> value) to its entry in blades.yaml.

    `base`: name of the entry, where the changed blade has another name.
    """

    kind: ClassVar[str] = "blade"

    @cached_property
    def settings(self) -> BladeSettings:
        """Shape and material of the blade, which is no family, in SI units. Raises ConfigError."""
        return blade_settings(self.name, self.designs.entries, self.configuration.root, self.designs.document)

    def check(self) -> None:
        """Raises ConfigError for what the entry cannot be."""
        super().check()
        for name in self.designs.named([self.name]):
            blade_settings(name, self.designs.entries, self.configuration.root, self.designs.document)

    def _copied(self, entry: Any, original: str) -> Any:
        if not isinstance(entry, Mapping) or "stacking_table" not in entry:
            return entry
        # the table has its row under the original name
        vary = self.changes.get("vary")
        varied = {key.split(".")[0] for key in (*self.changes, *(vary if isinstance(vary, Mapping) else ()))}
        for key in (*SHARES, *SECTION_KEYS):
            if key in varied and key in entry:
                has = "whose table has a share already" if key in SHARES else "which has a value of it already"
                shared = f"{key} of a copy of {original}, {has}"
                raise ConfigError(f"name: found {shared}; allowed: the changed blade without a name")
        return {"base": original}


@dataclass(frozen=True)
class SceneChoice(Choice):
    """A scene, the result of `r37.scene`: its `name`, and the `changes` (dotted key -> value) to its entry in scenes.yaml.

    `base`: name of the entry, where the changed scene has another name.
    """

    kind: ClassVar[str] = "scene"

    def _left_out(self, entry: Any) -> Any:
        # what the base has is not there any more, either
        has_base = isinstance(entry, Mapping) and {**entry, **self.changes}.get("base") is not None
        return None if has_base else Without.KEY

    @property
    def entry(self) -> SceneEntry:
        """Keys of the scene, which is no family, in the units of their names. Raises ConfigError."""
        return self.designs.entries[self.name]

    @property
    def changes_clearance(self) -> bool:
        """True where the changes give the scene another clearance than its file does."""
        if not self.changes or self.is_family:
            return False
        with contextlib.suppress(ConfigError):
            original = designs_of_file(self.kind, self.configuration.root, self.file).entries.get(self.base or self.name)
            return original is not None and original.casing.cold_clearance != self.entry.casing.cold_clearance
        return False


C = TypeVar("C", bound=Choice)


@stages()
def blades(*, file: Path | str | None = None, config: Path | str | None = None) -> list[str]:
    """Names of the blades in blades.yaml, designs of families included.

    Args:
        file: A blades.yaml in place of the configuration's.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.

    Returns:
        The names, in the order of the file.

    Raises:
        ConfigError: For files that cannot be read, or have no blades.

    Examples:
        >>> r37.blades()
        ['Ref', 'L50', 'L100', 'S50', 'S100', 'CS50', 'CS100']
    """
    chosen = read_configuration(config).changed_file("blades_file", file)
    return list(designs_of_file(BladeChoice.kind, chosen.root, chosen.checked.blades_file).entries)


@stages()
def scenes(*, file: Path | str | None = None, config: Path | str | None = None) -> list[str]:
    """Names of the scenes in scenes.yaml: what a blade may rub on.

    Args:
        file: A scenes.yaml in place of the configuration's.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.

    Returns:
        The names, in the order of the file.

    Raises:
        ConfigError: For files that cannot be read, or have no scenes.

    Examples:
        >>> r37.scenes()[:2]
        ['abradable', 'direct']
    """
    return _scenes_in(read_configuration(config).changed_file("scenes_file", file))


@stages()
def blade(
    name_of_entry: str,
    /,
    *,
    # a type checker holds the value of `**{"lining.thickness_m": 0.003}` against these, too
    name: str | Any = None,
    file: Path | str | Any = None,
    config: Path | str | Any = None,
    **changes: Any,
) -> BladeChoice:
    """A blade of blades.yaml, as it is there or with changed values.

    Args:
        name_of_entry: Name of the blade in the file.
        name: Name of the changed blade in results and figures. By default its changes name it.
        file: A blades.yaml in place of the configuration's.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.
        **changes: Values of keys of the entry, in the units of their names. A dot leads into a section, as in
            `**{"material.density_kg_m3": 4430.0}`. A law over the span may also be a dictionary, or a list of its rows.
            None leaves a key out. With `vary={"sweep_percent": [50, 100]}`, or with a DataFrame as `designs`, it is a
            family of designs, for `r37.run`.

    Returns:
        The blade, for all calls that take one. Nothing is meshed or simulated yet.

    Raises:
        ConfigError: For an unknown name, an impossible value or shape, and files that cannot be read.

    Examples:
        >>> swept = r37.blade("Ref", chordwise_sweep_deg=8)
        >>> swept.label
        'Ref, chordwise_sweep_deg=8'
        >>> r37.blade("Ref", chordwise_sweep_deg=8, name="Swept").label
        'Swept'
        >>> r37.blade("Ref", stagger_deg={"hub": 0, "tip": 2}, thickness_percent=105, name="Turned").label
        'Turned'
    """
    return _chosen(BladeChoice, name_of_entry, name, changes, read_configuration(config).changed_file("blades_file", file))


@stages()
def scene(
    name_of_entry: str,
    /,
    *,
    name: str | Any = None,
    file: Path | str | Any = None,
    config: Path | str | Any = None,
    **changes: Any,
) -> SceneChoice:
    """A scene of scenes.yaml, as it is there or with changed values.

    Args:
        name_of_entry, name, file, config, **changes: As of `r37.blade`, of a scenes.yaml. `lining=None` leaves the
            abradable lining out, also that of a `base`: the casing is bare. Scenes that have this one as their base stay as
            they are. `vary={"casing.clearance_m": [4e-4, 7e-4]}` is a family of scenes.

    Returns:
        The scene, for all calls that take one.

    Raises:
        ConfigError: For an unknown name, an impossible value, and files that cannot be read.

    Examples:
        >>> r37.scene("abradable", **{"friction.coefficient": 0.1}).entry.friction.coefficient
        0.1
    """
    return _chosen(SceneChoice, name_of_entry, name, changes, read_configuration(config).changed_file("scenes_file", file))


def scenes_named(configuration: Configuration) -> list[str]:
    """Names of the scenes that a configuration runs. Raises ConfigError."""
    named = configuration.checked.scenes
    return _scenes_in(configuration) if named == "all" else list(named)


def _scenes_in(configuration: Configuration) -> list[str]:
    """Names of the scenes and families of scenes in the file of a configuration. Raises ConfigError."""
    return list(designs_of_file(SceneChoice.kind, configuration.root, configuration.checked.scenes_file).document.content)


def _chosen(kind: type[C], entry: str, name: str | None, changes: Mapping[str, Any], configuration: Configuration) -> C:
    """The choice, checked. Raises ConfigError, also for what is no name."""
    for key, value in (("name_of_entry", entry), ("name", name)):
        if not isinstance(value, str | None):
            raise ConfigError(f"{key}: found {single_line(repr(value))}; allowed: a name")
    chosen = kind(entry, changes, configuration) if name is None else kind(name, changes, configuration, entry)
    chosen.check()
    return chosen


def _unknown(kind: str, name: str, known: Iterable[str], file: str) -> ConfigError:
    names = list(known)
    return ConfigError(f"{kind}: found '{name}'; allowed: {', '.join(names)} ({file}){did_you_mean(str(name), names)}")
