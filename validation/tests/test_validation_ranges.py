"""Published numbers beside the range of ours: judged on values made up by hand, and the members that are planned."""

from dataclasses import replace

import numpy as np
import pytest
from r37core.studies.plan import Studies

from r37core.config import ConfigError, command_line_document
from r37core.product.reading import read_settings
from validation.studies.checks import Check, claim
from validation.studies.modelling_choices.cases import DIRECT
from validation.studies.validation_ranges.cases import NOMINAL, cases, values
from validation.studies.validation_ranges.report import judge, range_report, range_table

SAID = "CS100: slightly more"
PUBLISHED = [
    Check("slope", 1.0, 1.0),
    Check("ours alone", None, 5.0),
    Check("good", 10.0, 10.01),
    Check("good but outside", 10.0, 10.05),
    Check("width", 17.0, 28.0, "rad/s", 0.2),
    Check("wear", 5.0, 4.0, "mm"),
    claim("clearance", False, "0.92 of it"),
    claim(SAID, False, "1.37 of it"),
    claim("never", False),
]


def member(good, width, wear, more):
    """Checks of one member: numbers of `good` and `width` and `wear`, and whether the statement is true."""
    return [
        Check("good", 10.0, good),
        Check("good but outside", 10.0, 10.2),
        Check("width", 17.0, width, "rad/s", 0.2),
        Check("wear", 5.0, wear, "mm"),
        claim(SAID, more, "1.2 of it"),
        claim("never", False),
        Check("ours alone", None, 4.0),
    ]


MEMBERS = [member(9.95, 16.0, 4.1, False), member(10.2, 30.0, 4.4, True), member(10.0, np.nan, 4.2, False)]


@pytest.fixture
def judged():
    return {one.shipped.name: one for one in judge(PUBLISHED, MEMBERS[2], MEMBERS)}


def test_numbers_have_a_range_and_statements_a_count(judged):
    shown = {name: (one.shown, one.verdict) for name, one in judged.items()}
    assert shown == {
        "slope": ("", ""),
        "good": ("9.95 to 10.2", "yes"),
        "good but outside": ("10.2", "**no**"),
        "width": ("16 to 30 (1 of 3 none)", "yes"),
        "wear": ("4.1 to 4.4", "**no**"),
        "clearance": ("", ""),
        SAID: ("1 of 3", "yes"),
        "never": ("0 of 3", "**no**"),
    }


def test_a_number_at_the_end_of_the_range_is_inside():
    lowest, none = judge(
        [Check("a", 2.0, 3.0), Check("b", 2.0, 3.0)], [], [[Check("a", 2.0, 2.0), Check("b", 2.0, np.nan)]] * 2
    )
    assert (lowest.shown, lowest.inside) == ("2", True)
    assert (none.shown, none.inside) == ("none", False)


def test_a_member_without_a_check_has_no_number():
    (one,) = judge([Check("a", 2.0, 3.0)], [], [[Check("a", 2.0, 1.0)], []])
    assert one.shown == "1 (1 of 2 none)"
    (said,) = judge([claim("a", True)], [], [[claim("a", True)], []])
    assert said.shown == "1 of 2"


def test_the_conclusion_says_what_differs_inside_the_range_and_outside(judged):
    text = range_report(list(judged.values()), {"friction.coefficient": "± 5%"})
    assert (
        "3 of 6 published numbers and statements lie inside the range. Of the 5 that differ as shipped, 2 lie inside." in text
    )
    assert f"- differ as shipped, but lie inside (2): width; {SAID}\n" in text
    assert "- differ, and the range does not reach them (2): wear; never\n" in text
    assert "- differ, and none of these tolerances touches them (1): clearance\n" in text
    assert "- agree as shipped, though outside (1): good but outside\n" in text
    assert "3 members; `friction.coefficient` ± 5%." in text
    # the first has `good` and `width`, the others one each; the third is the nominal run here
    assert "Of these 6, single members agree with 1 to 2. The nominal run agrees with 1 of 6." in text


def test_what_differs_comes_first_and_what_has_neither_range_nor_error_is_left_out(judged):
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in range_table(list(judged.values())).splitlines()]
    assert rows[0] == ["what", "published", "ours", "nominal", "range", "inside"]
    assert [row[0] for row in rows[2:]] == ["wear", "clearance", "never", "width", SAID, "good but outside", "good"]
    assert rows[2][1:] == ["5 mm", "**4**", "4.2", "4.1 to 4.4", "**no**"]
    assert rows[3][1:] == ["yes", "**no (0.92 of it)**", "", "", ""]


def test_members_have_numbers_within_the_tolerances_in_both_scenes(settings):
    planned = cases(settings)
    members = {name.split("/")[0] for name in planned}
    assert members == {NOMINAL, *map(str, range(16))}
    lined, direct = planned[f"{NOMINAL}/Ref_4"], planned[f"{NOMINAL}/{DIRECT}"]
    for name in members - {NOMINAL}:
        scene, other = planned[f"{name}/Ref_4"].scene, planned[f"{name}/{DIRECT}"].scene
        assert scene.friction == other.friction
        assert scene.casing == other.casing
        assert abs(scene.friction.coefficient / 0.15 - 1.0) <= 0.05
        assert abs(scene.casing.clearance / 3.56e-4 - 1.0) <= 0.02
        assert 0.8e-3 <= scene.lining.bar_width <= 1.25e-3
        assert scene != lined.scene
        assert other.lining is None
        # the same grids and time integration for all
        assert planned[f"{name}/Ref_4"] == replace(lined, scene=scene, what=f"member {name}")
        assert planned[f"{name}/{DIRECT}"] == replace(direct, scene=other, what=f"member {name}")


def test_members_take_the_time_integration_of_the_quick_level(settings):
    quick = settings.levels["standard"].time_integration
    assert cases(settings)["0/S50_4"].choice == quick.choice(lined=True)
    assert cases(settings)[f"0/{DIRECT}"].choice == quick.choice(lined=False)


def test_more_members_change_none(root, settings):
    more = command_line_document({"studies": {"validation_ranges": {"members": 32}}})
    planned = cases(read_settings(root, more))
    assert cases(settings).items() <= planned.items()
    assert "31/Ref_4" in planned


def test_the_table_is_made_of_what_is_shipped_and_of_the_members(settings):
    given = Studies(settings).inputs("validation_ranges")(None)
    assert "<results>/studies/modelling_choices/shipped/Ref_4.nc" in given["shipped"]
    assert not any("/quick/" in file for file in given["shipped"])
    assert len(given["shipped"]) == len(values(settings)["shipped"])
    assert "<results>/studies/validation_ranges/15/CS100_4.nc" in given["cases"]
    assert values(settings)["tolerances"]["lining.bar_width_m"] == "0.0008 to 0.00125"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"members": 12}, r"studies\.validation_ranges\.members: found 12; allowed: a power of two, such as 8 or 16"),
        (
            {"of_scenes": {"lining.bars": {"uniform": 3}}},
            r"of_scenes\.lining\.bars: found lining\.bars; allowed: one of casing",
        ),
        (
            {"of_scenes": {"casing.cone_angle_deg": {"uniform": 3}}},
            r"of_scenes\.casing\.cone_angle_deg: found casing\.cone_angle_deg; allowed: one of ",
        ),
        (
            {"of_scenes": {"friction.coefficient": {"uniform_percent": 500}}},
            r"of_scenes\.friction\.coefficient: the end of its range: found -.*; or a narrower tolerance",
        ),
        (
            {"of_scenes": {"casing.rise_fraction": {"between": [0.1, 1.1]}}},
            r"of_scenes\.casing\.rise_fraction: the end of its range: found 1\.1.*; or a narrower tolerance",
        ),
        (
            {"of_scenes": {"friction.coefficient": {"uniform_percent": 5}}, "members": 2},
            None,
        ),
    ],
)
def test_what_cannot_spread_is_refused(root, change, message):
    """Before anything runs; what no member can have before members are drawn."""
    document = command_line_document({"studies": {"validation_ranges": change}})
    if message is None:
        assert cases(read_settings(root, document))
    else:
        with pytest.raises(ConfigError, match=message):
            read_settings(root, document)


def test_scenes_without_the_study_s_are_not_refused(config_copy):
    """It may never be asked for."""
    (config_copy / "config/scenes.yaml").write_text("rigid: { casing: { clearance_m: 3e-4 } }\n")
    changes = {"scenes": ["rigid"], "studies": {"validation_ranges": {"of_scenes": {"lining.bars": {"uniform": 3}}}}}
    read_settings(config_copy, command_line_document(changes))
