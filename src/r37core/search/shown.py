"""How quantities and variables of a search are shown to people: units, factors to them, and names that fit."""

from __future__ import annotations

_LONGEST = 14
"""Characters of a name in one line."""


def with_unit(name: str, unit: str) -> str:
    """A quantity's name with the unit it is shown in."""
    return f"{name} ({unit})" if unit else name


def in_lines(key: str) -> str:
    """A dotted key; a long one with its last part in a second line."""
    before, dot, last = key.rpartition(".")
    return key if len(key) <= _LONGEST or not dot else f"{before}.\n{last}"
