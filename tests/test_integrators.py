"""Both integrators against exact solutions."""

import numpy as np
import pytest
from integration_runs import free_motion

from r37core.time_integration.integrators import INTEGRATORS, central_difference, exact_modal, recursion


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
