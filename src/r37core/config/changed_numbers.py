"""Blades and scenes with other values of some numbers, checked like entries that a user wrote."""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from r37core.base.io import CarriedError
from r37core.base.units import si_name
from r37core.base.varied_number import BLADE, SCENE, VariedNumber, numbers_in, with_value
from r37core.base.yaml_file import KeyPath
from r37core.blade.definition import Shape
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import check_sweep
from r37core.blade.section_changes import SectionChangeError
from r37core.contact.scene import Scene

from . import shape_keys
from .blade_sections import MATERIAL, MATERIAL_KEYS
from .blades import BladeEntry, BladeSettings
from .declaring import si_fields
from .document import Document
from .messages import did_you_mean, explain_all, single_line
from .scenes import SceneEntry
from .section import Section, plain
from .varied import FAMILY_KEYS

E = TypeVar("E", bound=Section)
Stacking = tuple[tuple[float, float, float], ...] | None

_LINE = ("sweep_cm", "lean_deg")
"""Sweep and lean that are added at the tip, and below in proportion to the span."""

BLADE_KEYS = (*MATERIAL_KEYS, *shape_keys.SHARES, *_LINE, *shape_keys.SECTION_KEYS, *shape_keys.END_KEYS)
"""Numbers of a blade that spread: those of an entry that starts from the blade, and _LINE."""

_ON_TOP = BladeEntry(base="blade")
"""Entry that starts from a blade and changes nothing."""


class ImpossibleValueError(CarriedError):
    """Value that a blade or a scene cannot have; `number`: the one to blame, or the key of what it leads to."""

    def __init__(self, kind: str, key: str, text: str):
        super().__init__(text)
        self.number = VariedNumber(kind, key)

    def place(self, known: Collection[VariedNumber]) -> tuple[tuple[str, ...], str]:
        """Path among tolerances of the `known` numbers, and the message there."""
        section, key = self.number.section, self.number.key
        return ((section, key), str(self)) if self.number in known else ((section,), f"{key}: {self}")


def scene_numbers(entry: SceneEntry) -> dict[str, float]:
    """Dotted key -> value of all numbers of a scene but those that count something or stop a run."""
    return {key: value for key, value in numbers_in(plain(entry)).items() if key != "divergence_limit_m"}


def blade_number(blade: BladeSettings, key: str) -> float | None:
    """Nominal value of one of BLADE_KEYS in its unit, None if a blade has none; ValueError for shifts of a chordwise sweep."""
    if key.startswith(MATERIAL):
        value = math.inf if blade.material is None else getattr(blade.material, si_name(key.removeprefix(MATERIAL))[0])
        return value if math.isfinite(value) else None
    shape = blade.definition
    if not isinstance(shape, Shape) or (key in shape_keys.SHARES and shape.stacking is None):
        return None
    if key in (*shape_keys.SECTION_KEYS, *shape_keys.END_KEYS) and si_name(key.split(".")[0])[0] not in shape.changes:
        return None
    if key in ("sweep_cm", "lean_deg") and shape.chordwise_sweep_angle is not None:
        raise ValueError(f"{key} with {shape.name}, whose sweep is chordwise")
    return shape_keys.neutral_value(key)


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
            raise document.refusal(single_line(number.key), allowed, *path, number.section, number.key)


def kind_of(entry: Section) -> str:
    """Kind of an entry, BLADE or SCENE."""
    return SCENE if isinstance(entry, SceneEntry) else BLADE


def entry_with(entry: E, values: Mapping[str, float]) -> E:
    """The entry, without a family's keys, with values at dotted keys. Raises ImpossibleValueError."""
    kind = kind_of(entry)
    content = entry.model_dump(exclude_none=True, exclude_unset=True, exclude=set(FAMILY_KEYS))
    for key, value in values.items():
        try:
            content = with_value(content, key, value)
        except (AttributeError, KeyError, IndexError, TypeError, ValueError):
            stand = "rows of a table stand in the entry, counted from 0, and hub and tip stand where it has no number"
            raise ImpossibleValueError(kind, key, f"found no {key} to vary; {stand}") from None
    return _checked(type(entry), content, kind)


def changed_blade(blade: BladeSettings, changes: Mapping[str, float]) -> BladeSettings:
    """The blade with values of BLADE_KEYS replaced. Raises ImpossibleValueError."""
    shape = [key for key in changes if key not in MATERIAL_KEYS]
    # as entries of two blades, each with the one before as its base: an entry has a number over the whole span or at its ends
    ends = {key: changes[key] for key in shape if key in shape_keys.END_KEYS}
    entry = entry_with(_ON_TOP, {key: value for key, value in changes.items() if key not in (*ends, *_LINE)})
    changed, material = blade, si_fields(entry.material)
    if material and blade.material is not None:
        changed = replace(changed, material=(other := replace(blade.material, **material)))
        try:
            other.check_strengths()
        except ValueError as error:
            raise ImpossibleValueError(BLADE, next(key for key in changes if key in MATERIAL_KEYS), str(error)) from None
    if shape and isinstance(blade.definition, Shape):
        definition = _changed_shape(blade.definition, (entry, entry_with(_ON_TOP, ends)), shape)
        stacking = _changed_stacking(blade.definition.stacking, entry, changes)
        try:
            check_sweep(stacking or (), definition.height)
        except BladeShapeError as error:
            raise ImpossibleValueError(BLADE, next((key for key in shape if "sweep" in key), shape[0]), str(error)) from None
        changed = replace(changed, definition=definition.replaced(stacking=stacking))
    return changed


def changed_pair(blade: BladeSettings, scene: SceneEntry, values: Mapping[VariedNumber, float]) -> tuple[BladeSettings, Scene]:
    """A blade and a scene with values of some of their numbers. Raises ImpossibleValueError."""
    blade_values, scene_values = (
        {number.key: value for number, value in values.items() if number.kind == kind} for kind in (BLADE, SCENE)
    )
    return changed_blade(blade, blade_values), entry_with(scene, scene_values).scene()


def _changed_shape(shape: Shape, entries: Iterable[shape_keys.ShapeKeys], keys: Iterable[str]) -> Shape:
    """The shape with changes of entries on top of each other, for which `keys` are to blame."""
    try:
        for entry in entries:
            shape = shape_keys.changed_shape(shape, entry)
    except SectionChangeError as error:
        blamed = [key for key in keys if key.split(".")[0] in shape_keys.changed_keys(error)]
        text = str(error) if len(blamed) == 1 else f"{' and '.join(blamed)}: {error}"
        raise ImpossibleValueError(BLADE, blamed[0], text) from None
    return shape


def _changed_stacking(stacking: Stacking, entry: shape_keys.ShapeKeys, changes: Mapping[str, float]) -> Stacking:
    """The table of sweep and lean with shares of it kept, and a straight line over the span added."""
    sweep_cm, lean_deg = (changes.get(key, 0.0) for key in _LINE)
    _checked(shape_keys.SweepLean, {"span_percent": 100.0, "sweep_cm": sweep_cm, "lean_deg": lean_deg}, BLADE)
    if stacking is None and not (sweep_cm or lean_deg):
        return None
    rows, sweep, lean = stacking or ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), 0.01 * sweep_cm, math.radians(lean_deg)
    kept, kept_lean = (1.0 if share is None else 0.01 * share for share in (entry.sweep_percent, entry.lean_percent))
    changed = tuple((span, kept * back + span * sweep, kept_lean * side + span * lean) for span, back, side in rows)
    for span, back, side in changed:
        row = {"span_percent": 100.0 * span, "sweep_cm": 100.0 * back, "lean_deg": math.degrees(side)}
        _checked(shape_keys.SweepLean, row, BLADE, "table: ")
    return changed


def _checked(model: type[BaseModel], content: Mapping[str, Any], kind: str, above: str = "") -> Any:
    """The content as a model; ImpossibleValueError, of a number of this `kind`, whose key has `above` before it."""
    try:
        return model.model_validate(content)
    except ValidationError as error:
        path, _, text = explain_all(error, content, model)[0]
        raise ImpossibleValueError(kind, above + ".".join(map(str, path)), text) from None
