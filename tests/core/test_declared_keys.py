"""A key of the configuration is declared on the dataclass of a computation alone: its schema, unit and field follow from it."""

import ast
import dataclasses
import math
import re
from dataclasses import dataclass, fields
from typing import Annotated

import numpy as np
import pytest
from pydantic import Field

from r37core.base.declared import Key, declared_keys
from r37core.base.units import LIKE_A_UNIT, SUFFIXES, si_name
from r37core.config import checked_scene, si_fields, si_form
from r37core.config.declaring import declared_by, section_of
from r37core.config.section import Section


@dataclass(frozen=True)
class Seal:
    """A seal of a computation."""

    clearance: Annotated[float, Key("at rest", "_m", ge=1e-6, le=0.1)]
    slope: Annotated[float | None, Key("of its face", "_deg", gt=-90, lt=90, none="tip")] = None
    teeth: Annotated[int, Key("how many", ge=1)] = 3
    brushed: Annotated[bool, Key("what rubs", name="face", words={"plain": False, "brush": True})] = False
    stiffness: Annotated[float, Key("of the brush", "_n_m2", gt=0)] = float("inf")
    speed: Annotated[float | None, Key("of the test", "_rad_s"), Key("of the test, in rpm", "_rpm")] = None
    swirl: tuple[float, ...] = ()


@declared_by(Seal, teeth=5)
class SealSection(Section):
    """A seal."""

    swirl: list[float] = Field(default=[])


def test_the_dataclass_decides_what_the_schema_has():
    schema = SealSection.model_json_schema()
    keys = ["swirl", "clearance_m", "slope_deg", "teeth", "face", "stiffness_n_m2", "speed_rad_s", "speed_rpm"]
    assert list(schema["properties"]) == keys
    assert schema["required"] == ["clearance_m"]
    assert schema["description"] == "A seal."
    number = {"description": "at rest", "maximum": 0.1, "minimum": 1e-6, "title": "Clearance M", "type": "number"}
    assert schema["properties"]["clearance_m"] == number
    assert schema["properties"]["face"]["enum"] == ["plain", "brush"]
    defaults = {key: part.get("default") for key, part in schema["properties"].items()}
    assert (defaults["face"], defaults["teeth"], defaults["slope_deg"], defaults["stiffness_n_m2"]) == ("plain", 5, "tip", None)


def test_and_the_section_becomes_the_dataclass_again():
    assert si_form(Seal, SealSection(clearance_m=1e-3)) == Seal(1e-3, teeth=5)
    given = SealSection(clearance_m=1e-3, slope_deg=90 / 2, face="brush", speed_rpm=30.0, stiffness_n_m2=2.0, swirl=[1.0, 2.0])
    seal = si_form(Seal, given, teeth=7)
    assert (seal.teeth, seal.brushed, seal.stiffness, seal.swirl) == (7, True, 2.0, (1.0, 2.0))
    assert (seal.slope, seal.speed) == (pytest.approx(0.7853981633974483), pytest.approx(3.141592653589793))


def test_a_section_may_take_some_of_the_keys_or_leave_all_of_them_out():
    Changes = section_of(Seal, "What differs.", optional=True)
    assert list(section_of(Seal, "Some of it.", only=["teeth"]).model_fields) == ["teeth"]
    assert dict(Changes()) == dict.fromkeys(one.name for one in declared_keys(Seal))
    assert {one.field for one in declared_keys(Seal)} == {field.name for field in fields(Seal)} - {"swirl"}


ENTRY = {
    "casing": {"clearance_m": 2e-4},
    "lining": {"thickness_m": 4e-3, "elastic_modulus_pa": 1e10, "plastic_modulus_pa": 2e9, "yield_stress_pa": 3.0},
    "friction": {"form": "vector", "coefficient": 0.2},
}

SAME = {
    "casing.clearance_m": 5e-4,
    "casing.lobes": 6,
    "friction.heat_share": 0.3,
    "casing.width": 0.11,
    "casing.rise_fraction": 0.6,
    "casing.rise_revolutions": 30,
    "lining.thickness_m": 7e-3,
    "lining.elastic_modulus_pa": 7e9,
    "lining.plastic_modulus_pa": 7e8,
    "lining.yield_stress_pa": 7e6,
    "lining.bars": 70,
    "lining.contact_length_m": 7e-4,
    "lining.bar_width_m": 7e-4,
    "lining.bar_area_m2": 7e-7,
    "friction.coefficient": 0.7,
    "damping_ratio": 0.07,
    "divergence_limit_m": 0.07,
}
"""Key -> value, which is that of the field called like the key without its unit."""

REACHES = {path: (value, si_name(path)[0], value) for path, value in SAME.items()} | {
    "casing.cone_angle_deg": (-7.0, "casing.cone_angle", np.radians(-7.0)),
    "casing.amplitude_clearances": (2.5, "casing.amplitude", 2.5),
    "casing.amplitude_m": (5e-4, "casing.height", 5e-4),
    "friction.form": ("constant", "friction.vector", False),
    "gap": ("exact", "exact_gap", True),
}
"""Key -> value, its field, and what that then has."""


def flat(scene):
    """Dotted field -> value."""
    fields = {}
    for name, value in dataclasses.asdict(scene).items():
        fields |= {f"{name}.{inner}": one for inner, one in value.items()} if isinstance(value, dict) else {name: value}
    return fields


def with_key(path, value):
    entry = {name: dict(part) if isinstance(part, dict) else part for name, part in ENTRY.items()}
    *parents, last = path.split(".")
    (entry[parents[0]] if parents else entry)[last] = value
    return entry


@pytest.mark.parametrize("path", REACHES)
def test_a_key_reaches_its_field_only(path):
    value, field, expected = REACHES[path]
    before, after = flat(checked_scene(ENTRY)), flat(checked_scene(with_key(path, value)))
    assert before[field] != after[field] == expected
    assert {name for name in before if before[name] != after[name]} == {field}


def test_every_field_has_a_key_and_by_default_the_tip_decides_the_cone_angle():
    """Those of a clearance that changes with the speed: see test_clearance; of an elastic casing: test_elastic_casing."""
    elsewhere = {"casing.centrifugal", "casing.growth_speeds", "casing.growth", "casing.ring", "casing.ring_radius"}
    elsewhere |= {"casing.change", "casing.change_revolutions"}
    # of the blades of a rotor
    elsewhere |= {"rotor", "casing.longer"}
    assert {field for _, field, _ in REACHES.values()} | elsewhere == set(flat(checked_scene(ENTRY)))
    scene = checked_scene(ENTRY)
    assert (scene.casing.cone_angle, scene.lining.published) == (None, False)
    assert scene.casing.angle(-0.26) == -0.26
    assert checked_scene(with_key("casing.cone_angle_deg", 3.0)).casing.angle(-0.26) == np.radians(3.0)


IN_SI = {
    f"_{unit}": (0.3, 0.3) for unit in ("m", "m2", "s", "hz", "pa", "kg", "kg_m3", "n_m2", "rad_s", "rad_s2", "clearances")
}
IN_SI |= {"_cm": (30.0, 0.3), "_percent": (30.0, 0.3), "_deg": (90, 0.5 * math.pi)}
IN_SI |= {"_rpm": (60.0, 2.0 * math.pi), "_rpm_s": (60.0, 2.0 * math.pi)}
"""Suffix -> a number in its unit, which may be a whole one as defaults are, and the same in that of the SI."""


def sections(of=Section):
    """All models of mappings of the configuration files."""
    for kind in of.__subclasses__():
        yield kind
        yield from sections(kind)


SECTIONS = {kind.__name__: kind for kind in sections() if kind.__module__.startswith("r37core") and kind.model_fields}


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_number_with_a_unit_becomes_one_of_the_si(suffix):
    number, expected = IN_SI[suffix]
    assert si_fields([(f"some{suffix}", number)]) == {"some": pytest.approx(expected, rel=1e-15)}
    assert si_fields([(f"some{suffix}", [number, 0.0])])["some"] == (pytest.approx(expected, rel=1e-15), 0.0)


def test_every_unit_of_a_key_is_known_and_what_is_left_out_has_no_field():
    """A key that ends in a unit without a suffix of its own would reach its field under a wrong name."""
    keys = {key for section in SECTIONS.values() for key in section.model_fields}
    with_units = {key for key in keys if LIKE_A_UNIT.search(key)}
    assert {"clearance_m", "time_step_s", "density_kg_m3", "speeds_rpm", "cone_angle_deg"} <= with_units
    assert not {key for key in with_units if not key.endswith(tuple(SUFFIXES))}
    assert si_fields([("bar_area_m2", None), ("cone_angle_deg", "tip"), ("bars", 7)]) == {"bars": 7}


@pytest.mark.parametrize("unit", ["_n", "_furlong"])
def test_a_key_of_an_unknown_unit_is_refused_with_its_name(unit):
    @dataclass
    class Spring:
        force: Annotated[float, Key("of the spring", unit)]

    with pytest.raises(ValueError, match=rf"key force{unit}: found the unit '{unit}'; known: _m, _m2, .*_deg"):
        declared_keys(Spring)


@pytest.mark.parametrize(("rad_s", "rpm", "speeds"), [([5.0], [], (5.0,)), ([], [30.0], (math.pi,)), ([], [], ())])
def test_of_two_units_the_one_that_is_given_counts(rad_s, rpm, speeds):
    assert si_fields([("speeds_rad_s", rad_s), ("speeds_rpm", rpm)]) == {"speeds": pytest.approx(speeds)}


def defaults_in(tree):
    """Names and values of a module's constants and of the defaults of fields and parameters.

    But for fields that declare a key, where its default stands.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign):
            yield ast.unparse(node.targets[0]).lower(), ast.unparse(node.value)
        elif isinstance(node, ast.AnnAssign) and node.value and not declares_key(node):
            yield ast.unparse(node.target), ast.unparse(node.value)
        elif isinstance(node, ast.FunctionDef):
            named = [*node.args.posonlyargs, *node.args.args]
            pairs = [*zip(reversed(named), reversed(node.args.defaults), strict=False)]
            pairs += zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True)
            yield from ((parameter.arg, ast.unparse(value)) for parameter, value in pairs if value)


def declares_key(field):
    return "Key(" in ast.unparse(field.annotation)


def test_no_default_of_a_key_stands_in_the_code_again(root):
    """CONTRIBUTING.md: a number that a user may want to change has its default where its key is declared, and nowhere else."""
    core = root / "src/r37core"
    trees = {file.relative_to(core): ast.parse(file.read_text()) for file in core.rglob("*.py")}
    of_sections = [one.model_fields.items() for one in SECTIONS.values()]
    of_sections = [[(key, field.default) for key, field in fields if not field.is_required()] for fields in of_sections]
    keys = {(name, repr(value)) for given in of_sections for name, value in [*given, *si_fields(given).items()]}
    declared = [node for tree in trees.values() for node in ast.walk(tree) if isinstance(node, ast.AnnAssign) and node.value]
    keys |= {(field.target.id, ast.unparse(field.value)) for field in declared if declares_key(field)}
    keys = {(name, value) for name, value in keys if not re.match(r"None$|\(\)$|\w+\(", value)}
    assert {("bars", "10000"), ("stress_instants", "62"), ("amplitude", "2.0")} <= keys
    of_code = [(file, *pair) for file, tree in trees.items() if "config" not in file.parts for pair in defaults_in(tree)]
    assert [(file, *pair) for file, *pair in of_code if tuple(pair) in keys] == []
