"""Scores of the modelling choices against the published numbers, on runs made by hand."""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from defaults import Casing, IntegrationChoice, Scene

from r37core.cases import runner
from r37core.cases.case import Case
from r37core.cases.runner import run_case
from r37core.dataset_file import read_dataset
from r37core.fem.material import Material
from r37core.figures import style
from r37core.results import measures
from r37core.stress.operator import StressOperator
from validation.published import BLADES, INTERACTIONS
from validation.studies import measures as own_measures
from validation.studies.checks import Check, claim, score, validation_table
from validation.studies.modelling_choices.cases import CHOICES, DIRECT, HISTORIES, SHIPPED, VARIED, cases, grid, windows
from validation.studies.modelling_choices.figures import draw_blades, draw_choices, draw_reference, draw_stress
from validation.studies.modelling_choices.report import choices_table, runs_of
from validation.studies.modelling_choices.validation import Runs, choice_checks, survey_checks, torsion_speed
from validation.studies.sections import SpeedSteps

YIELD = 1.38e9
STEPS = SpeedSteps(fine=2.0, coarse=4.0, survey=5.0)
UNITS = ("rms_normal", "rms_radial", "rms_tangential", "max_von_mises", "max_wear", "casing_hits", "status")


def branch(peak, order=4, normal=4e-3, tangential=19e-3, low=None, high=None):
    """A response that rises to its peak and drops, yielding over the 17 rad/s before its end, every 2 rad/s."""
    speed = np.arange(peak - 40 if low is None else low, peak + 41 if high is None else high, 2.0)
    level = np.where(speed <= peak, np.maximum(1 - (peak - speed) / 40, 0.02), 0.02)
    stress = np.where((speed > peak - 17) & (speed <= peak), 2.0 * YIELD, 0.0)
    values = {name: np.zeros(len(speed)) for name in UNITS}
    values |= {"rms_normal": normal * level, "rms_tangential": tangential * level, "max_von_mises": stress}
    values |= {"max_wear": 5e-3 * level, "casing_hits": level}
    run = xr.Dataset({name: ("speed", value) for name, value in values.items()}, coords={"speed": speed})
    run = run.assign_coords(tip_point=["leading_edge", "trailing_edge"], lobes=np.arange(21))
    return run.assign(yield_stress=YIELD, **with_lobes(run, order), **touching_from(run, 8))


def with_lobes(run, order):
    """Wear of so many lobes, beside the casing's own two, which are larger."""
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
    runs["S100_4"]["max_von_mises"] *= 0.3
    runs["Ref_4"] = with_history(branch(1717.0), {1717.0: 40, 1800.0: np.nan})
    runs["Ref_4"]["max_von_mises_history"].loc[{"history_speed": 1800.0}] = 0.1 * YIELD
    direct = with_history(branch(1344.0, high=1900.0), {1344.0: 88, 1717.0: np.nan, 1800.0: np.nan})
    direct["max_von_mises_history"].loc[{"history_speed": 1717.0}] = np.where(direct["revolution"] < 19, 0.6, 0.4) * YIELD
    return runs | {DIRECT: direct}


def test_runs_as_published_agree_in_every_check():
    checks = choice_checks(published_runs())
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
        (
            lambda runs: {"Ref_7": runs["Ref_7"].assign(with_lobes(runs["Ref_7"], 6))},
            "Ref 1B/7: lobes of the wear at the peak",
        ),
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
            lambda runs: {DIRECT: runs[DIRECT].assign(max_von_mises_history=3 * runs[DIRECT]["max_von_mises_history"])},
            "direct at 1800: below yield",
        ),
        (lambda runs: {DIRECT: branch_that_stays(runs[DIRECT])}, "direct: low above, its median less than half"),
    ],
)
def test_what_is_not_as_published_differs(change, differs):
    runs = published_runs()
    checks = choice_checks(runs | change(runs))
    assert any(check.name.startswith(differs) for check in checks if not check.agrees)


def branch_that_stays(run):
    """The same run, which rises again far above its peak."""
    return run.assign(rms_tangential=run["rms_tangential"] + 12e-3 * (run["speed"] > 1400))


def test_a_peak_is_that_of_the_whole_motion():
    run = branch(1642.0, normal=1e-5, tangential=9e-3)
    run["rms_normal"][-5] = 5e-5
    assert measures.peak_speed(run) == 1642.0
    assert np.isnan(measures.peak_speed(branch(1642.0, normal=1e-5, tangential=1e-3)))
    assert np.isnan(measures.peak_speed(branch(1642.0, low=1642.0)))


def test_width_is_from_the_first_to_the_last_speed_above_yield():
    stress = np.array([0.0, 2.0, 0.0, 0.0, 0.5, 1.5, 0.9, 2.0, 0.0])
    data = {
        "max_von_mises": ("speed", YIELD * stress),
        "rms_normal": ("speed", stress),
        "rms_tangential": ("speed", 0 * stress),
        "status": ("speed", np.zeros(9)),
    }
    run = xr.Dataset(data, coords={"speed": 2.0 * np.arange(9)}).assign(yield_stress=YIELD)
    assert measures.width_above_yield(run) == pytest.approx((14 + 1) - (0 + 1))
    assert np.isnan(measures.width_above_yield(run.isel(speed=slice(0, 8))))
    assert measures.width_above_yield(run.assign(yield_stress=10 * YIELD)) == 0.0
    # a run that diverged is above yield, and its end stays where it is
    run["max_von_mises"][7], run["status"][7] = np.nan, 1
    assert measures.width_above_yield(run) == pytest.approx(14 - (0 + 1))


def test_overtaking_must_last():
    theirs = np.ones(20)
    ours = np.array([2.0, 0.5, 2.0, *np.full(17, 2.0)])
    assert own_measures.overtakes(ours, theirs) == 3
    assert np.isnan(own_measures.overtakes(theirs, ours))


def test_torsion_is_a_maximum_of_its_own():
    speed = np.arange(1600.0, 1661.0, 5.0)
    level = 1e-5 * (speed - 1500.0)
    run = xr.Dataset({"rms_normal": ("speed", level)}, coords={"speed": speed})
    assert np.isnan(torsion_speed(run))
    run["rms_normal"][6] *= 2.0
    assert torsion_speed(run) == 1630.0


def test_checks_that_differ_come_first_and_ours_alone_last():
    checks = [Check("alone", None, 19.0), Check("good", 10.0, 10.01), Check("bad", 10.0, 12.0), claim("worst", False, "0.3")]
    lines = validation_table(checks, {"half_step": [Check("good", 10.0, 10.02)]}).splitlines()
    assert lines[0].startswith("1 of 3 ")
    assert [line.split("|")[1].strip() for line in lines[4:]] == ["worst", "bad", "good", "alone"]
    cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines[4:]]
    assert cells[0][2:4] == ["no (0.3)", "**differs**"]
    assert cells[1][3] == "**20%**"
    assert cells[2][4] == "10.02"
    assert cells[3][1:4] == ["", "19", ""]
    assert score(checks) == "1 of 3"


def test_table_of_choices_marks_what_is_missing_and_what_goes_on():
    runs = published_runs()
    going_on = with_history(branch(1717.0, high=1718.0), {1717.0: 40, 1800.0: np.nan})
    poor = {"Ref_4": going_on, "L50_4": branch(1672.0, normal=0.0, tangential=1e-4)}
    lines = choices_table({SHIPPED: runs, "baseline": poor}).splitlines()
    good, bad = ([cell.strip() for cell in line.split("|")[1:-1]] for line in lines[2:])
    assert good[1:11] == [f"{one.peak:g}" for one in INTERACTIONS]
    assert good[12] == "10 of 10"
    assert bad[1:4] == ["≥ 1717", "none", ""]
    assert bad[11] == "1 differ"


def test_every_choice_is_varied_on_all_blades():
    for name, choice in VARIED.items():
        found = windows(choice, STEPS)
        assert {window.blade for window in found.values()} == set(BLADES), name
        assert (DIRECT in found) == (not name.startswith(("width", "yield"))), name
        assert all(one.peak in found[one.name].speeds for one in INTERACTIONS)
    shipped = windows(CHOICES[SHIPPED], STEPS)
    assert all(window.follow for name, window in shipped.items() if name not in (DIRECT, HISTORIES))
    assert {1344.0, 1345.0, 1800.0} <= set(shipped[DIRECT].speeds)
    for window in shipped.values():
        assert set(window.history_speeds) <= set(window.speeds)
    assert grid(10.0, -3.0, 4.0, 2.0) == (8.0, 10.0, 12.0, 14.0)


STRESS = StressOperator(np.empty((6, 1, 1)), 1, "airfoil")


def fake_run(model, speed, scene, choice, results, **kept):
    """Stands for the time integration: above yield from 995 to 1010 rad/s, the largest motion at 1010."""
    level = float(995.0 < speed <= 1010.0)
    return {
        "status": np.array(0),
        "time_step": np.array(choice.time_step),
        "cone_angle": np.array(0.0),
        "rms": np.full((2, 3), level * speed),
        "peak": np.zeros((2, 3)),
        "revolution_maxima": np.zeros((choice.revolutions, 2, 3)),
        "max_von_mises": np.array(2.0 * level * YIELD),
        "revolution_von_mises": np.full(choice.snapshot_revolutions, 2.0 * level * YIELD),
        "stress_region": np.array("airfoil"),
        "static_stress": np.array(0),
    }


def test_a_window_is_followed_to_where_the_stress_is_below_yield(tmp_path, monkeypatch):
    monkeypatch.setattr(runner, "run_speed", fake_run)
    monkeypatch.setattr(runner, "prepared", lambda *_: None)
    steel = Material(2e11, 8000.0, 0.3, YIELD)
    choice = IntegrationChoice(1e-7, 3, 62, snapshots_per_revolution=31)
    still = Case("Ref", "pressure_edge", Scene(Casing(1e-4)), choice, (1000.0, 1003.0, 1006.0),
                 ("stress",), steel, {}, history_speeds=(1003.0,))  # fmt: skip
    run_case(still, None, STRESS, tmp_path / "still.nc")
    run_case(replace(still, follow=True), None, STRESS, tmp_path / "found.nc")
    found = runs_of({"a/Ref_4": read_dataset(tmp_path / "found.nc")})["a"]["Ref_4"]
    assert list(found["speed"].values) == [994.0, 997.0, 1000.0, 1003.0, 1006.0, 1009.0, 1012.0]
    # the largest motion is at 1009
    assert list(found["history_speed"].values) == [1003.0, 1009.0]
    assert np.all(found["max_von_mises_history"].sel(history_speed=1009.0) == np.float32(2.0 * YIELD))
    still = read_dataset(tmp_path / "still.nc")
    assert still.sizes["speed"] == 3
    assert list(still["history_speed"].values) == [1003.0]


def test_pictures_show_every_blade_and_both_scenes():
    shipped = published_runs()
    survey = {name: branch(1200.0, low=750.0, high=2000.0) for name in ("Ref_lined", "Ref_direct")}
    figures = [draw_reference(survey, shipped), draw_blades(shipped), draw_stress(shipped)]
    for figure, legend in zip(
        figures, (["abradable lining", "direct contact"], list(BLADES), [*BLADES, "yield stress", style.OUTSIDE]), strict=True
    ):
        assert figure.axes[0].get_legend_handles_labels()[1] == legend
    speed, level = figures[0].axes[0].lines[0].get_data()
    assert np.all(np.diff(speed) > 0.0)
    # the finer windows stand in the survey's curve
    assert level[np.searchsorted(speed, 838.0)] == pytest.approx(4.0)
    errors = draw_choices({SHIPPED: shipped}).axes[0]
    assert "10 of 10" in [text.get_text() for text in errors.texts]
    plt.close("all")


def test_steepest_fall_is_where_a_noisy_branch_ends():
    level = np.array([1.0, 1.2, 1.1, 1.19, 0.5, 0.4])
    data = {"rms_normal": ("speed", 0.0 * level), "rms_tangential": ("speed", level)}
    speed, share = own_measures.steepest_fall(xr.Dataset(data, coords={"speed": 1340.0 + np.arange(6)}))
    assert speed == 1343.0
    assert share == pytest.approx(0.69 / 1.19)


def test_varied_choices_take_the_quick_level_and_the_shipped_one_the_published(settings):
    planned = cases(settings)
    published, quick = (settings.levels[name].time_integration.choice(lined=True) for name in ("paper", "standard"))
    assert planned["shipped/Ref_4"].choice == published
    assert planned["half_step/Ref_4"].choice == replace(published, time_step=0.5 * published.time_step)
    assert {planned[name].choice for name in ("exact/Ref_4", "quick/Ref_4", "survey/Ref_lined")} == {quick}
    assert quick != published


def test_the_perturbed_choice_perturbs_friction(settings):
    shipped, perturbed = (cases(settings)[f"{name}/Ref_4"].scene for name in ("shipped", "perturbed"))
    friction = shipped.friction
    assert perturbed == replace(shipped, friction=replace(friction, coefficient=1.001 * friction.coefficient))


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
    shipped["CS100_4"]["max_von_mises"][5:] += 1.5 * YIELD * (shipped["CS100_4"]["speed"][5:] < 1400.0)
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


def test_a_median_does_not_depend_on_where_speeds_lie_close():
    plain = np.arange(750.0, 2001.0, 5.0)
    refined = np.unique(np.concatenate([plain, np.arange(1700.0, 1730.0, 0.25)]))
    runs = [xr.Dataset({"rms_radial": ("speed", np.abs(speeds - 1715.0))}, {"speed": speeds}) for speeds in (plain, refined)]
    ours = [own_measures.median_over_speed(run, "rms_radial") for run in runs]
    assert ours[0] == float(runs[0]["rms_radial"].median())
    assert ours[1] == pytest.approx(ours[0], abs=5.0)
