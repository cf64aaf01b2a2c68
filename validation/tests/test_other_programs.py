"""The time integration against SciPy and other programs, on a small blade."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Lining, Scene
from evidence.equations_of_motion import against_spring, blade_of, with_wear, without_yield
from harmonic_balance import by_harmonic_balance
from integration_cases import random_model, with_static_modes
from reference_engine import ReferenceSimulation

from r37core.contact.laws import series_modulus
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.simulate import Simulation

SPEED, SAMPLES, BARS = 3000.0, 50, 40
HALF = SAMPLES // 2
TIMES = (1 + np.arange(SAMPLES)) * 2.0 * np.pi / SPEED / SAMPLES
ELASTIC = Lining(5e-3, 20e9, 5e9, 1e30, bar_area=1e-7)
SCENE = Scene(Casing(0.356e-3, amplitude=1.5, rise_fraction=0.0), ELASTIC, Friction(0.3), damping_ratio=0.01)


FLEXIBILITY = 2e-7
"""Of static modes (m/N), which the time integration has in addition to those of the equations of motion."""

SLOW = np.linspace(6e3, 1e5, 10)
"""Frequencies (rad/s)."""


@pytest.fixture(scope="module")
def model():
    """Two nodes, the first at the leading edge, on modes of frequencies SLOW."""
    full, modes = random_model(2), len(SLOW)
    rows = full.displacement_operator[..., :modes]
    return replace(
        full,
        squared_frequencies=SLOW**2,
        stiffness_per_square=np.zeros((modes, modes)),
        displacement_operator=rows,
        tip_displacement_operator=rows[:, [0, 1]],
        to_reduced=np.eye(modes),
        # so slow over the casing that the vibration turns the friction
        radius=np.full(2, 0.02),
    )


def in_series(scene):
    """The scene for the equations of motion, of slow modes alone: its bars with the static modes' flexibility behind them."""
    lining = scene.lining
    stiffness = lining.elastic_modulus * lining.bar_area / lining.thickness
    modulus = series_modulus(lining.elastic_modulus, stiffness, FLEXIBILITY)
    assert modulus < 0.95 * lining.elastic_modulus
    return replace(scene, lining=replace(lining, elastic_modulus=modulus))


def integrated(model, scene, steps, integrator, static_above=1.0):
    """Samples of the leading edge and wear after a revolution of so many steps."""
    choice = IntegrationChoice(TIMES[-1] / steps, 1, SAMPLES, integrator=integrator, static_above=static_above)
    simulation = ReferenceSimulation(model, SPEED, scene, choice)
    assert simulation.problem.grid.steps_per_revolution == steps
    assert len(simulation.problem.blade.frequencies) == len(SLOW)
    state = simulation.start()
    return simulation.advance(state, 1).samples[:, 0], state.wear


def held(model, integrator):
    """The model, with exact modal steps on its static modes, and how the scene is to the equations of motion."""
    return (with_static_modes(model, FLEXIBILITY), in_series) if integrator == EXACT_MODAL else (model, lambda scene: scene)


def order_of(errors):
    """Power of the step with which errors fall, over all halvings of it."""
    return np.log2(errors[0] / errors[-1]) / (len(errors) - 1)


def error(motion, exact):
    return np.abs(motion - exact).max() / np.abs(exact).max()


@pytest.mark.parametrize(("integrator", "order", "largest"), [(EXACT_MODAL, 2.0, 1e-4), (CENTRAL_DIFFERENCE, 1.0, 5e-2)])
def test_on_bars_that_do_not_yield_the_integration_has_the_order_that_it_claims(model, integrator, order, largest):
    blade, seen = held(model, integrator)
    exact = without_yield(blade_of(model, SPEED, seen(SCENE), np.inf), TIMES, rtol=1e-9, atol=1e-14)
    errors = [error(integrated(blade, SCENE, steps, integrator)[0], exact) for steps in (1000, 2000, 4000)]
    assert errors[0] < largest
    assert order_of(errors) == pytest.approx(order, abs=0.35), errors


def test_a_casing_that_rises(model):
    rising = replace(SCENE, casing=replace(SCENE.casing, rise_fraction=0.5))
    exact = without_yield(blade_of(model, SPEED, in_series(rising), TIMES[-1]), TIMES, rtol=1e-9, atol=1e-14)
    assert error(integrated(with_static_modes(model, FLEXIBILITY), rising, 4000, EXACT_MODAL)[0], exact) < 1e-3


def test_on_bars_that_wear_the_integration_is_of_first_order(model):
    """In motion and wear: what a node does on a bar after its last step there goes unseen."""
    scene = replace(SCENE, lining=replace(ELASTIC, yield_stress=1e6, bars=BARS))
    exact, wear = with_wear(blade_of(model, SPEED, in_series(scene), np.inf), TIMES, rtol=1e-8, atol=1e-13)
    assert np.count_nonzero(wear) > 4
    blade = with_static_modes(model, FLEXIBILITY)
    runs = [integrated(blade, scene, BARS * parts, EXACT_MODAL) for parts in (25, 50, 100)]
    for which, truth in ((0, exact), (1, wear)):
        errors = [error(run[which], truth) for run in runs]
        assert errors[-1] < 1e-2
        assert order_of(errors) > 0.7, errors


def test_springs_with_dashpots_lead_to_the_multipliers_of_direct_contact(model):
    """Those of central differences, which have mass at the nodes: it does not bounce."""
    scene = replace(SCENE, lining=None)
    ours = integrated(model, scene, 8000, CENTRAL_DIFFERENCE)[0][:HALF]
    blade = blade_of(model, SPEED, scene, np.inf)
    stiffnesses = (1e7, 1e8, 1e9, 1e10)
    errors = [error(against_spring(blade, TIMES[:HALF], k, 2.0, rtol=1e-6, atol=1e-12), ours) for k in stiffnesses]
    assert errors[-1] < 2e-2
    assert errors[0] > 5 * errors[-1]


def test_in_direct_contact_the_integration_is_on_the_springs_of_its_static_modes(model):
    """Second order; nothing is lost in an impact."""
    scene = replace(SCENE, lining=None)
    exact = against_spring(blade_of(model, SPEED, scene, np.inf), TIMES, 1.0 / FLEXIBILITY, 0.0, rtol=1e-9, atol=1e-14)
    blade = with_static_modes(model, FLEXIBILITY)
    errors = [error(integrated(blade, scene, steps, EXACT_MODAL)[0], exact) for steps in (1000, 2000, 4000)]
    assert errors[0] < 1e-3
    assert order_of(errors) == pytest.approx(2.0, abs=0.35), errors


def test_a_settled_motion_is_found_by_harmonic_balance(model):
    """From a tenth less than it, by mousai; bars that are worn otherwise have another motion."""
    choice = IntegrationChoice(1e-6, 60, SAMPLES * 10, integrator=EXACT_MODAL)
    simulation = Simulation(model, SPEED, SCENE, choice)
    state = simulation.start()
    simulation.advance(state, choice.revolutions)
    motion = simulation.advance_samples(copy.deepcopy(state), choice.samples_per_revolution).samples[:, 0]
    sizes = [np.sqrt(np.mean(each**2)) for each in (motion, by_harmonic_balance(simulation, state))]
    assert sizes[0] > 1e-6
    assert sizes[1] == pytest.approx(sizes[0], rel=2e-3)
    state.wear += 2e-5
    assert np.sqrt(np.mean(by_harmonic_balance(simulation, state) ** 2)) != pytest.approx(sizes[0], rel=1e-2)
