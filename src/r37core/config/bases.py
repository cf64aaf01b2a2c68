"""Bases of blades and scenes: entries of the same file that others start from."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import reduce
from typing import Any

from r37core.base.yaml_file import KeyPath

from .document import ConfigRefusals, Document
from .messages import did_you_mean, single_line
from .section import Without
from .varied import FAMILY_KEYS


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
            raise document.refusal((chain[0], "base"), f"'{base}'", f"another {kind} of this file ({', '.join(others)}){hint}")
        chain.insert(0, base)
    return chain


def with_bases(scenes: Document, above: Document | None = None) -> tuple[Document, ConfigRefusals]:
    """Scenes that are complete: what an entry leaves out is that of its base, key by key also inside sections.

    A key that is null is left out although the base has it. `above`: changes of some entries, which others that start from them
    do not have. An entry whose base is not there, or in a circle, is left out and refused.
    """
    changed = scenes.overlaid(above) if above else scenes
    below, entries = _entries(scenes), _entries(changed)
    bases = {name: base for name, entry in entries.items() if (base := _base(entry)) is not None}
    known = [name for name, entry in below.items() if not entry.content.keys() & set(FAMILY_KEYS)]
    bases_below = {name: _base(entry) for name, entry in below.items()}
    content = dict(changed.content) if bases else changed.content
    locations, refusals = dict(changed.locations), ConfigRefusals()
    inherited: dict[KeyPath, str] = {}
    for name, base in bases.items():
        chain = refusals.of(chain_of_bases, name, {**bases_below, name: base}.get, known, changed, "scene")
        if chain is None:
            del content[name]
            continue
        whole = reduce(Document.overlaid, map(_own_keys, [*(below[link] for link in chain[:-1]), entries[name]]))
        content[name] = whole.content
        locations |= {(name, *path): location for path, location in whole.locations.items()}
        inherited |= {(name, *path): base for path in whole.locations.keys() - entries[name].locations.keys()}
    return replace(changed, content=content, locations=locations, inherited=inherited), refusals


def _entries(scenes: Document) -> dict[Any, Document]:
    """Each scene that is a mapping, by its name."""
    content = scenes.content if isinstance(scenes.content, Mapping) else {}
    lines: dict[Any, dict[KeyPath, str]] = {name: {} for name, entry in content.items() if isinstance(entry, Mapping)}
    for path, location in scenes.locations.items():
        if path and path[0] in lines:
            lines[path[0]][path[1:]] = location
    return {name: Document(scenes.name, content[name], of) for name, of in lines.items()}


def _base(entry: Document) -> str | None:
    base = entry.content.get("base")
    return base if isinstance(base, str) else None


def _own_keys(entry: Document) -> Document:
    """The keys that an entry has itself: on top of a base, null leaves a key out."""
    if _base(entry) is None:
        return entry
    return replace(entry, content=_without_nulls({key: value for key, value in entry.content.items() if key != "base"}))


def _without_nulls(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _without_nulls(inner) for key, inner in value.items()}
    return Without.KEY if value is None else value
