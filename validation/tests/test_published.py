"""Published numbers next to ours, on runs made by hand."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from evidence import published_windows as windows
from evidence.checks import Check, claim, score
from evidence.published_checks import Runs, survey_checks, torsion_speed, window_checks
from evidence.published_figures import draw_reference, draw_stress_over_speed, draw_widths
from evidence.published_ranges import counts, judge
from evidence.published_tables import SHORT, checks_table, choices_table, differences, kinds, ranges_table, summary
from evidence.published_windows import BARE
from published import BLADES, INTERACTIONS

from r37core.product.extensions import read_settings

YIELD = 1.38e9
UNITS = ("rms_normal", "rms_radial", "rms_tangential", "max_von_mises_last_revolution", "max_wear", "casing_hits", "status")


def branch(peak, order=4, normal=4e-3, tangential=19e-3, low=None, high=None):
    """A response that rises to its peak and drops, yielding over the 17 rad/s before its end, every 2 rad/s."""
    speed = np.arange(peak - 40 if low is None else low, peak + 41 if high is None else high, 2.0)
    level = np.where(speed <= peak, np.maximum(1 - (peak - speed) / 40, 0.02), 0.02)
    stress = np.where((speed > peak - 17) & (speed <= peak), 2.0 * YIELD, 0.0)
    values = {name: np.zeros(len(speed)) for name in UNITS}
    values |= {"rms_normal": normal * level, "rms_tangential": tangential * level, "max_von_mises_last_revolution": stress}
    values |= {"max_wear": 5e-3 * level, "casing_hits": level}
    run = xr.Dataset({name: ("speed", value) for name, value in values.items()}, coords={"speed": speed})
    run = run.assign_coords(tip_point=["leading_edge", "trailing_edge"], lobes=np.arange(21))
    return run.assign(yield_stress=YIELD, **with_lobes(run, order), **touching_from(run, 8))


def with_lobes(run, order):
    """Wear of so many lobes, in addition to the casing's own two, which are larger."""
    lobes = np.arange(21)
    return {"wear_harmonic": (("speed", "lobes"), np.tile(2.0 * (lobes == 2) + (lobes == order), (run.sizes["speed"], 1)))}


def touching_from(run, revolution):
    """The tip's largest positions: contact from a revolution on."""
    inside = np.where(np.arange(1, 201) < revolution, -1e-4, 1e-4)
    return {"revolution_maximum": (("speed", "revolution", "tip_point"), np.tile(inside[:, None], (run.sizes["speed"], 1, 2)))}


def with_history(run, first_yields):
    """Add stress per revolution, above yield from a revolution on (NaN: never), by speed."""
    revolution = np.arange(1, 201)
    stress = np.array([np.where(revolution >= first, 2.0, 0.5) * YIELD for first in first_yields.values()])
    run = run.assign_coords(history_speed=list(first_yields), revolution=revolution)
    return run.assign(max_von_mises_history=(("history_speed", "revolution"), stress))


def published_runs() -> Runs:
    """Runs that are as published, but for the reference blade's direct contact, which is silent about 1717."""
    motion = {"L50": (0.95, 1.2), "S50": (0.55, 0.9), "S100": (0.01, 0.5), "CS50": (1.1, 1.2)}
    motion |= {"L100": motion["L50"], "CS100": motion["CS50"], "Ref": (1.0, 1.0)}
    runs = {}
    for one in INTERACTIONS:
        normal, tangential = motion[one.blade]
        run = branch(one.peak, one.engine_order, 4e-3 * normal, 19e-3 * tangential)
        runs[one.name] = with_history(run, {one.peak: 44 if one.blade == "L50" else 78})
    runs["S100_4"]["max_von_mises_last_revolution"] *= 0.3
    runs["Ref_4"] = with_history(branch(1717.0), {1717.0: 40, 1800.0: np.nan})
    runs["Ref_4"]["max_von_mises_history"].loc[{"history_speed": 1800.0}] = 0.1 * YIELD
    direct = with_history(branch(1344.0, high=1900.0), {1344.0: 88, 1717.0: np.nan, 1800.0: np.nan})
    direct["max_von_mises_history"].loc[{"history_speed": 1717.0}] = np.where(direct["revolution"] < 19, 0.6, 0.4) * YIELD
    return runs | {BARE: direct}


def test_runs_as_published_agree_in_every_check():
    checks = window_checks(published_runs())
    assert [check.name for check in checks if not check.agrees] == []
    assert sum(check.published is not None for check in checks) > 50
    named = {check.name: check.ours for check in checks}
    assert named["Ref 1B/4: width above yield"] == pytest.approx(17.0, abs=2.0)
    assert named["Ref lined at 1717: first yield"] == 40
    assert named["at 1717: lined passes direct contact in stress"] == 19
    assert named["variants at their peaks: earliest first yield"] == 44


@pytest.mark.parametrize(
    ("change", "differs"),
    [
        (lambda runs: {"Ref_4": runs["Ref_4"].assign_coords(speed=runs["Ref_4"]["speed"] + 12)}, "Ref 1B/4: peak"),
        (lambda runs: {"L50_4": runs["L50_4"].isel(speed=slice(0, 21))}, "L50 1B/4: drop after the peak"),
        (lambda runs: {"Ref_7": runs["Ref_7"].assign(with_lobes(runs["Ref_7"], 6))}, "Ref 1B/7: lobes of the wear at the peak"),
        (
            lambda runs: {"S50_4": runs["S50_4"].assign(rms_normal=2 * runs["S50_4"]["rms_normal"])},
            "S50 at its peak: normal motion",
        ),
        (lambda runs: {"S100_4": runs["Ref_4"]}, "stress at the peak: S100 more than three times below Ref"),
        (
            lambda runs: {"Ref_4": runs["Ref_4"].assign(touching_from(runs["Ref_4"], 20))},
            "Ref lined: whole revolutions before the first contact",
        ),
        (
            lambda runs: {BARE: runs[BARE].assign(max_von_mises_history=3 * runs[BARE]["max_von_mises_history"])},
            "direct at 1800: below yield",
        ),
        (lambda runs: {BARE: branch_that_stays(runs[BARE])}, "direct: low above, its median less than half"),
    ],
)
def test_what_is_not_as_published_differs(change, differs):
    runs = published_runs()
    checks = window_checks(runs | change(runs))
    assert any(check.name.startswith(differs) for check in checks if not check.agrees)


def branch_that_stays(run):
    """The same run, which rises again far above its peak."""
    return run.assign(rms_tangential=run["rms_tangential"] + 12e-3 * (run["speed"] > 1400))


def test_torsion_is_a_maximum_of_its_own():
    speed = np.arange(1600.0, 1661.0, 5.0)
    level = 1e-5 * (speed - 1500.0)
    run = xr.Dataset({"rms_normal": ("speed", level)}, coords={"speed": speed})
    assert np.isnan(torsion_speed(run))
    run["rms_normal"][6] *= 2.0
    assert torsion_speed(run) == 1630.0


def test_checks_that_differ_come_first_and_ours_alone_last():
    checks = [Check("alone", None, 19.0), Check("good", 10.0, 10.01), Check("bad", 10.0, 12.0), claim("worst", False, "0.3")]
    _, rows = checks_table(checks, [Check("good", 10.0, 10.02)])
    assert [row[0] for row in rows] == ["worst", "bad", "good", "alone"]
    assert rows[0][2:6] == ["yes", "no (0.3)", "", "no"]
    assert rows[1][4:] == ["20%", "no", "", "", ""]
    assert rows[2][5:] == ["yes", "10.02", "0.2%", "yes"]
    assert rows[3][2:6] == ["", "19", "", ""]
    assert score(checks) == "1 of 3"
    assert [row[0] for row in differences(checks, checks)[1]] == ["worst", "bad"]


def test_every_number_is_of_one_kind():
    """Counts of the kinds add up to all, in both tables of counts."""
    checks = [*window_checks(published_runs()), Check("volume of the blade", 1.0, 1.0), Check("Ref 1B/4: Campbell", 1.0, 1.0)]
    checks += [Check("S50: slope of 1B's dynamic clearance (prototype)", 1.0, 1.0)]
    checks += survey_checks(
        {name: survey_of({}, 1e-5) for name in ("Ref_lined", "Ref_direct", "CS100_lined")}, published_runs()
    )
    for table in (kinds(checks, checks), summary(checks)):
        *parts, whole = [int(row[1].split(" of ")[1]) for row in table[1]]
        assert sum(parts) == whole == sum(check.published is not None for check in checks)


def test_table_of_choices_marks_what_is_missing_and_what_goes_on():
    runs = published_runs()
    poor = {
        **runs,
        "Ref_4": with_history(branch(1717.0, high=1718.0), {1717.0: 40, 1800.0: np.nan}),
        "L50_4": branch(1672.0, normal=0.0, tangential=1e-4),
    }
    head, (good, bad) = choices_table({"as shipped": runs, "other": poor})
    assert good[1:11] == [f"{one.peak:g}" for one in INTERACTIONS]
    assert good[head.index("drops")] == "10 of 10"
    assert bad[1:3] == ["at least 1717", "none"]
    assert bad[head.index("largest error")] == "1 without a peak"
    assert set(SHORT) < set(head)


def test_runs_have_the_published_speeds(root):
    for keys, of in (
        (windows.speeds(windows.fine, ["direct"], 2.0), windows.fine),
        (windows.speeds(windows.narrow, ["direct"], 4.0), windows.narrow),
    ):
        settings = read_settings(root, command_line(keys))
        for one in INTERACTIONS:
            assert set(of(one)) <= set(settings.speed_plans[one.blade, "abradable"].certain)
        assert {1344.0, 1717.0, 1800.0} <= set(settings.speed_plans["Ref", "direct"].certain)
    assert all(one.peak in windows.narrow(one) for one in INTERACTIONS)
    assert windows.grid(10.0, -3.0, 4.0, 2.0) == [8.0, 10.0, 12.0, 14.0]


def command_line(keys):
    """Keys of a run as a document."""
    from r37core.config import command_line_document

    return command_line_document(keys)


def test_each_choice_varies_one_thing(settings):
    """What a scene of validation/scenes.yaml does not vary is shipped."""
    varied = read_settings(Path(__file__).parents[2], command_line({"scenes_file": "validation/scenes.yaml", "scenes": "all"}))
    lined = {f"abradable_{name}" for name in windows.CHOICES}
    direct = {f"direct_{name}" for name in windows.CHOICES if name not in windows.OF_LINING}
    assert set(varied.scenes) == lined | direct
    for name, chosen in varied.scenes.items():
        kind, _, choice = name.partition("_")
        shipped = settings.scenes[kind].scene
        changed = [field for field in vars(shipped) if getattr(shipped, field) != getattr(chosen.scene, field)]
        assert len(changed) == (choice not in windows.TIP_LINES), name
        assert chosen.tip_line == windows.TIP_LINES.get(choice, "pressure_edge")
    friction = varied.scenes["abradable_perturbed"].scene.friction
    assert friction.coefficient == pytest.approx(1.001 * settings.scenes["abradable"].scene.friction.coefficient)


def test_pictures_show_every_blade_and_both_scenes():
    survey = {name: branch(1200.0, low=750.0, high=2000.0) for name in ("lined", "direct")}
    for figure in (draw_reference(survey["lined"], survey["direct"]), draw_stress_over_speed(survey)):
        assert figure.axes[0].get_legend_handles_labels()[1][:2] == ["abradable lining", "bare casing"]
    assert len(draw_widths(published_runs()).axes[0].patches) == len(BLADES)
    plt.close("all")


def survey_of(responses, median):
    """The whole range with a response of so many metres, normal and radial, at single speeds."""
    speed = np.arange(750.0, 2001.0, 5.0)
    run = xr.Dataset({"rms_normal": ("speed", np.full(len(speed), median))}, coords={"speed": speed})
    run = run.assign(rms_radial=run["rms_normal"].copy())
    for at, (normal, radial) in responses.items():
        run["rms_normal"].loc[{"speed": at}], run["rms_radial"].loc[{"speed": at}] = normal, radial
    return run


def test_survey_counts_responses_beside_the_interactions():
    ref = {840.0: (4e-3, 2e-3), 1630.0: (6e-4, 1e-4), 1345.0: (2e-3, 4e-4), 1350.0: (2e-3, 4e-4)}
    survey = {"Ref_lined": survey_of(ref, 0.02e-3), "Ref_direct": survey_of({}, 0.13e-3)}
    survey["CS100_lined"] = survey_of({900.0: (2e-3, 0.0), 1000.0: (2e-3, 0.0), 1100.0: (2e-3, 0.0)}, 0.02e-3)
    shipped = {"Ref_4": branch(1717.0), "CS100_4": branch(1407.0)}
    shipped["CS100_4"]["max_von_mises_last_revolution"][5:] += 1.5 * YIELD * (shipped["CS100_4"]["speed"][5:] < 1400.0)
    checks = {check.name: check for check in survey_checks(survey, shipped)}
    assert [name for name, check in checks.items() if not check.agrees] == []
    assert any(check.detail == "3 and 2" for check in checks.values())
    # the median is counted once, of the radial displacement, and the normal one is named
    survey["Ref_direct"]["rms_normal"][:] = 0.234e-3
    medians = [check for check in survey_checks(survey, shipped) if "median rms, radial" in check.name]
    assert [check.shown for check in medians] == ["0.02 (normal to the casing 0.02)", "0.13 (normal to the casing 0.23)"]
    assert all(check.agrees for check in medians)
    survey["Ref_lined"]["rms_radial"].loc[{"speed": 1345.0}] = 0.9e-3
    differing = [check.name for check in survey_checks(survey, shipped) if not check.agrees]
    assert differing == ["Ref lined, 750 to 2000: no other rms above 0.8 mm, radial"]


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
        "good": ("9.95 to 10.2", "yes"),
        "good but outside": ("10.2", "no"),
        "width": ("16 to 30 (1 of 3 none)", "yes"),
        "wear": ("4.1 to 4.4", "no"),
        SAID: ("1 of 3", "yes"),
        "never": ("0 of 3", "no"),
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


def test_what_differs_comes_first(judged):
    head, rows = ranges_table(list(judged.values()))
    assert head[0] == "what" and head[-1] == "inside"
    assert [row[0] for row in rows] == ["wear", "never", "width", SAID, "good but outside", "good"]
    assert rows[0][1:] == ["mm", "5", "4", "4.2", "4.1 to 4.4", "no"]
    assert [count for _, count in counts(list(judged.values()))] == [1, 1, 2, 2]
