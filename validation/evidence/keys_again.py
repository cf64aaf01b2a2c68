"""Models of the configuration whose keys docs/configuration.md has in another table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from .allowed_values import AllowedValues, Schema

_FEWEST = 2
"""Common keys from which on a table refers to another one."""

_FEWEST_MORE = 4
"""Further common keys from which on it refers to one more."""


@dataclass(frozen=True)
class Shown:
    """A model with a table: its file, the place of its keys in words, its schema."""

    file: str
    place: str
    model: Schema


@dataclass(frozen=True)
class Again:
    """Keys of a model that another table has: that table, their names (all keys where empty), what they are here.

    `own`: keys that need rows.
    """

    text: str = ""
    own: list[str] = field(default_factory=list)
    section: str = "section"


class ShownModels:
    """Models with a table, of the files before and of this one."""

    def __init__(self) -> None:
        self._shown: dict[str, Shown] = {}

    def add(self, name: str, shown: Shown) -> None:
        """A model has a table now."""
        self._shown.setdefault(name, shown)

    def again(self, name: str, model: Schema, file: str, values: AllowedValues) -> Again:
        """Keys of a model that an earlier table has. `values`: words for what the keys may be."""
        same = self._shown.get(name)
        if same and same.model == model:
            return Again(f"keys of {same.place}" + ("" if same.file == file else f" of {same.file}.yaml"))
        of_file = [shown for shown in self._shown.values() if shown.file == file]
        alike = next((shown for shown in of_file if _descriptions(shown.model) == _descriptions(model)), None)
        if alike:
            return Again(f"keys of {alike.place}", section=f"section of {_other_values(model, alike.model, values)}")
        own, texts, fewest = list(model["properties"]), [], _FEWEST
        while True:
            common = {shown.place: [key for key in _common(model, shown.model) if key in own] for shown in of_file}
            likest = max(common, key=lambda place: len(common[place]), default="")
            if not likest or len(common[likest]) < fewest:
                return Again(", the ".join(texts), own)
            texts.append(f"keys {', '.join(f'`{key}`' for key in common[likest])} of {likest}")
            own, fewest = [key for key in own if key not in common[likest]], _FEWEST_MORE


def _descriptions(model: Schema) -> Mapping[str, object]:
    """Key -> all that a row says but for the allowed values and the unit."""
    required = model.get("required", ())
    return {key: (part.get("description"), part.get("default"), key in required) for key, part in model["properties"].items()}


def _other_values(model: Schema, other: Schema, values: AllowedValues) -> str:
    """Allowed values of the keys that differ from those of another model."""
    parts = {key: part for key, part in model["properties"].items() if part != other["properties"][key]}
    return "; ".join(dict.fromkeys(values.of(part).rsplit(": ", 1)[-1] for part in parts.values()))


def _common(model: Schema, other: Schema) -> list[str]:
    """Keys that two models have with the same row."""
    needed, needed_there = (set(schema.get("required", ())) for schema in (model, other))
    return [
        key
        for key, part in model["properties"].items()
        if other["properties"].get(key) == part and (key in needed) == (key in needed_there)
    ]
