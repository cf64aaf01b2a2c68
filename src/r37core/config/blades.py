"""blades.yaml: blades by profiles, a base or another kind of entry, and their materials."""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cache, reduce
from operator import or_
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self

from pydantic import Discriminator, RootModel, Tag

from r37core.base.io import EntryRefused, TextFileError
from r37core.blade.definition import BladeDefinition, Definition, Shape
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import check_sweep, read_profile_table, stacking_rows, stacking_table_rows
from r37core.blade.section_changes import SectionChangeError
from r37core.blade.sense import check_profile_sense
from r37core.fem import material as fem_material
from r37core.mesh.disc import Disc
from r37core.rom.reduction_choice import PATCHES, QUADRATIC
from r37core.rom.region_choice import RegionChoice
from r37core.stress.statistic import Strengths

from .blade_kind import BladeKind, blade_kinds
from .blade_sections import (
    CONTACT_IN_WORDS,
    KINEMATICS_IN_WORDS,
    MATERIAL_KEYS,
    REQUIRED_OF_MATERIAL,
    Contact,
    Kinematics,
    MaterialSection,
    RegionSection,
    chosen_regions,
    refuse_taken_names,
)
from .declaring import si
from .document import ConfigError, Document, chain_of_bases
from .section import ByName, FileName, LeftOut, Name, Section, left_out, option, plain, refused
from .shape_keys import END_KEYS, SECTION_KEYS, SHARES, SHIFTS, ShapeKeys, changed_keys, changed_shape


class GivenShape(Section):
    """Source of a shape: profiles, or another blade."""

    profiles: FileName | LeftOut = left_out("Profile table (CSV)")
    base: Name | LeftOut = left_out("Blade that gives profiles or sections, sweep, lean, contact, kinematics and material")


class BladeEntry(ShapeKeys, GivenShape):
    """One blade: `profiles` with a material, or a `base` to start from, and at most one way to give sweep and lean.

    With `vary` or `designs` it is a family, many blades that differ in some numbers.
    """

    # as of BladeKind, and numbers in rows of a table
    varied: ClassVar[tuple[str, ...]] = ("chordwise_sweep_deg", *SHARES, *SECTION_KEYS, *END_KEYS, *MATERIAL_KEYS)
    refuse_several = (("profiles", "base"), *ShapeKeys.refuse_several)

    contact: Contact | LeftOut = left_out(f"{CONTACT_IN_WORDS}; by default that of the base, without one patches")
    kinematics: Kinematics | LeftOut = left_out(f"{KINEMATICS_IN_WORDS}; by default that of the base, without one quadratic")
    sense_check: bool = option("Whether a blade whose trailing edge leads is refused", True)
    stress_regions: ByName[RegionSection] | LeftOut = left_out("Regions beside those of config.yaml; by default of the base")
    material: MaterialSection = MaterialSection()

    def _check(self) -> None:
        refuse_taken_names(self.stress_regions or ())
        if self.profiles is None and self.base is None:
            raise refused("neither profiles nor base", "one of them, or sections, or a mesh or matrices of another program")


@cache
def blades_model() -> type[RootModel[dict[str, Any]]]:
    """Model of blades.yaml: entries by name, each of the kind that its keys tell."""
    kinds = blade_kinds()

    def kind_of(value: Any) -> str:
        """Name of the model of an entry, which messages know it by."""
        keys = value if isinstance(value, dict) else {getattr(value, "key", "")}
        return next((kind.__name__ for key, kind in kinds.items() if key in keys), BladeEntry.__name__)

    models: list[type[Section]] = [BladeEntry, *kinds.values()]
    entries = [Annotated[model, Tag(model.__name__)] for model in models]
    entry: Any = Annotated[reduce(or_, entries), Discriminator(kind_of)] if kinds else BladeEntry

    class Blades(RootModel[ByName[entry]]):
        """blades.yaml, blades by name."""

    return Blades


@dataclass(frozen=True)
class BladeSettings:
    """One blade: what gives its shape, its material (none for matrices), contact, kinematics, own regions of stress.

    `disc`: on which this program meshes it, None of one that is clamped or comes with its disc.
    """

    definition: Definition
    material: fem_material.Material | None
    contact: str
    kinematics: str
    stress_regions: Mapping[str, RegionChoice] = field(default_factory=dict, hash=False)
    disc: Disc | None = None

    @property
    def cyclic(self) -> Any:
        """The disc that it is a sector of, with its number of `sectors`; None of a blade alone."""
        return self.disc or self.definition.cyclic

    @property
    def has_profiles(self) -> bool:
        """True if it is given by profiles or sections, so that it can have another mesh."""
        return isinstance(self.definition, Shape)

    @property
    def shape(self) -> Shape:
        """The definition of a blade that has profiles."""
        assert isinstance(self.definition, Shape)
        return self.definition

    @property
    def is_matrices(self) -> bool:
        """True if it is given by matrices, so that it has one model and no stress."""
        return self.material is None

    @property
    def yield_stress(self) -> float:
        """Yield stress of the material (Pa); infinite where that is not known."""
        return math.inf if self.material is None else self.material.yield_stress

    @property
    def strengths(self) -> Strengths:
        """Strengths of the Goodman line (Pa); infinite where they are not known."""
        material = self.material
        if material is None:
            return Strengths()
        life = material.fatigue_cycles, material.fatigue_exponent
        return Strengths(material.fatigue_strength, material.ultimate_strength, *life)

    @property
    def elastic(self) -> Self:
        """Blade without the strengths of its material: a new one asks for no new model."""
        return self if self.material is None else replace(self, material=self.material.elastic)


def blade_settings(name: str, entries: Mapping[str, Any], root: Path, document: Document) -> BladeSettings:
    """The blade `name` of the checked `entries` of `document`, with its tables and files (relative to `root`) read.

    Raises ConfigError for a base that is not there or runs in a circle, a material with gaps, tables that cannot be read or
    have an impossible shape, and a mesh or matrices that are not there; a mesh itself is looked into when it is imported.
    """
    chain = chain_of_blades(name, entries, document)
    first, entry = chain[0], entries[chain[0]]
    check_sense = all(entries[link].sense_check for link in chain)
    if isinstance(entry, BladeKind) and not entry.has_material:
        if len(chain) > 1:
            raise document.refusal(f"'{first}', a blade of {entry.key}", "a blade with profiles or a mesh", chain[1], "base")
        definition = _described(entry, first, root, document, check_sense)
        return BladeSettings(definition, None, entry.contact, entry.kinematics)
    material = _material(chain, entries, document)
    contact, kinematics = (
        getattr(entries[link_with(key, chain, entries)], key) or otherwise
        for key, otherwise in (("contact", PATCHES), ("kinematics", QUADRATIC))
    )
    # some kinds have the regions of config.yaml alone
    own = (getattr(entries[link], "stress_regions", None) for link in reversed(chain))
    regions = chosen_regions(next(filter(None, own), {}))
    if isinstance(entry, BladeKind) and not entry.has_shape:
        for link in chain[1:]:
            keys = [key for key in (*SHIFTS, *SHARES, *SECTION_KEYS, "disc") if getattr(entries[link], key) is not None]
            if keys := keys if entries[link].sense_check else [*keys, "sense_check"]:
                raise document.refusal(
                    f"{keys[0]} with the {entry.key} of {first}", "another material, no other shape", link, keys[0]
                )
        with document.blamed((name, "material"), ValueError):
            material.check_units()
        definition = _described(entry, first, root, document, check_sense)
        return BladeSettings(definition, material, contact, kinematics, regions)
    shift: dict[str, Any] = {}
    place = name, "base"
    for link in chain:
        for key in SHIFTS:
            if getattr(entries[link], key) is not None:
                place = link, key
                shift = _shift(link, key, getattr(entries[link], key), root, document)
        shift = _scaled(link, entries[link], shift, document)
    shape = _shape(entry, first, root, document, check_sense).replaced(name=name, **shift)
    for link in chain:
        shape = _changed(link, entries[link], shape, document)
    with document.blamed(place, BladeShapeError, before=f"blade {name}: "):
        check_sweep(shift.get("stacking") or (), shape.height)
    disc = entries[link_with("disc", chain, entries)].disc
    return BladeSettings(shape, material, contact, kinematics, regions, disc and si(disc))


def _shape(entry: Any, first: str, root: Path, document: Document, check_sense: bool) -> Shape:
    """Shape of the first entry of a chain of bases, whose sense each of them may leave unchecked."""
    if isinstance(entry, BladeKind):
        return _described(entry, first, root, document, check_sense)
    with readable_table(entry.profiles, (first, "profiles"), document):
        profiles = tuple(read_profile_table(root / entry.profiles))
        if check_sense:
            check_profile_sense(profiles[-1])
    return BladeDefinition(first, profiles)


def _described(entry: BladeKind, name: str, root: Path, document: Document, check_sense: bool) -> Any:
    """The definition that an entry of another kind gives, with its files found."""
    with readable_table(getattr(entry, entry.key), (name, entry.key), document):
        return entry.definition(name, root, check_sense)


def chain_of_blades(name: str, entries: Mapping[str, Any], document: Document) -> list[str]:
    """Names from the entry without a base down to the blade `name`. Raises ConfigError as chain_of_bases."""
    return chain_of_bases(name, lambda link: getattr(entries[link], "base", None), entries, document, "blade")


def link_with(key: str, chain: Sequence[str], entries: Mapping[str, Any]) -> str:
    """Link of a blade's chain of bases that gives a key to it; the blade itself where none does."""
    return next((link for link in reversed(chain) if getattr(entries[link], key) is not None), chain[-1])


def _changed(blade: str, entry: ShapeKeys, shape: Shape, document: Document) -> Shape:
    """The shape, which has the changes of the base, with those that the entry of a blade makes on top."""
    try:
        return changed_shape(shape, entry)
    except SectionChangeError as error:
        keys = changed_keys(error)
        raise document.error((blade, keys[0]), f"blade {blade}: {' and '.join(keys)}: {error}") from None


def _material(chain: Sequence[str], entries: Mapping[str, Any], document: Document) -> fem_material.Material:
    material: dict[str, float] = {}
    for link in chain:
        material |= plain(entries[link].material)
    missing = [key for key in REQUIRED_OF_MATERIAL if key not in material]
    if missing:
        raise document.error((chain[-1], "material"), f"missing key {', '.join(missing)} (give it here or in the base)")
    made = si(MaterialSection(**material))
    with document.blamed((chain[-1], "material"), ValueError):
        made.check_strengths()
    return made


def _shift(blade: str, key: str, value: Any, root: Path, document: Document) -> dict[str, Any]:
    """Arguments of BladeDefinition for a sweep given in one of the three ways."""
    if key == "chordwise_sweep_deg":
        return {"chordwise_sweep_angle": math.radians(value), "stacking": None}
    if key == "stacking_table":
        with readable_table(value, (blade, key), document):
            rows = stacking_rows(stacking_table_rows(root / value, blade))
    else:
        with document.blamed((blade, key), BladeShapeError, before=f"blade {blade}: "):
            rows = stacking_rows([row.model_dump() for row in value])
    return {"stacking": rows, "chordwise_sweep_angle": None}


def _scaled(blade: str, entry: ShapeKeys, shift: dict[str, Any], document: Document) -> dict[str, Any]:
    """The shift with only a share of its table's sweep and lean."""
    if entry.sweep_percent is None and entry.lean_percent is None:
        return shift
    if shift.get("stacking") is None:
        key = "lean_percent" if entry.sweep_percent is None else "sweep_percent"
        raise document.error(
            (blade, key), f"blade {blade}: there is no table of sweep and lean to take a share of, here or in the base"
        )
    sweep, lean = (1.0 if share is None else share / 100.0 for share in (entry.sweep_percent, entry.lean_percent))
    return {**shift, "stacking": tuple((span, sweep * back, lean * side) for span, back, side in shift["stacking"])}


@contextmanager
def readable_table(file: str, path: tuple[str, str], document: Document, kind: str = "blade") -> Iterator[None]:
    """Turn the errors of reading a table `file`, that is named at `path` in the entry of a `kind`, into ConfigErrors."""
    try:
        yield
    except FileNotFoundError:
        raise document.error(path, f"there is no file {file}") from None
    except OSError as error:
        raise document.error(path, f"{file} cannot be read: {error.strerror}") from None
    except TextFileError as error:
        raise ConfigError(f"{file}:{error.line}: {kind} {path[0]}: {error.reason}") from None
    except BladeShapeError as error:
        raise ConfigError(f"{file}: {kind} {path[0]}: {error}") from None
    except EntryRefused as error:
        raise document.error((path[0], error.key or path[1]), str(error)) from None
