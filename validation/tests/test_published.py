"""Published numbers next to ours, on runs made by hand."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from conftest import CHECKOUT
from evidence import published_windows as windows
from evidence.checks import Check, claim, score
from evidence.configuration import settings_of
from evidence.gallery import draw_reference, draw_stress
from evidence.published_checks import Runs, survey_checks, torsion_speed, window_checks
from evidence.published_tables import checks_table, choices_table, counts, differences
from evidence.published_windows import BARE
from plan.published import PAPER, PUBLISHED
from published import INTERACTIONS

YIELD = 1.38e9
UNITS = ("rms_normal", "rms_radial", "rms_tangential", "max_von_mises_last_revolution", "max_wear", "casing_hits", "status")


def branch(peak, order=4, normal=4e-3, tangential=19e-3, low=None, high=None):
    """A response that rises to its peak and drops, yielding over the 17 rad/s before its end, every 2 rad/s."""
    speed = np.arange(peak - 40 if low is None else low, peak + 41 if high is None else high, 2.0)
    level = np.where(speed <= peak, np.maximum(1 - (peak - speed) / 40, 0.02), 0.02)
    stress = np.where((speed > peak - 17) & (speed <= peak), 2.0 * YIELD, 0.0)
    values = {name: np.zeros(len(speed)) for name in UNITS}
    values |= {"rms_normal": normal * level, "rms_tangential": tangential * level, "max_von_mises_last_revolution": stress}
    values |= {"max_wear": 5e-3 * level, "casing_hits": level, "exit_revolution": np.full(len(speed), np.nan)}
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
    for row in INTERACTIONS:
        normal, tangential = motion[row.blade]
        run = branch(row.peak, row.engine_order, 4e-3 * normal, 19e-3 * tangential)
        runs[row.name] = with_history(run, {row.peak: 44 if row.blade == "L50" else 78})
    runs["S100_4"]["max_von_mises_last_revolution"] *= 0.3
    runs["Ref_4"] = with_history(branch(1717.0), {1717.0: 40, 1800.0: np.nan})
    runs["Ref_4"]["max_von_mises_history"].loc[{"history_speed": 1800.0}] = 0.1 * YIELD
    direct = with_history(branch(1344.0, high=1900.0), {1344.0: 88, 1717.0: np.nan, 1800.0: np.nan})
    direct["max_von_mises_history"].loc[{"history_speed": 1717.0}] = np.where(direct["revolution"] < 19, 0.6, 0.4) * YIELD
    return runs | {BARE: direct}


def test_runs_as_published_agree_in_every_check():
    checks = window_checks(published_runs())
    assert [check.name for check in checks if not check.agrees] == []
    assert len(checks) > 50
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
        (lambda runs: {"S100_4": runs["Ref_4"]}, "stress at the peak: S100 more than three times below Ref"),
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


def test_checks_that_differ_come_first_and_the_prototype_last():
    checks = [
        Check("slope (prototype)", 19.0, 1.0),
        Check("good", 10.0, 10.01),
        Check("bad", 10.0, 12.0),
        claim("worst", False, "0.3"),
    ]
    _, rows = checks_table(checks, [*checks[::2], Check("good", 10.0, 10.02), checks[3]])
    assert [row[0] for row in rows] == ["worst", "bad", "good", "slope (prototype)"]
    assert rows[0][2:6] == ["yes", "no (0.3)", "", "no"]
    assert rows[1][4:6] == ["20%", "no"]
    assert rows[2][5:] == ["yes", "10.02", "0.2%", "yes"]
    assert score(checks) == "1 of 4"
    assert [row[0] for row in differences(checks, checks)[1]] == ["worst", "bad", "slope (prototype)"]


def test_every_published_number_is_of_one_kind():
    """Counts of the kinds add up to all; slopes of the prototype stand apart."""
    checks = [*window_checks(published_runs()), Check("volume of the blade", 1.0, 1.0), Check("Ref 1B/4: Campbell", 1.0, 1.0)]
    checks += [Check("S50: slope of 1B's dynamic clearance (prototype)", 1.0, 1.0)]
    checks += [claim("1B's dynamic clearance of S50 and S100: significantly smaller than Ref's", True)]
    surveys = {name: survey_of({}, 1e-5) for name in ("Ref_lined", "Ref_direct", "CS100_lined")}
    checks += survey_checks(surveys, published_runs())
    *parts, whole, apart = [int(row[1].split(" of ")[1]) for row in counts(checks, checks)[1]]
    assert (sum(parts), apart) == (whole, 1)
    assert whole == len(checks) - 1


def test_table_of_choices_marks_what_is_missing():
    runs = published_runs()
    poor = {**runs, "L50_4": branch(1672.0, normal=0.0, tangential=1e-4)}
    head, (good, bad) = choices_table({"as shipped": runs, "other": poor})
    assert good[head.index("peaks within 0.6%")] == good[head.index("drops")] == "10 of 10"
    assert bad[head.index("largest error")] == "1 without a peak"
    assert good[head.index("first yield at 1717")] == "40"


def test_runs_have_the_published_speeds():
    paper, standard = (settings_of(CHECKOUT, **run.keys).speed_plans for run in (PAPER, PUBLISHED))
    for row in INTERACTIONS:
        assert set(windows.paper_window(row)) <= set(paper[row.blade, "abradable"].certain)
        assert set(windows.narrow(row)) < set(windows.window(row)) <= set(standard[row.blade, "abradable"].certain)
        assert set(windows.narrow(row)) <= set(standard[row.blade, "abradable_form"].certain)
        assert min(abs(speed - row.peak) for speed in windows.narrow(row)) <= 2.0
    for plans in (paper, standard):
        assert {1344.0, 1345.0, 1717.0, 1800.0} <= set(plans["Ref", "direct"].certain)
    assert windows.grid(10.0, -3.0, 4.0, 2.0) == [8.0, 10.0, 12.0, 14.0]


def test_each_choice_varies_one_thing():
    """What a scene of validation/published.yaml does not vary is shipped."""
    settings, varied = (
        settings_of(CHECKOUT, **keys) for keys in ({}, {"scenes_file": "validation/published.yaml", "scenes": "all"})
    )
    lined = {"abradable", *(f"abradable_{name}" for name in windows.CHOICES)}
    assert set(varied.scenes) == lined | {"direct", *(f"direct_{name}" for name in windows.BARE_CHOICES)}
    for name, chosen in varied.scenes.items():
        kind, _, choice = name.partition("_")
        shipped = settings.scenes[kind].scene
        changed = [field for field in vars(shipped) if getattr(shipped, field) != getattr(chosen.scene, field)]
        assert len(changed) == bool(choice), name
    friction = varied.scenes["abradable_perturbed"].scene.friction
    assert friction.coefficient == pytest.approx(1.001 * settings.scenes["abradable"].scene.friction.coefficient)


def test_pictures_show_both_scenes():
    survey = {name: branch(1200.0, low=750.0, high=2000.0) for name in ("lined", "direct")}
    for figure in (draw_reference(survey), draw_stress(survey)):
        assert figure.axes[0].get_legend_handles_labels()[1][:2] == ["abradable lining", "bare casing"]
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
