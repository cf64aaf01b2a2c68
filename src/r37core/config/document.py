"""A configuration file's content, several on top of each other, where each value stands, and bases of entries."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import reduce
from pathlib import Path
from typing import Any, Self, TypeVar

import numpy as np
from pydantic import BaseModel, ValidationError

from r37core.base.io import TextFileError
from r37core.base.yaml_file import KeyPath, load_yaml_with_lines, scalar

from .messages import did_you_mean, explain_all, single_line
from .section import Without
from .varied import FAMILY_KEYS

Model = TypeVar("Model", bound=BaseModel)
Result = TypeVar("Result")

_MOST_LINES = 20
"""Largest number of lines of a message with several refusals."""


class ConfigError(ValueError):
    """Error in a configuration or an argument: file, line, key, value found and values allowed, one line for each error."""


class ConfigRefusals:
    """Refusals of a configuration, from checks that do not wait for each other: all are reported at once."""

    def __init__(self, *lines: str) -> None:
        self._lines = dict.fromkeys(lines)

    def of(self, check: Callable[..., Result], *arguments: Any) -> Result | None:
        """Result of a check; None where it refuses, which it may do for the reason of one before it."""
        try:
            return check(*arguments)
        except ConfigError as error:
            self._lines |= dict.fromkeys(str(error).splitlines())
            return None

    def tell(self) -> None:
        """ConfigError with all of them, each once and not too many, if there are any."""
        if self._lines:
            lines, more = list(self._lines)[:_MOST_LINES], len(self._lines) - _MOST_LINES
            raise ConfigError("\n".join([*lines, *([f"and {more} more"] if more > 0 else [])]))


@dataclass(frozen=True)
class Document:
    """Content of a file. `name`: of the file, for messages; `locations`: file and line of the values, as `file:line`.

    `sources`: entry -> the one that gives what stands nowhere in it: its base, or the family of a design.
    """

    name: str
    content: Any
    locations: Mapping[KeyPath, str] = field(default_factory=dict)
    sources: Mapping[Any, str] = field(default_factory=dict)

    def location(self, path: KeyPath) -> str:
        """File and line of a value, of what holds it if it is not given, or the file alone."""
        place = self._place(path)
        return self.locations.get(place, self.name) if place or not path else self.name

    def _place(self, path: KeyPath) -> KeyPath:
        """Path with a line that the value at `path` is from, or what holds it: of its entry or of the source of that."""
        own: KeyPath = next((path[:length] for length in range(len(path), 0, -1) if path[:length] in self.locations), ())
        source = self.sources.get(path[0]) if path else None
        other = () if source is None else self._place((source, *path[1:]))
        return other if len(other) > len(own) else own

    def error(self, path: KeyPath, text: str, key: KeyPath | None = None) -> ConfigError:
        """The error of the value at `path`: place, key (where that is not the whole path) and `text`."""
        named, place = path if key is None else key, self._place(path)
        shown = ".".join(single_line(str(step)) for step in named) or "top level"
        source = f" (given by '{place[0]}')" if place[:1] not in ((), path[:1]) else ""
        return ConfigError(f"{self.location(path)}: {shown}: {text}{source}")

    @contextmanager
    def blamed(self, path: KeyPath, *errors: type[Exception], before: str = "") -> Iterator[None]:
        """Turn one of these errors within into that of the value at `path`, with the text `before` its own."""
        try:
            yield
        except errors as error:
            raise self.error(path, f"{before}{error}") from None

    def refusal(self, value: str, allowed: str, *path: str | int) -> ConfigError:
        """The error of the value at `path`, with what was found and what is allowed."""
        return self.error(path, f"found {value}; allowed: {allowed}")

    def known(self, path: KeyPath, names: Iterable[str], entries: Iterable[str], file: Self) -> None:
        """ConfigError for a name, at `path` of this document, that is none of the `entries` of `file`."""
        allowed = list(entries)
        for name in names:
            if name not in allowed:
                meant = did_you_mean(name, allowed)
                raise self.refusal(f"'{name}'", f"{', '.join(allowed)} ({file.name}){meant}", *path)

    def check(self, model: type[Model]) -> Model:
        """The content as a model; ConfigError for all that the model does not allow, in a base for the base alone."""
        try:
            return model.model_validate(self.content)
        except ValidationError as error:
            explained = explain_all(error, self.content, model, self._starts_from_another)
        texts, lines = {path: text for path, _, text in explained}, []
        for path, key, text in explained:
            place = (*self._place(path)[:1], *path[1:])
            # after the reason of the base there may be a remedy
            if place == path or not text.startswith(texts.get(place, "no reason")):
                lines.append(str(self.error(path, text, key)))
        ConfigRefusals(*lines).tell()
        raise AssertionError("a model refuses for a reason")

    def _starts_from_another(self, path: KeyPath) -> bool:
        """True if the entry at the beginning of a path has a base, or changes of a call on top of the file."""
        return path[0] in self.sources or self.location(path[:1]).startswith(("r37.blade(", "r37.scene("))

    def overlaid(self, above: Self) -> Self:
        """Document with the values of another one on top: mappings are joined, all else is replaced."""
        locations = dict(self.locations)
        content = _overlay(self.content, above.content, (), locations)
        return replace(self, content=content, locations=locations | dict(above.locations), sources={})


def read_document(root: Path, name: str) -> Document:
    """The YAML file `name`, relative to the folder `root`; ConfigError where it cannot be read."""
    try:
        content, lines = load_yaml_with_lines(root / name)
    except TextFileError as error:
        raise ConfigError(f"{name}:{error.line}: {error.reason}") from None
    except FileNotFoundError:
        remedy = "check the keys ..._file in config.yaml; `r37 init FOLDER` writes a folder that has all files"
        raise ConfigError(f"{name}: there is no such file in {root}; {remedy}") from None
    except OSError as error:
        raise ConfigError(f"{name}: cannot be read: {error.strerror}") from None
    return Document(name, content, {path: f"{name}:{line}" for path, line in lines.items()})


def command_line_document(values: Mapping[str, Any], name: str = "--config") -> Document:
    """Values of a command line, where Snakemake hands numbers inside lists on as texts, or of a call, which may have NumPy's.

    Raises ConfigError for a key that no file can have.
    """
    locations: dict[KeyPath, str] = {}
    return Document(name, _converted_texts(dict(values), name, (), locations), locations)


def _converted_texts(value: Any, name: str, path: KeyPath, locations: dict[KeyPath, str]) -> Any:
    """A value and all in it with texts and keys as a file has them; puts the paths of its keys into `locations`."""
    if isinstance(value, Mapping):
        content: dict[str, Any] = {}
        for key, inner in value.items():
            if not isinstance(key, str) and type(key) is not int:
                raise ConfigError(f"{name}: found the key {single_line(repr(key))}; allowed: a name or a whole number")
            # a table by numbers, as a file has it
            if str(key) in content:
                raise ConfigError(f"{name}: found the key {single_line(str(key))} twice, as a number and a text; allowed: one")
            locations[inner_path := (*path, str(key))] = name
            content[str(key)] = _converted_texts(inner, name, inner_path, locations)
        return content
    if isinstance(value, list | tuple):
        # of what is in a list the list has the place
        return [_converted_texts(inner, name, (), {}) for inner in value]
    if isinstance(value, np.generic):
        return value.item()
    return scalar(value) if isinstance(value, str) else value


def joined(below: Any, above: Any) -> Any:
    """One content on top of another: mappings are joined, all else is replaced."""
    return _overlay(below, above, (), {})


def _overlay(below: Any, above: Any, path: KeyPath, locations: dict[KeyPath, str]) -> Any:
    if not (isinstance(below, Mapping) and isinstance(above, Mapping)):
        for inside in [known for known in locations if known[: len(path)] == path]:
            del locations[inside]
        return above
    joined = dict(below)
    for key, value in above.items():
        if value is Without.KEY and key in joined:
            del joined[key]
        else:
            joined[key] = _overlay(below[key], value, (*path, key), locations) if key in below else value
    return joined


def chain_of_bases(
    name: str, base_of: Callable[[str], str | None], known: Collection[str], document: Document, kind: str
) -> list[str]:
    """Names from the entry without a base down to `name`.

    Raises ConfigError for a base that is none of the `known` entries of the document, and for bases in a circle.
    """
    chain = [name]
    while (base := base_of(chain[0])) is not None:
        if base not in known or base in chain:
            circle = chain if base in chain else []
            others = [single_line(entry) for entry in known if entry not in (chain[0], *circle)]
            hint = ", in no circle of bases" if circle else did_you_mean(base, others)
            raise document.refusal(
                f"'{base}'", f"another {kind} of this file, no family ({', '.join(others)}){hint}", chain[0], "base"
            )
        chain.insert(0, base)
    return chain


def completed(document: Document, above: Document | None, kind: str, keys: Collection[str]) -> tuple[Document, ConfigRefusals]:
    """Entries of a `kind`, those with one of the `keys` with what they leave out from their base, key by key also in sections.

    A key that is null is left out although the base has it. `above`: changes of some entries, which others that start from them
    do not have. An entry whose base is not there, or in a circle, is left out and refused.
    """
    changed, refusals = document.overlaid(above) if above else document, ConfigRefusals()
    below, entries = entries_of(document), entries_of(changed)
    bases_below, bases = _bases(below), _bases({name: entry for name, entry in entries.items() if entry.keys() & set(keys)})
    known = [name for name, entry in below.items() if not entry.keys() & set(FAMILY_KEYS)]
    content, sources = dict(changed.content) if bases else changed.content, {}
    for name, base in bases.items():
        chain = refusals.of(chain_of_bases, name, {**bases_below, name: base}.get, known, changed, kind)
        if chain is None:
            del content[name]
        else:
            content[name] = reduce(joined, map(_own_keys, [*(below[link] for link in chain[:-1]), entries[name]]))
            sources[name] = base
    return replace(changed, content=content, sources=sources), refusals


def entries_of(document: Document) -> dict[str, Mapping[str, Any]]:
    """Entries of a file as far as they are mappings."""
    every = document.content.items() if isinstance(document.content, Mapping) else ()
    return {name: entry for name, entry in every if isinstance(entry, Mapping)}


def _bases(entries: Mapping[str, Mapping[str, Any]]) -> dict[str, str]:
    return {name: entry["base"] for name, entry in entries.items() if isinstance(entry.get("base"), str)}


def _own_keys(entry: Mapping[str, Any]) -> Any:
    """The keys that an entry has itself: on top of a base, null leaves a key out."""
    return _without_nulls({key: value for key, value in entry.items() if key != "base"}) if "base" in entry else entry


def _without_nulls(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _without_nulls(inner) for key, inner in value.items()}
    return Without.KEY if value is None else value
