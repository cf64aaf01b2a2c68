"""Further runs of a verdict: which are done, where, and that each is the run it claims to be."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from defaults import IntegrationChoice, Lining
from integration_cases import ABRADABLE, DIRECT

from r37core.contact.scene import DampingRow
from r37core.results.operating_range import OperatingRange
from r37core.results.response import run_row
from r37core.stress.recovery import stress_operators
from r37core.stress.statistic import UNKNOWN
from r37core.sweep.parts import Parts
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed
from r37core.time_integration.status import RunStatus
from r37studies.requirements import choice
from r37studies.requirements import looks as further_runs
from r37studies.requirements.choice import Requirements
from r37studies.requirements.evidence import HALF_FRICTION, Evidence, beyond_model
from r37studies.requirements.judging import (
    BRIEF_RISE,
    DOWN,
    FAILS,
    FAST_RISE,
    HALF_STEP,
    HIGHEST_DAMPING,
    LARGE_CHANGES,
    LESS_FRICTION,
    LOWEST_DAMPING,
    MORE_FRICTION,
    REPEATED,
    REST,
    SLIGHTLY_MORE_FRICTION,
    SLOW_RISE,
    SLOWEST_RISE,
    SUDDEN_RISE,
    UP,
    judge,
)
from r37studies.requirements.looks import JudgedBlade, joined_looks, looks_in, looks_of
from r37studies.run_up_integration import RunUpIntegration
from r37studies.run_up_revolutions import record_run_up
from r37studies.run_up_schedule import RunUp

CHOICE = IntegrationChoice(6.4e-6, 12, 62, integrator=EXACT_MODAL)
KEPT = {"spectrum_highest_order": 4, "wear_angles": 8}
LINED = replace(
    ABRADABLE,
    casing=replace(ABRADABLE.casing, rise_fraction=0.5),
    damping_ratio=(DampingRow(0.0005, lowest=0.0, highest=0.5),),
    lining=Lining(5e-3, 20e9, 5e9, 1.5, bars=200, bar_width=1e-3),
)
FLOWN = OperatingRange(1300.0, 1310.0)
NEEDS = Requirements(used_lining=0.5)
LARGE_LOOKS = (REST, *LARGE_CHANGES, UP, DOWN)
RESULTS = ("wear", "spectrum")


@pytest.fixture
def lined(contact, monkeypatch, tmp_path):
    """A lined blade whose runs end after 20 revolutions at the latest."""
    monkeypatch.setattr(further_runs, "LONGEST", 20)
    monkeypatch.setattr(further_runs, "FOLLOWED", 48)
    monkeypatch.setattr(further_runs, "MOST_NEAR", 1)
    monkeypatch.setattr(choice, "RUN_UPS", (4,))
    monkeypatch.setattr(further_runs, "PUBLISHED_REVOLUTIONS", CHOICE.revolutions)
    material = {"yield_stress": 1e9, "strengths": UNKNOWN}
    blade = JudgedBlade(contact, LINED, CHOICE, RESULTS, KEPT, parts=Parts(tmp_path / "runs", "lined"), **material)
    return replace(blade, coarser=replace(blade, parts=Parts(tmp_path / "coarser", "lined")))


def evidence(used=1e-5, speeds=(1290.0, 1305.0, 1320.0)):
    content = {"used_thickness": used, "worn_through_share": 0.0, "status": int(RunStatus.COMPLETED)}
    runs = xr.Dataset(
        {name: ("speed", np.full(len(speeds), value)) for name, value in content.items()}, {"speed": list(speeds)}
    )
    return Evidence(runs.assign(lined=1.0), operating=FLOWN, thickness=5e-3, clearance=3e-4)


FAILED = evidence(used=4e-3, speeds=(1290.0, 1302.0, 1305.0, 1308.0, 1320.0))


@pytest.fixture
def asked(lined, monkeypatch):
    """Speeds of each look, which nothing is run for: in all of them the lining is as good as unused."""
    monkeypatch.setattr(
        JudgedBlade, "runs_from_rest", lambda _, speeds, *of, **changes: evidence(speeds=sorted(speeds)).response
    )
    monkeypatch.setattr(JudgedBlade, "carried", lambda _, speeds: evidence(speeds=sorted(speeds)).response)
    monkeypatch.setattr(JudgedBlade, "run_up", lambda _, start, stop, revolutions, speeds: evidence(speeds=speeds).response)
    monkeypatch.setattr(further_runs, "MOST_NEAR", 1)

    def speeds(of=FAILED, needs=NEEDS, blade=lined, **numbers):
        for name, number in numbers.items():
            monkeypatch.setattr(further_runs.judging, name, lambda _, of, number=number: number(of.speeds))
        return {name: runs["speed"].values.tolist() for name, runs in looks_of(blade, needs, of)}

    return speeds


@pytest.mark.slow
def test_what_is_run_where_nothing_fails_and_each_is_the_run_that_it_claims_to_be(lined, contact):
    found = dict(looks_of(lined, NEEDS, evidence()))
    # (1310^2 - 1300^2) / 2 over four revolutions
    run_ups = [f"in a run-{direction} at 519 rad/s2" for direction in ("up", "down")]
    assert [*found] == [*LARGE_LOOKS, *run_ups, *REPEATED]
    assert found[REST]["speed"].values.tolist() == [1300.0, 1302.5, 1305.0, 1307.5, 1310.0]
    for motion in (UP, DOWN):
        assert found[motion]["speed"].values.tolist() == [1300.0, 1305.0, 1310.0]
    # a file of them gives them back
    again = looks_in(joined_looks(found))
    for name, runs in found.items():
        xr.testing.assert_allclose(again[name][["used_thickness", "status"]], runs[["used_thickness", "status"]])
    # lobes rise as in the runs of the sweep
    rising = replace(LINED, casing=replace(LINED.casing, rise_revolutions=LINED.casing.rise_fraction * CHOICE.revolutions))
    friction, damped, casing = rising.friction, (replace(rising, damping_ratio=ratio) for ratio in (0.0, 0.5)), rising.casing
    factors = {MORE_FRICTION: 1.01, LESS_FRICTION: 0.99, SLIGHTLY_MORE_FRICTION: 1.001}
    rises = {FAST_RISE: 0.6, SUDDEN_RISE: 1.0, BRIEF_RISE: 4.0, SLOW_RISE: 12.0, SLOWEST_RISE: 8.0}
    scenes = {REST: rising, HALF_STEP: rising} | dict(zip((LOWEST_DAMPING, HIGHEST_DAMPING), damped, strict=True))
    for look, factor in factors.items():
        scenes[look] = replace(rising, friction=replace(friction, coefficient=factor * friction.coefficient))
    for look, revolutions in rises.items():
        scenes[look] = replace(rising, casing=replace(casing, rise_revolutions=revolutions))
    changes = {HALF_STEP: {"time_step": 0.5 * CHOICE.time_step}}
    lengths = set()
    used = {}
    for name, scene in scenes.items():
        run = found[name].sel(speed=1305.0, method="nearest")
        # a motion that grows is followed
        choice = replace(CHOICE, revolutions=48 if run["followed"] else 20, until_settled=True, **changes.get(name, {}))
        lengths.add(choice.revolutions)
        row = run_row(run_speed(contact, float(run["speed"]), scene, choice, RESULTS, **KEPT), 1e9, UNKNOWN)
        used[name] = run["used_thickness"].item()
        assert used[name] == pytest.approx(row["used_thickness"].item(), rel=1e-9)
        # next to a followed run's
        np.testing.assert_allclose(run["amplitude"].dropna("engine_order"), row["amplitude"], rtol=1e-6, atol=1e-12)
    assert len(set(used.values())) == 12 and lengths == {20, 48}


def test_runs_that_are_there_are_not_run_again(lined, tmp_path, monkeypatch):
    """Nor those of a motion that is carried on, which goes on from the last of them."""
    kept, few = replace(lined, parts=Parts(tmp_path, "lined")), replace(evidence(), operating=OperatingRange(1304.0, 1309.0))
    expected = dict(looks_of(kept, NEEDS, few))
    files = sorted(tmp_path.glob("speed_*.npz"))
    for file in files[::3]:
        file.unlink()
    run, done = Simulation.run, []
    monkeypatch.setattr(Simulation, "run", lambda self, *of: done.append(1) or run(self, *of))
    again = dict(looks_of(kept, NEEDS, few))
    assert len(done) == len(files[::3])
    for name, runs in expected.items():
        xr.testing.assert_identical(again[name], runs)


def test_stress_before_a_run_settles_is_known(contact, model, steel, lined):
    """The largest stress of all revolutions, which a run that keeps all of them says, lies before the statistic here."""
    stress = {"box": stress_operators(model, steel)["box"]}
    choice = replace(CHOICE, snapshots_per_revolution=31)
    blade = replace(lined, scene=ABRADABLE, choice=choice, results=("stress",), stress=stress)
    speed = 1340.0
    (largest,) = blade.runs_from_rest([speed])["max_von_mises_ever"].values
    every = replace(choice, revolutions=20, until_settled=True, snapshot_revolutions=20)
    run = run_speed(contact, speed, blade.rising_scene, every, ("stress",), stress=stress, **KEPT)
    history = run["revolution_von_mises"][0]
    assert largest == history.max() > 1.1 * history[-10:].max()


@pytest.mark.parametrize("ends", [(1300.0, 1340.0), (1340.0, 1300.0)])
def test_a_run_up_has_the_largest_stress_about_each_speed(contact, model, steel, lined, ends, monkeypatch):
    """And all the wear of the run-up; next to speeds without a revolution that of the nearest."""
    stress, speeds, results = {"box": stress_operators(model, steel)["box"]}, [1300.0, 1320.0, 1340.0], ("stress", "wear")
    choice = replace(CHOICE, snapshots_per_revolution=31)
    blade = replace(lined, choice=choice, results=(*results, "spectrum"), stress=stress)
    runs = blade.run_up(*ends, 12.0, speeds)
    run_up = RunUp(*ends, 12.0, 12, 0, False)
    integration = RunUpIntegration(contact, blade.rising_scene, replace(choice, snapshot_revolutions=12), run_up)
    expected = record_run_up(integration, results, highest_order=0, stress=stress["box"], yield_stress=1e9)
    revolutions = pd.DataFrame({name: expected[name] for name in ("speed", "max_von_mises")})
    for speed in speeds:
        away = (revolutions["speed"] - speed).abs()
        about = revolutions[away <= max(2.5, away.min())]["max_von_mises"]
        assert runs["max_von_mises_inside"].sel(speed=speed) == about.max()
    # all the heat where the run-up is no longer than a run of the sweep, else that of the worst of these
    (heat,) = {*blade.run_up(*ends, 12.0, speeds)["friction_heat"].values}
    short = replace(blade, choice=replace(blade.choice, revolutions=4, snapshot_revolutions=4))
    assert heat > short.run_up(*ends, 12.0, speeds)["friction_heat"].max() > heat / 6.0
    assert runs["used_thickness"].min() == runs["used_thickness"].max() > expected["max_wear"][-1] > 0.0
    # what comes before the exit counts, also of a run-up that diverges after it
    monkeypatch.setattr(further_runs, "melting_power", lambda *_: 0.95 * heat)
    monkeypatch.setattr(further_runs, "record_run_up", lambda *_, **__: expected | {"status": np.array(1)})
    monkeypatch.setattr(RunUpIntegration, "__init__", lambda self, *_: self.__dict__.update(state=integration.state))
    left = blade.run_up(*ends, 12.0, speeds).sel(speed=[*ends])
    assert left["exit_revolution"].isnull().values.tolist() == [True, False]
    assert left["max_von_mises_inside"].values.tolist() == [runs["max_von_mises_inside"].sel(speed=ends[0]), 0.0]
    assert not left["status"].any()


def test_a_motion_is_carried_on_in_a_new_lining(lined):
    up = lined.carried([1300.0, 1305.0])
    down = lined.carried([1305.0, 1300.0])
    assert up["speed"].values.tolist() == down["speed"].values.tolist() == [1300.0, 1305.0]
    # the first speed of each is from rest
    alone = lined.carried([1305.0])
    used = [float(runs["used_thickness"].sel(speed=1305.0)) for runs in (up, down, alone)]
    assert used[0] != used[1] == used[2]
    # as long as a run from rest may be
    row = run_row(run_speed(lined.model, 1305.0, LINED.grown, lined.long_choice, ("wear",), **KEPT), 1e9, UNKNOWN)
    assert float(alone["share_of_time_in_contact"][0]) == row["share_of_time_in_contact"]


def test_a_short_run_fails_nothing_clearly(asked, lined):
    short = replace(lined, choice=replace(CHOICE, revolutions=CHOICE.revolutions - 1))
    assert asked(blade=short)[UP] and UP not in asked()


def test_other_friction_and_step_are_tried_closest_to_the_limit(asked):
    found = asked(evidence(), closeness=lambda speeds: -np.abs(speeds - 1302.5))
    assert [found[name] for name in (MORE_FRICTION, LESS_FRICTION, HALF_STEP)] == 3 * [[1302.5]]


def test_large_changes_are_tried_where_runs_fail_or_nearly_do(asked):
    """All speeds that fail, or the worst where that still fails; else the nearest to the limit; nothing else of what fails."""
    found = asked(nearness=lambda speeds: 1.0 - 1e-3 * (speeds - 1305.5))
    assert found == {name: [1302.0] for name in LARGE_CHANGES if name != SLOWEST_RISE}
    # the first that still fails ends it, of what fails clearly
    numbers = {"nearness": lambda speeds: 1.0 - 1e-3 * (speeds - 1308.5) - (speeds < 1304.0) * (len(speeds) == 1)}
    for clearly in (True, False):
        found = asked(**numbers, fails_clearly=lambda _, clearly=clearly: clearly)
        assert (found[FAST_RISE] == [1302.0, 1305.0]) == clearly
    # of what fails the slowest rise is not tried
    found = asked(evidence(), nearness=lambda speeds: (1.0 - 1e-3 * (speeds - 1302.5)) * (len(speeds) > 1))
    assert all(found[name] == [1300.0, 1301.25, 1302.5] for name in LARGE_CHANGES if name in found)


def test_the_worst_speeds_of_each_limit_are_tried(lined):
    """Of two limits the farther one has its own worst speed among those that are run in other ways."""
    speeds = np.arange(1300.0, 1310.1, 1.0)
    numbers = {"goodman_share_inside": 0.9 - 0.01 * (speeds - 1300.0), "used_thickness": 1e-5 * (speeds - 1299.0)}
    runs = evidence(speeds=speeds).response.assign({name: ("speed", values) for name, values in numbers.items()})
    both = Requirements(used_lining=0.5, goodman_share=1.0)
    nearest = further_runs._nearest(both, evidence().replaced(runs), further_runs.judging.nearness, 8)
    assert nearest == [*speeds[:8], *speeds[-1:-4:-1]]
    # the eight that are nearest to any limit, and the six of the lining of which three are among them
    assert further_runs._nearest(NEEDS, evidence().replaced(runs), further_runs.judging.nearness, 8) == [*speeds[:2:-1]]


def test_half_the_friction_is_tried_of_the_run_that_diverged_soonest(lined):
    """What it says stands in the note on the divergence, and judges nothing."""
    gone = evidence().response.assign(
        status=("speed", [0, RunStatus.DIVERGED, RunStatus.DIVERGED]), diverged_revolution=("speed", [np.nan, 9.0, 4.0])
    )
    runs = replace(evidence().replaced(gone), operating=OperatingRange(1300.0, 1320.0))
    found = dict(looks_of(lined, NEEDS, runs))
    assert found[HALF_FRICTION]["speed"].values.tolist() == [1320.0]
    half = replace(lined.rising_scene.friction, coefficient=0.5 * LINED.friction.coefficient)
    expected = lined.runs_from_rest([1320.0], replace(lined.rising_scene, friction=half))
    xr.testing.assert_identical(found[HALF_FRICTION], expected)
    alone = replace(runs, looks={HALF_FRICTION: expected})
    (judgement,) = judge(NEEDS, alone)
    told = "every run diverged, soonest at 1320 rad/s after 4 revolutions"
    assert (
        judgement["verdict"] == FAILS
        and f"{told}; with half the friction this run ends: friction drives it" in judgement["note"]
    )
    # nor does it take the blade beyond the model's limits
    melting = expected.assign(friction_power=("speed", [1e9]), melting_power=1.0)
    assert beyond_model(replace(runs, looks={REST: melting}))
    assert not beyond_model(replace(runs, looks={HALF_FRICTION: melting}))


@pytest.mark.parametrize(("length", "count"), [(0.0, 1), (15.0, 3)])
def test_a_length_that_fails_is_tried_at_all_speeds(asked, length, count):
    """A speed that stays above yield says nothing of the length."""
    numbers = {"nearness": lambda speeds: np.full(len(speeds), 1.2), "fails_clearly": lambda _: ["above_yield"]}
    assert len(asked(FAILED, Requirements(above_yield=length), **numbers)[FAST_RISE]) == count


def test_nothing_more_is_run_of_what_fails(asked, monkeypatch):
    monkeypatch.setattr(further_runs, "_large_changes", lambda *_: iter(()))
    quiet = evidence().response.assign(share_of_time_in_contact=("speed", np.zeros(3)))
    assert asked() == asked(evidence().replaced(quiet)) == {}
    assert joined_looks({}).sizes == {"look": 0} and looks_in(joined_looks({})) == {}
    # also where the runs from rest show it
    assert tuple(asked(evidence(), fails_clearly=lambda speeds: len(speeds) == 5)) == (REST,)


def test_without_friction_only_the_step_is_changed(asked, lined):
    bare = replace(lined, scene=replace(DIRECT, friction=None), results=(), coarser=None)
    run_ups = tuple(f"in a run-{direction} at 519 rad/s2" for direction in ("up", "down"))
    assert tuple(asked(evidence(), blade=bare)) == (
        REST,
        SUDDEN_RISE,
        BRIEF_RISE,
        SLOW_RISE,
        SLOWEST_RISE,
        UP,
        DOWN,
        *run_ups,
        HALF_STEP,
    )


SPEEDS, NEAR = 1000.0 + 2.5 * np.arange(4), np.array([0.2, 0.6, 0.61, 0.2])
KNOWN = np.concatenate([1100.0 + 10.0 * count + np.array([-0.1, 0.0, 0.1]) for count in range(12)])


@pytest.mark.parametrize(
    ("speeds", "near", "expected"),
    [
        (SPEEDS, [0.1, 0.8, 0.2, 0.6], [1001.25, 1003.75]),
        (SPEEDS, [0.1, 1.2, 0.2, 0.3], [1001.25, 1003.75]),
        # what diverges and what lies far below are no peaks, nor is there anything between speeds that stand close
        (SPEEDS, [0.1, np.inf, 0.2, 0.3], []),
        ([1000.0, 1000.1], [0.9, 0.1], []),
        # a peak between two like speeds, and a top that is known to 3%
        (SPEEDS, NEAR, [1003.75, 1006.25]),
        (SPEEDS, 0.6 - 1e-3 * (SPEEDS - 1003.0) ** 2, []),
        # peaks that are known as well as can be take no place of others; the gap before them may hide more
        (np.append(SPEEDS, KNOWN), np.append(NEAR, np.tile([0.3, 0.9, 0.3], 12)), [1003.75, 1006.25]),
    ],
)
def test_runs_stand_closer_about_a_peak(speeds, near, expected):
    refined = further_runs._speeds_about_peaks(np.array(speeds), np.array(near), 0.03)
    assert [speed for speed in refined if speed < 1010.0] == expected


def test_a_resonance_is_found_to_the_error_that_is_asked_for():
    """A peak of 1.5 rad/s at half its height, anywhere between speeds 2.5 rad/s apart: its height within the error."""
    for place in np.linspace(1000.0, 1002.5, 11):
        speeds = np.arange(980.0, 1021.0, 2.5)

        def height(speed, place=place):
            return 0.1 + 0.8 / (1.0 + ((speed - place) / 0.75) ** 2)

        while new := further_runs._speeds_about_peaks(speeds, height(speeds), 0.033):
            speeds = np.sort(np.append(speeds, new))
        assert height(speeds).max() > 0.9 / 1.033 and len(speeds) < 40, place
    assert further_runs._closer([1000.0, 1006.0, 1007.0], 2.5) == [1000.0, 1002.0, 1004.0, 1006.0, 1007.0]
