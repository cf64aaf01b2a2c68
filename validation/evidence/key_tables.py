"""Tables of docs/configuration.md and docs/results.md that follow from the code: every key, and every column in words.

`PYTHONPATH=validation python -m evidence.key_tables` renews both pages.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from evidence.schemas import MODELS
from r37core.config.messages import describe
from r37core.config.section import NAME_PATTERN, TEXT_PATTERN
from r37core.config.speed_section import UNITS
from r37core.io import write_text
from r37core.results.glossary import INTERACTIONS, RANKING, Word
from r37core.text_file import with_part
from r37core.units import SUFFIXES

Schema = Mapping[str, Any]

UNIT_OF_SUFFIX = {
    "_m": "m",
    "_cm": "cm",
    "_m2": "m²",
    "_s": "s",
    "_hz": "Hz",
    "_pa": "Pa",
    "_kg": "kg",
    "_kg_m3": "kg/m³",
    "_n_m2": "N/m²",
    "_rad_s": "rad/s",
    "_rad_s2": "rad/s²",
    "_rpm": "rpm",
    "_rpm_s": "rpm/s",
    "_deg": "degrees",
    "_percent": "%",
    "_clearances": "clearances",
}
"""End of a key -> its unit as people read it."""

KINDS = {
    "BladeEntry": "A blade by its shape, or of a base",
    "MeshEntry": "A blade by a mesh",
    "MatricesEntry": "A blade by matrices",
}
"""Model of an entry -> heading of its keys, where a file has several kinds of entries."""

_HEAD = "| key | default | unit | allowed | what it is |\n|---|---|---|---|---|"
_WORDS = {NAME_PATTERN: "name", TEXT_PATTERN: "name of a file or folder"}


def tables() -> dict[str, str]:
    """Name of a configuration file without its ending -> Markdown, its keys under headings of the third level."""
    return {name: _file(model.model_json_schema()) for name, model in MODELS.items()}


def _file(schema: Schema) -> str:
    """All keys of a file; of one with entries by name, those of an entry."""
    if "properties" in schema:
        return _FileKeys(schema).by_section(schema)
    entry = next(_entries(schema))
    if "oneOf" not in entry:
        return _FileKeys(schema).by_section(_resolved(entry, schema))
    kinds = [_resolved(kind, schema) for kind in entry["oneOf"]]
    return "\n\n".join(_FileKeys(schema).in_one(kind, KINDS[kind["title"]]) for kind in kinds)


class _FileKeys:
    """Rows of the keys of one file. A model that comes again refers to where its keys stand."""

    def __init__(self, schema: Schema) -> None:
        self._schema = schema
        self._shown: dict[str, str] = {}

    def by_section(self, model: Schema) -> str:
        """Plain keys first, then a heading for each key that holds others."""
        plain, sections = [], []
        for key, part in model["properties"].items():
            rows = list(self._rows(key, part, model))
            if len(rows) == 1:
                plain += rows
            else:
                sections.append("\n".join([f"### {key}\n\n{_HEAD}", *rows]))
        return "\n\n".join([*(["\n".join([_HEAD, *plain])] if plain else []), *sections])

    def in_one(self, model: Schema, heading: str) -> str:
        """One table under a heading."""
        rows = [row for key, part in model["properties"].items() for row in self._rows(key, part, model)]
        return "\n".join([f"### {heading}\n\n{_HEAD}", *rows])

    def _rows(self, path: str, part: Schema, parent: Schema, inherited: str = "") -> Iterator[str]:
        """The row of a key, and those of the keys in it."""
        key = path.rsplit(".", 1)[-1].removesuffix("[]")
        unit = _unit(key, part) or inherited
        inner = list(_models(part, path, self._schema))
        again = [self._shown[name] for name, _, _ in inner if name in self._shown]
        meaning = part.get("description") or next((model.get("description", "") for _, _, model in inner), "")
        meanings = [_text(meaning), *(f"keys as of `{where}`" for where in again)]
        default = _default(path, part, parent, [model for _, _, model in inner])
        cells = [f"`{path}`", default, unit, _allowed(part, self._schema), "; ".join(filter(None, meanings))]
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
        for name, where, model in inner:
            if name in self._shown:
                continue
            self._shown[name] = where
            for inside, entry in model["properties"].items():
                yield from self._rows(f"{where}.{inside}", entry, model, unit)


def _models(part: Schema, path: str, schema: Schema) -> Iterator[tuple[str, str, Schema]]:
    """Models in a key's value: name, path of an entry, schema. `[]` is an entry of a list, NAME one of a mapping."""
    if "$ref" in part:
        name = part["$ref"].rsplit("/", 1)[1]
        yield name, path, schema["$defs"][name]
    for choice in (*part.get("anyOf", ()), *part.get("oneOf", ())):
        yield from _models(choice, path, schema)
    if isinstance(part.get("items"), Mapping):
        yield from _models(part["items"], f"{path}[]", schema)
    for entry in _entries(part):
        yield from _models(entry, f"{path}.NAME", schema)


def _entries(part: Schema) -> Iterator[Schema]:
    """What the entries of a mapping with names of one's own may be."""
    inner = (part.get("additionalProperties"), *part.get("patternProperties", {}).values())
    yield from (schema for schema in inner if isinstance(schema, Mapping))


def _unit(key: str, part: Schema) -> str:
    """The unit that the key's name ends with; lists of speeds have theirs from their name."""
    if key in UNITS and part.get("type", "array") == "array":
        return UNITS[key]
    ends = [end for end in SUFFIXES if key.endswith(end)]
    return UNIT_OF_SUFFIX[max(ends, key=len)] if ends else ""


def _default(path: str, part: Schema, parent: Schema, models: list[Schema]) -> str:
    """What counts where the key is not given; that of a section stands beside its keys, unless these have none of their own."""
    key = path.rsplit(".", 1)[-1]
    if "default" not in part:
        return "needed" if key in parent.get("required", ()) else ""
    value = part["default"]
    if value is None:
        return "left out"
    in_keys = isinstance(value, Mapping) and models and not any(model.get("required") for model in models)
    return "" if in_keys else f"`{_flow(value)}`"


def _flow(value: Any) -> str:
    """A value as YAML has it in one line."""
    if isinstance(value, Mapping):
        inside = ", ".join(f"{key}: {_flow(part)}" for key, part in value.items() if part is not None)
        return f"{{ {inside} }}" if inside else "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(_flow, value))}]"
    if isinstance(value, bool):
        return json.dumps(value)
    return f"{value:g}" if isinstance(value, float) else str(value)


def _allowed(part: Schema, schema: Schema) -> str:
    """What a key may be, in the words of the messages."""
    choices = part.get("anyOf") or part.get("oneOf")
    if choices:
        return "; or ".join(_allowed(choice, schema) for choice in choices)
    resolved = _resolved(part, schema)
    if "properties" in resolved:
        return "section"
    if resolved.get("type") == "array":
        return _list(resolved, schema)
    if resolved.get("type") == "object":
        return "sections by name" if any(_models(resolved, "", schema)) else "values by name"
    if resolved.get("pattern") in _WORDS:
        return _WORDS[resolved["pattern"]]
    return "true or false" if resolved.get("type") == "boolean" else describe(resolved, schema)


def _list(part: Schema, schema: Schema) -> str:
    least, most = part.get("minItems", 0), part.get("maxItems")
    number = f" of {least}" if least == most else f" of at least {least}" if least else ""
    return f"list{number}: {_allowed(part['items'], schema)}"


def _resolved(part: Schema, schema: Schema) -> Schema:
    return schema["$defs"][part["$ref"].rsplit("/", 1)[1]] if "$ref" in part else part


def _text(description: str) -> str:
    """The first paragraph of a description, on one line."""
    return " ".join(description.split("\n\n")[0].split()).rstrip(".").replace("<", "&lt;")


def filled(page: str) -> str:
    """The page with the tables between its markers."""
    for name, text in tables().items():
        page = with_part(page, name, text)
    return page


def column_table(words: Mapping[str, Word]) -> str:
    """Columns as a table of Markdown."""
    lines = [f"| `{name}` | {word.meaning} |" for name, word in words.items()]
    return "\n".join(["| column | what it is |", "|---|---|", *lines])


COLUMN_TABLES = {"columns": INTERACTIONS, "ranking_columns": RANKING}
"""Part of docs/results.md -> columns that stand there."""


def main(docs: Path = Path("docs")) -> None:
    """Renew both pages."""
    page = docs / "configuration.md"
    write_text(filled(page.read_text(encoding="utf-8")), page)
    page = docs / "results.md"
    text = page.read_text(encoding="utf-8")
    for name, words in COLUMN_TABLES.items():
        text = with_part(text, name, column_table(words))
    write_text(text, page)


if __name__ == "__main__":
    main()
