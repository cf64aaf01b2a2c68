"""From keys with units, as configuration files have them, to fields in SI units, as the computations take them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from typing import Any, TypeVar

from r37core.units import si_name

T = TypeVar("T")

WORDS = {
    "edges": ("round_edges", "round"),
    "form": ("vector", "vector"),
    "direction": ("against_rotation", "against_rotation"),
    "coupling": ("coupled", "coupled"),
    "gap": ("exact_gap", "exact"),
    "rings": ("shared_ring", "shared"),
    "pressure_side": ("pressure_side_forward", "forward"),
}
"""Key whose value is one of two words -> field that is true or false, and the word for true."""


def si_fields(section: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """Fields of a section's keys and values: without units in their names, in SI units, lists as tuples.

    A key that is not given has no field, nor has one with a word in place of a number. Of two keys for one field, in two
    units, the one that is given counts.
    """
    found: dict[str, Any] = {}
    for key, value in section:
        if key in WORDS:
            field, true = WORDS[key]
            found[field] = value == true
            continue
        field, factor = si_name(key)
        left_out = value is None or (factor is not None and isinstance(value, str))
        if not left_out and (value or field not in found):
            found[field] = _in_si(value, factor)
    return found


def in_si(kind: type[T], section: Iterable[tuple[str, Any]], **parts: Any) -> T:
    """The dataclass `kind` of those of a section's fields that it has, and of `parts` that are made otherwise."""
    names = {field.name for field in fields(kind)}  # type: ignore[arg-type]
    return kind(**{name: value for name, value in si_fields(section).items() if name in names} | parts)


def _in_si(value: Any, factor: float | None) -> Any:
    if isinstance(value, list):
        return tuple(_in_si(one, factor) for one in value)
    return value * factor if factor is not None and isinstance(value, int | float) else value
