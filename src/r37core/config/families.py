"""Families of designs: one entry of blades.yaml or scenes.yaml with `vary` or `designs` is many blades or scenes."""

import copy
from collections.abc import Iterable, Mapping, Sequence, Sized
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any, Generic, TypeVar

from pydantic import ValidationError
from pydantic_core import PydanticCustomError

from r37core.base.io import TextFileError
from r37core.base.speeds import exact_text
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import read_designs

from .blade_sections import MaterialSection
from .blades import SHARES, BladeEntry, readable_table
from .document import ConfigError, Document
from .imported_entry import MatricesEntry, MeshEntry
from .messages import did_you_mean, explain, single_line
from .scenes import SceneEntry
from .section import check_name, check_names, plain
from .section_laws import SECTION_KEYS
from .varied import FAMILY_KEYS, LARGEST_FAMILY, Variation, is_family

AnyEntry = BladeEntry | MeshEntry | MatricesEntry | SceneEntry
"""One blade or scene, or one family."""

E = TypeVar("E", bound=AnyEntry)

_KINDS: dict[Any, str] = {BladeEntry: "blade", SceneEntry: "scene"}
"""Entries that may be a family, and what they are called."""

VARIED = (
    *("chordwise_sweep_deg", *SHARES, *SECTION_KEYS, *(f"{key}.{end}" for key in SECTION_KEYS for end in ("hub", "tip"))),
    *(f"material.{key}" for key in MaterialSection.model_fields),
)
"""Keys with a number that may vary in a family, besides those in the rows of a table."""


@dataclass(frozen=True)
class Family:
    """Designs that differ in some `keys`, dotted as in `vary`. `designs`: blade or scene -> values, one for each key."""

    keys: tuple[str, ...]
    designs: dict[str, tuple[float, ...]]

    def values(self, design: str) -> dict[str, float]:
        """Key -> value of a design."""
        return dict(zip(self.keys, self.designs[design], strict=True))


@dataclass(frozen=True)
class Designs(Generic[E]):
    """All blades or scenes of a file: `entries` with a design in place of every family, and the `families` by name.

    `document`: where they stand; a design where its family does.
    """

    entries: dict[str, E]
    families: dict[str, Family]
    document: Document

    @property
    def names(self) -> list[str]:
        """Names of all entries and families."""
        return [*self.entries, *self.families]

    @property
    def family_of(self) -> dict[str, str]:
        """Design -> family."""
        return {design: name for name, family in self.families.items() for design in family.designs}

    def named(self, names: Iterable[str]) -> list[str]:
        """Entries of these names, and designs of families of these names, each once."""
        several = [list(self.families[name].designs) if name in self.families else [name] for name in names]
        return list(dict.fromkeys(name for names in several for name in names))

    def locations_of_keys(self, blade: str) -> dict[str, str]:
        """Key of a blade's entry, or of the entry that its base has it from -> `file:line: blade.key`."""
        entry: Any = self.entries[blade]
        if base := getattr(entry, "base", None):
            return self.locations_of_keys(base)
        return {key: f"{self.document.location((blade, key))}: {blade}.{key}" for key in type(entry).model_fields}


def expanded_families(entries: Mapping[str, E], root: Path, document: Document) -> Designs[E]:
    """The entries with every family replaced by its designs. Raises ConfigError, with the place in `document`."""
    made: dict[str, E] = {}
    families: dict[str, Family] = {}
    locations = dict(document.locations)
    for name, entry in entries.items():
        if not is_family(entry):
            made[name] = entry
            continue
        families[name] = family = _family(name, entry, root, document)
        for design in family.designs:
            if design in entries or design in made:
                allowed = f"designs that are not named like another {_kind(entry)}"
                raise document.refusal((name,), f"the design '{design}'", allowed)
            made[design] = design_entry(name, entry, family.values(design), design, document)
            locations |= {(design, *path[1:]): location for path, location in document.locations.items() if path[:1] == (name,)}
        try:
            check_names(made)
            for design in family.designs:
                check_name(design)
        except PydanticCustomError as error:
            raise document.error((name,), str(error)) from None
    try:
        check_names(made)
    except PydanticCustomError as error:
        raise document.error((list(made)[-1],), str(error)) from None
    return Designs(made, families, replace(document, locations=locations))


def _kind(entry: Any) -> str:
    return next(kind for model, kind in _KINDS.items() if isinstance(entry, model))


def _family(name: str, entry: Any, root: Path, document: Document) -> Family:
    if entry.designs is not None:
        return _table_family(name, entry, root, document)
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
    designs = {design_name(name, row): tuple(row) for row in rows}
    if len(designs) < len(rows):
        raise document.refusal((name, "vary"), "the same values twice", "designs that differ")
    return Family(tuple(values), designs)


def _check_size(designs: Sized, family: str, key: str, document: Document) -> None:
    if len(designs) > LARGEST_FAMILY:
        raise document.refusal((family, key), f"{len(designs)} designs", f"at most {LARGEST_FAMILY}")


def _table_family(name: str, entry: Any, root: Path, document: Document) -> Family:
    file = entry.designs
    with readable_table(file, (name, "designs"), document):
        try:
            keys, rows = read_designs(root / file, _kind(entry))
        except (TextFileError, BladeShapeError) as error:
            raise ConfigError(f"{file}: family {name}: {error}") from None
    _check_size(rows, name, "designs", document)
    return Family(keys, rows)


def design_name(family: str, values: Sequence[float]) -> str:
    """Name of a design by its values: Sweep_-50, Grid_2p5_10."""
    return "_".join([family, *(exact_text(value).replace(".", "p").replace("+", "") for value in values)])


def design_entry(family: str, entry: E, values: Mapping[str, float], design: str, document: Document) -> E:
    """The entry of one design, checked like one that a user wrote."""
    model = next(model for model in _KINDS if isinstance(entry, model))
    content = entry.model_dump(exclude_none=True, exclude_unset=True, exclude=set(FAMILY_KEYS))
    for key, value in values.items():
        _check_varies(key, family, entry, design, document)
        try:
            content = changed_content(content, key.split("."), value)
        except (AttributeError, KeyError, IndexError, TypeError, ValueError):
            raise document.error(
                (family,),
                f"design {design}: found no {key} to vary; rows of a table stand in the entry, counted from 0, and hub and "
                "tip stand where it has no number",
            ) from None
    try:
        return model.model_validate(content)
    except ValidationError as error:
        path, named, text = explain(error, content, model)
        at = (family, "vary", ".".join(map(str, path)))
        raise document.error(at, f"design {design}: {text}", (family, *named)) from None


def _check_varies(key: str, family: str, entry: Any, design: str, document: Document) -> None:
    """ConfigError for a key that does not begin like one that an entry may vary."""
    first = key.split(".")[0]
    if first in type(entry).model_fields and first not in FAMILY_KEYS:
        return
    known = VARIED if isinstance(entry, BladeEntry) else tuple(numbers_of(plain(entry)))
    hint = did_you_mean(key, known)
    for model, kind in _KINDS.items():
        if first in model.model_fields and not isinstance(entry, model):
            search = f", in a search as scene.{key}" if model is SceneEntry else ""
            hint = f" (a number of a {kind} varies in {kind}s.yaml{search})"
    raise document.error(
        (family,), f"design {design}: found unknown key {single_line(key)}; allowed keys: {', '.join(known)}{hint}"
    )


def numbers_of(content: Mapping[str, Any], path: str = "") -> dict[str, float]:
    """Dotted key -> value of all numbers in the sections of an entry but those that count something."""
    numbers: dict[str, float] = {}
    for key, value in content.items():
        if isinstance(value, Mapping):
            numbers |= numbers_of(value, f"{path}{key}.")
        elif isinstance(value, float):
            numbers[path + key] = value
    return numbers


def changed_content(content: dict[str, Any], path: Sequence[str], value: Any) -> dict[str, Any]:
    """A copy of the content with one value set; sections that are not there are made, rows of a list are not."""
    changed = copy.deepcopy(content)
    inner: Any = changed
    for step in path[:-1]:
        inner = inner[int(step)] if isinstance(inner, list) else inner.setdefault(step, {})
    if isinstance(inner, list):
        raise TypeError
    # for keys that count; others take one, too
    inner[path[-1]] = int(value) if isinstance(value, float) and value.is_integer() else value
    return changed
