"""Numbers of blades and scenes that a run varies: their names, their places in an entry, and how a value is put there.

Families of designs, tolerances and searches vary the same numbers. An entry is a mapping of plain values, as in the files.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self, TypeVar

T = TypeVar("T")

BLADE, SCENE = KINDS = ("blade", "scene")
"""Kinds of entries that have numbers."""

_OF_SCENES = f"{SCENE}."


@dataclass(frozen=True)
class VariedNumber:
    """Number of an entry: its `kind`, BLADE or SCENE, and its dotted `key` in the file, such as `lining.thickness_m`."""

    kind: str
    key: str

    @classmethod
    def named(cls, name: str) -> Self:
        """Number by its name among those of a blade and its scenes, such as `stagger_deg.tip` or `scene.damping_ratio`."""
        return cls(SCENE, name.removeprefix(_OF_SCENES)) if name.startswith(_OF_SCENES) else cls(BLADE, name)

    @property
    def name(self) -> str:
        """Name where numbers of blades and scenes stand together: variables of a search, columns of designs.csv."""
        return _OF_SCENES + self.key if self.kind == SCENE else self.key

    @property
    def section(self) -> str:
        """Section of its distribution among tolerances."""
        return f"of_{self.kind}s"


def values_of(kind: str, values: Mapping[str, T]) -> dict[str, T]:
    """Values of the numbers of one kind by their keys, of `values` by the names of numbers of both."""
    numbers = {VariedNumber.named(name): value for name, value in values.items()}
    return {number.key: value for number, value in numbers.items() if number.kind == kind}


def numbers_in(content: Mapping[str, Any], path: str = "") -> dict[str, float]:
    """Dotted key -> value of all numbers in the sections of an entry but those that count something."""
    numbers: dict[str, float] = {}
    for key, value in content.items():
        if isinstance(value, Mapping):
            numbers |= numbers_in(value, f"{path}{key}.")
        elif isinstance(value, float):
            numbers[path + key] = value
    return numbers


def value_at(content: Mapping[str, Any], key: str) -> float | None:
    """Number at a dotted key, whose steps into a list are counted from 0; None where there is none."""
    inner: Any = content
    for step in key.split("."):
        inner = inner[int(step)] if isinstance(inner, list) else inner.get(step) if isinstance(inner, Mapping) else None
    return float(inner) if isinstance(inner, int | float) else None


def with_value(content: Mapping[str, Any], key: str, value: Any) -> dict[str, Any]:
    """Copy of an entry with one value set; sections that are not there are made, rows of a list are not.

    Raises AttributeError, KeyError, IndexError, TypeError or ValueError for a key that leads nowhere.
    """
    changed = dict(content)
    *path, last = key.split(".")
    inner: Any = changed
    for step in path:
        # only what leads to the number is copied
        place: Any = int(step) if isinstance(inner, list) else step
        inner[place] = (inner[place] if isinstance(inner, list) else inner.get(place, {})).copy()
        inner = inner[place]
    if isinstance(inner, list):
        raise TypeError
    # for keys that count; others take one, too
    inner[last] = int(value) if isinstance(value, float) and value.is_integer() else value
    return changed
