"""Periodic motions: against a second integration, closed forms, and sweeps up and down through a fold."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import oscillator, with_static_modes
from scipy.integrate import solve_ivp

from r37core.second_motions.branches import Event, branch_through, events_of
from r37core.second_motions.choice import DOWN, UP, SweepChoice
from r37core.second_motions.periodic import NoOrbitError, PeriodicBlade, PeriodMap, orbit_after
from r37core.second_motions.sweeping import CarriedSweep
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.simulate import Simulation

FREQUENCY, DAMPING, FLEXIBILITY = 5000.0, 0.004, 1e-7
CLEARANCE = 0.356e-3
MODEL = with_static_modes(oscillator(FREQUENCY), FLEXIBILITY)
"""A mass on a spring that meets a lobe, which hardly reaches it at rest, through a second spring: it hardens."""

SCENE = Scene(Casing(CLEARANCE, lobes=1, amplitude=1.05, rise_fraction=0.0), damping_ratio=DAMPING)
CHOICE = IntegrationChoice(2e-6, 4, 124, integrator=EXACT_MODAL)
FIRST, LAST = 5150.0, 5500.0
KEPT = {"spectrum_highest_order": 4, "wear_angles": 8}


@cache
def followed():
    """Branch through the small motion at the highest speed, as far as the lowest, and what happens to it."""
    blade = PeriodicBlade.stepped(MODEL, SCENE, CHOICE, LAST)
    simulation = Simulation(MODEL, LAST, SCENE, blade.choice)
    state = simulation.start()
    simulation.advance(state, 400)
    orbits = branch_through(blade, orbit_after(blade, simulation, state, 1), FIRST, LAST, 300)
    return blade, orbits, events_of(blade, orbits)


def stop(time, speed):
    """Where the second spring begins (m)."""
    return CLEARANCE - SCENE.casing.lobe_height * SCENE.casing.shape(-speed * np.asarray(time))


def acceleration(time, motion, speed):
    """The same mass by its equation of motion."""
    displacement, velocity = motion
    push = max(displacement - float(stop(time, speed)), 0.0) / FLEXIBILITY
    return [velocity, -2.0 * DAMPING * FREQUENCY * velocity - FREQUENCY**2 * displacement - push]


@pytest.mark.slow
def test_a_branch_folds_twice_and_reaches_both_ends():
    _, orbits, events = followed()
    assert [event.event for event in events] == [Event.FOLD, Event.FOLD]
    assert sorted((orbits[0].speed, orbits[-1].speed)) == [FIRST, LAST]
    low, high = sorted(event.speed for event in events)
    assert FIRST < low < high < LAST
    between = orbits[min(event.orbit for event in events) : max(event.orbit for event in events)]
    assert not any(orbit.stable for orbit in between[1:-1])
    assert len(between) > 5


@pytest.mark.slow
def test_orbits_close_in_another_integration():
    blade, orbits, _ = followed()
    for orbit in (orbits[len(orbits) // 4], min((each for each in orbits if not each.stable), key=lambda each: each.speed)):
        at_speed = blade.map_at(orbit.speed)
        state, period = at_speed.state(orbit.z, orbit.phase), 2.0 * np.pi / orbit.speed
        start = [state.displacement[0], orbit.z[1]]
        begin = orbit.phase % blade.choice.samples_per_revolution / blade.choice.samples_per_revolution * period
        # the stiffness of the contact makes a step of a thousandth of the period exact enough
        options = {"args": (orbit.speed,), "rtol": 1e-10, "atol": 1e-14, "max_step": 1e-3 * period}
        end = solve_ivp(acceleration, (begin, begin + period), start, **options).y[:, -1]
        size = np.linalg.norm(orbit.z)
        distance = np.hypot(FREQUENCY * (end[0] - start[0]), end[1] - start[1]) / size
        # an unstable orbit is left by the growth of the difference of both integrations
        assert distance < 2e-3


@pytest.mark.slow
def test_the_multipliers_of_an_orbit_multiply_to_the_decay_of_a_free_motion():
    """The contact is a spring, so a volume of states shrinks by the damping alone: Liouville's formula."""
    for orbit in followed()[1][::10]:
        assert np.prod(orbit.multipliers).real == pytest.approx(
            np.exp(-4.0 * np.pi * DAMPING * FREQUENCY / orbit.speed), rel=1e-4
        )


@pytest.mark.slow
def test_the_motion_of_an_orbit_lasts():
    blade, orbits, _ = followed()
    orbit = max((each for each in orbits if each.stable), key=lambda each: each.rms[0])
    at_speed = blade.map_at(orbit.speed)
    state = at_speed.state(orbit.z, orbit.phase)
    motion = at_speed.simulation.advance_samples(state, 20 * blade.choice.samples_per_revolution).samples[:, 0]
    assert np.sqrt(np.mean(motion**2)) == pytest.approx(orbit.rms[0], rel=1e-9)
    assert np.abs(motion).max() == pytest.approx(orbit.peak, rel=1e-9)


@pytest.mark.slow
def test_sweeps_leave_their_motion_at_the_folds(tmp_path):
    low, high = sorted(event.speed for event in followed()[2])
    sweep = SweepChoice(FIRST, LAST, 5.0, revolutions=300)
    speeds = np.array(sweep.speeds)
    rms = {}
    for motion in (UP, DOWN):
        run = CarriedSweep(MODEL, SCENE, replace(CHOICE, revolutions=300), sweep, motion, (), KEPT)
        files = run.run(tmp_path / motion)
        levels = [np.load(file)["run"]["revolution_rms"][-1] for file in files]
        rms[motion] = np.array(levels if motion == UP else levels[::-1])
    differ = np.abs(rms[UP] - rms[DOWN]) > 0.05 * rms[UP]
    assert speeds[differ][0] == pytest.approx(low, abs=5.0)
    # just above the fold the motion falls slowly
    assert speeds[differ][-1] == pytest.approx(high, abs=10.0)
    assert np.all(differ[(speeds > low + 5.0) & (speeds < high - 5.0)])


def test_a_free_motion_has_the_multipliers_of_its_mode():
    """Within the clearance the map is that of the free motion, whatever the point: e^(lambda T)."""
    free = replace(SCENE, casing=replace(SCENE.casing, lobes=0))
    blade = PeriodicBlade.stepped(MODEL, free, CHOICE, 5000.0)
    at_speed = PeriodMap(Simulation(MODEL, 5000.0, free, blade.choice), *blade.basis)
    z, samples = np.array([0.1, 0.2]), CHOICE.samples_per_revolution
    multipliers = np.linalg.eigvals(at_speed.derivative(z, 0, samples, at_speed(z, 0, samples)))
    root = -DAMPING * FREQUENCY + 1j * FREQUENCY * np.sqrt(1.0 - DAMPING**2)
    expected = np.exp(root * 2.0 * np.pi / 5000.0)
    np.testing.assert_allclose(sorted(multipliers, key=np.imag), sorted([expected.conj(), expected], key=np.imag), rtol=1e-8)


def test_what_does_not_close_is_said():
    blade = PeriodicBlade.stepped(MODEL, SCENE, CHOICE, 5300.0)
    at_speed = blade.map_at(5300.0)
    with pytest.raises(NoOrbitError):
        at_speed.orbit(np.array([1e3, 1e3]), 0, CHOICE.samples_per_revolution)
