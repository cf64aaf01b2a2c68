"""Settings of a call: its blades and scenes, with other keys of config.yaml."""

from __future__ import annotations

import inspect
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from pathlib import Path
from typing import Any, TypedDict

from r37core.config import ConfigError, Document, Settings, command_line_document
from r37core.config.cross_checks import history_speeds_are_run
from r37core.config.messages import single_line
from r37core.config.remarks import remarks_at_end, remarks_on_input
from r37core.product.extensions import EXTENSIONS, READER

from .arguments import finite
from .call_configuration import Configuration, read_configuration
from .choices import BladeChoice, Choice, SceneChoice

_SPEEDS = ("speeds", "speeds_rpm", "speeds_for")

_JUDGING = "requirements"
"""Extension whose section judges results of any call, as `interactions` of the pipeline does."""

_OF_A_RUN = ("run", *_SPEEDS, *(extension.name for extension in EXTENSIONS if extension.name != _JUDGING))
"""Sections of config.yaml that say what a run of the workflow makes, and nothing of a single simulation."""

_READER = replace(READER, checks=tuple(check for check in READER.checks if check is not history_speeds_are_run))
"""A call names its speeds: of those with a stress history it has the ones that it runs."""


class OneOptions(TypedDict, total=False):
    """Options of every call of one blade in a scene, as of `r37.simulate`."""

    fidelity: str | None
    results: Sequence[str] | None
    config: Path | str | None


@dataclass(frozen=True)
class Call:
    """Blades of one file in scenes of one file, with `keys` of config.yaml on top of `base`; `name`: of the call, for messages.

    Without blades or scenes those of `base` are taken. `whole`: what `base` says of a run counts, too, but for its section run.
    """

    name: str
    base: Configuration
    blades: Sequence[BladeChoice]
    scenes: Sequence[SceneChoice]
    keys: Mapping[str, Any]
    whole: bool = False

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
        changes = {"blades_above": above(self.blades), "scenes_above": above(self.scenes)}
        return _READER.load_settings(document, Configuration(document).root, **changes)

    @property
    def told(self) -> dict[str, str]:
        """Attributes of a dataset with the changes of blades and scenes."""
        return {name: text for choice in (*self.blades, *self.scenes) for name, text in choice.told.items()}

    def tell_remarks(self) -> None:
        """Warn of what the settings may not mean."""
        changed = [scene.name for scene in self.scenes if scene.changes_clearance]
        tell([*remarks_on_input(self.settings, changed), *remarks_at_end(self.settings)])


def chosen_blade(blade: BladeChoice | str, config: Path | str | None) -> BladeChoice:
    """The blade, of the configuration `config` where it is a name. Raises ConfigError."""
    if not isinstance(blade, BladeChoice | str):
        raise ConfigError(f"blade: found {blade!r}; allowed: the name of a blade, or what r37.blade gives")
    chosen = blade if isinstance(blade, BladeChoice) else BladeChoice(blade, {}, read_configuration(config))
    chosen.check()
    return chosen


def chosen_scene(scene: SceneChoice | str, base: Configuration, results: Sequence[str] | None = None) -> SceneChoice:
    """The scene, of the configuration `base` where it is a name, with other `results` if there are any. Raises ConfigError."""
    if not isinstance(scene, SceneChoice | str):
        raise ConfigError(f"scene: found {scene!r}; allowed: the name of a scene, or what r37.scene gives")
    chosen = scene if isinstance(scene, SceneChoice) else SceneChoice(scene, {}, base)
    if isinstance(results, str):
        raise ConfigError(f'results: found "{results}"; allowed: a list, as in results=["{results}"]')
    if results is not None:
        if not isinstance(results, Iterable):
            raise ConfigError(f"results: found {results!r}; allowed: a list of names")
        # results are no change of the scene
        chosen = replace(chosen, results=tuple(finite(results, "results")))
    chosen.check()
    return chosen


def base_of(blades: Sequence[BladeChoice], config: Path | str | None) -> Configuration:
    """The configuration of structure and levels: `config`, else that of the blades."""
    return blades[0].configuration if blades and config is None else read_configuration(config)


def call_of(
    caller: str,
    blades: Iterable[BladeChoice | str],
    scenes: Iterable[SceneChoice | str],
    keys: Mapping[str, Any],
    options: Mapping[str, Any],
    *,
    named: bool = False,
    whole: bool = False,
) -> Call:
    """The call of these blades in these scenes, whose names stand in tables if `named`; `options` as of OneOptions.

    Raises ConfigError.
    """
    config, fidelity = options.get("config"), options.get("fidelity")
    chosen = [chosen_blade(blade, config) for blade in blades]
    base = base_of(chosen, config)
    rubs_on = [chosen_scene(scene, base, options.get("results")) for scene in scenes]
    for choices in (chosen, rubs_on) if named else ():
        names_of_their_own(choices)
    return Call(caller, base, chosen, rubs_on, {**keys, **({} if fidelity is None else {"fidelity": fidelity})}, whole)


def several(value: Any, kind: type[Choice]) -> list[Any]:
    """One blade or scene, or several of them, as a list. Raises ConfigError for others and for none."""
    name = kind.kind
    if isinstance(value, kind | str):
        return [value]
    if isinstance(value, bytes | type) or not isinstance(value, Iterable):
        allowed = f"the name of a {name}, or what r37.{name} gives, or a list of them"
        raise ConfigError(f"{name}s: found {single_line(repr(value))}; allowed: {allowed}")
    choices = finite(value, f"{name}s")
    if not choices:
        raise ConfigError(f"{name}s: found none; allowed: at least one")
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


def above(choices: Sequence[Choice]) -> Document | None:
    """The changes of some entries as one document."""
    documents = [choice.above for choice in choices if choice.above]
    return reduce(Document.overlaid, documents) if documents else None


_PACKAGE = str(Path(__file__).parent) + os.sep


def tell(remarks: Iterable[str]) -> None:
    """Warn whoever has called r37: each remark points at the innermost line outside this package."""
    level, frame = 1, inspect.currentframe()
    while frame and frame.f_code.co_filename.startswith(_PACKAGE):
        level, frame = level + 1, frame.f_back
    for remark in remarks:
        warnings.warn(remark, stacklevel=level)
