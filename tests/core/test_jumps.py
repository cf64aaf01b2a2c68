"""Jumps over free flight against plain stepping."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from hypothesis import given, settings
from hypothesis import strategies as st
from integration_cases import ABRADABLE, AT_ONCE, DIRECT, oscillator

from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL, central_difference
from r37core.time_integration.jump_plan import jump_lengths, plan_jumps
from r37core.time_integration.problem import Problem
from r37core.time_integration.simulate import Simulation


def both(model, scene, choice, speed, displacement=None, increment=None):
    """State and record of the same run with jumps and without."""
    for jumps in (True, False):
        simulation = Simulation(model, speed, scene, replace(choice, jumps=jumps))
        state = simulation.start()
        if displacement is not None:
            state.displacement[:] = displacement
            state.increment[:] = increment
        yield state, simulation.advance(state, choice.revolutions)


@pytest.mark.slow
@pytest.mark.parametrize("scene", [ABRADABLE, DIRECT, replace(ABRADABLE, exact_gap=True)], ids=["abradable", "direct", "exact"])
@pytest.mark.parametrize("speed", [900.0, 1600.0])
@pytest.mark.parametrize(("integrator", "step"), [(CENTRAL_DIFFERENCE, 2e-7), (EXACT_MODAL, 8e-7)])
def test_long_run_with_jumps_is_the_plain_run(contact, scene, speed, integrator, step):
    """10 revolutions, 49,000 steps and more; after 20, a start moved by 1e-18 m makes a difference of 1e-8."""
    choice = IntegrationChoice(step, 10, 496, integrator=integrator)
    (jumped, with_jumps), (plain, without) = both(contact, replace(scene, casing=Casing(0.356e-3)), choice, speed)
    assert jumped.totals["steps_jumped"] > 0.1 * jumped.totals["steps"]
    assert plain.totals["steps_jumped"] == 0
    largest = np.abs(without.samples).max()
    np.testing.assert_allclose(with_jumps.samples, without.samples, rtol=0, atol=1e-10 * largest)
    for count in ("steps_in_contact", "casing_hits"):
        assert jumped.totals[count] == plain.totals[count]
    for energy in ("work", "loss"):
        np.testing.assert_allclose(jumped.totals[energy], plain.totals[energy], rtol=1e-9)
    if plain.wear.size:
        np.testing.assert_allclose(jumped.wear, plain.wear, rtol=0, atol=1e-10 * plain.wear.max())


@settings(max_examples=40)
@given(
    st.integers(0, 2**31 - 1),
    st.sampled_from([1e-3, 1e-6, 1e-9, -1e-9, -1e-6]),
    st.booleans(),
    st.integers(0, 5),
    st.sampled_from([None, 0.0, 0.4]),
)
@pytest.mark.slow
def test_no_contact_is_missed(contact, seed, excess, exact, lobes, cone_angle):
    """Random states of many modes; the casing is put where a step of the free motion just passes it, or just does not."""
    generator = np.random.default_rng(seed)
    frequencies = contact.modes_at(1500.0)[0]
    share = generator.uniform(0, 1) ** np.arange(len(frequencies)) * generator.choice([1.0, 50.0])
    displacement = generator.standard_normal(len(frequencies)) * share / frequencies
    choice = IntegrationChoice(generator.uniform(1e-7, 4e-7), 1, int(generator.integers(20, 200)))
    increment = generator.standard_normal(len(frequencies)) * share * choice.time_step
    amplitude, width = (generator.uniform(0.1, 0.7), generator.uniform(0.05, 0.3)) if lobes else (0.0, 1.0)
    casing = Casing(1.0, lobes, width, amplitude, rise_fraction=0.0, cone_angle=cone_angle)
    open_scene = Scene(casing, exact_gap=exact, divergence_limit=10.0)
    reach = largest_reach(contact, open_scene, choice, displacement, increment)
    scene = replace(open_scene, casing=replace(casing, clearance=reach * (1.0 - excess)))
    (jumped, _), (plain, _) = both(contact, scene, choice, 1500.0, displacement, increment)
    assert (plain.totals["steps_in_contact"] > 0) == (excess > 0)
    assert jumped.totals["steps_in_contact"] == plain.totals["steps_in_contact"]
    scale = np.abs(plain.displacement).max()
    np.testing.assert_allclose(jumped.displacement, plain.displacement, rtol=0, atol=1e-9 * scale)


def largest_reach(model, scene, choice, displacement, increment):
    """The smallest clearance that a free run never uses up, by the recursion in NumPy."""
    problem = Problem(model, 1500.0, scene, choice)
    keep, pull = problem.contact.recursion.keep, problem.contact.recursion.pull
    cosine, sine = np.cos(problem.casing.cone_angle), np.sin(problem.casing.cone_angle)
    u, d = np.empty((problem.grid.steps_per_revolution + 1, len(keep))), increment
    u[0] = displacement
    for n in range(problem.grid.steps_per_revolution):
        d = keep * d - pull * u[n]
        u[n + 1] = u[n] + d
    position, tangential, meridional = (u[1:] @ rows.T for rows in problem.contact.displacement_operator)
    turned = 2.0 * np.pi * np.arange(1, len(u)) / problem.grid.steps_per_revolution
    theta = model.theta - turned[:, None]
    if scene.exact_gap:
        from_axis = model.radius + cosine * position + sine * meridional
        position = position + cosine * (np.hypot(from_axis, tangential) - from_axis)
        theta = theta + np.arctan2(tangential, from_axis)
    return (position / (1.0 - scene.casing.amplitude * scene.casing.shape(theta))).max()


def test_lobes_that_pass_during_a_jump_are_met():
    """A blade at rest is hit by every lobe of a casing deformed from the start, though no node moves."""
    model = oscillator(6000.0)
    scene = Scene(replace(AT_ONCE, lobes=7, width=0.01, amplitude=1.001))
    (jumped, _), (plain, _) = both(model, scene, IntegrationChoice(1e-6, 2, 3), 1000.0)
    assert plain.totals["steps_in_contact"] > 0
    assert jumped.totals["steps_in_contact"] == plain.totals["steps_in_contact"]
    assert jumped.totals["steps_jumped"] > 0


@pytest.mark.parametrize("ratio", [0.0, 5e-4, 0.3])
def test_jump_is_the_power_of_the_step(ratio):
    frequencies = np.array([3e3, 4e4, 9e5])
    recursion = central_difference(frequencies, ratio, 1e-6)
    loss = np.array([1.0, 2.0, 3.0])
    recursion = replace(recursion, lost=4.0 * recursion.inverse * loss)
    plan = plan_jumps(recursion, 77, 1, followed=3)
    np.testing.assert_array_equal(jump_lengths(77), [5, 8, 16, 32, 64])
    for length, jump in zip(jump_lengths(77), plan.jumps, strict=True):
        u, d, lost = np.array([1.0, -2.0, 0.5]), np.array([0.1, 0.2, -0.3]), np.zeros(3)
        mapped_u = u + jump[0] * u + jump[1] * d
        mapped_d = d + jump[2] * u + jump[3] * d
        mapped_loss = jump[4] * u * u + jump[5] * u * d + jump[6] * d * d
        for _ in range(length):
            following = recursion.keep * d - recursion.pull * u
            lost += loss * (following + d) ** 2
            u, d = u + following, following
        np.testing.assert_allclose(mapped_u, u, rtol=1e-11, atol=1e-12)
        np.testing.assert_allclose(mapped_d, d, rtol=1e-11, atol=1e-12)
        np.testing.assert_allclose(mapped_loss, lost, rtol=1e-11)


def test_bound_beyond_the_tangent_is_reached_but_not_passed():
    """A slow mode of unit amplitude, whatever its phase; a smaller bound would jump over contacts."""
    plan = plan_jumps(central_difference(np.array([100.0]), 0.0, 1e-6), 77, 1, followed=1)
    assert plan.slow_modes.all()
    eigenvalue = np.exp(1j * np.arccos(1.0 - 0.5 * 1e-8))
    phases = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 721))
    u, d = phases.real, (phases * (1.0 - 1.0 / eigenvalue)).real
    for length, jump in zip(jump_lengths(77), plan.jumps, strict=True):
        beyond = np.abs((phases * eigenvalue**length).real - u - length * d).max()
        assert 0.99 * jump[7, 0] < beyond <= jump[7, 0] * (1.0 + 1e-6)
    # the faster of two does not follow its tangent, and stays within its amplitude
    plan = plan_jumps(central_difference(np.array([100.0, 200.0]), 0.0, 1e-6), 77, 1, followed=1)
    assert set(plan.slow_modes) == {1}
    assert np.all(plan.jumps[:, 7, 0] < 1e-3) and np.all(plan.jumps[:, 7, 1] == 1.0)
    # those that do not oscillate are stepped
    assert plan_jumps(central_difference(np.array([1e4, 1e6]), 1.0, 1e-7), 64, 8, followed=2) is None
