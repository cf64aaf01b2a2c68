"""From keys with units, as configuration files have them, to fields in SI units, where no dataclass declares the keys."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from r37core.units import si_name


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
            fields[field] = to_si(value, factor)
    return fields


def to_si(value: Any, factor: float | None) -> Any:
    """A value of a key whose unit is `factor` in the SI, as fields have it: a list as a tuple."""
    if isinstance(value, list):
        return tuple(to_si(entry, factor) for entry in value)
    return value * factor if factor is not None and isinstance(value, int | float) else value
