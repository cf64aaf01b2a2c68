"""Values that a key of the configuration may have, in the words of docs/configuration.md."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from r37core.config.section import NAME_PATTERN, TEXT_PATTERN

Schema = Mapping[str, Any]

_WORDS = {NAME_PATTERN: "name", TEXT_PATTERN: "path"}
_KINDS = {"boolean": "true, false", "string": "text"}


def resolved(part: Schema, schema: Schema) -> Schema:
    """A part of a schema itself, where it may be a reference."""
    return schema["$defs"][name_of(part)] if "$ref" in part else part


def name_of(reference: Schema) -> str:
    """Name of the model that a reference is to."""
    return str(reference["$ref"].rsplit("/", 1)[1])


def entries_of(part: Schema) -> Iterator[Schema]:
    """Schemas of the entries of a mapping whose keys are names."""
    inner = (part.get("additionalProperties"), *part.get("patternProperties", {}).values())
    yield from (schema for schema in inner if isinstance(schema, Mapping))


@dataclass(frozen=True)
class AllowedValues:
    """Words for what parts of a schema allow. `unit` of the numbers; `sections`: model -> words for a section of it."""

    schema: Schema
    unit: str = ""
    sections: Mapping[str, str] = field(default_factory=dict)

    def of(self, part: Schema) -> str:
        """Values that a part allows."""
        choices = part.get("anyOf") or part.get("oneOf")
        if choices:
            return "; or ".join(map(self.of, choices))
        plain = resolved(part, self.schema)
        if "properties" in plain:
            return self.sections.get(name_of(part) if "$ref" in part else "", "section")
        if plain.get("type") == "array":
            return f"{_list(plain)}: {self.of(plain['items'])}"
        return self._by_name(plain) if plain.get("type") == "object" else self._value(plain)

    def _by_name(self, part: Schema) -> str:
        if any("properties" in resolved(entry, self.schema) for entry in entries_of(part)):
            return "sections by name"
        return f"values by name ({self.unit})" if self.unit else "values by name"

    def _value(self, part: Schema) -> str:
        """A word, or a number between bounds."""
        if "const" in part:
            return str(part["const"])
        if "enum" in part:
            return ", ".join(map(str, part["enum"]))
        kind = str(part.get("type", ""))
        if kind not in ("integer", "number"):
            return _WORDS.get(part.get("pattern", ""), _KINDS.get(kind, kind))
        return " ".join(filter(None, ["integer" if kind == "integer" else "", _bounds(part) or "number", self.unit]))


def _list(part: Schema) -> str:
    least, most = part.get("minItems", 0), part.get("maxItems")
    if least < 2:
        return "list" if least else "list or []"
    return f"list of {least}" if least == most else f"list of {least} or more"


def _bounds(part: Schema) -> str:
    if {"minimum", "maximum"} <= part.keys():
        return f"{_number(part['minimum'])}..{_number(part['maximum'])}"
    words = {"minimum": "at least", "exclusiveMinimum": "above", "maximum": "at most", "exclusiveMaximum": "below"}
    return ", ".join(f"{word} {_number(part[bound])}" for bound, word in words.items() if bound in part)


def _number(value: float) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
