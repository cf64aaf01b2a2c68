"""Blades and scenes with other values of some numbers, checked like entries that a user wrote."""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, Field, ValidationError, create_model

from r37core.base.units import si_name
from r37core.base.varied import BLADE, SCENE, VariedNumber, numbers_in, with_value
from r37core.base.yaml_file import KeyPath
from r37core.blade.definition import BladeDefinition
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import check_sweep
from r37core.blade.section_changes import SectionChangeError
from r37core.contact.scene import Scene

from .blade_sections import MaterialSection
from .blades import SHARES, BladeSettings, SweepLean, TableShare
from .declaring import si_fields
from .document import Document
from .messages import did_you_mean, explain, single_line
from .scenes import SceneEntry
from .section import Section, plain
from .section_laws import END_KEYS, SECTION_KEYS, bounds_of, changed_keys, linear_law, neutral_value, profiles_by_laws
from .varied import FAMILY_KEYS

E = TypeVar("E", bound=Section)

_MATERIAL = "material."

MATERIAL_KEYS = tuple(_MATERIAL + key for key in MaterialSection.model_fields)
"""Numbers of a blade's material."""

_SHAPE: dict[str, Any] = {
    **dict.fromkeys(SHARES, TableShare),
    "sweep_cm": Annotated[float, Field(ge=-100, le=100)],
    "lean_deg": Annotated[float, Field(gt=-90, lt=90)],
    **{key: bounds_of(key) for key in (*SECTION_KEYS, *END_KEYS)},
}
"""Numbers of a blade's shape that a member may have, and their bounds."""

_Shape = create_model(  # type: ignore[call-overload]
    "_Shape",
    __base__=Section,
    **{key.replace(".", "_at_"): (kind, Field(neutral_value(key), alias=key)) for key, kind in _SHAPE.items()},
)

BLADE_KEYS = (*MATERIAL_KEYS, *_SHAPE)
"""Numbers of a blade that spread. `sweep_cm` and `lean_deg` are added at the tip, and below in proportion to the span. Changes
of profiles that the entry of a blade has stand under these changes."""


class ImpossibleValueError(ValueError):
    """Value that a blade or a scene cannot have; `number`: the one to blame, or the key of what it leads to."""

    def __init__(self, number: VariedNumber, text: str):
        super().__init__(text)
        self.number = number

    def place(self, known: Collection[VariedNumber]) -> tuple[tuple[str, ...], str]:
        """Path among tolerances of the `known` numbers, and the message there."""
        section, key = self.number.section, self.number.key
        return ((section, key), str(self)) if self.number in known else ((section,), f"{key}: {self}")


def scene_numbers(entry: SceneEntry) -> dict[str, float]:
    """Dotted key -> value of all numbers of a scene but those that count something or stop a run."""
    return {key: value for key, value in numbers_in(plain(entry)).items() if key != "divergence_limit_m"}


def blade_number(blade: BladeSettings, key: str) -> float | None:
    """Nominal value of one of BLADE_KEYS in its unit, None if a blade has none; ValueError for shifts of a chordwise sweep."""
    if key.startswith(_MATERIAL):
        value = math.inf if blade.material is None else getattr(blade.material, si_name(key.removeprefix(_MATERIAL))[0])
        return value if math.isfinite(value) else None
    shape = blade.definition
    if not isinstance(shape, BladeDefinition) or (key in SHARES and shape.stacking is None):
        return None
    if key in ("sweep_cm", "lean_deg") and shape.chordwise_sweep_angle is not None:
        raise ValueError(f"{key} with {shape.name}, whose sweep is chordwise")
    return neutral_value(key)


def nominal_value(number: VariedNumber, blade: BladeSettings, scene: Mapping[str, float]) -> float | None:
    """Value of a number of a blade, or of a scene of these numbers. Raises ValueError as `blade_number`."""
    return blade_number(blade, number.key) if number.kind == BLADE else scene.get(number.key)


def check_known(numbers: Iterable[VariedNumber], scene_keys: Iterable[str], document: Document, path: KeyPath) -> None:
    """Check that blades, or scenes of these keys, have the numbers that stand at `path` of a document. Raises ConfigError."""
    scenes = list(dict.fromkeys(scene_keys))
    for number in numbers:
        known: Sequence[str] = BLADE_KEYS if number.kind == BLADE else scenes
        if number.key not in known:
            what = "one of" if number.kind == BLADE else "a number of the scenes, by its dotted key:"
            allowed = f"{what} {', '.join(known)}{did_you_mean(number.key, known)}"
            raise document.refusal((*path, number.section, number.key), single_line(number.key), allowed)


def entry_with(entry: E, values: Mapping[str, float]) -> E:
    """The entry, without a family's keys, with values at dotted keys. Raises ImpossibleValueError."""
    kind = SCENE if isinstance(entry, SceneEntry) else BLADE
    content = entry.model_dump(exclude_none=True, exclude_unset=True, exclude=set(FAMILY_KEYS))
    for key, value in values.items():
        try:
            content = with_value(content, key, value)
        except (AttributeError, KeyError, IndexError, TypeError, ValueError):
            stand = "rows of a table stand in the entry, counted from 0, and hub and tip stand where it has no number"
            raise ImpossibleValueError(VariedNumber(kind, key), f"found no {key} to vary; {stand}") from None
    return _checked(type(entry), content, kind)


def changed_scene(entry: SceneEntry, changes: Mapping[str, float]) -> Scene:
    """The scene with values at dotted keys replaced. Raises ImpossibleValueError."""
    return entry_with(entry, changes).scene()


def changed_blade(blade: BladeSettings, changes: Mapping[str, float]) -> BladeSettings:
    """The blade with values of BLADE_KEYS replaced. Raises ImpossibleValueError."""
    changed = blade
    material = {key.removeprefix(_MATERIAL): value for key, value in changes.items() if key.startswith(_MATERIAL)}
    if material and blade.material is not None:
        other = replace(blade.material, **si_fields(_checked(MaterialSection, material, BLADE, _MATERIAL)))
        try:
            other.check_strengths()
        except ValueError as error:
            raise ImpossibleValueError(VariedNumber(BLADE, _MATERIAL + next(iter(material))), str(error)) from None
        changed = replace(changed, material=other)
    shape = {key: value for key, value in changes.items() if key in _SHAPE}
    if shape and isinstance(blade.definition, BladeDefinition):
        changed = replace(changed, definition=_changed_shape(blade.definition, shape))
    return changed


def changed_pair(blade: BladeSettings, scene: SceneEntry, values: Mapping[VariedNumber, float]) -> tuple[BladeSettings, Scene]:
    """A blade and a scene with values of some of their numbers. Raises ImpossibleValueError."""
    of_blade, of_scene = (
        {number.key: value for number, value in values.items() if number.kind == kind} for kind in (BLADE, SCENE)
    )
    return changed_blade(blade, of_blade), changed_scene(scene, of_scene)


def _changed_shape(definition: BladeDefinition, changes: Mapping[str, float]) -> BladeDefinition:
    shape = _checked(_Shape, changes, BLADE).model_dump(by_alias=True)
    profiles = definition.profiles
    try:
        for hub, tip in (("", ""), (".hub", ".tip")):
            laws = {key: linear_law(key, shape[key + hub], shape[key + tip]) for key in SECTION_KEYS}
            profiles = profiles_by_laws(profiles, laws)
    except SectionChangeError as error:
        blamed = [key for key in changes if key.split(".")[0] in changed_keys(error)]
        text = str(error) if len(blamed) == 1 else f"{' and '.join(blamed)}: {error}"
        raise ImpossibleValueError(VariedNumber(BLADE, blamed[0]), text) from None
    stacking = _changed_stacking(definition.stacking, shape)
    try:
        check_sweep(stacking or (), profiles)
    except BladeShapeError as error:
        blamed_key = next((key for key in changes if "sweep" in key), next(iter(changes)))
        raise ImpossibleValueError(VariedNumber(BLADE, blamed_key), str(error)) from None
    return replace(definition, profiles=profiles, stacking=stacking)


def _changed_stacking(
    stacking: tuple[tuple[float, float, float], ...] | None, shape: Mapping[str, float]
) -> tuple[tuple[float, float, float], ...] | None:
    """The table of sweep and lean with shares of it kept, and a straight line over the span added."""
    if stacking is None and not (shape["sweep_cm"] or shape["lean_deg"]):
        return None
    rows = stacking or ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    sweep, lean = 0.01 * shape["sweep_cm"], math.radians(shape["lean_deg"])
    changed = tuple(
        (span, 0.01 * shape["sweep_percent"] * back + span * sweep, 0.01 * shape["lean_percent"] * side + span * lean)
        for span, back, side in rows
    )
    for span, back, side in changed:
        row = {"span_percent": 100.0 * span, "sweep_cm": 100.0 * back, "lean_deg": math.degrees(side)}
        _checked(SweepLean, row, BLADE, "table: ")
    return changed


def _checked(model: type[BaseModel], content: Mapping[str, Any], kind: str, above: str = "") -> Any:
    """The content as a model; ImpossibleValueError, of a number of this `kind`, whose key has `above` before it."""
    try:
        return model.model_validate(content)
    except ValidationError as error:
        path, _, text = explain(error, content, model)
        raise ImpossibleValueError(VariedNumber(kind, above + ".".join(map(str, path))), text) from None
