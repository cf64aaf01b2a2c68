"""Messages from pydantic's errors: the key, what was found and what is allowed."""

import difflib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
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


def explain_all(
    error: ValidationError, content: Any, model: type[BaseModel], inherits: Callable[[KeyPath], bool] = lambda path: False
) -> list[tuple[KeyPath, KeyPath, str]]:
    """Place, key and message of all errors, one of each value, unknown keys first.

    A missing key beside an unknown one is not reported, because the unknown one may be meant for it. `inherits`: whether the
    entry with the value at a path starts from another one.
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
            place, key, text = _explained(refusal, path, content, model)
            remedy = "; null (None in Python) leaves out an inherited one"
            explained[path] = place, key, text + remedy * (refusal["type"] == "several" and inherits(path))
    return list(explained.values())


def _explained(error: Mapping[str, Any], path: KeyPath, content: Any, model: type[BaseModel]) -> tuple[KeyPath, KeyPath, str]:
    schema, variants, context = _schema(model), set(map(str, error["loc"])), error.get("ctx", {})
    if "found" in context:
        return path, path, f"found {single_line(context['found'])}; allowed: {context['allowed']}"
    if error["type"] in ("missing", "extra_forbidden"):
        *parent, key = path
        known = _keys(_part_at(schema, parent, variants))
        if error["type"] == "missing":
            return tuple(parent), tuple(parent), f"missing key {key}; allowed keys: {', '.join(known)}"
        text = f"found unknown key {single_line(str(key))}; allowed keys: {', '.join(known)}{did_you_mean(str(key), known)}"
        return path, tuple(parent), text
    value = reduce(getitem, path, content)
    shown = "nothing" if value in (None, Without.KEY) else single_line(repr(value))
    return path, path, f"found {shown}; allowed: {describe(_part_at(schema, path, variants)) or error['msg']}"


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
def _schema(model: type[BaseModel]) -> Any:
    """JSON schema of a model, with parts in place of references to them."""
    schema = model.model_json_schema()
    return _expanded(schema, schema.pop("$defs", {}))


def _expanded(part: Any, parts: Mapping[str, Any]) -> Any:
    if isinstance(part, list):
        return [_expanded(inner, parts) for inner in part]
    if not isinstance(part, dict):
        return part
    content = parts[part["$ref"].rsplit("/", 1)[1]] if "$ref" in part else part
    return {key: _expanded(inner, parts) for key, inner in content.items()}


def describe(part: Mapping[str, Any]) -> str:
    """Allowed values of a part of a JSON schema, in words."""
    if choices := _choices(part):
        return " or ".join(map(describe, choices))
    if "const" in part:
        return str(part["const"])
    if "enum" in part:
        return f"one of {', '.join(map(str, part['enum']))}"
    words = [str(part["type"])] if "type" in part else []
    bounds = {bound: part[name] for name, bound in _BOUNDS.items() if name in part}
    words += [f"{bound} {value:g}" if isinstance(value, float) else f"{bound} {value}" for bound, value in bounds.items()]
    if part.get("type") == "array" and "items" in part:
        inner = part["items"]
        words[0] = f"list of {describe(inner) if 'properties' in inner else inner.get('type', 'values')}"
    if "properties" in part:
        words[0] = f"mapping with the keys {', '.join(part['properties'])}"
    elif named := [*part.get("patternProperties", {}).values(), part.get("additionalProperties")][0]:
        words = ["mapping of names", *words[1:], *([] if _choices(named) else [f"each with {describe(named)}"])]
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


def _keys(part: Mapping[str, Any]) -> list[str]:
    """Keys of a mapping, or of those among several kinds of values that are one."""
    return [key for kind in (part, *_choices(part)) for key in kind.get("properties", {})]


def _choices(part: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The kinds of values that a part allows, where it allows several."""
    return [*part.get("anyOf", ()), *part.get("oneOf", ())]


def _part_at(part: Mapping[str, Any], path: Sequence[str | int], variants: Collection[str]) -> Mapping[str, Any]:
    """The part of a JSON schema that is for the value at `path`; empty where there is none.

    Among several models that of a title in `variants` counts, which pydantic has in the place of an error.
    """
    choices = _choices(part)
    named = [choice for choice in choices if choice.get("title") in variants]
    if named:
        return _part_at(named[0], path, variants)
    if not path:
        return part
    matches = (_part_at(choice, path, variants) for choice in choices)
    if match := next(filter(None, matches), None):
        return match
    step, *rest = path
    inner = part.get("items") if isinstance(step, int) else part.get("properties", {}).get(step)
    # numbers may be the keys of a table that a call gives
    inner = inner or next(iter(part.get("patternProperties", {}).values()), None) or part.get("additionalProperties")
    return _part_at(inner, rest, variants) if isinstance(inner, Mapping) else {}
