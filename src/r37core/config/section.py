"""Base of the models of all configuration files: strictness, and the kinds of values."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Generic, Literal, Self, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Discriminator, Field, Tag, WithJsonSchema, model_validator
from pydantic.json_schema import SkipJsonSchema
from pydantic_core import PydanticCustomError

from r37core.base.yaml_file import scalar

T = TypeVar("T")


@dataclass(frozen=True)
class ExtensionSection(Generic[T]):
    """A section of config.yaml that an extension brings: its `name`, and `kind` and `default` as pydantic takes them."""

    name: str
    kind: type[T]
    default: Any


class Without(Enum):
    """Mark in place of a value, in a document that lies on top of another: the key is left out, if it is there."""

    KEY = "left out"


class Section(BaseModel):
    """A mapping of a configuration file: only declared keys, no null, no text for a number, nothing infinite.

    `declares`: dataclass that declares its keys and is made of it (r37core.config.declaring.si). `one_of`, `refuse_several`:
    keys of which an entry has exactly one, or at most one, other than its default.
    """

    declares: ClassVar[Any] = None
    one_of: ClassVar[tuple[tuple[str, ...], ...]] = ()
    refuse_several: ClassVar[tuple[tuple[str, ...], ...]] = ()

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False, defer_build=True)

    if TYPE_CHECKING:
        # keys that a dataclass of the computation declares (r37core.config.declaring)
        def __getattr__(self, key: str) -> Any: ...

    @model_validator(mode="before")
    @classmethod
    def _without_nulls(cls, data: Any) -> Any:
        if isinstance(data, Mapping):
            for key, value in data.items():
                if value is None and key in cls.model_fields:
                    raise refused("nothing", "a value, or the key left out", key)
            return {key: value for key, value in data.items() if value is not Without.KEY or key not in cls.model_fields}
        return data

    @model_validator(mode="after")
    def _checked(self) -> Self:
        for keys in (*self.one_of, *self.refuse_several):
            present = [key for key in keys if getattr(self, key) != type(self).model_fields[key].default]
            if len(present) > 1:
                raise refused(" and ".join(present), "one of them", present[1], kind="several")
            if not present and keys in self.one_of:
                raise refused(f"neither {' nor '.join(keys)}", "one of them")
        self._check()
        return self

    def _check(self) -> None:
        """Raise the error (`refused`) of keys that do not go together."""

    def parts(self) -> dict[str, Any]:
        """Fields of the dataclass that are made otherwise than of a key each."""
        return {}


def plain(section: BaseModel) -> dict[str, Any]:
    """A section as a dictionary of plain values, which Snakemake can compare and a job can read without the models."""
    return section.model_dump(exclude_none=True)


def refused(value: str, allowed: str, *at: str | int, kind: Literal["refused", "several"] = "refused") -> PydanticCustomError:
    """The error of a validator that compares several keys; `at`: path of the one to blame, seen from the validated section.

    `kind`: "several" of keys of which one is allowed.
    """
    return PydanticCustomError(kind, "found {found}; allowed: {allowed}", {"at": at, "found": value, "allowed": allowed})


def check_table(section: Section, places: str, values: str, at_zero: str = "") -> None:
    """Raise the error of two lists, by their keys, that are no table: ascending places, and as many values.

    `at_zero`: key of what holds at place 0, where a table of changes begins with 0.
    """
    x, y = getattr(section, places), getattr(section, values)
    if (at_zero and x[0]) or any(after <= before for before, after in pairwise(x)):
        raise refused(f"{x}", f"ascending numbers{', the first of them 0' if at_zero else ''}", places)
    if len(x) != len(y):
        raise refused(f"{len(y)} numbers for {len(x)} {places}", "one for each", values)
    if at_zero and y[0]:
        raise refused(f"{y[0]:g} at the first of {places}", f"0; the clearance there is {at_zero}", values, 0)


def _each_once(values: list[T]) -> list[T]:
    seen: set[T] = set()
    for number, value in enumerate(values):
        if value in seen:
            raise refused(f"{value!r} twice", "each once", number)
        seen.add(value)
    return values


TEXT_PATTERN = r"\S"
NAME_PATTERN = r"^[A-Za-z0-9][A-Za-z0-9-]*(_[A-Za-z0-9-]+)*$"


def check_name(name: str) -> str:
    """The name itself; the error of one that cannot be part of file names."""
    if not re.fullmatch(NAME_PATTERN, name) or len(name) > 60 or name == "all" or not isinstance(scalar(name), str):
        allowed = "a name of letters, digits, hyphens and single underscores between them, of at most 60 characters, that is"
        raise refused(repr(name), f"{allowed} neither 'all' nor a number, true, false or null in YAML")
    return name


Name = Annotated[str, AfterValidator(check_name), WithJsonSchema({"type": "string", "pattern": NAME_PATTERN, "maxLength": 60})]
"""Name of a blade, scene, level or run: part of file names, where two underscores separate names."""

EachOnce = Annotated[list[T], AfterValidator(_each_once)]
"""A list with no value twice."""

Unique = Annotated[list[T], Field(min_length=1), AfterValidator(_each_once)]
"""A list with at least one value and none twice."""

Names = Unique[Name]


def either(value: Any, *sections: Any, rows: Any = None) -> Any:
    """Type of a key with a value of the type `value`, one of some sections in its place, or a list of the type `rows`.

    Of several sections a mapping is the one whose keys it has most of.
    """
    kinds: Any = Annotated[value, Tag("value")]
    for tagged in sections:
        kinds |= Annotated[tagged, Tag(tagged.__name__)]
    if rows is not None:
        kinds |= Annotated[rows, Tag("rows")]

    def kind_of(content: Any) -> str:
        if isinstance(content, dict) and sections:
            return max(sections, key=lambda section: len(section.model_fields.keys() & content.keys())).__name__
        if isinstance(content, Section) and sections:
            return type(content).__name__
        return "rows" if rows and isinstance(content, list) else "value"

    return Annotated[kinds, Discriminator(kind_of)]


AllOrNames: Any = either(Literal["all"], rows=Names)


def _printable(name: str) -> str:
    if not name.isprintable():
        raise refused(repr(name), "a name without line breaks and other invisible characters")
    return name


FileName = Annotated[str, Field(min_length=1, max_length=1000, pattern=TEXT_PATTERN), AfterValidator(_printable)]
LeftOut = SkipJsonSchema[None]
"""Type of an optional key that is not given; null is refused."""


def option(description: str, default: Any = ..., **bounds: Any) -> Any:
    """The field of a key: its description, its default (none of a key that is required), and bounds as pydantic takes them."""
    return Field(default=default, description=description, **bounds)


def left_out(description: str) -> Any:
    """The field of an optional key without a default."""
    return option(description, None)


Speed = Annotated[float, Field(ge=1e-3, le=1e6)]
"""An angular speed (rad/s)."""

Rpm = Annotated[float, Field(ge=0.01, le=9.5e6)]
"""An angular speed in revolutions per minute."""


def check_names(names: dict[str, T]) -> dict[str, T]:
    """The entries by name; raises the error of two names that differ in capitals only: some systems would have one file."""
    seen: dict[str, str] = {}
    for name in names:
        other = seen.setdefault(name.lower(), name)
        if other != name:
            raise refused(f"'{name}' beside '{other}'", "names that differ in more than capitals", name)
    return names


Named = Annotated[dict[Name, T], AfterValidator(check_names)]
"""Entries by name, of which there may be none."""

ByName = Annotated[dict[Name, T], Field(min_length=1), AfterValidator(check_names)]
"""The content of a file with entries by name."""
