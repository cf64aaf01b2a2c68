"""A lining of second order and the static modes that go with it: order, energy, stability, and what long steps keep."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Lining, Scene
from integration_cases import ABRADABLE, LINING, oscillator, random_model
from scipy.integrate import solve_ivp

from r37core.time_integration import problem as problem_module
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.problem import Problem, UnstableStepError, stable_problem
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

NARROW = replace(ABRADABLE, lining=replace(LINING, bar_width=1e-3))
LONG = IntegrationChoice(3.2e-6, 2, 62, integrator=EXACT_MODAL, energy=True)
ELASTIC = Lining(5e-3, 20e9, 5e9, 1e30, bar_area=1e-6)
"""Bars that never yield."""


def test_error_of_a_mode_on_an_elastic_bar_falls_with_the_square_of_the_step():
    """Lobes press the bar against one damped mode; exact: SciPy's DOP853."""
    frequency, ratio, speed = 3000.0, 0.02, 1000.0
    casing = Casing(1e-4, lobes=2, amplitude=2.0, rise_fraction=0.0)
    scene = Scene(casing, replace(ELASTIC, bar_area=1e-11), damping_ratio=ratio, divergence_limit=1.0)
    model = oscillator(frequency)
    stiffness = scene.lining.elastic_modulus * scene.lining.area(0.25) / scene.lining.thickness

    def motion(time, state):
        shape = casing.shape(np.array([model.theta[0] - speed * time]))[0]
        pressed = max(0.0, state[0] - casing.clearance * (1.0 - casing.amplitude * shape))
        return state[1], -2 * ratio * frequency * state[1] - frequency**2 * state[0] - stiffness * pressed

    errors = []
    for step in (1.6e-5, 8e-6, 4e-6, 2e-6):
        simulation = Simulation(model, speed, scene, replace(LONG, time_step=step, revolutions=3, samples_per_revolution=50))
        ours = simulation.advance(simulation.start(), 3).samples[:, 0]
        time = (1 + np.arange(len(ours))) * simulation.problem.steps_per_sample * simulation.problem.time_step
        found = solve_ivp(motion, (0.0, time[-1]), [0.0, 0.0], "DOP853", time, rtol=1e-12, atol=1e-16, max_step=1e-5)
        errors.append(np.abs(ours - found.y[0]).max() / np.abs(found.y[0]).max())
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert errors[0] < 1e-2
    assert np.all((orders > 1.8) & (orders < 2.3)), orders


@pytest.mark.slow
@pytest.mark.parametrize(
    "scene",
    [
        NARROW,
        replace(NARROW, lining=replace(NARROW.lining, shared_ring=True)),
        replace(NARROW, friction=replace(NARROW.friction, vector=False)),
        replace(NARROW, exact_gap=True),
        # with the casing behind it
        replace(NARROW, lining=Lining(1e-4, 1e8, 5e7, 1e5, bar_width=0.03)),
    ],
    ids=["abradable", "shared", "constant", "exact", "thin"],
)
def test_energy_balance_closes_with_static_modes(contact, scene):
    simulation = Simulation(contact, 1600.0, scene, replace(LONG, revolutions=4))
    assert len(simulation.problem.frequencies) < len(contact.squared_frequencies)
    state = simulation.start()
    simulation.advance(state, 4)
    work, loss = state.totals["work"], state.totals["loss"]
    assert loss > 0.0
    assert (state.totals["casing_hits"] > 0) == (scene.lining.thickness < 1e-3)
    assert abs(simulation.energy(state) - work + loss) < 1e-10 * (abs(work) + loss)


def pressed_oscillator(share):
    """A mode that is always on its elastic bar, started beside its rest; `share`: of the limit's stiffness the bar has."""
    frequency, penetration, speed = 2e4, 1e-3, 1000.0
    choice = replace(LONG, time_step=2e-5, samples_per_revolution=314)
    free = Problem(oscillator(frequency), speed, Scene(Casing(1.0, lobes=0)), choice)
    keep, pull, inverse = (float(part[0]) for part in (free.recursion.keep, free.recursion.pull, free.recursion.inverse))
    stiffness = share * (2.0 * (1.0 + keep) - pull) / inverse
    lining = replace(ELASTIC, bar_area=stiffness * ELASTIC.thickness / ELASTIC.elastic_modulus)
    scene = Scene(Casing(-penetration, lobes=0), lining, divergence_limit=1e300)
    rest = -penetration * stiffness / (stiffness + frequency**2)
    return oscillator(frequency), speed, scene, choice, rest, stiffness * (penetration + rest)


@pytest.mark.parametrize("share", [0.97, 1.03])
def test_the_limit_of_the_lining_is_where_pressed_nodes_become_unstable(monkeypatch, share):
    model, speed, scene, choice, rest, force = pressed_oscillator(share)
    if share > 1.0:
        with pytest.raises(UnstableStepError, match="limit for this lining"):
            Problem(model, speed, scene, choice)
        monkeypatch.setattr(problem_module, "check_step", lambda problem: None)
    simulation = Simulation(model, speed, scene, choice)
    state = simulation.start()
    state.displacement[:] = rest * (1.0 + 1e-9)
    state.contact_force[0] = -force
    away = np.abs(simulation.advance(state, 1).samples[:, 0] / rest - 1.0)
    assert (away.max() > 1e-2) == (share > 1.0)
    assert share > 1.0 or away.max() < 1e-7


def test_a_stiff_lining_shortens_a_level_s_step_but_not_one_that_is_asked_for():
    model, speed, scene, choice, _, _ = pressed_oscillator(4.0)
    with pytest.raises(UnstableStepError, match=r"time_step_s: 2e-05 s .* limit for this lining"):
        stable_problem(model, speed, scene, choice)
    shortened = stable_problem(model, speed, scene, replace(choice, shorten=True))
    assert shortened.time_step < 0.6 * choice.time_step
    # not more than it must be
    with pytest.raises(UnstableStepError):
        Problem(model, speed, scene, replace(choice, time_step=4.0 * shortened.time_step))


def test_pressed_nodes_that_would_grow_by_the_lag_have_a_shorter_step():
    """Stepped modes and lagging forces are stable each by itself here, and grow together: to 1e8 J in twenty revolutions."""
    elastic = replace(NARROW.lining, elastic_modulus=1e15, yield_stress=1e30)
    scene, model = replace(NARROW, lining=elastic, friction=Friction(0.0)), random_model(8)
    choice = replace(LONG, revolutions=20, shorten=True)
    with pytest.raises(UnstableStepError):
        Problem(model, 1600.0, scene, replace(choice, time_step=6.7e-7))
    run = run_speed(model, 1600.0, scene, choice, ("energy",), spectrum_highest_order=5, wear_angles=60)
    assert run["status"] == 0
    assert 0.0 < run["contact_work"] < 100.0


@pytest.mark.parametrize("modulus", [2e10, 1e11, 1e12, 1e13, 1e14])
@pytest.mark.parametrize("number", [None, 8])
def test_no_few_nodes_that_stay_pressed_grow(contact, number, modulus):
    """Eigenvalues of the recursion of displacement, increment and lagging force, at the steps taken, without friction."""
    scene = replace(NARROW, lining=replace(NARROW.lining, elastic_modulus=modulus), friction=Friction(0.0))
    model = random_model(number) if number else contact
    for step in (6.4e-6, 3.2e-6, 1.6e-6, 8e-7):
        problem = stable_problem(model, 1600.0, scene, replace(LONG, time_step=step, shorten=True))
        for count in (2, 3, 8):
            for nodes in combinations(range(8), count):
                assert _growth(problem, list(nodes)) < 0.01, (step, problem.time_step, nodes)


def _growth(problem, nodes):
    """Factor, less one, by which the fastest growing motion with `nodes` on elastic bars grows in a revolution."""
    normal, recursion = problem.displacement_operator[0, nodes], problem.recursion
    flexibility = problem.residual_flexibility[0][np.ix_(nodes, nodes)]
    bars = problem.bar_stiffness / (1.0 + problem.bar_stiffness * np.diag(flexibility))
    others = flexibility - np.diag(np.diag(flexibility))
    push, by_u, by_force = recursion.inverse[:, None] * normal.T, -bars[:, None] * normal, -bars[:, None] * others
    increment = np.hstack([push @ by_u - np.diag(recursion.pull), np.diag(recursion.keep), push @ by_force])
    step = np.vstack([increment, increment, np.hstack([by_u, np.zeros_like(by_u), by_force])])
    modes = len(recursion.keep)
    step[:modes, :modes] += np.eye(modes)
    return np.abs(np.linalg.eigvals(step)).max() ** problem.steps_per_revolution - 1.0


@pytest.mark.slow
def test_a_split_run_with_static_modes_is_the_whole_run(contact):
    simulation = Simulation(contact, 1600.0, NARROW, replace(LONG, snapshots_per_revolution=62, snapshot_revolutions=2))
    whole_state, state = simulation.start(), simulation.start()
    whole = simulation.advance(whole_state, 2)
    parts = [simulation.advance(state, 1), simulation.advance(state, 1)]
    for name in ("samples", "snapshots"):
        joined = np.concatenate([getattr(part, name) for part in parts])
        np.testing.assert_array_equal(joined, getattr(whole, name))
    np.testing.assert_array_equal(state.wear, whole_state.wear)
    np.testing.assert_array_equal(state.contact_force, whole_state.contact_force)


@pytest.mark.slow
def test_samples_and_snapshots_have_the_share_of_the_static_modes(contact):
    """The samples are the snapshots' shapes at the tip, of which some percent are static when the blade is first pressed."""
    simulation = Simulation(contact, 1600.0, NARROW, replace(LONG, snapshots_per_revolution=62, snapshot_revolutions=2))
    record = simulation.advance(simulation.start(), 2)
    radial = contact.tip_displacement_operator[0, 0] @ simulation.problem.state_shapes
    largest = np.abs(record.samples[:, 1]).max()
    np.testing.assert_allclose(record.snapshots @ radial, record.samples[:, 1], rtol=0, atol=1e-12 * largest)
    stepped = len(simulation.problem.frequencies)
    static = np.abs(record.snapshots[:, stepped:] @ radial[stepped:]).max()
    assert 1e-3 * largest < static < 0.1 * largest


@pytest.mark.slow
def test_long_steps_keep_motion_stress_and_wear(contact):
    """Eight times the step, half of the modes static, a bar in ten met by a step."""
    found = [
        run_speed(
            contact,
            1600.0,
            NARROW,
            replace(LONG, time_step=step, revolutions=20, samples_per_revolution=496, snapshots_per_revolution=62),
            ("spectrum", "wear", "energy"),
            spectrum_highest_order=10,
            wear_angles=1000,
        )
        for step in (4e-7, 3.2e-6)
    ]
    fine, coarse = found
    assert coarse["time_step"] > 6 * fine["time_step"]
    assert coarse["wear"].shape == fine["wear"].shape == (1000,)
    for name, within in (("rms", 2e-3), ("peak", 5e-3), ("amplitude", 2e-3), ("wear_harmonic", 1e-2), ("max_wear", 1e-2)):
        scale = np.abs(fine[name]).max()
        np.testing.assert_allclose(coarse[name], fine[name], rtol=0, atol=within * scale, err_msg=name)


@pytest.mark.slow
def test_static_modes_let_go_of_a_casing_behind_worn_bars(contact):
    """Bars without a force from the start: when the blade leaves the casing, nothing is left on the static modes."""
    lining = replace(NARROW.lining, thickness=1e-5, elastic_modulus=20e6, plastic_modulus=5e6)
    choice = replace(LONG, time_step=8e-7, samples_per_revolution=248)
    found = []
    for engine in ("compiled", "reference"):
        simulation = Simulation(contact, 6000.0, replace(NARROW, lining=lining), replace(choice, engine=engine))
        state = simulation.start()
        state.wear[:] = lining.thickness
        found.append((simulation.advance(state, 2).samples, state.totals["casing_hits"]))
    (ours, hits), (theirs, _) = found
    assert hits > 0
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-10 * np.abs(theirs).max())
