"""Tables that follow from the code: every key in docs/configuration.md, every declared column in validation/tables/columns.csv.

`PYTHONPATH=validation python -m evidence.key_tables` renews both files.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from r37core.base.io import write_text
from r37core.base.units import SUFFIXES
from r37core.config.config_file import UNITS
from r37core.product.schemas import MODELS
from r37core.product.targets import COLUMNS as DECLARED
from r37core.results.columns import CHANCE, ENDS, IN_REGION, LENGTHS, OPERATING, Column, names
from r37core.results.ranking import RANKED_BY
from r37core.time_integration.speed_arrays import ARRAYS
from r37studies.designs.table import MEASURES
from r37studies.second_motions.tables import RANGE_COLUMNS, RANGES
from r37studies.tolerances.ranges import COLUMNS as TOLERANCES
from r37studies.tolerances.ranges import RANGED

from .allowed_values import AllowedValues, Schema, entries_of, name_of, resolved
from .keys_again import Shown, ShownModels
from .pages import replace_part
from .tables import write_table

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
    "SectionsEntry": "A blade by sections",
}
"""Model of an entry -> heading of its keys, where a file has several kinds of entries."""

_HEAD = "| key | values | meaning |\n|---|---|---|"


def tables() -> dict[str, str]:
    """Name of a configuration file without its ending -> Markdown, its keys under headings of the third level."""
    shown = ShownModels()
    return {name: _file(_FileKeys(name, model.model_json_schema(), shown)) for name, model in MODELS.items()}


def _file(keys: _FileKeys) -> str:
    """All keys of a file; of one with entries by name, those of an entry."""
    schema = keys.schema
    if "properties" in schema:
        return keys.by_section(schema)
    entry = next(entries_of(schema))
    if "oneOf" not in entry:
        return keys.by_section(resolved(entry, schema))
    return "\n\n".join(keys.of_kind(resolved(kind, schema)) for kind in entry["oneOf"])


class _Row(NamedTuple):
    """Cells of a key's row; the values begin with the default, or with `required`."""

    key: str
    values: str
    meaning: str


def _line(row: _Row) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"


def _is_rpm_of(key: str, other: str) -> bool:
    """Whether a key is another one's speed or rate in revolutions per minute."""
    plain = key.replace("_rpm_s", "_rad_s2").replace("_rpm", "_rad_s")
    return "_rpm" in key and other in (plain, key.removesuffix("_rpm"))


def _without_rpm(keys: Iterable[str]) -> list[str]:
    """Keys but for those that share the row of their counterpart in rad/s."""
    names = list(keys)
    return [key for key in names if not any(_is_rpm_of(key, other) for other in names)]


class _FileKeys:
    """Rows of the keys of one file. Of keys that have rows already, the place of these is named. `shown`: models with rows."""

    def __init__(self, file: str, schema: Schema, shown: ShownModels) -> None:
        self.schema = schema
        self._file = file
        self._shown = shown

    def by_section(self, model: Schema) -> str:
        """Plain keys first, then a heading for each key that holds others, with its meaning as a sentence."""
        plain, sections = [], []
        for key in _without_rpm(model["properties"]):
            first, *rows = self._rows(key, model["properties"][key], model)
            if not rows:
                plain.append(_line(first))
            elif first.values in ("section", "required; section"):
                lead = "Required. " if first.values.startswith("required") else ""
                sections.append("\n".join([f"### {key}\n\n{lead}{first.meaning}.\n\n{_HEAD}", *map(_line, rows)]))
            else:
                sections.append("\n".join([f"### {key}\n\n{_HEAD}", *map(_line, (first, *rows))]))
        return "\n\n".join([*(["\n".join([_HEAD, *plain])] if plain else []), *sections])

    def of_kind(self, model: Schema) -> str:
        """One table of an entry's keys, under the heading of its kind."""
        keys = _without_rpm(model["properties"])
        rows = [_line(row) for key in keys for row in self._rows(key, model["properties"][key], model)]
        return "\n".join([f"### {KINDS[model['title']]}\n\n{_HEAD}", *rows])

    def _rows(self, path: str, part: Schema, parent: Schema, inherited: str = "") -> Iterator[_Row]:
        """The row of a key, and those of the keys in it."""
        key = path.rsplit(".", 1)[-1].removesuffix("[]")
        unit = _unit(key, part) or inherited
        inner = list(_models(part, path, self.schema))
        values = AllowedValues(self.schema, unit)
        again = {name: self._shown.again(name, model, self._file, values) for name, _, model in inner}
        meaning = part.get("description") or next((model.get("description", "") for _, _, model in inner), "")
        places = (keys.text.replace(f"of `{path}`", "as above") for keys in again.values())
        meanings = "; ".join(filter(None, dict.fromkeys([_text(meaning), *places])))
        default = _default(path, part, parent, [model for _, _, model in inner])
        values = replace(values, sections={name: keys.section for name, keys in again.items()})
        names = [f"`{path}`", *(f"`{twin}`" for twin in parent["properties"] if _is_rpm_of(twin, key))]
        yield _Row(", ".join(names), "; ".join(filter(None, [default, values.of(part)])), meanings)
        for name, where, model in inner:
            self._shown.add(name, Shown(self._file, f"`{where.removesuffix('[]')}`", model))
            for inside in () if again[name].text else _without_rpm(model["properties"]):
                yield from self._rows(f"{where}.{inside}", model["properties"][inside], model, unit)


def _models(part: Schema, path: str, schema: Schema) -> Iterator[tuple[str, str, Schema]]:
    """Models in a key's value: name, path of an entry, schema. `[]` is an entry of a list, NAME one of a mapping."""
    if "$ref" in part:
        yield name_of(part), path, resolved(part, schema)
    for choice in (*part.get("anyOf", ()), *part.get("oneOf", ())):
        yield from _models(choice, path, schema)
    if isinstance(part.get("items"), Mapping):
        yield from _models(part["items"], f"{path}[]", schema)
    for entry in entries_of(part):
        yield from _models(entry, f"{path}.NAME", schema)


def _unit(key: str, part: Schema) -> str:
    """The unit that the key's name ends with; lists of speeds have theirs from their name."""
    if key in UNITS and part.get("type", "array") == "array":
        return UNITS[key]
    ends = [end for end in SUFFIXES if key.endswith(end)]
    return UNIT_OF_SUFFIX[max(ends, key=len)] if ends else ""


def _default(path: str, part: Schema, parent: Schema, models: list[Schema]) -> str:
    """Value of a key that is left out, nothing for an optional key; a section's is in its keys, unless these have none."""
    key = path.rsplit(".", 1)[-1]
    if "default" not in part:
        return "required" if key in parent.get("required", ()) else ""
    value = part["default"]
    if value is None:
        return ""
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


def _text(description: str) -> str:
    """The first paragraph of a description, on one line."""
    return " ".join(description.split("\n\n")[0].split()).rstrip(".").replace("<", "&lt;")


def filled(page: str) -> str:
    """The page with the tables between its markers."""
    for name, text in tables().items():
        page = replace_part(page, name, text)
    return page


COLUMNS = Path("validation/tables/columns.csv")
"""File with the meaning of every declared column."""

_RANGES = [name for column in RANGED for name in column.range_names]
_RANKED_RANGES = [f"{name}_{end}" for name in RANKED_BY for end in ("low", "high")]

TABLES_OF_RESULTS = {
    "summary.csv": [*names(DECLARED["summary"]), *_RANGES],
    "ranking.csv": [
        "blade",
        "scene",
        *names(DECLARED["ranking"]),
        *_RANKED_RANGES,
        IN_REGION.format("REGION"),
        f"{CHANCE}BLADE",
    ],
    "designs.csv": ["blade", "scene", *names(MEASURES), *names(OPERATING)],
    "tolerances.csv": TOLERANCES,
    "second_motions.csv": RANGE_COLUMNS,
}
"""Table of results -> its declared columns. REGION and BLADE stand for a name."""

RUN_FILE = "speed_*.npz"
"""File of a run, whose arrays are declared."""


def column_rows() -> Iterator[tuple[str, str, str]]:
    """Table, column and meaning of every declared column, and those of every array of a run."""
    designs = (*MEASURES, *OPERATING)
    declared = {"ranking.csv": DECLARED["ranking"], "designs.csv": designs, "second_motions.csv": RANGES}
    for file, columns in TABLES_OF_RESULTS.items():
        for name in columns:
            yield file, name, _meaning(name, (*declared.get(file, ()), *DECLARED["summary"], *DECLARED["ranking"]))
    for name, array in ARRAYS.items():
        yield RUN_FILE, name, f"{array.long_name}; unit {array.units}" + f", over {', '.join(array.dims)}" * bool(array.dims)


def _meaning(name: str, columns: Iterable[Column]) -> str:
    """Meaning of a column: one of `columns`, the scatter or range over members of one, a length in a region, a chance."""
    for column in columns:
        if name == column.name:
            return column.meaning
        if name == column.scatter_name:
            return f"standard deviation by chance of: {column.meaning}"
        if name in column.range_names:
            quantile = ENDS[name.removeprefix(f"{column.name}_")]
            return f"{'median' if quantile == 0.5 else f'{quantile:.0%}'} of the members: {column.meaning}"
    others = {
        IN_REGION.format("REGION"): f"{LENGTHS[0].meaning} in the region REGION",
        f"{CHANCE}BLADE": "share of the members in which the blade is better than BLADE",
    }
    return others[name]


def columns(input: Any, output: Any, params: Any) -> None:
    """Every declared column of the tables of results and every array of a run's file, and what it means."""
    write_columns(output.table)


def write_columns(file: Path | str) -> None:
    """Write the table of columns."""
    write_table(("file", "column", "meaning"), column_rows(), file)


def main(root: Path = Path()) -> None:
    """Renew the page of the configuration, and the table of columns."""
    page = root / "docs/configuration.md"
    write_text(filled(page.read_text(encoding="utf-8")), page)
    write_columns(root / COLUMNS)


if __name__ == "__main__":
    main()
