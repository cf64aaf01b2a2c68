"""Run-ups: the schedule, exact limits of the integration, and a linear oscillator that is swept through its resonance."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from defaults import Casing, IntegrationChoice, Lining, Scene
from integration_cases import ABRADABLE, NARROW, oscillator, with_static_modes
from integration_runs import in_all_directions
from reference_engine import ReferenceSimulation
from scipy.integrate import solve_ivp

from r37core.base.io import InputFileError
from r37core.contact.ring import RingMode
from r37core.rom.rotation import BucklingError
from r37core.time_integration import integration_choice
from r37core.time_integration.carrying import resolved_problem
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.problem import Problem, stable_problem
from r37core.time_integration.segments import segments_at
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.step_limit import UnstableStepError
from r37studies import run_up_integration as integration_module
from r37studies import run_up_revolutions as revolutions_module
from r37studies import run_up_schedule as schedule_module
from r37studies.run_up_integration import RunUpIntegration
from r37studies.run_up_revolutions import record_run_up
from r37studies.run_up_schedule import RunUp, schedule
from r37studies.run_ups.choice import Crossing, RunUpChoice, RunUpError
from r37studies.run_ups.dataset import VARIABLES as RUN_UP_ARRAYS
from r37studies.run_ups.dataset import runs_of, write_run_ups
from r37studies.run_ups.figures import draw_rates, draw_run_ups
from r37studies.run_ups.tables import rate_table, run_up_table

LONG = IntegrationChoice(3.2e-6, 4, 62, integrator=EXACT_MODAL)
FREE = Scene(Casing(1.0, lobes=0))
UNDAMPED = replace(FREE, damping_ratio=0.0)


def samples_of(integration):
    return np.concatenate([stage.samples for stage in integration.segments()])


def segments_of(intervals):
    """Speeds and samples of all segments."""
    return [np.concatenate([interval[part] for interval in intervals]) for part in (1, 2)]


@pytest.mark.parametrize(("start", "stop"), [(1300.0, 1800.0), (1800.0, 1300.0), (100.0, 101.0)])
@pytest.mark.parametrize("revolutions", [0.4, 3.7, 250.0])
def test_a_schedule_keeps_angle_and_time_of_a_constant_rate(start, stop, revolutions):
    per_revolution = 496
    speeds, samples = segments_of(schedule(RunUp(start, stop, revolutions, 3, 2, worn=False), per_revolution, 1e-8))
    assert sum(samples) == per_revolution * (5 + np.ceil(round(revolutions * per_revolution) / per_revolution))
    changing = (speeds != start) & (speeds != stop)
    angles = 2.0 * np.pi * samples[changing] / per_revolution
    angle, time = sum(angles), sum(angles / speeds[changing])
    assert angle == pytest.approx(2.0 * np.pi * round(revolutions * per_revolution) / per_revolution, rel=1e-12)
    # at a constant rate the mean speed is that of the ends
    assert time == pytest.approx(angle / (0.5 * (start + stop)), rel=1e-12)
    assert np.all(np.diff(speeds[changing]) * np.sign(stop - start) > 0.0)


def test_the_reference_slides_with_the_speed_of_each_segment(contact):
    problem = Problem(contact, 1600.0, NARROW, LONG)
    engine = ReferenceSimulation.build(problem, segments_at(problem, np.array([1590.0, 1610.0]))).engine
    for place, speed in enumerate((1590.0, 1610.0)):
        engine.take(place)
        np.testing.assert_allclose(engine.rotation_velocity, problem.casing.rotation_velocity * speed / 1600.0, rtol=1e-14)
        assert engine.time_step == pytest.approx(2.0 * np.pi / speed / problem.grid.steps_per_revolution, rel=1e-14)


@pytest.mark.parametrize("start", [1600.0, 1700.0])
def test_a_change_that_ends_where_it_began_hardly_differs_from_the_run_at_that_speed(contact, start):
    """Other modes, and displacement and velocity taken over: a change of 1e-7 of the speed changes no more than that."""
    run = Simulation(contact, start, NARROW, LONG)
    expected = run.advance(run.start(), 6).samples
    integration = RunUpIntegration(contact, NARROW, LONG, RunUp(start, start * (1.0 + 1e-7), 2.0, 4, 0, worn=False))
    found = samples_of(integration)
    assert len(integration.intervals) == 2
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-5 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("module", "limit", "stop"), [(integration_module, "_AT_ONCE", 1650.0), (integration_choice, "STEPS_AT_ONCE", 1605.0)]
)
def test_it_does_not_matter_how_much_the_engine_does_at_once(contact, monkeypatch, module, limit, stop):
    """Many segments in a call, and many steps of a long one."""
    whole, parts = (RunUpIntegration(contact, NARROW, LONG, RunUp(1600.0, stop, 8.5, 4, 1, worn=False)) for _ in range(2))
    few = list(whole.segments())
    monkeypatch.setattr(module, limit, 1)
    many = list(parts.segments())
    assert len(many) > max(len(few), len(parts.intervals))
    for name in ("samples", "speeds", "wear"):
        found, expected = (np.concatenate([getattr(stage, name) for stage in each]) for each in (many, few))
        np.testing.assert_array_equal(found, expected, err_msg=name)
    # the wear of each sample
    assert np.all(np.diff(found) >= 0.0)
    assert found[-1] > 0.0


@pytest.mark.parametrize("integrator", ["exact_modal", "central_difference"])
def test_the_stiffness_works_half_of_its_change_times_the_squared_displacement(integrator):
    """One mode whose stiffness grows with the squared speed; exact: the sum of u^2 dk/2 where the speed changes."""
    model = replace(oscillator(3000.0), stiffness_per_square=np.array([[2.0]]))
    if integrator == EXACT_MODAL:
        model = with_static_modes(model, 1e-9)
    errors = []
    for step in (4e-6, 2e-6):
        choice = replace(LONG, time_step=step, integrator=integrator, samples_per_revolution=124)
        integration = RunUpIntegration(model, UNDAMPED, choice, RunUp(1000.0, 1200.0, 5.0, 1, 0, worn=False))
        integration.state.displacement[:] = 1e-3
        integration.energy = 0.5 * 3000.0**2 * 1e-6 + 0.5 * 2.0 * 1000.0**2 * 1e-6
        first, stages = integration.energy, list(integration.segments())
        speeds, samples = (np.concatenate([getattr(stage, of) for stage in stages]) for of in ("speeds", "samples"))
        work = np.sum(np.diff(speeds**2, prepend=1000.0**2) * np.append(1e-3, samples[:-1, 0]) ** 2)
        errors.append(abs(integration.energy - first - work) / abs(work))
    assert errors[0] < 1e-3
    assert errors[1] < 0.3 * errors[0]


def test_free_motion_is_that_of_the_whole_stiffness_at_every_speed(monkeypatch):
    """Eight modes that the speed couples strongly, against DOP853 on u'' + (K_0 + Omega(t)^2 K_1) u = 0."""
    generator, start, stop, revolutions = np.random.default_rng(1), 1000.0, 1500.0, 6.0
    squares, coupled = np.linspace(4e3, 2e4, 8) ** 2, generator.standard_normal((8, 8))
    model = replace(
        oscillator(1.0),
        squared_frequencies=squares,
        stiffness_per_square=coupled @ coupled.T,
        displacement_operator=generator.standard_normal((3, 1, 8)),
        tip_displacement_operator=generator.standard_normal((3, 2, 8)),
        to_reduced=np.eye(8),
    )
    blade = with_static_modes(model, 1e-9, frequency=1e7)
    rate, first = (stop**2 - start**2) / (4.0 * np.pi * revolutions), 1e-4 * generator.standard_normal(8)

    def motion(time, state):
        stiffness = np.diag(squares) + (start + rate * time) ** 2 * model.stiffness_per_square
        return np.concatenate([state[8:], -stiffness @ state[:8]])

    choice, errors = replace(LONG, time_step=1e-5, samples_per_revolution=124), []
    duration = (stop - start) / rate
    exact = solve_ivp(motion, (0.0, duration), [*first, *np.zeros(8)], "DOP853", rtol=1e-11, atol=1e-15).y[:8, -1]
    for lead, stiffening in ((2.5e-4, 0.01), (1e-5, 0.001)):
        monkeypatch.setattr(schedule_module, "LARGEST_LEAD", lead)
        monkeypatch.setattr(schedule_module, "LARGEST_STIFFENING", stiffening)
        integration = RunUpIntegration(blade, UNDAMPED, choice, RunUp(start, stop, revolutions, 1, 0, worn=False))
        integration.intervals = integration.intervals[1:]
        modes = Simulation(blade, integration.intervals[0].speed, FREE, choice).problem.blade.modes[:8]
        integration.state.displacement[:] = modes.T @ first
        samples_of(integration)
        modes = Simulation(blade, integration.intervals[-1].speed, FREE, choice).problem.blade.modes[:8]
        errors.append(np.abs(modes @ integration.state.displacement - exact).max() / np.abs(exact).max())
    assert errors[0] < 0.05
    assert errors[1] < 0.1 * errors[0]


def test_a_swept_oscillator_follows_its_equation(monkeypatch):
    """A mode always pressed on an elastic bar by a lobed casing is linear: against DOP853 on its equation.

    Both start from rest, which is forgotten before the speed changes.
    """
    frequency, ratio, start, rate, before, revolutions, per_revolution = 4000.0, 0.004, 1900.0, 1500.0, 150, 60.0, 62
    casing = Casing(1e-5, lobes=2, width=1.0, amplitude=20.0, rise_fraction=0.0)
    lining = Lining(5e-3, 20e9, 5e9, 1e30, bar_area=4e-14)
    bar, model = lining.elastic_modulus * lining.bar_area / lining.thickness, with_static_modes(oscillator(frequency), 1e-9)
    run_up = RunUp(start, float(np.sqrt(start**2 + 4.0 * np.pi * rate * revolutions)), revolutions, before, 0, worn=False)

    def motion(time, state):
        angle = start * time + 0.5 * rate * max(time, 0.0) ** 2
        wall = casing.clearance * (1.0 - casing.amplitude * casing.shape(model.theta - angle).item())
        return state[1], bar * wall - 2.0 * ratio * frequency * state[1] - (frequency**2 + bar) * state[0]

    angle = 2.0 * np.pi * np.arange(1, revolutions * per_revolution + 1) / per_revolution
    time = (np.sqrt(start**2 + 2.0 * rate * angle) - start) / rate
    ends = -2.0 * np.pi * before / start, time[-1]
    exact = solve_ivp(motion, ends, (0.0, 0.0), "DOP853", time, rtol=1e-8, atol=1e-18).y[0]
    level = np.abs(exact - exact.mean())
    # the peak comes after the resonance, at 2010 rad/s, and the motion beats
    assert 2040.0 < start + rate * time[np.argmax(level)] < 2060.0
    errors = {}
    for lead, step in ((1e-5, 4e-5), (1e-5, 1e-5), (schedule_module.LARGEST_LEAD, 1e-5)):
        monkeypatch.setattr(schedule_module, "LARGEST_LEAD", lead)
        choice = replace(LONG, time_step=step, samples_per_revolution=per_revolution, static_above=10.0)
        integration = RunUpIntegration(model, Scene(casing, lining, damping_ratio=ratio), choice, run_up)
        found = samples_of(integration)[before * per_revolution :, 0]
        assert integration.state.totals["steps_in_contact"] > 0.9999 * integration.state.totals["steps"]
        errors[lead, step] = np.abs(found - exact).max() / level.max()
    coarse, fine, shipped = errors.values()
    assert fine < 3e-4
    # two steps against six in a sample
    assert fine < 0.15 * coarse
    assert shipped < 6e-4


def recorded(model, scene, choice, run_up, results=("spectrum", "wear", "energy")):
    integration = RunUpIntegration(model, scene, choice, run_up)
    return record_run_up(integration, results, highest_order=8, stress=None, yield_stress=1e9)


def test_modes_that_pass_the_highest_frequency_come_and_go(contact):
    """The second mode stiffens beyond it on the way, and follows statically from there on."""
    second = contact.modes_at(1650.0)[0][1] / 2.0 / np.pi
    choice = replace(LONG, highest_frequency=second)
    low, high = (Problem(contact, speed, NARROW, choice) for speed in (1500.0, 1800.0))
    assert (len(low.blade.frequencies), len(high.blade.frequencies)) == (2, 1)
    found = recorded(contact, NARROW, choice, RunUp(1500.0, 1800.0, 3.0, 1, 0, worn=False))
    assert found["status"] == 0
    assert abs(found["energy_residual"]) < 1e-10 * (abs(found["contact_work"]) + found["damping_loss"])


def test_a_run_that_diverges_keeps_what_was_before_also_when_it_wears_the_lining(contact):
    run_up = RunUp(1500.0, 1800.0, 3.0, 2, 0, worn=False)
    whole = recorded(contact, NARROW, LONG, run_up)
    maximum = in_all_directions(whole, "maximum")
    limit = float(maximum[1:].max()) * 0.999
    scene = replace(NARROW, divergence_limit=limit)
    assert np.all(maximum[0] < limit)
    for worn in (False, True):
        found = recorded(contact, scene, LONG, replace(run_up, worn=worn))
        assert found["status"] == 1
        kept = len(found["speed"])
        assert 1 <= kept == int(found["diverged_revolution"] - 1e-9) < len(whole["speed"])
        for name in ("speed", "rms_normal", "amplitude"):
            np.testing.assert_array_equal(found[name], whole[name][:kept])


def test_a_lining_worn_by_the_same_run_up(contact):
    """Where the first pass has worn it, the second one finds room."""
    new, worn = (recorded(contact, NARROW, LONG, RunUp(1500.0, 1800.0, 3.0, 2, 0, worn=worn)) for worn in (False, True))
    assert worn["max_wear"][0] >= new["max_wear"][-1] > new["max_wear"][0] > 0.0
    assert in_all_directions(worn, "rms").max() < 0.9 * in_all_directions(new, "rms").max()


def test_steps_are_so_short_that_every_mode_tells_its_velocity(contact):
    """Those of the blade always do; an elastic casing's may be faster."""
    choice = replace(LONG, time_step=1.6e-6, shorten=True)
    scene = replace(ABRADABLE, lining=None, friction=None)
    resolved, stable = (make(contact, 1600.0, scene, choice).grid for make in (resolved_problem, stable_problem))
    assert resolved.time_step == stable.time_step
    scene = replace(scene, casing=replace(scene.casing, ring=(RingMode(2, 2.8e6, 1e3, 0.0),)))
    problem = resolved_problem(contact, 1600.0, scene, choice)
    assert 2.5 < problem.contact.highest_frequency * problem.grid.time_step < 3.0
    with pytest.raises(
        UnstableStepError, match=r"time_step_s: 1\.6e-06 s; allowed where the speed changes: below 1\.07\d+e-06 s"
    ):
        resolved_problem(contact, 1600.0, scene, replace(choice, shorten=False))


def test_steps_that_are_held_do_not_become_shorter_for_ever(contact):
    """At a low speed steps of as many per sample are too long: that is reported, and no shorter ones are tried."""
    choice = replace(LONG, shorten=True, steps_per_sample=4)
    with pytest.raises(UnstableStepError):
        stable_problem(contact, 50.0, ABRADABLE, choice)


def test_a_blade_that_buckles_on_the_way_is_refused_at_once(contact):
    soft = replace(contact, stiffness_per_square=-contact.stiffness_per_square)
    with pytest.raises(BucklingError, match=r"no stable position at 6000 rad/s.*run-ups"):
        RunUpIntegration(soft, NARROW, LONG, RunUp(1500.0, 6000.0, 200.0, 4, 0, worn=False))


def test_a_slow_change_has_few_segments_in_memory_at_once():
    intervals = schedule(RunUp(1600.0, 1600.001, 100_000.0, 1, 0, worn=False), 62, 1e-7)
    assert max(len(interval.samples) for interval in intervals) <= 500


@pytest.mark.parametrize(
    ("start", "stop", "revolutions", "message"),
    [
        (100.0, 2000.0, 30.0, r"found a change from 100 to 2000 rad/s within 30 revolutions; allowed: 40 to 100000"),
        (0.5, 1e6, 90000.0, r"found speeds from 0\.5 to 1e\+06 rad/s; allowed: nearer ones"),
    ],
)
def test_a_sample_changes_the_speed_by_one_percent_at_most(start, stop, revolutions, message):
    choice = RunUpChoice(start, stop, None, None, revolutions, 1, 0, worn=False)
    with pytest.raises(RunUpError, match=message):
        choice.run_up(496)
    shortest = replace(choice, stop=2.0 * start, revolutions=3.0 / (1.01**2 - 1.0) / 496).run_up(496)
    samples = shortest.samples(496)
    speeds = np.sqrt(start**2 * (1.0 + 3.0 * np.arange(samples + 1) / samples))
    assert 0.0095 < np.max(np.diff(speeds) / speeds[:-1]) < 0.0101


def test_crossings_that_a_blade_does_not_have():
    speeds = {"speed": np.array([0.0, 2000.0]), "mode": ["1B"], "engine_order": [3, 4]}
    campbell = xr.Dataset({"crossing_speed": (("mode", "engine_order"), [[np.nan, 1900.0]])}, speeds)
    choice = RunUpChoice(-0.02, 0.08, Crossing("1B", 3), 100.0, None, 200, 0, worn=False)
    message = r"config\.yaml: run_ups\.up: found a run-up about 1B and engine order 3, which do not cross up to 2000 rad/s"
    with pytest.raises(RunUpError, match=message):
        choice.blade_run_up(496, campbell, "up")
    choice = replace(choice, crossing=Crossing("1B", 4))
    with pytest.raises(RunUpError, match=r"found 2052 rad/s; allowed: up to structure\.maximum_speed_rad_s, 2000"):
        choice.blade_run_up(496, campbell, "up")
    assert replace(choice, stop=0.05).blade_run_up(496, campbell, "up").stop == pytest.approx(1995.0)


def written(found, folder):
    """Dataset of one run-up."""
    write_speed(found, folder / "up.npz", {}, RUN_UP_ARRAYS)
    write_run_ups({("Ref", "abradable", "up"): folder / "up.npz"}, folder / "run_ups.nc", {})
    return xr.load_dataset(folder / "run_ups.nc")


def test_files_that_are_no_run_ups_are_named(contact, tmp_path):
    found = recorded(contact, NARROW, LONG, RunUp(1500.0, 1600.0, 1.0, 1, 0, worn=False))
    with pytest.raises(ValueError, match=r"rms_normal: found an array of shape \(1, 2\); allowed: revolution \(\d+\)"):
        written(found | {"rms_normal": found["rms_normal"][:1]}, tmp_path)
    with pytest.raises(InputFileError, match=r"up\.npz: cannot be read .* delete it and run again"):
        written({"status": found["status"]}, tmp_path)
    dataset = written(found, tmp_path)
    assert list(dataset.data_vars)[:3] == ["start_speed", "stop_speed", "rate"]
    assert dataset["amplitude"].dims == ("run", "revolution", "engine_order")
    np.testing.assert_array_equal(dataset["speed"][0], found["speed"])
    # without stress there is nothing to say of it
    table = run_up_table(dataset)
    assert "largest_stress_pa" not in table
    assert len(rate_table(table)) == 0
    draw_rates(table, "", scene="abradable")
    rate = f"{abs(dataset['rate'].item()):.4g} rad/s²"
    for worn, legend in ((0, [rate, "run-up"]), (1, [rate, "run-up", "worn before"])):
        dataset["worn"][:] = worn
        figure = draw_run_ups(dataset, "", blade="Ref", scene="abradable")
        assert [text.get_text() for text in figure.legends[0].texts] == legend
    stress = {"max_von_mises": xr.full_like(dataset["speed"], 1e9), "yield_stress": ("run", [1.38e9])}
    figure = draw_run_ups(dataset.assign(stress), "", blade="Ref", scene="abradable")
    assert "largest von Mises (GPa)" in [axes.get_ylabel() for axes in figure.axes]


def test_figures_of_runs_that_diverged_at_once(contact, tmp_path):
    scene = replace(NARROW, divergence_limit=1e-12)
    found = recorded(contact, scene, LONG, RunUp(1500.0, 1600.0, 1.0, 1, 0, worn=False))
    dataset = written(found | {"max_von_mises": np.empty(0)}, tmp_path)
    table = run_up_table(dataset)
    assert list(table["status"]) == ["diverged"]
    assert np.isnan(rate_table(table)["lowest_safe_rate_rad_s2"].item())
    draw_run_ups(dataset, "", blade="Ref", scene="abradable")
    draw_rates(table, "", scene="abradable")


def runs_at(rates, shares, **others):
    """Rows of run_ups.csv that differ by their rates, with stress as shares of yield, NaN where a run diverged."""
    common = {"blade": "Ref", "scene": "abradable", "low_speed_rad_s": 1600.0, "high_speed_rad_s": 1800.0, "direction": "up"}
    common |= {"lining": "new", "revolutions_before": 200, "revolutions_after": 50, "yield_stress_pa": 1e9}
    rows = pd.DataFrame([common | others | {"rate_rad_s2": rate} for rate in rates])
    status = np.where(np.isnan(shares), "diverged", "completed")
    return rows.assign(largest_stress_pa=1e9 * np.array(shares), status=status)


@pytest.mark.parametrize(
    ("shares", "lowest", "at_yield"),
    [
        ((0.9, 0.5, 0.1), 10.0, np.nan),
        ((4.0, 2.0, 0.5), 1000.0, np.sqrt(1e5)),
        # a slow one that stays below by chance does not count
        ((0.5, 10.0, 0.1), 1000.0, np.sqrt(1e5)),
        ((4.0, 2.0, 1.5), np.nan, np.nan),
        # exactly yield is not above
        ((1.0, 0.5), 10.0, np.nan),
        ((2.0, 0.5), 100.0, 10.0**1.5),
        # diverged: above yield
        ((2.0, np.nan, 0.5), 1000.0, 1000.0),
    ],
)
def test_rates_that_stay_below_yield(shares, lowest, at_yield):
    row = rate_table(runs_at((10.0, 100.0, 1000.0)[: len(shares)], shares).iloc[::-1]).iloc[0]
    assert row["rates"] == len(shares)
    assert row["largest_share_of_yield"] == pytest.approx(max(np.nan_to_num(shares, nan=np.inf)))
    np.testing.assert_allclose([row["lowest_safe_rate_rad_s2"], row["rate_at_yield_rad_s2"]], [lowest, at_yield])


def test_runs_that_differ_in_more_than_their_rate_are_told_apart_and_constant_speed_has_none():
    runs = pd.concat(
        [runs_at((10.0, 100.0), (2.0, 0.5)), runs_at((100.0,), (3.0,), revolutions_after=0), runs_at((0.0,), (3.0,))]
    )
    assert list(rate_table(runs)["lowest_safe_rate_rad_s2"].fillna(-1.0)) == [100.0, -1.0]


def test_a_run_has_its_labels_its_revolutions_after_those_before_and_its_last_stress(contact, tmp_path):
    """One speed is no run-down."""
    found = recorded(contact, NARROW, LONG, RunUp(1500.0, 1600.0, 1.0, 2, 2, worn=False))
    dataset = written(found | {"max_von_mises": 1e9 * np.array([9.0, 9.0, 0.5, 1.5, 0.25])}, tmp_path)
    (run,) = runs_of(dataset, blade="Ref", scene="abradable")
    np.testing.assert_array_equal(run["revolution"], [3, 4, 5])
    assert runs_of(dataset, blade="L50") == [] and runs_of(dataset, blade="Ref", scene="direct") == []
    for stop, direction in ((1600.0, "up"), (1500.0, "up"), (1400.0, "down")):
        (row,) = run_up_table(dataset.assign(stop_speed=("run", [stop]))).to_dict("records")
        assert (row["last_von_mises_pa"], row["largest_stress_pa"], row["direction"]) == (0.25e9, 1.5e9, direction)


def test_numbers_of_a_revolution_are_those_of_its_samples(contact):
    run_up = RunUp(1600.0, 1600.0, 2.0, 4, 0, worn=False)
    edge = samples_of(RunUpIntegration(contact, NARROW, LONG, run_up)).reshape(6, 62, 2, 3)[:, :, 0]
    found = recorded(contact, NARROW, LONG, run_up)
    np.testing.assert_allclose(found["speed"], 1600.0)
    np.testing.assert_allclose(found["time"], 2.0 * np.pi / 1600.0 * np.arange(1, 7))
    for name, direction in zip(("amplitude", "amplitude_tangential"), revolutions_module.KEPT, strict=True):
        orders = np.abs(np.fft.rfft(edge[..., direction], axis=1)) / 31
        np.testing.assert_allclose(found[name][:, 1:], orders[:, 1:9], rtol=1e-5, atol=1e-12)


def test_no_segment_leads_its_mean_speed_by_more_than_allowed():
    """And the longest come close to it: with many samples a revolution rounding to whole ones is small."""
    per_revolution, turns = 65536, 20.0
    rate = (1000.0**2 - 900.0**2) / (4.0 * np.pi * turns)
    speeds, samples = segments_of(schedule(RunUp(900.0, 1000.0, turns, 0, 0, worn=False), per_revolution, 0.0))
    lead = rate * (2.0 * np.pi * samples / per_revolution / speeds).max() ** 2 / 8.0
    assert 0.95 * schedule_module.LARGEST_LEAD < lead < 1.02 * schedule_module.LARGEST_LEAD
