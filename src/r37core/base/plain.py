"""Frozen dataclasses as plain dictionaries, and back: what a rule's parameter holds, and what a job makes of it.

Light: the simulation jobs import it.
"""

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

T = TypeVar("T")


class PlainError(ValueError):
    """A value that has no plain form, or plain values that do not make the wanted type; the message says where."""


def to_plain(value: Any) -> Any:
    """`value` as dictionaries, lists, numbers, texts and None, which Snakemake compares and JSON can hold.

    Dataclasses become dictionaries of all their fields, tuples become lists. Raises PlainError for anything else.
    """
    return _plain(value, type(value).__name__)


def from_plain(cls: type[T], data: Any) -> T:
    """The `cls` of which `to_plain` made `data`: a dataclass, or any type that one may have as a field.

    Raises PlainError for a field that is unknown or missing, and for a value in place of a section or the other way round.
    """
    kind: Any = cls
    origin, arguments, several = get_origin(kind), get_args(kind), isinstance(data, list | tuple)
    if origin in (Union, UnionType):
        for part in arguments:
            with suppress(PlainError):
                return from_plain(part, data)
    elif hints := _hints(kind):
        if isinstance(data, Mapping) and data.keys() == hints.keys():
            return kind(**{name: from_plain(hint, data[name]) for name, hint in hints.items()})
    elif origin in (tuple, list):
        endless = origin is list or arguments[-1] is Ellipsis
        if several and (endless or len(data) == len(arguments)):
            kinds = arguments[:1] * len(data) if endless else arguments
            return origin(map(from_plain, kinds, data))
    elif isinstance(origin, type) and issubclass(origin, Mapping):
        if isinstance(data, Mapping):
            return {key: from_plain(arguments[1], part) for key, part in data.items()}  # type: ignore[return-value]
    elif kind is Any or ((data is None) == (kind is NoneType) and not (several or isinstance(data, Mapping))):
        return data
    raise PlainError(f"{getattr(kind, '__name__', kind)}: found {data!r}")


def to_json(value: Any) -> str:
    """`value` as JSON text, as `to_plain` has it. Raises PlainError."""
    return json.dumps(to_plain(value))


def from_json(cls: type[T], text: str) -> T:
    """The `cls` of which `to_json` made `text`. Raises PlainError as `from_plain`."""
    return from_plain(cls, json.loads(text))


@cache
def _hints(kind: Any) -> dict[str, Any]:
    """Fields of a dataclass and their types; none of any other type."""
    hints = get_type_hints(kind) if is_dataclass(kind) else {}
    return {field.name: hints[field.name] for field in fields(kind)} if hints else {}


def _plain(value: Any, path: str) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name), f"{path}.{field.name}") for field in fields(value)}
    if isinstance(value, Mapping):
        return {_plain(key, path): _plain(part, f"{path}.{key}") for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(part, f"{path}[{index}]") for index, part in enumerate(value)]
    for kind in (bool, int, float, str):
        # np.float64 is a float too, but has a repr of its own, which Snakemake would compare
        if isinstance(value, kind):
            return kind(value)
    if value is None:
        return None
    raise PlainError(f"{path}: found {type(value).__name__}; allowed: dataclasses, mappings, lists, tuples, plain numbers")
