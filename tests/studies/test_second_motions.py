"""Second motions: sweeps that carry the state on, where motions differ, and the answers with them."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from defaults import Casing, IntegrationChoice, Lining, Scene
from integration_cases import ABRADABLE, DIRECT, oscillator, with_static_modes

from r37core.base.plain import to_plain
from r37core.config import ConfigError, command_line_document
from r37core.figures.response_curves import draw_response
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.product.remarks import remarks
from r37core.rom.contact_model import write_contact_model
from r37core.stress.statistic import UNKNOWN
from r37core.time_integration.carrying import END_WEAR
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.speed_run import OF_RUNS, run_speed
from r37core.time_integration.status import RunStatus
from r37studies.second_motions import steps
from r37studies.second_motions.added import ranking_with_motions
from r37studies.second_motions.choice import DOWN, MOTIONS, REST, UP, SweepChoice
from r37studies.second_motions.dataset import pair_motions
from r37studies.second_motions.figures import draw_second_motions
from r37studies.second_motions.levels import MotionLevels, motions_differ, read_levels, write_levels
from r37studies.second_motions.plan import finished_runs, results
from r37studies.second_motions.sweeping import CarriedSweep
from r37studies.second_motions.tables import RANGE_COLUMNS, closing, range_table

CHOICE = IntegrationChoice(6.4e-6, 20, 62, integrator=EXACT_MODAL)
KEPT = {"spectrum_highest_order": 4, "wear_angles": 8}
SWEEP = SweepChoice(1300.0, 1320.0, 10.0, revolutions=10)
GROWING = replace(DIRECT, casing=replace(DIRECT.casing, rise_fraction=0.2))
LINED = replace(ABRADABLE, lining=Lining(5e-3, 20e9, 5e9, 1.5, bars=200, bar_width=1e-3))


def sweep_of(model, motion, scene=GROWING, sweep=SWEEP, choice=CHOICE):
    return CarriedSweep(model, scene, choice, (), KEPT, sweep=sweep, motion=motion)


def test_the_motion_from_rest_is_the_run_of_the_pipeline(contact, tmp_path):
    """One that is at hand is not made again."""
    files = sweep_of(contact, REST).run(tmp_path / "once")
    expected = run_speed(contact, 1310.0, GROWING, CHOICE, (), **KEPT)
    numbers = read_speed(files[1])
    np.testing.assert_equal({name: numbers[name] for name in expected}, expected)
    finished = {float(read_speed(file)["speed"]): file for file in files[1:]}
    again = sweep_of(contact, REST).run(tmp_path / "again", finished=finished)
    assert again[1:] == files[1:] and len(list((tmp_path / "again").glob("*.npz"))) == 1


@pytest.mark.parametrize(
    ("motion", "changes", "speeds"), [(REST, {}, ["1000", "1010.0000000000001"]), (REST, {"lining": "worn"}, []), (UP, {}, [])]
)
def test_runs_of_the_pipeline_are_those_from_rest(root, motion, changes, speeds):
    """As speeds in rpm are, one is another in its last digit. All of their results are, too: one file has them with others."""
    section = {"from_rad_s": 1000, "to_rad_s": 1010, "scenes": ["abradable"], **changes}
    keys = {"second_motions": section, "scenes": ["abradable"], "speeds": [990, 1000, 1007, 1010.0000000000001]}
    sweep = Sweep(read_settings(root, command_line_document(keys)))
    asked = SimpleNamespace(blade="Ref", scene="abradable", motion=motion)
    assert [Path(file).stem for file in finished_runs(sweep, asked)] == [f"speed_{speed}" for speed in speeds]
    assert (results(sweep, asked) == [each for each in sweep.results(asked) if each in OF_RUNS]) == (motion == REST)


def test_a_sweep_begins_as_a_run_from_rest_that_goes_on(contact, tmp_path):
    first = read_speed(sweep_of(contact, UP).run(tmp_path)[0])
    simulation = Simulation(contact, 1300.0, GROWING, CHOICE)
    state = simulation.start()
    simulation.advance(state, 20)
    # of lobes that grow in four revolutions nothing is left to grow after twenty
    motion = simulation.advance(state, 1).samples[:, [0, 2]]
    assert first["revolution_rms"][0] == pytest.approx(np.sqrt(np.sum(np.mean(motion**2, axis=0))), rel=1e-5)


@pytest.mark.parametrize("motion", [UP, DOWN])
def test_an_interrupted_sweep_goes_on_with_the_same_bits(contact, motion, tmp_path, monkeypatch):
    sweep = replace(SWEEP, worn=True)
    whole = [read_speed(file) for file in sweep_of(contact, motion, LINED, sweep).run(tmp_path / "whole")]
    original, runs = CarriedSweep.run_on, []

    def run_on(self, speed, carried):
        if len(runs) == 2:
            raise KeyboardInterrupt
        runs.append(speed)
        return original(self, speed, carried)

    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(CarriedSweep, "run_on", run_on)
        sweep_of(contact, motion, LINED, sweep).run(tmp_path / "parts")
    files = sweep_of(contact, motion, LINED, sweep).run(tmp_path / "parts")
    np.testing.assert_equal([read_speed(file) for file in files], whole)


@pytest.mark.parametrize(("given", "expected"), [(None, 20), (10, 10)])
def test_carried_motions_are_as_long_as_those_from_rest(contact, given, expected, tmp_path):
    """Or as long as the configuration says, which the dataset of all motions has."""
    write_contact_model(contact, tmp_path / "contact.npz")
    plain = {"scene": GROWING, "choice": CHOICE, "sweep": replace(SWEEP, revolutions=given)}
    params = {
        "code": "",
        "results": (),
        "kept": KEPT,
        "yield_stress": 1e9,
        "strengths": to_plain(UNKNOWN),
        "provenance": {"revolutions": 20},
    }
    params |= {name: to_plain(value) for name, value in plain.items()}
    for motion in MOTIONS:
        output = SimpleNamespace(response=tmp_path / f"{motion}.nc", levels=tmp_path / f"{motion}.npz")
        steps.carry(SimpleNamespace(model=tmp_path / "contact.npz", runs=[]), output, SimpleNamespace(motion=motion, **params))
    responses, levels = ([tmp_path / f"{motion}.{suffix}" for motion in MOTIONS] for suffix in ("nc", "npz"))
    pair = pair_motions(responses, levels)
    assert pair["revolutions"].values.tolist() == [expected, expected, 20]
    run = run_speed(contact, 1310.0, GROWING, CHOICE, (), **KEPT)
    here = pair.sel(motion=REST, speed=1310.0)
    counted = run["revolution_rms"][10:]
    assert (float(here["motion_mean"]), float(here["motion_scatter"])) == (counted.mean(), counted.std())


def test_a_carried_motion_ends_as_it_has_settled_where_that_from_rest_does(contact):
    settled = replace(CHOICE, until_settled=True)
    lengths = {None: (20, True), 10: (10, False)}
    for given, expected in lengths.items():
        choice = sweep_of(contact, UP, sweep=replace(SWEEP, revolutions=given), choice=settled).carried_choice
        assert (choice.revolutions, choice.until_settled) == expected


def test_another_length_of_carried_motions_is_said_before_the_run(root):
    sections = {number: {"from_rad_s": 1000, "to_rad_s": 1100, "revolutions": number} for number in (100, 200)}
    said = {
        number: [
            line
            for line in remarks(read_settings(root, command_line_document({"second_motions": section})))
            if "carried" in line
        ]
        for number, section in sections.items()
    }
    assert said == {100: ["second_motions: 100 revolutions of carried motions, 200 from rest"], 200: []}


def test_a_lining_is_new_or_carried_on(contact, tmp_path):
    wear = {}
    for worn in (False, True):
        files = sweep_of(contact, UP, LINED, replace(SWEEP, worn=worn)).run(tmp_path / str(worn))
        wear[worn] = [read_speed(file).get(END_WEAR) for file in files]
    assert wear[False] == [None, None, None]
    assert (np.diff(wear[True], axis=0) >= 0.0).all() and wear[True][0].max() > 0.0


def test_after_a_run_that_diverged_the_sweep_starts_from_rest(contact, tmp_path):
    hopeless = replace(GROWING, divergence_limit=1e-9)
    files = sweep_of(contact, UP, hopeless).run(tmp_path)
    assert [int(read_speed(file)["status"]) for file in files] == 3 * [RunStatus.DIVERGED]
    write_levels(files, SWEEP.speeds, 1e-3, False, tmp_path / "levels.npz")
    levels = read_levels(3 * [tmp_path / "levels.npz"])
    assert np.isinf(levels.mean).all() and not levels.differ.any()


def levels(mean, scatter=0.0, clearance=0.0):
    mean = np.array(mean, dtype=float)
    scatter = np.broadcast_to(np.asarray(scatter, dtype=float), mean.shape)
    speeds = 100.0 + 5.0 * np.arange(mean.shape[1])
    return MotionLevels(speeds, mean, scatter, np.arange(3), motions_differ(mean, scatter, clearance))


def test_motions_differ_by_more_than_they_scatter(tmp_path):
    """One that diverges differs and is the largest; a worn lining is not compared with a new one."""
    mean = [[1.0, 1.005, 1.5, 1.5, 0.2, np.inf], [1.0, 1.0, 1.0, 1.0, 0.1, np.inf], [1.0, 1.0, 1.0, 1.0, 0.1, np.inf]]
    scatter = 3 * [[0.0, 0.0, 0.2, 0.3, 0.0, 0.0]]
    several = levels(mean, scatter, clearance=0.5)
    # the same; within 1%; more than twice the scatter; less; quiet; all diverged
    assert several.differ.tolist() == [False, False, True, False, False, False]
    assert [(part.start, part.stop) for part in several.ranges()] == [(2, 3)]
    several = levels([[np.inf, 1.0], [0.1, 1.0], [0.1, 1.0]], clearance=0.5)
    assert several.differ.tolist() == [True, False]
    assert (several.high[0], several.low[0], several.worst(slice(0, 1))) == (0, 1, 0)
    new, worn = [], []
    for motion, rms in zip(MOTIONS, (1.0, 1.0, 9.0), strict=True):
        for files, is_worn in ((new, False), (worn, True)):
            files.append(tmp_path / f"{motion}_{is_worn}.npz")
            np.savez(files[-1], speed=[100.0], mean=[rms], scatter=[0.0], clearance=0.0, worn=is_worn)
    new, worn = read_levels(new), read_levels(worn)
    assert (new.differ.tolist(), worn.differ.tolist()) == ([True], [False])
    assert (MOTIONS[new.high[0]], MOTIONS[worn.high[0]]) == (REST, UP)


def test_ranges_are_neighbouring_speeds():
    several = levels([[1.0, 2.0, 3.0, 2.5, 2.0, 1.0, 5.0], np.ones(7), np.ones(7)])
    assert [(part.start, part.stop) for part in several.ranges()] == [(1, 5), (6, 7)]
    assert [several.worst(part) for part in several.ranges()] == [2, 6]


@pytest.fixture
def motions(tmp_path):
    """second_motions.nc of two blades, of which one is swept: up differs from rest at three speeds of five."""
    speeds = 1000.0 + 5.0 * np.arange(5)
    mean = {UP: [1.0, 3.0, 4.0, 3.0, 1.0], DOWN: 5 * [1.0], REST: 5 * [1.0]}
    values = 1e-3 * np.array([mean[motion] for motion in MOTIONS])
    over = ("motion", "speed")
    data = {
        "motion_mean": (over, values),
        "motion_scatter": (over, 0.0 * values),
        "rms_normal": (over, 0.2 * values),
        "rms_tangential": (over, values),
        "peak_normal": (over, values),
        "max_von_mises_median": (over, 1e12 * values),
        "max_von_mises_inside": (over, 1e12 * values),
        "max_von_mises_ever": (over, 2e12 * values),
        "share_of_revolutions_above_yield": (over, 1.0 * (values > 2e-3)),
        "status": (over, np.zeros(values.shape)),
        "differ": ("speed", [0.0, 1.0, 1.0, 1.0, 0.0]),
        "compared": ("motion", np.ones(3)),
        "revolutions": ("motion", [100, 100, 200]),
        "yield_stress": ((), 1.38e9),
        "lined": ((), 0.0),
    }
    dataset = xr.Dataset(data, {"motion": list(MOTIONS), "speed": speeds}).expand_dims({"blade": ["Ref"], "scene": ["direct"]})
    return dataset.reindex(blade=["Ref", "S100"])


@pytest.fixture
def motions_file(motions, tmp_path):
    motions.to_netcdf(tmp_path / "second_motions.nc")
    return tmp_path / "second_motions.nc"


def test_the_worst_motion_stands_in_the_ranking(motions_file):
    ranking = pd.DataFrame({"blade": ["Ref", "S100"], "scene": "direct", "rank": [1, 2]})
    table = ranking_with_motions(ranking, motions_file)
    # half of the way from one speed to the next on both sides
    lengths = [f"length_most_revolutions_{name}_rad_s" for name in ("rest", "worst")]
    assert table.loc[0, [*lengths, "largest_rms_worst_m", "rank_worst"]].tolist() == pytest.approx([0.0, 15.0, 4e-3, 1])
    assert table.loc[1, [lengths[1], "rank_worst"]].isna().all()
    # from rest at more speeds
    for from_rest, worst in ((5.0, 15.0), (20.0, 20.0)):
        longer = ranking_with_motions(ranking.assign(length_most_revolutions_rad_s=from_rest), motions_file)
        assert longer[lengths[1]].tolist() == pytest.approx([worst, np.nan], nan_ok=True)
    assert table["carried_revolutions"].tolist() == pytest.approx([100.0, np.nan], nan_ok=True)


def test_table_of_ranges(motions):
    ranges = range_table(motions)
    assert list(ranges.columns) == list(RANGE_COLUMNS)
    (row,) = ranges.to_dict("records")
    assert (row["from_rad_s"], row["to_rad_s"], row["speeds"], row["speed_rad_s"]) == (1005.0, 1015.0, 3, 1010.0)
    assert row["largest_motion"] == "up"
    assert row["rms_normal_up_m"] == pytest.approx(0.8e-3)
    assert row["rms_normal_rest_m"] == pytest.approx(0.2e-3)


def test_sweeps_are_drawn_with_the_speeds_at_which_they_differ(motions):
    pair = motions.sel(blade="Ref", scene="direct")
    figure = draw_second_motions(pair, "Ref, direct", blade="Ref")
    assert len(figure.axes[0].patches) == 3
    # the stress of each motion: its median, and the band up to the largest
    highest = [line.get_ydata().max() for line in figure.axes[1].lines[:6]]
    np.testing.assert_allclose(highest[1::2], 2.0 * np.array(highest[::2]))
    lengths = ["carried up, 100 revolutions", "carried down, 100 revolutions", "from rest, 200 revolutions"]
    assert [line.get_label() for line in figure.axes[0].lines[:3]] == lengths
    alike = draw_second_motions(pair.assign(revolutions=("motion", 3 * [200])), "", blade="Ref")
    assert [line.get_label() for line in alike.axes[0].lines[:3]] == ["carried up", "carried down", "from rest"]
    rms = xr.Dataset(
        {
            **{f"rms_{name}": (("scene", "speed", "tip_point"), np.ones((1, 5, 1))) for name in ("normal", "tangential")},
            "status": (("scene", "speed"), np.zeros((1, 5))),
            "exit_cause": (("scene", "speed"), np.zeros((1, 5))),
            "exit_revolution": (("scene", "speed"), np.full((1, 5), np.nan)),
        },
        {"scene": ["direct"], "speed": motions["speed"].values, "tip_point": ["leading_edge"]},
    )
    for blade, shaded in (("Ref", 3), ("S100", 0)):
        assert len(draw_response(blade, None, rms, None, motions.sel(blade=blade)).axes[0].patches) == shaded


def test_the_last_line_names_no_motion_without_one_from_rest(tmp_path):
    table = pd.DataFrame([{name: np.nan for name in RANGE_COLUMNS} | {"largest_motion": "up"}])
    table.to_csv(tmp_path / "second_motions.csv", index=False)
    assert closing(tmp_path) == "1 range of hysteresis"
    table.assign(largest_motion=REST).to_csv(tmp_path / "second_motions.csv", index=False)
    assert closing(tmp_path) == "1 range of hysteresis"
    known = {"blade": "Ref", "scene": "direct", "speed_rad_s": 1195.0, "median_von_mises_up_pa": 2.4e9}
    table.assign(**known, rms_normal_up_m=1.09e-3, rms_normal_rest_m=3.3e-4).to_csv(
        tmp_path / "second_motions.csv", index=False
    )
    where = "Ref in direct at 1195 rad/s: from rest 0.33, up 1.09 mm (normal rms), 2.40 GPa"
    assert closing(tmp_path) == f"1 range of hysteresis; {where}"


@pytest.mark.parametrize(
    ("section", "message"),
    [
        ("{ from_rad_s: 1000 }", "second_motions: found from_rad_s alone; allowed: from_rad_s and to_rad_s"),
        ("{ to_rpm: 9000 }", "second_motions: found to_rpm alone; allowed: from_rad_s and to_rad_s"),
        ("{ from_rad_s: 1000, to_rad_s: 900 }", "second_motions.to_rad_s: found a speed below the lowest one"),
        ("{ from_rad_s: 1000, to_rad_s: 1100, step_rad_s: 5, step_rpm: 5 }", "step_rad_s and step_rpm; allowed: one of them"),
        ("{ from_rad_s: 1000, to_rad_s: 2100 }", "second_motions.to_rad_s: found 2100 rad/s; allowed: up to"),
        ("{ from_rad_s: 1, to_rad_s: 1900, step_rad_s: 0.01 }", "second_motions: found 189901 speeds"),
        ("{ from_rad_s: 1000, to_rad_s: 1100, scenes: [direct], lining: worn }", "worn in the scene 'direct', which has no"),
        ("{ from_rad_s: 1000, to_rad_s: 1100, scenes: [rotor_abradable] }", "'rotor_abradable', which has a rotor"),
        ("{ from_rad_s: 1000, to_rad_s: 1100, blades: [Reff] }", "second_motions.blades"),
        ("{ from_rad_s: 1000, to_rad_s: 1100, revolutions: 1 }", "second_motions.revolutions: found 1"),
        ("{ revolutions: 50 }", "second_motions: found no speeds; allowed: from_rad_s and to_rad_s"),
        ("{ from_rad_s: 1.5, to_rad_s: 1100 }", "second_motions.from_rad_s: found 1.5 rad/s; allowed: from the step on, 5"),
        ("{ from_rpm: 0.5, to_rpm: 9000, step_rpm: 0.5 }", "second_motions.from_rpm: found 0.0523599 rad/s, a revolution of"),
    ],
)
def test_what_cannot_be_swept_is_refused(root, section, message):
    with pytest.raises(ConfigError) as error:
        read_settings(root, command_line_document({"second_motions": yaml.safe_load(section)}))
    assert message in str(error.value) and "\n" not in str(error.value)


@pytest.mark.slow
def test_sweeps_leave_their_motion_at_the_folds(tmp_path):
    """A mass that meets a lobe through a second spring. Its folds (rad/s) are those of its branch of periodic motions.

    Once found by pseudo-arc-length continuation.
    """
    low, high = 5214.97, 5398.96
    casing = Casing(0.356e-3, lobes=1, amplitude=1.05, rise_fraction=0.0)
    choice = IntegrationChoice(2e-6, 300, 124, integrator=EXACT_MODAL)
    sweep, rms = SweepChoice(5150.0, 5500.0, 5.0, revolutions=300), {}
    for motion in (UP, DOWN):
        model = with_static_modes(oscillator(5000.0), 1e-7)
        files = sweep_of(model, motion, Scene(casing, damping_ratio=0.004), sweep, choice).run(tmp_path / motion)
        levels = [read_speed(file)["revolution_rms"][-1] for file in files]
        rms[motion] = np.array(levels if motion == UP else levels[::-1])
    speeds, differ = np.array(sweep.speeds), np.abs(rms[UP] - rms[DOWN]) > 0.05 * rms[UP]
    assert speeds[differ][0] == pytest.approx(low, abs=5.0)
    # just above the fold the motion falls slowly
    assert speeds[differ][-1] == pytest.approx(high, abs=10.0)
    assert np.all(differ[(speeds > low + 5.0) & (speeds < high - 5.0)])
