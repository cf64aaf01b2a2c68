"""A key of the configuration is declared on the dataclass of a computation alone; all else follows from it."""

from dataclasses import dataclass, fields
from typing import Annotated

import pytest
from pydantic import Field

from r37core.base.declared import Key, declared_keys
from r37core.config import ConfigError, Document, si_form
from r37core.config.declaring import DECLARED, declared_by
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

    face: object = DECLARED
    swirl: list[float] = Field(default=[])


def test_the_dataclass_decides_what_the_schema_has():
    schema = SealSection.model_json_schema()
    keys = ["face", "swirl", "clearance_m", "slope_deg", "teeth", "stiffness_n_m2", "speed_rad_s", "speed_rpm"]
    assert list(schema["properties"]) == keys
    assert schema["required"] == ["clearance_m"]
    assert schema["description"] == "A seal."
    number = {"description": "at rest", "maximum": 0.1, "minimum": 1e-6, "title": "Clearance M", "type": "number"}
    assert schema["properties"]["clearance_m"] == number
    assert schema["properties"]["face"]["enum"] == ["plain", "brush"]
    defaults = {key: part.get("default") for key, part in schema["properties"].items()}
    assert (defaults["face"], defaults["teeth"], defaults["slope_deg"], defaults["stiffness_n_m2"]) == ("plain", 5, "tip", None)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"clearance_m": 0.2}, "clearance_m: found 0.2; allowed: number, at least 1e-06, at most 0.1"),
        ({"face": "felt"}, "face: found 'felt'; allowed: one of plain, brush"),
        ({"slope_deg": 91}, "slope_deg: found 91; allowed: tip or number, more than -90, less than 90"),
        ({"tooth": 1}, "found unknown key tooth; allowed keys: face, swirl, clearance_m, slope_deg, teeth"),
    ],
)
def test_and_what_a_message_says(change, message):
    with pytest.raises(ConfigError) as refused:
        Document("seal.yaml", {"clearance_m": 1e-3} | change).check(SealSection)
    assert message in str(refused.value)


def test_and_the_section_becomes_the_dataclass_again():
    assert si_form(Seal, SealSection(clearance_m=1e-3)) == Seal(1e-3, teeth=5)
    given = SealSection(clearance_m=1e-3, slope_deg=90 / 2, face="brush", speed_rpm=30.0, stiffness_n_m2=2.0, swirl=[1.0, 2.0])
    seal = si_form(Seal, given, teeth=7)
    assert (seal.teeth, seal.brushed, seal.stiffness, seal.swirl) == (7, True, 2.0, (1.0, 2.0))
    assert (seal.slope, seal.speed) == (pytest.approx(0.7853981633974483), pytest.approx(3.141592653589793))


def test_a_section_may_take_some_of_the_keys_or_leave_all_of_them_out():
    @declared_by(Seal, only_listed=True)
    class Some(Section):
        teeth: object = DECLARED

    @declared_by(Seal, optional=True)
    class Changes(Section):
        """What differs."""

    assert list(Some.model_fields) == ["teeth"]
    assert dict(Changes()) == dict.fromkeys(one.name for one in declared_keys(Seal))
    assert {one.field for one in declared_keys(Seal)} == {field.name for field in fields(Seal)} - {"swirl"}
