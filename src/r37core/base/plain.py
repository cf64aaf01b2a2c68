"""Frozen dataclasses as plain dictionaries, and back: what a rule's parameter holds, and what a job makes of it.

Light: the simulation jobs import it.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

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

    Raises PlainError for a field that is unknown or missing, and for a value of another type.
    """
    return _made(cls, data, getattr(cls, "__name__", str(cls)))


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


def _made(kind: Any, data: Any, path: str) -> Any:
    origin = get_origin(kind)
    if origin in (Union, UnionType):
        return _made_of_one(get_args(kind), data, path)
    if is_dataclass(kind):
        return _dataclass(kind, data, path)
    if origin in (tuple, list):
        return _sequence(kind, data, path)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        key_kind, value_kind = get_args(kind)
        _require(isinstance(data, Mapping), data, "a mapping", path)
        return {_made(key_kind, key, path): _made(value_kind, part, f"{path}.{key}") for key, part in data.items()}
    if origin is Literal:
        _require(data in get_args(kind), data, " or ".join(map(repr, get_args(kind))), path)
    elif kind is not Any:
        _require(_is_scalar(kind, data), data, getattr(kind, "__name__", str(kind)), path)
    return data


def _dataclass(kind: Any, data: Any, path: str) -> Any:
    hints = _hints(kind)
    _require(isinstance(data, Mapping), data, f"the fields of {kind.__name__}", path)
    _require(set(data) == set(hints), ", ".join(map(str, data)) or "nothing", f"the fields {', '.join(hints)}", path)
    return kind(**{name: _made(hint, data[name], f"{path}.{name}") for name, hint in hints.items()})


def _sequence(kind: Any, data: Any, path: str) -> Any:
    arguments = get_args(kind)
    _require(isinstance(data, list | tuple), data, "a list", path)
    if get_origin(kind) is list or arguments[-1] is Ellipsis:
        arguments = (arguments[0],) * len(data)
    _require(len(data) == len(arguments), f"{len(data)} values", f"{len(arguments)}", path)
    parts = zip(arguments, data, strict=True)
    return get_origin(kind)(_made(item_kind, item, f"{path}[{index}]") for index, (item_kind, item) in enumerate(parts))


def _made_of_one(kinds: tuple[Any, ...], data: Any, path: str) -> Any:
    """Value of the first of several types that fits; a dictionary fits the dataclass that has its keys as fields."""
    refusals = []
    for kind in kinds:
        try:
            return _made(kind, data, path)
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


def _require(fits: bool, value: Any, needed: str, path: str) -> None:
    if not fits:
        raise PlainError(f"{path}: found {value!r}; needed: {needed}")
