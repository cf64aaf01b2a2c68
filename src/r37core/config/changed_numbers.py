"""A blade or a scene with other values of some numbers, as a member of a sample has it."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from pydantic import BaseModel, Field, ValidationError

from r37core.base.units import si_name
from r37core.blade.definition import BladeDefinition
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import check_sweep
from r37core.blade.section_changes import SectionChangeError
from r37core.contact.scene import Scene

from .blade_sections import MaterialSection
from .blades import SHARES, BladeSettings, SweepLean, TableShare
from .families import changed_content, numbers_of
from .messages import explain
from .scenes import SceneEntry
from .section import Section, plain
from .section_laws import SECTION_KEYS, Angle, AngleEnds, Share, ShareEnds, changed_keys, profiles_by_laws, span_law

_MATERIAL = "material."


class _Shape(Section):
    """Numbers of a shape as a member may have them."""

    sweep_percent: TableShare = 100.0
    lean_percent: TableShare = 100.0
    sweep_cm: float = Field(default=0.0, ge=-100, le=100)
    lean_deg: float = Field(default=0.0, gt=-90, lt=90)
    stagger_deg: Angle = 0.0
    camber_deg: Angle = 0.0
    chord_percent: Share = 100.0
    thickness_percent: Share = 100.0


_ENDS = {key: AngleEnds if key.endswith("_deg") else ShareEnds for key in SECTION_KEYS}
"""Changes of profiles that a member may also have linear in the span, by dotted keys."""


class ImpossibleValueError(ValueError):
    """A value that a blade or a scene cannot have; `key`: of which number, where that is told."""

    def __init__(self, key: str, text: str):
        super().__init__(text)
        self.key = key


_SHAPE: dict[str, float] = {name: field.default for name, field in _Shape.model_fields.items()} | {
    f"{key}.{end}": field.default for key, ends in _ENDS.items() for end, field in ends.model_fields.items()
}
"""Keys of a blade's shape and their nominal values."""

BLADE_KEYS = (*(_MATERIAL + key for key in MaterialSection.model_fields), *_SHAPE)
"""What may vary of a blade. `sweep_cm` and `lean_deg` are added at the tip, and below in proportion to the span. What the
entry of a blade changes of its profiles is there already, and stands under these changes."""


def scene_numbers(entry: SceneEntry) -> dict[str, float]:
    """Dotted key -> value of all numbers of a scene but those that count something or stop a run."""
    return {key: value for key, value in numbers_of(plain(entry)).items() if key != "divergence_limit_m"}


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
    return _SHAPE[key]


def changed_scene(entry: SceneEntry, changes: Mapping[str, float]) -> Scene:
    """The scene with values at dotted keys replaced. Raises ImpossibleValueError."""
    content = plain(entry)
    for key, value in changes.items():
        content = changed_content(content, key.split("."), value)
    return _checked(SceneEntry, content).scene()


def changed_blade(blade: BladeSettings, changes: Mapping[str, float]) -> BladeSettings:
    """The blade with values of BLADE_KEYS replaced. Raises ImpossibleValueError."""
    changed = blade
    material = {key.removeprefix(_MATERIAL): value for key, value in changes.items() if key.startswith(_MATERIAL)}
    if material and blade.material is not None:
        numbers = plain(_checked(MaterialSection, material, _MATERIAL))
        other = replace(blade.material, **{si_name(key)[0]: of for key, of in numbers.items()})
        try:
            other.check_strengths()
        except ValueError as error:
            raise ImpossibleValueError(_MATERIAL + next(iter(material)), str(error)) from None
        changed = replace(changed, material=other)
    shape = {key: value for key, value in changes.items() if key in _SHAPE}
    if shape and isinstance(blade.definition, BladeDefinition):
        changed = replace(changed, definition=_changed_shape(blade.definition, shape))
    return changed


def _changed_shape(definition: BladeDefinition, changes: Mapping[str, float]) -> BladeDefinition:
    shape: _Shape = _checked(_Shape, {key: value for key, value in changes.items() if key in _Shape.model_fields})
    constant = {key: getattr(shape, key) for key in SECTION_KEYS}
    ends = {}
    for key, model in _ENDS.items():
        content = {end: changes[f"{key}.{end}"] for end in model.model_fields if f"{key}.{end}" in changes}
        ends[key] = _checked(model, content, f"{key}.")
    profiles = definition.profiles
    try:
        for laws in (constant, ends):
            profiles = profiles_by_laws(profiles, {key: span_law(key, law) for key, law in laws.items()})
    except SectionChangeError as error:
        blamed = [key for key in changes if key.split(".")[0] in changed_keys(error)]
        text = str(error) if len(blamed) == 1 else f"{' and '.join(blamed)}: {error}"
        raise ImpossibleValueError(blamed[0], text) from None
    stacking = _changed_stacking(definition.stacking, shape)
    try:
        check_sweep(stacking or (), profiles)
    except BladeShapeError as error:
        raise ImpossibleValueError(next((key for key in changes if "sweep" in key), next(iter(changes))), str(error)) from None
    return replace(definition, profiles=profiles, stacking=stacking)


def _changed_stacking(
    stacking: tuple[tuple[float, float, float], ...] | None, shape: _Shape
) -> tuple[tuple[float, float, float], ...] | None:
    """The table of sweep and lean with shares of it kept, and a straight line over the span added."""
    if stacking is None and not (shape.sweep_cm or shape.lean_deg):
        return None
    rows = stacking or ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    sweep, lean = 0.01 * shape.sweep_cm, math.radians(shape.lean_deg)
    changed = tuple(
        (span, 0.01 * shape.sweep_percent * back + span * sweep, 0.01 * shape.lean_percent * side + span * lean)
        for span, back, side in rows
    )
    for span, back, side in changed:
        _checked(SweepLean, {"span_percent": 100.0 * span, "sweep_cm": 100.0 * back, "lean_deg": math.degrees(side)}, "table: ")
    return changed


def _checked(model: type[BaseModel], content: dict[str, Any], above: str = "") -> Any:
    try:
        return model.model_validate(content)
    except ValidationError as error:
        path, _, text = explain(error, content, model)
        raise ImpossibleValueError(above + ".".join(map(str, path)), text) from None
