"""Bases of blades and scenes: entries of the same file that others start from."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import reduce
from typing import Any

from .document import ConfigRefusals, Document, joined
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
            raise document.refusal(
                (chain[0], "base"), f"'{base}'", f"another {kind} of this file, no family ({', '.join(others)}){hint}"
            )
        chain.insert(0, base)
    return chain


def complete_scenes(scenes: Document, above: Document | None = None) -> tuple[Document, ConfigRefusals]:
    """Scenes that are complete: what an entry leaves out is that of its base, key by key also inside sections.

    A key that is null is left out although the base has it. `above`: changes of some entries, which others that start from them
    do not have. An entry whose base is not there, or in a circle, is left out and refused.
    """
    changed, refusals = scenes.overlaid(above) if above else scenes, ConfigRefusals()
    below, entries = _mappings(scenes.content), _mappings(changed.content)
    bases_below, bases = _bases(below), _bases(entries)
    known = [name for name, entry in below.items() if not entry.keys() & set(FAMILY_KEYS)]
    content, sources = dict(changed.content) if bases else changed.content, {}
    for name, base in bases.items():
        chain = refusals.of(chain_of_bases, name, {**bases_below, name: base}.get, known, changed, "scene")
        if chain is None:
            del content[name]
        else:
            content[name] = reduce(joined, map(_own_keys, [*(below[link] for link in chain[:-1]), entries[name]]))
            sources[name] = base
    return replace(changed, content=content, sources=sources), refusals


def _mappings(content: Any) -> dict[str, Mapping[str, Any]]:
    """Entries of a file as far as they are mappings."""
    every = content.items() if isinstance(content, Mapping) else ()
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
