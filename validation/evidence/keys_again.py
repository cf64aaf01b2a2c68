"""Models of the configuration whose keys docs/configuration.md has in another table."""

from collections.abc import Mapping
from dataclasses import dataclass

from .allowed_values import AllowedValues, Schema


@dataclass(frozen=True)
class Shown:
    """A model with a table: its file, the place of its keys in words, its schema."""

    file: str
    place: str
    model: Schema


@dataclass(frozen=True)
class Again:
    """Words for the table that has the keys of a model, empty where they need rows of their own, and for what they are here."""

    text: str = ""
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
        return Again()


def _descriptions(model: Schema) -> Mapping[str, object]:
    """Key -> all that a row says but for the allowed values and the unit."""
    required = model.get("required", ())
    return {key: (part.get("description"), part.get("default"), key in required) for key, part in model["properties"].items()}


def _other_values(model: Schema, other: Schema, values: AllowedValues) -> str:
    """Allowed values of the keys that differ from those of another model."""
    parts = {key: part for key, part in model["properties"].items() if part != other["properties"][key]}
    return "; ".join(dict.fromkeys(values.of(part).rsplit(": ", 1)[-1] for part in parts.values()))
