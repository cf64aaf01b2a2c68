"""JSON schemas of the configuration files, for editors, in config/schemas.

`python -m r37core.product.schemas` writes them.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from r37core.base.io import write_text
from r37core.config.blades import blades_model
from r37core.config.fidelity import Levels
from r37core.config.scenes import Scenes

from .extensions import CONFIG

MODELS: dict[str, type[BaseModel]] = {"config": CONFIG, "blades": blades_model(), "scenes": Scenes, "fidelity": Levels}

_ON_BASE = "OnBase"
"""End of the names of parts that need no key."""


def schemas() -> dict[str, str]:
    """File name -> content. `changes` is for files that lie on top of config.yaml, where nothing is required."""
    made = {name: model.model_json_schema() for name, model in MODELS.items()}
    made |= {name: _based_entries(made[name]) for name in ("blades", "scenes")}
    made["changes"] = {key: value for key, value in made["config"].items() if key != "required"}
    dialect = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return {f"{name}.schema.json": json.dumps(dialect | made[name], indent=1, ensure_ascii=False) + "\n" for name in made}


def _based_entries(schema: dict[str, Any]) -> dict[str, Any]:
    """The schema of entries by name, where one with a `base` needs no key, and null leaves out what the base has."""
    ((name, entry),) = schema["patternProperties"].items()
    either = {"if": {"required": ["base"]}, "then": _based(entry), "else": entry}
    parts = {f"{part}{_ON_BASE}": _based(content) for part, content in schema["$defs"].items()}
    return {**schema, "$defs": schema["$defs"] | parts, "patternProperties": {name: either}}


def _based(part: Mapping[str, Any]) -> dict[str, Any]:
    """The part of a schema for what lies on top of a base; entries of lists are not joined with those of the base."""
    changed = {key: content for key, content in part.items() if key != "required"}
    if "$ref" in part:
        changed["$ref"] = part["$ref"] + _ON_BASE
    for key in {"anyOf", "oneOf"} & part.keys():
        # without its keys a value may fit several
        changed["anyOf"] = [_based(choice) for choice in changed.pop(key)]
    if "properties" in part:
        changed["properties"] = {
            key: {"if": {"type": "null"}, "else": _based(content)} for key, content in part["properties"].items()
        }
    return changed


def main(folder: Path = Path("config/schemas")) -> None:
    """Write all of them."""
    for name, text in schemas().items():
        write_text(text, folder / name)


if __name__ == "__main__":
    main()
