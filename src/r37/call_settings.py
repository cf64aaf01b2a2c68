"""Settings of a call: its blades and scenes, with other keys of config.yaml."""

from __future__ import annotations

import contextlib
import inspect
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from pathlib import Path
from typing import Any, TypeVar

from r37core.config import ConfigError, Document, Settings, command_line_document
from r37core.config.messages import single_line
from r37core.config.remarks import remarks_at_end, remarks_on_input
from r37core.product.extensions import EXTENSIONS, READER

from .call_configuration import Configuration, read_configuration
from .choices import BladeChoice, Choice, SceneChoice, scenes_named

_SPEEDS = ("speeds", "speeds_rpm", "speeds_for")

_JUDGING = "requirements"
"""Extension whose section judges results of any call, as `interactions` of the pipeline does."""

_OF_A_RUN = ("run", *_SPEEDS, *(extension.name for extension in EXTENSIONS if extension.name != _JUDGING))
"""Sections of config.yaml that say what a run of the workflow makes, and nothing of a single simulation."""

C = TypeVar("C", bound=Choice)


@dataclass(frozen=True)
class Call:
    """Blades of one file in scenes of one file, with `keys` of config.yaml on top of `base`; `name`: of the call, for messages.

    Without blades or scenes those of `base` are taken. `results`: in place of the scenes' own, which is no change of a scene.
    `whole`: what `base` says of a run counts, too, but for its section run.
    """

    name: str
    base: Configuration
    blades: Sequence[BladeChoice]
    scenes: Sequence[SceneChoice]
    keys: Mapping[str, Any]
    results: Sequence[str] | None
    whole: bool

    @cached_property
    def settings(self) -> Settings:
        """Checked settings; a message names the call as its place. Raises ConfigError."""
        keys, below = dict(self.keys), self.base.document
        for kind, choices in (("blades", self.blades), ("scenes", self.scenes)):
            if choices:
                keys |= {kind: [choice.name for choice in choices], f"{kind}_file": _one_file(kind, choices)}
        left_out = {"run", *(_SPEEDS if keys.keys() & set(_SPEEDS) else ())} if self.whole else set(_OF_A_RUN)
        content = {key: value for key, value in below.content.items() if key not in left_out}
        locations = {path: line for path, line in below.locations.items() if not path or path[0] not in left_out}
        document = replace(below, content=content, locations=locations).overlaid(command_line_document(keys, self.name))
        asked = {} if self.results is None else {scene.name: {"results": self.results} for scene in self.scenes}
        scenes = above(self.scenes, command_line_document(asked, self.name))
        root = Configuration(document).root
        return READER.load_settings(document, root, blades_above=above(self.blades), scenes_above=scenes)

    @property
    def told(self) -> dict[str, str]:
        """Attributes of a dataset with the changes of blades and scenes."""
        return {name: text for choice in (*self.blades, *self.scenes) for name, text in choice.told.items()}

    def tell_remarks(self) -> None:
        """Warn of what the settings may not mean."""
        changed = [scene.name for scene in self.scenes if scene.changes_clearance]
        tell([*remarks_on_input(self.settings, changed), *remarks_at_end(self.settings)])


def call_of(
    caller: str,
    blades: Iterable[BladeChoice | str] | None,
    scenes: Iterable[SceneChoice | str] | None,
    keys: Mapping[str, Any],
    *,
    config: Path | str | None,
    fidelity: str | None,
    results: Sequence[str] | None = None,
    whole: bool = False,
) -> Call:
    """The call of these blades in these scenes, of the configuration `config` where they are names, or of all that it runs.

    `whole`: of a run, in whose tables their names stand; else of a blade in a scene, neither of which is a family. Raises
    ConfigError.
    """
    if isinstance(results, str) or not isinstance(results, Iterable | None):
        raise ConfigError(f'results: found {single_line(repr(results))}; allowed: a list of names, as in results=["stress"]')
    base = read_configuration(config)
    blade_choices = [chosen(BladeChoice, blade, base) for blade in blades or ()]
    if blade_choices and config is None:
        base = blade_choices[0].configuration
    if scenes is None and results is not None:
        # results are a key of each scene
        scenes = scenes_named(base)
    scene_choices = [chosen(SceneChoice, scene, base) for scene in scenes or ()]
    for choices in (blade_choices, scene_choices):
        if whole:
            names_of_their_own(choices)
        elif families := [choice for choice in choices if choice.is_family]:
            kind, design = families[0].kind, next(iter(families[0].designs.families[families[0].name]))
            raise ConfigError(f"{kind}: found the family {families[0].name}; allowed: a {kind}, such as {design}")
    level = {} if fidelity is None else {"fidelity": fidelity}
    asked = None if results is None else [*results]
    return Call(caller, base, blade_choices, scene_choices, {**keys, **level}, asked, whole)


def chosen(kind: type[C], choice: C | str, base: Configuration) -> C:
    """The blade or scene, of the configuration `base` where it is a name, checked. Raises ConfigError."""
    if not isinstance(choice, kind | str):
        name = kind.kind
        raise ConfigError(f"{name}: found {single_line(repr(choice))}; allowed: the name of a {name}, or what r37.{name} gives")
    entry = kind(choice, {}, base) if isinstance(choice, str) else choice
    entry.check()
    return entry


def several(value: Any, kind: type[Choice]) -> list[Any] | None:
    """One blade or scene, or several of them, as a list; None as it is. Raises ConfigError for an empty list."""
    if value is None:
        return None
    choices = [value] if isinstance(value, kind | str) or not isinstance(value, Iterable) else list(value)
    if not choices:
        raise ConfigError(f"{kind.kind}s: found none; allowed: at least one")
    return choices


def names_of_their_own(choices: Sequence[Choice]) -> None:
    """ConfigError for changed entries without a name where names stand in tables, and for two of one name."""
    names: set[str] = set()
    for choice in choices:
        if (choice.changes and not choice.base) or choice.name in names:
            example = f'r37.{choice.kind}("{choice.base or choice.name}", ..., name="Mine")'
            raise ConfigError(f"{choice.kind}s: found {choice.label}; allowed: names that differ, as of {example}")
        names.add(choice.name)


def _one_file(key: str, choices: Sequence[Choice]) -> str:
    files = list(dict.fromkeys(choice.file for choice in choices))
    if len(files) > 1:
        together = (
            f'write them into one: r37 init <folder> gives the shipped ones in config/; then file="<folder>/config/{key}.yaml"'
        )
        raise ConfigError(f"{key}: found {' and '.join(files)}; allowed: {key} of one file; {together}")
    return files[0]


def above(choices: Sequence[Choice], *others: Document) -> Document | None:
    """The changes of some entries, and `others` on top, as one document."""
    documents = [choice.above for choice in choices if choice.above] + [other for other in others if other.content]
    return reduce(Document.overlaid, documents) if documents else None


_OWN_FILES = (str(Path(__file__).parent) + os.sep, contextlib.__file__)
"""Beginnings of the names of files that a call runs through: this package, and the decorator of its calls."""


def tell(remarks: Iterable[str]) -> None:
    """Warn whoever has called r37: each remark points at the innermost line outside this package."""
    level, frame = 1, inspect.currentframe()
    while frame and frame.f_code.co_filename.startswith(_OWN_FILES):
        level, frame = level + 1, frame.f_back
    for remark in remarks:
        warnings.warn(remark, stacklevel=level)
