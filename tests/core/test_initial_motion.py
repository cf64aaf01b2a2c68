"""Runs that start in motion: free flight against closed forms, energy, what is not stepped, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import DIRECT, NARROW, oscillator, with_static_modes
from integration_runs import ENGINES, assert_close, free_motion, times, whole_run
from scipy.linalg import expm

from r37core.contact.ring import RingMode
from r37core.time_integration.initial_motion import InitialMotion, InitialMotionError
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL, INTEGRATORS
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

SPEED = 1000.0
FAR = Scene(Casing(1.0, lobes=0), damping_ratio=0.02, divergence_limit=10.0)
"""A casing that nothing reaches."""

KEPT = {"spectrum_highest_order": 5, "wear_angles": 60}


def choice(integrator, step=2e-7, revolutions=1, **others):
    return IntegrationChoice(step, revolutions, 50, integrator=integrator, **others)


def motion(displacement=None, velocity=None):
    return InitialMotion.from_arrays(displacement, velocity)


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
        scene, given = replace(FAR, damping_ratio=ratio), motion([displacement], [velocity])
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
    given = motion(*start)
    simulation, _, record = whole_run(contact, speed, scene, chosen, given, engine)
    frequencies, shapes = model.modes(speed, modes)
    stiffness, damping = np.diag(frequencies**2), np.diag(2.0 * scene.damping_ratio * frequencies)
    system = np.block([[np.zeros((modes, modes)), np.eye(modes)], [-stiffness, -damping]])
    first = np.concatenate([shapes.T @ model.mass @ part for part in start])
    expected = exponential(system, times(simulation, 1)[0], first)[:, :modes] @ shapes.T
    assert_close(record.snapshots @ (contact.to_reduced @ simulation.problem.contact.state_shapes).T, expected, within)
    assert given.left_out(simulation.problem) < 1e-12


def test_what_is_not_stepped_is_left_out(model, contact):
    """A fast mode does not move, and its share of the energy is told; a slow one beside it moves as it does alone."""
    speed, chosen = 1600.0, choice(EXACT_MODAL, 6.4e-6)
    frequencies, shapes = model.modes(speed)
    slow, fast = 1e-5 * shapes[:, 0], 1e-5 * frequencies[0] / frequencies[-1] * shapes[:, -1]
    runs = {}
    for name, displacement in {"slow": slow, "fast": fast, "both": slow + fast}.items():
        given = motion(displacement)
        simulation, state, record = whole_run(contact, speed, FAR, chosen, given)
        runs[name] = record.samples, given.left_out(simulation.problem), simulation.energy(state)
    assert len(simulation.problem.blade.frequencies) < len(frequencies)
    scale = np.abs(runs["slow"][0]).max()
    np.testing.assert_allclose(runs["fast"][0], 0.0, rtol=0, atol=1e-9 * scale)
    np.testing.assert_allclose(runs["both"][0], runs["slow"][0], rtol=0, atol=1e-9 * scale)
    assert [share for _, share, _ in runs.values()] == pytest.approx([0.0, 1.0, 0.5], abs=1e-9)
    # the energy that a velocity has is told, too
    velocity = motion(None, frequencies[0] * slow + frequencies[-1] * np.sqrt(3.0) * fast)
    assert velocity.left_out(simulation.problem) == pytest.approx(0.75, abs=1e-9)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_elastic_casing_starts_at_rest(engine):
    """The blade flies as beside a rigid one, and nothing moves the casing."""
    ring = (RingMode(2, 4000.0, 1.0, 0.01), RingMode(3, 9000.0, 1.0, 0.01))
    model, samples = with_static_modes(oscillator(6000.0), 1e-9), []
    for scene in (FAR, replace(FAR, casing=replace(FAR.casing, ring=ring))):
        _, state, record = whole_run(model, SPEED, scene, choice(EXACT_MODAL, 2e-6), motion([1e-3], [2.0]), engine)
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
    given = motion(None, velocity)
    run = run_speed(contact, speed, growing, choice(integrator, 2e-7, 3), ("energy",), **KEPT, motion=given)
    assert run["share_of_time_in_contact"] > 0.0 and run["initial_energy_left_out"] < 1e-12
    mass_norm = velocity @ model.mass @ velocity
    assert run["initial_energy"] == pytest.approx(0.5 * mass_norm, rel=1e-3)
    assert run["energy_change"] < 0.0
    assert abs(run["energy_residual"]) < 1e-9 * run["initial_energy"]
    rest_state = run_speed(contact, speed, growing, choice(integrator, 2e-7, 3), ("energy",), **KEPT)
    assert rest_state["share_of_time_in_contact"] == 0.0 and "initial_energy" not in rest_state


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
def test_a_start_in_no_motion_is_the_start_at_rest(contact, scene, integrator):
    """To the last bit."""
    zeros, chosen = np.zeros(len(contact.to_reduced)), choice(integrator, 2e-7, 2)
    runs = [run_speed(contact, 1600.0, scene, chosen, ("energy",), **KEPT, motion=one) for one in (None, motion(zeros, zeros))]
    assert set(runs[1]) - set(runs[0]) == {"initial_energy", "initial_energy_left_out"}
    for name, value in runs[0].items():
        np.testing.assert_array_equal(runs[1][name], value)
    assert motion(zeros, zeros).attributes == {}
    assert runs[0]["share_of_time_in_contact"] > 0.0


@pytest.mark.parametrize(
    ("displacement", "velocity", "message"),
    [
        (1e-3, None, r"initial_displacement: found an array of shape \(\); allowed: finite numbers in a row"),
        (None, [[1.0]], r"initial_velocity: found an array of shape \(1, 1\); allowed: finite numbers in a row"),
        ([[1.0], [1.0, 2.0]], None, "initial_displacement: found rows of different lengths; allowed"),
        ([1.0j], None, "initial_displacement: found entries of kind complex128; allowed"),
        (None, ["fast"], "initial_velocity: found entries of kind str128; allowed"),
        (None, [True], "initial_velocity: found entries of kind bool; allowed"),
        ([0.0, np.nan], None, "initial_displacement: found nan at place 1, counted from 0; allowed"),
        (None, [-np.inf], "initial_velocity: found -inf at place 0, counted from 0; allowed"),
    ],
)
def test_what_is_no_motion_is_refused(displacement, velocity, message):
    with pytest.raises(InitialMotionError, match=f"^{message}") as refusal:
        motion(displacement, velocity)
    assert "\n" not in str(refusal.value)


def test_a_motion_of_another_model_is_refused(contact):
    simulation = Simulation(contact, SPEED, FAR, choice(EXACT_MODAL))
    size = len(contact.to_reduced)
    with pytest.raises(InitialMotionError, match=rf"^initial_velocity: found 3 numbers; allowed: {size}, one for each coord"):
        simulation.start(motion(np.zeros(size), np.zeros(3)))
    with pytest.raises(InitialMotionError, match=r"^initial_displacement, initial_velocity: found an energy .*; allowed: less"):
        motion(None, np.full(size, 1e200)).left_out(simulation.problem)


@pytest.mark.parametrize("exact_gap", [False, True])
@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_start_inside_of_the_casing_is_refused(scene, engine, exact_gap):
    """One node, whose room is the clearance less the lobe above it."""
    model, chosen = with_static_modes(oscillator(6000.0), 1e-9), choice(EXACT_MODAL, 2e-6)
    simulation = ENGINES[engine](model, SPEED, replace(scene, exact_gap=exact_gap), chosen)
    problem = simulation.problem
    room = scene.casing.clearance - scene.casing.lobe(problem.casing.theta(0), 0.0, 0.0)[0]
    assert 0.0 < room < scene.casing.clearance
    state = simulation.start(motion([room]))
    assert state.displacement[0] == room
    told = r"^initial_displacement: contact node 1 of 1, .*, would start 1e-06 m inside of the casing or lining; allowed: a"
    with pytest.raises(InitialMotionError, match=told):
        simulation.start(motion([room + 1e-6]))
    # on the other side there is room
    simulation.start(motion([-10.0 * room]))


def test_a_start_in_the_groove_that_the_tip_has_cut_is_allowed():
    """A casing that comes nearer than the tip: the lining is worn so deep, and there is no room beyond."""
    casing = replace(NARROW.casing, clearance=-1e-4, lobes=0, growth_speeds=(0.0, 2e3), growth=(0.0, 0.0))
    model = with_static_modes(oscillator(6000.0), 1e-9)
    simulation = Simulation(model, SPEED, replace(NARROW, casing=casing), choice(EXACT_MODAL, 2e-6))
    assert simulation.start(motion([0.0])).wear.min() == pytest.approx(1e-4)
    with pytest.raises(InitialMotionError, match="would start 2e-06 m inside"):
        simulation.start(motion([2e-6]))
