"""Run-ups: the schedule, exact limits of the integration, and a linear oscillator that is swept through its resonance."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from defaults import Casing, IntegrationChoice, Lining, Scene
from integration_cases import ABRADABLE, LINING, oscillator, with_static_modes
from integration_runs import ENGINES, in_all_directions
from reference_engine import ReferenceSimulation
from reference_run_up import RUN_UPS
from scipy.integrate import solve_ivp
from scipy.special import wofz

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
from r37studies.run_ups import choice as schedule_module
from r37studies.run_ups import integration as integration_module
from r37studies.run_ups import revolutions as revolutions_module
from r37studies.run_ups.choice import Crossing, RunUp, RunUpChoice, RunUpError, check_highest, schedule
from r37studies.run_ups.dataset import VARIABLES as RUN_UP_ARRAYS
from r37studies.run_ups.dataset import runs_of, write_run_ups
from r37studies.run_ups.figures import draw_rates, draw_run_ups
from r37studies.run_ups.integration import IntegratedSegments, RunUpIntegration
from r37studies.run_ups.revolutions import largest_stress, record_run_up
from r37studies.run_ups.tables import rate_table, run_up_table

LONG = IntegrationChoice(3.2e-6, 4, 62, integrator=EXACT_MODAL)
NARROW = replace(ABRADABLE, lining=replace(LINING, bar_width=1e-3))
FREE = Scene(Casing(1.0, lobes=0))
UNDAMPED = replace(FREE, damping_ratio=0.0)


def samples_of(integration):
    return np.concatenate([stage.samples for stage in integration.segments()])


def segments_of(intervals):
    return [segment for interval in intervals for segment in interval.segments]


@pytest.mark.parametrize(("start", "stop"), [(1300.0, 1800.0), (1800.0, 1300.0), (100.0, 101.0)])
@pytest.mark.parametrize("revolutions", [0.4, 3.7, 250.0])
def test_a_schedule_keeps_angle_and_time_of_a_constant_rate(start, stop, revolutions):
    per_revolution = 496
    segments = segments_of(schedule(RunUp(start, stop, revolutions, 3, 2, worn=False), per_revolution, 1e-8))
    samples = sum(segment.samples for segment in segments)
    assert samples % per_revolution == 0
    assert samples == per_revolution * (5 + np.ceil(round(revolutions * per_revolution) / per_revolution))
    changing = [one for one in segments if one.speed not in (start, stop)]
    time = sum(2.0 * np.pi * one.samples / per_revolution / one.speed for one in changing)
    angle = 2.0 * np.pi * sum(one.samples for one in changing) / per_revolution
    assert angle == pytest.approx(2.0 * np.pi * round(revolutions * per_revolution) / per_revolution, rel=1e-12)
    # at a constant rate the mean speed is that of the ends
    assert time == pytest.approx(angle / (0.5 * (start + stop)), rel=1e-12)
    assert np.all(np.diff([one.speed for one in changing]) * np.sign(stop - start) > 0.0)


def test_a_run_down_is_its_run_up_backwards():
    up, down = (schedule(RunUp(*ends, 40.3, 1, 0, worn=False), 496, 2e-7) for ends in ((1500.0, 1700.0), (1700.0, 1500.0)))
    assert segments_of(up[1:-1]) == segments_of(down[1:-1])[::-1]
    assert [one.speed for one in up[1:-1]] == [one.speed for one in down[1:-1]][::-1]


@pytest.mark.parametrize("engine", ENGINES)
def test_at_one_speed_a_run_up_is_the_run_at_that_speed(contact, engine):
    run = ENGINES[engine](contact, 1600.0, NARROW, LONG)
    expected = run.advance(run.start(), 6).samples
    integration = RUN_UPS[engine](contact, NARROW, LONG, RunUp(1600.0, 1600.0, 1.5, 4, 0, worn=False))
    np.testing.assert_array_equal(samples_of(integration), expected)


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


@pytest.mark.slow
@pytest.mark.parametrize(("ends", "intervals", "segments"), [((5000.0, 6000.0), 6, 1), ((1600.0, 1650.0), 2, 10)])
@pytest.mark.parametrize("scene", [NARROW, replace(ABRADABLE, lining=None)], ids=["abradable", "direct"])
def test_compiled_run_up_is_that_of_the_reference(contact, scene, ends, intervals, segments):
    choice = replace(LONG, time_step=3.2e-6 if scene.lining else 8e-7)
    run_up = RunUp(*ends, 1.3, 1, 0, worn=False)
    ours, theirs = (run_up_class(contact, scene, choice, run_up) for run_up_class in RUN_UPS.values())
    found, expected = samples_of(ours), samples_of(theirs)
    assert len(ours.intervals) >= intervals
    assert max(len(interval.segments) for interval in ours.intervals) >= segments
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-10 * np.abs(expected).max())
    for name in ("work", "loss"):
        assert ours.state.totals[name] == pytest.approx(float(theirs.state.totals[name]), rel=1e-8)
    assert ours.stiffness_work == pytest.approx(theirs.stiffness_work, rel=1e-8)
    assert ours.stiffness_work != 0.0


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


@pytest.mark.parametrize("scene", [NARROW, replace(ABRADABLE, lining=None)], ids=["abradable", "direct"])
def test_energy_closes_with_the_work_of_the_changing_stiffness(contact, scene):
    choice = replace(LONG, time_step=3.2e-6 if scene.lining else 8e-7)
    integration = RunUpIntegration(contact, scene, choice, RunUp(1500.0, 1900.0, 3.2, 1, 0, worn=False))
    samples_of(integration)
    balance = integration.balance
    work, loss = balance["contact_work"], balance["damping_loss"]
    assert loss > 0.0
    assert abs(integration.stiffness_work) > 1e-6 * abs(work)
    assert abs(balance["energy_change"] - work + loss - integration.stiffness_work) < 1e-10 * (abs(work) + loss)


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


@pytest.mark.parametrize("integrator", ["exact_modal", "central_difference"])
def test_without_contact_a_run_up_and_its_run_down_give_back_what_was_there(contact, integrator):
    """Undamped motion goes back the way it came when its velocity is turned round, through all changes of the modes."""
    choice = replace(LONG, time_step=1e-7 if integrator == "central_difference" else 5e-7, integrator=integrator)
    ends = ((4000.0, 5000.0), (5000.0, 4000.0))
    up, down = (RunUpIntegration(contact, UNDAMPED, choice, RunUp(*one, 2.0, 1, 0, worn=False)) for one in ends)
    up.intervals, down.intervals = up.intervals[1:], down.intervals[1:]
    started = 1e-5 / (1.0 + np.arange(len(up.velocity))), 1e-2 * np.ones(len(up.velocity))
    up.state.displacement[:], up.velocity = started
    largest = np.abs(samples_of(up)).max()
    assert len(up.intervals) > 5
    assert np.abs(up.state.displacement - started[0]).max() > 1e-6
    down.state.displacement, down.velocity = up.state.displacement, -up.velocity
    samples_of(down)
    # what the speed turns into static modes is lost
    within = 1e-9 if integrator == "central_difference" else 1e-8
    np.testing.assert_allclose(down.state.displacement, started[0], rtol=0, atol=within * largest)
    np.testing.assert_allclose(-down.velocity, started[1], rtol=0, atol=1e2 * within)


def test_a_swept_oscillator_follows_the_closed_form(monkeypatch):
    """A mode always pressed on an elastic bar by a lobed casing is linear: Lewis (Trans. ASME 54, 1932) with Fresnel integrals.

    Each harmonic of the casing forces it with exp(i m (theta_0 + Omega t + a t^2/2)); the motion is the steady one at the first
    speed and Duhamel's integral, which the Faddeeva function has in closed form.
    """
    frequency, ratio, start, rate, revolutions, per_revolution = 4000.0, 0.004, 1900.0, 1500.0, 60.0, 62
    casing = Casing(1e-5, lobes=2, width=1.0, amplitude=20.0, rise_fraction=0.0)
    lining = Lining(5e-3, 20e9, 5e9, 1e30, bar_area=4e-14)
    bar, model = lining.elastic_modulus * lining.bar_area / lining.thickness, with_static_modes(oscillator(frequency), 1e-9)
    natural = np.sqrt(frequency**2 + bar)
    run_up = RunUp(start, float(np.sqrt(start**2 + 4.0 * np.pi * rate * revolutions)), revolutions, 250, 0, worn=False)
    angle = 2.0 * np.pi * np.arange(1, revolutions * per_revolution + 1) / per_revolution
    time = (np.sqrt(start**2 + 2.0 * rate * angle) - start) / rate
    exact = swept_motion(casing, model.theta[0], bar, natural, ratio * frequency / natural, start, rate, time)
    level = np.abs(exact - exact.mean())
    # the peak comes after the resonance, at 2010 rad/s, and the motion beats
    assert 2040.0 < start + rate * time[np.argmax(level)] < 2060.0
    errors = {}
    for lead, step in ((1e-5, 4e-5), (1e-5, 1e-5), (schedule_module.LARGEST_LEAD, 1e-5)):
        monkeypatch.setattr(schedule_module, "LARGEST_LEAD", lead)
        choice = replace(LONG, time_step=step, samples_per_revolution=per_revolution, static_above=10.0)
        integration = RunUpIntegration(model, Scene(casing, lining, damping_ratio=ratio), choice, run_up)
        found = samples_of(integration)[250 * per_revolution :, 0]
        assert integration.state.totals["steps_in_contact"] > 0.9999 * integration.state.totals["steps"]
        errors[lead, step] = np.abs(found - exact).max() / level.max()
    coarse, fine, shipped = errors.values()
    assert fine < 3e-4
    # two steps against six in a sample
    assert fine < 0.15 * coarse
    assert shipped < 6e-4


def swept_motion(casing, theta, bar, natural, damping, start, rate, time):
    """Displacement (m) at times (s) after the change of the speed begins; the angle falls with time, from theta."""
    period = 2.0 * np.pi / casing.lobes
    angles = np.arange(4096) * period / 4096
    fourier = np.fft.fft(casing.clearance * (1.0 - casing.amplitude * casing.shape(angles))) / 4096
    damped = natural * np.sqrt(1.0 - damping**2)
    found = np.full(len(time), bar * fourier[0].real / natural**2, dtype=complex)
    for harmonic in range(1, 8):
        order, amplitude = harmonic * casing.lobes, 2.0 * fourier[harmonic] * bar
        # Re(amplitude exp(i order (theta - Omega t - a t^2/2)))
        force = amplitude * np.exp(1j * order * theta)
        steady = force / (natural**2 - (order * start) ** 2 - 2j * damping * natural * order * start)
        decay, swing = np.exp(-damping * natural * time), damped * time
        velocity = -1j * order * start * steady
        free = steady.real * np.cos(swing) + (velocity.real + damping * natural * steady.real) / damped * np.sin(swing)
        found += decay * free
        for sign in (1.0, -1.0):
            root = -damping * natural + sign * 1j * damped
            swept = _integral(-root - 1j * order * start, order * rate, time)
            found += (force / (2j * sign * damped) * np.exp(root * time) * swept).real
    return found.real


def _integral(slope, curvature, time):
    """Integral of exp(slope t - i curvature t^2/2) from 0 to the times, by the error function of a complex number."""
    root = np.sqrt(0.5j * curvature)

    def primitive(t):
        # exp(slope t - root^2 t^2) erfc(z) exp(z^2) with z = root t - slope/(2 root), but for the sign of its real part
        z = root * t - slope / (2.0 * root)
        left = z.real < 0.0
        scaled = wofz(1j * np.where(left, -z, z)) * np.exp(slope * t - root**2 * t**2)
        return np.where(left, 2.0 * np.exp(slope**2 / (4.0 * root**2)) - scaled, scaled)

    return np.sqrt(np.pi) / (2.0 * root) * (primitive(np.zeros(1)) - primitive(time))


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
    assert max(len(interval.segments) for interval in intervals) <= 500


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


def test_the_highest_speed_of_the_model_is_allowed():
    check_highest(2000.0, 2000.0)
    with pytest.raises(RunUpError, match=r"found 2000\.\d+ rad/s|found 2000 rad/s"):
        check_highest(np.nextafter(2000.0, 3000.0), 2000.0)


def run_of(stress, *, start=900.0, stop=1000.0, before=2, **more):
    """A dataset of one run-up of blade Ref, whose revolutions have this stress (shares of yield); the first two come before."""
    count = len(stress)
    speed = np.linspace(start, stop, count)
    rms = np.ones((count, 2)) * np.arange(count)[:, None]
    of_run = {"start_speed": start, "stop_speed": stop, "rate": 10.0, "worn": 0, "revolutions_before": before}
    of_run |= {"revolutions_after": 0, "status": 0, "casing_hits": 0, "yield_stress": 1e9} | more
    names = {name: ("run", [label]) for name, label in (("blade", "Ref"), ("scene", "direct"), ("run_up", "a"))}
    return xr.Dataset(
        {name: ("run", [value]) for name, value in of_run.items()}
        | {
            "speed": (("run", "revolution"), speed[None]),
            "rms_normal": (("run", "revolution", "tip_point"), rms[None]),
            "rms_tangential": (("run", "revolution", "tip_point"), rms[None]),
            "max_von_mises": (("run", "revolution"), 1e9 * np.array(stress)[None]),
        },
        names | {"revolution": np.arange(1, count + 1), "tip_point": ["leading_edge", "trailing_edge"]},
    )


def test_a_run_has_its_labels_its_revolutions_after_those_before_and_its_last_stress():
    """One speed is no run-down."""
    dataset = run_of([0.1, 0.2, 0.3, 0.4])
    (run,) = runs_of(dataset, blade="Ref", scene="direct")
    np.testing.assert_array_equal(run["revolution"], [3, 4])
    assert runs_of(dataset, blade="L50") == [] and runs_of(dataset, blade="Ref", scene="abradable") == []
    (row,) = run_up_table(run_of([9.0, 9.0, 0.5, 1.5, 0.25])).to_dict("records")
    assert (row["last_von_mises_pa"], row["largest_stress_pa"], row["direction"]) == (0.25e9, 1.5e9, "up")
    assert run_up_table(run_of([0.1, 0.2, 0.3], stop=900.0))["direction"].item() == "up"
    assert run_up_table(run_of([0.1, 0.2, 0.3], stop=800.0))["direction"].item() == "down"


class _Stress:
    """Of a node that has the coordinate itself as its stress; counts how often it is asked."""

    def __init__(self):
        self.asked = []

    def max_von_mises(self, coordinates):
        self.asked.append(len(coordinates))
        return np.abs(coordinates[:, 0])


def test_instants_that_may_have_the_largest_stress_are_all_looked_at(monkeypatch):
    """In lots, of which there are several here; the bound of another instant may be the largest."""
    monkeypatch.setattr(revolutions_module, "_INSTANTS_AT_ONCE", 3)
    rng = np.random.default_rng(5)
    coordinates = rng.uniform(0.5, 1.0, size=(4, 6, 1))
    bound = coordinates[..., 0] + rng.uniform(0.3, 0.6, size=(4, 6))
    stress = _Stress()
    np.testing.assert_array_equal(largest_stress(stress, coordinates, bound), coordinates[..., 0].max(axis=1))
    assert max(stress.asked[1:]) == 3
    assert largest_stress(stress, np.empty((0, 6, 1)), np.empty((0, 6))).shape == (0,)


def test_revolutions_last_as_long_as_their_samples(contact):
    """Time, speed and the orders of both motions of a stage of one speed."""
    per_revolution = LONG.samples_per_revolution
    angle = 2.0 * np.pi * np.arange(2 * per_revolution) / per_revolution
    samples = np.zeros((2 * per_revolution, 2, 3))
    samples[:, 0, revolutions_module.KEPT[0]] = 1.0 + 3.0 * np.cos(4.0 * angle)
    samples[:, 0, revolutions_module.KEPT[1]] = 2.0 * np.cos(5.0 * angle)
    speeds, wear = np.full(len(samples), 100.0), np.zeros(len(samples))
    collected = revolutions_module._Revolutions(contact, LONG, 5, None, False)
    nothing = np.empty((0, 1)), np.empty(0), np.empty((1, 1)), False
    collected.add(IntegratedSegments(speeds, samples.reshape(len(samples), -1), wear, *nothing))
    values = collected.joined()
    np.testing.assert_allclose(values["speed"], 100.0)
    np.testing.assert_allclose(values["time"], [2.0 * np.pi / 100.0, 4.0 * np.pi / 100.0])
    assert values["amplitude"].shape == values["amplitude_tangential"].shape == (2, 6)
    np.testing.assert_allclose(values["amplitude"][0], [1.0, 0, 0, 0, 3.0, 0], atol=1e-6)
    np.testing.assert_allclose(values["amplitude_tangential"][0], [0, 0, 0, 0, 0, 2.0], atol=1e-6)


def test_no_segment_leads_its_mean_speed_by_more_than_allowed():
    """And the longest come close to it: with many samples a revolution rounding to whole ones is small."""
    per_revolution, turns = 65536, 20.0
    rate = (1000.0**2 - 900.0**2) / (4.0 * np.pi * turns)
    segments = segments_of(schedule(RunUp(900.0, 1000.0, turns, 0, 0, worn=False), per_revolution, 0.0))
    lasting = np.array([2.0 * np.pi * segment.samples / per_revolution / segment.speed for segment in segments])
    lead = rate * lasting.max() ** 2 / 8.0
    assert 0.95 * schedule_module.LARGEST_LEAD < lead < 1.02 * schedule_module.LARGEST_LEAD
