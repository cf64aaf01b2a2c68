"""Families of designs: one entry of blades.yaml with `vary` or `designs` is many blades."""

import copy
from collections.abc import Iterable, Mapping, Sequence, Sized
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from pydantic_core import PydanticCustomError

from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import read_designs
from r37core.io import TextFileError
from r37core.speeds import exact_text

from .blade_sections import MaterialSection
from .blades import LARGEST_FAMILY, SHARES, BladeEntry, Variation, readable_table
from .document import ConfigError, Document
from .imported_entry import MatricesEntry, MeshEntry
from .messages import did_you_mean, explain, single_line
from .scenes import SceneEntry
from .section import check_name, check_names
from .section_laws import SECTION_KEYS

AnyEntry = BladeEntry | MeshEntry | MatricesEntry
"""One blade, or one family."""

VARIED = (
    *("chordwise_sweep_deg", *SHARES, *SECTION_KEYS, *(f"{key}.{end}" for key in SECTION_KEYS for end in ("hub", "tip"))),
    *(f"material.{key}" for key in MaterialSection.model_fields),
)
"""Keys with a number that may vary in a family, besides those in the rows of a table."""


@dataclass(frozen=True)
class Family:
    """Designs that differ in some `keys`, dotted as in `vary`. `designs`: blade -> values, one for each key."""

    keys: tuple[str, ...]
    designs: dict[str, tuple[float, ...]]


@dataclass(frozen=True)
class Designs:
    """All blades of blades.yaml: `entries` with a design in place of every family, and the `families` by name.

    `document`: where they stand; a design where its family does.
    """

    entries: dict[str, AnyEntry]
    families: dict[str, Family]
    document: Document

    @property
    def family_of(self) -> dict[str, str]:
        """Design -> family."""
        return {design: name for name, family in self.families.items() for design in family.designs}

    def named(self, names: Iterable[str]) -> list[str]:
        """Blades of these names, and designs of families of these names, each once."""
        several = [list(self.families[name].designs) if name in self.families else [name] for name in names]
        return list(dict.fromkeys(name for names in several for name in names))

    def locations_of_keys(self, blade: str) -> dict[str, str]:
        """Key of a blade's entry, or of the entry that its base has it from -> `file:line: blade.key`."""
        entry = self.entries[blade]
        if base := getattr(entry, "base", None):
            return self.locations_of_keys(base)
        return {key: f"{self.document.location((blade, key))}: {blade}.{key}" for key in type(entry).model_fields}


def expanded_families(entries: Mapping[str, AnyEntry], root: Path, document: Document) -> Designs:
    """The entries with every family replaced by its designs. Raises ConfigError, with the place in `document`."""
    made: dict[str, AnyEntry] = {}
    families: dict[str, Family] = {}
    locations = dict(document.locations)
    for name, entry in entries.items():
        if not isinstance(entry, BladeEntry) or (entry.vary is None and entry.designs is None):
            made[name] = entry
            continue
        families[name] = family = _family(name, entry, root, document)
        for design, values in family.designs.items():
            if design in entries or design in made:
                raise document.refusal((name,), f"the design '{design}'", "designs that are not named like another blade")
            made[design] = design_entry(name, entry, dict(zip(family.keys, values, strict=True)), design, document)
            locations |= {(design, *path[1:]): location for path, location in document.locations.items() if path[:1] == (name,)}
        try:
            check_names(made)
            for design in family.designs:
                check_name(design)
        except PydanticCustomError as error:
            raise document.error((name,), str(error)) from None
    return Designs(made, families, replace(document, locations=locations))


def _family(name: str, entry: BladeEntry, root: Path, document: Document) -> Family:
    if entry.designs is not None:
        return _table_family(name, entry.designs, root, document)
    assert entry.vary is not None
    values = {key: way.values() if isinstance(way, Variation) else list(map(float, way)) for key, way in entry.vary.items()}
    if entry.combine == "pairs":
        lengths = {key: len(several) for key, several in values.items()}
        if len(set(lengths.values())) > 1:
            counted = ", ".join(f"{key} {length}" for key, length in lengths.items())
            raise document.refusal((name, "vary"), f"{counted} values", "as many of each key, with combine: pairs")
        rows = list(zip(*values.values(), strict=True))
    else:
        rows = list(product(*values.values()))
    _check_size(rows, name, "vary", document)
    return Family(tuple(values), {design_name(name, row): tuple(row) for row in rows})


def _check_size(designs: Sized, family: str, key: str, document: Document) -> None:
    if len(designs) > LARGEST_FAMILY:
        raise document.refusal((family, key), f"{len(designs)} designs", f"at most {LARGEST_FAMILY}")


def _table_family(name: str, file: str, root: Path, document: Document) -> Family:
    with readable_table(file, (name, "designs"), document):
        try:
            keys, rows = read_designs(root / file)
        except (TextFileError, BladeShapeError) as error:
            raise ConfigError(f"{file}: family {name}: {error}") from None
    _check_size(rows, name, "designs", document)
    return Family(keys, rows)


def design_name(family: str, values: Sequence[float]) -> str:
    """Name of a design by its values: Sweep_-50, Grid_2p5_10."""
    return "_".join([family, *(exact_text(value).replace(".", "p").replace("+", "") for value in values)])


def design_entry(family: str, entry: BladeEntry, values: Mapping[str, float], design: str, document: Document) -> BladeEntry:
    """The entry of one design, checked like one that a user wrote."""
    content = entry.model_dump(exclude_none=True, exclude_unset=True, exclude={"vary", "combine", "designs"})
    for key, value in values.items():
        _check_varies(key, family, design, document)
        try:
            content = changed_content(content, key.split("."), value)
        except (KeyError, IndexError, TypeError, ValueError):
            raise document.error(
                (family,),
                f"design {design}: found no {key} to vary; rows of a table stand in the entry, counted from 0, and hub and "
                "tip stand where it has no number",
            ) from None
    try:
        return BladeEntry.model_validate(content)
    except ValidationError as error:
        path, named, text = explain(error, content, BladeEntry)
        at = (family, "vary", ".".join(map(str, path)))
        raise document.error(at, f"design {design}: {text}", (family, *named)) from None


def _check_varies(key: str, family: str, design: str, document: Document) -> None:
    """ConfigError for a key that does not begin like one of VARIED."""
    first = key.split(".")[0]
    if first in BladeEntry.model_fields:
        return
    hint = did_you_mean(key, VARIED)
    if first in SceneEntry.model_fields:
        hint = f" (a number of a scene varies under tolerances.of_scenes, in a search as scene.{key}, or as several scenes)"
    allowed = f"{', '.join(VARIED)}{hint}"
    raise document.error((family,), f"design {design}: found unknown key {single_line(key)}; allowed keys: {allowed}")


def changed_content(content: dict[str, Any], path: Sequence[str], value: Any) -> dict[str, Any]:
    """A copy of the content with one value set; sections that are not there are made, rows of a list are not."""
    changed = copy.deepcopy(content)
    inner: Any = changed
    for step in path[:-1]:
        inner = inner[int(step)] if isinstance(inner, list) else inner.setdefault(step, {})
    if isinstance(inner, list):
        raise TypeError
    inner[path[-1]] = value
    return changed
