"""Declaration of a dataclass field's key in the configuration files: its key, unit, bounds and description.

The dataclass of a computation declares them, and nothing else does: `r37core.config.declaring` makes the model of the file's
section of it, and with that the schema, the messages and the tables of docs/configuration.md. Light: the simulations import it.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from functools import cache
from itertools import chain
from typing import Annotated, Any, get_args, get_origin, get_type_hints

from .units import SUFFIXES


@dataclass(frozen=True)
class Key:
    """The key that gives a field: `Annotated[float, Key("of a bar", "_pa", ge=0)]`; its default is that of the field.

    `unit`: end of the key, one of units.SUFFIXES; `name`: the key without its unit, where it is not called like the field;
    `ge`, `gt`, `le`, `lt`: bounds in the key's unit, of a list's entries where there is one; `one_of`: texts that are allowed;
    `entries`: least number of a list's entries; `words`: word -> value of a field that is true or false; `none`: word for a
    field that is None. `optional`: whether the key may be left out, also of a field without default, which is then made
    otherwise. Several keys of one field are several ways to give it.
    """

    description: str
    unit: str = ""
    name: str = ""
    ge: float | None = None
    gt: float | None = None
    le: float | None = None
    lt: float | None = None
    entries: int | None = None
    words: Mapping[str, bool] | None = None
    one_of: Iterable[str] = ()
    none: str = ""
    optional: bool = False

    @property
    def factor(self) -> float | None:
        """Factor from the key's unit to the SI; None for a key without a unit."""
        return SUFFIXES[self.unit] if self.unit else None


def speed_keys(description: str, name: str = "") -> tuple[Key, Key]:
    """Keys of a speed, in rad/s or rpm, as one part of an annotation."""
    return (
        Key(description, "_rad_s", name, ge=1e-3, le=1e6, optional=True),
        Key("The same speed in revolutions per minute", "_rpm", name, ge=0.01, le=9.5e6, optional=True),
    )


@dataclass(frozen=True)
class DeclaredKey:
    """A `key` of the configuration, the `field` that it gives, and that field's `kind` and `default` (in SI units)."""

    name: str
    field: str
    key: Key
    kind: Any
    default: Any


@cache
def declared_keys(kind: type) -> tuple[DeclaredKey, ...]:
    """All keys that the fields of a dataclass declare, in their order. Raises ValueError for a key whose unit is not known."""
    hints = get_type_hints(kind, include_extras=True)
    declared = []
    for field in fields(kind):
        if get_origin(hints[field.name]) is Annotated:
            kind, *metadata = get_args(hints[field.name])
            parts = chain.from_iterable(part if isinstance(part, tuple) else (part,) for part in metadata)
            for key in (part for part in parts if isinstance(part, Key)):
                name = (key.name or field.name) + key.unit
                if key.unit not in ("", *SUFFIXES):
                    raise ValueError(f"key {name}: found the unit '{key.unit}'; known: {', '.join(SUFFIXES)} (units.SUFFIXES)")
                declared.append(DeclaredKey(name, field.name, key, kind, field.default))
    return tuple(declared)
