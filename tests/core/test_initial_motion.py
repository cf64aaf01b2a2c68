"""Runs that start in motion: free flight against closed forms, and energy."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import DIRECT, NARROW, oscillator, with_static_modes
from integration_runs import ENGINES, assert_close, free_motion, times, whole_run
from motion_at_start import MotionAtStart
from scipy.linalg import expm

from r37core.contact.ring import RingMode
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL, INTEGRATORS
from r37core.time_integration.speed_run import numbers_of_run, simulation_of

SPEED = 1000.0
FAR = Scene(Casing(1.0, lobes=0), damping_ratio=0.02, divergence_limit=10.0)
"""A casing that nothing reaches."""

KEPT = {"spectrum_highest_order": 5, "wear_angles": 60}


def choice(integrator, step=2e-7, revolutions=1, **others):
    return IntegrationChoice(step, revolutions, 50, integrator=integrator, **others)


def exponential(system, step, motion):
    """Solution of x' = system x after each of fifty steps (s), shape (50, numbers), from `motion` on."""
    power, found = expm(step * system), [motion]
    for _ in range(50):
        found.append(power @ found[-1])
    return np.array(found[1:])


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("displacement", "velocity"), [(1e-3, 0.0), (0.0, 5.0), (1e-3, -5.0)])
def test_central_differences_start_to_second_order(engine, displacement, velocity):
    """Halving the step takes three quarters of the error; a start of first order would leave half of it."""
    frequency, ratio, errors = 6000.0, 0.1, []
    for steps in (32, 64, 128):
        chosen = choice(CENTRAL_DIFFERENCE, steps_per_sample=steps)
        scene, given = replace(FAR, damping_ratio=ratio), MotionAtStart([displacement], [velocity])
        simulation, _, record = whole_run(oscillator(frequency), SPEED, scene, chosen, given, engine)
        exact = free_motion(frequency, ratio, times(simulation, 50), displacement, velocity)
        errors.append(np.abs(record.samples[:, 0] - exact).max() / np.abs(exact).max())
    assert errors[0] < 1e-3
    np.testing.assert_allclose(errors[:2], 4.0 * np.array(errors[1:]), rtol=0.01)


def slow_part(reduced, speed, modes, generator):
    """Displacement and velocity in reduced coordinates, of random amplitudes of the first modes at a speed."""
    _, shapes = reduced.modes(speed, modes)
    return shapes @ (1e-5 * generator.standard_normal(modes)), shapes @ generator.standard_normal(modes)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("integrator", "within"), [(EXACT_MODAL, 1e-9), (CENTRAL_DIFFERENCE, 1e-4)])
def test_free_flight_of_a_blade_is_that_of_its_matrices(model, contact, integrator, within, engine):
    """Reduced coordinates at every sample, by the exponential of the first modes of the reduced matrices."""
    speed, modes, scene = 4800.0, 6, replace(FAR, damping_ratio=0.02)
    start = slow_part(model, speed, modes, np.random.default_rng(1))
    chosen = choice(integrator, snapshots_per_revolution=50, snapshot_revolutions=1)
    given = MotionAtStart(*start)
    simulation, _, record = whole_run(contact, speed, scene, chosen, given, engine)
    frequencies, shapes = model.modes(speed, modes)
    stiffness, damping = np.diag(frequencies**2), np.diag(2.0 * scene.damping_ratio * frequencies)
    system = np.block([[np.zeros((modes, modes)), np.eye(modes)], [-stiffness, -damping]])
    first = np.concatenate([shapes.T @ model.mass @ part for part in start])
    expected = exponential(system, times(simulation, 1)[0], first)[:, :modes] @ shapes.T
    assert_close(record.snapshots @ (contact.to_reduced @ simulation.problem.contact.state_shapes).T, expected, within)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_elastic_casing_starts_at_rest(engine):
    """The blade flies as beside a rigid one, and nothing moves the casing."""
    ring = (RingMode(2, 4000.0, 1.0, 0.01), RingMode(3, 9000.0, 1.0, 0.01))
    model, samples = with_static_modes(oscillator(6000.0), 1e-9), []
    for scene in (FAR, replace(FAR, casing=replace(FAR.casing, ring=ring))):
        _, state, record = whole_run(model, SPEED, scene, choice(EXACT_MODAL, 2e-6), MotionAtStart([1e-3], [2.0]), engine)
        samples.append(record.samples)
    assert record.casing.shape == (50, 4) and not record.casing.any() and not state.displacement[1:].any()
    np.testing.assert_allclose(*samples, rtol=0, atol=1e-14)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
def test_energy_balance_has_the_energy_of_the_start(model, contact, scene, integrator):
    speed, frequencies = 1600.0, model.modes(1600.0, 1)[0]
    # towards the casing, fast enough to reach it
    shape = model.modes(speed, 1)[1][:, 0]
    normal = contact.displacement_operator[0] @ np.linalg.solve(contact.to_reduced, shape)
    velocity = 3.0 * scene.casing.clearance * frequencies[0] / normal[np.abs(normal).argmax()] * shape
    # lobes grow, so that the casing is far as the run starts
    growing = replace(scene, casing=replace(scene.casing, lobes=0))
    given = MotionAtStart(velocity=velocity)
    simulation = simulation_of(contact, speed, growing, choice(integrator, 2e-7, 3))
    energy = simulation.energy(simulation.start(given))
    run = numbers_of_run(simulation.run(given), ("energy",), **KEPT)
    assert run["share_of_time_in_contact"] > 0.0
    assert energy == pytest.approx(0.5 * velocity @ model.mass @ velocity, rel=1e-3)
    assert run["energy_change"] < 0.0
    assert abs(run["energy_residual"]) < 1e-9 * energy
    assert numbers_of_run(simulation.run(), ("energy",), **KEPT)["share_of_time_in_contact"] == 0.0
