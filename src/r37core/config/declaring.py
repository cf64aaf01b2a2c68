"""Sections of the configuration from the dataclasses of the computations, and back.

A dataclass declares its keys (`r37core.base.declared`). `declared_by` puts them into a section, `section_of` makes the section
of nothing else; `si` makes the dataclass of a section, with those of the sections in it.
"""

import math
from collections.abc import Callable, Collection, Iterable
from dataclasses import MISSING, fields
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin

from pydantic import Field, create_model

from r37core.base.declared import DeclaredKey, Key, declared_keys
from r37core.base.units import si_name

from .section import LeftOut, Section

S = TypeVar("S", bound=Section)
T = TypeVar("T")


def declared_by(
    kind: type, *, optional: bool = False, only: Collection[str] = (), **defaults: Any
) -> Callable[[type[S]], type[S]]:
    """Complete a section by the keys that the dataclass `kind` declares, after its own.

    `optional`: every key may be left out; `only`: some of the keys; `defaults`: of keys, where this section's is another than
    the dataclass's.
    """

    def completed(section: type[S]) -> type[S]:
        keys = [key for key in declared_keys(kind) if not only or key.name in only]
        made: dict[str, Any] = {key.name: _field(key, optional, defaults.get(key.name, MISSING)) for key in keys}
        model = create_model(section.__name__, __base__=section, __module__=section.__module__, __doc__=section.__doc__, **made)
        model.declares = kind
        return model

    return completed


def section_of(kind: type, meaning: str, **options: Any) -> Any:
    """A section of no more than the keys that the dataclass `kind` declares; `options` as of declared_by."""
    return declared_by(kind, **options)(create_model(f"{kind.__name__}Section", __base__=Section, __doc__=meaning))


def si(section: Section) -> Any:
    """The dataclass that declares a section's keys, in SI units, with those of the sections in it."""
    return si_form(section.declares, section, **section.parts())


def si_form(kind: type[T], section: Section, **parts: Any) -> T:
    """The dataclass `kind` of what a section gives it, in SI units, and of `parts` that are made otherwise.

    A field has the value of a key that it declares or, without a declaration, of one that is called like it. What is left out
    has the dataclass's default, or is None.
    """
    keys = _keys_of_all_fields(kind)  # type: ignore[arg-type]
    values: dict[str, Any] = {each.field: None for each in keys if each.default is MISSING}
    for each in keys:
        value, key = getattr(section, each.name, None), each.key
        if each.field not in parts and value is not None and value != (key.none or None):
            values[each.field] = key.words[value] if key.words else si_value(value, key.factor)
    return kind(**values | parts)


@cache
def _keys_of_all_fields(kind: Any) -> list[DeclaredKey]:
    """Keys of a dataclass: a field that declares none has the one that is called like it."""
    declared = declared_keys(kind)
    others = [field for field in fields(kind) if field.name not in {key.field for key in declared}]
    return [*declared, *(DeclaredKey(field.name, field.name, Key(""), field.type, field.default) for field in others)]


def _field(declared: DeclaredKey, optional: bool, default: Any) -> tuple[Any, Any]:
    """Type and field of a model for a key."""
    key, default = declared.key, _default(declared) if default is MISSING else default
    # three dots stand for a key that is required
    if optional or (default is ... and key.optional):
        default = None
    kind = _file_type(key, declared.kind)
    return kind | LeftOut if default is None else kind, Field(default=default, description=key.description)


def _default(declared: DeclaredKey) -> Any:
    """The default in the key's unit; None where a key that is left out says the same, as with no bound; `...` without one."""
    default, key = declared.default, declared.key
    if default is MISSING:
        return ...
    if default is None or (isinstance(default, float) and math.isinf(default)):
        return key.none or None
    if key.words:
        return next(word for word, value in key.words.items() if value == default)
    if isinstance(default, tuple):
        return list(default)
    return default if key.factor in (None, 1.0) else default / key.factor


def _file_type(key: Key, kind: Any) -> Any:
    """Type in a file for a field of the type `kind`: words for true and false, lists for tuples, bounds of numbers."""
    if key.words:
        return Literal[tuple(key.words)]
    if key.one_of:
        return Literal[tuple(key.one_of)]
    if get_origin(kind) in (Union, UnionType):
        (kind,) = (part for part in get_args(kind) if part is not NoneType)
        number = _file_type(key, kind)
        return Literal[key.none] | number if key.none else number
    if get_origin(kind) is tuple:
        entries = get_args(kind)
        least, most = (key.entries, None) if entries[-1] is Ellipsis else (len(entries), len(entries))
        return Annotated[list[_file_type(key, entries[0])], Field(min_length=least, max_length=most)]  # type: ignore[misc]
    if kind in (int, float):
        return Annotated[kind, Field(ge=key.ge, gt=key.gt, le=key.le, lt=key.lt)]
    return kind


def si_fields(section: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """Fields of a section's keys and values: without units in their names, in SI units, lists as tuples.

    A key that is not given has no field, nor has one with a word in place of a number. Of two keys for one field, in two
    units, the one that is given counts.
    """
    fields: dict[str, Any] = {}
    for key, value in section:
        field, factor = si_name(key)
        left_out = value is None or (factor is not None and isinstance(value, str))
        if not left_out and (value or field not in fields):
            fields[field] = si_value(value, factor)
    return fields


def si_value(value: Any, factor: float | None) -> Any:
    """A value of a key whose unit is `factor` in the SI, as fields have it: lists as tuples, sections as their dataclasses."""
    if isinstance(value, list):
        return tuple(si_value(entry, factor) for entry in value)
    if isinstance(value, Section) and value.declares:
        return si(value)
    return value * factor if factor is not None and isinstance(value, int | float) else value
