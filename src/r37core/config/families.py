"""Families of designs: one entry of blades.yaml or scenes.yaml with `vary` or `designs` is many blades or scenes."""

from collections.abc import Iterable, Mapping, Sequence, Sized
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any, Generic, TypeVar

from pydantic import RootModel

from r37core.base.speeds import exact_text
from r37core.base.varied_number import BLADE, SCENE, numbers_in
from r37core.blade.profile_tables import read_designs

from .blade_kind import BladeKind
from .blades import BladeEntry, readable_table
from .changed_numbers import ImpossibleValueError, entry_with, kind_of
from .document import Document
from .messages import did_you_mean, single_line
from .named_files import named_file
from .scenes import SceneEntry
from .section import ByName, Section, plain
from .varied import FAMILY_KEYS, LARGEST_FAMILY, Variation, is_family

AnyEntry = BladeEntry | BladeKind | SceneEntry
"""One blade or scene, or one family."""

E = TypeVar("E", bound=AnyEntry)

_KINDS: dict[type[Section], str] = {BladeEntry: BLADE, SceneEntry: SCENE}
"""Entries of the two files, and what they are called."""


Family = dict[str, dict[str, float]]
"""Designs of a family: name -> values by the keys that vary, dotted as in `vary`, of all designs the same keys."""


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
        return {design: name for name, family in self.families.items() for design in family}

    def families_of(self, names: Iterable[str]) -> dict[str, Family]:
        """Families with those of their designs that are among these names, where there are some."""
        there = set(names)
        families = {
            name: {design: values for design, values in family.items() if design in there}
            for name, family in self.families.items()
        }
        return {name: family for name, family in families.items() if family}

    def named(self, names: Iterable[str]) -> list[str]:
        """Entries of these names, and designs of families of these names, each once."""
        several = [self.families.get(name, [name]) for name in names]
        return list(dict.fromkeys(name for names in several for name in names))

    def locations_of_keys(self, blade: str) -> dict[str, str]:
        """Key of a blade's entry, or of the entry that its base has it from -> `file:line: blade.key`."""
        entry: Any = self.entries[blade]
        base = getattr(entry, "base", None)
        keys = entry.model_fields_set if base else type(entry).model_fields
        own = {key: f"{self.document.location((blade, key))}: {blade}.{key}" for key in keys}
        return (self.locations_of_keys(base) if base else {}) | own


def expanded_families(entries: Mapping[str, E], root: Path, document: Document) -> Designs[E]:
    """The entries with every family replaced by its designs. Raises ConfigError, with the place in `document`."""
    made: dict[str, E] = {}
    families: dict[str, Family] = {}
    for name, entry in entries.items():
        if not is_family(entry):
            made[name] = entry
            continue
        families[name] = family = _family(name, entry, root, document)
        for design, values in family.items():
            if design in entries or design in made:
                allowed = f"designs that are not named like another {kind_of(entry)}"
                raise document.refusal(f"the design '{design}'", allowed, name)
            made[design] = design_entry(name, entry, values, design, document)
    family_of = {design: name for name, family in families.items() for design in family}
    document = replace(document, sources={**document.sources, **family_of})
    replace(document, content=dict.fromkeys(made)).check(_NAMES)
    return Designs(made, families, document)


_NAMES = RootModel[ByName[Any]]
"""Entries whose names alone are checked."""


def _family(name: str, entry: Any, root: Path, document: Document) -> Family:
    if entry.designs is not None:
        file = named_file(entry.designs, root / document.name, root)
        with readable_table(file, (name, "designs"), document, "family"):
            designs = read_designs(root / file, kind_of(entry))
        _check_size(designs, name, "designs", document)
        return designs
    values = {key: way.values() if isinstance(way, Variation) else list(map(float, way)) for key, way in entry.vary.items()}
    rows = list(product(*values.values()))
    _check_size(rows, name, "vary", document)
    designs = {design_name(name, row): dict(zip(values, row, strict=True)) for row in rows}
    if len(designs) < len(rows):
        raise document.refusal("the same values twice", "designs that differ", name, "vary")
    return designs


def _check_size(designs: Sized, family: str, key: str, document: Document) -> None:
    if len(designs) > LARGEST_FAMILY:
        raise document.refusal(f"{len(designs)} designs", f"at most {LARGEST_FAMILY}", family, key)


def design_name(family: str, values: Sequence[float]) -> str:
    """Name of a design by its values: Sweep_-50, Grid_2p5_10."""
    return "_".join([family, *(exact_text(value).replace(".", "p").replace("+", "") for value in values)])


def design_entry(family: str, entry: E, values: Mapping[str, float], design: str, document: Document) -> E:
    """The entry of one design, checked like one that a user wrote."""
    for key in values:
        _check_varies(key, family, entry, design, document)
    try:
        return entry_with(entry, values)
    except ImpossibleValueError as error:
        key = error.number.key
        shown = (family, *filter(None, key.split(".")))
        raise document.error((family, "vary", key), f"design {design}: {error}", shown) from None


def _check_varies(key: str, family: str, entry: Any, design: str, document: Document) -> None:
    """ConfigError for a key that does not begin like one that an entry may vary."""
    first, keys = key.split(".")[0], type(entry).model_fields
    known = numbers_in(plain(entry)) if isinstance(entry, SceneEntry) else entry.varied
    vary = {name.split(".")[0] for name in known} if isinstance(entry, BladeKind) else keys
    if first in vary and first not in FAMILY_KEYS:
        return
    hint = did_you_mean(key, known)
    for model, kind in _KINDS.items():
        if first in model.model_fields and kind != kind_of(entry):
            search = f", in a search as scene.{key}" if model is SceneEntry else ""
            hint = f" (a number of a {kind} varies in {kind}s.yaml{search})"
    reason = f"design {design}: found {'' if first in keys else 'unknown key '}{single_line(key)}"
    raise document.error((family,), f"{reason}; allowed keys: {', '.join(known)}{hint}")
