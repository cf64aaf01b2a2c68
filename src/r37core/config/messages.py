"""Messages from pydantic's errors: the key, what was found and what is allowed."""

import difflib
from collections.abc import Iterable, Mapping
from functools import cache, reduce
from operator import getitem
from typing import Any

from pydantic import BaseModel, ValidationError

from r37core.base.yaml_file import KeyPath

from .section import Without

_BOUNDS = {
    "minimum": "at least",
    "exclusiveMinimum": "more than",
    "maximum": "at most",
    "exclusiveMaximum": "less than",
    "minItems": "entries: at least",
    "maxItems": "at most",
    "minProperties": "entries: at least",
    "minLength": "characters: at least",
    "maxLength": "characters: at most",
    "pattern": "text like",
}


def explain_all(error: ValidationError, content: Any, model: type[BaseModel]) -> list[tuple[KeyPath, KeyPath, str]]:
    """Place, key and message of all errors, one of each value, unknown keys first.

    A missing key beside an unknown one is not reported, because the unknown one may be meant for it.
    """
    errors = sorted(error.errors(include_url=False), key=lambda refusal: refusal["type"] != "extra_forbidden")
    unknown = {refusal["loc"][:-1] for refusal in errors if refusal["type"] == "extra_forbidden"}
    explained: dict[KeyPath, tuple[KeyPath, KeyPath, str]] = {}
    # the explained places and all that hold them: a list may have as many errors as entries
    holding: set[KeyPath] = set()
    for refusal in errors:
        within = _within(content, refusal["loc"], missing=refusal["type"] == "missing")
        path = (*within, *refusal.get("ctx", {}).get("at", ()))
        is_implied = refusal["type"] == "missing" and refusal["loc"][:-1] in unknown
        above = [path[:length] for length in range(len(path) + 1)]
        if not is_implied and path not in holding and explained.keys().isdisjoint(above):
            holding.update(above)
            explained[path] = _explained(refusal, path, content, model)
    return list(explained.values())


def _explained(error: Mapping[str, Any], path: KeyPath, content: Any, model: type[BaseModel]) -> tuple[KeyPath, KeyPath, str]:
    schema, variants, context = _schema(model), frozenset(map(str, error["loc"])), error.get("ctx", {})
    if error["type"] == "refused":
        return path, path, f"found {single_line(context['found'])}; allowed: {context['allowed']}"
    if error["type"] in ("missing", "extra_forbidden"):
        *parent, key = path
        known = _keys(_part_at(schema, tuple(parent), schema, variants), schema)
        if error["type"] == "missing":
            return tuple(parent), tuple(parent), f"missing key {key}; allowed keys: {', '.join(known)}"
        text = f"found unknown key {single_line(str(key))}; allowed keys: {', '.join(known)}{did_you_mean(str(key), known)}"
        return path, tuple(parent), text
    value = reduce(getitem, path, content)
    shown = "nothing" if value in (None, Without.KEY) else single_line(repr(value))
    return path, path, f"found {shown}; allowed: {describe(_part_at(schema, path, schema, variants), schema) or error['msg']}"


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """A question in brackets for the end of a message: the known name that is most like this one, whatever its capitals."""
    lower_names = {other.lower(): other for other in known}
    close = difflib.get_close_matches(name.lower(), lower_names, 1)
    # the beginning of a long name is enough
    close = close or [other for other in lower_names if len(name) > 2 and other.startswith(name.lower())]
    return f" (did you mean {lower_names[close[0]]}?)" if close else ""


def single_line(text: str) -> str:
    """The text as a message shows it: control characters as in Python, and no more than 80 characters."""
    plain = text if text.isprintable() else repr(text)[1:-1]
    return plain if len(plain) <= 80 else plain[:76] + " ..."


@cache
def _schema(model: type[BaseModel]) -> dict[str, Any]:
    return model.model_json_schema()


def describe(part: Mapping[str, Any], schema: Mapping[str, Any]) -> str:
    """Allowed values of a part of a JSON schema, in words."""
    part = _resolved(part, schema)
    if choices := _choices(part, schema):
        return " or ".join(describe(choice, schema) for choice in choices)
    if "const" in part:
        return str(part["const"])
    if "enum" in part:
        return f"one of {', '.join(map(str, part['enum']))}"
    words = [str(part["type"])] if "type" in part else []
    bounds = {bound: part[name] for name, bound in _BOUNDS.items() if name in part}
    words += [f"{bound} {value:g}" if isinstance(value, float) else f"{bound} {value}" for bound, value in bounds.items()]
    if part.get("type") == "array" and "items" in part:
        inner = _resolved(part["items"], schema)
        words[0] = f"list of {describe(inner, schema) if 'properties' in inner else inner.get('type', 'values')}"
    if "properties" in part:
        words[0] = f"mapping with the keys {', '.join(part['properties'])}"
    elif named := [*part.get("patternProperties", {}).values(), part.get("additionalProperties")][0]:
        several = {"anyOf", "oneOf"} & _resolved(named, schema).keys()
        words = ["mapping of names", *words[1:], *([] if several else [f"each with {describe(named, schema)}"])]
    return ", ".join(words)


def _within(content: Any, location: Iterable[str | int], missing: bool) -> KeyPath:
    """A place as the file has it: pydantic's has names of variants in between, and a missing key at its end."""
    steps = list(location)
    last = [steps.pop()] if missing else []
    path: list[str | int] = []
    for step in steps:
        is_key = isinstance(content, Mapping) and step in content
        is_entry = isinstance(content, list) and isinstance(step, int) and step < len(content)
        if is_key or is_entry:
            content = content[step]
            path.append(step)
    return (*path, *last)


def _resolved(part: Mapping[str, Any], schema: Mapping[str, Any]) -> Mapping[str, Any]:
    while "$ref" in part:
        part = schema["$defs"][part["$ref"].rsplit("/", 1)[1]]
    return part


def _keys(part: Mapping[str, Any], schema: Mapping[str, Any]) -> list[str]:
    """Keys of a mapping, or of those among several kinds of values that are one."""
    return [key for kind in (part, *_choices(part, schema)) for key in kind.get("properties", {})]


def _choices(part: Mapping[str, Any], schema: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The kinds of values that a part allows, where it allows several."""
    return [_resolved(choice, schema) for choice in (*part.get("anyOf", ()), *part.get("oneOf", ()))]


def _part_at(part: Mapping[str, Any], path: KeyPath, schema: Mapping[str, Any], variants: frozenset[str]) -> Mapping[str, Any]:
    """The part of a JSON schema that is for the value at `path`; empty where there is none.

    Among several models that of a title in `variants` counts, which pydantic has in the place of an error.
    """
    part = _resolved(part, schema)
    choices = _choices(part, schema)
    named = [choice for choice in choices if choice.get("title") in variants]
    if named:
        return _part_at(named[0], path, schema, variants)
    if not path:
        return part
    for choice in choices:
        match = _part_at(choice, path, schema, variants)
        if match:
            return match
    step, *rest = path
    inner = part.get("items") if isinstance(step, int) else part.get("properties", {}).get(step)
    # numbers may be the keys of a table that a call gives
    inner = inner or next(iter(part.get("patternProperties", {}).values()), None) or part.get("additionalProperties")
    return _part_at(inner, tuple(rest), schema, variants) if isinstance(inner, Mapping) else {}
