"""Both integrators against exact solutions."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Lining, Scene
from integration_cases import ABRADABLE, DIRECT, LINING, oscillator, with_static_modes
from scipy.integrate import solve_ivp

from r37core.time_integration.integrators import EXACT_MODAL, INTEGRATORS, central_difference, exact_modal, recursion
from r37core.time_integration.simulate import Simulation


def free_motion(frequency, ratio, time, start, velocity):
    """Displacement of an underdamped oscillator (Meirovitch, Fundamentals of Vibrations, section 2.2)."""
    damped = frequency * np.sqrt(1 - ratio**2)
    sine = (velocity + ratio * frequency * start) / damped
    return np.exp(-ratio * frequency * time) * (start * np.cos(damped * time) + sine * np.sin(damped * time))


@pytest.mark.parametrize("ratio", [0.0, 5e-4, 0.3, 0.99])
@pytest.mark.parametrize("frequency", [6e3, 1e5, 3e6, 3e7])
def test_exact_modal_is_the_free_motion_at_any_step(frequency, ratio):
    """Also at steps of many periods, where central differences would have left for infinity."""
    step = 1e-6
    stepping = exact_modal(np.array([frequency]), ratio, step)
    time = step * np.arange(200)
    exact = free_motion(frequency, ratio, time, 1.0, 0.2 * frequency)
    u, d = exact[1], exact[1] - exact[0]
    for n in range(2, len(time)):
        d = stepping.keep[0] * d - stepping.pull[0] * u
        u += d
        assert u == pytest.approx(exact[n], abs=1e-9)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_constant_force_holds_the_static_deflection(integrator):
    """The fixed point of the recursion is F/omega^2, whatever the step."""
    frequencies = np.array([4e3, 7e4, 1.2e6])
    stepping = recursion(integrator, frequencies, 0.05, 1e-6)
    np.testing.assert_allclose(stepping.inverse / stepping.pull, 1.0 / frequencies**2, rtol=1e-12)


def test_both_tend_to_each_other_with_the_step():
    frequencies, ratio = np.array([5e3, 5e4]), 1e-3
    differences = []
    for step in (1e-6, 1e-7):
        central, exact = central_difference(frequencies, ratio, step), exact_modal(frequencies, ratio, step)
        differences.append(np.abs(central.pull / exact.pull - 1.0))
        np.testing.assert_allclose(central.lost, exact.lost, rtol=5.0 * frequencies.max() * step)
    np.testing.assert_allclose(differences[0] / differences[1], 100.0, rtol=0.05)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_pushed_oscillator_against_an_ode_solver(integrator):
    """Bars that never yield are a spring pressed by the lobes that pass; its force comes a step late: an error of order h."""
    frequency, ratio, speed = 8000.0, 0.02, 1000.0
    lining = Lining(5e-3, 4e6, 0.0, 1e12, bar_width=1.0, bars=10)
    casing = Casing(1e-4, lobes=2, amplitude=2.0, rise_fraction=0.0)
    scene = Scene(casing, lining, damping_ratio=ratio, divergence_limit=1.0)
    model, flexibility = oscillator(frequency), 0.0
    if integrator == EXACT_MODAL:
        flexibility = 1e-9
        model = with_static_modes(model, flexibility)
    stiffness = 1.0 / (lining.thickness / lining.elastic_modulus / lining.area(0.25) + flexibility)

    def motion(time, state):
        shape = casing.shape(np.array([model.theta[0] - speed * time]))[0]
        pressed = max(0.0, state[0] - casing.clearance * (1.0 - casing.amplitude * shape))
        return state[1], -2 * ratio * frequency * state[1] - frequency**2 * state[0] - stiffness * pressed

    errors = []
    for step in (1e-6, 1e-7):
        simulation = Simulation(model, speed, scene, IntegrationChoice(step, 3, 500, integrator=integrator))
        ours = simulation.advance(simulation.start(), 3).samples[:, 0]
        time = (1 + np.arange(len(ours))) * simulation.problem.grid.steps_per_sample * simulation.problem.grid.time_step
        exact = solve_ivp(motion, (0.0, time[-1]), [0.0, 0.0], t_eval=time, rtol=1e-10, atol=1e-14, max_step=1e-5).y[0]
        errors.append(np.abs(ours - exact).max() / np.abs(exact).max())
    assert errors[0] < 0.02
    assert errors[1] < 0.12 * errors[0]


NARROW = replace(ABRADABLE, lining=replace(LINING, bar_width=1e-3))


@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
@pytest.mark.parametrize("step", [2e-7, 8e-7])
def test_energy_balance_of_exact_modal_steps_closes(contact, scene, step):
    simulation = Simulation(contact, 1600.0, scene, IntegrationChoice(step, 3, 62, integrator=EXACT_MODAL))
    state = simulation.start()
    simulation.advance(state, 3)
    work, loss = simulation.work(state), state.totals["loss"]
    assert loss > 0.0
    assert abs(simulation.energy(state) - work + loss) < 1e-9 * (abs(work) + loss)


def test_exact_modal_steps_have_no_limit_from_the_blade(contact):
    """Four times the limit of central differences, free of contact: the energy of a damped blade only falls."""
    highest = contact.modes_at(1000.0)[0][-1]
    scene = Scene(Casing(1.0, lobes=0), damping_ratio=5e-4)
    simulation = Simulation(contact, 1000.0, scene, IntegrationChoice(8.0 / highest, 4, 62, integrator=EXACT_MODAL))
    state = simulation.start()
    state.displacement[:] = 1e-6 / (1.0 + np.arange(len(simulation.problem.blade.frequencies)))
    start = simulation.energy(state)
    simulation.advance(state, 4)
    assert 0.0 < simulation.energy(state) < start
