"""What a run's file keeps, against closed forms and counts by hand; runs that end as they have settled, and what moves then."""

from contextlib import nullcontext
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import DIRECT, LINING, oscillator, random_model
from integration_runs import in_all_directions
from motion_at_start import MotionAtStart

from r37core.base.dataset_file import read_dataset
from r37core.contact.laws import used_thickness, wear_at_the_casing, worn
from r37core.contact.scene import Friction, Rotor
from r37core.results.datasets import write_sweep_dataset
from r37core.results.regions import read_judged
from r37core.results.response import write_response
from r37core.stress.operator import StressOperator
from r37core.time_integration.kept_numbers import wear_numbers
from r37core.time_integration.problem import Problem, UnstableStepError
from r37core.time_integration.rotor_simulation import RotorSimulation
from r37core.time_integration.settling import (
    NO_WEAR,
    MotionAtEnd,
    has_settled,
    motion_at_end,
    parts_of_run,
    remaining_drift,
    revolution_rms,
)
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import numbers_of_run, run_speed, simulation_of
from r37core.time_integration.state import SimulationState
from r37core.time_integration.status import RunStatus
from r37core.time_integration.time_grid import TimeGrid

FREE = Scene(Casing(1.0, lobes=0), damping_ratio=0.0)
SPEED = 1000.0

SWINGING = MotionAtStart([1e-4])
"""Displacement (m) of the one mode as its run starts."""


def kept_of(model, speed, scene, choice, results, motion=None, **more):
    run = simulation_of(model, speed, scene, choice).run(*filter(None, [motion]))
    return numbers_of_run(run, results, spectrum_highest_order=31, wear_angles=90, **more)


def with_tip(normal, tangential):
    """One mode whose amplitude moves leading and trailing edge differently."""
    model = oscillator(10.0 * SPEED)
    operator = np.zeros((3, 2, 1))
    operator[0, :, 0], operator[1, :, 0] = normal, tangential
    return replace(model, tip_displacement_operator=operator)


def test_statistics_of_a_free_oscillation():
    """Ten periods a revolution of 0.1 mm: rms amplitude/sqrt(2) in metres and one line of the spectrum, at both edges."""
    choice = IntegrationChoice(1e-7, 6, 620)
    kept = kept_of(with_tip([1.0, 3.0], [0.5, 2.0]), SPEED, FREE, choice, ("spectrum",), motion=SWINGING)
    expected = 1e-4 * np.array([[1.0, 1.0, 0.5], [3.0, 3.0, 2.0]])
    np.testing.assert_allclose(in_all_directions(kept, "rms"), expected / np.sqrt(2.0), rtol=1e-4)
    np.testing.assert_allclose(in_all_directions(kept, "peak"), expected, rtol=1e-3)
    np.testing.assert_allclose(kept["revolution_maximum"], np.broadcast_to(expected[:, 0], (6, 2)), rtol=1e-3)
    line = kept["engine_order"] == 10.0
    for name, size in (("amplitude", 1e-4), ("amplitude_tangential", 0.5e-4)):
        np.testing.assert_allclose(kept[name][line], size, rtol=1e-3)
        assert kept[name][~line].max() < 1e-7


def test_contact_statistics_counted_step_by_step():
    """Every step of a node driven by a lobed casing is sampled: contacts, their onsets and forces are read off the motion."""
    frequency, step = 6000.0, 1e-6
    choice = IntegrationChoice(step, 2, 6284)
    scene = Scene(Casing(1e-4, rise_fraction=0.0), damping_ratio=0.0)
    model = oscillator(frequency)
    simulation = Simulation(model, SPEED, scene, choice)
    assert simulation.problem.grid.steps_per_sample == 1
    kept = kept_of(model, SPEED, scene, choice, ())
    u = simulation.advance(simulation.start(), 2).samples[:, 0]
    u = np.concatenate([[0.0, 0.0], u])
    h = simulation.problem.grid.time_step
    # the force that the recursion of central differences leaves over, for a unit mass
    force = (u[2:] - 2.0 * u[1:-1] + u[:-2]) / h**2 + frequency**2 * u[1:-1]
    pushed = np.abs(force) > 1e-6 * np.abs(force).max()
    assert 0.0 < pushed.mean() < 1.0
    assert kept["share_of_time_in_contact"] == pytest.approx(pushed.mean(), rel=1e-9)
    assert kept["largest_normal_force"] == pytest.approx(np.abs(force).max(), rel=1e-6)
    assert kept["casing_hits"] == np.count_nonzero(pushed & ~np.concatenate([[False], pushed[:-1]]))


@pytest.mark.parametrize("edge", [0, 1])
def test_either_edge_of_the_tip_can_diverge(edge):
    """The limit is on what any output moves, at the leading edge as at the trailing edge."""
    moves = [0.0, 0.0]
    moves[edge] = 5.0
    model, choice = with_tip(moves, [0.0, 0.0]), IntegrationChoice(1e-7, 4, 62)
    for limit, status in ((6e-4, RunStatus.COMPLETED), (4e-4, RunStatus.DIVERGED)):
        kept = kept_of(model, SPEED, replace(FREE, divergence_limit=limit), choice, (), motion=SWINGING)
        assert kept["status"] == status


def test_wear_is_that_of_the_most_worn_ring(monkeypatch):
    """A ring worn by a + b cos(3 theta): its largest depth, its profile and its harmonics; another ring is worn less.

    Bars count as worn through that are worn as far as the casing behind them allows: to round-off none, or a twelfth.
    """
    bars = 720
    theta = 2.0 * np.pi * np.arange(bars) / bars
    worn = 2e-4 + 1e-4 * np.cos(3.0 * theta) + 2e-5 * np.cos(7.0 * theta + 0.3)
    advance = Simulation.advance_samples

    def worn_lining(simulation, state: SimulationState, *samples, **room):
        record = advance(simulation, state, *samples, **room)
        state.wear[:] = 0.25 * worn
        state.wear[-1] = worn
        return record

    monkeypatch.setattr(Simulation, "advance_samples", worn_lining)
    lining = replace(LINING, bars=bars)
    kept = kept_of(random_model(2), SPEED, replace(DIRECT, lining=lining), IntegrationChoice(2e-7, 2, 62), ("wear",))
    assert kept["max_wear"] == worn.max()
    np.testing.assert_allclose(kept["wear"], worn.reshape(90, -1).max(axis=1), rtol=1e-6)
    harmonics = np.zeros(21)
    harmonics[[0, 3, 7]] = 2e-4, 1e-4, 2e-5
    np.testing.assert_allclose(kept["wear_harmonic"], harmonics, atol=1e-15)
    assert kept["worn_through_share"] == 0.0
    largest = wear_at_the_casing(lining)
    assert largest == pytest.approx(lining.thickness * 20.0 / 25.0, rel=1e-6)
    for share, reached in ((1.0 / 12.0, largest), (1.0 / 12.0, largest * (1.0 - 1e-12)), (0.0, largest * (1.0 - 1e-6))):
        rings = np.zeros((2, bars))
        rings[1, : bars // 12] = reached
        assert wear_numbers(rings, 90, lining, np.zeros((2, 1)))["worn_through_share"] == share


def test_what_a_tip_has_cut_leaves_nothing_that_springs_back():
    """A ring is cut by 1 mm before the run: as much is used, and it is not worn through, until the law wears more."""
    lining, rings, cut = replace(LINING, thickness=1.2e-3), np.zeros((2, 100)), np.array([[1e-3], [0.0]])
    at_the_casing = wear_at_the_casing(lining)
    assert at_the_casing < 1e-3
    rings += cut
    numbers = wear_numbers(rings, 10, lining, cut)
    assert (numbers["used_thickness"], numbers["worn_through_share"]) == (1e-3, 0.0)
    rings[1, :10] = at_the_casing
    numbers = wear_numbers(rings, 10, lining, cut)
    assert numbers["used_thickness"] == pytest.approx(1.2e-3) and numbers["worn_through_share"] == 0.1


def test_a_lining_that_cannot_yield_is_not_worn_through():
    lining = replace(LINING, yield_stress=2.0 * LINING.elastic_modulus)
    numbers = wear_numbers(np.zeros((2, 100)), 10, lining, np.zeros((2, 1)))
    assert numbers["worn_through_share"] == 0.0


def test_step_limit_of_a_lining_is_four_thirds():
    """A node pressed on an elastic bar, x_{n+1} = (1 - g)(2 x_n - x_{n-1}), is stable for g < 4/3; the refusal begins there."""
    assert np.abs(np.roots([1.0, -2.0 * (1.0 - 1.33), 1.0 - 1.33])).max() < 1.0
    assert np.abs(np.roots([1.0, -2.0 * (1.0 - 1.34), 1.0 - 1.34])).max() > 1.0
    model, choice = oscillator(6000.0), IntegrationChoice(1e-6, 1, 62)
    step = Problem(model, SPEED, DIRECT, choice).grid.time_step
    soft = replace(LINING, elastic_modulus=1.0)
    stiffness_per_pascal = soft.pressed_areas(model.tip_lengths, 0.25)[0] / soft.thickness
    for share, refused in ((0.999, False), (1.001, True)):
        lining = replace(soft, elastic_modulus=share * 4.0 / 3.0 / step**2 / stiffness_per_pascal)
        with pytest.raises(UnstableStepError, match="limit for this lining") if refused else nullcontext():
            Problem(model, SPEED, replace(DIRECT, lining=lining), choice)


@pytest.mark.parametrize(("snapshots", "kept"), [(4, 2), (1, 1), (0, 2), (4, 0)])
def test_snapshots_are_the_last_samples_of_equal_parts(snapshots, kept):
    """In whatever pieces the run is done."""
    choice = IntegrationChoice(1e-5, 3, 8, snapshots_per_revolution=snapshots, snapshot_revolutions=kept)
    grid, samples = TimeGrid(1000.0, choice), 24
    every = 8 // snapshots if snapshots and kept else 0
    expected = [n for n in range(samples) if every and n >= samples - 8 * kept and (n + 1) % every == 0]
    assert grid.samples_per_snapshot == every and grid.snapshots_after(samples) == len(expected)
    for piece in (24, 5, 1):
        pieces = [(first, min(first + piece, samples)) for first in range(0, samples, piece)]
        assert [first + n for first, last in pieces for n in grid.snapshots_between(first, last)] == expected


CLEARANCE = 1e-4
REVOLUTION = np.arange(200.0)
NOISE = np.random.default_rng(0).standard_normal(200)

RISING = Casing(CLEARANCE, rise_revolutions=10.0)
LINED = Scene(RISING, LINING, Friction(0.15), damping_ratio=0.01)
CHOICE = IntegrationChoice(4e-5, 400, 62, until_settled=True)
run = partial(run_speed, oscillator(6400.0), SPEED, spectrum_highest_order=10, wear_angles=60)


@pytest.mark.parametrize(
    ("rms", "about", "state"),
    [
        (1e-3 * np.exp(0.01 * REVOLUTION), {}, MotionAtEnd.GROWING),
        (1e-3 * (1.0 + 1e-3 * REVOLUTION), {}, MotionAtEnd.GROWING),
        (1e-3 * (1.0 + 3e-3 * REVOLUTION + 0.2 * NOISE), {}, MotionAtEnd.LASTING),
        (1e-3 * (1.0 + 0.1 * NOISE), {}, MotionAtEnd.LASTING),
        (np.full(200, 1e-3), {"contact_steps": 10.0}, MotionAtEnd.LASTING),
        (1e-3 * np.exp(-0.005 * REVOLUTION), {}, MotionAtEnd.LASTING),
        (1e-3 * np.exp(-0.015 * REVOLUTION), {}, MotionAtEnd.CUT_FREE),
        (1e-3 * np.exp(-0.005 * REVOLUTION), {"contact_steps": 0.0}, MotionAtEnd.CUT_FREE),
        (np.full(200, 0.99 * CLEARANCE), {}, MotionAtEnd.QUIET),
        (0.5 * CLEARANCE * np.exp(-0.1 * REVOLUTION), {"contact_steps": 0.0}, MotionAtEnd.QUIET),
        (np.full(200, 1e-3), {"max_wear": 1e-3, "wear_growth": 1.1e-5}, MotionAtEnd.GROWING),
        (np.full(200, 1e-3), {"max_wear": 1e-3, "wear_growth": 0.9e-5}, MotionAtEnd.LASTING),
        (np.full(200, 0.5 * CLEARANCE), {"max_wear": 1e-7, "wear_growth": 1e-7}, MotionAtEnd.GROWING),
        (np.where(REVOLUTION < 150, 1e-3, np.nan), {}, MotionAtEnd.UNKNOWN),
        (np.array([1e-3, 1e-3]), {}, MotionAtEnd.LASTING),
    ],
)
def test_motion_at_the_end(rms, about, state):
    assert motion_at_end(rms, CLEARANCE, **about) == state


def test_a_run_settles_when_two_windows_are_alike_and_nothing_wears():
    """Windows of ten revolutions: 1% of the level, or 0.1% of the largest, and 10 nm of wear are no change."""

    def of(*windows):
        return np.repeat(windows, 10)

    settled = partial(has_settled, window=10, wear_growth=0.0, risen=0.0)
    assert settled(of(1.0, 1.0)) and settled(of(5.0, 1.0, 1.009)) and not settled(of(1.0, 1.011))
    # a slow decay of what is over anyway
    assert settled(of(5.0, 0.004, 0.0)) and not settled(of(5.0, 0.02, 0.01))
    assert not settled(of(1.0)) and not settled(of(1.0, 1.0), risen=1.0) and settled(of(1.0, 1.0, 1.0), risen=10.0)
    assert settled(of(1.0, 1.0), wear_growth=NO_WEAR) and not settled(of(1.0, 1.0), wear_growth=1.1 * NO_WEAR)
    # the windows are the last ones
    assert settled(np.concatenate([[9.0] * 3, of(1.0, 1.0)]))
    # steps of 0.5% that go on would be a tenth, those that halve 0.5%; what goes up and down or scatters does not drift
    assert not settled(of(1.0, 1.005, 1.01)) and settled(of(1.0, 1.01, 1.015)) and settled(of(1.0, 1.005, 1.0))
    assert settled(of(1.0, 1.005, 1.01) + np.tile([0.02, -0.02], 15))
    # not before the lobes have risen
    assert settled(of(0.99, 0.995, 1.0, 1.0), risen=20.0)


def test_a_drift_is_followed_as_it_shrinks():
    """Of means that come nearer to 1 by a half in each window, and by the same step in each."""
    halving, even = np.repeat(1.0 - 0.5 ** np.arange(3, 6), 10), np.repeat([1.0, 1.1, 1.2], 10)
    assert remaining_drift(halving, 10) == pytest.approx((1.0 - halving[-1]) / halving[-1], rel=1e-5)
    assert remaining_drift(even, 10) == pytest.approx(20 * 0.1 / 1.2) and remaining_drift(even[::-1], 10) < 0.0
    assert remaining_drift(even[10:], 10) == pytest.approx(20 * 0.1 / 1.2)


def test_parts_are_windows_and_each_revolution_has_its_rms():
    fixed = replace(CHOICE, until_settled=False)
    assert [parts_of_run(replace(fixed, revolutions=n)) for n in (2, 7, 200, 1000)] == [
        [1, 1],
        [3, 3, 1],
        [100, 50, 50],
        [500, 450, 50],
    ]
    assert [parts_of_run(replace(CHOICE, revolutions=n)) for n in (3, 30, 220)] == [[1] * 3, [9, 7, 7, 7], [70, 50, 50, 50]]
    motion = np.array([[3.0, 4.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    np.testing.assert_allclose(revolution_rms(motion, 2), [np.sqrt(12.5), 1.0])


@pytest.fixture(scope="module")
def settled():
    return run(LINED, CHOICE, ("spectrum", "wear", "energy"))


def test_a_settled_run_is_the_begin_of_a_longer_one(settled):
    """Bit for bit, and it has settled: the fixed run moves alike from then on, and its lining wears no more."""
    end = int(settled["statistic_end"])
    assert settled["settled_revolution"] == end < CHOICE.revolutions
    assert settled["motion_at_end"] in (MotionAtEnd.LASTING, MotionAtEnd.QUIET)
    fixed = run(LINED, replace(CHOICE, until_settled=False), ("spectrum", "wear", "energy"))
    assert np.isnan(fixed["settled_revolution"]) and fixed["statistic_end"] == 400
    maxima = settled["revolution_maximum"]
    assert maxima.shape == fixed["revolution_maximum"].shape and np.isnan(maxima[end:]).all()
    np.testing.assert_array_equal(maxima[:end], fixed["revolution_maximum"][:end])
    np.testing.assert_allclose(settled["rms_normal"], fixed["rms_normal"], rtol=0.02)
    np.testing.assert_allclose(settled["max_wear"], fixed["max_wear"], rtol=0.0, atol=1e-7)
    assert settled["max_wear"] > 0.0 and settled["wear_growth"] <= NO_WEAR


def test_numbers_do_not_depend_on_the_longest_run(settled):
    """Neither the lobes' rise, nor the statistic, which is that of the last hundred revolutions."""
    longer = run(LINED, replace(CHOICE, revolutions=650), ("spectrum", "wear", "energy"))
    for name, values in settled.items():
        if name != "revolution_maximum":
            np.testing.assert_array_equal(longer[name], values, err_msg=name)
    assert len(longer["revolution_maximum"]) == 650
    assert settled["engine_order"][1] == pytest.approx(0.01)


def test_a_share_of_the_rise_is_one_of_the_published_length(settled):
    scenes = [replace(LINED, casing=replace(RISING, rise_revolutions=None, rise_fraction=0.05)), LINED]
    share, revolutions = (run(scene, replace(CHOICE, revolutions=500), ())["rms_normal"] for scene in scenes)
    np.testing.assert_array_equal(share, revolutions)
    np.testing.assert_array_equal(share, settled["rms_normal"])
    # of a fixed length it is a share of that
    fixed = replace(CHOICE, until_settled=False)
    fifth = replace(scenes[0], casing=replace(RISING, rise_revolutions=None, rise_fraction=0.025))
    np.testing.assert_array_equal(run(fifth, fixed, ())["revolution_maximum"], run(LINED, fixed, ())["revolution_maximum"])


def test_what_does_not_settle_goes_on_to_the_last_revolution():
    """Free and undamped, but slowly pumped: a mode whose amplitude beats changes from window to window."""
    free, choice = replace(FREE, damping_ratio=2e-5), replace(CHOICE, revolutions=230)
    kept = kept_of(oscillator(10.0 * SPEED), SPEED, free, choice, (), motion=SWINGING)
    assert np.isnan(kept["settled_revolution"]) and kept["statistic_end"] == 230
    assert np.isfinite(kept["revolution_maximum"]).all()


def test_one_run_in_a_thick_lining_has_the_thickness_that_suffices():
    """Bars alike per metre of depth: until one is worn through the thickness changes nothing, a hundredth less is too thin."""

    def of(thickness):
        share = thickness / LINING.thickness
        moduli = {name: share * getattr(LINING, name) for name in ("elastic_modulus", "plastic_modulus")}
        lining = replace(LINING, thickness=thickness, **moduli)
        return run(replace(LINED, lining=lining), CHOICE, ("wear",))

    thick = of(0.05)
    used = float(thick["used_thickness"])
    assert used == pytest.approx(1.25 * float(thick["max_wear"]), rel=1e-3)
    suffices, too_thin = of(1.01 * used), of(0.99 * used)
    assert suffices["worn_through_share"] == 0.0 < too_thin["worn_through_share"]
    for name in ("max_wear", "used_thickness", "rms_normal"):
        np.testing.assert_allclose(suffices[name], thick[name], rtol=1e-9)
    assert too_thin["used_thickness"] == pytest.approx(0.99 * used)


@pytest.mark.parametrize("wear", [0.0, 1e-6, 2e-3])
def test_used_thickness_is_the_depth_that_wears_so_much(wear):
    lining = replace(LINING, yield_stress=1e5)
    depth = used_thickness(wear, lining)
    assert (depth == 0.0) if wear == 0.0 else worn(depth, 0.0, lining) == pytest.approx(wear, rel=1e-12)
    assert used_thickness(wear_at_the_casing(lining), lining) == pytest.approx(lining.thickness)


def test_a_run_that_diverges_has_not_settled_and_a_rotor_does_not():
    kept = run(replace(LINED, divergence_limit=1e-6), CHOICE, ("wear",))
    assert (kept["status"], kept["motion_at_end"]) == (1, MotionAtEnd.UNKNOWN)
    assert np.isnan(kept["settled_revolution"]) and np.isnan(kept["rms_normal"]).any()
    rotor = Rotor((1, 2), (0.0, 3.0), (1.0, 1.0), (0.0, 0.0))
    with pytest.raises(ValueError, match="until: settled in a scene with a rotor; allowed: until: revolutions"):
        RotorSimulation(oscillator(6400.0), SPEED, replace(LINED, rotor=rotor), CHOICE)


def test_stress_of_a_settled_run_is_that_of_its_last_revolutions(tmp_path):
    """With and without a history of all revolutions; and a speed that was not run has no state of its motion."""
    components = np.zeros((6, 1, 1))
    components[0] = 1e12
    stress, responses = StressOperator(components, 1, "node"), {}
    for snapshots, history in ((100, []), (400, [SPEED])):
        choice = replace(CHOICE, snapshots_per_revolution=31, snapshot_revolutions=snapshots)
        kept = run(LINED, choice, ("stress", "wear"), stress={"one": stress})
        write_speed(kept, tmp_path / "run.npz", {})
        file = responses["blade", f"{snapshots}"] = tmp_path / f"{snapshots}.nc"
        speeds = {"stress_history_speeds": history, "yield_stress": 1e6, "provenance": {}}
        write_response([tmp_path / "run.npz"], [SPEED], file, **speeds)
    short, long = (read_judged(file).isel(speed=0) for file in responses.values())
    for name in ("max_von_mises_ever", "max_von_mises_median", "share_of_revolutions_above_yield"):
        assert short[name] == long[name] > 0.0
    end = int(kept["statistic_end"])
    history = long["max_von_mises_history"].values[0]
    assert np.isnan(history[end:]).all() and history[end - 100 : end].max() == pytest.approx(long["max_von_mises_ever"].item())
    assert long["settled_revolution"] == end
    assert long["used_thickness"] == pytest.approx(1.25 * long["max_wear"].item(), rel=1e-3)
    assert long["motion_at_end"].attrs["flag_meanings"] == "quiet cut_free lasting growing unknown"
    write_speed(run(LINED, replace(CHOICE, revolutions=2), ()), tmp_path / "run.npz", {})
    responses["second", "other"] = tmp_path / "other.nc"
    write_response([tmp_path / "run.npz"], [2.0 * SPEED], tmp_path / "other.nc", **speeds | {"stress_history_speeds": []})
    write_sweep_dataset("rms", responses, tmp_path / "rms.nc", {})
    joined = read_dataset(tmp_path / "rms.nc")["motion_at_end"]
    assert joined.sel(blade="blade", scene="100").values.tolist() == [kept["motion_at_end"], MotionAtEnd.UNKNOWN]
    assert joined.sel(blade="second", scene="100").values.tolist() == [MotionAtEnd.UNKNOWN] * 2
    assert joined.dtype == "i1" and joined.attrs["flag_values"].tolist() == list(MotionAtEnd)
