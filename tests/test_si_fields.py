"""Keys with units become fields in SI units, in one place, and no default of a key stands in the code a second time."""

import ast
import math
import re

import pytest

from r37core.base.declared import declared_keys
from r37core.base.units import SUFFIXES
from r37core.config import si_fields
from r37core.config.casing_section import CasingSection
from r37core.config.declaring import si_form
from r37core.config.section import Section
from r37core.contact.casing import Casing
from r37core.contact.scene import Friction, Lining, Scene
from r37core.exchange.importing.source import MeshSource
from r37core.product import schemas

IN_SI = {
    f"_{unit}": (0.3, 0.3) for unit in ("m", "m2", "s", "hz", "pa", "kg", "kg_m3", "n_m2", "rad_s", "rad_s2", "clearances")
}
IN_SI |= {"_cm": (30.0, 0.3), "_percent": (30.0, 0.3), "_deg": (90, 0.5 * math.pi)}
IN_SI |= {"_rpm": (60.0, 2.0 * math.pi), "_rpm_s": (60.0, 2.0 * math.pi)}
"""Suffix -> a number in its unit, which may be a whole one as defaults are, and the same in that of the SI."""

UNIT = re.compile(
    r"_([kcmu]?m|in|ft|m?m[23]|k?g|t|m?s|min|k?hz|[kmg]?pa|k?n|j|w|rad|deg|rpm|rad_s2?|rpm_s|percent|kg_m3|n_m2)$",
    re.IGNORECASE,
)
"""Ends of names that a reader takes for a unit."""


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


def test_every_unit_of_a_key_is_known():
    """A key that ends in a unit without a suffix of its own would reach its field under a wrong name."""
    keys = {key for section in SECTIONS.values() for key in section.model_fields}
    with_units = {key for key in keys if UNIT.search(key)}
    assert {"clearance_m", "time_step_s", "density_kg_m3", "speeds_rpm", "cone_angle_deg"} <= with_units
    assert not {key for key in with_units if not key.endswith(tuple(SUFFIXES))}
    assert {suffix for suffix in SUFFIXES if any(key.endswith(suffix) for key in keys)} == set(SUFFIXES)


def test_what_is_left_out_has_no_field():
    assert si_fields([("bar_area_m2", None), ("cone_angle_deg", "tip"), ("bars", 7)]) == {"bars": 7}


@pytest.mark.parametrize(("rad_s", "rpm", "speeds"), [([5.0], [], (5.0,)), ([], [30.0], (math.pi,)), ([], [], ())])
def test_of_two_units_the_one_that_is_given_counts(rad_s, rpm, speeds):
    assert si_fields([("speeds_rad_s", rad_s), ("speeds_rpm", rpm)]) == {"speeds": pytest.approx(speeds)}


def test_a_dataclass_takes_its_fields_and_parts_made_otherwise():
    section = CasingSection(clearance_m=1e-3, cone_angle_deg=-90.0 / 2)
    assert si_form(Casing, section) == Casing(1e-3, cone_angle=-0.25 * math.pi)
    assert si_form(Casing, section, cone_angle=None).cone_angle is None
    with pytest.raises(TypeError, match="depth"):
        si_form(Casing, section, depth=1.0)


def test_words_for_yes_are_among_those_of_their_keys():
    allowed = [schemas.MODELS[name].model_json_schema() for name in schemas.MODELS]
    properties = [part["properties"] for one in allowed for part in one["$defs"].values() if "properties" in part]
    words = {one.name: one for kind in (Friction, Lining, Scene, MeshSource) for one in declared_keys(kind) if one.key.words}
    assert set(words) == {"form", "gap", "pressure_side"}
    for name, one in words.items():
        enums = [part[name]["enum"] for part in properties if name in part]
        assert enums
        assert all(enum == list(one.key.words) and sorted(one.key.words.values()) == [False, True] for enum in enums)
        assert one.key.words[next(part[name]["default"] for part in properties if name in part)] == one.default


def literal(node):
    try:
        return ast.literal_eval(node)
    except ValueError:
        return None


def is_declaration(line):
    """Whether a field's annotation declares a key of the configuration."""
    return any(isinstance(node, ast.Name) and node.id == "Key" for node in ast.walk(line.annotation))


def declarations(tree):
    """Fields of dataclasses that declare keys, with their defaults."""
    lines = [line for node in ast.walk(tree) if isinstance(node, ast.ClassDef) for line in node.body]
    return [line for line in lines if isinstance(line, ast.AnnAssign) and is_declaration(line) and line.value is not None]


def defaults_in(tree):
    """Name, value and line of a module's constants and of the defaults of all dataclasses' fields and functions' parameters.

    But for fields that declare a key, where its default stands.
    """
    for line in tree.body:
        if isinstance(line, ast.Assign) and isinstance(line.targets[0], ast.Name):
            yield line.targets[0].id.lower(), literal(line.value), line.lineno
        elif isinstance(line, ast.Assign) and isinstance(line.targets[0], ast.Tuple) and isinstance(line.value, ast.Tuple):
            for name, value in zip(line.targets[0].elts, line.value.elts, strict=True):
                yield name.id.lower(), literal(value), line.lineno
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            for line in node.body:
                if isinstance(line, ast.AnnAssign) and line.value is not None and not is_declaration(line):
                    yield line.target.id, literal(line.value), line.lineno
        elif isinstance(node, ast.FunctionDef):
            named = [*node.args.posonlyargs, *node.args.args]
            given = zip(reversed(named), reversed(node.args.defaults), strict=False)
            for argument, value in [*given, *zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True)]:
                if value is not None:
                    yield argument.arg, literal(value), value.lineno


def test_no_default_of_a_key_stands_in_the_code_again(root):
    """CONTRIBUTING.md: a number that a user may want to change has its default where its key is declared, and nowhere else."""
    core = root / "src/r37core"
    trees = {file: ast.parse(file.read_text()) for file in core.rglob("*.py")}
    of_sections = [section_defaults(section) for section in SECTIONS.values()]
    keys = {(name, repr(value)) for given in of_sections for name, value in [*given, *si_fields(given).items()]}
    keys |= {(line.target.id, repr(literal(line.value))) for tree in trees.values() for line in declarations(tree)}
    keys = {(name, value) for name, value in keys if value not in ("None", "()")}
    assert {("bars", "10000"), ("stress_instants", "62"), ("amplitude", "2.0")} <= keys
    found = [
        f"{file.relative_to(core)}:{line}: {name} = {value!r}"
        for file, tree in trees.items()
        if "config" not in file.relative_to(core).parts
        for name, value, line in defaults_in(tree)
        if (name, repr(value)) in keys
    ]
    assert found == []


def section_defaults(section):
    """Keys with the defaults as they stand."""
    return [(key, field.default) for key, field in section.model_fields.items() if not field.is_required()]
