"""Frozen dataclasses as plain dictionaries, and back: what a rule's parameter holds, and what a job makes of it.

Light: the simulation jobs import it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

T = TypeVar("T")

_SCALARS = (bool, int, float, str)


class PlainError(ValueError):
    """A value that has no plain form, or plain values that do not make the wanted type; the message says where."""


def to_plain(value: Any) -> Any:
    """`value` as dictionaries, lists, numbers, texts and None, which Snakemake compares and JSON can hold.

    Dataclasses become dictionaries of all their fields, tuples become lists. Raises PlainError for anything else.
    """
    return _plain(value, type(value).__name__)


def from_plain(cls: type[T], data: Any) -> T:
    """The `cls` of which `to_plain` made `data`: a dataclass, or any type that one may have as a field.

    Raises PlainError for a field that is unknown or missing, and for a value of another type.
    """
    return _made(cls, data, getattr(cls, "__name__", str(cls)))


def _plain(value: Any, place: str) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name), f"{place}.{field.name}") for field in fields(value)}
    if isinstance(value, Mapping):
        return {_plain(key, place): _plain(one, f"{place}.{key}") for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(one, f"{place}[{index}]") for index, one in enumerate(value)]
    for kind in _SCALARS:
        # np.float64 is a float too, but has a repr of its own, which Snakemake would compare
        if isinstance(value, kind):
            return kind(value)
    if value is None:
        return None
    raise PlainError(f"{place}: found {type(value).__name__}; allowed: dataclasses, mappings, lists, tuples, plain numbers")


def _made(kind: Any, data: Any, place: str) -> Any:
    origin = get_origin(kind)
    if origin in (Union, UnionType):
        return _made_of_one(get_args(kind), data, place)
    if is_dataclass(kind):
        return _dataclass(kind, data, place)
    if origin in (tuple, list):
        return _sequence(kind, data, place)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        key_kind, value_kind = get_args(kind)
        _require(isinstance(data, Mapping), data, "a mapping", place)
        return {_made(key_kind, key, place): _made(value_kind, one, f"{place}.{key}") for key, one in data.items()}
    if origin is Literal:
        _require(data in get_args(kind), data, " or ".join(map(repr, get_args(kind))), place)
    elif kind is not Any:
        _require(_is_scalar(kind, data), data, getattr(kind, "__name__", str(kind)), place)
    return data


def _dataclass(kind: Any, data: Any, place: str) -> Any:
    hints = _hints(kind)
    _require(isinstance(data, Mapping), data, f"the fields of {kind.__name__}", place)
    _require(set(data) == set(hints), ", ".join(map(str, data)) or "nothing", f"the fields {', '.join(hints)}", place)
    return kind(**{name: _made(hint, data[name], f"{place}.{name}") for name, hint in hints.items()})


def _sequence(kind: Any, data: Any, place: str) -> Any:
    arguments = get_args(kind)
    _require(isinstance(data, list | tuple), data, "a list", place)
    if get_origin(kind) is list or arguments[-1] is Ellipsis:
        arguments = (arguments[0],) * len(data)
    _require(len(data) == len(arguments), f"{len(data)} values", f"{len(arguments)}", place)
    parts = zip(arguments, data, strict=True)
    return get_origin(kind)(_made(part, one, f"{place}[{index}]") for index, (part, one) in enumerate(parts))


def _made_of_one(kinds: tuple[Any, ...], data: Any, place: str) -> Any:
    """Of several types the first that fits; a dictionary fits the dataclass that has its keys as fields."""
    refusals = []
    for kind in kinds:
        try:
            return _made(kind, data, place)
        except PlainError as error:
            refusals.append(str(error))
    raise PlainError("; or ".join(refusals))


def _is_scalar(kind: Any, data: Any) -> bool:
    if kind is float:
        return isinstance(data, int | float) and not isinstance(data, bool)
    return kind in (bool, int, str, NoneType) and type(data) is kind


@cache
def _hints(kind: Any) -> dict[str, Any]:
    hints = get_type_hints(kind)
    return {field.name: hints[field.name] for field in fields(kind)}


def _require(fits: bool, found: Any, needed: str, place: str) -> None:
    if not fits:
        raise PlainError(f"{place}: found {found!r}; needed: {needed}")
